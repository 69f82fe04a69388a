#!/bin/sh
# The main job from a bare Debian 12 machine: installs missing packages, builds culet, fits a stone to an
# evening's readings, fits and renders a real diamond, fits and renders a tourmaline and compares it with its photograph.
set -eu
cd "$(dirname "$0")/.."
sh .ci/install-packages.sh
cmake --workflow --preset sample
mkdir -p out
echo
echo "== cutters-evening, with a slip of the pen: it is named, and the answer is not to be trusted"
build/culet fit samples/cutters-evening/stone.toml -o out/cutters-evening-slip.obj || [ $? -eq 1 ]
for sample in cutters-evening real-brilliant dravite-step; do
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
echo "Three reports to open in a browser:"
for sample in cutters-evening real-brilliant dravite-step; do
    echo "  $PWD/out/$sample/report.html"
done
