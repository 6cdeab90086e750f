#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sweeps over any keys of a scene: scaling, means over seeds, parts, single chains, mean images.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >v.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 12}]}
sweep:
  over: {chain.striker.velocity: [0.1 m/s, 300 mm/s, 1 m/s, 3 m/s]}
  measure: {beads: [6, 6]}
outputs:
  - {table: mean.csv}
  - {table: all.csv, show: configurations}
  - {sweep: s.h5}
YAML
column() { tail -n +2 "$1" | cut -d, -f"$2"; }
pixels() { python3 -c 'import re, sys; print(re.search(b"IDAT(.*?)(IEND|.{4}[it].Xt)", open(sys.argv[1], "rb").read(), re.S).group(1)[:-4].hex())' "$1"; }
is() { [ "$1" = "$2" ] || { echo "$1 is not $2"; return 1; }; }
within() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {d = a - b; exit !((d < 0 ? -d : d) <= t)}' || { echo "$1 is not $2 to $3"; return 1; }; }
ok "a sweep over the striker's velocity" exits 0 "$beadsim" v.yaml -o .
# Without damping and precompression F ~ v^(6/5), exactly.
ok "... forces scale with its power 6/5" within "$(column mean.csv 11 | head -n 1)" 1.2 1e-12
ok "... a row each" is "$(column all.csv 2 | tr '\n' ';')" "0.1 m/s;300 mm/s;1 m/s;3 m/s;"
one() { "$beadsim" v.yaml -o one.csv --set 'sweep={}' --set "chain.striker.velocity=$1" 2>/dev/null; }
ok "a chain of it, by itself" exits 0 "$beadsim" v.yaml --configuration 1 -o one.csv
ok "... has the same peak, to the last digit" is "$(grep '^6,' one.csv | cut -d, -f2)" "$(column all.csv 3 | sed -n 2p)"
ok "... and from the file" exits 0 "$beadsim" s.h5 --configuration 1 -o again.csv
ok "... the same" cmp one.csv again.csv
ok "its tables from the file" exits 0 "$beadsim" s.h5 -o mean2.csv
ok "... the same, too" cmp mean.csv mean2.csv
ok "the last of them" exits 0 "$beadsim" v.yaml --configuration 3 -o one.csv
ok "... has its peak" is "$(grep '^6,' one.csv | cut -d, -f2)" "$(column all.csv 3 | sed -n 4p)"
ok "there is none behind it" eval 'fails "1 2" "$beadsim" v.yaml --configuration 4 -o one.csv && says "must be a number from 0 to 3"'
ok "... nor before the first" eval 'fails "1 2" "$beadsim" v.yaml --configuration -1 -o one.csv'
parts() { local i; for i in 1 2 3; do "$beadsim" v.yaml -o parts --shard $i/3 >/dev/null || return 1; done; "$beadsim" --merge parts/s.*of3.h5 -o merged.h5; }
ok "in three parts, put together" parts
ok "... the same bytes" cmp merged.h5 s.h5
ok "on one thread the same" eval '"$beadsim" v.yaml -o alone --threads 1 >"$T/out" && cmp alone/s.h5 s.h5'
ok "--info names the keys" eval '"$beadsim" --info s.h5 | grep -qF "over 4 values of chain.striker.velocity"'
ok "... of a scene, too" eval '"$beadsim" --info v.yaml >"$T/out" && grep -qF "v.yaml: scene of a sweep" "$T/out" && grep -qF "over 4 values of chain.striker.velocity" "$T/out"'
ok "--plan, too" eval '"$beadsim" v.yaml --plan | grep -qF "over 4 of chain.striker.velocity"'

# Chains over keys: at least five are measured, or all; others are uncertain by the worst of them.
seeds() { "$beadsim" random.yaml -q -o . --set "sweep={over: {chain.beads.0.seed: 1..12}, measure: {beads: [40, 40]}}" \
    --set "outputs=[{table: $1.csv, show: configurations}, {table: $1-mean.csv}]" --set simulate.accuracy=$2; }
