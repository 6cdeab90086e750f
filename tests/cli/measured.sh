#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Measured curves beside computed ones, and fits to them: files, units, what a run keeps, and what is wrong.
source "$(dirname "$0")/../shell.bash"
mkdir -p "$T/in" && cd "$T" || exit 1
# Beads struck at 0.4 m/s, in volts and microseconds, by a trigger that is 7 us early.
cat >truth.yaml <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 12}]}
simulate: {until: 0.3 ms}
outputs: [{table: truth.csv, show: sensors, beads: 8, every: 1.3 us}]
YAML
cat >in/s.yaml <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 12}]}
simulate: {until: 0.3 ms}
outputs:
  - {plot: p.svg, beads: 8, measured: {file: scope.csv, columns: [us, volts], time: 1 us, gain: 25 N, start: 0 us}}
  - {table: fit.csv, show: fit}
  - {trajectory: run.h5, every: 1 us, fields: [force]}
fit: [chain.striker.velocity, outputs.0.measured.start]
YAML
ok "an experiment" exits 0 "$beadsim" truth.yaml
awk -F, 'NR == 1 {print "us,ignored,volts"; next} {printf "%.17g,x,%.17g\n", 1e6 * $1 + 7, $2 / 25}' truth.csv >in/scope.csv
ok "a fit of it, and a plot" exits 0 "$beadreel" in/s.yaml -o a
found() { # KEY VALUE TOLERANCE
    awk -F, -v key="$1" -v value="$2" -v tolerance="$3" '$1 == key {n++; d = $3 - value} END {exit !(n == 1 && d < tolerance && -d < tolerance)}' a/fit.csv
}
ok "the velocity is found" found chain.striker.velocity 0.4 1e-5
ok "... and the trigger" found outputs.0.measured.start -7e-6 1e-9
ok "a plan finds it, too" exits 0 "$beadsim" --plan in/s.yaml
ok "... and says so" prints 'fit: chain.striker.velocity = 0.4 +-'
rm in/scope.csv
ok "a run keeps what was measured, without the file" exits 0 "$beadreel" a/run.h5 -o p.svg
ok "its scene" exits 0 "$beadsim" --info a/run.h5
ok "... has the velocity that was found" prints 'at 400 mm/s'

printf '0,0\n1e-4,3\n3e-4,0\n' >in/plain.csv
with() { printf '%s\n' 'chain: {beads: [{bead: large-steel, count: 12}]}' 'simulate: {until: 0.3 ms}' "outputs: [{plot: p.svg, $1}]" "${2:-}" >in/w.yaml; }
refused() { with "${@:2}" && fails "1 2" "$beadsim" --plan in/w.yaml && says "$1"; }
with 'beads: 8, measured: plain.csv'
ok "a name alone is that of a file of seconds and values" exits 0 "$beadreel" in/w.yaml
# An oscilloscope saves its settings, names in quotation marks and units first; the points are those of the plain file.
printf 'Model,TDS2024\r\nSerial,"C1,7"\r\nRecord Length,3\r\n\r\n"TIME", "CH1","CH2"\r\n(s),(V),(V)\r\n0,9,0\r\n1e-4,9,3\r\n3e-4,9,0\r\n' >in/scope.csv
mv p.svg plain.svg
with 'beads: 8, measured: {file: scope.csv, columns: [TIME, CH2]}'
ok "a file as an oscilloscope saves it" exits 0 "$beadreel" in/w.yaml
ok "... has the same points" cmp p.svg plain.svg
ok "... but not a column of another name" refused 'scope.csv has no column `CH3`' 'beads: 8, measured: {file: scope.csv, columns: [TIME, CH3]}'
ok "three columns" refused 'measured.columns: has 3 entries; must be two' 'beads: 8, measured: {file: scope.csv, columns: [TIME, CH1, CH2]}'
printf 'us,volts\n-,-\n' >in/none.csv
ok "a file without numbers" refused 'none.csv: no line has two numbers' 'beads: 8, measured: none.csv'
rm in/none.csv
ok "a file that is not there" refused 'none.csv: cannot be read' 'beads: 8, measured: none.csv'
ok "no file" refused 'outputs.0.measured.file: is missing' 'beads: 8, measured: {gain: 2 N}'
ok "a gain in another unit" refused 'measured.gain' 'beads: 8, measured: {file: plain.csv, gain: 2 m}'
ok "a plot that has no times" refused 'belongs to `show: sensors`' 'show: peaks, measured: plain.csv'
ok "normalised forces" refused 'leave `normalise` out' 'beads: 8, normalise: max, measured: plain.csv'
ok "a fit to nothing" refused 'needs a plot with `measured`' 'beads: 8' 'fit: [chain.striker.velocity]'
ok "a fit of what the scene does not have" refused 'has no number `chain.wall`' 'beads: 8, measured: plain.csv' 'fit: [chain.wall]'
ok "... of what is no number" refused 'is `large-steel`' 'beads: 8, measured: plain.csv' 'fit: [chain.beads.0.bead]'
ok "... of what changes nothing" refused 'changes nothing that was measured' 'beads: 8, measured: plain.csv' 'fit: [simulate.until]'
ok "a table of no fit" refused 'there is no `fit`' 'beads: 8}, {table: fit.csv, show: fit'
finish
