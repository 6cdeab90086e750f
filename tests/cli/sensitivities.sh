#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tables of the derivatives of peaks, and of what the tolerances of beads make of them.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

cat >pair.yaml <<'YAML'
materials:
  loose: {modulus: 193 GPa, poisson: 0.3, radius: 4.76 mm, mass: 3.63 g, tolerance: {radius: 0.1 %, modulus: 2 %}}
  small: {modulus: 193 GPa, poisson: 0.3, radius: 2.38 mm, mass: 0.45 g}
chains:
  - name: long
    striker: {bead: loose, velocity: 0.443 m/s}
    beads: [{cell: [loose, small], spins: "1101001011"}, {bead: small, sensor: last}, {bead: loose, count: 5}]
  - name: short
    striker: {bead: loose, velocity: 0.443 m/s}
    beads: [{bead: loose, count: 12}]
    wall: rigid
outputs:
  - {table: given.csv, show: sensitivities, contacts: [18, 4, 4]}
  - {table: meant.csv, show: sensitivities}
  - {table: peaks.csv, show: peaks, uncertainty: false}
  - {table: beads.csv, show: bead-peaks}
  - {table: chain.csv, show: chain}
YAML
# rows FILE CHAIN CONTACT
rows() { awk -F, -v chain="$2" -v contact="$3" '$1 == chain && $2 == contact' "$1" | wc -l; }
# number FILE CHAIN INDEX COLUMN : of a table of peaks
number() { awk -F, -v chain="$2" -v index_="$3" -v column="$4" '$1 == chain && $2 == index_ {print $column}' "$1"; }
# near X Y PART
near() { awk -v x="$1" -v y="$2" -v part="$3" 'BEGIN {d = x - y; if (d < 0) d = -d; exit !(x != "" && y > 0 && d <= part * y)}'; }
# deviation CHAIN CONTACT : of the beads' tolerances, from the table of sensitivities
deviation() {
    awk -F, -v chain="$1" -v contact="$2" 'NR == FNR {material[$1 "," $2] = $3; next}
        $1 == chain && $2 == contact && material[chain "," $5] == "loose" {
            r = 0.001 * (4.76e-3 * $7 + 3 * 3.63e-3 * $6); e = 0.02 * 193e9 * $8; sum += r * r + e * e}
        END {printf "%.9g\n", sqrt(sum)}' chain.csv given.csv
}