echo 'chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 20, spins: random}, {bead: large-steel, count: 10}]}' >random.yaml
ok "twelve random chains" seeds some 1e-5
ok "... to ten digits" seeds exact 1e-10
ok "... none says less than was asked" awk -F, 'NR > 1 {known += $7 > 0.999e-5 * $3} END {exit known != 12}' some.csv
ok "... forces are off by less" awk -F, 'FNR == 1 {next} NR == FNR {exact[$1] = $3; next}
    {d = $3 - exact[$1]; bad += (d < 0 ? -d : d) > $7; any += d != 0} END {print bad + 0, any; exit bad || any < 10}' exact.csv some.csv
ok "... so are their times, of which no more than ten times what was asked is said" awk -F, 'FNR == 1 {next} NR == FNR {exact[$1] = $4; next}
    {d = $4 - exact[$1]; bad += (d < 0 ? -d : d) > $8 || $8 < 0.999e-5 * $4 || $8 > 1e-4 * $4; any += d != 0} END {exit bad || any < 10}' exact.csv some.csv
ok "... and their means" awk -F, 'FNR == 1 {next} NR == FNR {exact[$1] = $4; next}
    {d = $4 - exact[$1]; bad += (d < 0 ? -d : d) > $(NF - 1) || !($(NF - 1) > 0); n++} END {exit bad || n < 1}' exact-mean.csv some-mean.csv

# Without precompression c ~ v^(1/5), exactly; samples follow pulses to six digits.
ok "a measure of them" exits 0 "$beadsim" v.yaml -o . --set 'chain.beads.0.count=40' --set 'outputs=[{table: c.csv, measure: front speed}]'
ok "... speeds scale with its power 1/5" within "$(column c.csv 11 | head -n 1)" 0.2 1e-6
ok "... in their unit" is "$(head -n 1 c.csv | cut -d, -f4)" mean_m/s
ok "a chain of it, measured by itself" exits 0 "$beadsim" v.yaml --configuration 1 -o m.csv --set 'chain.beads.0.count=40' --set 'outputs=[{table: m.csv, show: measures}]'
ok "... has the same speed" within "$(grep '^front speed,' m.csv | cut -d, -f2)" "$(sed -n 3p c.csv | cut -d, -f4)" 1e-3
# Each of these chains is run twice.
measure_of() { "$beadsim" measured.yaml -q -o . --set "outputs=[{table: $1.csv, measure: participation of forces}]" --set simulate.accuracy=$2; }
bars_of() { "$beadreel" measured.yaml -q -o . --set "outputs=[{plot: $1.svg, measure: participation of forces}]" --set simulate.accuracy=$2; }
cat >measured.yaml <<'EOF'
chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 40, spins: random, seed: 1}]}
simulate: {until: 4 ms}
sweep: {over: {chain.striker.velocity: [0.1 m/s, 0.2 m/s, 0.4 m/s]}}
EOF
ok "a measure of random chains, roughly" measure_of rough 1e-4
ok "... and to nine digits" measure_of right 1e-9
ok "... the table says how uncertain it is, and it is off by less" awk -F, 'FNR == 1 {next} NR == FNR {exact[$1] = $4; next}
    {d = $4 - exact[$1]; bad += (d < 0 ? -d : d) > $13 || !($13 > 0); n++} END {exit bad || n != 3}' right.csv rough.csv
ok "... and its slope" awk -F, 'FNR == 1 {next} NR == FNR {exact = $11; next}
    {d = $11 - exact; d = d < 0 ? -d : d; bad += !(d > 0 && d <= $14 && $14 < 10 * d)} END {exit bad}' right.csv rough.csv
ok "... to less than a hundredth where it is known well" awk -F, 'NR > 1 {bad += !($13 > 0 && $13 < 0.01 * $4)} END {exit bad}' right.csv
ok "the plot has bars where that is more" eval 'bars_of rough 1e-4 && bars_of right 1e-9 && [ "$(grep -c "<path" rough.svg)" = "$(($(grep -c "<path" right.svg) + 1))" ]'
ok "a measure that is none" eval 'fails "1 2" "$beadsim" v.yaml -o . --set "outputs=[{table: c.csv, measure: speed}]" && says "there is no \`speed\`"'
ok "... but nearly one" eval 'fails 2 "$beadsim" v.yaml -o . --set "outputs=[{table: c.csv, measure: front sped}]" && says "did you mean \`front speed\`?"'
ok "... of peaks of each chain" eval 'fails "1 2" "$beadsim" v.yaml -o . --set "outputs=[{table: c.csv, show: configurations, measure: front speed}]" && says "means of a measure"'

