#!/usr/bin/env bash
# A Slurm cluster of one node on the loopback, for tests: real slurmctld, slurmd and munge, started by this user.
# usage: slurm.sh start DIR   DIR is new; prints what to export (SLURM_CONF). Exit status 1, and why, where it cannot start
#        slurm.sh stop DIR
set -euo pipefail
dir=$2
PATH=$PATH:/usr/sbin

stop() {
  for name in slurmd slurmctld munged; do
    if [[ -f $dir/$name.pid ]]; then kill -9 "$(cat "$dir/$name.pid")" 2>/dev/null || true; fi
  done
}
if [[ $1 == stop ]]; then
  stop
  exit 0
fi

for program in munged slurmctld slurmd sbatch; do
  command -v "$program" >/dev/null || { echo "$program is not installed" && exit 1; }
done
mkdir -p "$dir/state" "$dir/spool"
chmod 700 "$dir"
head -c 128 /dev/urandom >"$dir/munge.key"
chmod 600 "$dir/munge.key"
munged --force --key-file="$dir/munge.key" --socket="$dir/munge.socket" --pid-file="$dir/munged.pid" \
  --log-file="$dir/munged.log" --seed-file="$dir/munge.seed"
host=$(hostname -s)
port=$((20000 + $$ % 6000 * 2)) # and the next one
cat >"$dir/slurm.conf" <<END
ClusterName=presa
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
MailProg=/bin/true
NodeName=$host NodeAddr=127.0.0.1 CPUs=8 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$dir/slurm.conf
slurmctld
slurmd -N "$host"
for _ in $(seq 100); do
  if [[ $(sinfo --noheader --format=%T 2>/dev/null) == idle ]]; then
    echo "$SLURM_CONF"
    exit 0
  fi
  sleep 0.1
done
stop
echo "the cluster does not come up: $(tail -n 1 "$dir/slurmctld.log") $(tail -n 1 "$dir/slurmd.log")"
exit 1
