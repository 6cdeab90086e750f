#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# --frame: one frame of a film is what the film shows, pixel by pixel, at less work.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
chains='
  - {name: A, striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 30}, {bead: small-steel, sensor: S}], wall: brass}
  - {name: B, striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 30, spins: random, seed: 3}, {bead: small-steel, sensor: S}], wall: brass}'
# of KEYS : a lossless film. APNG is that in any quality, but takes five times as long.
of() { case $1 in *quality*) echo film.apng ;; *) echo "film.mov, quality: lossless" ;; esac; }
# film NAME KEYS [LENGTH] : a scene with one film, lossless, and its trajectory.
film() {
    cat >"$1.yaml" <<YAML
title: One frame
chains: $chains
simulate: {until: 0.9 ms}
outputs:
  - {table: peaks.csv, show: peaks}
  - {movie: $(of "$2"), size: [480, 270], ${3:-duration: 2 s, fps: 20}, $2}
  - {trajectory: run.h5, every: 3 us, fields: [displacement, velocity, force]}
YAML
    exits 0 "$beadreel" "$1.yaml" -o "$1"
}
# pixels PICTURE... : of pictures of one size, one behind the other.
pixels() { cat "$@" | ffmpeg -v fatal -f image2pipe -c:v png -i - -fps_mode passthrough -f rawvideo -pix_fmt rgba -; }
# shows INPUT DIRECTORY MOMENT:FRAME... : these frames of the film.
shows() {
    local input=$1 directory=$2 part wanted='' pictures=()
    shift 2
    for part; do
        pictures+=("frame-${part#*:}.png")
        exits 0 "$beadreel" "$input" --frame "${part%:*}" -o "${pictures[-1]}" || return
        wanted+="+eq(n\\,${part#*:})"
    done
    ffmpeg -v fatal -i "$directory"/film.* -vf "select=${wanted#+}" -fps_mode passthrough -f rawvideo -pix_fmt rgba - >film.raw && pixels "${pictures[@]}" >frame.raw
    [ "$(stat -c %s film.raw)" -eq $((4 * 480 * 270 * $#)) ] && cmp film.raw frame.raw
}
# same NAME WHAT KEYS [LENGTH] [PARTS] : the film's frames, from the scene and from its trajectory.
same() {
    ok "$2" film "$1" "$3" "${4:-}"
    # shellcheck disable=SC2086
    ok "... frames" shows "$1.yaml" "$1" ${5:-0%:0 30%:12 77%:30 100%:39}
}
if command -v ffmpeg >/dev/null; then
    same plain "beads, profile, space-time" "views: [beads, profile, spacetime]"
    same stage "a stage, with what is to come" "views: [stage, profile, spacetime], quality: high"
    ok "... at times" shows plain.yaml plain 0.46ms:20 "0.9 ms:39"
    ok "... of its trajectory" exits 0 "$beadreel" plain/run.h5 -o again/film.mov
    ok "... is that of the film of it" shows plain/run.h5 again 77%:30
    plain_canvas
    same follow "a camera, sensors" "views: [beads, profile, sensors], follow: front, field: velocity"
    same overlay "curves of all chains in one, captions with pauses, a title card" \
        "views: [profile, spacetime], layout: overlay, card: {text: Begin, for: 0.3 s}, captions: [{at: 0.3 ms, text: Now, pause: 0.3 s}]" "duration: 1.4 s, fps: 20"
    same clear "no background, a range that is given" "views: [beads, spacetime], background: none, range: [0, 40 N]"
    same draft "a draft: the file holds every second frame" "views: [beads, spacetime], quality: draft" "fps: 40, duration: 1 s" "0%:0 30%:6 100%:20"
    ok "... two moments have one frame" shows draft.yaml draft 33%:6
    same trust "a comparison run" "views: [spacetime, sensors], trust: true"
    chains='
  - {name: A, striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 400}]}'
    same lens "a lens, a single chain" "views: [beads, profile], poster: poster.png"
    ok "peak" exits 0 "$beadreel" lens.yaml --frame peak -o frame.png
    ok "... is the poster" cmp <(pixels lens/poster.png) <(pixels frame.png)
    sed -i 's/count: 400/count: 30/' lens.yaml
    ok "a scene of a short chain" exits 0 "$beadreel" lens.yaml -o lens
    ok "... its peak" exits 0 "$beadreel" lens.yaml --frame peak -o frame.png
    ok "... is its poster" cmp <(pixels lens/poster.png) <(pixels frame.png)
    ok "... from the trajectory" exits 0 "$beadreel" lens/run.h5 --frame peak -o frame.png
    ok "... too" cmp <(pixels lens/poster.png) <(pixels frame.png)
else
    skip ffmpeg "frames of films"
    film lens "views: [beads]"
fi

# ---- races ----

# race FIRST SECOND HALF : of a light and a heavy chain the word stands in the half of the picture that the faster one has.
race() {
    cat >race.yaml <<YAML
chains:
  - {name: $1, beads: [{bead: $1, count: 40}], striker: {bead: $1, velocity: 1 m/s}}
  - {name: $2, beads: [{bead: $2, count: 40}], striker: {bead: $2, velocity: 1 m/s}}
simulate: {until: 0.4 ms}
outputs: [{movie: race.mp4, duration: 1 s, fps: 20, size: [960, 540], views: [stage], race: true}]
YAML
    exits 0 "$beadreel" race.yaml --frame 0.12ms -o with.png || return
    exits 0 "$beadreel" race.yaml --frame 0.12ms --set outputs.0.race=false -o without.png || return
    cmp -l <(pixels with.png) <(pixels without.png) >differ
    awk -v half="$3" '{ n[int(($1 - 1) / (4 * 960 * 270))]++ } END { exit !(n[half] > 500 && n[1 - half] == 0) }' differ
}
if command -v ffmpeg >/dev/null; then
    ok "a race: the faster chain above is ahead" race small-steel large-steel 0
    ok "... and below" race large-steel small-steel 1
else
    skip ffmpeg "a race"
fi

# ---- the cell, beside the curve ----

cat >inset.yaml <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{cell: [large-steel, 2 ptfe], count: 20}]}
simulate: {until: 0.2 ms}
outputs: [{movie: i.mp4, duration: 1 s, fps: 20, size: [960, 540], inset: cell}]
YAML
ok "the cell is drawn into a film" exits 0 "$beadreel" inset.yaml --frame 0 -o inset.png
ok "... not into its stage alone" exits 0 "$beadreel" inset.yaml --still poster -o still.png
ok "... and not without room" fails 2 "$beadreel" inset.yaml --frame 0 -o no.png --set 'outputs.0.size=[540, 960]'
ok "... as is said" says 'inset: 540 x 960 pixels have no room for a drawing of the cell'
ok "... nor where there is none" fails 2 "$beadreel" inset.yaml --frame 0 -o no.png --set 'chain.beads=[{bead: ptfe, count: 20}]'
ok "... as is said, too" says 'inset: is cell, but no chain has a cell of two beads'