# Restitution of viscoelastic spheres, x = 0.04 at 1 m/s and half of it at 1/32: 1 - C1 x + C2 x^2 + (4/15) x^(5/2) - C3 x^3, good to
# x^(7/2) (Ramirez et al., Phys. Rev. E 60, 4465 (1999), without pull: test_damped.c).
cat >e.yaml <<'YAML'
materials: {unit: {mass: 1 g, radius: 5 mm, modulus: 1 GPa, poisson: 0.3}}
chain:
  law: {power: 1.5, coefficient: 1e9}
  striker: {bead: unit}
  beads: [{bead: unit}]
  damping: {coefficient: 480.45, exponent: 1, compression: 0.5}
simulate: {until: 1 ms, accuracy: 1e-9}
sweep: {over: {chain.striker.velocity: [0.03125 m/s, 1 m/s]}}
outputs: [{table: e.csv, measure: restitution}, {sheet: e.svg, size: [900, 600]}]
YAML
ok "a table of restitution against speed" exits 0 "$beadreel" e.yaml -o .
expansion() { awk -v x="$1" 'BEGIN {c = 1.15344; printf "%.17g", 1 - c * x + 0.6 * c * c * x * x + 4 / 15 * x ^ 2.5 - 0.483582 * x ^ 3}'; }
ok "... as the expansion in the speed has it" within "$(sed -n 3p e.csv | cut -d, -f4)" "$(expansion 0.04)" 1.3e-5
ok "... at a lower one, too" within "$(sed -n 2p e.csv | cut -d, -f4)" "$(expansion 0.02)" 1.2e-6

# Two keys and a seed: curves by radius, means over seeds. Twice the radius of all: eight times the mass.
cat >g.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 8, disorder: {radius: normal 3 %, seed: 1}}]}
sweep: {over: {chain.striker.velocity: [0.5 m/s, 1 m/s], chain.striker.mass: [2 g, 4 g], chain.beads.0.disorder.seed: 1..5}}
outputs: [{table: g.csv}, {table: each.csv, show: configurations}, {table: m.csv, against: chain.striker.mass}]
YAML
ok "a grid of three keys" exits 0 "$beadsim" g.yaml -o .
ok "... two curves of two points" is "$(column g.csv 2 | sort | uniq -c | tr -s ' \n' ' ')" " 2 mass 2 g 2 mass 4 g "
ok "... of five chains each" is "$(column g.csv 3 | sort -u)" 5
ok "... twenty in all" is "$(column each.csv 1 | wc -l)" 20
mean() { awk -F, -v v="$1" -v m="$2" '$2 == v && $3 == m {s += $5; n++} END {print s / n}' each.csv; }
ok "... their means" within "$(sed -n 2p g.csv | cut -d, -f4)" "$(mean '0.5 m/s' '2 g')" 1e-3
ok "... against another key" is "$(head -n 1 m.csv | cut -d, -f1)" chain.striker.mass
ok "a contact sheet of them" exits 0 "$beadreel" g.yaml -o . --set 'outputs=[{sheet: sheet.svg, size: [1400, 1000]}]'
ok "... with a row for each combination, and the seeds in it" eval '[ "$(grep -c "mass 2 g" sheet.svg)" -eq 2 ] && grep -q "velocity 0.5 m/s" sheet.svg && grep -q "#19" sheet.svg'
ok "pairs" exits 0 "$beadsim" g.yaml -o pairs --set sweep.combine=pairs --set 'sweep.over={chain.striker.velocity: [1 m/s, 2 m/s], chain.striker.mass: [2 g, 4 g]}'
ok "... are two chains" is "$(column pairs/each.csv 1 | wc -l)" 2

