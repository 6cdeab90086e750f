#!/bin/bash
# What the README shows is true: its scenes, its commands, its library example, its files.
source "$(dirname "$0")/shell.bash"
readme=$top/README.md
# block LANGUAGE NUMBER : the text of a code block
block() { awk -v want="\`\`\`$1" -v n="$2" '/^```/ {if (inside) {inside = 0; next} if ($0 == want && ++seen == n) {inside = 1; next}} inside' "$readme"; }
block yaml 1 >"$T/scene.yaml"
block c 1 >"$T/minimal.c"
ok "the example is tests/examples/minimal.c" diff "$T/minimal.c" "$top/tests/examples/minimal.c"
scenes=$(grep -c '^```yaml' "$readme")
for ((n = 1; n <= scenes; n++)); do
    block yaml $n >"$T/block.yaml"
    ok "scene $n is right" exits 0 "$BUILD/beadreel" --plan "$T/block.yaml"
done
# Of what "Use" shows, the lines that run a scene.
uses_plan() {
    local line count=0
    while IFS= read -r line; do
        (cd "$T" && eval "\"$BUILD/${line%% *}\" --plan ${line#* }") >/dev/null || { echo "$line"; return 1; }
        count=$((count + 1))
    done < <(sed -n '/^## Use/,/^## /p' "$readme" | sed 's/ *#.*//' | grep -E '^bead(reel|sim) (scene\.yaml|[a-z][a-z-]+ )')
    [ $count -ge 4 ]
}
ok "the commands of Use are right" uses_plan
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
# A picture must be one, and the gallery's are kept with the sources: small.
pictures_are_small() {
    local picture magic most count=0
    for picture in $(grep -oE '!\[[^]]*\]\([^)]*\)' "$readme" | sed 's/.*(\(.*\))/\1/'); do
        case $picture in
        *.png) magic=PNG most=200000 ;;
        *.gif) magic=GIF most=1000000 ;;
        *) magic='?' most=0 ;;
        esac
        head -c 4 "$top/$picture" | grep -qa "$magic" || { echo "$picture is no picture of its kind"; return 1; }
        [[ $picture != *gallery* ]] || [ "$(stat -c %s "$top/$picture")" -lt $most ] || { echo "$picture is large"; return 1; }
        count=$((count + 1))
    done
    [ $count -ge 2 ]
}
ok "pictures are there, and small" pictures_are_small
gallery_is_shown() {
    local picture
    for picture in "$top"/assets/gallery/*.{png,gif}; do
        grep -q "(assets/gallery/$(basename "$picture"))" "$readme" || { echo "$picture"; return 1; }
    done
}
ok "all of the gallery is shown" gallery_is_shown
for scene in "$top"/assets/scenes/*.yaml "$top"/assets/scenes/*/*.yaml; do
    ok "--plan of ${scene#"$top/assets/scenes/"}" exits 0 "$BUILD/beadreel" --plan "$scene"
done
commands_plan() {
    local line
    while IFS= read -r line; do
        (cd "$T" && eval "\"$BUILD/beadreel\" --plan ${line#beadreel }") >/dev/null || { echo "$line"; return 1; }
    done < <(sed -n '/^## Gallery/,/^## /p' "$readme" | grep -oE '`beadreel [^`]*`' | tr -d '`')
}
ok "the gallery's commands are right" commands_plan
targets_exist() {
    local target
    for target in $(grep -oE '`make [a-z-]+' "$readme" | cut -d' ' -f2 | sort -u); do
        grep -q "^$target:" "$top/Makefile" || { echo "$target"; return 1; }
    done
}
ok "make targets exist" targets_exist
finish
