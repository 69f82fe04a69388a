#!/bin/sh
# A Slurm of one node on the loopback, for a test: slurm_here.sh start DIR | kill-node DIR | start-node DIR | stop DIR.
# As root, with Debian's slurmctld, slurmd, slurm-client and munge. Then: export SLURM_CONF=DIR/slurm.conf
set -eu
what=$1
dir=$(mkdir -p "$2" && cd "$2" && pwd)
export SLURM_CONF="$dir/slurm.conf"
end() {
    for pid in "$@"; do
        if [ -f "$dir/$pid.pid" ]; then kill "$(cat "$dir/$pid.pid")" 2>/dev/null || true; fi
    done
}
case $what in
    stop)
        end d ctld munge
        exit 0
        ;;
    kill-node)
        # As a node that loses its power: the steps' own processes go with it.
        pkill -KILL -F "$dir/d.pid" || true
        pkill -KILL -f "slurmstepd: \[" || true
        exit 0
        ;;
    start-node)
        slurmd -f "$SLURM_CONF"
        exit 0
        ;;
esac
host=$(hostname -s)
mkdir -p "$dir/state" "$dir/spool" "$dir/log" /run/munge
chown munge /run/munge
cat > "$SLURM_CONF" <<C
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CryptoType=crypto/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/ctld.pid
SlurmdPidFile=$dir/d.pid
SlurmctldLogFile=$dir/log/ctld.log
SlurmdLogFile=$dir/log/d.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmdTimeout=10
InactiveLimit=0
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SlurmctldPort=16817
SlurmdPort=16818
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
C
if ! [ -S /run/munge/munge.socket.2 ]; then
    runuser -u munge -- /usr/sbin/munged --force 2>/dev/null || runuser -u munge -- /usr/sbin/munged
    cp /run/munge/munged.pid "$dir/munge.pid" 2>/dev/null || true
fi
slurmctld -f "$SLURM_CONF"
sleep 1
slurmd -f "$SLURM_CONF"
sleep 2
sinfo
