#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One file by its name: of a scene, and of a trajectory or a sweep that is drawn again, with the options for it.
source "$(dirname "$0")/../shell.bash"
plain_canvas
cd "$T" || exit 1
cat >scene.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 40}, {bead: small-steel, sensor: A}, {bead: large-steel, count: 30}]}
simulate: {until: 0.6 ms}
outputs:
  - {movie: film.mp4, size: [320, 240], duration: 0.3 s, fps: 10, views: [beads, profile], colormap: magma}
  - {trajectory: run.h5, every: 5 us}
  - {plot: sensor.png, show: sensors, size: [640, 400]}
  - {image: [force.png, force.pdf], size: [640, 400], axes: false}
YAML
# same FILE FILE : but for what they say of themselves.
decoded() {
    ffmpeg -v error -y -i "$1" -i "$2" -map 0:v -f rawvideo -pix_fmt rgb24 one.rgb -map 1:v -f rawvideo -pix_fmt rgb24 two.rgb </dev/null && [ -s one.rgb ] && [ -s two.rgb ]
}
same() { decoded "$1" "$2" && cmp one.rgb two.rgb; }
differ() { decoded "$1" "$2" && ! cmp -s one.rgb two.rgb; }

ok "a run" exits 0 "$beadreel" scene.yaml -o run

# ---- other formats ----

# redrawn FILE NAME FORMAT SIZE : the output NAME of the scene, under the name of the file.
redrawn() {
    exits 0 "$beadreel" scene.yaml -o "$1" && grep -q "from the scene's $2" out && file "$1" | grep -q "$3" && file "$1" | grep -qE "$4"
}
if command -v file >/dev/null; then
    ok "the first picture as JPEG" redrawn a.jpg sensor.png 'JPEG image' 640x400
    ok "... as TIFF" redrawn a.tif sensor.png 'TIFF image.*LZW' 'height=400.*width=640'
    ok "... as AVIF, WebP is a picture, too" redrawn a.avif sensor.png 'AVIF Image' .
    ok "a page for print of one for print" redrawn a.eps force.pdf 'PostScript.*type EPS' .
    ok "a film of the film" redrawn a.webm film.mp4 WebM .
else
    skip file "other formats"
fi
# 400 pixels at 96 an inch are 300 points.
ok "a page for print" exits 0 "$beadreel" scene.yaml -o a.eps
ok "EPS is as large as the page" grep -qa '^%%BoundingBox: 0 0 480 300' a.eps
ok "... and not from today" exits 1 grep -qa CreationDate a.eps
printf 'chain: {beads: [{bead: brass, count: 5}]}\noutputs: [{image: figure.pdf, style: paper, size: [86 mm, 43 mm]}]\n' >paper.yaml
ok "a picture for the screen of a page for print" exits 0 "$beadreel" paper.yaml -o x.png
ok "... has its size" [ "$(od -An -t u4 --endian=big -j 16 -N 8 x.png | xargs)" = "2031 1016" ] # 600 an inch
ok "a frame as JPEG" exits 0 "$beadreel" scene.yaml --frame 50% -o frame.jpg
ok "JPEG without a background" fails 2 "$beadreel" scene.yaml -o none.jpg --set outputs.0.background=none
ok "... is not made" says "background: \`none\` needs a file that can be transparent"

# ---- standard output ----

mkdir tmp
piped() { TMPDIR=tmp "$beadreel" scene.yaml --only force.png -o - >piped.png 2>err && same piped.png run/force.png; }
if command -v ffmpeg >/dev/null; then ok "one file to standard output" piped; else skip ffmpeg "standard output"; fi
ok "several files" fails 2 "$beadreel" scene.yaml -o -
ok "... are too many" says "-o -: is for one file, which --only names, and not for 5: film.mp4, run.h5, sensor.png, force.png, force.pdf"
ok "... with the results as JSON" fails 2 "$beadreel" scene.yaml --only force.png -o - --json
ok "a trajectory" fails 2 "$beadreel" run/run.h5 -o -
ok "... has no file of its own" says "-o -: is for one file of a scene; of run/run.h5 name the file to draw: -o picture.png"
cp run/run.h5 named
ok "... by any name" fails 2 "$beadreel" named -o -
ok "... has none either" says "-o -: is for one file of a scene; of named name"
ok "... nothing is left" [ -z "$(ls tmp)" ]

# ---- drawing again ----