ok "a run" exits 0 "$beadsim" pair.yaml -o .
ok "the columns" grep -qx 'chain,contact,peak_force_N,time_s,bead,by_mass_N_per_kg,by_radius_N_per_m,by_modulus_N_per_Pa,by_striker_velocity_N_s_per_m\(,by_[a-zA-Z_]*_uncertainty\)\{4\}' given.csv
ok "... whose uncertainties are known" test "$(tail -n +2 given.csv | cut -d, -f10-13 | grep -cvE '^([0-9.e-]+,){3}([0-9.e-]+)?$')" -eq 0
ok "a row for each bead, once" test "$(rows given.csv long 4)" -eq 27
ok "... of the other contact" test "$(rows given.csv long 18)" -eq 27
ok "... of the other chain" test "$(rows given.csv short 4)" -eq 13
ok "... not of a contact that it has not" test "$(rows given.csv short 18)" -eq 0
ok "the contacts of a sensor are meant where none are named" test "$(rows meant.csv long 20)$(rows meant.csv long 21)" = 2727
ok "... else the last with a maximum" test "$(cut -d, -f1,2 meant.csv | grep short | sort -u)" = "$(awk -F, '$1 == "short" && $5 == "" {last = $1 "," $2} END {print last}' peaks.csv)"
ok "... and no others" test "$(cut -d, -f1,2 meant.csv | sort -u | wc -l)" -eq 4
ok "peaks are those of the table of peaks" test "$(number given.csv long 4 3 | head -n 1)" = "$(number peaks.csv long 4 3)"
ok "only the striker has a velocity" test "$(awk -F, 'NR > 1 && $9 != "" {print $5}' given.csv | sort -u)" = 0
ok "... F goes as v^(6/5)" near "$(awk -F, '$1 == "long" && $2 == 18 && $5 == 0 {printf "%.12g", 0.443 * $9 / $3}' given.csv)" 1.2 1e-7
ok "peaks have a deviation" grep -qx 'chain,contact,peak_force_N,time_s,state,deviation_N' peaks.csv
ok "... beads have it beside their uncertainty" grep -qx 'chain,bead,peak_force_N,time_s,state,uncertainty_N,deviation_N,time_s_uncertainty' beads.csv
ok "... that follows from the derivatives" near "$(number peaks.csv long 18 6)" "$(deviation long 18)" 3e-4
ok "... in the other chain" near "$(number peaks.csv short 4 6)" "$(deviation short 4)" 3e-4
ok "... of the mean of two contacts less than of one" near "$(number beads.csv short 5 7)" "$(number peaks.csv short 4 6)" 0.5
ok "... every peak of a run that ends by itself has one" test "$(awk -F, 'NR > 1 && !($6 > 0)' peaks.csv | wc -l)" -eq 0
# A wall whose modulus is known to 2 %: the difference of two runs tells what the last force makes of it.
cat >wall.yaml <<'YAML'
materials: {w: {modulus: 90 GPa, poisson: 0.3, radius: 1 mm, mass: 1 g, tolerance: {modulus: 2 %}}}
chain: {beads: [{bead: large-steel, count: 3}], wall: w}
simulate: {accuracy: 1e-9}
outputs: [{table: wall.csv, show: peaks, uncertainty: false}]
YAML
last() { awk -F, -v column="$1" 'END {print $column}' wall.csv; }
with_modulus() { "$beadsim" wall.yaml -o . --set materials.w.modulus="$1 GPa" >/dev/null && last 2; }
ok "a wall with a tolerance" exits 0 "$beadsim" wall.yaml -o .
deviates=$(last 5)
ok "... makes peaks deviate" near "$deviates" "$(awk -v a="$(with_modulus 89.982)" -v b="$(with_modulus 90.018)" 'BEGIN {printf "%.12g", (b - a) / 0.036 * 0.02 * 90}')" 1e-6
# Two equal balls, that meet again after one has flown to an anvil and back: F1 = A^(2/5) m^(3/5) v^(6/5) with 1/m = 1/m0 + 1/m1, and F2 the
# same with v (3 m0 - m1) / (m0 + m1) for v. By ln R0 and ln R1 their logarithms change by 1, 1 and by 23/5, -13/5; the larger of two normal
# deviates of equal means has the variance (2 + 27.92) / 2 - 25.92 / 2 pi (Clark). The anvil's force, v 2 m0 / (m0 + m1): 9/5 and 1/10.
cat >twice.yaml <<'YAML'
materials:
  ball: {modulus: 200 GPa, poisson: 0.3, radius: 5 mm, density: 7800, tolerance: {radius: 0.1 %}}
  anvil: {modulus: 200 GPa, poisson: 0.3, radius: 5 mm, mass: 1e6 kg}
chain: {striker: {bead: ball, velocity: 1 m/s}, gap: 0.1 mm, beads: [{bead: ball}, {bead: anvil}]}
simulate: {until: 0.5 ms, accuracy: 1e-9}
outputs:
  - {table: twice.csv, show: peaks, uncertainty: false}
  - {table: flown.csv, show: sensitivities, contacts: 1, uncertainty: false}
YAML
ok "beads that fly" exits 0 "$beadsim" twice.yaml -o .
ok "... remember who struck them" near "$(awk -F, 'NR == 2 {printf "%.12g", $8 / $2}' flown.csv)" 1.2 1e-6
ok "... and how heavy it was" near "$(awk -F, 'NR == 2 {printf "%.12g", 7800 * 4 / 3 * 3.141592653589793 * 0.005 ^ 3 * $5 / $2}' flown.csv)" 0.6 1e-6
ok "... in deviations, too" near "$(awk -F, 'NR == 3 {printf "%.12g", $5 / $2}' twice.csv)" 1.8027756e-3 1e-5
ok "of two peaks either may be the largest" near "$(awk -F, 'NR == 2 && $4 == "rival" {printf "%.12g", $5 / $2}' twice.csv)" 3.2916106e-3 1e-4
ok "other instructions" exits 0 "$beadsim" pair.yaml -o portable --instructions portable --threads 1
ok "... the same bits" cmp given.csv portable/given.csv
ok "... of deviations" cmp peaks.csv portable/peaks.csv

ok "an end in the scene" exits 0 "$beadsim" pair.yaml -o ended --set 'simulate.until=0.2 ms'
ok "... is the same for all: forces at the end have deviations" test "$(awk -F, '$5 == "open"' ended/peaks.csv | grep -c nan)" -eq 0
ok "--plan" exits 0 "$beadsim" --plan pair.yaml
ok "... tells what the tables take" prints 'sensitivities of'
ok "without tolerances" exits 0 "$beadsim" pair.yaml -o plain --set 'materials.loose.tolerance={}' --only peaks.csv
ok "... tables are as before" grep -qx 'chain,contact,peak_force_N,time_s,state' plain/peaks.csv
finish
