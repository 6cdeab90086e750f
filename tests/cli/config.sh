#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A user's own settings: found where XDG says, below what scenes say, and a part of what runs store; colours from files.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
own=$XDG_CONFIG_HOME/beadreel
mkdir -p "$own/maps"
cat >scene.yaml <<'YAML'
# With a comment.
chain: {beads: [{bead: carbide, count: 20}]}
simulate: {until: 0.2 ms}
outputs:
  - {image: a.png, size: [480, 270], colormap: mine}
  - {image: b.png, size: [480, 270], style: movie, font: Lato, colormap: grey}
  - {movie: c.apng, size: [320, 240], duration: 0.3 s, fps: 10}
  - {trajectory: run.h5, every: 3 us}
  - {table: peaks.csv, show: peaks}
YAML
sed 's/carbide/brass/; s/, colormap: mine//' scene.yaml >plain.yaml
material='{density: 14900 kg/m3, modulus: 668 GPa, poisson: 0.24, radius: 4.76 mm}'
printf 'carbide: %s\nunused: %s\n' "$material" "$material" >"$own/library.yaml"
printf '# red green blue\n0 0 0\n255, 128, 0\n255\t255 255\n' >"$own/maps/mine.txt"
cat >said.yaml <<'YAML'
chain: {beads: [{bead: brass, count: 20}]}
outputs: [{image: b.png, size: [480, 270], style: movie, font: Lato, colormap: grey}]
YAML
numbers() { grep -v '^#' "$1/peaks.csv"; }

# ---- nothing, and what is wrong ----

ok "without a file" exits 0 "$beadreel" plain.yaml -o none
ok "... another scene" exits 0 "$beadreel" said.yaml -o none
ok "there is none to list" exits 0 "$beadreel" --info plain.yaml
ok "..." [ "$(grep -c 'your settings' out)" -eq 0 ]
: >"$own/config.yaml"
ok "an empty file" exits 0 "$beadreel" plain.yaml -o empty
ok "... changes nothing" cmp none/a.png empty/a.png
ok "... at all" cmp none/run.h5 empty/run.h5
# wrong MESSAGE LINE... : what a file of these lines says.
wrong() {
    local message=$1
    shift
    printf '%s\n' "$@" >"$own/config.yaml"
    fails 2 "$beadreel" scene.yaml -o no && says "$message" && [ ! -e no ]
}
file=$own/config.yaml
ok "an unknown key" wrong "$file:2:1: font-size: unknown key" "style: slide" "font-size: 3"
ok "no YAML" wrong "$file:2:1: not YAML: " "style: ["
ok "no map of colour maps" wrong "$file:1:12: colormaps: is \`mine\`; must be a map of names to files" "colormaps: mine"
ok "a style that is none" wrong "$file:2:8: outputs.0.style: is \`nice\`; must be auto, paper, slide or movie" "materials: library.yaml" "style: nice"
ok "a canvas that is none" wrong "$file:1:9: canvas: is \`gl\`; must be one of osmesa, egl, plain" "canvas: gl"
ok "a library that is not there" wrong "$file:1:12: materials: $own/no.yaml: cannot be read" "materials: no.yaml"
printf 'brass: %s\n' "$material" >"$own/brass.yaml"
own_brass() { # as heavy as written, in place of the ready one
    printf 'materials: brass.yaml\n' >"$own/config.yaml"
    printf 'chain: {beads: [{bead: brass, count: 9}]}\noutputs: [{table: t.csv}]\n' >brass.yaml
    exits 0 "$beadreel" --info brass.yaml && prints '9 beads of brass (your own)' && prints 'your settings:' &&
        exits 0 "$beadreel" --info brass.yaml --no-config && prints '9 beads of brass: radius'
}
ok "an own material goes before a ready one of its name" own_brass
printf 'carbide:\n  density: 3\n  modulus: heavy\n  poisson: 0.3\n' >"$own/wrong.yaml"
ok "a wrong material" wrong "$own/wrong.yaml:3:12: materials.carbide.modulus" "materials: wrong.yaml" "colormaps: {mine: maps/mine.txt}"
printf '0 0 0\n1 2\n' >"$own/maps/short.txt"
ok "a wrong colour" wrong "scene.yaml:5:48: outputs.0.colormap: $own/maps/short.txt: line 2: must be a row of red, green and blue" \
    "colormaps: {mine: maps/short.txt}" "materials: library.yaml"
{ yes '0 0 0' | head -n 1023; echo 1 2; } >"$own/maps/long.txt"
ok "a wrong colour in the last row that there may be" wrong "long.txt: line 1024: must be a row of red, green and blue" \
    "colormaps: {mine: maps/long.txt}" "materials: library.yaml"
yes '0 0 0' | head -n 1025 >"$own/maps/long.txt"
ok "too many colours" wrong "long.txt: line 1025: has more than 1024 colours" \
    "colormaps: {mine: maps/long.txt}" "materials: library.yaml"

