#!/bin/sh
# What accuracy costs in time, for a diamond, a sapphire and a zircon: one page each, and with `--pictures` the charts of
# the README drawn anew. Takes about ten minutes on one core; other machines find other times.
set -eu
cd "$(dirname "$0")/../.."
[ -x build/culet ] || { sh .ci/install-packages.sh && cmake --workflow --preset sample; }
for stone in diamond sapphire zircon; do
    echo "== $stone"
    build/culet study "samples/studies/$stone.toml" -o "out/studies/$stone" --threads 1 --budget 150
    if [ "${1:-}" = --pictures ]; then cp "out/studies/$stone/time.svg" "docs/pictures/study-$stone.svg"; fi
done
