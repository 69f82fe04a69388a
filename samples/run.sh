#!/bin/sh
# The main job from a bare Debian 12 machine: installs missing packages, builds culet, fits and renders a
# real diamond, fits and renders a tourmaline and compares it with its photograph.
set -eu
cd "$(dirname "$0")/.."
sh .ci/install-packages.sh
cmake --workflow --preset sample
for sample in real-brilliant dravite-step; do
    echo
    echo "== $sample"
    build/culet run "samples/$sample/job.toml" -o "out/$sample" >/dev/null
done
echo
echo "== instruments"
mkdir -p out/instruments
for view in polariscope conoscope dichroscope; do
    build/culet render "samples/instruments/$view.toml" -o "out/instruments/$view.png" --exposure 2
done
echo
echo "Pictures: $PWD/out/instruments/*.png"
echo "Two reports to open in a browser:"
for sample in real-brilliant dravite-step; do
    echo "  $PWD/out/$sample/report.html"
done
