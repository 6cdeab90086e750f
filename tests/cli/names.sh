#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures have names for people: labels of materials, words instead of identifiers; tables keep the names of the scene.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >scene.yaml <<'YAML'
materials:
  big-steel: {label: "steel, 4.76 mm", mass: 3.63 g, radius: 4.76 mm, modulus: 193 GPa, poisson: 0.30}
  dark_glass: {mass: 1 g, radius: 3 mm, modulus: 70 GPa, poisson: 0.22}
simulate: {until: 0.3 ms}
chains:
  - name: half-reversed_1
    striker: {bead: big-steel, velocity: 0.443 m/s}
    beads: [{cell: [big-steel, tungsten-carbide], count: 6}, {bead: dark_glass, sensor: A}]
    wall: big-steel
  - name: All Glass-like
    striker: {bead: small-steel, velocity: 0.443 m/s}
    beads: [{cell: [dark_glass, ptfe], count: 6}, {bead: ptfe, sensor: A}]
    wall: tungsten-carbide
outputs:
  - {plot: setup.pdf, show: setup}
  - {plot: cell.pdf, show: cell}
  - {plot: contact.pdf, show: contact, contact: 13}
  - {plot: sensors.pdf, show: sensors}
  - {plot: peaks.pdf, show: peaks}
  - {image: image.pdf, views: [beads, profile, spacetime], size: [1280, 720]}
  - {image: trust.pdf, trust: true}
  - {plot: panels.pdf, panels: [[{show: sensors, chain: half-reversed_1}], [{show: sensors, chain: All Glass-like}], [{show: peaks}]]}
  - {table: peaks.csv}
YAML
cat >sweep.yaml <<'YAML'
sweeps:
  - {name: long-sweep, cells: 6, configurations: 2}
  - {name: short_sweep, cells: 4, configurations: 2}
outputs:
  - {sheet: sheet.pdf, size: [900, 700]}
  - {plot: plot.pdf}
YAML
ok "pictures" exits 0 "$beadreel" scene.yaml -o made
ok "pictures of sweeps" exits 0 "$beadreel" sweep.yaml -o made
cat made/peaks.csv >table
ok "tables keep names" grep -q '^half-reversed_1,' table
if command -v pdftotext >/dev/null; then
    identifiers() { pdftotext "$1" - | grep -E 'big-steel|dark_glass|small-steel|tungsten-carbide|half-reversed|half_|long-sweep|short_sweep|\bptfe\b'; }
    has() { pdftotext "$1" - | tr '\n' ' ' | grep -qF -- "$2"; }
    none() { test -s "$1" && ! identifiers "$1"; }
    for f in setup cell contact sensors peaks image trust sheet plot; do
        ok "$f: no identifiers" none "made/$f.pdf"
    done
    ok "labels, the radius once" has made/setup.pdf "steel, 4.76 mm, 3.63 g"
    ok "words where there is no label" has made/setup.pdf "dark glass, R = 3.00 mm, 1.00 g"
    ok "labels of ready materials" has made/setup.pdf "PTFE, R"
    ok "walls have no radius" has made/setup.pdf "steel wall"
    ok "cells" has made/cell.pdf "1 : 1 steel, 4.76 mm : tungsten carbide dimer cell"
    ok "contacts" has made/contact.pdf "steel wall"
    ok "chains" has made/peaks.pdf "half reversed 1"
    ok "names that are no identifiers stay" has made/peaks.pdf "All Glass-like"
    ok "sweeps" has made/plot.pdf "long sweep"
    legends() { pdftotext "$1" - | grep -c "^$2\$"; }
    ok "panels that share a legend have one" [ "$(legends made/panels.pdf A)" -eq 1 ]
    ok "... others their own" has made/panels.pdf "half reversed 1, M"
    ok "marks have a key" has made/plot.pdf "each configuration"
else
    skip "pdftotext (poppler-utils)" "names in pictures"
fi

# The largest value, where the colours leave it out, is written as people write numbers: not 1.1e+02.
peak() {
    printf '%s\n' 'chain: {beads: [{bead: large-steel, count: 40}], wall: rigid}' 'outputs: [{image: peak.svg}]' >"$T/peak.yaml" &&
        exits 0 "$beadreel" "$T/peak.yaml" -o "$T/made" && grep -qF 'peak 110 (N)' "$T/made/peak.svg"
}
ok "peaks of a hundred newtons" peak
finish
