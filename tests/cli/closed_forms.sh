#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Two equal beads meet: every table of one run beside the closed form of a Hertzian collision, which exchanges their velocities.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >s.yaml <<'YAML'
materials: {unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0, yield: 250 MPa}}
chain: {striker: {bead: unit, velocity: 1 m/s}, beads: [{bead: unit, sensor: it}]}
simulate: {accuracy: 1e-10, until: 9 ms}
outputs:
  - {table: peaks.csv, show: peaks}
  - {table: beads.csv, show: bead-peaks}
  - {table: chain.csv, show: chain}
  - {table: measures.csv, show: measures}
  - {table: energy.csv, show: energy, every: 1 ms}
  - {table: sensors.csv, show: sensors, contacts: 0, every: 1 us}
  - {table: extremes.csv, show: extremes, field: contact-force, every: 1 us}
  - {table: force.csv, show: profiles, field: force, at: [0.2 ms]}
  - {table: contact-force.csv, show: profiles, field: contact-force, at: [0.2 ms]}
  - {table: compression.csv, show: profiles, field: compression, at: [0.2 ms, 8 ms]}
  - {table: most.csv, show: extremes, field: compression, every: 1 us}
  - {trajectory: run.h5, fields: [displacement], every: 1 us}
  - {table: velocity.csv, show: profiles, field: velocity, at: [0, 0.2 ms, 8 ms]}
  - {table: displacement.csv, show: profiles, field: displacement, at: [0.2 ms, 8 ms]}
  - {table: profile-of-energy.csv, show: profiles, field: energy, at: [0.2 ms, 8 ms]}
