#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Cost of pictures: movies by this program, by `ffmpeg` merely encoding the same frames, by matplotlib and VTK; space-time images.
#   pictures.sh BUILD        writes BUILD/bench/pictures.csv and a table with ratios; minutes
# BENCH_QUICK=1: a second of movie instead of ten, whose start-up then counts for much. BENCH_REPEAT=n: the best of n runs. All figures
# count the whole process: start-up, simulation, drawing, encoding. Times are of this machine as it is now: compare rows of one run.
set -e
build=$1 here=$(dirname "$0") out=$1/bench
table=$out/pictures.csv
frames=600 repeat=${BENCH_REPEAT:-1}
case ${BENCH_QUICK:-0} in 0) ;; *) frames=60 ;; esac
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%R %U %S'
scene=clean-vs-delocalised
helper=$build/tests/bench/pictures_frames

say() { echo "bench: $*" >&2; }
# measure COMMAND...: wall and CPU seconds, with all children: the least of its runs.
measure() {
    local run
    : > "$work/clocks"
    for run in $(seq "$repeat"); do
        { time "$@" > "$work/said" 2>&1; } 2>> "$work/clocks" || { say "$1 failed: $(tail -n 1 "$work/said")"; return 1; }
    done
    awk '{ cpu = $2 + $3 } NR == 1 || $1 < wall { wall = $1 } NR == 1 || cpu < least { least = cpu } END { print wall, least }' \
        "$work/clocks" > "$work/clock"
}
# row WHAT FRAMES FILE PSNR: of what was measured last. PSNR: of all pixels, of changed blocks.
row() {
    awk -v what="$1" -v frames="$2" -v bytes="$(stat -c %s "$3")" -v psnr="$4" '{
        split(psnr, p, " ")
        printf "%s,%d,%.3f,%.3f,%.2f,%.2f,%d,%s,%s\n", what, frames, $1, $2, 1e3 * $1 / frames, 1e3 * $2 / frames, bytes, p[1], p[2]
    }' "$work/clock" >> "$table"
}
movie() { # QUALITY
    measure "$build/beadreel" "$scene" --only waves.mp4 --set outputs.0.duration="$((frames / 60)) s" \
        --set outputs.0.quality="$1" -o "$work/$1"
}
encode() { # NAME OPTIONS...
    local name=$1
    shift
    measure ffmpeg -nostdin -v error -y -f rawvideo -pix_fmt yuv420p -s 1920x1080 -r 60 -i "$work/raw.yuv" "$@" \
        -pix_fmt yuv420p "$work/ffmpeg.mp4" || return 0
    row "ffmpeg $name" $frames "$work/ffmpeg.mp4" "$("$helper" psnr "$work/ffmpeg.mp4" "$work/raw.yuv")"
}
movies() {
    local options repeated=$repeat
    repeat=1
    movie lossless || return 0
    repeat=$repeated
    "$helper" raw "$work/lossless/waves.mp4" "$work/raw.yuv" > "$work/count"
    [ "$(cat "$work/count")" = $frames ] || say "$(cat "$work/count") frames differ of $frames"
    rm -r "$work/lossless"
    if command -v ffmpeg > /dev/null; then
        encode 'veryfast crf 18' -c:v libx264 -preset veryfast -crf 18
    else
        say "no ffmpeg: its encodings are left out"
    fi
    # Of half of the frames, and its camera goes a trifle otherwise: errors against the others' frames say nothing.
    movie draft && row 'beadreel draft' $frames "$work/draft/waves.mp4" ''
    for quality in standard high; do
        movie $quality || continue
        row "beadreel $quality" $frames "$work/$quality/waves.mp4" "$("$helper" psnr "$work/$quality/waves.mp4" "$work/raw.yuv")"
        command -v ffmpeg > /dev/null || continue
        read -ra options < <("$helper" options $quality)
        encode "as $quality" "${options[@]}"
    done
    rm "$work/raw.yuv"
}
find_python() { # MODULE: sets `python`, or says that there is none
    python=''
    for p in python3 /usr/bin/python3; do
        if "$p" -c "import h5py, $1" 2> /dev/null; then python=$p; fi
    done
    [ "$python" ] || say "no $1 with h5py for Python: its pictures are left out"
}
# peer NAME FRAMES COMMAND...: of the scene's trajectory, into peer.mp4.
peer() {
    local name=$1 some=$2
    shift 2
    [ -e "$work/run.h5" ] || "$build/beadreel" $scene --only run.h5 -o "$work" > /dev/null
    if measure "$@"; then row "$name" "$some" "$work/peer.mp4" ''; fi
}
peers() {
    local some=$((frames < 120 ? frames / 2 : 120))
    command -v ffmpeg > /dev/null || return 0
    find_python matplotlib
    [ ! "$python" ] || peer 'matplotlib' $some "$python" "$here/pictures_matplotlib.py" movie "$work/run.h5" "$work/peer.mp4" $some
    command -v xvfb-run > /dev/null || { say "no xvfb-run: VTK's beads are left out"; return 0; }
    find_python vtk
    [ ! "$python" ] || peer 'VTK beads only' $some xvfb-run -a "$python" "$here/pictures_vtk.py" "$work/run.h5" "$work/peer.mp4" $some
    rm -f "$work/run.h5"
}
images() {
    cat > "$work/image.yaml" << 'END'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{bead: large-steel, count: 499}]
simulate: {until: 6 ms}
outputs:
  - {trajectory: image.h5, every: 1 us, fields: [force]}
END
    "$build/beadreel" "$work/image.yaml" -o "$work" > /dev/null
    for axes in true false; do
        measure "$build/beadreel" "$work/image.h5" -o "$work/image.png" --set outputs.0.size='[1920, 1080]' \
            --set outputs.0.axes=$axes || continue
        row "beadreel image axes $axes" 1 "$work/image.png" ''
    done
    find_python matplotlib
    [ "$python" ] || return 0
    measure "$python" "$here/pictures_matplotlib.py" image "$work/image.h5" "$work/matplotlib.png" || return 0
    row 'matplotlib image' 1 "$work/matplotlib.png" ''
}
# Ratios: of movies to `ffmpeg veryfast crf 18`, of images to this program's with axes.
show() {
    awk -F, 'NR == 1 { next }
        $2 > 1 && !wall { wall = $5; cpu = $6 }
        $2 == 1 && !image++ { printf "\n"; wall = $5; cpu = $6; head = 0 }
        !head++ { printf "%-26s %6s %10s %8s %10s %8s %10s %8s %8s\n", "", "frames", "ms wall", "ratio", "ms CPU", "ratio", "bytes", "PSNR",
                         "changed" }
        { printf "%-26s %6d %10.2f %8.2f %10.2f %8.2f %10d %8s %8s\n", $1, $2, $5, $5 / wall, $6, $6 / cpu, $7, $8, $9 }' "$table"
}

echo 'what,frames,wall s,CPU s,wall ms a frame,CPU ms a frame,bytes,PSNR dB,PSNR dB where it changes' > "$table"
movies
peers
images
show
