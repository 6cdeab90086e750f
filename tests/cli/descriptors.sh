#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Few file descriptors: a run is whole, the same as ever, or it fails and leaves nothing. Fonts that cannot be opened are a failure.
source "$(dirname "$0")/../shell.bash"
cat >"$T/scene.yaml" <<'YAML'
chain:
  striker: {velocity: 0.443 m/s}
  beads:
    - {cell: [large-steel, aluminium], count: 3, spins: random, magnetism: 0.3, seed: 7}
    - {bead: small-steel, sensor: first}
simulate: {until: 100 us}
outputs:
  - {trajectory: run.h5, every: 5 us, fields: all}
  - {image: force.png, size: [320, 200]}
  - {plot: sensors.pdf, show: sensors}
  - {movie: beads.mp4, duration: 0.2 s, size: [160, 120], fps: 10, captions: [{at: 0, text: "*F*_{max}"}]}
  - {table: peaks.csv}
YAML
all() { "$beadreel" "$T/scene.yaml" --canvas plain --threads 1 -o "$1" >"$T/out" 2>"$T/err"; }
all "$T/whole"
# The search for leaks at the end of a program wants descriptors of its own, and may crash without: test_allocations looks for leaks.
few_asan=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0
whole_or_nothing() { # DESCRIPTORS [--only NAME]
    rm -rf "$T/few"
    (ulimit -n "$1"; ASAN_OPTIONS=$few_asan "$beadreel" "$T/scene.yaml" --canvas plain --threads 1 -o "$T/few" "${@:2}" >"$T/out" 2>"$T/err")
    status=$?
    if [ $status -eq 0 ]; then
        for f in "$T"/few/*; do cmp "$f" "$T/whole/$(basename "$f")" || return 1; done
    else
        [ "$status" -eq 1 ] && [ "$(grep -cv '^Fontconfig' "$T/err")" -eq 1 ] && empty "$T/few" || { cat "$T/err"; return 1; }
    fi
}
for n in 5 6 7 8 9 10 12 14 16 18 20; do ok "$n descriptors" whole_or_nothing $n; done
for n in 5 6 7 8 9; do ok "$n descriptors for one plot" whole_or_nothing $n --only sensors.pdf; done
cp "$T/whole/run.h5" "$T/run.h5"
"$beadreel" --info "$T/run.h5" >"$T/described"
described() { # DESCRIPTORS : whole, or it says that they are too few
    run bash -c 'ulimit -n "$1" && exec "${@:2}"' - "$1" "$beadreel" --info "$T/run.h5"
    if [ $status -eq 0 ]; then cmp "$T/out" "$T/described"; else [ $status -eq 1 ] && says "Too many open files" && ! says install >/dev/null; fi
}
for n in 4 5 6 7 8; do ok "$n descriptors for a description" described $n; done
no_fonts() {
    echo '<?xml version="1.0"?><fontconfig></fontconfig>' >"$T/fonts.conf"
    rm -rf "$T/few"
    FONTCONFIG_FILE=$T/fonts.conf "$beadreel" "$T/scene.yaml" --only sensors.pdf -o "$T/few" >"$T/out" 2>"$T/err"
    status=$?
    [ $status -eq 1 ] && says "finds no font" && ! [ -e "$T/few/sensors.pdf" ] || { echo "status $status"; cat "$T/err"; return 1; }
}
ok "no fonts at all" no_fonts
finish
