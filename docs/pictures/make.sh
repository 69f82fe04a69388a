#!/bin/sh
# Makes the pictures of the README and the two tutorials anew: sh docs/pictures/make.sh [build/culet]
# Needs ImageMagick (convert), and Chromium with python3-selenium for pictures of pages.
set -eu
cd "$(dirname "$0")/../.."
culet=$(realpath "${1:-build/culet}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
dravite=samples/dravite-step evening=samples/cutters-evening

page() { # HTML PNG HEIGHT: the top of a page
    timeout -k 5 120 chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars \
        --window-size=900,"$3" --screenshot="$work/page.png" "file://$1" >/dev/null 2>&1
    convert "$work/page.png" -resize 640x +dither -colors 128 "$2"
}

drawing() { # SVG WIDTH: as wide in a page
    height=$(sed -n 's/.*viewBox="0 0 \([0-9]*\) \([0-9]*\)".*/\1 \2/p' "$1" | head -1 |
        awk -v width="$2" '{ printf "%.0f", width * $2 / $1 }')
    sed -i "1s/ width=\"[0-9]*\" height=\"[0-9]*\" role/ width=\"$2\" height=\"$height\" role/" "$1"
}

# The README: mesh, fitted stone, render, photograph, live view.
"$culet" render $dravite/hand.obj --material tourmaline_dravite --engine flat --size 300,250 \
    --exposure 0.55 -q -o docs/pictures/tour/mesh.png
"$culet" fit $dravite/stone.toml -o "$work/fitted.obj" --drawing docs/pictures/tour/fitted.svg --paint sigma -q
drawing docs/pictures/tour/fitted.svg 300
"$culet" run $dravite/job.toml -o "$work/dravite" -q >/dev/null
for picture in "$work/dravite/render.png:render.png" "$dravite/simulated-photo.png:photograph.jpg"; do
    convert "${picture%:*}" -gravity center -crop 384x320+0+0 +repage -resize 300x250 -strip \
        -quality 85 "docs/pictures/tour/${picture##*:}"
done
"$culet" fit $dravite/stone.toml -o "$work/hand.obj" --report "$work/fit.json" -q
cp $dravite/stone.toml $dravite/readings.csv "$work"
"$culet" view "$work/stone.toml" --report "$work/fit.json" --before $dravite/hand.obj -o "$work/view.html" -q
PYTHONPATH=tests/viewer python3 - "$work/view.html" "$work/view.png" <<'EOF'
import sys
from viewer_pages import Browser
with Browser(1000, 833) as browser:
    browser.open(sys.argv[1])
    browser.rest()
    browser.run("culet_page.motion.turn_to(Turn.after(Turn.about([1, 0.3, 0], -0.35), culet_page.home()))")
    browser.rest()
    browser.shot(sys.argv[2])
EOF
convert "$work/view.png" -resize 300x250 +dither -colors 128 docs/pictures/tour/view.png

# The first stone: the typing error, the uncertainties, the report.
"$culet" fit $evening/stone.toml -o "$work/slip.obj" --drawing "$work/slip.svg" -q || [ $? -eq 1 ]
sed 's/; the fit does without[^<]*//' "$work/slip.svg" >docs/pictures/first-stone/typing-error.svg
"$culet" fit $evening/mended.toml -o "$work/mended.obj" --drawing docs/pictures/first-stone/uncertainty.svg \
    --paint sigma -q
drawing docs/pictures/first-stone/typing-error.svg 720
drawing docs/pictures/first-stone/uncertainty.svg 720
"$culet" run $evening/job.toml -o "$work/evening" -q >/dev/null
page "$work/evening/report.html" docs/pictures/first-stone/report.png 1040

# Photograph against render: the pose, the comparison.
cp "$work/fitted.obj" "$work/stone.obj"
sed 's/"hand.obj"/"stone.obj"/' $dravite/stone.toml >"$work/fitted.toml"
sed 's/"stone.toml"/"fitted.toml"/' $dravite/scene.toml >"$work/scene.toml"
"$culet" register $dravite/simulated-photo.png "$work/scene.toml" -o "$work/posed.toml" \
    --overlay "$work/overlay.png" -q
convert "$work/overlay.png" -gravity center -crop 700x560+0+0 +repage -resize 560x -quality 82 \
    docs/pictures/photograph/overlay.jpg
"$culet" compare $dravite/simulated-photo.png "$work/scene.toml" -o "$work/comparison" --simulated -q
page "$work/comparison/report.html" docs/pictures/photograph/report.png 1150

# The first stone in the studio.
python3 docs/pictures/studio.py "$culet" "$work/studio"
for picture in "$work"/studio/*.png; do
    convert "$picture" -resize 900x +dither -colors 200 "docs/pictures/studio/$(basename "$picture")"
done
