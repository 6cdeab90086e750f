#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How many beads and curves there can be: stated limits are checked before memory is taken, and plans build no beads.
source "$(dirname "$0")/../shell.bash"
scene() { # BEADS [OUTPUTS]
    echo "chain: {beads: [{$1}]}
simulate: {until: 1 ms}
outputs: [{table: peaks.csv, show: peaks}${2:-}]"
}
scene 'bead: large-steel, count: 100000000' >"$T/longest.yaml"
scene 'bead: large-steel, count: 50000000}, {bead: large-steel, count: 50000001' >"$T/longer.yaml"
scene 'cell: [large-steel, aluminium], count: 2000000, spins: random, seed: 7' >"$T/random.yaml"
scene 'bead: large-steel, count: 100000000' ', {table: measures.csv, show: measures}, {trajectory: run.h5, every: 1 us},
    {movie: film.mp4}, {image: image.png}, {image: bare.png, axes: false}, {plot: peaks.pdf, show: peaks}' >"$T/drawn.yaml"
limited() { # KILOBYTES COMMAND...
    (ulimit -v "$1" && shift && exec "$@") >"$T/out" 2>"$T/err"
    status=$?
}
ok "more than 1e8 beads behind the striker" fails 2 "$beadsim" --plan "$T/longer.yaml"
ok "... the message has the limit" says "longer than 100000000 beads, the most that is allowed"
overlay() { # CHAINS
    local i
    echo "chains:"
    for i in $(seq "$1"); do echo "  - {name: c$i, beads: [{bead: large-steel, count: 5}]}"; done
    echo "simulate: {until: 50 us}
outputs: [{movie: a.gif, layout: overlay, views: [profile], size: [320, 240], fps: 5, duration: 1 s}]"
}
overlay 16 >"$T/full.yaml"
overlay 17 >"$T/fuller.yaml"
ok "an overlay of 16 chains" exits 0 "$beadreel" "$T/full.yaml" -o "$T/o"
ok "... of no more" fails "1 2" "$beadreel" "$T/fuller.yaml" -o "$T/o"
ok "... as the message says" says "an overlay shows at most 16 chains"
limited 100000 "$beadsim" --list methods
if [ $status -ne 0 ]; then
    skip "limits of memory (sanitizers need all there is)" "plans within limits of memory"
else
    limited 100000 "$beadsim" --plan "$T/longest.yaml"
    ok "1e8 beads are planned in 100 MB" prints "chain 100000001 beads, 100000000 contacts; rkn8"
    ok "... with the memory that a run needs" grep -qE '^memory: 6.4 GB at least, for the beads; only 0.0[0-9]* GB are free: a run would be refused$' "$T/out"
    limited 100000 "$beadsim" --plan "$T/random.yaml"
    ok "4e6 of random cells, too: a byte a cell" prints "chain 4000001 beads, 4000000 contacts, M = 0;"
    for options in "" --json; do
        # shellcheck disable=SC2086
        limited 100000 "$beadsim" --info "$T/longest.yaml" $options
        ok "... and described${options:+ as JSON}" test $status -eq 0
        limited "$([ -z "$options" ] && echo 100000 || echo 200000)" "$beadsim" --info "$T/random.yaml" $options
        ok "4e6 of random cells are described${options:+ as JSON}" test $status -eq 0
        [ -n "$options" ] || ok "... with the beads of each material" prints "  2000000 beads of aluminium: radius 4.76 mm, mass 1.26 g, modulus 72.4 GPa"
    done
    limited 1000000 "$beadsim" "$T/longest.yaml" -o "$T/run"
    ok "a run of 1e8 is refused in 1 GB: status 1" test $status -eq 1
    ok "... one line" test "$(wc -l <"$T/err")" -eq 1
    ok "... what, where, how much" grep -qE 'longest.yaml:1:8: chain: 100000001 beads need 6.4 GB of memory; [01]\.?[0-9]* GB are free$' "$T/err"
    ok "... nothing is made" test ! -e "$T/run"
    if [ -x /usr/bin/time ] && [ -n "$beadreel" ]; then
        cheap() { /usr/bin/time -f %M -o "$T/kilobytes" "$beadreel" --plan "$T/drawn.yaml" && [ "$(tail -1 "$T/kilobytes")" -lt 200000 ]; }
        ok "1e8 beads in every kind of output are planned in 200 MB" cheap
    fi
fi
# ---- room on the disk ----
scene 'bead: large-steel, count: 100000' ', {trajectory: run.h5, every: 1 ps}' >"$T/disk.yaml"
ok "a trajectory of 8.8 PB is planned" exits 0 "$beadsim" --plan "$T/disk.yaml" -o "$T"
ok "... with its size and what is free" grep -qE ', 8.8e\+06 GB; only [0-9.e+]+ GB are free: a run would be refused$' "$T/out"
ok "... and refused before it begins" fails 1 "$beadsim" "$T/disk.yaml" -o "$T/room"
ok "... in words" says "run.h5: needs 8.8e+06 GB for its samples; "
ok "... nothing is left" empty "$T/room"
# 10001 samples of 100 beads in 11 columns; the rest of the file, and its last chunk, are a few per cent of that.
scene 'bead: large-steel, count: 99' ', {trajectory: run.h5, every: 100 ns}' >"$T/size.yaml"
as_large() { "$beadsim" "$T/size.yaml" -o "$T" && awk -v is="$(stat -c %s "$T/run.h5")" 'BEGIN { exit !(is >= 8 * 11 * 100 * 10001 && is < 1.04 * 8 * 11 * 100 * 10001) }'; }
ok "samples are as large as that says" as_large
# Of many equal cells a plan looks at some only: it says of them what it says of cells whose spins are given one by one.
cells() { # SPINS
    echo "chain: {precompression: 2 N, beads: [{bead: brass, count: 3}, {cell: [large-steel, aluminium, ptfe], count: 24, spins: $1}, {bead: brass}]}
outputs: [{table: peaks.csv, show: peaks}]" >"$T/cells.yaml"
    "$beadsim" --plan "$T/cells.yaml"
}
for spins in up:1 down:0; do
    digits=$(printf "${spins#*:}%.0s" {1..24})
    ok "cells that are all ${spins%:*}" test "$(cells "${spins%:*}")" = "$(cells "\"$digits\"")"
done
finish