# A sweep over spins is one over a key, too: the same chains, so the same bits in the results of each, its table and its picture.
cat >spins.yaml <<'YAML'
sweep: {cells: 12, magnetism: all, configurations: 3, seed: 2009}
outputs: [{table: spins.csv, show: configurations}, {sweep: spins.h5}]
YAML
by_keys() {
    "$beadsim" spins.yaml -q -o . && python3 -c 'import csv
spins = [row["spins"] for row in csv.DictReader(open("spins.csv"))]
print("chain: {beads: [{cell: [large-steel, aluminium], count: 12, spins: \"111111111111\"}, {cell: [large-steel, aluminium], count: 15}]}")
print("sweep: {measure: {beads: [27, 29]}, over: {chain.beads.0.spins: [%s]}}" % ", ".join(f"\"{digits}\"" for digits in spins))
print("outputs: [{table: keys.csv, show: configurations}, {sweep: keys.h5}]")' >keys.yaml && "$beadsim" keys.yaml -q -o .
}
same_results() { # each data set but that of uncertainties: of spins some chains measure theirs, of keys others
    local part
    for part in peak_force peak_time peak_bead peak_open; do
        cmp <(h5dump -d /sweeps/0/$part -m %.17g spins.h5 | tail -n +2) <(h5dump -d /sweeps/0/$part -m %.17g keys.h5 | tail -n +2) || return 1
        cmp <(h5dump -d /sweeps/0/reference_$part -m %.17g spins.h5 | tail -n +2) <(h5dump -d /sweeps/0/reference_$part -m %.17g keys.h5 | tail -n +2) || return 1
    done
}
both_ways() { # FILE [OPTION]...
    local how
    for how in spins keys; do "$beadreel" $how.h5 --configuration 7 -q -o "$how-$1" "${@:2}" >"$T/out" 2>&1 || { cat "$T/out"; return 1; }; done
}
ok "a sweep over spins, by its own words and by keys" by_keys
# Ratios to the clean chain, whose force is off as well, and means in newtons.
of_spins() { "$beadsim" spins.yaml -q -o "$1" --set simulate.accuracy=$2 --set 'outputs=[{table: c.csv, show: configurations}, {table: m.csv}]'; }
known() { # FILE COLUMN UNCERTAINTY
    awk -F, -v c="$2" -v u="$3" 'FNR == 1 {next} NR == FNR {exact[FNR] = $c; next} {d = $c - exact[FNR]; d = d < 0 ? -d : d
        any += d > 0; bad += !(d <= $u && $u > 0 && $u < 1e-3 * $c)} END {exit bad || any < 3}' right/"$1" rough/"$1"
}
ok "over spins, roughly and to nine digits" eval 'of_spins rough 1e-4 && of_spins right 1e-9'
ok "... ratios are off by less than is said" known c.csv 3 11
ok "... and their times" known c.csv 5 10
ok "... means" known m.csv 3 17
ok "... in newtons" known m.csv 10 18
ok "... the plateau" known m.csv 13 19
ok "... has as many chains" is "$(column keys.csv 1 | wc -l)" 19
ok "... with the same forces, times and beads" cmp <(cut -d, -f4-6 spins.csv) <(cut -d, -f3-5 keys.csv)
if command -v h5dump >/dev/null; then ok "... in the files of results, too" same_results; else skip h5dump "files of sweeps"; fi
ok "... the same peaks of a chain" eval 'both_ways peaks.csv && cmp spins-peaks.csv keys-peaks.csv'
ok "... and the same picture of it" eval 'both_ways image.png --size 300x200 && cmp <(pixels spins-image.png) <(pixels keys-image.png)'

