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
ok "a time without its unit" told 'scene.yaml:2:19: simulate.until: `2e7` is out of range; must be above 0, at most 1e6 s or auto; did you mean `2e7 ms`?' \
    "chain: {beads: [{bead: brass}]}\nsimulate: {until: 2e7}$end"
ok "... in brackets" told 'chain.striker.443 m/s: unknown key; in { } a comma ends a value: numbers have a decimal point' \
    "chain: {beads: [{bead: brass}], striker: {velocity: 0,443 m/s}}$end"
ok "part of a material's name" told 'there is no material `steel`; did you mean `large-steel` or `small-steel`?' "chain: {beads: [{bead: steel}]}$end"
ok "no outputs" told 'scene.yaml:1:1: outputs: is missing: the files to make, at least one: see outputs; such as `outputs: [{image: force.png}' 'chain: {beads: [{bead: brass}]}'
ok "a missing colon, of a value" told 'simulate: is `until 2 ms`; must be a map of keys and values: how long and how exactly to compute; is the colon missing after `until`?' \
    "chain: {beads: [{bead: brass}]}\nsimulate:\n  until 2 ms$end"
ok "... of a list" told 'chain.beads [{bead: unknown key; is the colon missing after `beads`?' "chain:\n  beads [{bead: brass}]\n  wall: rigid$end"
ok "... of a map" told 'is the colon missing after `striker`?' "chain:\n  striker {bead: brass}\n  beads: [{bead: brass}]$end"
ok "... of a word" told "could not find expected ':'; a key ends with a colon and a space: is one missing here, or in the line before?" "chain:\n  beads: [{bead: brass}]\n  wall rigid$end"
ok "... of a section" told 'scene.yaml:2:8: not YAML: mapping values are not allowed in this context; is a colon missing in the line before?' "chain\n  beads: [{bead: brass}]$end"
ok "... of an entry" told 'is the colon missing after `bead`?' "chain:\n  beads:\n  - bead brass$end"
ok "a key in the wrong place" told 'scene.yaml:1:1: colormap: unknown key; did you mean `outputs.N.colormap`?' "colormap: grey\nchain: {beads: [{bead: brass}]}$end"
ok "... of --set" fails 2 "$beadreel" clean-vs-delocalised --set colormap=grey
ok "... as well" says '--set:1:1: colormap: unknown key; did you mean `outputs.N.colormap`?'
ok "... of the run" fails 2 "$beadreel" clean-vs-delocalised --set until=1ms
ok "... too" says 'did you mean `simulate.until`?'

# The kind of output that makes such files; what keys are called here; what moves nothing; sizes that a codec cannot have.
ok "a panel without room" told 'scene.yaml:2:69: size: 200 x 260 pixels leave no room for 1 plot' \
    "chain: {beads: [{bead: brass, count: 40}], striker: {velocity: 0.4 m/s}}\noutputs: [{image: a.png, size: [200, 260], panels: [[{show: peaks}, {field: force}]]}]"
ok "a film as an image" told 'scene.yaml:2:19: outputs.0.image: `a.mp4` lacks the extension of files of this kind; must be a name with .png, .pdf, .svg, .eps, .jpg, .jpeg, .tif, .tiff, .webp or .avif; did you mean `movie: a.mp4`?' \
    "chain: {beads: [{bead: brass}]}\noutputs: [{image: a.mp4}]"
ok "a page as a table" told 'did you mean `report: a.html`?' "chain: {beads: [{bead: brass}]}\noutputs: [{table: a.html}]"
ok "a key under another name" told 'scene.yaml:1:31: chain.beads.0.diameter: unknown key; did you mean `radius`, half of it?' "chain: {beads: [{bead: brass, diameter: 9 mm}]}$end"
ok "... of a material" told 'materials.x.young: unknown key; did you mean `modulus`?' "materials: {x: {young: 1 GPa, poisson: .3, radius: 1 mm, mass: 1 g}}\nchain: {beads: [{bead: x}]}$end"
ok "... of a picture" told 'outputs.0.width: unknown key; did you mean `size`: [WIDTH, HEIGHT]?' "chain: {beads: [{bead: brass}]}\noutputs: [{image: a.png, width: 86 mm}]"
ok "a strike without speed" told 'scene.yaml:1:53: chain.striker.velocity: nothing moves at first, so no step follows from the motion: give a velocity, such as `velocity: 0.4 m/s`, or a step' \
    "chain: {beads: [{bead: brass}], striker: {velocity: 0}}$end"
ok "... a start without one" told 'scene.yaml:3:10: chain.start: nothing moves at first, so no step follows from the motion: give a velocity, such as `start: [{bead: 0, velocity: 0.4 m/s}]`' \
    "chain:\n  beads: [{bead: brass, count: 3}]\n  start: [{bead: 2, velocity: 0}]\nsimulate: {until: 1 ms}$end"
ok "... of the second chain" told 'scene.yaml:3:70: chain.striker.velocity: nothing moves at first' \
    "chains:\n- {name: a, beads: [{bead: brass}]}\n- {name: b, beads: [{bead: brass}], striker: {bead: brass, velocity: 0}}$end"
