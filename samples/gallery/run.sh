#!/bin/sh
# The pictures of docs/gallery.md: every light by name, before a diamond, a sapphire and a tourmaline.
#   sh samples/gallery/run.sh [CULET] [FOLDER]
set -eu
cd "$(dirname "$0")/../.."
culet=${1:-build/culet}
pictures=${2:-docs/pictures/gallery}
stones=$(mktemp -d)
trap 'rm -r "$stones"' EXIT
mkdir -p "$pictures"
"$culet" cut round-brilliant -q -o "$stones/diamond.obj"
"$culet" cut oval -q -o "$stones/sapphire.obj"
"$culet" cut step -q -o "$stones/tourmaline.obj"

for light in jeweller photograph daylight lightbox darkfield aset idealscope arrows hearts; do
    while read -r stone material; do
        "$culet" render "$stones/$stone.obj" --material "$material" --light "$light" --width 6.5 \
            --size 180 -q -o "$pictures/$light-$stone.png"
        echo "$pictures/$light-$stone.png"
    done <<STONES
diamond diamond
sapphire sapphire_blue
tourmaline tourmaline_green
STONES
done
