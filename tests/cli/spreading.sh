#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How energy spreads from one bead: ballistic without disorder, superdiffusive with it, as A. J. Martinez and others found
# (Phys. Rev. E 93, 022902, 2016). The numbers are those of an independent program: spheres of radius 1 and .7, m = R^3,
# A = sqrt(2 R1 R2/(R1 + R2)), velocity 1 on the middle of 8000 beads, fitted from 7 % of t = 4000 on, 8 configurations.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
scene() { # BEADS
    cat <<YAML
materials:
  one: {density: 0.238732414637843 kg/m3, radius: 1 m, modulus: 2.121320343559643 Pa, poisson: 0}
  small: {density: 0.238732414637843 kg/m3, radius: 0.7 m, modulus: 2.121320343559643 Pa, poisson: 0}
chain: {striker: {bead: one}, start: [{bead: 4000, velocity: 1 m/s}], beads: [$1]}
simulate: {until: 4000 s, accuracy: 1e-5}
outputs: [{table: s.csv, show: spreading, every: 10 s}]
YAML
}
last() { tail -n 1 s.csv | cut -d, -f"$1"; }
within() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {d = a - b; exit !((d < 0 ? -d : d) <= t)}' || { echo "$1 is not $2 to $3"; return 1; }; }
scene '{bead: one, count: 8000}' >ordered.yaml
ok "an ordered chain" exits 0 "$beadsim" ordered.yaml -o . -q
ok "... begins with all energy in one bead" eval '[ "$(sed -n 2p s.csv | cut -d, -f2-4)" = 0,1,0 ]'
ok "... spreads as a wave: gamma 2" within "$(last 5)" 2.002 0.005
ok "... that stays as narrow: eta 0" within "$(last 7)" 0 0.03
# A bead struck with V = 1 sends on a solitary wave of V = .68163, at c = .907470 V^(1/5) beads in each unit of time.
ok "... whose front is a solitary wave" within "$(last 4)" "$(awk 'BEGIN {print 4000 * 0.907470 * 0.68163 ^ 0.2}')" 5
scene '{bead: one, count: 8000, disorder: {material: [one, small], seed: 1}}' >random.yaml
eight() {
    local seed
    for seed in 1 2 3 4 5 6 7 8; do
        "$beadsim" random.yaml -o . -q --set chain.beads.0.disorder.seed=$seed >"$T/out" || return 1
        tail -n 1 s.csv
    done >all
}
ok "eight disordered ones" eight
mean() { awk -F, -v c="$1" '{s += $c} END {print s / NR}' all; }
ok "... spread superdiffusively: gamma 1.77" within "$(mean 5)" 1.77 0.02
ok "... and delocalise: eta .98" within "$(mean 7)" 0.98 0.03
ok "equations have no beads" eval 'fails 2 "$beadsim" fput --plan --set "outputs=[{table: s.csv, show: spreading}]"'
finish
