#!/bin/sh
# Writes docs/sources/*.html: the figures of culet's sources beside culet's.
#   sh bench/studies.sh [NAME ...] [-o FOLDER] [--set KEY=VALUE ...]
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
sh "$here/.ci/install-packages.sh" "$here/.ci/packages.txt" "$here/.ci/packages-test.txt"
(cd "$here" && cmake --preset bench && cmake --build build --target make_source_pages) >&2
exec "$here/build/tests/make_source_pages" "$@"
