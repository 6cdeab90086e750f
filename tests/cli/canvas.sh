#!/bin/bash
# Back ends of the canvas: plain needs no library, the others Mesa's; the same files from both of those.
source "$(dirname "$0")/../shell.bash"
cat >"$T/scene.yaml" <<'YAML'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 8}]
  wall: brass
simulate: {until: 0.2 ms}
outputs:
  - {image: beads.png, views: [beads, profile], at: 0.12 ms, size: [640, 360]}
  - {movie: beads.mp4, quality: lossless, size: [320, 180], fps: 25, duration: 0.4 s}
YAML
draw() { mkdir -p "$T/$1" && "$BUILD/beadreel" "$T/scene.yaml" -o "$T/$1" "${@:2}" >"$T/$1.out" 2>"$T/$1.err"; }
same() { cmp "$T/$1/beads.png" "$T/$2/beads.png" && cmp "$T/$1/beads.mp4" "$T/$2/beads.mp4"; }
# As where they are not installed: what is found in their place is none of them.
mkdir "$T/lib" && echo 'int nothing;' | cc -shared -fPIC -x c - -o "$T/lib/libOSMesa.so.8" && cp "$T/lib/libOSMesa.so.8" "$T/lib/libEGL.so.1"
without() { LD_LIBRARY_PATH=$T/lib draw "$@"; }
there() { "$BUILD/beadreel" "$T/scene.yaml" -o "$T/there" --only beads.png --canvas "$1" >/dev/null 2>&1; }
declare -A package=([osmesa]="OSMesa (libosmesa6)" [egl]="EGL (libegl1, libegl-mesa0, libgl1-mesa-dri)")

ok "draws" draw default
ok "draws with --canvas plain" draw plain --canvas plain
ok "which is the default" same default plain
ok "draws where Mesa is missing" without missing
ok "the same files" same default missing
for canvas in osmesa egl; do
    if there $canvas; then
        ok "draws with --canvas $canvas" draw $canvas --canvas $canvas
    else
        skip "${package[$canvas]}" "draws with --canvas $canvas"
    fi
    ok "but not where it is missing" fails 1 env LD_LIBRARY_PATH="$T/lib" "$BUILD/beadreel" "$T/scene.yaml" -o "$T" --canvas $canvas
done
if there osmesa && there egl; then ok "the same files from both" same osmesa egl; else skip "OSMesa or EGL" "the same files from both"; fi
ok "an unknown canvas is refused" fails 2 "$BUILD/beadreel" "$T/scene.yaml" --canvas etching
ok "beadsim draws nothing" fails 2 "$BUILD/beadsim" "$T/scene.yaml" --canvas egl
finish
