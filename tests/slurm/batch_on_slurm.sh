#!/bin/sh
# A batch on a real Slurm, whose node dies midway, against one machine's: batch_on_slurm.sh CULET MAKE_BATCH_STONES
# [STONES [SHARES]]. The bytes of all results must be the same. 77: there is no Slurm here.
set -eu
CULET=$(realpath "$1") maker=$(realpath "$2") stones=${3:-40} shares=${4:-10}
export CULET
for program in slurmctld slurmd sbatch munged; do
    if ! command -v "$program" >/dev/null || [ "$(id -u)" -ne 0 ]; then
        echo "no Slurm here: it takes root and the packages slurmctld slurmd slurm-client munge"
        exit 77
    fi
done
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
export SLURM_CONF="$work/slurm/slurm.conf"
finish() {
    scancel --user=root 2>/dev/null || true
    sh "$here/slurm_here.sh" stop "$work/slurm"
    rm -rf "$work"
}
trap finish EXIT
"$maker" "$stones" "$work/stones"
sh "$here/slurm_here.sh" start "$work/slurm"
cd "$work"
WAIT=1 sh "$here/../../samples/batch/submit.sh" "$shares" "$work/stones" "$work/array" -q --draws 0 --tilts 0 > submitted 2>&1 &
submitted=$!
# A third of the jobs is done: the node dies, and comes back.
while [ "$(find "$work/array/jobs" -name job.json 2>/dev/null | wc -l)" -lt $((stones / 3)) ]; do
    kill -0 "$submitted" 2>/dev/null || { cat submitted slurm-*.out; exit 1; }
    sleep 0.2
done
echo "killing the node with $(find "$work/array/jobs" -name job.json | wc -l) of $stones jobs done"
sh "$here/slurm_here.sh" kill-node "$work/slurm"
sleep 15
sh "$here/slurm_here.sh" start-node "$work/slurm"
wait "$submitted"
cat submitted
"$CULET" batch "$work/stones" -o "$work/one" -q --draws 0 --tilts 0 > /dev/null || [ $? -eq 1 ]
diff -r "$work/one" "$work/array"
echo "$shares shares on Slurm, a node killed: $(find "$work/array/jobs" -type f | wc -l) files as on one machine"
