#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# --reproduce: any file that was made is made again, by the scene that it or its neighbour has, with the same bits. The manual says
# which kinds of files have one: each is tried.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
# Without Mesa, whose start takes longer than small pictures. --reproduce does not look at settings.
printf '#!/bin/sh\nexec "%s" "$@" --canvas plain\n' "$beadreel" >plain && chmod +x plain && beadreel=$T/plain
cat >scene.yaml <<'YAML'
title: "A < B & \"C\""
chain: {beads: [{bead: large-steel, count: 12}], wall: rigid}
simulate: {until: 0.2 ms}
outputs:
  - {image: a.png, size: [320, 240]}
  - {image: a.pdf, dpi: 100}
  - {image: a.svg, dpi: 100}
  - {movie: a.mp4, size: [320, 240], duration: 0.2 s}
  - {table: a.csv, show: peaks}
  - {trajectory: a.h5}
  - {report: a.html}
YAML
made=(a.png a.pdf a.svg a.mp4 a.csv a.h5 a.html)
ok "a scene with a file of most kinds" exits 0 "$beadreel" scene.yaml -o all --set simulate.until='0.25 ms'
mv scene.yaml kept.yaml
for f in "${made[@]}"; do
    ok "$f is made again" exits 0 "$beadreel" --reproduce "all/$f"
    ok "... with the same bits" prints "all/$f: same bits"
