#!/bin/bash
# The thesis's figures: every ready scene of them can be planned, the quick ones are made and their numbers are right.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

# within VALUE EXPECTED TOLERANCE
within() { awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN {d = a - b; if (d < 0) d = -d; if (!(d <= e)) {print a, "is not within", e, "of", b; exit 1}}'; }
# cell FILE FIELD PATTERN : a field of the line of a table that begins so
cell() { awk -F, -v f="$2" -v p="$3" 'index($0, p) == 1 {print $f; exit}' "$1"; }
measure() { cell "$1" 2 "$2,"; }
makes() {
    local scene=$1
    shift
    exits 0 "$beadreel" "thesis/$scene" -o figures || return 1
    for f in "$@"; do
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
ok "fig8" makes fig8 fig8.pdf fig8.png fig8.csv fig8-measures.csv
# The hump's right flank breaks first: t = min -1 / (d c / d x), c = sqrt(1 + e r) the speed, r = sech^2(x / w).
ok "... breaks when characteristics cross" within "$(measure figures/fig8-measures.csv "breaking time")" "$(awk 'BEGIN {w = 1.5; e = 0.5
    for (x = 0; x < 6; x += 1e-4) {s = 2 / (exp(x / w) + exp(-x / w)); r = s * s; th = (exp(x / w) - exp(-x / w)) / (exp(x / w) + exp(-x / w))
        d = 0.5 * e * 2 * r * th / w / sqrt(1 + e * r); if (d > most) most = d} print 1 / most}')" 0.05
ok "... loses energy afterwards" bash -c "awk -F, '/change of the energy/ {found = \$3 < -0.01} END {exit !found}' figures/fig8-measures.csv"

# The same profiles, whatever other times are asked for.
cat >scene.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 30}]}
outputs:
  - {table: [a.csv, again.csv], show: profiles, field: velocity, at: [0.1 ms, 0.2 ms]}
  - {table: b.csv, show: profiles, field: velocity, at: [0.1 ms, 0.2 ms, 0.2345678 ms]}
YAML
ok "profiles of beads" exits 0 "$beadsim" scene.yaml -o p
ok "... in both files of one output" cmp p/a.csv p/again.csv
ok "... a row for each bead and time" test "$(wc -l <p/a.csv)" -eq 63
ok "... the same beside others" bash -c "paste -d, p/a.csv p/b.csv | awk -F, 'NR == 1 && \$3 != \"velocity_m/s\" {exit 1}
    NR > 1 && NR < 64 {d = \$3 - \$6; if (d < 0) d = -d; if (\$1 != \$4 || \$2 != \$5 || d > 1e-4) exit 1; if (\$3 > 0.1) n++} END {exit !(n == 3)}'"
ok "profiles after the end are refused" fails 2 "$beadsim" scene.yaml -o p --set outputs.0.at='[0.1 ms, 9 ms]'
ok "settings find outputs by any of their files" exits 0 "$beadsim" scene.yaml -o q --set outputs.again.csv.field=force --only again.csv
ok "... and change it" grep -q '^time_s,bead,force_N$' q/again.csv
finish