ok "... on the command line" fails 2 "$beadreel" clean-vs-delocalised -o none.png --set chains.1.striker.velocity=0
ok "... is said of that" says '--set:1:27: chain.striker.velocity: nothing moves at first'
ok "a step that is too long" told 'scene.yaml:2:18: simulate.step: 0.001 s is too long for `rk4` to be stable: at most' \
    "chain: {beads: [{bead: brass, count: 9}]}\nsimulate: {step: 1 ms, until: 9 ms, method: rk4}$end"
ok "... for an equation" told 'scene.yaml:2:18: simulate.step: 9 is too long for' \
    "chain: {equation: fput, points: 31, start: {mode: 1, amplitude: 1}}\nsimulate: {step: 9, until: 99}$end"
ok "a method that does not suit the scene" told 'scene.yaml:2:20: simulate.method: `pefrl` does not support drives' \
    "chain: {precompression: 20 N, beads: [{bead: brass, count: 9}], drive: {displacement: sine, amplitude: 10 nm, frequency: 1 kHz}}\nsimulate: {method: pefrl, until: 1 ms}$end"
ok "an odd size of a film" told 'scene.yaml:2:32: size: 641 x 361 is odd, and this codec needs even sizes; the nearest is 642 x 362' "chain: {beads: [{bead: brass}]}\noutputs: [{movie: a.mp4, size: [641, 361]}]"

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
for name in a.bmp b.heic c.PS d.avi e.xyz f.lammpst; do
    ok "-o $name" fails 2 "$beadreel" good.yaml -o $name
    ok "... says what there is" says "--output: \`$name\` must end like one of .h5, .png, .pdf, .svg, .eps, .jpg"
    ok "... and makes no directory" test ! -e $name
done
ok "... each once" test "$(grep -o '\.png' err | wc -l)" -eq 1
ok "... and how a directory is meant" says '`f.lammpst/` would be a directory'
for name in run.2 run.d .hidden f.lammpst/; do
    ok "-o $name" "$beadreel" good.yaml -q -o $name
    ok "... is a directory" test -f "$name/peaks.csv"
done
cp good.yaml waves.yaml
ok "a scene of nearly this name" fails 2 "$beadreel" waves.yml
ok "... is named" says 'waves.yml: no such file, and no ready scene; did you mean `waves.yaml`?'
ok "a configuration of a chain that has one" fails 2 "$beadreel" waves.yaml --configuration 3 -o a.png
ok "... names the option that was given" says '--configuration:1:1: sweep: finds no `spins: random`'
ln -s loop loop
ok "a link to itself" fails 1 "$beadreel" loop
ok "... is told by the system's reason" says 'loop: cannot be read: Too many levels of symbolic links'
ok "a file taken for a folder" fails 1 "$beadreel" scene.yaml/waves.yaml
ok "... likewise" says 'waves.yaml: cannot be read: Not a directory'
cp good.yaml "$(printf 'nigh\e[31mt.yaml')"
ok "... without its control characters" eval 'fails 2 "$beadreel" "$(printf "nigh\e[31m.yaml")" && says "did you mean" && ! grep -q "$(printf "\e")" err'
"$beadreel" good.yaml -q -o . --set 'outputs=[{trajectory: run.h5}]' >/dev/null
mkdir folder
ok "a directory for one picture" eval 'fails 2 "$beadreel" run.h5 -o folder && says "\`folder\` is a directory; name the file to make in it"'
plan() { "$beadreel" good.yaml --plan --set "outputs=[{movie: m.mp4, speed: $1}]"; }
ok "one factor is a speed" eval 'plan 1/2000 >one && plan "[{at: 0, factor: 1/2000}]" >many && cmp one many && plan 1/4000 >other && ! cmp -s one other'
ok "... but no word" eval 'fails 2 plan slow && says "must be a factor such as 1/4000, or a list"'
printf "\\xff\\xd8\\xff\\xe0picture" | tee picture.jpg >picture.yaml
ok "a picture is no scene" eval 'fails 2 "$beadreel" --info picture.yaml && says "a scene is a text in UTF-8, which a picture or a film is not"'
ok "... and is told by its name, too" eval 'fails 2 "$beadreel" --info picture.jpg && says "is a result, not a scene; if beadreel made it, --reproduce"'
ok "a plan says milliseconds where there are many" eval '"$beadsim" good.yaml --plan --set "outputs=[{table: t.csv, show: sensors, beads: 2, every: 20 ms}]" --set simulate.until=0.1s >out && grep -q "6 times every 20 ms until 100 ms" out'
# What the options for -o mean, written in several ways.
drawn() { # NAME OPTION VALUE : its pixels, as NAME.raw
    "$beadreel" good.yaml -q -o "$1.png" "--$2=$3" >/dev/null && ffmpeg -v error -y -i "$1.png" -f rawvideo "$1.raw"
}
same() { # VALUE OPTION OTHER...
    local given=$1 option=$2 other
    drawn one "$option" "$given" || return 1
    for other in "${@:3}"; do drawn two "$option" "$other" && cmp one.raw two.raw || return 1; done
}
ok "beads from one on" same '[2, 5]' beads 2: 2:5 2-5 '[2, auto]'
ok "... up to one" same '[0, 3]' beads :3 0-3
ok "a range" same '[0, 30]' range 0:30 0-30 0,30
ok "... with exponents and signs" same '[-5, 30]' range -5:30 -5e0:3e1
ok "--quiet" exits 0 "$beadreel" good.yaml -o quiet --quiet
ok "... says nothing of progress" test ! -s err
ok "-q" exits 0 "$beadreel" good.yaml -o quiet -q
finish