# ---- the window of a camera, on the map of all beads ----

cat >window.yaml <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 99}]}
simulate: {until: 3 ms}
outputs: [{movie: w.mp4, duration: 2 s, fps: 20, views: [beads, spacetime], size: [640, 480], follow: front, window: 20, beads: [20, 99]}]
YAML
# window MOMENT : pixels where the line of the present begins, where the window begins and ends on it, and where the line ends. The
# window has the colour of the line of progress, in the lowest row.
window() {
    exits 0 "$beadreel" window.yaml --frame "$1" -o window.png || return
    pixels window.png | od -An -v -tx4 -w2560 | awk '
        { row[NR] = $0; accent = $1 }
        END {
            for (y = 1; y <= NR; y++) {
                runs = 0; colour[0] = ""; n = split(row[y], pixel, " ")
                for (x = 1; x <= n; x++) if (pixel[x] != colour[runs]) { colour[++runs] = pixel[x]; from[runs] = x - 1 }
                from[runs + 1] = n; colour[runs + 1] = ""
                for (k = 2; k <= runs; k++) if (colour[k] == accent && from[k - 1] > 0 && from[k] - from[k - 1] > 100) {
                    print from[k - 1], from[k], from[k + 1], colour[k + 1] == colour[k - 1] ? from[k + 2] : from[k + 1]; exit
                }
            }
        }'
}
# 20 of 80 beads; at the end from 1 to 3 radii beyond the last bead, of which the map has one (test_camera).
amid() { read -r left from to right < <(window 40%) && awk -v w=$((to - from)) -v all=$((right - left)) 'BEGIN {d = w - .25 * all; exit !(d * d < 2.25)}'; }
at_the_end() {
    local l f t r
    read -r l f t r < <(window 90%) && [ "$l $t $r" = "$left $right $right" ] && awk -v w=$((t - f)) -v all=$((r - l)) 'BEGIN {w /= all; exit !(w > .235 && w < .25)}'
}
if command -v ffmpeg >/dev/null; then
    ok "the map shows the camera's window" amid
    ok "... which ends at the last bead" at_the_end