ok "a trajectory" exits 0 "$beadreel" run/run.h5 -o plain/deep/force.png
ok "... in folders that are made" test -s plain/deep/force.png
ok "outputs.0 is the file" exits 0 "$beadreel" run/run.h5 -o set/force.png --set outputs.0.colormap=grey
ok "--colormap is the same" exits 0 "$beadreel" run/run.h5 -o option/force.png --colormap grey
if command -v ffmpeg >/dev/null; then
    ok "... in each pixel" same set/force.png option/force.png
    ok "... and another picture than without" differ set/force.png plain/deep/force.png
else
    skip ffmpeg "the pixels"
fi
# ---- figures of panels ----

cat >panels.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 40}, {bead: small-steel, sensor: A}, {bead: large-steel, count: 30}]}
simulate: {until: 1 ms}
outputs: [{plot: figure.svg, size: [640, 800], panels: [[{field: force}], [{field: velocity}, {show: sensors}]]}]
YAML
figure() { exits 0 "$beadreel" panels.yaml -o p.svg "$@" && prints "from the scene's figure.svg"; }
ok "what images show is of all images of a figure" figure --beads 57:63 --time 0.2ms:0.4ms --colormap grey
labels() { grep -o '<tspan[^>]*>[^<]*<' p.svg | sed 's/.*>\(.*\)</\1/' | grep -cxF -- "$1"; }
ok "... both have the beads" [ "$(labels 57),$(labels 63),$(labels 40)" = 2,2,0 ]
ok "... all three panels have the time" [ "$(labels 200),$(labels 100)" = 3,0 ]
figure --field velocity >tmp/out
ok "a field is that of images, not of curves" [ "$(labels 'bead force (N)'),$(labels 'velocity (mm/s)'),$(labels 'force (N)')" = 1,2,0 ]
printf 'chain: {beads: [{bead: brass, count: 5}]}\noutputs: [{plot: peaks.svg, panels: [[{show: peaks}]]}]\n' >peaks.yaml
ok "panels without an image" fails 2 "$beadreel" peaks.yaml -o p.svg --range 0:1
ok "... have nothing to colour" says "is a key of a single panel"

# draws OPTION... : another picture than without.
draws() { exits 0 "$beadreel" run/run.h5 -o "again.png" "$@" && ! cmp -s again.png plain/deep/force.png && rm again.png; }
for option in '--range 0:10' '--range [0,10]' '--range 0,10' '--time 0.2ms:0.4ms' '--time 0.2ms:' '--time [0.2ms,auto]' '--beads 30:60' \
    '--beads 30-60' '--beads 30..60' '--beads 30–60' '--beads [30,60]' '--range 0..10' '--range -1..1' '--time 0.2ms..0.4ms' '--size 400x300' '--size [400,300]' '--field velocity' '--field velocity --colormap vik' \
    '--views beads,spacetime --set outputs.0.axes=true' '--style paper --size 86mmx60mm --set outputs.0.axes=true'; do
    # shellcheck disable=SC2086
    ok "$option" draws $option
done
columns() { # BEADS NUMBER FIRST LAST : a table of the run has so many columns of beads
    "$beadreel" run/run.h5 -q -o some.csv --beads "$1" >out 2>&1 && head -n 1 some.csv | tr , '\n' | grep '^bead_[0-9]*$' >named
    [ "$(wc -l <named)" = "$2" ] && [ "$(head -n 1 named)" = "bead_$3" ] && [ "$(tail -n 1 named)" = "bead_$4" ] || { cat out named; return 1; }
}
last=$("$beadreel" --info run/run.h5 | sed -n 's/^chain 0: striker and \([0-9]*\) beads.*/\1/p')
ok "a table of beads 5 to 9" columns 5:9 5 5 9
ok "... written in another way" columns 5-9 5 5 9
ok "... of those from the one before the last" columns $((last - 1)): 2 $((last - 1)) "$last"
ok "... of those up to 3" columns :3 4 0 3
ok "... of two" columns 5,9 2 5 9
ok "... as scenes write it" columns '[1..3, 7, 2..4]' 5 1 7
ok "a film of beads 30 to 60 with another colour map" exits 0 "$beadreel" run/run.h5 -o film.mp4 --beads 30:60 --colormap viridis
ok "... is one" test -s film.mp4
ok "a picture for which the scene has none" exits 0 "$beadreel" run/run.h5 -o other.svg --size 86mmx60mm
ok "the plot of that name" exits 0 "$beadreel" run/run.h5 -o plot/sensor.png
ok "... is not what has colours" fails 2 "$beadreel" run/run.h5 -o plot/sensor.png --colormap grey
ok "... and says so" says "--colormap:1:1: outputs.0.colormap: is a key of outputs of kind image, movie, sheet"
ok "a picture of another name" exits 0 "$beadreel" run/run.h5 -o new.png --colormap grey
ok "... is the first that has the key" [ "$(stat -c %s new.png)" -gt 1000 ]

