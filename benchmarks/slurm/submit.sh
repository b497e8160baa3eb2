#!/bin/sh
# submit.sh SUITE OUT N: runs a suite as N parts on Slurm and merges their rows into OUT when all are done.
# Options of sbatch for the parts, such as a partition or a time, come from the environment (SBATCH_PARTITION, SBATCH_TIMELIMIT, ...).
# Without Slurm: seq N | parallel maxwrench run SUITE --shard {}/N --threads 1 --out OUT/shards/{}; maxwrench merge OUT OUT/shards/*
# and maxwrench run SUITE --dry --out OUT, which counts what is missing.
set -eu
[ $# -eq 3 ] || { echo "submit.sh: got $# words, expected SUITE OUT N" >&2; exit 2; }
suite=$1 out=$2 parts=$3
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$out/shards"
array=$(sbatch --parsable --array="1-$parts" --output="$out/shards/%a.log" --open-mode=append --requeue "$here/part.sh" "$suite" "$out" "$parts")
sbatch --dependency="afterok:$array" --kill-on-invalid-dep=yes --output="$out/merge.log" "$here/merge.sh" "$out" "$parts"
