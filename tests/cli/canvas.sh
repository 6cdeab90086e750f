#!/bin/bash
# Back ends of the canvas: the same pixels from both, and EGL where OSMesa is missing.
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
without_osmesa() {
    mkdir "$T/lib" && echo 'int nothing;' | cc -shared -fPIC -x c - -o "$T/lib/libOSMesa.so.8" &&
        LD_LIBRARY_PATH=$T/lib draw missing
}

ok "draws with OSMesa" draw osmesa --canvas osmesa
ok "draws with EGL" draw egl --canvas egl
ok "the same files from both" same osmesa egl
ok "draws where OSMesa is missing" without_osmesa
ok "the same files from there" same osmesa missing
ok "but not with --canvas osmesa" fails 1 env LD_LIBRARY_PATH="$T/lib" "$BUILD/beadreel" "$T/scene.yaml" -o "$T" --canvas osmesa
ok "an unknown canvas is refused" fails 2 "$BUILD/beadreel" "$T/scene.yaml" --canvas etching
ok "beadsim draws nothing" fails 2 "$BUILD/beadsim" "$T/scene.yaml" --canvas egl
finish