# A range instead of a list: its ends are those written, the rest at equal distances, or with equal ratios.
values() { "$beadsim" v.yaml -o range.csv --set "sweep.over={$1}" --set 'outputs=[{table: range.csv, show: configurations}]' >"$T/out" 2>&1 && column range.csv 2 | tr '\n' ';'; }
ok "a range of velocities" is "$(values 'chain.striker.velocity: {from: 100 mm/s, to: 0.5 m/s, count: 5}')" "100 mm/s;0.2 m/s;0.3 m/s;0.4 m/s;0.5 m/s;"
ok "... with equal ratios" is "$(values 'chain.striker.velocity: {from: 0.01 m/s, to: 10 m/s, count: 4, spacing: log}')" "0.01 m/s;0.1 m/s;1 m/s;10 m/s;"
ok "... forces scale with its power 6/5 there" within "$(awk -F, 'NR == 2 {a = $3} NR == 5 {print log($3 / a) / log(1000)}' range.csv)" 1.2 1e-6
ok "... downwards, without a unit" is "$(values 'chain.striker.velocity: {from: 3, to: 1, count: 3}')" "3;2;1;"
# Chains of unlike lengths: the bead in the middle of each, or its last, which nothing holds: half of the force of its contact.
lengths() { # SETTING...
    "$beadsim" v.yaml -o . --set 'sweep={over: {chain.beads.0.count: [5, 10, 21]}}' --set simulate.until=0.4ms --set chain.striker.velocity=1m/s --set 'outputs=[{table: n.csv, show: configurations}]' "$@"
}
printf 'chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 5}]}\nsimulate: {until: 0.4 ms}\noutputs: [{table: one.csv}]\n' >alone.yaml
of_bead() { "$beadsim" alone.yaml -q -o one.csv --set "chain.beads.0.count=$1" --set "outputs=[{table: one.csv, show: bead-peaks, beads: $2}]" >"$T/out" 2>&1 && tail -n 1 one.csv | cut -d, -f2; }
ok "chains of three lengths" exits 0 lengths
ok "... the bead in the middle of each" is "$(column n.csv 5 | tr '\n' ' ')" "3 5 11 "
ok "... and its force" is "$(column n.csv 3 | tr '\n' ' ')" "$(of_bead 5 3) $(of_bead 10 5) $(of_bead 21 11) "
ok "the last of each" exits 0 lengths --set 'sweep.measure={beads: last}'
ok "... and its force" is "$(column n.csv 3 | tr '\n' ' ')" "$(of_bead 5 last) $(of_bead 10 last) $(of_bead 21 last) "
ok "... or from a bead to the last" exits 0 lengths --set 'sweep.measure={beads: [4, last]}'
ok "a bead that the shortest does not have" eval 'fails 2 lengths --set "sweep.measure={beads: [7, last]}" && says "chain 0 has no bead 7, which is measured: its last is 5"'
ok "... and before any has run" eval 'fails 2 lengths --plan --set "sweep.measure={beads: [7, 7]}" && says "chain 0 has no bead 7"'
ok "a last that is before the first" eval 'fails 2 lengths --set "sweep.measure={beads: [last, 3]}" && says "is [last, 3]"'
ok "curves of the last of each" exits 0 lengths --set 'outputs=[{table: n.csv, show: sensors, contacts: last}]'
ok "... each with the same peak" within "$(awk -F, 'NR > 1 && $4 > top[$2] {top[$2] = $4} END {print top["count 10"] / top["count 21"]}' n.csv)" 1 1e-3
ok "... of a bead that is not there" eval 'fails 2 lengths --plan --set "outputs=[{table: n.csv, show: sensors, beads: 7}]" && says "a chain has no bead 7: its last is 5"'
ok "... a mean image has no axis for them" eval 'beadsim=$beadreel fails 2 lengths --plan --set "outputs=[{image: n.png}]" && says "chains have 6 and 11 beads; a mean needs"'
cat >d.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 8}], precompression: 10 N, wall: rigid, drive: {force: sine, amplitude: 1 N, frequency: 1 kHz}}
simulate: {until: 1 ms}
sweep: {over: {chain.drive.frequency: {from: 1 kHz, to: 4 kHz, count: 3, spacing: log}}}
outputs: [{table: d.csv, show: configurations}, {plot: d.svg}]
YAML
ok "... of frequencies" exits 0 "$beadreel" d.yaml -o .
ok "... in hertz" is "$(column d.csv 2 | tr '\n' ';')" "1 kHz;2000 Hz;4 kHz;"
ok "... along an axis of numbers" grep -q ">drive frequency (kHz)<" d.svg

