#!/bin/sh
# What accuracy costs in time, for a diamond, a sapphire and a zircon: one page each, and with `--pictures` the charts of
# the README drawn anew. Each takes up to three minutes of one core; other machines find other times.
set -eu
cd "$(dirname "$0")/../.."
[ -x build/culet ] || { sh .ci/install-packages.sh && cmake --workflow --preset sample; }
study() {
    stone=$1
    shift
    echo "== $stone"
    build/culet study "samples/studies/$stone.toml" -o "out/studies/$stone" --threads 1 --runs 3 "$@" || [ $? = 1 ]
    if $pictures; then cp "out/studies/$stone/time.svg" "docs/pictures/study-$stone.svg"; fi
}
pictures=false
if [ "${1:-}" = --pictures ]; then pictures=true; fi
# Trees of two waves are dear, and the reference has to be affordable: small pictures.
study diamond --size 64 --budget 140
study sapphire --size 48 --budget 110
study zircon --size 48 --budget 90
