#!/bin/sh
# A batch by Snakemake against one command: batch_by_snakemake.sh CULET MAKE_BATCH_STONES. The results are the same.
set -eu
culet=$(realpath "$1") maker=$(realpath "$2")
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$maker" 4 "$work/stones"
cd "$work"
snakemake --quiet --cores 2 -s "$here/../../samples/batch/Snakefile" \
    --config jobs="$work/stones" out="$work/shares" shares=3 culet="$culet" options="-q --draws 0 --tilts 0"
"$culet" batch "$work/stones" -o "$work/one" -q --draws 0 --tilts 0 > /dev/null || [ $? -eq 1 ]
rm -rf "$work/shares/.shares"
diff -r "$work/one" "$work/shares"
echo "3 shares by Snakemake: the same files as by one command"
