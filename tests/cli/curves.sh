#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Plots say what tables say: ticks, labels and curves, read back from SVG.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >s.yaml <<'YAML'
materials: {unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}}
chain: {striker: {bead: unit, velocity: 1 mm/s}, beads: [{bead: unit, count: 12}]}
simulate: {until: 30 ms}
outputs:
  - {plot: plain.svg, show: sensors, contacts: 0, time: [0, 5 ms]}
  - {plot: part.svg, show: sensors, contacts: 0, normalise: max, time: [0, 5 ms]}
  - {plot: far.svg, show: sensors, contacts: 7, time: [12 ms, 30 ms]}
  - {table: near.csv, show: sensors, contacts: 0, every: 4 us}
  - {table: far.csv, show: sensors, contacts: 7, every: 4 us}
YAML
curve() { python3 "$top/tests/curves.py" "$@"; }
differ() { curve "$@"; [ $? -eq 3 ]; }
ok "plots and their tables" exits 0 "$beadreel" s.yaml -o .
peak=$(tail -n +2 near.csv | cut -d, -f2 | sort -g | tail -n 1)
ok "the curve of a contact is the table's" curve plain.svg near.csv 1e-3 1e-3
ok "... normalised, of less than 1 N" curve part.svg near.csv 1e-3 "$peak"
ok "... of another, from some time on" curve far.svg far.csv 1e-3 1e-3
ok "a table that is larger is noticed" differ plain.svg near.csv 1e-3 1.01e-3
ok "... or later" differ plain.svg near.csv 1.01e-3 1e-3
finish
