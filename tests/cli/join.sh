#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Several trajectories: their curves in one plot, and the difference of two.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >s.yaml <<'YAML'
chain: {beads: [{cell: [large-steel, aluminium], count: 12, spins: random, seed: 3}], wall: rigid}
simulate: {until: 1 ms}
outputs: [{trajectory: run.h5, every: 2 us, fields: [force, velocity]}]
YAML
make() { "$beadsim" s.yaml -o . "${@:2}" >"$T/out" && mv run.h5 "$1"; }
ok "two accuracies" eval 'make a.h5 --set simulate.accuracy=1e-5 && make b.h5 --set simulate.accuracy=1e-10'
ok "one sampled otherwise, and longer" make c.h5 --set simulate.accuracy=1e-10 --set outputs.0.every='1 us' --set simulate.until='1.2 ms'
column() { tail -n +2 "$1" | cut -d, -f"$2"; }
alike() { [ "$(column "$1" "$2" | sort -u)" = "$3" ]; }
ok "a run with itself" exits 0 "$beadsim" --diff a.h5 a.h5 -o same.csv
ok "... is exactly 0" alike same.csv 2 0
ok "two runs" exits 0 "$beadsim" --diff a.h5 b.h5 -o diff.csv
ok "... have a table of times, values, beads and parts" eval '[ "$(head -n 1 diff.csv)" = time_s,largest_N,bead,part_of_largest ]'
ok "... and part: less than 1e-4 before 0.2 ms, more at the end" eval 'awk -F, "NR > 1 && \$1 < 2e-4 && \$4 > 1e-4 {bad = 1} END {exit bad || !(\$4 > 1e-6)}" diff.csv'
ok "... the other way round" exits 0 "$beadsim" --diff b.h5 a.h5 -o back.csv
ok "... it has the other sign" eval 'cmp <(column diff.csv 2 | sed "s/^-//") <(column back.csv 2 | sed "s/^-//") && ! cmp -s <(column diff.csv 2) <(column back.csv 2)'
ok "another sampling" exits 0 "$beadsim" --diff b.h5 c.h5 -o other.csv
ok "... is as long as the shorter" eval '[ "$(tail -n 1 other.csv | cut -d, -f1)" = 0.001 ]'
# The last step is cut at the end of the run: the other one has none there.
ok "... and exactly 0 where both have samples" eval 'awk -F, "NR > 1 && \$1 < 9.9e-4 && \$2 != 0 {bad = 1} END {exit bad}" other.csv'
ok "... the finer one first: on straight lines between" exits 0 "$beadsim" --diff c.h5 b.h5 -o lines.csv
ok "... off by their bend" eval 'awk -F, "NR > 1 {d = \$2 < 0 ? -\$2 : \$2; m = d > m ? d : m} END {exit !(m > 1e-6 && m < 1)}" lines.csv'
ok "a field of its own" exits 0 "$beadsim" --diff a.h5 b.h5 -o v.csv --set 'outputs=[{table: v.csv, show: extremes, field: velocity}]'
ok "... with its unit" eval 'head -n 1 v.csv | grep -qF "largest_m/s"'
ok "extremes of one run" exits 0 "$beadsim" a.h5 -o one.csv --set 'outputs=[{table: one.csv, show: extremes}]'
ok "... have no part" eval '[ "$(head -n 1 one.csv)" = time_s,largest_N,bead ]'
ok "... its largest is that of the run" eval '"$beadsim" s.yaml -o p.csv --set "outputs=[{table: p.csv, show: bead-peaks, uncertainty: false}]" --set simulate.accuracy=1e-5 >"$T/out" &&
    awk -F, "FNR == 1 {file++; next} {m[file] = \$2 > m[file] ? \$2 : m[file]} END {exit !(m[1] <= m[2] && m[1] > 0.98 * m[2])}" one.csv p.csv'
# Runs that hold one field that is not the usual one, and what it is called.
while read -r field title; do
    ok "two runs of $field alone" eval 'make f1.h5 --set simulate.accuracy=1e-5 --set outputs.0.fields='"[$field]"' && make f2.h5 --set outputs.0.fields='"[$field]"
    ok "... one in a picture" eval '"$beadreel" f1.h5 -o f.svg --size 400x300 >"$T/out" && grep -qF "$title (" f.svg'
    ok "... their difference" eval '"$beadreel" --diff f1.h5 f2.h5 -o f.svg --size 400x300 >"$T/out" && grep -qF "difference in $title" f.svg'
    ok "... and its largest values" eval '"$beadsim" --diff f1.h5 f2.h5 -o f.csv >"$T/out" && awk -F, "NR > 1 && \$2 != 0 {found = 1} END {exit !found}" f.csv'
done <<'END'
velocity velocity
displacement bead force
compression compression
energy energy
contact-force contact force
END
ok "displacements of a damped chain do not tell its forces" make f1.h5 --set chain.damping.coefficient=5 --set 'outputs.0.fields=[displacement]'
ok "... and are shown themselves" eval '"$beadreel" f1.h5 -o f.svg --size 400x300 >"$T/out" && grep -qF "displacement (" f.svg'
ok "a picture of the difference" exits 0 "$beadreel" --diff a.h5 b.h5 -o diff.svg --size 400x300
ok "... says what it is" grep -qF 'difference in bead force' diff.svg
ok "curves of both in one plot" exits 0 "$beadreel" a.h5 b.h5 -o both.svg --beads 10
ok "... named by their files" eval 'grep -qF ">a" both.svg && grep -qF ">b" both.svg'
ok "... and in one table" eval '"$beadsim" a.h5 b.h5 -o both.csv --set "outputs=[{table: both.csv, show: sensors, beads: 10}]" >"$T/out" && [ "$(head -n 1 both.csv)" = time_s,a/bead_10,b/bead_10 ]'
ok "... each as it is alone" eval '"$beadsim" a.h5 -o alone.csv --set "outputs=[{table: alone.csv, show: sensors, beads: 10}]" >"$T/out" && cmp <(column alone.csv 2) <(column both.csv 2)'
ok "--plan" eval '"$beadsim" --diff a.h5 b.h5 -o diff.csv --plan >"$T/out" && grep -qF "diff.csv" "$T/out"'
refused() { fails "$1" "$beadsim" "${@:3}" && says "$2"; }
ok "two scenes" refused 2 'one file at a time: `s.yaml` and `s.yaml`' s.yaml s.yaml
ok "one trajectory" refused 2 '--diff: needs two trajectories' --diff a.h5 -o diff.csv
ok "three" refused 2 '--diff: needs two trajectories' --diff a.h5 b.h5 c.h5 -o diff.csv
ok "a scene" refused 1 'not an HDF5 file' --diff a.h5 s.yaml -o diff.csv
ok "another chain" eval 'make d.h5 --set chain.beads.0.count=3 && refused 2 "each of as many beads" --diff a.h5 d.h5 -o diff.csv'
finish
