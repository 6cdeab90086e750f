#!/bin/bash
# Cost of pictures: movies by this program, by `ffmpeg` merely encoding the same frames, by matplotlib; space-time images.
#   pictures.sh BUILD        writes BUILD/bench/pictures.csv and a table
# BENCH_QUICK=1: a second of movie instead of ten. All figures count the whole process: start-up, simulation, drawing, encoding.
# Wall times are of this machine as it is now: compare rows of one run.
set -e
build=$1 here=$(dirname "$0") out=$1/bench
table=$out/pictures.csv
frames=600
case ${BENCH_QUICK:-0} in 0) ;; *) frames=60 ;; esac
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%R %U %S'
scene=clean-vs-delocalised

say() { echo "bench: $*" >&2; }
# measure COMMAND...: wall and CPU seconds, with all children, of its run.
measure() { { time "$@" > "$work/said" 2>&1; } 2> "$work/clock" || { say "$1 failed: $(tail -n 1 "$work/said")"; return 1; }; }
# row WHAT FRAMES FILE PSNR: of what was measured last. PSNR: of all pixels, of changed blocks.
row() {
    awk -v what="$1" -v frames="$2" -v bytes="$(stat -c %s "$3")" -v psnr="$4" '{
        split(psnr, p, " ")
        printf "%s,%d,%.3f,%.3f,%.2f,%d,%s,%s\n", what, frames, $1, $2 + $3, 1e3 * ($2 + $3) / frames, bytes, p[1], p[2]
    }' "$work/clock" >> "$table"
}
movie() { # QUALITY
    measure "$build/beadreel" "$scene" --only waves.mp4 --set outputs.0.duration="$((frames / 60)) s" \
        --set outputs.0.quality="$1" -o "$work/$1"
}
encode() { # NAME OPTIONS...
    local name=$1
    shift
    measure ffmpeg -nostdin -v error -y -f rawvideo -pix_fmt yuv420p -s 1920x1080 -r 60 -i "$work/raw.yuv" -c:v libx264 "$@" \
        -pix_fmt yuv420p "$work/ffmpeg.mp4" || return 0
    row "ffmpeg $name" $frames "$work/ffmpeg.mp4" "$("$build/tests/bench/pictures_frames" psnr "$work/ffmpeg.mp4" "$work/raw.yuv")"
}
movies() {
    movie lossless || return 0
    "$build/tests/bench/pictures_frames" raw "$work/lossless/waves.mp4" "$work/raw.yuv" > "$work/count"
    [ "$(cat "$work/count")" = $frames ] || say "$(cat "$work/count") frames differ of $frames"
    rm -r "$work/lossless"
    for quality in draft standard high; do
        movie $quality || continue
        row "beadreel $quality" $frames "$work/$quality/waves.mp4" \
            "$("$build/tests/bench/pictures_frames" psnr "$work/$quality/waves.mp4" "$work/raw.yuv")"
    done
    command -v ffmpeg > /dev/null || { say "no ffmpeg: its encodings are left out"; return 0; }
    encode 'veryfast crf 18' -preset veryfast -crf 18
    # The options of render/movie_codecs.c for standard.
    encode 'as standard' -preset ultrafast -qp 26 -threads 1 -x264-params \
        bframes=0:rc-lookahead=0:sync-lookahead=0:mbtree=0:scenecut=0:weightp=0:cabac=1:8x8dct=1:partitions=i4x4,i8x8
    rm "$work/raw.yuv"
}
find_python() {
    python=''
    for p in python3 /usr/bin/python3; do
        if "$p" -c 'import matplotlib, h5py' 2> /dev/null; then python=$p; fi
    done
    [ "$python" ] || say "no matplotlib with h5py: its pictures are left out"
}
matplotlib_movie() {
    local some=$((frames < 120 ? frames / 2 : 120))
    [ "$python" ] && command -v ffmpeg > /dev/null || return 0
    "$build/beadreel" $scene --only run.h5 -o "$work" > /dev/null
    measure "$python" "$here/pictures_matplotlib.py" movie "$work/run.h5" "$work/matplotlib.mp4" $some || return 0
    row 'matplotlib movie' $some "$work/matplotlib.mp4" ''
    rm "$work/run.h5"
}
images() {
    cat > "$work/image.yaml" << 'END'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{bead: large-steel, count: 499}]
simulate: {until: 6 ms}
outputs:
  - {trajectory: run.h5, every: 1 us, fields: [force]}
END
    "$build/beadreel" "$work/image.yaml" -o "$work" > /dev/null
    for axes in true false; do
        measure "$build/beadreel" "$work/run.h5" -o "$work/image.png" --set outputs.0.size='[1920, 1080]' \
            --set outputs.0.axes=$axes || continue
        row "beadreel image axes $axes" 1 "$work/image.png" ''
    done
    [ "$python" ] || return 0
    measure "$python" "$here/pictures_matplotlib.py" image "$work/run.h5" "$work/matplotlib.png" || return 0
    row 'matplotlib image' 1 "$work/matplotlib.png" ''
}

echo 'what,frames,wall s,CPU s,CPU ms a frame,bytes,PSNR dB,PSNR dB where it changes' > "$table"
find_python
movies
matplotlib_movie
images
awk -F, '{printf "%-26s %6s %8s %8s %15s %10s %8s %24s\n", $1, $2, $3, $4, $5, $6, $7, $8}' "$table"
