#!/usr/bin/env bash
# A Slurm of one node on this machine, of Debian's packages, with everything in a folder of its own:
#
#   cluster.sh start FOLDER    then SLURM_CONF=FOLDER/slurm.conf for sbatch and its like
#   cluster.sh stop FOLDER     ends what was started
#
# It listens on the loopback interface only, on ports that were free a moment ago.
set -euo pipefail

folder=$(mkdir -p "$2" && cd "$2" && pwd)
user=$(id -un)
export SLURM_CONF=$folder/slurm.conf
PATH=$PATH:/usr/sbin:/sbin

free_ports() {
  python3 - <<'PYTHON'
import socket
sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
print(*(one.getsockname()[1] for one in sockets))
PYTHON
}

configure() {
  local controller node
  read -r controller node < <(free_ports)
  mkdir -p "$folder/state" "$folder/spool"
  head -c 1024 /dev/urandom >"$folder/munge.key"
  chmod 0400 "$folder/munge.key"
  cat >"$SLURM_CONF" <<CONF
ClusterName=local
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$controller
SlurmdPort=$node
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
SlurmUser=$user
SlurmdUser=$user
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1
MinJobAge=3600
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP MaxTime=INFINITE
CONF
}

start() {
  configure
  # --force: the folder of a test may be one that others can write to.
  munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
  slurmctld
  slurmd
  local try
  for try in $(seq 100); do
    if [ "$(sinfo --noheader --format=%T 2>/dev/null)" = idle ]; then
      return
    fi
    sleep 0.2
  done
  echo "cluster.sh: no node is ready after 20 s" >&2
  tail --lines=20 "$folder"/*.log >&2
  return 1
}

stop() {
  local daemon pid
  for daemon in slurmd slurmctld munged; do
    if pid=$(cat "$folder/$daemon.pid" 2>/dev/null) && kill "$pid" 2>/dev/null; then
      tail --pid="$pid" --follow /dev/null 2>/dev/null
    fi
  done
}

case "$1" in
  start) start || { stop; exit 1; } ;;
  stop) stop ;;
  *)
    echo "cluster.sh: start or stop, not $1" >&2
    exit 2
    ;;
esac
