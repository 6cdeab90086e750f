#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Waves of drives from files: columns by name and number, units, a run that keeps what was read, and what is wrong with a file.
source "$(dirname "$0")/../shell.bash"
mkdir -p "$T/in" && cd "$T" || exit 1
printf 'us;ignored;volts\n0;7;0\n100;7;0.5\n300;7;-0.25\n\n500;7;0\n' >in/scope.csv
printf '0,0\n1e-4,0.5\n3e-4,-0.25\n5e-4,0\n' >plain.csv
cat >in/s.yaml <<'YAML'
chain:
  beads: [{bead: large-steel, count: 10}]
  drive: {force: {file: scope.csv, columns: [us, volts], time: 1 us}, amplitude: 40 N}
simulate: {until: 1 ms}
outputs: [{table: t.csv, show: sensors, contacts: [0, 4], every: 1 us, uncertainty: false}]
YAML
ok "a wave from a file beside the scene" exits 0 "$beadsim" in/s.yaml -o a
ok "... by number, from a file named in an option" exits 0 "$beadsim" in/s.yaml -o b --set 'chain.drive.force={file: plain.csv}'
ok "... as points" exits 0 "$beadsim" in/s.yaml -o c --set 'chain.drive.force="0 0, 1e-4 0.5, 3e-4 -0.25, 5e-4 0"'
alike() {
    paste -d, a/t.csv b/t.csv c/t.csv | awk -F, 'function off(x) {return x < 0 ? -x : x}
        NR > 1 {most = $2 > most ? $2 : most; w = off($2 - $5) > w ? off($2 - $5) : w; x += off($5 - $8)}
        END {exit !(most > 5 && w < 1e-6 * most && x == 0)}'
}
ok "all are the same, to the rounding of times" alike
ok "a run keeps the wave" exits 0 "$beadsim" in/s.yaml -o . --set 'outputs=[{trajectory: run.h5, every: 1 us, fields: [contact-force]}]'
rm in/scope.csv
ok "... without the file" exits 0 "$beadsim" run.h5 -o d.csv --set 'outputs=[{table: d.csv, show: sensors, contacts: [0, 4], every: 1 us, uncertainty: false}]'
ok "... to the last digit" cmp a/t.csv d.csv
ok "--info says what is driven, and promises no bound" eval '"$beadsim" --info run.h5 >"$T/out" && grep -q "bead 0 driven: its load is a measured wave of 40 N" "$T/out" && ! grep -qE "striker.*energy|at most" "$T/out"'
ok "... nor does --json" eval '"$beadsim" --info run.h5 --json >"$T/out" && grep -qE "\"energy_J\": *null" "$T/out" && grep -qE "\"pressure_yield_most\": *null" "$T/out"'
# A resonance collects energy, far more than a single push has.
echo 'chain: {precompression: 20 N, beads: [{bead: large-steel, count: 10}], wall: rigid, drive: {bead: 0, displacement: sine, amplitude: 1 um, frequency: 3 kHz, ramp: 1 ms}}
simulate: {until: 40 ms}
outputs: [{table: m.csv, show: measures, uncertainty: false}]' >in/resonance.yaml
ok "a resonance" exits 0 "$beadsim" in/resonance.yaml -o .
ok "... that leaves the model says so" says 'times the yield strength'
ok "... not away from it" exits 0 "$beadsim" in/resonance.yaml -o . --set chain.drive.frequency='2 kHz'
ok "... where nothing is said" test ! -s "$T/err"
ok "gaps, pendulums and springs are in --info" eval '"$beadsim" --info in/resonance.yaml --set "chain={gap: 2 um, cradle: {length: 3 cm}, beads: [{bead: brass, count: 3, gap: 5 um, spring: 2 kN/m}]}" >"$T/out" && grep -q "gaps of 5 um, springs of 2 kN/m" "$T/out" && grep -q "^  gaps of 2 um" "$T/out" && grep -q "pendulums of 3 cm\|pendulums of 30 mm" "$T/out"'
echo 'chain: {beads: [{bead: small-steel, count: 3}], drive: {force: {file: a.csv}, amplitude: 1 N}}
simulate: {until: 100 us}
sweep: {over: {chain.drive.force.file: [a.csv, b.csv]}, measure: {beads: [1, 1]}}
outputs: [{table: all.csv, show: configurations}]' >in/sweep.yaml
printf '0,0\n5e-5,1\n1e-4,0\n' >in/a.csv
sed 's/,1$/,2/' in/a.csv >in/b.csv
ok "a sweep over files" exits 0 "$beadsim" in/sweep.yaml -o .
sed -e '/^sweep/d' -e 's/: all.csv.*/: one.csv, show: bead-peaks}]/' in/sweep.yaml >in/one.yaml
ok "... another file in an option, beside the one output" exits 0 "$beadsim" in/one.yaml -o one.csv --set chain.drive.force.file=in/b.csv
own=$(sed -n 's/^1,b.csv,\([^,]*\),.*/\1/p' all.csv)
ok "... each chain has its own" test -n "$own" -a "$own" = "$(sed -n 's/^1,\([^,]*\),.*/\1/p' one.csv)"
echo 'chain: {beads: [{bead: small-steel, sensor: first}]}
outputs: [{plot: p.svg, show: sensors, measured: {file: a.csv}}]' >in/measured.yaml
ok "another file of what was measured" exits 0 "$beadreel" in/measured.yaml -o b.svg --set outputs.0.measured.file=in/b.csv
ok "... which is drawn" eval '"$beadreel" in/measured.yaml -q -o c.svg --set "outputs.0.measured={file: in/b.csv}" && cmp b.svg c.svg && "$beadreel" in/measured.yaml -q -o d.svg && ! cmp -s b.svg d.svg'
refused() { fails "1 2" "$beadsim" --plan in/s.yaml "${@:2}" && says "$1"; }
wrong() { # FILE TEXT SETTING...
    printf '%b' "$1" >in/scope.csv
    refused "${@:2}"
}
ok "a file that is not there" refused 'scope.csv: cannot be read'
ok "a column that is not there" wrong 'us,force\n0,1\n1,2\n' 'scope.csv has no column `volts`'
ok "a line without numbers" wrong 'us,volts\n0,1\n1,x\n' 'scope.csv: line 3 has no two numbers'
ok "times that do not rise" wrong 'us,volts\n0,1\n0,2\n' 'point 2, at 0 s, is not later'
ok "one point" wrong 'us,volts\n0,1\n' 'has 1 points'
ok "a frequency besides" wrong 'us,volts\n0,1\n1,2\n' 'belongs to waves that are not from a file' --set chain.drive.frequency=1kHz
ok "a part of what a run holds" fails "1 2" "$beadsim" run.h5 -o e.csv --set chain.drive.force.file=in/b.csv
ok "a wave that is none" refused 'must be sine, chirp, noise' --set chain.drive.force=square
finish
