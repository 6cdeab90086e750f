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
ok "... have a table of times, values, beads and parts" eval '[ "$(head -n 1 diff.csv)" = time_s,largest_N,bead,part_of_largest,uncertainty ]'
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
ok "... have no part" eval '[ "$(head -n 1 one.csv)" = time_s,largest_N,bead,uncertainty ]'
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
ok "... and in one table" eval '"$beadsim" a.h5 b.h5 -o both.csv --set "outputs=[{table: both.csv, show: sensors, beads: 10}]" >"$T/out" && [ "$(head -n 1 both.csv)" = time_s,a/bead_10,b/bead_10,a/bead_10_uncertainty,b/bead_10_uncertainty ]'
ok "... each as it is alone" eval '"$beadsim" a.h5 -o alone.csv --set "outputs=[{table: alone.csv, show: sensors, beads: 10}]" >"$T/out" && cmp <(column alone.csv 2) <(column both.csv 2)'
ok "--plan" eval '"$beadsim" --diff a.h5 b.h5 -o diff.csv --plan >"$T/out" && grep -qF "diff.csv" "$T/out"'
# Chains of unlike lengths, and files that hold only a part of their beads, or begin later: the order of the files does not matter.
cat >u.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 20}]}
simulate: {until: 1 ms}
outputs: [{trajectory: run.h5, every: 2 us, fields: [displacement, velocity, force, contact-force]}]
YAML
long() { "$beadsim" u.yaml -o . "${@:2}" >"$T/out" && mv run.h5 "$1"; }
ok "runs of 20 and 40 beads, of 11 of the beads, and without the beginning" eval 'long u20.h5 && long u40.h5 --set chain.beads.0.count=40 && long part.h5 --set "outputs.0.beads=[0, 10]" &&
    long late.h5 --set "outputs.0.time=[0.2 ms, 0.9 ms]" && long sensor.h5 --set "chain.beads=[{bead: large-steel, count: 30}, {bead: brass, sensor: far}]"'
sorted() { head -n 1 "$1" | tr , '\n' | grep -v uncertainty | sort | tr '\n' ' '; }
pair() { # WHAT A B KEYS COLUMNS: a table of A and B has these columns, and the same numbers in both orders
    ok "$1" eval '"$beadsim" '"$2.h5 $3.h5"' -o 1.csv --set "outputs=[{table: 1.csv, '"$4"'}]" >"$T/out" && "$beadsim" '"$3.h5 $2.h5"' -o 2.csv --set "outputs=[{table: 2.csv, '"$4"'}]" >"$T/out"'
    ok "... both are there" eval '[ "$(sorted 1.csv)" = "'"$5"'" ] && [ "$(sorted 2.csv)" = "'"$5"'" ]'
}
pair "a bead that both have" u20 u40 'show: sensors, beads: 10' 'time_s u20/bead_10 u40/bead_10 '
ok "... with values" eval 'awk -F, "NR > 1 && \$2 > 1 && \$3 > 1 {found = 1} END {exit !found}" 1.csv'
pair "a bead that one has" u20 u40 'show: sensors, beads: [10, 30]' 'time_s u20/bead_10 u40/bead_10 u40/bead_30 '
ok "... the other's is not 0" eval 'awk -F, "NR > 1 && \$4 > 1 {found = 1} END {exit !found}" 1.csv'
pair "a contact that one has" u20 u40 'show: sensors, contacts: 30' 'time_s u40/contact_30 '
pair "a sensor that one has" u20 sensor 'show: sensors' 'sensor/far time_s '
pair "a spectrum of a bead that one has" u20 u40 'show: spectrum, beads: 30' 'frequency_Hz u40/bead_30 '
for order in "u20.h5 u40.h5" "u40.h5 u20.h5"; do
    ok "a bead that none has, $order" eval 'fails 2 "$beadsim" '"$order"' -o no.csv --set "outputs=[{table: no.csv, show: sensors, beads: [10, 50]}]" && says "is 50, but the last bead is 40"'
    ok "... a contact" eval 'fails 2 "$beadsim" '"$order"' -o no.csv --set "outputs=[{table: no.csv, show: sensors, contacts: 40}]" && says "is 40, but the last contact is 39"'
    for show in sensors spectrum spectrogram; do
        ok "... a plot of what one has: $show" eval '"$beadreel" '"$order"' -o one.svg --set "outputs=[{plot: one.svg, show: '$show', beads: 30}]" >"$T/out" && grep -qF "u40" one.svg && ! grep -qF "u20" one.svg'
    done
    ok "... profiles" eval '"$beadsim" '"$order"' -o p.csv --set "outputs=[{table: p.csv, show: profiles, at: [0.3 ms]}]" >"$T/out" && [ "$(wc -l <p.csv)" = 63 ]'
    ok "... a chain by its name" eval '"$beadreel" '"$order"' -o one.svg --set "outputs=[{plot: one.svg, panels: [[{show: sensors, beads: 10, chain: u40}]]}]" >"$T/out" && grep -qF "u40" one.svg && ! grep -qF "u20" one.svg'
    ok "... a race" exits 0 "$beadreel" $order -o race.mp4 --set 'outputs=[{movie: race.mp4, race: true, size: [320, 240], fps: 4, duration: 1 s}]'
    ok "nothing asked for: a bead in the middle" exits 0 "$beadreel" $order -o both.svg
    ok "... says which" eval 'says "this shows bead 10" && grep -qF "bead 10" both.svg'
