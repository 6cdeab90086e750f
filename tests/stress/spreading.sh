#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How energy spreads in chains of 8000 beads, at full size: three disorders, eight chains each, and order, with their exponents beside
# those of an independent program (velocity Verlet with steps of .05, other random numbers, 8 to 12 chains), all struck at a bead of
# radius 1; in order a solitary wave runs on, as wide as before.   spreading.sh BUILD     status 1 if a row FAILED
build=$1
status=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# row NAME GAMMA ERROR ETA ERROR OPTION...: the difference must be within three standard errors of both, or .01.
row() {
    local name=$1 expected=("${@:2:4}")
    shift 5
    if ! timeout 600 "$build/beadsim" martinez2016 -q -o "$work" --set 'outputs=[{table: s.csv, show: spreading}]' "$@" >"$work/log" 2>&1; then
        tail -n 1 "$work/log"
        return 1
    fi
    tail -n 1 "$work/s.csv" | awk -F, -v name="$name" -v e="${expected[*]}" '
        function off(is, error, should, known, bound) {
            bound = 3 * sqrt(error ^ 2 + known ^ 2)
            return (is > should ? is - should : should - is) > (bound > .01 ? bound : .01)
        }
        {split(e, x, " "); bad = off($10, $11, x[1], x[2]) || off($12, $13, x[3], x[4])
         printf "  %-28s gamma %.3f +- %.3f, expected %.3f +- %.3f; eta %.3f +- %.3f, expected %.3f +- %.3f  %s\n", name, $10, $11, x[1], x[2],
             $12, $13, x[3], x[4], bad ? "FAILED" : "ok"; exit bad}'
}
echo "Exponents of spreading, from 7 % of the time on:"
row 'each bead by itself' 1.765 .007 .982 .008 || status=1
row 'dimers AA or BB' 1.776 .006 .965 .006 --set chain.beads.0.disorder.alike=2 --set chain.beads.1.count=2 \
    --set chain.beads.2.disorder.alike=2 || status=1
row 'dimers AB or BA' 1.756 .009 .996 .007 --set chain.start.0.bead=3999 --set 'chain.beads=[{cell: [one, small], count: 1999,
    spins: random}, {bead: one}, {bead: small}, {cell: [one, small], count: 2000, spins: random}]' \
    --set 'sweep.over={chain.beads.0.seed: 1..8, chain.beads.3.seed: 101..108}' || status=1
row 'order' 2 .001 0 .01 --set 'chain.beads=[{bead: one, count: 8000}]' --set chain.start.0.bead=4000 \
    --set 'sweep.over={chain.start.0.velocity: [1 m/s]}' || status=1
exit $status