# ---- what it does ----

cat >"$own/config.yaml" <<'YAML'
style: slide
font: DejaVu Sans
canvas: plain
materials: library.yaml
colormaps: {mine: maps/mine.txt}
YAML
ok "a run" exits 0 "$beadreel" scene.yaml -o run
ok "... with the canvas" grep -q 'c.apng.*painted by the plain canvas' out
ok "a scene that says all itself" exits 0 "$beadreel" said.yaml -o own
ok "... is as it was" cmp none/b.png own/b.png
ok "one that does not" exits 0 "$beadreel" plain.yaml -o own
ok "... takes style and font" [ "$(cmp -s none/a.png own/a.png; echo $?)" -eq 1 ]
ok "the numbers stay" cmp <(numbers none) <(numbers own)
ok "the library is needed" fails 2 "$beadreel" scene.yaml -o no --no-config
ok "... as --no-config says" says "there is no material \`carbide\`"
ok "--no-config: as it was" exits 0 "$beadreel" plain.yaml -o off --no-config
ok "... in every bit" cmp none/a.png off/a.png
ok "beadsim has it, too" exits 0 "$beadsim" scene.yaml -o data
ok "... with the same numbers" cmp <(numbers run) <(numbers data)
ok "what is stored is whole" exits 0 "$beadreel" run/run.h5 -o again/a.png --no-config
ok "... and drawn alike elsewhere" cmp run/a.png again/a.png
ok "a colour map by its name" exits 0 "$beadreel" run/run.h5 -o named/b.png --colormap mine
ok "... by its file" exits 0 "$beadreel" run/run.h5 -o filed/b.png --colormap "$own/maps/mine.txt" --no-config
ok "... by its colours" exits 0 "$beadreel" run/run.h5 -o listed/b.png --colormap '"#000000 #ff8000 #ffffff"'
ok "... all the same" cmp named/b.png filed/b.png
ok "... all of them" cmp named/b.png listed/b.png
ok "its other way round" exits 0 "$beadreel" run/run.h5 -o turned/b.png --colormap mine_r
ok "... by its colours" exits 0 "$beadreel" run/run.h5 -o white/b.png --colormap '"#000000 #ff8000 #ffffff_r"'
ok "... is that" cmp turned/b.png white/b.png
printf '0 0 0\n1 0.501961 0\n1 1 1\n' >unit.txt
ok "colours from 0 to 1, where the program runs" exits 0 "$beadreel" run/run.h5 -o unit/b.png --colormap unit.txt
ok "... are those" cmp named/b.png unit/b.png
mkdir -p deep && sed 's/colormap: mine/colormap: unit.txt/' scene.yaml >deep/scene.yaml && mv unit.txt deep
ok "a scene's file is beside it" exits 0 "$beadreel" deep/scene.yaml -o deep/run
ok "... and drawn" cmp run/a.png deep/run/a.png
ok "no such file" fails 2 "$beadreel" run/run.h5 -o no.png --colormap no.txt
ok "... says the option" says "--colormap:1:1: outputs.0.colormap: no.txt: cannot be read"
mkfifo deep/pipe.txt && sed 's/colormap: mine/colormap: pipe.txt/' scene.yaml >deep/pipe.yaml
ok "a scene does not wait at a pipe" fails 2 timeout 20 "$beadreel" deep/pipe.yaml -o no
ok "..." says "outputs.0.colormap: deep/pipe.txt: cannot be read: it is not a regular file"
ok "no such name" fails 2 "$beadreel" run/run.h5 -o no.png --colormap no
ok "... says it, too" says "--colormap:1:1: colormap: there is no colour map \`no\`"
ok "no such colours" fails 2 "$beadreel" run/run.h5 -o no.png --colormap '"#00 #11"'
ok "... says what they are" says "own colours must be two or more such as #ff8000"

# ---- where it is, and how it is shown ----

ok "--info" exits 0 "$beadreel" --info scene.yaml
ok "... says where" prints "your settings: $file"
ok "... and what" prints "  colour map mine: $own/maps/mine.txt"
ok "--info --json" exits 0 "$beadreel" --info run/run.h5 --json
ok "... too" prints "\"config\": {\"path\": \"$file\", \"style\": \"slide\""
ok "--info --no-config" exits 0 "$beadreel" --info run/run.h5 --no-config
ok "... does not" [ "$(grep -c 'your settings' out)" -eq 0 ]
mkdir -p home system/beadreel && mv "$XDG_CONFIG_HOME" home/.config
ok "in ~/.config" env -u XDG_CONFIG_HOME HOME="$T/home" "$beadreel" --info scene.yaml
cp home/.config/beadreel/library.yaml system/beadreel && echo "materials: library.yaml" >system/beadreel/config.yaml
system() { exits 0 env XDG_CONFIG_DIRS="/nothing:$T/system" "$beadsim" --info scene.yaml && prints "your settings: $T/system/beadreel/config.yaml"; }
ok "the machine's" system
finish