else
    skip ffmpeg "the map shows the camera's window"
fi

# ---- how much is computed ----

cat >given.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 40}]}
simulate: {until: 0.6 ms}
outputs:
  - {movie: films/one.mp4, duration: 1 s, fps: 21, views: [beads, profile], size: [320, 240], range: [0, 40 N]}
  - {image: still.png, size: [320, 240]}
  - {movie: two.webm, duration: 1 s, fps: 21, size: [320, 240], colormap: grey}
YAML
ok "a plan" exits 0 "$beadreel" given.yaml --frame 50% --plan
ok "... stops at the frame" prints "time: stops at 0.3 ms of 0.6 ms"
ok "... and leaves out the rest" prints "output still.png: skipped: not asked for"
ok "a range that must be found needs all" exits 0 "$beadreel" given.yaml --frame 50% --plan --only two
ok "... of the run" prints "time: 0.6 ms as asked"
ok "JSON" exits 0 "$beadreel" given.yaml --frame 50% --json -q
ok "... names the file and its kind" prints '"kind": "frame"'

# ---- title slides ----

cat >slide.yaml <<'YAML'
title: Beads of brass
chain: {striker: {bead: brass, velocity: 0.4 m/s}, beads: [{bead: brass, count: 40}]}
simulate: {until: 0.6 ms}
outputs:
  - {movie: slide.mp4, duration: 2 s, size: [640, 360], card: true, captions: [{at: 0.1 ms, text: Now}]}
YAML
# warm FILE X Y W H : is this part of the picture's, on average, redder than blue by a fifth?
warm() {
    read -r red _ blue < <(ffmpeg -v fatal -i "$1" -vf "crop=$4:$5:$2:$3,scale=1:1:flags=area" -f rawvideo -pix_fmt rgb24 - | od -An -tu1)
    [ $((10 * red)) -gt $((12 * blue)) ]
}
alphas() { ffmpeg -v fatal -i "$1" -vf alphaextract,format=gray -f rawvideo - | od -An -v -tu1 -w1 | sort -nu | sed -n '1p;$p' | tr -d '\n'; }
ok "a poster for slides" exits 0 "$beadreel" slide.yaml --still poster
ok "... has a name of its own" test -s slide-poster.png
ok "... of a moment" exits 0 "$beadreel" slide.yaml --still poster --frame 0.2ms -o early.png
ok "... which is another" [ "$(cmp -s early.png slide-poster.png; echo $?)" -eq 1 ]
ok "... without a background" exits 0 "$beadreel" slide.yaml --still poster --set outputs.0.background=none -o clear.png
ok "the title card" exits 0 "$beadreel" slide.yaml --frame 0% -o card.png
if command -v ffmpeg >/dev/null; then
    ok "the poster's beads are brass" warm slide-poster.png 200 120 240 120
    ok "... on nothing" [ "$(alphas clear.png | tr -d ' ')" = 0255 ]
    ok "the card's, too" warm card.png 100 140 440 60
    ok "... and those of steel are grey" exits 0 "$beadreel" slide.yaml --frame 0% -o card.png --set chain.beads.0.bead=large-steel --set chain.striker.bead=large-steel
    ok "... which shows" [ "$(warm card.png 100 140 440 60; echo $?)" -eq 1 ]
