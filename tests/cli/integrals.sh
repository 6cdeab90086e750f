#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What equations keep has a value in closed form at the start, and that value later; one bead may be written as a range.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {d = a - b; exit !(a != "" && (d < 0 ? -d : d) <= t)}' || { echo "$1 is not $2 to $3"; return 1; }; }
measure() { awk -F, -v name="$1" '$1 == name {print $2}' m.csv; }
number() { awk "BEGIN {pi = atan2(0, -1); printf \"%.15g\", $1}"; }

# u = cos(pi x) on a ring of length 2: integrals of u, u^2, and of drift u^2 / 2 + nonlinearity u^3 / 6 - dispersion u_x^2 / 2.
cat >kdv.yaml <<'YAML'
chain: {equation: kdv, length: 2, points: 64, nonlinearity: 1, dispersion: 4.84e-4, drift: 0.7, start: {cosine: 1, amplitude: 1}}
simulate: {until: 0.1, accuracy: 1e-9}
outputs: [{table: m.csv, show: measures}]
YAML
ok "kdv" exits 0 "$beadsim" kdv.yaml -o .
ok "... mass" near "$(measure mass)" 0 1e-15
ok "... momentum" near "$(measure momentum)" 1 1e-8
ok "... hamiltonian" near "$(measure hamiltonian)" "$(number '2 * (0.7 / 4 - 4.84e-4 * pi * pi / 4)')" 1e-8

cat >beads.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 9}], wall: brass}
simulate: {until: 0.1 ms}
outputs:
  - {trajectory: one.h5, every: 5 us, beads: 5}
  - {trajectory: range.h5, every: 5 us, beads: [5, 5]}
YAML
ok "a bead, and a range of one" exits 0 "$beadsim" beads.yaml -o .
ok "... are the same" h5diff one.h5 range.h5 /particles /particles
ok "... but not backwards" fails 2 "$beadsim" beads.yaml -o back --set outputs.1.beads='[5, 4]'
finish
