#!/bin/sh
#SBATCH --job-name=maxwrench-merge
# merge.sh OUT N: merges the rows of all parts into one folder.
set -eu
out=$1 parts=$2
set --
for part in $(seq "$parts"); do set -- "$@" "$out/shards/$part"; done
exec "${MAXWRENCH:-maxwrench}" merge "$out" "$@"