fi
ok "equations have no beads" fails 2 "$beadreel" kdv --still poster
ok "... as it says" says "kdv.yaml has no beads to show"
ok "no other kind" fails 2 "$beadreel" slide.yaml --still postre
ok "... is known" says "unknown value \`postre\`; did you mean \`poster\`"

# ---- names ----

rm -f ./*.png
ok "without -o" exits 0 "$beadreel" given.yaml --frame 50%
ok "... the film's name and the moment" test -s one-50percent.png
ok "... nothing else" [ "$(find . -newer given.yaml -name '*.png' | wc -l)" -eq 1 ]
ok "a directory" exits 0 "$beadreel" given.yaml --frame "0.2 ms" --only two.webm -o into/it
ok "... is made" test -s into/it/two-0.2ms.png
ok "options for the film" exits 0 "$beadreel" given.yaml --frame 50% --colormap grey -o grey.png
ok "... change it" [ "$(cmp -s <(pixels grey.png) <(pixels one-50percent.png); echo $?)" -eq 1 ]
ok "as do settings" exits 0 "$beadreel" given.yaml --frame 50% --set outputs.0.colormap=grey -o set.png
ok "... in the same way" cmp <(pixels grey.png) <(pixels set.png)
sed 's/^outputs:$/&\n  - {table: [a.csv, b.csv]}/' given.yaml >behind.yaml
ok "a film behind an entry of two files" exits 0 "$beadreel" behind.yaml --frame 50% --colormap grey -o behind.png
ok "... looks so, too" cmp <(pixels grey.png) <(pixels behind.png)
ok "... and by settings" exits 0 "$beadreel" behind.yaml --frame 50% --set outputs.1.colormap=grey -o behind.png
ok "... as well" cmp <(pixels grey.png) <(pixels behind.png)

# wrong MESSAGE ARGUMENT... : nothing is made.
wrong() {
    local message=$1
    shift
    fails 2 "$beadreel" "$@" -o no/no.png && says "$message" && [ ! -e no ]
}
ok "beyond the film" wrong "--frame 7ms: is not in the film, which shows 0 s to 600 us, 0% to 100%" given.yaml --frame 7ms
ok "before it" wrong "--frame -1ms: is not in the film" given.yaml --frame=-1ms
ok "more than all of it" wrong "--frame 101%: is not in the film" given.yaml --frame 101%
ok "no moment" wrong "--frame: \`soon\` " given.yaml --frame soon
ok "a wrong unit" wrong "--frame: \`3 N\` is not in a unit of s" given.yaml --frame "3 N"
ok "no movie" wrong "--frame: schematics has no movie" schematics --frame 50%
ok "--only of none" wrong "--frame: --only still.png names no movie of given.yaml" given.yaml --frame 50% --only still.png
ok "a film that a setting makes" exits 0 "$beadreel" given.yaml --frame 50% -o set.png --set 'outputs=[{image: still.png}, {movie: set.mp4, size: [160, 90]}]'
ok "... and no other picture" prints "from the scene's set.mp4"
ok "another output" wrong "--set outputs.1.colormap=grey: has no effect: the frame is one of outputs.0" given.yaml --frame 50% --set outputs.1.colormap=grey
ok "one of a sweep" wrong "--frame: has no effect with --configuration" sweep --frame 50% --configuration 1
ok "another kind of file" fails 2 "$beadreel" given.yaml --frame 50% -o no.mp4
ok "... says so" says "--frame: makes a picture (.png, .jpg, .jpeg, .tif, .tiff, .webp or .avif), and -o names no.mp4"
ok "a poster as PDF" fails 2 "$beadreel" slide.yaml --still poster -o poster.pdf
ok "... is said of the option given" says "--still: makes a picture (.png"
ok "a poster of a scene without a film" fails 2 "$beadreel" schematics --still poster
ok "... is told what to add" says "--still: schematics has no movie; add one to its outputs, such as {movie: film.mp4}"
ok "beadsim does not draw" fails 2 "$beadsim" given.yaml --frame 50%
finish
