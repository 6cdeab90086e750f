#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What is said of mistakes that beginners make: all at once, each with its place and what to write instead.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

# told MESSAGE SCENE : stderr has it, and nothing was made.
told() {
    printf '%b\n' "$2" >scene.yaml
    exits 2 "$beadreel" scene.yaml -o none && says "$1" && [ ! -e none ]
}
end='\noutputs: [{image: a.png}]'
ok "a decimal comma" told 'scene.yaml:1:53: chain.striker.velocity: `0,443 m/s` has a comma, but numbers have a decimal point' \
    "chain: {beads: [{bead: brass}], striker: {velocity: \"0,443 m/s\"}}$end"
ok "... in brackets" told 'chain.striker.443 m/s: unknown key; in { } a comma ends a value: numbers have a decimal point' \
    "chain: {beads: [{bead: brass}], striker: {velocity: 0,443 m/s}}$end"
ok "part of a material's name" told 'there is no material `steel`; did you mean `large-steel` or `small-steel`?' "chain: {beads: [{bead: steel}]}$end"
ok "no outputs" told 'scene.yaml:1:1: outputs: is missing: the files to make, at least one: see outputs; such as `outputs: [{image: force.png}' 'chain: {beads: [{bead: brass}]}'
ok "a missing colon, of a value" told 'simulate: is `until 2 ms`; must be a map of keys and values: how long and how exactly to compute; is the colon missing behind `until`?' \
    "chain: {beads: [{bead: brass}]}\nsimulate:\n  until 2 ms$end"
ok "... of a list" told 'chain.beads [{bead: unknown key; is the colon missing behind `beads`?' "chain:\n  beads [{bead: brass}]\n  wall: rigid$end"
ok "... of a map" told 'is the colon missing behind `striker`?' "chain:\n  striker {bead: brass}\n  beads: [{bead: brass}]$end"
ok "... of a word" told "could not find expected ':'; a key ends with a colon and a space: is one missing here, or in the line before?" "chain:\n  beads: [{bead: brass}]\n  wall rigid$end"
ok "... of a section" told 'scene.yaml:2:8: not YAML: mapping values are not allowed in this context; is a colon missing in the line before?' "chain\n  beads: [{bead: brass}]$end"
ok "... of an entry" told 'is the colon missing behind `bead`?' "chain:\n  beads:\n  - bead brass$end"
ok "a key in the wrong place" told 'scene.yaml:1:1: colormap: unknown key; did you mean `outputs.N.colormap`?' "colormap: grey\nchain: {beads: [{bead: brass}]}$end"
ok "... of --set" fails 2 "$beadreel" clean-vs-delocalised --set colormap=grey
ok "... as well" says '--set:1:1: colormap: unknown key; did you mean `outputs.N.colormap`?'
ok "... of the run" fails 2 "$beadreel" clean-vs-delocalised --set until=1ms
ok "... too" says 'did you mean `simulate.until`?'

ok "several mistakes" told 'scene.yaml:5:26: outputs.0.colour: unknown key' "title: x\nchain:\n  walll: brass\n  beads: [{bead: brss, count: 0}]\noutputs: [{image: a.png, colour: grey}, {movie: b.doc}]"
ok "... are told at once" test "$(wc -l <err)" -eq 5
ok "... each with its place" test "$(grep -cE '^beadreel: scene.yaml:[345]:[0-9]+: ' err)" -eq 5
if command -v python3 >/dev/null; then
    ok "... as JSON, too" bash -c "'$beadreel' scene.yaml --json 2>/dev/null | python3 -c 'import json, sys; e = json.load(sys.stdin)[\"errors\"]; sys.exit(not (len(e) == 5 and all(f[\"file\"] == \"scene.yaml\" and f[\"line\"] in (3, 4, 5) for f in e)))'"
fi
cp scene.yaml "$(printf 'a\nb.yaml')"
ok "a line break in the file's name" exits 2 "$beadreel" "$(printf 'a\nb.yaml')"
ok "... breaks no line" test "$(wc -l <err)" -eq 5

cat >good.yaml <<'YAML'
chain: {beads: [{bead: brass, count: 5}]}
outputs: [{table: peaks.csv}]
YAML
ok "--quiet" exits 0 "$beadreel" good.yaml -o quiet --quiet
ok "... says nothing of progress" test ! -s err
ok "-q" exits 0 "$beadreel" good.yaml -o quiet -q
finish
