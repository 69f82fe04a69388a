#!/bin/sh
# Makes the sample again: truth, hand-made mesh, readings, and the simulated photograph.
set -eu
cd "$(dirname "$0")/../../.."
cmake --preset default >/dev/null
cmake --build build --target culet --target make_dravite_step
sample=samples/dravite-step
build/make_dravite_step stone $sample
# A mesh drawn by hand says nothing of planes.
grep -v '^# culet' $sample/hand.obj >$sample/hand.tmp && mv $sample/hand.tmp $sample/hand.obj
build/culet render $sample/making/true-scene.toml -o out/dravite-true.exr
build/make_dravite_step photograph out/dravite-true.exr $sample/simulated-photo.png