done
ok "... not where a setting says it" eval '"$beadreel" u20.h5 u40.h5 -o both.svg --set "outputs.0.contacts=[3]" >"$T/out" 2>&1 && grep -qF "contact 3" both.svg && ! grep -qF "this shows" "$T/out" && ! grep -qF "bead 10" both.svg'
ok "... nor where there are sensors" eval '"$beadreel" u20.h5 sensor.h5 -o both.svg >"$T/out" 2>&1 && grep -qF "far" both.svg && ! grep -qF "this shows" "$T/out"'
ok "... of contacts where these alone are stored" eval 'long f1.h5 --set "outputs.0.fields=[contact-force]" && "$beadsim" f1.h5 u40.h5 -o c.csv >"$T/out" 2>&1 && [ "$(sorted c.csv)" = "f1/contact_10 time_s u40/contact_10 " ]'
pair "one begins later: from there" u20 late 'show: sensors, beads: 10' 'late/bead_10 time_s u20/bead_10 '
ok "... to where both end" eval 'awk -F, "NR == 2 && !(\$1 > 1.999e-4 && \$1 < 2.001e-4) || NR > 1 && \$1 > 9.01e-4 {bad = 1} NR > 1 && (\$2 > \$3 + 1e-3 || \$3 > \$2 + 1e-3) {bad = 1} END {exit bad || NR < 340}" 1.csv'
for order in "part.h5 u40.h5" "u40.h5 part.h5" part.h5; do
    ok "a bead that a file does not hold is not 0, $order" eval 'fails 1 "$beadsim" '"$order"' -o no.csv --set "outputs=[{table: no.csv, show: sensors, beads: 15}]" && says "part.h5 holds beads 0 to 10 only"'
    ok "... a profile" eval 'fails 1 "$beadsim" '"$order"' -o no.csv --set "outputs=[{table: no.csv, show: profiles, at: [0.3 ms]}]" && says "part.h5 holds beads 0 to 10 only"'
    ok "... an image shows those that all hold" exits 0 "$beadreel" $order -o held.svg --set 'outputs=[{image: held.svg}]'
done
ok "fields are missed in the file that lacks them" eval 'long v.h5 --set "outputs.0.fields=[velocity]" && fails 1 "$beadsim" u20.h5 v.h5 -o no.csv --set "outputs=[{table: no.csv, show: sensors, beads: 3}]" && says "which v.h5 does not hold"'
for order in "u20.h5 none.h5" "none.h5 u20.h5"; do
    ok "a file that is not there, $order" eval 'fails 1 "$beadreel" '"$order"' -o both.pdf && says "none.h5: cannot be read: No such file"'
done
# What a trajectory cannot have is not drawn by an ending alone; `last` is that of each chain.
cat >v.yaml <<'YAML'
chains:
  - {name: short, beads: [{bead: large-steel, count: 12}], start: [{bead: 0, velocity: 0.4 m/s}]}
  - {name: long, beads: [{bead: large-steel, count: 20}], start: [{bead: 0, velocity: 0.4 m/s}]}
simulate: {until: 0.6 ms}
outputs:
  - {plot: energy.svg, show: energy}
  - {plot: peaks.svg, show: peaks}
  - {table: last.csv, show: sensors, beads: [15, last], contacts: last, uncertainty: false}
  - {trajectory: v.h5, every: 2 us, fields: [displacement, velocity, force, contact-force]}
YAML
ok "the last bead of each of two unlike chains" exits 0 "$beadreel" v.yaml -o .
ok "... has a column each" eval '[ "$(head -n 1 last.csv)" = time_s,short/last_bead,short/last_contact,long/bead_15,long/last_bead,long/last_contact ]'
ok "... that of the bead by its number" eval '"$beadsim" v.yaml -o . --set "outputs=[{table: number.csv, show: sensors, beads: [12, 20], uncertainty: false, every: 2 us}]" --set simulate.until="0.6 ms" >"$T/out" &&
    "$beadsim" v.yaml -o . --set "outputs=[{table: word.csv, show: sensors, beads: last, uncertainty: false, every: 2 us}]" >"$T/out" && cmp <(column word.csv 2) <(column number.csv 2) && cmp <(column word.csv 3) <(column number.csv 4)'
ok "... and no peaks or energies, which are those of numbers" eval 'fails 2 "$beadsim" v.yaml -o . --set "outputs=[{table: no.csv, show: peaks, contacts: last}]" && says "contacts: has last, which is not the same in all chains"'
ok "stored runs: another plot than those that need a run" exits 0 "$beadreel" v.h5 -o own.svg
ok "... but not under their names" eval 'fails 1 "$beadreel" v.h5 -o energy.svg && says "the energy budget is kept by a run"'
refused() { fails "$1" "$beadsim" "${@:3}" && says "$2"; }
ok "two scenes" refused 2 'one file at a time: `s.yaml` and `s.yaml`' s.yaml s.yaml
"$beadsim" fput --set simulate.until=20 --set 'outputs=[{trajectory: string.h5}]' -o . >"$T/out"
ok "a string and beads" refused 2 'string.h5: is of an equation, and a.h5 of beads' a.h5 string.h5 -o no.csv --set outputs.0.beads=3
ok "... whatever the order" refused 2 'a.h5: is of beads, and string.h5 of an equation' string.h5 a.h5 -o no.csv --set outputs.0.beads=3
ok "one trajectory" refused 2 '--diff: needs two trajectories' --diff a.h5 -o diff.csv
ok "three" refused 2 '--diff: needs two trajectories' --diff a.h5 b.h5 c.h5 -o diff.csv
ok "a scene" refused 1 'not an HDF5 file' --diff a.h5 s.yaml -o diff.csv
ok "another chain" eval 'make d.h5 --set chain.beads.0.count=3 && refused 2 "each of as many beads" --diff a.h5 d.h5 -o diff.csv'
finish