# wrong MESSAGE ARGUMENT... : nothing is made.
wrong() {
    local message=$1
    shift
    fails 2 "$beadreel" run/run.h5 -o no/no.png "$@" && says "$message" && [ ! -e no ]
}
ok "--only has no effect" wrong "--only force.png: has no effect" --only force.png
ok "a colour map that is none, found as it is drawn" wrong "--colormap:1:1: colormap: there is no colour map \`nope\`" --colormap nope
ok "... by --set" fails 2 "$beadreel" run/run.h5 -o no/force.png --set title=x --set outputs.0.colormap=nope
ok "... the second" says "--set:2:20: colormap: there is no colour map \`nope\`"
ok "a size without room" wrong "--size:1:1: size: 9 x 9 pixels leave no room" --size 9x9 --set outputs.0.axes=true
ok "what was computed stays" wrong "--set:1:1: chain.striker.velocity: has no effect: run/run.h5" --set chain.striker.velocity=1
ok "... the second setting" wrong "--set:2:1: simulate.until: has no effect" --set title=x --set simulate.until=1
ok "what is shown does not" exits 0 "$beadreel" run/run.h5 -o title.png --set title=x --set chain.label=y
ok "another output" wrong "--set:1:9: outputs.1.colormap: the list has no element 1; it has 1" --set outputs.1.colormap=grey
ok "an output's number counts from --set, not from options" wrong "--set:2:" --size 64x64 --set title=x --set outputs.0.colour=grey
ok "no such map" wrong "there is no colour map \`gray\`" --colormap gray
ok "no such view" wrong "--views:1:2: outputs.0.views.0: " --views beds
ok "half a range" wrong "--range:1:1: outputs.0.range: " --range 4
ok "a wrong unit" wrong "--range:1:5: outputs.0.range" --range 0:3m
ok "no time" wrong "--time:1:1: outputs.0.time: is \`soon\`" --time soon
ok "beads that are not there" wrong "beads" --beads 90:95
ok "an empty value" wrong "--size:1:1: outputs.0.size: is nothing" --size ''
ok "three sizes" wrong "--size:1:1: outputs.0.size: is a list" --size 1x2x3
ok "a style of films" fails 2 "$beadreel" run/run.h5 -o no.mp4 --style paper
ok "... which have none" says "not of movie"
ok "several outputs" wrong "-o names one file, but there are 2 outputs" --set 'outputs=[{image: a.png}, {image: b.png}]'
ok "a part" wrong "--shard: " --shard 1/2
ok "beadsim does not draw" fails 2 "$beadsim" run/run.h5 -o no.png
ok "... and has no colours" fails 2 "$beadsim" run/run.h5 -o a.csv --colormap grey
ok "... but makes tables" exits 0 "$beadsim" run/run.h5 -o sensors.csv --set outputs.0.time='[0.1 ms, 0.2 ms]'

# ---- a scene ----

ok "one file of a scene" exits 0 "$beadreel" scene.yaml -o one/sub/force.pdf --size 60mmx40mm
ok "... and nothing else" test "$(find one -type f)" = one/sub/force.pdf
ok "a film that the scene has not by this name" exits 0 "$beadreel" scene.yaml -o one/film.gif --set outputs.0.duration='0.2 s'
ok "a table" exits 0 "$beadsim" scene.yaml -o one/peaks.csv
ok "... of peaks" grep -q '^contact,peak_force_N' one/peaks.csv
ok "a trajectory of its own" exits 0 "$beadsim" scene.yaml -o one/again.h5
ok "... which can be drawn again" exits 0 "$beadreel" one/again.h5 -o one/again.png
ok "the plan of one file" exits 0 "$beadreel" scene.yaml --plan -o one/force.png
ok "... is that of it alone" test "$(grep -c '^output ' out)" = 1
ok "an absolute path" exits 0 "$beadreel" scene.yaml -o "$T/absolute/force.png"
mkdir folder.png
ok "a directory stays one" exits 0 "$beadreel" scene.yaml -o folder.png --only force.png
ok "... with the file in it" test -s folder.png/force.png
ok "beadsim makes no pictures" fails 2 "$beadsim" scene.yaml -o no.png
ok "... and no directory of that name" test ! -e no.png
ok "--only besides" fails 2 "$beadreel" scene.yaml -o no.png --only force.png
ok "options without a file" fails 2 "$beadreel" scene.yaml -o folder --colormap grey
ok "... ask for one" says "--colormap: of which output? name it with -o FILE, or use --set outputs.N.colormap=grey"
ok "... or for a file in the plan" fails 2 "$beadreel" scene.yaml --plan --time 0:1ms
ok "a poster goes along" exits 0 "$beadreel" scene.yaml -o p/film.mp4 --set outputs.0.poster=poster.png
ok "... beside the film" test -s p/poster.png

