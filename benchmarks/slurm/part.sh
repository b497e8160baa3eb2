#!/bin/sh
#SBATCH --job-name=maxwrench
# part.sh SUITE OUT N: one part of an array job. It goes on with the rows that it finds; if its process dies, it queues itself again, three
# times at most. Exit status 1 says that some rows have no value, which is a result.
suite=$1 out=$2 parts=$3
status=0
"${MAXWRENCH:-maxwrench}" run "$suite" --shard "$SLURM_ARRAY_TASK_ID/$parts" --threads "${SLURM_CPUS_PER_TASK:-1}" \
  --out "$out/shards/$SLURM_ARRAY_TASK_ID" || status=$?
[ $status -gt 1 ] || exit 0
[ $status -gt 2 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ] &&
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" && sleep 60  # Slurm ends the job during the wait
exit $status
