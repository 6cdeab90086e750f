#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The thesis's figures: every ready scene of them can be planned, the quick ones are made and their numbers are right.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

# within VALUE EXPECTED TOLERANCE
within() { awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN {d = a - b; if (d < 0) d = -d; if (!(d <= e)) {print a, "is not within", e, "of", b; exit 1}}'; }
# cell FILE FIELD PATTERN : a field of the line of a table that begins so
cell() { awk -F, -v f="$2" -v p="$3" 'index($0, p) == 1 {print $f; exit}' "$1"; }
measure() { cell "$1" 2 "$2,"; }
more=() # options of what is made
makes() {
    local scene=$1
    exits 0 "$beadreel" "thesis/$scene" -o figures "${more[@]}" || return 1
    for f in "${@:2}"; do
        [ -s "figures/$f" ] || { echo "no $f"; return 1; }
    done
}

for f in "$BEADREEL_ASSETS"/scenes/thesis/*.yaml; do
    name=thesis/$(basename "$f" .yaml)
    ok "$name is listed" bash -c "'$beadreel' --list scenes | grep -q '^$name '"
    ok "$name can be planned" exits 0 "$beadreel" "$name" --plan
    ok "... has a pdf, a png and numbers" bash -c "for e in pdf png csv; do grep -q '^output .*[.]'\$e: '$T/out' || exit 1; done"
done

ok "fig1" makes fig1 fig1.pdf fig1.png fig1.csv
ok "... is 2 sech^2(x - 4 t) at all times" awk -F, 'NR > 1 {x = $2 - 4 * $1; if (x > -9 && x < 9) {s = 2 / (exp(x) + exp(-x)); d = $3 - 2 * s * s;
    if (d < 0) d = -d; if (d > w) w = d; n++}} END {if (n < 3000 || w > 2e-6) {print n, w; exit 1}}' figures/fig1.csv
ok "fig2" makes fig2 fig2.pdf fig2.png fig2.csv
ok "... steel pressed against brass" within "$(cell figures/fig2.csv 7 1,)" 6.33547e9 1e4
ok "fig3" makes fig3 fig3.pdf fig3.png fig3.csv
ok "... 1 : 2 steel and PTFE" test "$(awk -F, 'NR > 2 && NR < 6 {printf "%s ", $2}' figures/fig3.csv)" = "small-steel ptfe ptfe "
ok "fig4" makes fig4 fig4.pdf fig4.png fig4.csv
ok "... 68 beads and the striker" test "$(wc -l <figures/fig4.csv)" -eq 70
ok "... sensors behind dimers 19 and 23" test "$(awk -F, '$6 != "" && NR > 1 {printf "%s %s ", $1, $2}' figures/fig4.csv)" = "39 small-steel 48 small-steel "
ok "... the wall carries the weight" within "$(cell figures/fig4.csv 8 68,)" 0.1 0.05
ok "fig5" makes fig5 fig5.pdf fig5.png fig5.csv fig5-peaks.csv
# First passages of an independent program (the reflection from the wall comes after 1.5 ms).
peaks=(high 29.725809 734.082 29.274391 898.910 medium 24.453513 749.709 23.736214 911.775 low 20.860941 746.862 19.284343 925.099)
for ((i = 0; i < 15; i += 5)); do
    for k in 0 1; do
        line=${peaks[i]},$((39 + 9 * k)),
        ok "... force of $line" within "$(cell figures/fig5-peaks.csv 3 "$line")" "${peaks[i + 1 + 2 * k]}" 5e-5
        ok "... and its time" within "$(cell figures/fig5-peaks.csv 4 "$line" | awk '{print 1e6 * $1}')" "${peaks[i + 2 + 2 * k]}" 2e-3
    done
done
more=(--set chain.points=1200) # of 4734
ok "fig8" makes fig8 fig8.pdf fig8.png fig8.csv fig8-measures.csv
more=()
# The hump's right flank breaks first: t = min -1 / (d c / d x), c = sqrt(1 + e r) the speed, r = sech^2(x / w).
ok "... breaks when characteristics cross" within "$(measure figures/fig8-measures.csv "breaking time")" "$(awk 'BEGIN {w = 1.5; e = 0.5
    for (x = 0; x < 6; x += 1e-4) {s = 2 / (exp(x / w) + exp(-x / w)); r = s * s; th = (exp(x / w) - exp(-x / w)) / (exp(x / w) + exp(-x / w))
        d = 0.5 * e * 2 * r * th / w / sqrt(1 + e * r); if (d > most) most = d} print 1 / most}')" 0.05
ok "... loses energy afterwards" bash -c "awk -F, '/change of the energy/ {found = \$3 < -0.01} END {exit !found}' figures/fig8-measures.csv"

# Figs 6 and 7 with fewer configurations: means within three standard errors of the reference's and their own.
# means FILE PREFIX REFERENCE : FILE's rows that begin with PREFIX and a magnetism; REFERENCE has magnetism, mean, error.
means() {
    awk -F, -v prefix="$2" 'NR == FNR {mean[sprintf("%.4f", $1)] = $2; error[sprintf("%.4f", $1)] = $3; next}
        FNR > 1 && index($0, prefix ",") == 1 && $2 < 0.999 {k = sprintf("%.4f", $2); d = $4 - mean[k]; if (d < 0) d = -d; n++
            if (!(k in mean) || d > 3 * (error[k] + $5)) {print k, $4, "+-", $5, "not", mean[k]; bad = 1}} END {exit bad || n < 9}' "$3" "$1"
}
few() { exits 0 "$beadsim" "thesis/$1" -o few --only "$1.csv" "${@:2}"; }
ok "fig6 with 12 configurations" few fig6 --set sweep.configurations=12
printf '%s,.0035\n' .9,.878 .8,.788 .7,.726 .6,.681 .5,.648 .4,.632 .3,.622 .2,.618 .1,.619 0,.618 >channel1
ok "... means at the first sensor" means few/fig6.csv "channel 1" channel1
ok "fig7 with 30 configurations" few fig7 --set sweeps.2.magnetism=0 --set sweeps.2.configurations=1 --set sweeps.3.magnetism=0 --set sweeps.3.configurations=1 \
    --set sweeps.0.configurations=30 --set sweeps.1.configurations=30
for n in 32 64; do
    awk -F, -v n=$n '$1 == n {print $2 "," $3 "," $4}' "$top/tests/reference/fig7_mean.csv" >"mean$n"
    ok "... means behind $n dimers" means few/fig7.csv "$n dimers" "mean$n"
done
ok "fig6" makes fig6 fig6.pdf fig6.png fig6.csv
ok "... three configurations, one at M = 1" test "$(grep -c "^channel 1," figures/fig6-configurations.csv)" = 31

ok "defect" makes defect defect.pdf defect.png defect.csv defect-measures.csv
# After so many dimers the ratios are still a few parts in ten thousand from those far behind.
for case in "1 reversed,.7985" "2 apart,.6376" "3 apart,.5091" "2 adjacent,.836" "4 adjacent,.826" "6 adjacent,.820"; do
    ok "... energy past ${case/,/: }" within "$(cell figures/defect-measures.csv 3 "${case%,*},energy past defect,")" "${case#*,}" .003
done
# Decay lengths of the first fall by e, with 20 configurations: within 12 % of those of many.
few decay --set sweep.configurations=20 --set sweep.cells=200 --set sweep.magnetism="[0.9, 0.8, 0.5, 0]"
for case in 0.90,338 0.8,187 0.5,117 0,103; do
    ok "... decay length at M = ${case/,/: }" within "$(awk -F, -v m="${case%,*}" 'NR > 1 && $1 - m < 1e-9 && m - $1 < 1e-9 {print $6; exit}' few/decay.csv)" "${case#*,}" "$((${case#*,} * 12 / 100))"
done

# The same profiles, whatever other times are asked for.
cat >scene.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 30}]}
outputs:
  - {table: [a.csv, again.csv], show: profiles, field: velocity, at: [0.1 ms, 0.2 ms], uncertainty: false}
  - {table: b.csv, show: profiles, field: velocity, at: [0.1 ms, 0.2 ms, 0.2345678 ms], uncertainty: false}
YAML
ok "profiles of beads" exits 0 "$beadsim" scene.yaml -o p
ok "... in both files of one output" cmp p/a.csv p/again.csv
ok "... a row for each bead and time" test "$(wc -l <p/a.csv)" -eq 63
ok "... the same beside others" bash -c "paste -d, p/a.csv p/b.csv | awk -F, 'NR == 1 && \$3 != \"velocity_m/s\" {exit 1}
    NR > 1 && NR < 64 {d = \$3 - \$6; if (d < 0) d = -d; if (\$1 != \$4 || \$2 != \$5 || d > 1e-4) exit 1; if (\$3 > 0.1) n++} END {exit !(n == 3)}'"
ok "profiles after the end are refused" fails 2 "$beadsim" scene.yaml -o p --set simulate.until='1 ms' --set outputs.0.at='[0.1 ms, 9 ms]'
ok "... but extend a run that ends by itself" exits 0 "$beadsim" scene.yaml -o late --set outputs.0.at='[0.1 ms, 9 ms]' --only a.csv
ok "... and are at their times" grep -q '^0.009,' late/a.csv
ok "settings find outputs by any of their files" exits 0 "$beadsim" scene.yaml -o q --set outputs.again.csv.field=force --only again.csv
ok "... and change it" grep -q '^time_s,bead,force_N$' q/again.csv
finish
