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
outputs: [{table: s.csv, show: spreading, every: 10 s, uncertainty: false}]
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
# The ready scene, with three of its eight chains: tests/stress/spreading.sh has them all. AB or BA, AA or BB dimers are its comment's, and tests/stress/spreading.sh's.
ready() { "$beadsim" martinez2016 -o . -q --set 'outputs=[{table: m.csv, show: spreading, uncertainty: false}]' \
    --set 'sweep.over={chain.beads.0.disorder.seed: 1..3}' >"$T/out" 2>&1; }
of_means() { tail -n 1 m.csv | cut -d, -f"$1"; }
ok "three disordered ones, in one command" ready
ok "... spread superdiffusively: gamma 1.77" within "$(of_means 10)" 1.77 0.02
ok "... and delocalise: eta .98" within "$(of_means 12)" 0.98 0.03
ok "... over a window that the table says" eval '[ "$(tail -n 1 m.csv | cut -d, -f14-15)" = 280,4000 ]'

# Means and standard errors are those of single chains, and beads draw in twos where they are asked to.
short() { # FILE OPTION...
    local file=$1
    shift
    "$beadsim" random.yaml -o . -q --set simulate.until=40 --set 'chain.start=[{bead: 30, velocity: 1 m/s}]' --set chain.beads.0.count=60 \
        --set "outputs=[{table: $file.csv, show: spreading}]" "$@" >"$T/out" 2>&1
}
ok "two short chains" short m --set 'sweep={over: {chain.beads.0.disorder.seed: [3, 5]}}'
for seed in 3 5; do ok "... chain $seed by itself" short $seed --set chain.beads.0.disorder.seed=$seed; done
ok "... at the same times" eval 'cut -d, -f1 3.csv | cmp - <(cut -d, -f1 m.csv)'
both() { echo "$(tail -n 1 3.csv | cut -d, -f"$1") $(tail -n 1 5.csv | cut -d, -f"$1")"; }
ok "... the mean of both moments" within "$(of_means 4)" "$(both 2 | awk '{printf "%.15g", ($1 + $2) / 2}')" 1e-9
ok "... its standard error, half their distance" within "$(of_means 5)" "$(both 2 | awk '{d = ($1 - $2) / 2; printf "%.15g", d < 0 ? -d : d}')" 1e-9
ok "... and the mean of both exponents" within "$(of_means 10)" "$(both 5 | awk '{printf "%.15g", ($1 + $2) / 2}')" 1e-9
# Uncertainties: those of a chain alone, and those of means where a curve has several.
ok "a sweep of one chain" short one --set 'sweep={over: {chain.beads.0.disorder.seed: [3]}}'
ok "... says what its own table says" eval '[ "$(cut -d, -f16-18 one.csv | tail -n +2)" = "$(cut -d, -f9-11 3.csv | tail -n +2)" ]'
ok "... and nothing, unless asked" short none --set 'sweep={over: {chain.beads.0.disorder.seed: [3]}}' \
    --set 'outputs=[{table: none.csv, show: spreading, uncertainty: false}]'
ok "... but the same numbers" cmp <(cut -d, -f1-15 one.csv) <(cut -d, -f1-15 none.csv)
ok "... with nothing in the five columns" eval '[ "$(cut -d, -f16-20 none.csv | tail -n +2 | sort -u)" = ,,,, ]'
ok "... of exponents that of the last, not of the worst until then" awk -F, 'FNR == 1 {next} NR == FNR {g = $12; e = $13; next}
    !($19 > 0 && $20 > 0 && $19 <= g && $20 <= e) {bad++} END {exit bad}' 3.csv one.csv
for seeds in '[3, 5]' 11..22; do # both; six of twelve, as at least five are
    ok "seeds $seeds" short some --set "sweep={over: {chain.beads.0.disorder.seed: $seeds}}"
    ok "... to ten digits" short exact --set "sweep={over: {chain.beads.0.disorder.seed: $seeds}}" --set simulate.accuracy=1e-10
    ok "... means are off by less than is said" awk -F, 'function off(c) {d = $c - exact[FNR, c]; return d < 0 ? -d : d}
        FNR == 1 {next} NR == FNR {for (c = 4; c <= 12; c += 2) exact[FNR, c] = $c; next}
        {for (c = 4; c <= 12; c += 2) {bad += off(c) > $(14 + c / 2) + 1e-10 * $c; any += off(c) > 0}}
        END {print bad + 0, any; exit bad || any < 400}' exact.csv some.csv
done
ok "beads that draw alike" short alike --set chain.beads.0.disorder.alike=2 --set 'outputs=[{table: alike.csv, show: chain}]'
ok "... in twos" awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) c = $i == "radius_m" ? i : c}
    NR > 2 && NR % 2 == 0 && $c != last {bad = 1} NR > 2 {last = $c; n[$c]++} END {exit bad || n["1"] + n["0.7"] != 60 || n["1"] < 15 || n["0.7"] < 15}' alike.csv

# The plot's legend has the exponents of the table.
# Powers of time have logarithmic times: as close as motion needs at first, 32 more each time that it doubles, the end.
ok "a table of few times" eval '[ "$(wc -l <3.csv)" -lt 400 ] && [ "$(tail -n 1 3.csv | cut -d, -f1)" = 40 ]'
ok "... of which 32 are in the last half" eval '[ "$(awk -F, "NR > 1 && \$1 > 20" 3.csv | wc -l)" -le 33 ] && [ "$(awk -F, "NR > 1 && \$1 > 20" 3.csv | wc -l)" -ge 16 ]'
cat >ballistic.yaml <<'YAML'
materials: {one: {density: 0.238732414637843 kg/m3, radius: 1 m, modulus: 2.121320343559643 Pa, poisson: 0}}
chain: {striker: {bead: one}, start: [{bead: 300, velocity: 1 m/s}], beads: [{bead: one, count: 600}]}
simulate: {until: 300 s}
outputs: [{table: s.csv, show: spreading, every: 0.1 s}, {plot: s.svg, show: spreading, every: 0.1 s}]
YAML
ok "a plot of an ordered chain" exits 0 "$beadreel" ballistic.yaml -o .
ok "... says the table's exponent of a wave, 2" eval 'within "$(last 5)" 2 0.03 && grep -qF "exponent $(printf %.3f "$(last 5)")" s.svg'
ok "the plot of a sweep of it" exits 0 "$beadreel" ballistic.yaml -o . --set 'sweep={over: {chain.start.0.velocity: [1 m/s]}}' --set 'outputs=[{table: m.csv, show: spreading}, {plot: m.svg, show: spreading}]'
ok "... too" eval 'within "$(of_means 10)" 2 0.03 && grep -qF "exponent $(printf %.3f "$(of_means 10)")" m.svg'
ok "equations have no beads" eval 'fails 2 "$beadsim" fput --plan --set "outputs=[{table: s.csv, show: spreading}]"'
finish
