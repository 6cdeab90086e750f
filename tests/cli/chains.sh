#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Chains in a few words: values of beads, taper, disorder, numbers in cells, groups, decorations. The table `show: chain` has them.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

# chain ENTRY... : makes chain.csv of a chain of these.
chain() {
    local IFS=,
    printf '%s\n' "materials: {like: {density: 7800 kg/m3, modulus: 200 GPa, poisson: 0.3, radius: 4 mm}}" \
        "chain: {beads: [$*]}" 'outputs: [{table: chain.csv, show: chain}]' >scene.yaml
    exits 0 "$beadsim" scene.yaml -o .
}
column() { awk -F, -v c="$1" 'NR > 2 { printf "%s%s", n++ ? " " : "", $c } END { print "" }' chain.csv; } # without the striker
materials() { [ "$(column 2)" = "$1" ] || { column 2; return 1; }; }
# radii CONDITION : of r[1] ... r[n], in m, and m[...], in kg
holds() { awk -F, 'NR > 2 { r[++n] = $4; m[n] = $3 } function near(a, b) { return a - b < 1e-9 * b && b - a < 1e-9 * b } END { exit !('"$1"') }' chain.csv ||
    { cat chain.csv; return 1; }; }
density='r[1] ^ 3 / r[2] ^ 3'

ok "radius" chain '{bead: like, count: 2, radius: 2 mm}'
ok "... with the density" holds 'n == 2 && near(r[1], 2e-3) && near(m[2], 7800 * 4 / 3 * 3.141592653589793 * 8e-9)'
ok "mass" chain '{bead: like, count: 2, radius: 2 mm, mass: 1 g}'
ok "... of each" holds 'near(r[2], 2e-3) && near(m[1], 1e-3) && near(m[2], 1e-3)'
ok "of a cell" chain '{cell: [like, large-steel], count: 2, radius: 1 mm}'
ok "... of all of its beads" holds 'n == 4 && near(r[1], 1e-3) && near(r[4], 1e-3) && near(m[4], 3.63e-3 / 4.76 ^ 3)'
ok "numbers in cells" chain '{cell: [like, 2 ptfe], count: 2}'
ok "... are so many beads" materials 'like ptfe ptfe like ptfe ptfe'
ok "a taper" chain '{bead: like, count: 5, taper: 5 %}'
ok "... makes each smaller" holds 'near(r[1], 4e-3) && near(r[2], 3.8e-3) && near(r[5], 4e-3 * 0.95 ^ 4) && near(m[1] / m[2], 1 / 0.95 ^ 3)'
ok "... or larger" chain '{bead: like, count: 3, taper: -10 %}'
ok "... by as much" holds 'near(r[3], 4e-3 * 1.21)'
ok "from end to end" chain '{bead: like, count: 5, taper: {from: 4.76 mm, to: 1.8 mm}}'
ok "... by one factor" holds 'near(r[1], 4.76e-3) && near(r[5], 1.8e-3) && near(r[2] / r[1], r[5] / r[4])'
ok "from the bead itself" chain '{bead: like, count: 3, taper: {to: 1 mm}}'
ok "... on" holds 'near(r[1], 4e-3) && near(r[2], 2e-3) && near(r[3], 1e-3)'
ok "a 1:2 cell with a taper" chain '{cell: [like, 2 ptfe], count: 10, taper: 5 %}'
ok "... bead by bead" holds 'n == 30 && near(r[4], 4e-3 * 0.95 ^ 3) && near(r[3] / r[2], 0.95)'
ok "a decorated chain" chain '{bead: like, count: 4, decorate: ptfe, taper: 10 %}'
ok "... has a bead between every two" materials 'like ptfe like ptfe like ptfe like'
ok "... that stays as it is" holds 'near(r[2], r[6]) && near(r[7], 4e-3 * 0.9 ^ 3)'
ok "groups of groups" chain '{repeat: 2, of: [{bead: brass}, {repeat: 3, of: [{bead: like}, {bead: ptfe}]}], modulus: 1 GPa}'
ok "... one after the other" materials 'brass like ptfe like ptfe like ptfe brass like ptfe like ptfe like ptfe'
ok "a taper of a group" chain '{repeat: 3, of: [{bead: like}, {bead: like}], taper: 10 %}' '{bead: like}'
ok "... goes through it" holds 'near(r[6], 4e-3 * 0.9 ^ 5) && near(r[7], 4e-3)'
ok "a cell that is turned around" chain '{cell: [like, like], spins: "0", taper: 50 %}'
ok "... is so with its beads" holds 'near(r[1], 2e-3) && near(r[2], 4e-3)'

