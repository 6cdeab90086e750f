#!/bin/bash
# What the README shows is true: its scene, its library example, its files.
source "$(dirname "$0")/shell.bash"
readme=$top/README.md
# block LANGUAGE NUMBER : the text of a code block
block() { awk -v want="\`\`\`$1" -v n="$2" '/^```/ {if (inside) {inside = 0; next} if ($0 == want && ++seen == n) {inside = 1; next}} inside' "$readme"; }
block yaml 1 >"$T/scene.yaml"
block c 1 >"$T/minimal.c"
ok "the example is tests/examples/minimal.c" diff "$T/minimal.c" "$top/tests/examples/minimal.c"
ok "the scene is right" exits 0 "$BUILD/beadreel" --plan "$T/scene.yaml"
cat >>"$T/small.yaml" <<'YAML'
chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 5}]}
outputs: [{table: peaks.csv, show: peaks}]
YAML
ok "the example runs" exits 0 "$BUILD/tests/examples/minimal" "$T/small.yaml" "$T"
ok "... and prints a peak" prints "chain 0: first contact's peak force"
links_exist() {
    local link
    for link in $(grep -oE '\]\([A-Za-z][^):]*\)' "$readme" | tr -d '()]'); do
        [ -e "$top/$link" ] || { echo "$link"; return 1; }
    done
}
ok "links lead to files" links_exist
targets_exist() {
    local target
    for target in $(grep -oE '`make [a-z-]+' "$readme" | cut -d' ' -f2 | sort -u); do
        grep -q "^$target:" "$top/Makefile" || { echo "$target"; return 1; }
    done
}
ok "make targets exist" targets_exist
finish
