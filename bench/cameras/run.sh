#!/bin/sh
# Photographs of stones by POV-Ray, registered: sh bench/cameras/run.sh [FOLDER [OPTIONS]]
# Needs the package povray. Panoramas (blender-data) are used where they are at hand, and a scanned diamond with the
# option --scan FILE. Nothing that it makes is kept in the repository.
set -e
cd "$(dirname "$0")/../.."
if ! command -v povray >/dev/null 2>&1; then
    echo "skipped: POV-Ray is not installed (Debian package povray)"
    exit 0
fi
folder=${1:-build/povray-photographs}
[ $# -gt 0 ] && shift
(cmake --preset bench && cmake --build build --target povray_photographs) >/dev/null
build/povray_photographs -o "$folder" "$@"
