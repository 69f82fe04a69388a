#!/bin/sh
# Photographs of stones by POV-Ray, registered: sh tests/cameras/run.sh [FOLDER [OPTIONS]]
# Needs a configured build folder and the package povray; a scanned diamond and panoramas
# (blender-data) are used where they are at hand. Nothing that it makes is kept in the repository.
set -e
cd "$(dirname "$0")/../.."
if ! command -v povray >/dev/null 2>&1; then
    echo "skipped: POV-Ray is not installed (Debian package povray)"
    exit 0
fi
folder=${1:-build/povray-photographs}
[ $# -gt 0 ] && shift
ninja -C build povray_photographs >/dev/null
build/povray_photographs -o "$folder" "$@"
