#!/bin/sh
# One share of a batch for each task of a job array. Submitted by submit.sh, or by hand:
#   sbatch --array=0-49 culet-batch.sh JOBS DIR [OPTIONS OF culet batch]
# A task that a node takes down with it is queued again, and goes on where it stopped.
#SBATCH --job-name=culet-batch
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
set -u
if [ $# -lt 2 ]; then
    echo "usage: sbatch --array=0-N culet-batch.sh JOBS DIR [OPTIONS]" >&2
    exit 2
fi
jobs=$1 out=$2
shift 2
"${CULET:-culet}" batch "$jobs" -o "$out" --resume --threads "${SLURM_CPUS_PER_TASK:-1}" \
    --shard "$((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN))/$SLURM_ARRAY_TASK_COUNT" "$@"
# 1: some stone is not to be trusted, which the table says; the share is done.
code=$?
[ "$code" -le 1 ] && exit 0
exit "$code"