cat >m.yaml <<'YAML'
chain: {beads: [{cell: [large-steel, aluminium], count: 6, spins: random, seed: 1}]}
sweep: {over: {chain.beads.0.seed: 1..4}}
outputs: [{image: mean.png, size: [300, 200]}, {image: deviation.png, show: deviation, size: [300, 200]}, {plot: p.svg}]
YAML
ok "mean images" exits 0 "$beadreel" m.yaml -o .
ok "... on one thread the same bytes" eval '"$beadreel" m.yaml -o single --threads 1 >"$T/out" && cmp single/mean.png mean.png'
ok "... of equal chains that of one" exits 0 "$beadreel" m.yaml -o equal --set 'sweep.over={chain.beads.0.seed: [1, 1, 1]}' --set 'outputs=[{image: mean.png, axes: false, size: [60, 40]}]'
ok "... pixel by pixel" eval '"$beadreel" m.yaml -o first --set "sweep.over={chain.beads.0.seed: [1]}" --set "outputs=[{image: mean.png, axes: false, size: [60, 40]}]" >"$T/out" && cmp <(tail -c 400 first/mean.png) <(tail -c 400 equal/mean.png)'
# Colours and their range are those of a run alone, whose image has more samples.
alike() { # FIELD [SETTING]
    local i; sed '/^sweep/d' m.yaml >alone.yaml
    sed '1i sweep: {over: {chain.beads.0.seed: [1, 1]}}' alone.yaml >equal.yaml
    for i in alone equal; do
        "$beadreel" $i.yaml -q -o $i --set simulate.until=0.3ms "${@:2}" --set "outputs=[{image: mean.png, field: $1, axes: false, size: [60, 40]}]" || return 1
        ffmpeg -v error -y -i $i/mean.png -f rawvideo -pix_fmt rgb24 $i.rgb || return 1
    done
    python3 -c 'import sys; a, b = (open(f, "rb").read() for f in sys.argv[1:]); sys.exit(len(a) != len(b) or max(abs(x - y) for x, y in zip(a, b)) > 8)' alone.rgb equal.rgb
}
if command -v ffmpeg >/dev/null; then
    ok "... and as that of a run without a sweep" alike force
    ok "... of a field with both signs" alike velocity
    ok "... most of it negative" alike velocity --set 'chain.start=[{bead: 12, velocity: -1 m/s}]'
else
    skip ffmpeg "means look like a run"
fi
# One chain of two hardly moves: the lower quartile on a third of the range looks like the upper.
quartile() { # WHICH RANGE
    "$beadreel" m.yaml -o "$1" --set 'sweep.over={chain.striker.velocity: [1e-6 m/s, 0.4 m/s]}' --set simulate.until=0.15ms \
        --set "outputs=[{image: q.png, show: $1-quartile, axes: false, size: [60, 40], range: [0, $2 N], scale: linear}]" >"$T/out" 2>&1
}
ok "quartiles between nothing and a wave are 1 and 3 quarters of it" eval 'quartile lower 10 && quartile upper 30 && is "$(pixels lower/q.png)" "$(pixels upper/q.png)"'
ok "... and not each other" eval 'quartile upper 10 && [ "$(pixels lower/q.png)" != "$(pixels upper/q.png)" ]'

refused() { # SETTING MESSAGE
    fails 2 "$beadsim" v.yaml --plan --set "$1" && says "$2"
}
ok "a key that no scene has" refused 'sweep.over={chain.strike.velocity: [1]}' '--set:1:21: chain.strike'
cat >wrong.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 12}]}
sweep:
  over:
    chain.striker.velocity: [0.1 m/s, 1e6 m/s, 1 m/s]
  measure: {beads: [6, 6]}
outputs: [{table: all.csv, show: configurations}]
YAML
value_is_shown() {
    fails 2 "$beadsim" wrong.yaml && says 'wrong.yaml:4:39: chain.striker.velocity: `1e6 m/s` is out of range'
}
ok "a value that no scene may have is shown in the file" value_is_shown
ok "a range to another unit" refused 'sweep.over={chain.striker.velocity: {from: 1 m/s, to: 2 N, count: 3}}' 'over.chain.striker.velocity.to: is `2 N`; must be a number with a unit of m/s'
ok "a range of ratios from 0" refused 'sweep.over={chain.striker.velocity: {from: 0 m/s, to: 2 m/s, count: 3, spacing: log}}' 'must be above 0'
ok "a range of one" refused 'sweep.over={chain.striker.velocity: {from: 1 m/s, to: 2 m/s, count: 1}}' 'from 2 to'
ok "a range without end" refused 'sweep.over={chain.striker.velocity: {from: 1 m/s, count: 4}}' 'to: is missing'
ok "a value that is wrong" refused 'sweep.over={chain.striker.velocity: [1 m/s, 2 N]}' 'chain.striker.velocity: '
ok "outputs are no keys" refused 'sweep.over={outputs.0.size: [1, 2]}' 'must begin with chain, simulate or materials'
ok "spins have no place beside it" refused sweep.magnetism=0.5 'sweep.magnetism: belongs to sweeps over spins'
ok "pairs need as many values" refused 'sweep={combine: pairs, over: {chain.striker.velocity: [1 m/s, 2 m/s], chain.striker.mass: [1 g]}}' 'must have as many'
# What an output cannot show is told by the plan, so before chains run for hours.
early() { # OUTPUT MESSAGE
    fails 2 "$beadreel" v.yaml --plan --set "outputs=[{$1}]" && says "$2"
}
ok "no such key along the axis" early 'table: t.csv, against: chain.wall' '--set:1:34: against: `chain.wall` is no key of the sweep; the first is `chain.striker.velocity`'
ok "... no such measure" early 'plot: t.png, measure: width' '--set:1:33: measure: there is no `width`'
ok "... no such bead" early 'plot: t.png, show: sensors, beads: [13]' '--set:1:46: beads: a chain has no bead 13: its last is 12'
ok "... no logarithm of a range" early 'plot: t.png, scale: log, range: [auto, -2]' 'range: ends at -2; must be above 0 with `scale: log`'
for output in 'plot: t.png' 'plot: t.png, measure: front speed' 'plot: t.png, show: sensors, beads: 3' 'image: t.png' 'sheet: t.png'; do
    ok "... no room for {$output}" early "$output, size: [60, 20]" ': size: 60 x 20 pixels '
