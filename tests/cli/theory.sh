#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The line of the front that theory predicts, read back from SVG: where it begins, as fast as the closed form has it, and near the wave
# of the run.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {d = a / b - 1; exit !(a != "" && (d < 0 ? -d : d) <= t)}' || { echo "$1 is not $2 to $3"; return 1; }; }
refused() { fails 2 "$beadreel" "$@" --plan && says ': theory: '; }
scene() { # BEADS MASS, of the second material
    cat <<YAML
materials: {one: {radius: 0.5 m, mass: 1 kg, modulus: 1 GPa, poisson: 0}, two: {radius: 0.5 m, mass: $2 kg, modulus: 1 GPa, poisson: 0}}
chain: {striker: {bead: one, velocity: 1 m/s}, beads: [$1]}
outputs:
  - {image: line.svg, field: velocity, theory: true}
  - {image: contacts.svg, field: contact-force, time: [10 ms, 40 ms], beads: [10, 70], theory: true}
  - {table: peaks.csv, show: peaks}
YAML
}
line() { python3 "$top/tests/curves.py" "$1" - >points; } # ms, beads
slope() { awk -F, 'NR == 1 {x = $1; y = $2} END {printf "%.9g", 1e3 * ($2 - y) / ($1 - x)}' points; }
bead_at() { awk -F, -v t="$1" 'NR == 1 {x = $1; y = $2} END {printf "%.9g", y + (t - x) * ($2 - y) / ($1 - x)}' points; }
# beads/s of the crests from contact 30 to 60; with A = 1/3 GPa m^(1/2), of the largest force of both there, and the mean mass
crests() { awk -F, '$1 == 30 {t = $3} $1 == 60 {printf "%.9g", 30 / ($3 - t)}' peaks.csv; }
closed() { awk -F, -v m="$1" '$1 > 60 && $1 < 80 && $2 > f {f = $2} END {printf "%.9g", sqrt(0.8 / m) * (1e9 / 3) ^ (1 / 3) * f ^ (1 / 6)}' peaks.csv; }

scene '{bead: one, count: 100}' 1 >equal.yaml
ok "a line over equal beads" exits 0 "$beadreel" equal.yaml -o .
ok "... can be read" line line.svg
ok "... begins at the first bead with the wave" near "$(bead_at 0)" 1 0.1
ok "... as fast as Nesterenko's wave" near "$(slope)" "$(closed 1)" 1e-3
# The wave of beads: .905516 F^(1/6) where that of long waves is sqrt(.8) F^(1/6).
ok "... which beads are ahead of by 1.2 %" near "$(crests)" "$(awk -v v="$(slope)" 'BEGIN {print v * 0.905516 / sqrt(0.8)}')" 4e-3
ok "... and says so" grep -q 'theory: Nesterenko' line.svg
ok "over part of chain and time" line contacts.svg
ok "... it is the same line" near "$(slope)" "$(closed 1)" 1e-3
ok "... of contacts, half a bead later" near "$(bead_at 20)" "$(awk -v v="$(closed 1)" 'BEGIN {print 0.5 + 0.02 * v}')" 3e-3
# Dimers that pass on their wave as it is (K. R. Jayaprakash and others, Phys. Rev. E 83, 036606, 2011: eps = .3428).
scene '{cell: [one, two], count: 50}' 0.3428 >dimers.yaml
ok "a line over dimers" exits 0 "$beadreel" dimers.yaml -o .
ok "... can be read" line line.svg
ok "... as fast as a wave of the mean mass" near "$(slope)" "$(closed 0.6714)" 1e-3
ok "... near that of beads" near "$(crests)" "$(slope)" 0.025
ok "... and says so" grep -q 'theory: long waves of dimers' line.svg
for other in 'chain.precompression=1 N' 'chain.gap=1 um' 'chain.beads.0.spring=300 N/m' 'chain.law={power: 2, coefficient: 1e9}' \
    'chain.start=[{bead: last, velocity: -1 m/s}]' 'chain.beads=[{bead: one, count: 5}]' 'chain.beads=[{bead: one, count: 30}, {bead: two, count: 30}]'; do
    ok "no line: $other" refused dimers.yaml --set 'outputs=[{image: no.png, theory: true}]' --set "$other" --set simulate.until=10ms
done
# In films test_theory.c follows the line; here, that they have it.
ok "a film has the line, too" exits 0 "$beadreel" dimers.yaml --set 'outputs=[{movie: line.mp4, theory: true, size: [320, 240], fps: 5, duration: 2 s}]' -o .
ok "... not without an image" fails 2 "$beadreel" dimers.yaml --set 'outputs=[{movie: no.mp4, theory: true, views: [profile]}]'
ok "... and says why" says 'no spacetime to show it over'
finish
