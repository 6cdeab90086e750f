#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Films of all ready scenes, small and short: as many frames as the plan says, at a rate that ffprobe finds constant. The first is made in
# every container; the others as MP4. FILMS=first: only that, for another system whose libraries may write containers in another way.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
if ! command -v ffprobe >/dev/null; then
    skip "ffprobe (ffmpeg)" "rates of films"
    finish
fi
every="mp4 mov mkv webm apng gif"

# What makes scenes quick, and changes no film's frames.
lighter() { case $1 in kdv) echo chain.points=160 ;; zabusky-kruskal) echo chain.points=160 simulate.until=1.2 ;; shock) echo chain.points=400 ;; fput-kdv) echo chains.1.points=256 simulate.until=200 outputs.1.at=[0,200] ;; cradle) echo simulate.until=100ms ;; esac; }
# film FORMATS SCENE INDEX KEY=VALUE... : arguments for a run or a plan of output INDEX as m.EXTENSION.
film() {
    formats=$1
    local scene=$2 index=$3 pair
    shift 3
    arguments=("$scene" --canvas plain -o "$T" --set "outputs.$index.movie=[m.${formats// /, m.}]" --set "outputs.$index.poster=none")
    for pair in size='[160, 90]' duration='0.5 s' "$@"; do arguments+=(--set "outputs.$index.$pair"); done
    for pair in $(lighter "$scene"); do arguments+=(--set "$pair"); done
    for pair in $formats; do arguments+=(--only "m.$pair"); done
}
made() { exits 0 "$beadreel" "${arguments[@]}" -q; }
# planned NAME : frames in the file.
planned() { sed -n "s/^output .*$1: \([0-9]*\) frames\( (\([0-9]*\) of them [^)]*)\)\{0,1\} of .*/\1 \3/p" plan | awk '{print $NF}'; }
# rate NAME : the rates of the stream, how many frames it has, how far apart they and how long they are (least, most; in ticks), and
# how long all of them take. Packets beyond the frames are none: ffprobe 7 counts the comment behind a GIF's last picture.
rate() {
    ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=r_frame_rate,avg_frame_rate,nb_read_frames:packet=pts,duration "$1" |
        awk -F= '/^r_f/ {r = $2} /^avg/ {a = $2} /^nb/ {n = $2} /^dur/ {long[++d] = $2} /^pts/ {at[++p] = $2}
                 END {
                     dl = dm = long[1]; gl = gm = at[2] - at[1]
                     for (i = 2; i <= p && i <= n; i++) {
                         g = at[i] - at[i - 1]
                         if (g < gl) gl = g; if (g > gm) gm = g
                         if (long[i] < dl) dl = long[i]; if (long[i] > dm) dm = long[i]
                     }
                     print r, a, n, dl, dm, gl, gm, at[i - 1] + long[i - 1] - at[1]
                 }'
}
# constant NAME FPS TICKS FRAMES : all frames are within TICKS (of the container's clock) of as long.
constant() {
    local r a n dl dm gl gm all
    read -r r a n dl dm gl gm all < <(rate "$1")
    echo "$1: rates $r and $a, $n frames (planned: $4) of $dl to $dm, $gl to $gm apart, $all for all"
    case $1 in
    *.apng) r=$a ;; # ffprobe takes it from the file's clock
    # From the clock, of 10 ms, or from the first frame alone: the rate is that of all frames.
    *.gif) r=$(awk -v n="$n" -v all="$all" -v fps="$2" 'BEGIN {off = 100 * n / fps - all; print (off * off < 1 ? fps : 100 * n / all) "/1"}') a=$r ;;
    esac
    [ "$r" = "$2/1" ] && [ "$a" = "$2/1" ] && [ "$n" = "$4" ] && [ "$n" -gt 10 ] && [ $((dm - dl)) -le "$3" ] && [ $((gm - gl)) -le "$3" ]
}
all_constant() { # FPS: as asked for
    "$beadreel" "${arguments[@]}" --plan >plan
    local name
    for name in $formats; do
        case $name in
        mkv | webm) ok "... m.$name, to 1 ms" constant "m.$name" "$1" 1 "$(planned "m.$name")" ;;
        gif) ok "... m.gif, to 10 ms" constant m.gif "$(($1 > 50 ? $1 / 2 : $1))" $((100 % $1 > 0)) "$(planned m.gif)" ;;
        *) ok "... m.$name" constant "m.$name" "$1" 0 "$(planned "m.$name")" ;;
        esac
    done
}

films=0 formats=$every
for scene in $("$beadreel" --list scenes | awk '{print $1}'); do
    grep -q '^[^#]*movie:' "$BEADREEL_ASSETS/scenes/$scene.yaml" || continue # a plan takes as long as a small film
    while read -r index; do
        films=$((films + 1))
        film "$formats" "$scene" "$index"
        ok "films of $scene" made
        all_constant 60
        formats=mp4
        [ "${FILMS:-}" != first ] || break 2
    done < <("$beadreel" --info "$scene" | sed -n 's/^output \([0-9]*\): movie .*/\1/p')
done
ok "scenes have films" [ $films -ge "$([ "${FILMS:-}" = first ] && echo 1 || echo 7)" ]

film "$every" teaching 0 fps=25 card='{for: 0.4 s}' captions='[{at: 0.5 ms, text: Stop, pause: 0.6 s}]'
ok "a title card, a pause and 25 frames a second" made
all_constant 25
# A draft may leave frames out, and says how many there are.
film "mp4 mkv webm" shock 0 quality=draft
ok "a draft" made
"$beadreel" "${arguments[@]}" --plan >plan
for name in mp4 mkv webm; do
    read -r _ _ frames _ < <(rate "m.$name")
    ok "... m.$name has the 16 of 30 frames that the plan says" [ "$frames $(planned "m.$name")" = "16 16" ]
done
finish
