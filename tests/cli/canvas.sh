#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Back ends of the canvas: OSMesa, else EGL, else plain, which needs no library; result lines say who painted and encoded.
source "$(dirname "$0")/../shell.bash"
cat >"$T/scene.yaml" <<'YAML'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 8}]
  wall: brass
simulate: {until: 0.2 ms}
outputs:
  - {image: beads.png, views: [beads, profile], at: 0.12 ms, size: [640, 360]}
  - {image: clear.png, views: [beads, profile], at: 0.12 ms, size: [640, 360], background: none}
  - {movie: beads.mp4, quality: lossless, size: [320, 180], fps: 25, duration: 0.4 s}
YAML
draw() { mkdir -p "$T/$1" && "$BUILD/beadreel" "$T/scene.yaml" -o "$T/$1" "${@:2}" >"$T/$1.out" 2>"$T/$1.err"; }
same() { cmp "$T/$1/beads.png" "$T/$2/beads.png" && cmp "$T/$1/beads.mp4" "$T/$2/beads.mp4"; }
# As where they are not installed: what is found in their place is none of them.
mkdir "$T/none" "$T/no-osmesa" && echo 'int nothing;' | cc -shared -fPIC -x c - -o "$T/none/libOSMesa.so.8"
cp "$T/none/libOSMesa.so.8" "$T/none/libEGL.so.1" && cp "$T/none/libOSMesa.so.8" "$T/no-osmesa"
without() { LD_LIBRARY_PATH=$T/$1 draw "${@:2}"; }
there() { "$BUILD/beadreel" "$T/scene.yaml" -o "$T/there" --only beads.png --canvas "$1" >/dev/null 2>&1; }
declare -A package=([osmesa]="OSMesa (libosmesa6)" [egl]="EGL (libegl1, libegl-mesa0, libgl1-mesa-dri)")
# painted NAME WORDS: the movie's line and the picture's say so.
painted() {
    grep -q "beads.mp4 .* painted by $2, encoded by libavcodec (libx264rgb)\$" "$T/$1.out" && grep -q "beads.png .* painted by $2\$" "$T/$1.out"
}

ok "draws" draw default
ok "draws with --canvas plain" draw plain --canvas plain
ok "... and says so" painted plain 'the plain canvas ([a-z0-9]*)'
# Colours and alpha differ by a level here and there.
alike() { ffmpeg -v info -i "$T/$1/clear.png" -i "$T/$2/clear.png" -lavfi "[0]format=rgba[a];[1]format=rgba[b];[a][b]psnr" -f null - 2>&1 | awk '/average:/ {sub(/.*average:/, ""); found = 1; good = $1 == "inf" || $1 > 55; print} END {exit !(found && good)}'; }
if command -v ffmpeg >/dev/null; then ok "transparent pictures are alike" alike default plain; else skip ffmpeg "transparent pictures are alike"; fi
ok "draws where Mesa is missing" without none missing
ok "... with the plain canvas" painted missing 'the plain canvas ([a-z0-9]*)'
ok "... the same files" same plain missing
ok "draws where OSMesa is missing" without no-osmesa fallback
if there osmesa; then
    ok "OSMesa is the default" painted default 'OSMesa (llvmpipe)'
else
    skip "${package[osmesa]}" "OSMesa is the default"
fi
if there egl; then
    ok "EGL is next" painted fallback 'EGL (llvmpipe)'
else
    skip "${package[egl]}" "EGL is next"
fi
for canvas in osmesa egl; do
    if there $canvas; then
        ok "draws with --canvas $canvas" draw $canvas --canvas $canvas
    else
        skip "${package[$canvas]}" "draws with --canvas $canvas"
    fi
    ok "but not where it is missing" fails 1 env LD_LIBRARY_PATH="$T/none" "$BUILD/beadreel" "$T/scene.yaml" -o "$T" --canvas $canvas
done
if there osmesa && there egl; then ok "the same files from both" same osmesa egl; else skip "OSMesa or EGL" "the same files from both"; fi
if there osmesa; then ok "the same files by default" same default osmesa; else skip "${package[osmesa]}" "the same files by default"; fi
for n in 1 2 3; do
    ok "draws with $n threads" draw "threads$n" --threads $n --set outputs.2.quality=standard
    ok "... the same files" same threads1 "threads$n"
done
opened() { LD_DEBUG=files "$BUILD/beadreel" "$T/scene.yaml" -o "$T/opened" --only beads.png "$@" 2>&1 >/dev/null | grep -c 'calling init.*\(OSMesa\|EGL\)'; }
ok "a still without beads opens no canvas" test "$(opened --set outputs.0.views='[profile]')" = 0
if there osmesa; then ok "... one with beads does" test "$(opened)" -gt 0; else skip "${package[osmesa]}" "... one with beads does"; fi
ok "an unknown canvas is refused" fails 2 "$BUILD/beadreel" "$T/scene.yaml" --canvas etching
ok "beadsim draws nothing" fails 2 "$BUILD/beadsim" "$T/scene.yaml" --canvas egl
ok "no contact sheet either" fails 2 "$BUILD/beadsim" "$T/scene.yaml" --sheet -o "$T/sheet.png"
ok "and its help offers neither" eval '! "$BUILD/beadsim" --help | grep -e --canvas -e --sheet'

# Encoders are opened as canvases are; Debian names packages of libraries after these.
library=$("$BUILD/beadreel" --list libraries | grep -o '^libavformat[^ ]*')
mkdir "$T/no-movies" && cp "$T/none/libOSMesa.so.8" "$T/no-movies/$library"
no_movie() {
    fails 1 env LD_LIBRARY_PATH="$T/no-movies" "$BUILD/beadreel" "$T/scene.yaml" -o "$T/films" --only beads.mp4 &&
        says "movies need FFmpeg's libraries: " && says "$library" && says "(install ${library/.so./})" && empty "$T/films"
}
ok "a movie says which library it lacks, and what to install" no_movie
ok "pictures need none" env LD_LIBRARY_PATH="$T/no-movies" "$BUILD/beadreel" "$T/scene.yaml" -o "$T/stills" --only beads.png
finish
