#!/bin/sh
#SBATCH --job-name=maxwrench-merge
# merge.sh OUT N: the rows of all parts in one folder.
set -eu
set -- "$1" $(seq -f "$1/shards/%g" "$2")
exec "${MAXWRENCH:-maxwrench}" merge "$@"
