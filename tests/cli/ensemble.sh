#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Curves of the chains of a sweep: each beside that of its chain alone, means and standard errors over seeds beside those of the single
# runs, scaling, and the bands of a cell.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {d = a - b; if (b != 0) d /= b; exit !(a != "" && b != "" && (d < 0 ? -d : d) <= t)}' || { echo "$1 is not $2 to $3"; return 1; }; }
is() { [ "$1" = "$2" ] || { echo "$1 is not $2"; return 1; }; }

# Without precompression and damping F ~ v^(6/5), and times are as v^(-1/5), exactly.
cat >v.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 30}]}
sweep: {over: {chain.striker.velocity: [0.1 m/s, 3.2 m/s]}}
outputs: [{table: v.csv, show: sensors, contacts: 20, every: 0.1 us}]
YAML
ok "forces of a contact, for each velocity" exits 0 "$beadsim" v.yaml -o .
peak() { awk -F, -v name="$1" -v c="$2" '$2 == name && $4 > most {most = $4; at = $1} END {print c == "at" ? at : most}' v.csv; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN {printf "%.15g", a / b}'; }
ok "... scale as the velocity to the power 6/5" near "$(ratio "$(peak 'velocity 3.2 m/s' force)" "$(peak 'velocity 0.1 m/s' force)")" 64 1e-4
ok "... their times as its power -1/5" near "$(ratio "$(peak 'velocity 0.1 m/s' at)" "$(peak 'velocity 3.2 m/s' at)")" 2 1e-3
ok "... of one chain each, without an error" is "$(tail -n +2 v.csv | cut -d, -f3,5 | sort -u)" "1,"
ok "compressions as its power 4/5" eval '"$beadsim" v.yaml -q -o . --set outputs.0.field=compression && near "$(ratio "$(peak "velocity 3.2 m/s" force)" "$(peak "velocity 0.1 m/s" force)")" 16 1e-4'

cat >m.yaml <<'YAML'
chain: {beads: [{cell: [large-steel, aluminium], count: 12, spins: random, magnetism: 0.5, seed: 1}]}
simulate: {until: 0.4 ms}
sweep: {over: {chain.beads.0.magnetism: [0, 0.5], chain.beads.0.seed: 1..5}}
outputs: [{table: m.csv, show: sensors, beads: [3, 12], field: velocity, every: 2 us}, {plot: m.svg, show: sensors, beads: 12, field: velocity, every: 2 us}]
YAML
# alone TABLE SETTINGS : the same table of each chain by itself, one.0.csv and so on
alone() {
    local i n=$1; shift
    for ((i = 0; i < n; i++)); do "$beadsim" "$1" -q --configuration $i -o one.csv --set "outputs=[$2]" >"$T/out" || return 1; mv one.csv one.$i.csv; done
}
# means TABLE FIRST NAME : means and standard errors of columns of five single runs beside those of a table of the sweep
means() {
    python3 - "$@" <<'PY'
import csv, statistics, sys
table, first, name, columns = sys.argv[1], int(sys.argv[2]), sys.argv[3], int(sys.argv[4])
number = lambda text: float(text) if text else float("nan")
mine = [row for row in csv.reader(open(table)) if row[1] == name]
ones = [{row[0]: row for row in list(csv.reader(open(f"one.{first + i}.csv")))[1:]} for i in range(5)]
largest = [max(abs(number(row[1 + c])) for one in ones for row in one.values()) for c in range(columns)]
if len(mine) < 20 or sorted({x for one in ones for x in one}) != sorted(row[0] for row in mine): sys.exit(f"{len(mine)} other rows")
for i, row in enumerate(mine):
    if row[2] != "5": sys.exit(f"row {i}: {row[:3]}")
    for c in range(columns):
        values = [number(one[row[0]][1 + c]) for one in ones if row[0] in one] # a transfer has none where the drive is small
        if len(values) < 2: continue
        wanted = statistics.mean(values), statistics.stdev(values) / len(values) ** 0.5
        for got, want in zip(row[3 + 2 * c:], wanted):
            if not abs(number(got) - want) <= 1e-6 * largest[c]: sys.exit(f"row {i}, column {c}: {got}, not {want}")
PY
}
ok "means over seeds" exits 0 "$beadreel" m.yaml -o .
ok "... beside the chains alone" alone 10 m.yaml '{table: one.csv, show: sensors, beads: [3, 12], field: velocity, every: 2 us, uncertainty: false}'
ok "... are their means, and standard errors" means m.csv 0 "magnetism 0" 2
ok "... of the other value, too" means m.csv 5 "magnetism 0.5" 2
ok "... on one thread the same bytes" eval '"$beadreel" m.yaml -q -o single --threads 1 >"$T/out" && cmp single/m.csv m.csv && cmp single/m.svg m.svg'
wide() { "$beadreel" m.yaml -q -o . --set "outputs=[{plot: paper.svg, show: sensors, beads: $1, style: paper}]" && grep -qE "width=\"$2" paper.svg; }
ok "on paper, the curves of one place have one column" wide 3 24
ok "... those of two both" wide "[3, 12]" 50
ok "... and says how many there are" grep -q "mean of 5 chains" m.svg
ok "means of spectra" exits 0 "$beadsim" m.yaml -o . --set 'outputs=[{table: s.csv, show: spectrum, beads: [3, 12], field: velocity, every: 2 us}]'
# All five chains of a curve are run twice. Columns: what, curve, number, means and standard errors of two, two uncertainties.
known() { # KEYS : roughly, and to nine digits
    local a
    for a in 1e-4 1e-9; do "$beadsim" m.yaml -q -o $a --set simulate.accuracy=$a --set "outputs=[{table: k.csv, $1}]" || return 1; done
    awk -F, 'function size(x) {return x < 0 ? -x : x} FNR == 1 {next} NR == FNR {for (c = 4; c < 8; c += 2) exact[$1, $2, c] = $c; next}
        {for (c = 4; c < 8; c += 2) {e = size($c - exact[$1, $2, c]); u = $(8 + (c - 4) / 2); bad += !(e <= u); column = $2 SUBSEP c
            off[column] = e > off[column] ? e : off[column]; said[column] = u; high[column] = size($c) > high[column] ? size($c) : high[column]}}
        END {for (c in off) {n++; bad += !(off[c] > 0) || said[c] > 10 * off[c] && said[c] > 1e-3 * high[c]} print bad, n; exit bad || n != 4}' 1e-9/k.csv 1e-4/k.csv
}
ok "means of curves are off by less than they say" known 'show: sensors, beads: [3, 12], field: velocity, every: 2 us'
ok "... of spectra" known 'show: spectrum, beads: [3, 12], field: velocity, every: 2 us'
ok "... not where nothing is asked" eval '"$beadsim" m.yaml -q -o . --set "outputs=[{table: k.csv, show: sensors, beads: [3, 12], field: velocity, every: 2 us, uncertainty: false}]" && cmp k.csv <(cut -d, -f1-7 m.csv)'
ok "... beside the chains alone" alone 5 m.yaml '{table: one.csv, show: spectrum, beads: [3, 12], field: velocity, every: 2 us, uncertainty: false}'
ok "... are means of amplitudes" means s.csv 0 "magnetism 0" 2

{ dimers 60; cat; } >d.yaml <<'YAML'
  drive: {displacement: noise, amplitude: 10 pm, frequency: 12 kHz, seed: 1}
simulate: {until: 20 ms}
sweep: {over: {chain.drive.seed: 1..5}}
outputs:
  - {table: t.csv, show: transfer, beads: [2, 40], every: 20 us, segment: 10 ms}
  - {plot: t.svg, show: transfer, beads: 40, every: 20 us, segment: 10 ms, frequencies: [0 Hz, 12 kHz]}
YAML
ok "a dimer, shaken five times" exits 0 "$beadreel" d.yaml -o .
ok "... its plot has the curve of the table" eval 'tail -n +2 t.csv | cut -d, -f1,6 | sed "1i x,y" >curve.csv && python3 "$top/tests/curves.py" t.svg curve.csv 1e3 1 3'
ok "the chains alone" alone 5 d.yaml '{table: one.csv, show: transfer, beads: [2, 40], every: 20 us, segment: 10 ms, uncertainty: false}'
ok "means of transfers" means t.csv 0 "" 2
ok "... inside the gap below a thousandth" eval 'awk -F, "NR > 1 && \$1 > 5300 && \$1 < 7600 && \$6 > most {most = \$6} END {exit !(most > 0 && most < 1e-3)}" t.csv'
# Forces that are too weak to tell: two equal chains, struck in the middle.
sed 's/drive: .*/drive: {force: noise, amplitude: 1e-30 N, frequency: 12 kHz, seed: 1}/' d.yaml >equal.yaml
ok "equal chains" exits 0 "$beadreel" equal.yaml -o . --set 'chain.start=[{bead: [60, 61], velocity: 1 um/s}]' \
    --set 'sweep={over: {chain.drive.seed: 1..2}}' --set 'outputs=[{table: d.csv, show: dispersion}, {plot: d.svg, show: dispersion}]'
ok "their mean dispersion ends where the lower band does" near "$(awk -F, '$3 == 1 && $4 == 1 {print $6}' d.csv)" 4710.94 2e-3
ok "... and the upper" near "$(awk -F, '$3 == 0 && $4 == 2 {print $6}' d.csv)" 9372.22 2e-3
ok "... with the exact ones beside them" near "$(awk -F, '$3 == 1 && $4 == 1 {print $5}' d.csv)" 4710.94 1e-5
ok "... and over them in a picture" grep -q "exact bands" d.svg
ok "... without an error" awk -F, 'NR > 1 {bad = bad || $2 != 2 || $8 == "" || $8 > 1e-9 * $7} END {exit bad || NR < 40}' d.csv
ok "without until, to the last arrival of a front" eval '"$beadsim" m.yaml -q -o . --set simulate.until=auto --set "outputs=[{table: e.csv, show: sensors, contacts: 3}]" && [ "$(cut -d, -f2 e.csv | sort | uniq -c | wc -l)" = 3 ]'

refused() { # MESSAGE SETTING... : with the scene m.yaml
    local says=$1 set=(); shift
    for s in "$@"; do set+=(--set "$s"); done
    fails "1 2" "$beadsim" --plan m.yaml "${set[@]}" && says "$says"
}
ok "curves need places" refused 'no bead of the chain has a `sensor`' 'outputs=[{table: t.csv, show: sensors}]'
ok "... a field that they have" refused 'is one of contacts' 'outputs=[{table: t.csv, show: sensors, beads: 3, field: compression}]'
ok "... no axis of a key" refused 'belongs to peaks and measures' 'outputs=[{table: t.csv, show: sensors, beads: 3, against: chain.beads.0.magnetism}]'
ok "... no window over time" refused 'does not belong to this `show`' 'outputs=[{table: t.csv, show: sensors, beads: 3, window: none}]'
ok "peaks have no places" refused 'belongs to `show: sensors`' 'outputs=[{table: t.csv, beads: 3}]'
ok "sweeps over spins have none" fails "1 2" "$beadsim" --plan sweep --set 'outputs=[{table: t.csv, show: sensors, beads: 3}]'
ok "... and say so" says 'sweep over keys'
ok "chains of other lengths have other wave numbers" fails 2 "$beadsim" d.yaml --plan --set 'sweep={over: {chain.beads.0.count: [20, 40]}}' --set simulate.until=2ms --set 'outputs=[{table: d.csv, show: dispersion}]'
ok "... and say so" says 'chains have 41 and 81 beads; a mean needs chains of equal length'
finish
