#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tables of bands and energies; names of curves at the ends of their lines; curves that go to the ends of a domain, read back from SVG.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >s.yaml <<'YAML'
materials: {unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}}
chain: {striker: {bead: unit, velocity: 1 mm/s}, beads: [{bead: unit, count: 12}]}
simulate: {until: 30 ms}
YAML
# Equal beads under 1 N: 2 sqrt(K / m) sin(q / 2) / (2 pi), with K = 3/2 A^(2/3) and A = 4/3 E* sqrt(R*) = 1/3 GPa m^(1/2).
cat >bands.yaml <<'YAML'
materials: {unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}}
chain: {precompression: 1 N, striker: {bead: unit, velocity: 1 mm/s}, beads: [{bead: unit, count: 12}]}
outputs: [{plot: bands.svg, show: bands}, {table: bands.csv, show: bands}]
YAML
ok "the table of bands" exits 0 "$beadsim" bands.yaml -o . --only bands.csv
awk 'BEGIN { pi = atan2(0, -1); k = 1.5 * (1e9 / 3) ^ (2 / 3); print "part,Hz"
             for (i = 0; i <= 1000; i++) printf "%.9g,%.9g\n", i / 1000, sqrt(k) / pi * sin(pi * i / 2000) }' >closed.csv
ok "the table has the band of equal beads" eval 'awk -F, "NR == FNR { last = \$2; next } FNR == 2 { exit !(\$3 == \"band\" && \$5 == 0 && (\$6 / last - 1) ^ 2 < 1e-16) }" closed.csv bands.csv'
# Bands and gaps are counted from 1, from the lowest on, and lie one behind the other; so do modes.
ok "a trimer's bands, and the modes of its chain" exits 0 "$beadsim" bands.yaml -o . --set 'chain.beads=[{cell: [large-steel, aluminium, ptfe], count: 7}]' \
    --set 'outputs=[{table: trimer.csv, show: bands}, {table: modes.csv, show: eigenmodes}]'
ok "... are counted" test "$(tail -n +2 trimer.csv | cut -d, -f1-4 | tr '\n' ' ')" = "1,21,band,1 1,21,gap,1 1,21,band,2 1,21,gap,2 1,21,band,3 "
ok "... in order, without a hole" eval 'tail -n +2 trimer.csv | awk -F, "NR > 1 {bad += \$5 != end} {bad += !(\$6 > \$5); end = \$6} END {exit !(NR == 5 && bad == 0)}"'
ok "... with the word gap for each in a plot" eval '"$beadreel" bands.yaml -q -o . --set "chain.beads=[{cell: [large-steel, aluminium, ptfe], count: 7}]" --only bands.svg && test "$(grep -o ">gap<" bands.svg | wc -l)" = 2'
ok "... modes, too" eval 'tail -n +2 modes.csv | awk -F, "{bad += \$1 != NR || \$2 < last; last = \$2} END {exit !(NR == 22 && bad == 0)}"'

# The first pulse has .99366 of the striker's 2 J.
cat >energy.yaml <<'YAML'
materials: {unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}}
chain: {striker: {bead: unit, velocity: 2 m/s}, beads: [{bead: unit, count: 12}]}
simulate: {until: 4 ms}
outputs: [{table: energy.csv, show: energy, beads: 5, uncertainty: false}]
YAML
ok "the table of energies" exits 0 "$beadsim" energy.yaml -o .
ok "... has past a bead most of what was put in" awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) c = $i == "past_bead_5_J" ? i : c } { last = $c } END { exit !((last / 2 - 0.99366) ^ 2 < 1e-8) }' energy.csv
# A heavy striker sends a train of pulses. The front's is the first, whose energy the measure has as an integral of force times velocity
# at one place; later pulses are behind it.
ok "energies of a train of pulses" exits 0 "$beadsim" energy.yaml -o . --set materials.heavy='{mass: 4 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}' \
    --set chain.striker.bead=heavy --set chain.beads.0.count=60 --set simulate.until=auto \
    --set 'outputs=[{table: place.csv, show: energy, parts: place, uncertainty: false}, {table: train.csv, show: measures, uncertainty: false}]'
