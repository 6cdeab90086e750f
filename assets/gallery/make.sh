#!/bin/bash
# The README's pictures from ready scenes: make.sh BEADREEL DIRECTORY. Small, since they are kept with the sources.
set -eu
beadreel=$1 to=$2
T=$(mktemp -d)
trap 'rm -rf "$T"' EXIT
# picture NAME SCENE OUTPUT [OPTION...] : OUTPUT is an entry of `outputs` without its file.
picture() {
    local name=$1 scene=$2 output=$3
    shift 3
    "$beadreel" "$scene" "$@" --set "outputs=[{${output/FILE/$name.png}}]" --progress none -o "$to"
}

picture waves clean-vs-delocalised 'image: FILE, style: movie, size: [800, 450], views: [beads, profile, spacetime], at: 0.8 ms, scale: sqrt'
picture horizon clean-vs-delocalised 'image: FILE, size: [680, 380], trust: true, scale: sqrt' --set simulate.until='8 ms'
"$beadreel" panels --progress none -o "$to" --set outputs.0.image=panels.png --set outputs.0.dpi=110
"$beadreel" teaching --only teaching.mp4 --progress none -o "$T" --set 'outputs.0.size=[800, 450]' --set outputs.0.fps=4 --set outputs.0.poster-at='0.8 ms'
mv "$T/teaching.png" "$to"
"$beadreel" clean-vs-delocalised --progress none -o "$to" --set simulate.until='1.9 ms' --set \
    'outputs=[{movie: loop.gif, views: [beads, profile], size: [440, 300], fps: 12, duration: 3 s}]'
picture force sweep 'plot: FILE, size: [720, 450]'
picture sheet sweep 'sheet: FILE, size: [720, 450], theme: dark, configurations: 6, magnetism: [1, 0.97, 0.9, 0.5]'
picture setup schematics 'plot: FILE, show: setup, size: [800, 300]'
picture contact schematics 'plot: FILE, show: contact, size: [640, 400]'
picture kdv kdv 'image: FILE, size: [640, 400]'
picture fput fput 'plot: FILE, show: modes, modes: 4, size: [640, 400]'
picture shock shock 'plot: FILE, show: profiles, at: [0, 2, 3.86, 6, 8], size: [640, 400]'
