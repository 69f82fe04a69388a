#!/bin/sh
# One line of a file of commands for each task of a job array: studies, optimisations, renders.
#   sbatch --array=1-"$(wc -l < COMMANDS.txt)" lines.sh COMMANDS.txt
#SBATCH --job-name=culet-lines
#SBATCH --requeue
set -eu
command=$(sed -n "${SLURM_ARRAY_TASK_ID}p" "$1")
[ -n "$command" ] || { echo "$1 has no line $SLURM_ARRAY_TASK_ID" >&2; exit 2; }
exec sh -c "$command"