train() { awk -F, 'NR == FNR { pulse = $1 == "pulse energy" ? $2 : pulse; next } FNR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
    $1 > 0.015 && $1 < 0.02 { rows++; f = $c["front_J"]; most = f > most ? f : most; bad += f < 0.995 * pulse || (f + $c["behind_J"] - 8) ^ 2 > 1e-12 }
    END { exit !(rows > 50 && bad == 0 && (most / pulse - 1) ^ 2 < 1e-10) }' train.csv place.csv; } # up to a tenth of its force
ok "... the front has that of the first" train
ok "theory of a sweep belongs to spreading" fails "1 2" "$beadreel" bands.yaml --plan --set 'outputs=[{plot: mean.svg, theory: true}]' \
    --set 'sweep={over: {chain.beads.0.count: [12, 14]}}'
# Names of curves are at the ends of their lines, in their colours; where two end in one place, or names are long, in a legend.
cat >ends.yaml <<'YAML'
chain: {equation: shock, epsilon: 0.5, length: 6.283185307179586, start: {simple-wave: 1, amplitude: 1}}
simulate: {until: 6}
outputs:
  - {plot: apart.svg, show: profiles, at: [0, 1, 2, 6]}
  - {plot: dark.svg, show: profiles, at: [0, 1, 2, 6], style: movie, size: [1280, 720]}
  - {plot: narrow.svg, show: profiles, at: [0, 1, 2, 6], size: [45 mm, 60 mm]}
  - {plot: together.svg, show: profiles, at: [0, 0.05, 2]}
YAML
ends() { python3 "$top/tests/ends.py" "$1"; }
at_ends() { ends "$1" | awk -v n="$2" '/:/ && ($2 < 0.3 || $2 > 1 || $3 ^ 2 > 0.04) { bad++; print } END { exit !(NR == n + 1 && $1 == n && bad == 0) }'; }
ok "profiles whose names have room, and others" exits 0 "$beadreel" ends.yaml -o .
ok "the names are at the ends of the lines" at_ends apart.svg 4
ok "... on dark pages" at_ends dark.svg 4
ok "... in a legend, where they would take a third of the width" test "$(ends narrow.svg)" = "0 names"
ok "... or two lines end in one place" test "$(ends together.svg)" = "0 names"
ok "contacts whose pulses are over have a legend" exits 0 "$beadreel" s.yaml -o . --only over.svg \
    --set 'outputs=[{plot: over.svg, show: sensors, contacts: [0, 1], time: [0, 30 ms]}]'
ok "... both forces end at 0" test "$(ends over.svg)" = "0 names" -a "$(grep -c '>contact [01]</tspan>' over.svg)" -eq 2
# Curves along strings and waves go to the ends of the domain: fixed ones do not move; joined ones have one value, here a cosine's 1, a sine's 0.
whole() { # CHAIN FIRST LAST VALUE [KEYS]
    exits 0 "$beadreel" --set "chain=$1" --set 'simulate.until=1' --set "outputs=[{plot: whole.svg, show: profiles, at: [0]${5:-}}]" whole.yaml -o . &&
        python3 "$top/tests/curves.py" whole.svg - | awk -F, -v a="$2" -v b="$3" -v value="$4" 'function off(x, y) { return (x - y) ^ 2 > 1e-6 }
            NR == 1 && (off($1, a) || off($2, value)) { bad++ } END { exit !(NR > 9 && bad == 0 && !off($1, b) && !off($2, value)) }'
}
echo 'chain: {}' >whole.yaml
ok "a string with fixed ends is drawn to them" whole '{equation: fput, points: 15, alpha: 0.25, start: {mode: 1}}' 0 16 0
ok "... a ring once around" whole '{equation: fput, points: 16, ends: periodic, alpha: 0.25, start: {mode: 1}}' 0 16 0
ok "... a wave between points on the ends of its domain" whole '{equation: kdv, length: 2, points: 64, low: -0.5, dispersion: 1e-3, start: {cosine: 1, amplitude: 1}}' -0.5 1.5 1
ok "... and between cells" whole '{equation: shock, length: 2, points: 64, epsilon: 0.5, start: {simple-wave: 1, amplitude: 0.5}}' 0 2 0 ', field: strain'
finish