# ---- one of several chains ----

cat >several.yaml <<'YAML'
chains:
  - {name: short, beads: [{bead: brass, count: 9}]}
  - {name: the long one, beads: [{bead: large-steel, count: 20}, {bead: brass, sensor: B}]}
simulate: {until: 0.2 ms}
outputs:
  - {image: both.svg, size: [400, 300]}
  - {movie: film.mp4, size: [320, 240], duration: 0.2 s, notes: [{at: 0.1 ms, bead: 9, chain: the long one, text: long}]}
  - {trajectory: several.h5, every: 2 us}
YAML
"$beadreel" several.yaml -o . --only several.h5 -q >/dev/null
sed '2d; s/several/alone/' several.yaml >alone.yaml
"$beadreel" alone.yaml -o . --only alone.h5 -q >/dev/null
for from in several.h5 several.yaml; do
    ok "the second chain of $from" exits 0 "$beadreel" $from --configuration 'the long one' -o second.png
    "$beadreel" "${from/several/alone}" -o alone.png -q >/dev/null
    if command -v ffmpeg >/dev/null; then ok "... as a run of it alone" same second.png alone.png; else skip ffmpeg "its pixels"; fi
    ok "... as a GIF, with the film's note to it" exits 0 "$beadreel" $from --configuration 'the long one' -o second.gif
    ok "... which is one" [ "$(head -c 6 second.gif)" = GIF89a ]
    ok "... with another name" exits 0 "$beadreel" $from --configuration 'the long one' -o second.svg --set chains.0.name=another
    ok "... nothing else" exits 1 grep -q short second.svg
    ok "a note to a chain that is not shown" fails 2 "$beadreel" $from --configuration short -o first.gif
    ok "... says so" says "notes.0.chain: "
    ok "no such chain of $from" fails 2 "$beadreel" $from --configuration long -o no.png
    ok "... but others" says "--configuration long: no chain has this name; there are short, the long one"
done
ok "sensors of the second chain" exits 0 "$beadsim" several.h5 --configuration 'the long one' -o b.csv --set 'outputs=[{table: b.csv, show: sensors}]'
ok "... are its own" grep -q B b.csv
ok "of one chain there is no other" fails 2 "$beadreel" run/run.h5 --configuration A -o no.png
ok "..." says "--configuration A: run/run.h5 has only one chain"

# ---- a sweep ----

cat >sweep.yaml <<'YAML'
sweep: {cells: 6, configurations: 2, magnetism: [0, 1]}
outputs: [{sweep: sweep.h5}, {plot: force.png, size: [640, 480]}, {table: force.csv}]
YAML
ok "one file of a sweep" exits 0 "$beadreel" sweep.yaml -o s/new.pdf --size 86mmx60mm
ok "... alone" test "$(find s -type f)" = s/new.pdf
ok "its results" exits 0 "$beadsim" sweep.yaml -o s/sweep.h5
ok "... drawn again" exits 0 "$beadreel" s/sweep.h5 -o s/force.png --size 400x300
ok "... with a colour map" fails 2 "$beadreel" s/sweep.h5 -o s/no.png --colormap grey
ok "... which it has none of" says "--colormap:1:1: outputs.0.colormap: "
ok "... one chain of it" exits 0 "$beadreel" s/sweep.h5 --configuration 1 -o s/one.png --colormap grey --beads 2:9
ok "... a sheet of it" exits 0 "$beadreel" --sheet s/sweep.h5 -o s/sheet.png --size 640x480
ok "... with --only" fails 2 "$beadreel" s/sweep.h5 -o s/no.png --only force.png
# Runs of one field: all that is missing for a film is named at once, and a film of what is there needs no more than that.
for field in velocity force energy; do
    ok "a run of one field: $field" exits 0 "$beadreel" scene.yaml -o one --set "outputs=[{trajectory: $field.h5, every: 5 us, fields: [$field]}]"
    ok "... a film of its beads lacks two others" eval 'fails 1 "$beadreel" one/$field.h5 -o beads.mp4 --field $field && says "needs the fields \`contact-force, displacement\`" && says "views='"'"'[profile, spacetime]'"'"'"'
    ok "... one without beads does not" exits 0 "$beadreel" one/$field.h5 -o curves.mp4 --field $field --size 320x240 --set outputs.0.duration='0.2 s' --set 'outputs.0.views=[profile, spacetime]'
done
finish