done
ok "nothing new beside it" test "$(ls all | wc -l)" -eq ${#made[@]}
ok "a table by the data program" exits 0 "$beadsim" --reproduce all/a.csv

# Each ending that a file can have, alone in a directory, from a scene that is long and has what formats treat in a way of their own.
manual=$top/assets/manual/publish.md
rows() { sed -n '/^| file |/,/^$/p' "$manual" | grep '^| `'; }
told() { rows | grep -F "\`.$1\`" | grep -v '| none'; }
{ "$beadreel" --list keys | grep -o '(.*FILE\.[^;]*;' | grep -o '\.[a-z0-9]*' | tr -d .; echo xdmf; } | sort -u >endings
ok "there are endings" test "$(wc -l <endings)" -ge 20
listed() { rows | cut -d '|' -f 2 | grep -o '\.[a-z0-9]*' | tr -d . | sort | diff - endings; }
ok "the manual has a row for each ending" listed
{
    printf '# <a> & "b" \\134 ]]> -- &amp; &#65; </metadata> </code> é 粒\n# endstream\nendstream: [&x 1, *x]\n' | sed '/^endstream/d'
    seq -f '# line %.0f of a scene that is longer than a segment of JPEG can be' 1100
    printf '# %0300d\n' 7
    cat <<'YAML'
title: "<A> & \\ \"B\" é"
chain: {beads: [{bead: large-steel, count: 8}], wall: rigid}
simulate: {until: 0.1 ms}
outputs:
YAML
    while read -r ending; do
        case $ending in
        csv) echo "  - {table: x.csv, show: peaks}" ;;
        h5) echo "  - {trajectory: x.h5, xdmf: true}" ;;
        xdmf) ;;
        html) echo "  - {report: x.html}" ;;
        mp4 | mov | mkv | webm | gif | apng) echo "  - {movie: x.$ending, size: [240, 160], duration: 0.2 s}" ;;
        png | webp | avif)
            echo "  - {image: x.$ending, size: [240, 160]}"
            echo "  - {movie: film-x.$ending, size: [240, 160], duration: 0.2 s}"
            ;;
        *) echo "  - {image: x.$ending, size: [240, 160]}" ;;
        esac
    done <endings
    echo "  - {movie: a.mp4, size: [240, 160], duration: 0.2 s, poster: poster-x.png}"
    echo "  - {movie: b.mp4, size: [240, 160], duration: 0.2 s, slides: slides-x.html, stops: [50 us]}"
} >long.yaml
ok "a scene of 70 kB with a file of each kind" exits 0 "$beadreel" long.yaml -o kinds -q
ok "every ending is there" test "$(cd kinds && printf '%s\n' x.* | sed 's/.*\.//' | sort -u)" = "$(cat endings)"
alone() { rm -rf alone && mkdir alone && cp "$1" alone; }
whole() { alone "kinds/$1" && exits 0 "$beadreel" --reproduce "alone/$1" && prints "alone/$1: same bits" && prints "by the scene in it" && test "$(ls alone)" = "$1"; }
flip() { # FILE : one bit at two thirds, where there are pixels, and numbers of chains
    local at=$(($(stat -c %s "$1") * 2 / 3)) byte
    byte=$(od -An -tu1 -j "$at" -N 1 "$1")
    printf "\\x$(printf %02x $((byte ^ 1)))" | dd of="$1" bs=1 seek="$at" conv=notrunc status=none
}
# Of a short scene, so that the bytes are of pixels and numbers, with this output alone: where bits differ, all are made.
short() { { sed '/^#/d; /^  - /d' long.yaml; grep -E " $1[,}]" long.yaml; } >short.yaml && "$beadreel" short.yaml -o short -q; }
changed() { short "$1" && alone "short/$1" && flip "alone/$1" && fails 1 "$beadreel" --reproduce "alone/$1" && grep -qE "alone/$1: (other bits from byte|damaged: bytes) " "$T/err"; }
without() { alone "kinds/$1" && fails 1 "$beadreel" --reproduce "alone/$1" && says "no scene is stored in it"; }
for f in $(cd kinds && ls -- *x.*); do
    if [ -n "$(told "${f##*.}")" ]; then
        ok "$f alone is made again" whole "$f"
        ok "... and one other bit is found" changed "$f"
    else
        ok "$f alone has no scene, as the manual says" without "$f"
    fi
done
rm -rf alone

if command -v pdfdetach >/dev/null; then
    attached() { pdfdetach -save 1 -o s.yaml all/a.pdf && "$beadreel" s.yaml -o s --only a.csv -q && cmp s/a.csv all/a.csv; }
    ok "a PDF has its scene attached, ready to run" attached
else
    skip "poppler-utils" "a PDF has its scene attached, ready to run"
fi

# What -o makes of a scene's picture or film, and of a trajectory.
printf 'chain: {beads: [{bead: brass, count: 8}]}\nsimulate: {until: 0.2 ms}\noutputs: [{image: a.png, size: [300, 200]}, {image: b.png}, {movie: c.mp4, duration: 0.2 s, size: [320, 200]}, {trajectory: drawn.h5, every: 7 us}]\n' >drawn.yaml
"$beadreel" drawn.yaml -o . --only drawn.h5 -q >/dev/null
again() { # FROM FILE OPTION...
    local from=$1 file=alone/$2
    shift 2
    mkdir alone && "$beadreel" "$from" -o "$file" "$@" -q >/dev/null && exits 0 "$beadreel" --reproduce "$file" && prints "$file: same bits"
    local result=$?
    rm -r alone
    return $result
}
for from in drawn.yaml drawn.h5; do
    for file in x.png x.jpg x.html; do ok "$file of $from" again $from $file; done
    ok "x.svg of $from" again $from x.svg --set outputs.0.dpi=100
    ok "... in another size" again $from x.png --size 400x300
    ok "... a film" again $from x.mp4 --size 300x300
done
ok "... for a span of time, with a title" again drawn.h5 x.pdf --set outputs.0.dpi=100 --time 20us:150us --set title=other
ok "... one frame" again drawn.yaml x.png --frame '60 us'
ok "... and what a poster has of it" again drawn.h5 x.jpg --frame 50% --still poster
ok "... another plot" again drawn.h5 x.png --set 'outputs=[{plot: x.png, show: profiles, at: [50 us, 100 us]}]'

piped() { "$beadreel" drawn.yaml --set 'outputs=[{movie: c.gif, size: [240, 160], duration: 0.2 s}]' -o - >p.gif && exits 0 "$beadreel" --reproduce p.gif && prints "p.gif: same bits"; }
ok "a film by way of standard output" piped

# What was changed is found. Where bits differ, all that the scene makes is made: here no film and no report.
grep -v 'movie\|report' kept.yaml >light.yaml
rm -r all && "$beadreel" light.yaml -o all -q --set simulate.until='0.25 ms'
other() { # FILE SED SAYS
    sed -i "$2" "all/$1" && fails 1 "$beadreel" --reproduce "all/$1" && says "$3"
}
ok "a changed number of a table is found" other a.csv '4s/,[0-9]*\./,9999./' "a.csv: other bits from line 4 on"
ok "... and of a picture" other a.svg 's/fill="[^"]*"/fill="red"/' "a.svg: other bits from byte"
ok "-o keeps the new file" fails 1 "$beadreel" --reproduce all/a.csv -o new
ok "... as it should be" bash -c "[ \"\$(diff all/a.csv new/a.csv | grep -c '^<')\" = 1 ]"
older() { sed -i 's/beadreel [0-9.]*, scene:/beadreel 0.0.9, scene:/' all/a.svg && fails 1 "$beadreel" --reproduce all/a.svg && says "beadreel 0.0.9 made it"; }
ok "another version is named" older
mkdir alone && cp all/a.csv alone
printf 'GIF89a\x01\0\x01\xfe\0\0\0!\xfe!beadreel , scene:\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0!;' >unsaid.gif # found by fuzzing
ok "a head without a version is none" fails 1 "$beadreel" --reproduce unsaid.gif
ok "..." says "no scene is stored in it"
ok "a table alone has no scene" fails 1 "$beadreel" --reproduce alone/a.csv
ok "... and says so" says "no scene is stored in it, and no file beside it has a scene that names it"
cp new/a.csv alone && cp light.yaml alone/run.yaml
ok "its scene's file beside it serves" exits 1 "$beadreel" --reproduce alone/a.csv
ok "... but was run with another value" says "a.csv: other bits from line"
sed -i 's/0\.2 ms}/0.25 ms}/' alone/run.yaml
ok "a scene's file as it was run" exits 0 "$beadreel" --reproduce alone/a.csv
ok "... is named" prints "alone/a.csv: same bits"
ok "... with its name" prints "by the scene of run.yaml"
cp all/a.h5 alone && sed -i 's/0\.25 ms}/0.3 ms}/' alone/run.yaml
ok "a scene as it was run goes before one that may have changed" exits 0 "$beadreel" --reproduce alone/a.csv
ok "... and is named" prints "by the scene of a.h5"
rm alone/run.yaml
stranger() { cp all/a.csv alone/b.csv && cp all/a.h5 alone && fails 1 "$beadreel" --reproduce alone/b.csv && cp all/a.pdf alone/x.pdf &&
    sed -i 's/a\.pdf/a.abc/' alone/x.pdf && fails 2 "$beadreel" --reproduce alone/x.pdf; }
ok "a file that its scene does not make" stranger
ok "what is no file" fails 1 "$beadreel" --reproduce nothing.png

"$beadreel" sweep -o sweep -q --set sweep.cells=8 --set sweep.configurations=2 >/dev/null
for f in sweep.h5 force.csv sheet.pdf; do ok "a sweep's $f has the same bits" exits 0 "$beadreel" --reproduce "sweep/$f"; done
# ---- a search that takes long ----
mkdir films && echo 'contact,peak_force_N' >films/of_none.csv
for i in $(seq 300); do truncate -s 100M "films/$i.mp4"; done # holes: 30 GB to read, none on the disk
ends() {
    timeout --preserve-status -k 20 -s TERM 1 "$beadreel" --reproduce films/of_none.csv >out 2>err </dev/null
    [ $? -eq 143 ] && says "stopped by signal 15"
}
ok "a search in other files ends with SIGTERM" ends
rm -r films
# ---- what is compared stays ----
"$beadsim" clean-vs-delocalised --set simulate.until='50 us' --set 'outputs=[{table: p.csv}, {trajectory: run.h5}]' -o kept >/dev/null
echo changed >>kept/p.csv
ok "a changed table, made again above it" fails 2 "$beadsim" --reproduce kept/p.csv -o kept
ok "... is refused with a word" says "--reproduce: -o kept has kept/p.csv in it, which might be replaced; name another directory"
ok "... and stays" test "$(tail -n 1 kept/p.csv)" = changed
ok "... elsewhere, it is other bits" fails 1 "$beadsim" --reproduce kept/p.csv -o elsewhere
finish