YAML
# E* = 1 GPa / 2, R* = R / 2: A = 4/3 E* sqrt(R*); (1/2) m* v^2 = (2/5) A d^(5/2) with m* = m / 2; duration 2.943 d / v.
eval "$(awk 'BEGIN {
    A = 4 / 3 * 0.5e9 * sqrt(0.25); d = exp(0.4 * log(5 * 0.5 / (4 * A))); F = A * exp(1.5 * log(d))
    gamma_04 = 2.2181595437576882; gamma_09 = 1.0686287021193193 # Gamma(.4), Gamma(.9)
    T = 0.8 * sqrt(atan2(0, -1)) * gamma_04 / gamma_09 * d
    printf "A=%.15g d=%.15g F=%.15g duration=%.15g bar=%.15g\n", A, d, F, T, 1 / sqrt(1e9 / (1 / (4 / 3 * atan2(0, -1) * 0.125)))
}')"
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {d = a - b; if (b != 0) d /= b; exit !((d < 0 ? -d : d) <= t)}' || { echo "$1 is not $2 to $3"; return 1; }; }
zero() { awk -v a="$1" -v t="$2" 'BEGIN {exit !(a != "" && (a < 0 ? -a : a) <= t)}' || { echo "$1 is not 0 to $2"; return 1; }; }
at() { sed -n "$(($2 + 1))p" "$1.csv" | cut -d, -f"$3"; } # TABLE ROW COLUMN
measure() { awk -F, -v name="$1" '$1 == name {print $2}' measures.csv; }
ok "two beads" exits 0 "$beadsim" s.yaml -o .
ok "stiffness in the table of the chain" near "$(at chain 1 7)" "$A" 1e-14
ok "peak of the contact" near "$(at peaks 1 2)" "$F" 1e-9
ok "... half-way through the collision" near "$(at peaks 1 3)" "$(awk -v t="$duration" 'BEGIN {printf "%.15g", t / 2}')" 1e-6
ok "peak of each bead: the mean of both its contacts" near "$(at beads 1 2)" "$(awk -v f="$F" 'BEGIN {printf "%.15g", f / 2}')" 1e-9
ok "... the other's" near "$(at beads 2 2)" "$(at beads 1 2)" 1e-12
ok "largest force over time" near "$(tail -n +2 extremes.csv | cut -d, -f2 | sort -g | tail -n 1)" "$F" 1e-5
ok "... in the sensor's curve" near "$(tail -n +2 sensors.csv | cut -d, -f2 | sort -g | tail -n 1)" "$F" 1e-5
impulse() { tail -n +2 sensors.csv | awk -F, '{s += $2} END {printf "%.15g", s * 1e-6}'; }
ok "... whose integral is the momentum" near "$(impulse)" 1 1e-6
ok "measured: compression" near "$(measure "striker's compression")" "$d" 3e-5 # by samples
ok "... and duration" near "$(measure "striker's contact time")" "$duration" 1e-6
ok "... strike / bar speed: v sqrt(density / modulus)" near "$(measure 'strike / bar speed')" "$bar" 1e-12
ok "... participation of energies: one bead" near "$(measure 'participation of energies')" 1 1e-9
ok "... clean index: all energy in one bead" near "$(measure 'clean index')" 1 1e-9
ok "... front arrival: no force before, at once after the contact" zero "$(measure 'front arrival')" 1e-5
ok "velocities are exchanged" near "$(at velocity 6 3)" 1 1e-9
ok "... the striker rests" zero "$(at velocity 5 3)" 1e-9
ok "displacements: the centre of mass goes on, v t" near "$(awk -F, 'NR > 1 && $1 > 7e-3 {s += $3} END {print s}' displacement.csv)" 8e-3 1e-12
# At .2 ms the beads still touch: F = A (u_0 - u_1)^(3/2), half of it felt by each; energy kept.
wanted() { awk -F, -v a="$A" 'NR == 2 {u = $3} NR == 3 {d = u - $3; printf "%.15g", a * d * sqrt(d)}' displacement.csv; }
ok "force of the contact follows from displacements" near "$(at contact-force 1 3)" "$(wanted)" 1e-11
ok "... a bead's is half of it" near "$(at force 1 3)" "$(awk -v f="$(wanted)" 'BEGIN {printf "%.15g", f / 2}')" 1e-11
ok "compression is (F / A)^(2/3)" near "$(at compression 1 3)" "$(awk -F, -v a="$A" 'NR == 2 {printf "%.15g", exp(2 / 3 * log($3 / a))}' contact-force.csv)" 1e-11
ok "... none where beads are apart" zero "$(at compression 2 3)" 0
ok "... at most that of the closed form" near "$(tail -n +2 most.csv | cut -d, -f2 | sort -g | tail -n 1)" "$d" 1e-5
ok "... from a stored run" exits 0 "$beadsim" run.h5 -o again.csv --set 'outputs=[{table: again.csv, show: extremes, field: compression, every: 1 us}]'
ok "... the same" cmp <(cut -d, -f1-3 most.csv) <(cut -d, -f1-3 again.csv)
# With damping the force has two parts, A d^p and gamma D^q: compressions are those of the beads' places all the same, (F / A)^(1/p) the
# other way round only where nothing moves.
damped() { # DAMPING LAW
    "$beadsim" s.yaml -q -o damped --set "chain.damping={$1}" --set "chain.law=$2" --set simulate.accuracy=1e-8 \
        --set 'outputs=[{table: u.csv, show: sensors, beads: [0, 1], field: displacement, every: 20 us}, {table: d.csv, show: sensors, contacts: 0, field: compression, every: 20 us}, {table: f.csv, show: sensors, contacts: 0, every: 20 us}]' || return 1
    paste -d, damped/{u,d,f}.csv | awk -F, -v a="$3" -v p="$4" -v damped="${5:-}" 'NR > 1 {
        d = $2 - $3 > 0 ? $2 - $3 : 0; off = $7 - d; bad = bad || off * off > 1e-30; most = d > most ? d : most
        law = $7 > 0 ? a * exp(p * log($7)) : 0; if ((law - $10) ^ 2 > (1e-9 * law) ^ 2) other = 1}
        END {exit bad || most < 1e-5 || (damped != "") != (other + 0)}'
}
ok "... of the power law, (F / A)^(1/p)" damped "coefficient: 0" "{power: 2.5, coefficient: 1e9}" 1e9 2.5
ok "... of damped contacts, which lag behind the force" damped "coefficient: 1e3, exponent: 1" "{power: 1.5, coefficient: 3e8}" 3e8 1.5 lags
# Of bead and half its contact's (2/5) A d^(5/2) each.
energy() { paste -d, displacement.csv velocity.csv | awk -F, -v a="$A" -v bead="$1" 'NR == 2 {u = $3} NR == 3 {d = u - $3} END {while ((getline line < "velocity.csv") > 0) {split(line, x, ","); if (x[1] == "0.0002" && x[2] == bead) v = x[3]} printf "%.15g", 0.5 * v * v + 0.5 * 0.4 * a * d * d * sqrt(d)}'; }
ok "energy of a bead: its own and half its contact's" near "$(at profile-of-energy 1 3)" "$(energy 0)" 1e-9
ok "... of the other" near "$(at profile-of-energy 2 3)" "$(energy 1)" 1e-9
ok "the budget has the striker's energy at all times" awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) if ($i == "total_J") c = i} NR > 1 && (c == 0 || ($c - 0.5) ^ 2 > 1e-20) {bad = 1} END {exit bad}' energy.csv
finish
