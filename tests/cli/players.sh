#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Programs of other people show what was made: a browser plays movies and opens drawings, poppler reads PDF; where installed.
source "$(dirname "$0")/../shell.bash"
cat >"$T/scene.yaml" <<'YAML'
title: Shown by others
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 16, spins: random, seed: 5}, {bead: small-steel, sensor: first}]
  wall: brass
outputs:
  - {movie: film.mp4, size: [320, 180], duration: 1 s, fps: 20, poster: poster.png, captions: [{at: 0.1 ms, text: The front}]}
  - {movie: [clear.webm, clear.apng], background: none, size: [320, 180], duration: 1 s, fps: 20, captions: [{at: 0.1 ms, text: The front}]}
  - {movie: [film.webm, film.gif, film.apng], size: [320, 180], duration: 1 s, fps: 20}
  - {image: still.svg, views: [beads, spacetime], at: 0.2 ms}
  - {image: [raster.pdf, raster.png], style: paper, dpi: 300, caption: "Forces of beads, *F*_m"}
  - {plot: [peaks.pdf, peaks.svg], show: peaks, style: paper}
  - {image: [clear.pdf, clear.svg], style: paper, background: none}
  - {plot: [setup.pdf, setup.svg], show: setup, style: paper}
YAML
cd "$T" || exit 1
ok "files for others" exits 0 "$beadreel" scene.yaml -o .

python=/usr/bin/python3
if "$python" -c 1 2>/dev/null && find_browser; then
    run timeout 240 "$python" "$top/tests/browser.py" "$browser" "$T" film.mp4 film.webm clear.webm film.gif film.apng clear.apng still.svg clear.svg peaks.svg setup.svg
    relay
else
    skip "a Chromium that runs here (chromium, python3)" "a browser plays movies and opens drawings"
fi

# Cairo 1.18 draws the page's rectangle beyond its edges.
ok "with background: none an SVG has no page" bash -c '! grep "<rect" clear.svg &&
    grep -qE "<rect x=.(0|-[0-9.]+). y=.(0|-[0-9.]+). .*rgb\(100%, ?100%, ?100%\)" still.svg'
embedded() { pdffonts "$1" | tail -n +3 >fonts && [ -s fonts ] && ! awk '{print $(NF - 4)}' fonts | grep -qv yes || { cat fonts; return 1; }; }
reads() { pdftotext "$1" text && grep -qF -- "$2" text || { cat text; return 1; }; }
# All pixels of the picture in a PDF file stand in the PNG file, where the plot is.
same_raster() {
    pdfimages -png raster.pdf raster || return 1
    [ "$(echo raster-*.png)" = raster-000.png ] || { ls raster-*; return 1; }
    for i in raster raster-000; do
        ffmpeg -v error -y -i $i.png -f rawvideo -pix_fmt rgb24 $i.rgb && ffprobe -v error -show_entries stream=width,height -of csv=p=0 $i.png >$i.size || return 1
    done
    "$python" - <<'PYTHON'
def load(name):
    width, height = map(int, open(name + ".size").read().split(",")[:2])
    data = open(name + ".rgb", "rb").read()
    return [data[3 * width * y:3 * width * (y + 1)] for y in range(height)]
page, image = load("raster"), load("raster-000")
assert len(image) > 200 and len(set(image)) > 10, "the raster shows nothing"
found = False
for top in range(len(page) - len(image) + 1):
    at = page[top].find(image[0])
    while at >= 0 and not found:
        found = at % 3 == 0 and all(page[top + y][at:at + len(row)] == row for y, row in enumerate(image))
        at = page[top].find(image[0], at + 1)
assert found, "the pixels are not those of the PNG file"
PYTHON
}
if command -v pdffonts >/dev/null && command -v pdftotext >/dev/null && command -v pdfimages >/dev/null; then
    for f in raster peaks setup; do
        ok "fonts of $f.pdf are embedded" embedded $f.pdf
    done
    ok "text of an image" reads raster.pdf "time (µs)"
    ok "... its caption" reads raster.pdf "Forces of beads"
    ok "text of a plot" reads peaks.pdf "peak force (N)"
    ok "text of a drawing" reads setup.pdf "first"
    corner() { pdftocairo -png -transp -singlefile -r 60 "$1" page && ffmpeg -v error -i page.png -vf 'format=rgba,alphaextract,crop=1:1:1:1' -f rawvideo - | od -An -tu1 | tr -d ' '; }
    if command -v ffmpeg >/dev/null && command -v pdftocairo >/dev/null; then
        ok "with background: none a PDF is transparent" [ "$(corner clear.pdf)" = 0 ]
        ok "... and without it is not" [ "$(corner raster.pdf)" = 255 ]
    else
        skip "ffmpeg or pdftocairo" "with background: none a PDF is transparent"
    fi
    if command -v ffmpeg >/dev/null && "$python" -c 1 2>/dev/null; then
        ok "the raster in a PDF has the pixels of the PNG" same_raster
    else
        skip "ffmpeg or python3" "the raster in a PDF has the pixels of the PNG"
    fi
else
    skip "pdffonts, pdftotext, pdfimages (poppler-utils)" "fonts, text and rasters of PDF files"
fi
finish
