#!/usr/bin/env bash
# run.sh MAXWRENCH [SUITE]: a suite in 4 parts on a Slurm of one node, which this starts and ends itself, as plain daemons. The process of one part is killed
# once. The merged rows must be those of one machine, byte for byte.
set -euo pipefail
[ "$(id -u)" -eq 0 ] || { echo "skipped: Slurm's daemons need root"; exit 0; }
command=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
slurm=$here/../../benchmarks/slurm
suite=$(realpath "${2:-$here/suite.toml}")
work=$(mktemp -d)
chmod 755 "$work"  # munge rejects a socket that not all can reach
daemons=()

# end_daemons: by word, and after ten seconds by force, since a daemon that waits for another one may never go.
end_daemons() {
  [ ${#daemons[@]} -ne 0 ] || return 0
  kill "${daemons[@]}" 2> /dev/null || true
  for _ in {1..100}; do
    kill -0 "${daemons[@]}" 2> /dev/null || break
    sleep 0.1
  done
  kill -KILL "${daemons[@]}" 2> /dev/null || true
  wait
}

finish() {
  local status=$?
  if [ $status -ne 0 ]; then tail -n 30 "$work"/*.log "$work"/out/*.log "$work"/out/shards/*.log >&2 || true; fi
  timeout 20 scancel --quiet --user=root || true
  end_daemons
  rm -rf "$work"
}
trap finish EXIT

# start WORD...: a daemon in the foreground of its own, until the end of this.
start() {
  "$@" > "$work/$(basename "$1").log" 2>&1 &
  daemons+=($!)
}

# wait_for SECONDS CONDITION...
wait_for() {
  local left=$1
  shift
  until "$@"; do
    [ $((left -= 1)) -gt 0 ] || { echo "waited in vain for: $*" >&2; return 1; }
    sleep 1
  done
}

configure() {
  local ports=$((20000 + $$ % 20000 / 2 * 2))
  mkdir "$work/state" "$work/spool" "$work/out"
  head -c 1024 /dev/urandom > "$work/key"
  chmod 600 "$work/key"
  cat > "$work/slurm.conf" <<EOF
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$ports
SlurmdPort=$((ports + 1))
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
AuthType=auth/munge
AuthInfo=socket=$work/socket,cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,bf_interval=1
MessageTimeout=60
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
EOF
}

# What the parts call instead of the command: that of part 2 dies once, as soon as it has rows.
write_mortal_command() {
  cat > "$work/maxwrench" <<EOF
#!/bin/sh
if [ "\$1" = run ] && [ "\$SLURM_ARRAY_TASK_ID" = 2 ] && [ ! -e "$work/died" ]; then
  "$command" "\$@" &
  until [ -s "$work/out/shards/2/times.csv.part" ] && [ "\$(wc -l < "$work/out/shards/2/times.csv.part")" -gt 3 ]; do sleep 0.01; done
  kill -KILL \$!
  cp "$work/out/shards/2/times.csv.part" "$work/died"
  wait \$!
  exit \$?
fi
exec "$command" "\$@"
EOF
  chmod +x "$work/maxwrench"
}

node_is_idle() { [ "$(sinfo -h -o %T 2> "$work/sinfo.log")" = idle ]; }
queue_is_empty() { [ -z "$(squeue -h)" ]; }

configure
write_mortal_command
export SLURM_CONF=$work/slurm.conf MAXWRENCH=$work/maxwrench
start munged --foreground --key-file="$work/key" --socket="$work/socket" --pid-file="$work/munged.pid" \
  --log-file="$work/munge.log" --seed-file="$work/seed" --num-threads=2
wait_for 30 test -S "$work/socket"
start slurmctld -D
start slurmd -D
wait_for 60 node_is_idle

"$slurm/submit.sh" "$suite" "$work/out" 4
"$command" run "$suite" --threads 2 --out "$work/one" > "$work/one.log" || [ $? -eq 1 ]  # some row has no value
wait_for 5400 queue_is_empty
[ -s "$work/died" ] || { echo "part 2 was not killed" >&2; exit 1; }
cmp "$work/one/values.csv.gz" "$work/out/values.csv.gz"
grep 'of them existed before' "$work/out/shards/2.log"
cat "$work/out/merge.log"
