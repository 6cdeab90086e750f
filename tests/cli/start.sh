#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Scenes to start from (--new), and scenes that are drawn again when saved (--watch).
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

for kind in paper lecture sweep compare; do
    ok "--new $kind" exits 0 "$beadreel" --new $kind
    ok "... says where it is" prints "$kind.yaml  edit it, then: beadreel $kind.yaml"
    ok "... is a scene" exits 0 "$beadreel" --plan $kind.yaml
    ok "... with comments" test "$(grep -c '#' $kind.yaml)" -ge 4
    ok "... of at most 24 lines" test "$(wc -l <$kind.yaml)" -le 24
    cp $kind.yaml before
    ok "... and is not overwritten" fails 2 "$beadreel" --new $kind
    ok "... but kept" cmp $kind.yaml before
done
ok "editors find the schema by the first line" test -f "$(sed -n '1s/^# yaml-language-server: $schema=//p' paper.yaml)"
ok "--new elsewhere" exits 0 "$beadsim" --new sweep -o other.yaml
ok "... is the same, but for its name" cmp <(sed 's/sweep\.yaml/other.yaml/' sweep.yaml) other.yaml
run_it() { eval "set -- $(sed -n 's/.*Run it: beadreel //p' "$1")" && exits 0 "$beadreel" --plan "$@"; }
for name in other.yaml "with spaces.yaml" "it's.yaml" '$HOME.yaml' 'été.yaml'; do
    [ -e "$name" ] || ok "--new of $name" exits 0 "$beadreel" --new paper -o "$name"
    ok "... says how to run it" run_it "$name"
done
ok "--new to standard output" exits 0 "$beadreel" --new paper -o -
ok "... is the scene, nothing else" cmp out paper.yaml
ok "... and makes no file" test ! -e ./-
ok "--new nowhere" fails 1 "$beadreel" --new sweep -o none/other.yaml
ok "--new of what there is not" fails 2 "$beadreel" --new papre
ok "... suggests" says 'did you mean `paper`?'
ok "its pictures" exits 0 "$beadreel" paper.yaml -o paper
ok "... are there" test -s paper/figure.pdf -a -s paper/peaks.csv
ok "a sweep, smaller" exits 0 "$beadreel" sweep.yaml -o sweep --set sweep.cells=6 --set sweep.configurations=2
ok "... with its results" test -s sweep/sweep.h5

# ---- --watch ----

cat >scene.yaml <<'YAML'
chain:
  striker: {velocity: 0.4 m/s}
  beads: [{bead: brass, count: 10}]
outputs: [{table: peaks.csv}]
YAML
# wait_for COMMAND... : until it holds, or for long enough on any machine.
wait_for() {
    local i
    for i in $(seq 300); do
        "$@" && return 0
        sleep 0.1
    done
    return 1
}
summaries() { [ "$(grep -c '^1 file, ' said)" -eq "$1" ]; }
changed_peaks() { ! cmp -s made/peaks.csv "$1"; }
"$beadsim" scene.yaml -o made --watch >said 2>complained </dev/null &
watcher=$!
ok "--watch runs the scene" wait_for summaries 1
cp made/peaks.csv first.csv
sed -i 's/0.4 m/0.8 m/' scene.yaml
ok "... again when it is saved" wait_for summaries 2
ok "... with what is new" changed_peaks first.csv
ok "... and says what" grep -qx 'scene.yaml:2: `striker: {velocity: 0.8 m/s}`, was `striker: {velocity: 0.4 m/s}`' said
sed -i 's/0.8 m/1250 mm/' scene.yaml
ok "a longer value" wait_for summaries 3
ok "... is shown whole" grep -qx 'scene.yaml:2: `striker: {velocity: 1250 mm/s}`, was `striker: {velocity: 0.8 m/s}`' said
sed -i 's/1250 mm/1 m/' scene.yaml
ok "a shorter one" wait_for summaries 4
ok "... is, too" grep -qx 'scene.yaml:2: `striker: {velocity: 1 m/s}`, was `striker: {velocity: 1250 mm/s}`' said
echo 'simulate: {until: soon}' >>scene.yaml
ok "a mistake" wait_for grep -q 'beadsim: scene.yaml:5:19: simulate.until: `soon`' complained
ok "... is told, with what is new" grep -qx 'scene.yaml:5: 1 line instead of 0' said
sed -i '$d' scene.yaml
ok "... and may be mended" wait_for summaries 5
ok "... while it goes on" kill -0 $watcher
touch scene.yaml
ok "saved as it is" wait_for grep -q 'scene.yaml: saved, not changed' said
kill -TERM $watcher
wait $watcher
ok "a signal ends it" test $? -eq 143
ok "--watch of a plan" fails 2 "$beadreel" --plan scene.yaml --watch
ok "--watch of nothing" fails 2 "$beadreel" nothing.yaml --watch
ok "--watch of standard input" fails 2 timeout 20 "$beadsim" - --watch -o made
mkfifo pipe.yaml
ok "--watch of a pipe" fails 2 timeout 20 "$beadsim" pipe.yaml --watch -o made
ok "... says why not" says "--watch: pipe.yaml is not a file that could be saved again"
finish
