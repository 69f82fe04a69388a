#!/bin/sh
# Builds the engine that lets stones turn in pages, build/share/culet/engine.wasm, and installs the packages that this
# needs. Pages that culet writes from then on carry it.
set -eu
cd "$(dirname "$0")/.."
sh .ci/install-packages.sh .ci/packages.txt .ci/packages-engine.txt
exec cmake --workflow --preset engine