ok "random radii" chain '{bead: like, count: 2000, disorder: {radius: uniform 0.3..1, seed: 7}}'
spread() { awk -F, 'NR > 2 { n++; s += $4; if ($4 < 1.2e-3 || $4 > 4e-3) bad++; if (min == "" || $4 < min) min = $4; if ($4 > max) max = $4; d += ($3 / $4 ^ 3 - 7800 * 4 / 3 * 3.141592653589793) ^ 2 }
    END { exit !(n == 2000 && !bad && s / n > 2.56e-3 && s / n < 2.64e-3 && min < 1.21e-3 && max > 3.99e-3 && d < 1e-6) }' chain.csv; }
ok "... fill their range, at the density" spread
cp chain.csv before.csv
ok "again" chain '{bead: like, count: 2000, disorder: {radius: uniform 0.3..1, seed: 7}}'
ok "... are the same" cmp chain.csv before.csv
ok "another seed" chain '{bead: like, count: 2000, disorder: {radius: uniform 0.3..1, seed: 8}}'
ok "... has others" bash -c '! cmp -s chain.csv before.csv'
ok "lengths" chain '{bead: like, count: 50, disorder: {radius: uniform 2..3 mm}}'
ok "... are taken as they are" bash -c "awk -F, 'NR > 2 && (\$4 < 2e-3 || \$4 > 3e-3) { exit 1 }' chain.csv"
ok "normal masses" chain '{bead: like, count: 4000, disorder: {mass: normal 5 %}}'
normal() { awk -F, 'NR > 2 { x = $3 / 2.090967e-3 - 1; n++; s += x; q += x * x; t += x > 0.05; if (x > 0.15 || x < -0.15 || $4 != 0.004) bad++ }
    END { print n, s / n, sqrt(q / n), t / n; exit !(!bad && s / n < 3e-3 && s / n > -3e-3 && sqrt(q / n) > 0.047 && sqrt(q / n) < 0.051 && t / n > 0.14 && t / n < 0.175) }' chain.csv; }
ok "... have their width, at equal radii" normal
ok "random materials" chain '{bead: like, count: 3000, disorder: {material: [brass, 2 ptfe], seed: 1}}'
shares() { local brass; brass=$(grep -c ',brass,' chain.csv); [ "$brass" -gt 900 ] && [ "$brass" -lt 1100 ] && [ "$(grep -c ',ptfe,' chain.csv)" -eq $((3000 - brass)) ]; }
ok "... by their chances" shares
ok "trimers in random order" chain '{cell: [like, ptfe, brass], count: 6000, disorder: {shuffle: true, seed: 3}}'
# 1000 of each of 3! orders, with a standard deviation of 29; each cell keeps its beads.
orders() { awk -F, 'NR > 2 { cell = cell $2; if ((NR - 2) % 3 == 0) { count[cell]++; cell = "" } }
    END { for (order in count) { n++; if (count[order] < 900 || count[order] > 1100) bad++ } exit !(n == 6 && !bad) }' chain.csv; }
ok "... in all six alike" orders
ok "random cells of beads that differ" chain '{cell: [like, ptfe], count: 20, spins: random, seed: 1, disorder: {radius: normal 10 %}}'
ok "... are as random as before" bash -c "'$beadsim' --info scene.yaml | grep -q '(20), M = 0'"

# The same numbers as those of a material that is written out.
peaks() { printf '%s\n' "$1" 'outputs: [{table: peaks.csv}, {table: measures.csv, show: measures}]' >p.yaml && exits 0 "$beadsim" p.yaml -o "$2"; }
ok "a chain of such beads" peaks 'chain: {beads: [{bead: large-steel, count: 30}, {bead: large-steel, count: 3, mass: 1 g, radius: 3 mm, modulus: 70 GPa}, {bead: large-steel, count: 30}]}' short
ok "... and one with a material for them" peaks 'materials: {x: {mass: 1 g, radius: 3 mm, modulus: 70 GPa, poisson: 0.3}}
chain: {beads: [{bead: large-steel, count: 30}, {bead: x, count: 3}, {bead: large-steel, count: 30}]}' long
poisson=$("$beadsim" --list materials | sed -n 's/^large-steel .*poisson //p')
if [ "$poisson" = 0.3 ]; then
    ok "... have the same peaks" cmp short/peaks.csv long/peaks.csv
    ok "... and measures" cmp short/measures.csv long/measures.csv
fi
cat >run.yaml <<'YAML'
chain: {beads: [{cell: [large-steel, 2 aluminium], count: 8, taper: 5 %}, {bead: small-steel, sensor: A}]}
outputs: [{trajectory: run.h5}, {image: force.png, size: [640, 400]}, {plot: setup.pdf, show: setup}, {plot: cell.pdf, show: cell}]
YAML
ok "pictures and a trajectory" exits 0 "$beadreel" run.yaml -o run
ok "... which draws the same again" bash -c "'$beadreel' run/run.h5 -o again/force.png >/dev/null && cmp run/force.png again/force.png"
if command -v pdftotext >/dev/null; then
    ok "... one line for each material" test "$(pdftotext run/setup.pdf - | grep -c 'R = ')" -eq 3
    ok "... with the sizes that it has there" bash -c "pdftotext run/setup.pdf - | grep -Eq '^large steel, R = [0-9.]+.*mm to [0-9.]+.*mm, [0-9.]+.*g to [0-9.]+.*g$'"
else
    skip "pdftotext (poppler-utils)" "materials in drawings"
fi
sweep='{sweep: {magnetism: [0, 1], configurations: 2, seed: 1, measure: {peak: force, sensor: A}}, chain: {beads: [{cell: [large-steel, ptfe], count: 8, spins: random, disorder: {radius: normal 5 %}}, {bead: large-steel, sensor: A}]}, outputs: [{sweep: s.h5}, {table: t.csv}]}'
echo "$sweep" >sweep.yaml
ok "a sweep of them" exits 0 "$beadsim" sweep.yaml -o sweep
ok "... and one of its chains" exits 0 "$beadsim" sweep/s.h5 --configuration 1 -o sweep/one.csv

# wrong MESSAGE ENTRY
wrong() {
    printf 'chain: {beads: [%s]}\noutputs: [{table: chain.csv, show: chain}]\n' "$2" >wrong.yaml
    fails 2 "$beadsim" wrong.yaml -o none && says "wrong.yaml:1:" && says "$1" && [ ! -e none ]
}
ok "a bead without a radius" wrong 'chain.beads.0.taper: `100 %` is out of range; must be from -100 % to below 100 %' '{bead: brass, taper: 100 %}'
ok "beads too small" wrong 'chain.beads.0: gives a bead a radius of' '{bead: brass, radius: 1 mm, taper: {from: 1 mm, to: 1 nm}, disorder: {radius: uniform 0.1..0.5}, count: 9}'
ok "a taper of what is left, not of what is taken away" \
    wrong 'chain.beads.0: taper: each bead is 97 % smaller than the one before; bead 5 would' '{bead: brass, radius: 5 mm, count: 30, taper: 0.97}'
ok "a taper to nowhere" wrong 'chain.beads.0.taper.to: is missing' '{bead: brass, taper: {from: 1 mm}}'
ok "repeat without of" wrong 'chain.beads.0.repeat: belongs to `of`' '{bead: brass, repeat: 3}'
ok "count beside of" wrong 'chain.beads.0.count: is given beside `of`' '{of: [{bead: brass}], count: 3}'
ok "nothing to repeat" wrong 'chain.beads.0.of: is an empty list' '{of: []}'
ok "a sensor twice" wrong 'sensor: `a` is the name of another sensor' '{of: [{bead: brass, sensor: a}], repeat: 2}'
for range in 'uniform 3..1' 'uniform 0..1' 'uniform 1 mm..2 kg' 'uniform 1 mm..2' 'uniform 0.5..2 mm..3' 'uniform 1' 'gauss 3' 'normal 50 %' 'normal 1 mm' normal '[1, 2]' ''; do
    ok "disorder: $range" wrong 'chain.beads.0.disorder.radius: is ' "{bead: brass, disorder: {radius: $range}}"
done
positions() { "$beadsim" run.yaml -q -o . --set "chain={gap: 1 mm, beads: [{bead: brass, count: 2}, {bead: brass, gap: 3 mm, count: 2}]}" \
    --set 'outputs=[{table: gaps.csv, show: chain}]' >"$T/out" && awk -F, 'NR > 3 {printf "%.3f ", 1e3 * ($5 - last)} {last = $5}' gaps.csv; }
ok "gaps of a chain and of its beads add up" test "$(positions)" = "10.520 13.520 13.520 "
ok "nothing to stand between" wrong 'chain.beads.0.decorate: needs two or more' '{bead: brass, decorate: brass}'
ok "... in cells" wrong 'chain.beads.0.decorate: needs two or more' '{cell: [brass, brass], count: 3, decorate: brass}'
ok "none of a material" wrong 'chain.beads.0.cell.1: is none of them' '{cell: [brass, 0 ptfe]}'
ok "some of no material" wrong 'there is no material `ptf`; did you mean `ptfe`?' '{cell: [brass, 3 ptf]}'
ok "too many of a material" wrong 'cell.0: makes 999999 beads of a cell' '{cell: [999999 brass]}'
ok "too many that differ" wrong 'makes 1000000 beads that differ; a scene may have 100000' '{bead: brass, count: 1000000, taper: 1 %}'
ok "too many in groups" wrong 'makes the chain longer than 100000000 beads' '{of: [{bead: brass, count: 100000000}], repeat: 2}'
ok "too many groups" wrong 'of.0.repeat: makes 60000 entries' '{of: [{repeat: 30000, of: [{bead: brass}, {bead: ptfe}]}], repeat: 2}'
ok "random cells in a group" exits 0 "$beadsim" --plan run.yaml --set 'chain.beads=[{repeat: 2, of: [{cell: [brass, ptfe], count: 4, spins: random}]}]'
ok "... but not of a sweep" fails 2 "$beadsim" --plan sweep.yaml --set 'chain.beads.0={repeat: 2, of: [{cell: [brass, ptfe], count: 4, spins: random}]}'
ok "... which says why" says "holds random cells, which in a sweep must be entries of \`beads\` itself"
finish
