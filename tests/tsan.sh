#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Demo, sweep and every kind of output with several threads: tests/tsan.sh BUILD, a build with the thread sanitizer.
# Each run must end as it should, without a report of a race; tests/tsan.txt names the libraries that the sanitizer cannot judge.
# Ends with `N passed, M failed`.
set -u
cd "$(dirname "$0")/.." || exit 1
build=$(realpath "$1")
export BEADREEL_ASSETS=$PWD/assets
T=$(mktemp -d "${TMPDIR:-/tmp}/beadreel-tsan.XXXXXX") || exit 1
trap 'rm -rf "$T"' EXIT
export TSAN_OPTIONS="suppressions=$PWD/tests/tsan.txt:exitcode=66:log_path=$T/report"
passed=0 failed=0

# judge NAME STATUS EXPECTED
judge() {
    if [ "$2" -eq "$3" ] && ! compgen -G "$T/report*" >/dev/null; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $1: status $2"
        tail -n 3 "$T/err"
        cat "$T"/report* 2>/dev/null | head -n 80
    fi
    rm -f "$T"/report*
}
# clean NAME PROGRAM ARGUMENTS...
clean() {
    "$build/$2" "${@:3}" --threads 4 >"$T/out" 2>"$T/err" </dev/null
    judge "$1" $? 0
}
# ended NAME SCENE FILE : by a signal, in the midst, once it has begun to write the file.
ended() {
    "$build/beadreel" "$2" --threads 4 -o "$T/ended" >"$T/out" 2>"$T/err" </dev/null &
    local pid=$!
    while [ ! -s "$T/ended/$3" ] && kill -0 $pid 2>/dev/null; do sleep 0.1; done
    kill -TERM $pid
    wait $pid
    judge "$1" $? 143
}
# scene NAME < outputs
scene() {
    { cat <<'YAML'; cat; } >"$T/$1.yaml"
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads:
    - {cell: [large-steel, aluminium], count: 6, spins: random, magnetism: 0.3, seed: 7}
    - {bead: small-steel, sensor: first}
simulate: {until: 200 us}
outputs:
YAML
}
scene every <<'YAML'
  - {trajectory: run.h5, every: 5 us, fields: all}
  - {image: [force.png, force.pdf, force.svg], size: [320, 200]}
  - {image: trust.png, size: [320, 200], trust: true}
  - {image: max.png, size: [320, 200], sample: max}
  - {image: beads.png, views: [beads, profile], at: 100 us, size: [320, 200]}
  - {plot: sensors.svg, show: sensors}
  - {plot: setup.svg, show: setup}
  - {plot: contact.svg, show: contact}
  - {plot: cell.svg, show: cell}
  - {table: peaks.csv, show: peaks}
  - {table: sensors.csv, show: sensors}
  - {table: measures.csv, show: measures}
  - {movie: m.mp4, duration: 0.4 s, size: [160, 120], fps: 10, poster: poster.png, captions: [{at: 0, text: "*F*_{max}"}]}
  - {movie: m.mkv, duration: 0.4 s, size: [160, 120], fps: 10}
  - {movie: m.webm, duration: 0.4 s, size: [160, 120], fps: 10}
  - {movie: m.gif, duration: 0.4 s, size: [160, 120], fps: 10}
  - {movie: m.apng, duration: 0.4 s, size: [160, 120], fps: 10}
  - {report: run.html}
  - {movie: follow.mp4, duration: 0.4 s, size: [320, 120], fps: 10, views: [beads], follow: front}
YAML
scene long <<'YAML'
  - {trajectory: run.h5, every: 10 us, fields: all}
  - {movie: m.mp4, duration: 100 s, size: [160, 120], fps: 60}
YAML
sed -i 's/until: 200 us/until: 20 ms/' "$T/long.yaml"
cat >"$T/sweep.yaml" <<'YAML'
sweep: {cells: 8, magnetism: [0, 0.5, 1], configurations: 6, measure: {decay: true, beads: [1, 3]}}
outputs: [{sweep: sweep.h5}, {table: sweep.csv}, {plot: sweep.png, size: [320, 200]}, {sheet: sheet.png}, {report: sweep.html}]
YAML
sed 's/configurations: 6/configurations: 10000/' "$T/sweep.yaml" >"$T/long-sweep.yaml"

for canvas in plain osmesa egl; do
    TSAN_OPTIONS=report_bugs=0 "$build/beadreel" "$T/every.yaml" --only beads.png --canvas $canvas -o "$T/there" >/dev/null 2>&1 || { echo "no canvas $canvas here"; continue; }
    clean "every output, canvas $canvas" beadreel "$T/every.yaml" --canvas $canvas -o "$T/$canvas"
done
clean "drawn from a trajectory" beadreel "$T/plain/run.h5" -o "$T/again.mp4"
clean "data only" beadsim "$T/every.yaml" -o "$T/data"
clean "a sweep" beadreel "$T/sweep.yaml" -o "$T/sweep"
clean "... drawn again" beadreel "$T/sweep/sweep.h5" -o "$T/again.png"
clean "... in parts: one" beadsim "$T/sweep.yaml" --shard 1/2 -o "$T/parts"
clean "... in parts: two" beadsim "$T/sweep.yaml" --shard 2/2 -o "$T/parts"
clean "... one configuration" beadreel "$T/sweep.yaml" --configuration 2 -o "$T/one.png"
clean "... many" beadreel "$T/sweep.yaml" --sheet -o "$T/sheet.png"
ended "a run that is stopped" "$T/long.yaml" m.mp4.part
ended "a sweep that is stopped" "$T/long-sweep.yaml" sweep.h5.part
demo=clean-vs-delocalised
movie=$("$build/beadreel" --info $demo | sed -n 's/^output \([0-9]*\): movie .*/\1/p' | head -n 1)
clean "the demo" beadreel $demo -o "$T/demo" --set "outputs.$movie.size=[320, 180]" --set "outputs.$movie.duration=1 s" --set "outputs.$movie.fps=15"
# What makes the long ones of one thread short.
lighter() {
    case $1 in
    kdv) echo chain.points=160 simulate.until=0.4 outputs.2.at='[0,0.4]' ;;
    shock) echo chain.points=400 ;;
    fput) echo simulate.until=2500 outputs.3.at='[0,2500]' ;;
    fput-kdv) echo simulate.until=200 outputs.1.at='[0,200]' ;;
    esac
}
for ready in teaching fput fput-kdv kdv shock sensors panels schematics; do
    stills=$("$build/beadreel" --info $ready | sed -n '/^output [0-9]*: movie/d; s/^output [0-9]*: .* //p')
    # shellcheck disable=SC2046
    clean "$ready, but its movies" beadreel $ready -o "$T/$ready" $(printf ' --only %s' $stills) $(for set in $(lighter $ready); do echo "--set $set"; done)
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
