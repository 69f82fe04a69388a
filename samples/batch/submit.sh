#!/bin/sh
# A batch on Slurm: submit.sh SHARES JOBS DIR [OPTIONS OF culet batch]. When all shares are done, another job makes
# the table. Waits for it where WAIT is set. DIR is on a disk that all nodes see.
set -eu
if [ $# -lt 3 ]; then
    echo "usage: submit.sh SHARES JOBS DIR [OPTIONS]" >&2
    exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
shares=$1 out=$3
shift
array=$(sbatch --parsable --array="0-$((shares - 1))" "$here/culet-batch.sh" "$@")
merge=$(sbatch --parsable ${WAIT:+--wait} --dependency="afterok:$array" --job-name=culet-merge \
    --wrap="'${CULET:-culet}' batch --merge '$out' || [ \$? -eq 1 ]")
echo "shares: job $array; table: job $merge, $out/index.html"
