#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What users are told of the accuracy of peaks: a column, the last line, --info; a guarantee, and peaks that miss it; long steps.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

# Contact 5 has its peak late, behind the wave: it answers to errors a hundred times as strongly as others.
cat >rattling.yaml <<'YAML'
materials:
  m0: {density: 3343.3, modulus: 595.46 GPa, poisson: 0.297, radius: 12.044 mm}
  m1: {density: 4495.3, modulus: 0.6667 GPa, poisson: 0.242, radius: 7.3854 mm}
chain:
  striker: {bead: m1, velocity: 3.0113 m/s}
  wall: rigid
  beads: [{bead: m0}, {bead: m0}, {bead: m0}, {bead: m1}, {bead: m0}, {bead: m0}, {bead: m1}, {bead: m1}, {bead: m1},
    {bead: m0}, {bead: m0}, {bead: m1}, {bead: m0}, {bead: m1}, {bead: m0}, {bead: m1}, {bead: m0}, {bead: m0},
    {bead: m1}, {bead: m1}, {bead: m0}, {bead: m1}, {bead: m0}, {bead: m0}, {bead: m1}, {bead: m1}, {bead: m0},
    {bead: m1}, {bead: m0}, {bead: m1}, {bead: m0}, {bead: m1}, {bead: m0}, {bead: m1}, {bead: m1}, {bead: m1},
    {bead: m0}, {bead: m0}, {bead: m0}, {bead: m0}, {bead: m0}, {bead: m0}, {bead: m1}, {bead: m1}]
outputs: [{table: peaks.csv}, {table: beads.csv, show: bead-peaks}, {trajectory: run.h5}]
YAML
# column FILE ROW COLUMN
column() { awk -F, -v row="$2" -v column="$3" '$1 == row {print $column}' "$1"; }
# below X Y
below() { awk -v x="$1" -v y="$2" 'BEGIN {exit !(x != "" && x + 0 < y + 0)}'; }
# off FILE ROW : how far that peak is from the one of short steps, N
off() { awk -v x="$(column "$1" "$2" 2)" -v y="$(column "fine/${1#*/}" "$2" 2)" 'BEGIN {d = x - y; if (d < 0) d = -d; printf "%.6g\n", d}'; }

ok "short steps" exits 0 "$beadsim" rattling.yaml -o fine --quiet --set simulate.method=rkn8 --set 'simulate.step=0.05 us'
ok "... without a word" test ! -s err
ok "a run" exits 0 "$beadsim" rattling.yaml -o run
ok "tables of contacts have the column" grep -qx 'contact,peak_force_N,time_s,state,uncertainty_N,time_s_uncertainty' run/peaks.csv
ok "tables of beads have it" grep -qx 'bead,peak_force_N,time_s,state,uncertainty_N,time_s_uncertainty' run/beads.csv
ok "the bad peak is off by more than asked" below "$(column run/peaks.csv 5 2 | awk '{print 1e-6 * $1}')" "$(off run/peaks.csv 5)"
ok "... and by less than its uncertainty" below "$(off run/peaks.csv 5)" "$(column run/peaks.csv 5 5)"
ok "a good peak is certain" below "$(column run/peaks.csv 42 5)" "$(column run/peaks.csv 42 2 | awk '{print 1.1e-5 * $1}')"
ok "the last line names the worst" prints '; least certain peak: contact 5, 74.2'
ok "--info of the trajectory" exits 0 "$beadsim" --info run/run.h5
ok "... names it too" prints 'least certain peak: contact 5, 74.2'
ok "--plan tells of the second run" exits 0 "$beadsim" --plan rattling.yaml
ok "... and for which files" prints 'comparison run: uncertainties of'
ok "threads change no bit" exits 0 "$beadsim" rattling.yaml -o one --threads 1
ok "... of the peaks" cmp run/peaks.csv one/peaks.csv

ok "without the column" exits 0 "$beadsim" rattling.yaml -o plain --only peaks --set outputs.0.uncertainty=false
ok "... the table is the same" cmp plain/peaks.csv <(cut -d, -f1-4 run/peaks.csv)
ok "... the last line has no worst peak" test "$(grep -c 'least certain' out)" -eq 0

ok "verify: true" exits 0 "$beadsim" rattling.yaml -o sure --quiet --set simulate.verify=true
ok "... without a word" test ! -s err
ok "... makes the bad peak good" below "$(off sure/peaks.csv 5)" "$(column sure/peaks.csv 5 2 | awk '{print 1e-6 * $1}')"
ok "... says so" below "$(column sure/peaks.csv 5 5)" "$(column sure/peaks.csv 5 2 | awk '{print 1.001e-6 * $1}')"
# Coarse steps are cheaper without correction of contact events, which the fine ones that this chain takes are not.
finer_run() { # FILE : its peaks are those of a run with a smaller accuracy
    for accuracy in 1e-4 1e-5 1e-6; do
        exits 0 "$beadsim" rattling.yaml -o "at/$accuracy" --quiet --only peaks --set simulate.accuracy=$accuracy || return
        ! cmp -s <(cut -d, -f1-4 "at/$accuracy/peaks.csv") <(cut -d, -f1-4 "$1") || return 0
    done
    return 1
}
ok "verify: true from a low accuracy" exits 0 "$beadsim" rattling.yaml -o low --only peaks --set simulate.verify=true --set simulate.accuracy=1e-3
ok "... changes the method with the steps" prints ' with rkn8, '
ok "... is a run at a smaller accuracy" finer_run low/peaks.csv
ok "peaks that miss the accuracy fail" exits 1 "$beadsim" rattling.yaml -o unsure --set simulate.verify=true --set simulate.accuracy=1e-12
ok "... tells what, of the few that miss" grep -Eq 'simulate.verify: [1-9] of 90 peaks did not reach the requested accuracy of 1e-12; least certain: contact 5, 74.2' err
ok "... and leaves all results" test -s unsure/peaks.csv -a -s unsure/beads.csv -a -s unsure/run.h5
ok "not beside a step" fails 2 "$beadsim" rattling.yaml -o no --set simulate.verify=true --set 'simulate.step=1 us'
ok "... says why" says 'chooses the steps itself'

# Before the front, forces fall to 1e-34 N and less, and still rise at the end.
cat >front.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 64}]}
simulate: {until: 1 ms}
outputs: [{table: peaks.csv}]
YAML
ok "a run that ends before the wave has" exits 0 "$beadsim" front.yaml -o front
ok "... has forces that still rise, at the last contact" test "$(column front/peaks.csv 63 4)" = open
ok "... none of them is the least certain peak" prints '; least certain peak: contact 0, 84.53'

cat >steel.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 30}]}
simulate: {method: rkn8, step: 20 us}
outputs: [{table: peaks.csv}]
YAML
ok "steps that are too long" exits 0 "$beadsim" steel.yaml -o long
ok "... are told in words" says 'warning: steel.yaml:2:32: simulate.step: steps of 20 us are too long'
ok "steps that are short enough" exits 0 "$beadsim" steel.yaml -o short --quiet --set 'simulate.step=4 us'
ok "... are not" test ! -s err
finish
