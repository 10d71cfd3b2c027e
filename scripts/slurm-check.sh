#!/usr/bin/env bash
# Plans batches on a real Slurm: a cluster of this one machine, from Debian's packages, that listens on loopback and is
# gone afterwards. Needs root.
#
# A job array (scripts/slurm-array.sh) of four shards has to write the rows of the command, and so has one of which a
# task was killed in the middle, once the same job is sent again, and Dask on jobs of which one is killed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

[ "$(id -u)" = 0 ] || die "a Slurm of one's own needs root"
PATH=$PATH:/usr/sbin:/sbin # where the daemons are
find_missing() {
  missing=()
  command -v munged >/dev/null || missing+=(munge)
  { command -v slurmctld && command -v slurmd && command -v sbatch; } >/dev/null || missing+=(slurm-wlm)
}
find_missing
[ ${#missing[@]} = 0 ] || install_missing
. scripts/python-package.sh

place=$(mktemp -d /tmp/ffsm-slurm-XXXXXX)
daemons=()
end() {
  local status=$?
  if [ $status != 0 ] && [ ${#daemons[@]} != 0 ]; then
    tail -n 20 "$place"/*.log "$place"/job-*.out >&2 || true
    # Jobs outlive the daemons.
    timeout 10 scancel --user=root || true
    sleep 2
  fi
  # The controller first: it would take the node's end for a failure.
  [ ${#daemons[@]} = 0 ] || kill "${daemons[@]}" 2>/dev/null || true
  wait
  rm -rf "$place"
}
trap end EXIT
# munged refuses a socket in a folder that others cannot reach, and a key that they can read.
chmod 755 "$place"
head -c 1024 /dev/urandom >"$place/munge.key"
chmod 600 "$place/munge.key"

# Two ports that nothing listens on.
read -r controller node < <(python3 -c '
import socket
ends = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
print(*(end.getsockname()[1] for end in ends))')
# Control groups need not be there, so processes are found by their parents, and nothing is bound to processors.
cat >"$place/slurm.conf" <<EOF
ClusterName=check
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$controller
SlurmdPort=$node
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$place/munge.socket
CredType=cred/munge
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=check Nodes=ALL Default=YES MaxTime=30 State=UP
EOF
export SLURM_CONF=$place/slurm.conf
mkdir "$place/state" "$place/spool"

munged --foreground --socket="$place/munge.socket" --key-file="$place/munge.key" --pid-file="$place/munged.pid" \
  --seed-file="$place/munge.seed" --log-file="$place/munged.log" >/dev/null 2>&1 &
munged=$!
daemons=("$munged")
slurmctld -D -f "$SLURM_CONF" >/dev/null 2>&1 &
daemons=("$!" "${daemons[@]}")
slurmd -D -f "$SLURM_CONF" >/dev/null 2>&1 &
daemons=("${daemons[0]}" "$!" "$munged")

# Waits for a condition, a minute at most.
await() {
  local what=$1 left=200
  shift
  until "$@"; do
    left=$((left - 1))
    [ $left -gt 0 ] || die "$what: not within a minute"
    sleep 0.3
  done
}
is_up() { [ "$(sinfo -h -o %t 2>/dev/null)" = idle ]; }
await "the node of Slurm" is_up
sinfo --version

# Plans of some milliseconds, enough of them that a shard lasts seconds.
cat >"$place/batch.toml" <<EOF
schema = 1
problem = "$PWD/config/table1-relaxed.toml"
seed = 3
count = 400
[[vary]]
key = "task.final.joints[0]"
uniform = [0.3, 0.7]
EOF

# Sends the array to a folder; its number is then in `job`.
send() {
  job=$(sbatch --parsable --array=1-4 --cpus-per-task=1 --time=10 --chdir="$place" --output="$place/job-%A-%a.out" \
    scripts/slurm-array.sh "$place/batch.toml" "$place/$1")
}
has_ended() { [ -z "$(squeue -h -j "$job" 2>/dev/null)" ]; }
# Waits for the end of the array: states of its tasks.
finish() {
  local left=2000
  until has_ended; do
    left=$((left - 1))
    [ $left -gt 0 ] || die "job $job: not done within ten minutes"
    sleep 0.3
  done
  scontrol -o show job "$job" | sed -n 's/.*ArrayTaskId=\([0-9]*\) .*JobState=\([A-Z]*\).*/\1 \2/p' | sort
}
rows() { "$python" python/tests/same_rows.py "$@"; }

"$FFSM_IPOPT" batch "$place/batch.toml" --out "$place/command" --quiet

send whole
states=$(finish)
[ "$(grep -c COMPLETED <<<"$states")" = 4 ] || die "expected four tasks that completed: $states"
echo "a job array of four:"
rows "$place/command" "$place/whole"

send killed
has_part() { compgen -G "$place/killed/part-2of4-*.parquet" >/dev/null; }
await "a part of the second task" has_part
scancel --full --signal=KILL "${job}_2"
states=$(finish)
[ "$(grep -c COMPLETED <<<"$states")" = 3 ] || die "expected one task that was killed: $states"
! rows "$place/command" "$place/killed" >/dev/null 2>&1 || die "expected rows to be missing"
send killed
states=$(finish)
[ "$(grep -c COMPLETED <<<"$states")" = 4 ] || die "expected four tasks that completed: $states"
echo "one of them killed in the middle, and the job sent again:"
rows "$place/command" "$place/killed"

"$python" python/tests/slurm_dask.py "$place/batch.toml" "$place/dask"
echo "Dask on two jobs, one of them killed in the middle:"
rows "$place/command" "$place/dask"