done
printf '%s\n' 'sweep: {cell: [large-steel, aluminium], cells: 4, configurations: 2, magnetism: [0, 1]}' \
    'outputs: [{report: r.html, colormap: sepia}]' >spins.yaml
ok "... no such colours" fails 2 "$beadreel" spins.yaml --plan
for output in 'plot: t.png, size: [60, 20]' 'movie: t.mp4, colormap: sepia' 'table: t.csv, show: spectrum, beads: 3, every: 1'; do
    ok "... nor of one run: {$output}" fails 2 "$beadreel" v.yaml --plan --set 'sweep={}' --set simulate.until=1ms --set "outputs=[{$output}]"
done
# Values between two ends have digits enough to tell them apart in names, and no more; whole numbers are written out.
names() {
    "$beadsim" v.yaml -o n --set "sweep.over={$1}" --set 'materials.my={mass: 1 g, radius: 5 mm, modulus: 1 GPa, poisson: 0.3}' --set 'outputs=[{table: n.csv, show: sensors, contacts: 3}]' >log 2>&1 || { cat log; return 1; }
    awk -F, 'NR == 1 {for (c = 1; $c != "curve";) c++; next} {split($c, word, " "); print word[2]}' n/n.csv | sort -u | tr '\n' ' '
}
ok "names of values are short" is "$(names 'chain.striker.velocity: {from: 0.1 m/s, to: 2 m/s, count: 4, spacing: log}')" "0.1 0.2714 0.7368 2 "
ok "... but differ" is "$(names 'chain.striker.velocity: {from: 1 m/s, to: 1.0001 m/s, count: 3}')" "1 1.00005 1.0001 "
ok "... and whole numbers are whole" is "$(names 'materials.my.modulus: {from: 100000 MPa, to: 200000 MPa, count: 3}')" "100000 150000000000 200000 "
# Keys whose paths end alike are told apart, in curves, on axes and in sheets.
cat >alike.yaml <<'YAML'
chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 8}, {bead: large-steel, count: 8}]}
sweep: {over: {chain.beads.0.bead: [brass, aluminium], chain.beads.1.bead: [brass, aluminium], chain.striker.bead: [brass, aluminium], chain.striker.velocity: [1 m/s, 2 m/s]}, measure: {beads: last}}
outputs: [{table: alike.csv, against: chain.striker.velocity}, {sheet: alike.svg, size: [1280, 900]}, {plot: alike-plot.svg, against: chain.striker.velocity}]
YAML
ok "three keys that end alike" exits 0 "$beadreel" alike.yaml -o .
ok "... are told apart in tables" grep -qF '"beads 0 bead brass, beads 1 bead brass, striker bead aluminium"' alike.csv
ok "... and in plots" eval 'grep -qF "striker bead" alike-plot.svg && grep -qF "striker velocity" alike-plot.svg'
ok "... and on both axes of a plane" eval '"$beadreel" alike.yaml -o . --set "sweep.over={chain.beads.0.count: [4, 6, 8], chain.beads.1.count: [4, 6]}" --set "outputs=[{plot: alike-plane.svg, show: plane}]" >"$T/out" && grep -qF "beads 0 count" alike-plane.svg && grep -qF "beads 1 count" alike-plane.svg'
finish
