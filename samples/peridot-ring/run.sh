#!/bin/sh
# A ring with a peridot: stone, mounting, scene and picture.
#   sh samples/peridot-ring/run.sh [CULET] [FOLDER]
set -eu
cd "$(dirname "$0")/../.."
culet=${1:-build/culet}
folder=${2:-out/peridot-ring}
mkdir -p "$folder"
"$culet" cut oval --width 6 -q -o "$folder/peridot.obj"
"$culet" setting "$folder/peridot.obj" --material peridot --prongs 4 --metal gold --ring 17 \
    -o "$folder/ring.obj" --scene "$folder/scene.toml"
"$culet" render "$folder/scene.toml" --engine whitted -o "$folder/peridot-ring-quick.png"
# Both waves of a biaxial stone, each with its own tree of rays, take many minutes in a ring: left out.
"$culet" render "$folder/scene.toml" -o "$folder/peridot-ring.png" \
    --set render.samples=64 --set 'render.effects=["absorption", "dispersion"]'
