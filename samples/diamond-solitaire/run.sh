#!/bin/sh
# A diamond solitaire: stone, mounting, scene and picture.
#   sh samples/diamond-solitaire/run.sh [CULET] [FOLDER]
set -eu
cd "$(dirname "$0")/../.."
culet=${1:-build/culet}
folder=${2:-out/diamond-solitaire}
mkdir -p "$folder"
"$culet" cut round-brilliant --diameter 6.5 -q -o "$folder/diamond.obj"
"$culet" setting "$folder/diamond.obj" --material diamond --prongs 6 --metal platinum --ring 17 \
    -o "$folder/ring.obj" --scene "$folder/scene.toml"
"$culet" render "$folder/scene.toml" --engine whitted -o "$folder/diamond-solitaire-quick.png"
"$culet" render "$folder/scene.toml" -o "$folder/diamond-solitaire.png"
