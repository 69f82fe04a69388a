#!/bin/sh
# Everything from a bare Debian 12 machine to passed tests: installs missing packages, configures,
# builds, tests. `sh tests/run.sh asan` does the same under the address and undefined-behaviour
# sanitizers, `sh tests/run.sh contract` runs the hard cases with fused multiplications and additions.
set -eu
cd "$(dirname "$0")/.."
sh .ci/install-packages.sh .ci/packages.txt .ci/packages-engine.txt .ci/packages-python.txt .ci/packages-test.txt
case ${1:-test} in
    test | asan | contract) ;;
    *) echo "usage: sh tests/run.sh [asan | contract]" >&2; exit 2 ;;
esac
exec cmake --workflow --preset "${1:-test}"
