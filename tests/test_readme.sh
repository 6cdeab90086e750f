#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the README files show is true: scenes, commands, the library example, the gallery, links.
source "$(dirname "$0")/shell.bash"
readme=$top/README.md
# block FILE LANGUAGE NUMBER : the text of a code block
block() { awk -v want="\`\`\`$2" -v n="$3" '/^```/ {if (inside) {inside = 0; next} if ($0 == want && ++seen == n) {inside = 1; next}} inside' "$1"; }
block "$readme" yaml 1 >"$T/scene.yaml"
example=0
for name in chain law film minimal; do
    block "$top/include/beadreel/README.md" c $((++example)) >"$T/$name.c"
    ok "example $example of the libraries is tests/examples/$name.c" diff "$T/$name.c" "$top/tests/examples/$name.c"
done
scenes=$(grep -c '^```yaml' "$readme")
for ((n = 1; n <= scenes; n++)); do
    block "$readme" yaml $n >"$T/block.yaml"
    ok "scene $n is right" exits 0 "$BUILD/beadreel" --plan "$T/block.yaml"
done
# The commands of a section, in the order of the text.
commands() { sed -n "/^## $1/,/^## /p" "$readme" | grep -E '^bead(reel|sim) '; }
# Run the recipes, their pictures and sweeps made small.
recipes_run() {
    local line count=0
    while IFS= read -r line; do
        case $line in
        *--info* | *--plan* | *.h5*) ;;
        *"scene.yaml -o results"*) line+=" --set outputs.1.size='[320, 180]' --set outputs.1.duration='1 s'" ;;
        *"beadreel sweep "*) line+=" --set sweep.configurations=1 --set sweep.cells=8 --only sweep.h5" ;;
        esac
        [[ $line != *" sweep/sweep.h5 "* ]] || line=${line/17/3}" --set outputs.0.size='[320, 180]' --set outputs.0.duration='1 s'"
        (cd "$T" && eval "\"$BUILD/${line%% *}\" ${line#* }") >/dev/null || { echo "$line"; return 1; }
        count=$((count + 1))
    done < <(commands "Five recipes")
    [ $count -ge 8 ] || { echo "$count commands"; return 1; }
    for line in results/beads.mp4 fast/force.png results/sensor.pdf results/force.pdf results/measures.csv sweep/one.mp4; do
        [ -s "$T/$line" ] || { echo "no $line"; return 1; }
    done
}
ok "the recipes do what they say" recipes_run
cat >>"$T/small.yaml" <<'YAML'
chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 5}]}
outputs: [{table: peaks.csv, show: peaks}]
YAML
ok "the example runs" exits 0 "$BUILD/tests/examples/minimal" "$T/small.yaml" "$T"
ok "... and prints a peak" prints "chain 0: first contact's peak force"
# Links of all documents, from where they stand.
links_exist() {
    local file link
    while IFS= read -r file; do
        for link in $(grep -oE '\]\([A-Za-z.][^):]*\)' "$file" | tr -d '()]'); do
            [ -e "$(dirname "$file")/$link" ] || { echo "$file: $link"; return 1; }
        done
    done < <(find "$top" -name '*.md' ! -path "$top/build*")
}
ok "links lead to files" links_exist
# Files that comments and documents name, with or without their folder.
names_exist() {
    # All ends of the paths that there are, then what is named.
    awk -F: 'NR == FNR { for (path = $0; ; sub("[^/]*/", "", path)) { there[path]; if (path !~ "/") next } }
             !($2 in there) { print; missing = 1 } END { exit missing }' \
        <(cd "$top" && find sim render include tests assets .github .ci ./*.md ./Makefile -type f | sed 's,^\./,,') <(cd "$top" && grep -oE '(^|[ (`])[a-z_0-9/]{2,}\.([ch]|sh|md)([] ,.;:)`]|$)' --exclude='*.js' -r sim render include assets ./*.md tests/*.md .github |
        grep -v '#include' | sed -E 's/:[ (`]?([^ ,;:)`]*[a-z])[] ,.;:)`]?$/:\1/')
}
ok "files that are named exist" names_exist
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
# The gallery: what is shown is what is kept, and what the commands beside it make, in the same size, and much like it: other fonts,
# another canvas and chaos leave above 30 dB, a film of an older layout 13.
names() { (cd "$1" && ls -- *.png *.gif); }
gallery_is_shown() { diff <(grep -o '(assets/gallery/[^)]*)' "$readme" | sed 's,.*/\(.*\)),\1,' | sort) <(names "$top/assets/gallery"); }
ok "the README shows all pictures of the gallery" gallery_is_shown
# Width and height as PNG and GIF have them in their heads.
shape() { case $1 in *.gif) od -An -tx1 -j 6 -N 4 "$1" ;; *) od -An -tx1 -j 16 -N 8 "$1" ;; esac; }
alike() { # PICTURE... : those in $T and in assets, all by one ffmpeg, whose start takes longer than a picture
    local picture inputs=() graph='' n=0
    for picture; do
        inputs+=(-i "$T/$picture" -i "$top/assets/$picture")
        graph+="${graph:+;}[$((2 * n))][$((2 * n + 1))]psnr[p$n]"
        n=$((n + 1))
    done
    # shellcheck disable=SC2046
    ffmpeg -hide_banner "${inputs[@]}" -filter_complex "$graph" $(seq -f '-map [p%.0f] -f null -' 0 $((n - 1))) 2>&1 </dev/null |
        sed -n 's/.*Parsed_psnr_\([0-9]*\) .*average:\([a-z0-9.]*\).*/\1 \2/p' >"$T/decibels"
    [ "$(cut -d ' ' -f 1 "$T/decibels" | sort -u | wc -l)" -eq $n ] &&
        awk 'BEGIN { split("'"$*"'", name, " ") } !($2 == "inf" || $2 >= 22) { print name[$1 + 1] ": " $2 " dB: make gallery"; bad = 1 } END { exit bad }' "$T/decibels"
}
gallery_is_made() {
    local picture
    mkdir "$T/gallery" && "$top/assets/gallery/make.sh" "$T/lighter" "$T/gallery" >/dev/null || return 1
    for picture in $(names "$top/assets/gallery"); do
        cmp <(shape "$T/gallery/$picture") <(shape "$top/assets/gallery/$picture") || { echo "$picture"; return 1; }
    done
    # shellcheck disable=SC2046
    alike readme.png $(names "$top/assets/gallery" | sed 's,^,gallery/,')
}
# The largest sweep is smaller here, and Mesa, whose start takes longer than a small picture, is not used.
cat >"$T/lighter" <<SH
#!/bin/sh
case \$1 in thesis/fig7) set -- "\$@" --set sweeps.0.configurations=4 --set sweeps.1.configurations=4 --set sweeps.2.configurations=1 --set sweeps.3.configurations=1 ;; esac
exec "$beadreel" "\$@" --canvas plain
SH
chmod +x "$T/lighter"
ok "the commands of the gallery make its pictures" gallery_is_made
for scene in "$top"/assets/scenes/*.yaml; do # those of the thesis: cli/thesis.sh
    ok "--plan of ${scene##*/}" exits 0 "$BUILD/beadreel" --plan "$scene"
done
targets_exist() {
    local target
    for target in $(grep -oE '`make [a-z-]+' "$readme" | cut -d' ' -f2 | sort -u); do
        grep -q "^$target:" "$top/Makefile" || { echo "$target"; return 1; }
    done
}
ok "make targets exist" targets_exist
finish
