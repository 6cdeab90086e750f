#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What a run prints and leaves: files, sizes, progress; the same results for any threads and instructions.
source "$(dirname "$0")/../shell.bash"
cat >"$T/scene.yaml" <<'YAML'
title: Results
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 12, spins: random, magnetism: 0.5, seed: 3}]
  wall: brass
outputs:
  - {trajectory: run.h5, every: 2 us, fields: [displacement, velocity, force]}
  - {image: force.png, size: [320, 200]}
  - {table: peaks.csv, show: peaks}
  - {table: beads.csv, show: bead-peaks}
YAML
cd "$T" || exit 1

ok "beadreel runs" exits 0 "$beadreel" scene.yaml -o all
ok "... makes the directory and every file" test -s all/run.h5 -a -s all/force.png -a -s all/peaks.csv -a -s all/beads.csv
ok "... and nothing else" test "$(ls -A all | wc -l)" -eq 4
for f in run.h5 force.png peaks.csv beads.csv; do
    ok "... and says so: $f" grep -q "^all/$f  " out
done
ok "... with a summary" grep -qE '^4 files, .* 1 chain to .* with .*, (first )?step ' out
ok "... quietly where stderr is no terminal" test ! -s err

ok "beadsim runs" exits 0 "$beadsim" scene.yaml -o data
ok "... makes only data" test "$(ls -A data | tr '\n' ' ')" = "beads.csv peaks.csv run.h5 "
ok "... names what it skipped" grep -q '^skipped.*: force.png$' out
ok "... the same peaks" cmp all/peaks.csv data/peaks.csv

budget=(--set 'outputs=[{trajectory: run.h5, every: 2 us}, {table: energy.csv, show: energy}]' --set 'simulate.until=0.1 ms')
ok "the energy budget beside a trajectory" exits 0 "$beadsim" scene.yaml -o budget "${budget[@]}"
ok "... at its times" test "$(grep -c '^[0-9]' budget/energy.csv)" -eq 51
ok "... of which the trajectory has none" fails 1 "$beadsim" budget/run.h5 -o energy.csv
ok "... and says so" says "energy.csv: the energy budget is kept by a run: no trajectory has it"

ok "drawings" exits 0 "$beadreel" schematics -o drawings --only setup.pdf
ok "... have no run to sum up" grep -qE '^1 file, .*: drawings only, nothing to compute$' out

poster=(--set 'outputs=[{movie: m.mp4, size: [320, 180], duration: 1 s, fps: 10, poster: p.png}]')
ok "a movie with a poster" exits 0 "$beadreel" scene.yaml -o posters "${poster[@]}"
ok "... names both files" grep -q '^posters/p.png  ' out
ok "... and counts them" grep -q '^2 files, ' out
ok "... with their sizes" test "$(grep -c '^posters/[mp].* [1-9][0-9.]* kB\(  painted by .*, encoded by .*\)\?$' out)" = 2
ok "... and the movie's encoder" grep -q '^posters/m.mp4 .* kB  .*encoded by libavcodec (libx264)$' out
ok "... as planned" bash -c "'$beadreel' scene.yaml --plan -o posters \"\$@\" | grep -q '^  beside it: posters/p.png$'" - "${poster[@]}"

both=(--set 'outputs=[{movie: m.mp4, size: [320, 180], duration: 1 s, fps: 10}, {image: i.png, size: [320, 200]}]')
ok "a movie before a picture" exits 0 "$beadreel" scene.yaml -o both "${both[@]}"
ok "... is listed before it, though ended after it" test "$(sed -n 's/^both\/\([^ ]*\) .*/\1/p' out | tr '\n' ' ')" = "m.mp4 i.png "

ok "--only" exits 0 "$beadreel" scene.yaml -o only --only peaks.csv
ok "... makes one file" test "$(ls -A only)" = peaks.csv
ok "... with the same numbers" cmp all/peaks.csv only/peaks.csv
ok "--plan of what shares samples" exits 0 "$beadreel" scene.yaml --plan --only run.h5 --only force.png
ok "... says so" grep -q '(shared with the trajectory)$' out
ok "... names files as they will be" grep -q '^output force.png: ' out
ok "--plan without the trajectory" exits 0 "$beadreel" scene.yaml --plan --only force.png
ok "... shares nothing" bash -c "! grep -q 'shared with' out"
ok "... but has its times" grep -q '(at the times of the trajectory that is skipped)$' out
ok "--only twice" bash -c "'$beadreel' scene.yaml -o two --only peaks.csv --only force.png && [ \$(ls two | wc -l) = 2 ]"
ok "... the same picture" cmp all/force.png two/force.png
ok "the current directory is the default" bash -c "mkdir here && cd here && '$beadsim' ../scene.yaml --only beads >../out && [ -s beads.csv ]"
ok "... and not named" grep -q '^beads.csv  ' out

ok "--info of a trajectory" exits 0 "$beadreel" --info all/run.h5
ok "... measures it" grep -qE '^  peak contact force +[0-9.]+ N$' out

# References to other datasets are addresses in h5dump 1.14, and their names.
contents() { h5dump -d /particles/chain/velocity/value -d /particles/chain/force/value "$1" | tail -n +2 | sed 's/(DATASET [0-9]* /(DATASET /'; }
for n in 1 2 3; do
    "$beadreel" scene.yaml -o "threads$n" --threads $n >/dev/null || continue
    ok "same pictures with $n threads" cmp all/force.png "threads$n/force.png"
    ok "same numbers with $n threads" cmp all/beads.csv "threads$n/beads.csv"
    ok "same samples with $n threads" cmp <(contents all/run.h5) <(contents "threads$n/run.h5")
done
for set in portable sse2 avx2 avx512; do
    if "$beadsim" scene.yaml -o "$set" --instructions=$set >/dev/null 2>err; then
        ok "same numbers with $set" cmp all/beads.csv "$set/beads.csv"
        ok "same samples with $set" cmp <(contents all/run.h5) <(contents "$set/run.h5")
    else
        skip "a processor with $set" "same numbers with $set"
    fi
done

# Progress: slow enough that there is some.
slow=(--set "simulate={until: 200 ms, method: rk4, step: 0.1 us}" --only peaks.csv)
ok "--progress=json" exits 0 "$beadsim" scene.yaml -o slow "${slow[@]}" --progress=json
json_lines() { [ -s err ] && ! grep -vE '^\{"what": "[^"]+", "done": [0-9.]+, "elapsed_s": [0-9.]+(, "left_s": [0-9.]+)?(, "time_s": [-+0-9.e]+)?\}$' err; }
ok "... one object a line" json_lines
# Where stderr is no terminal there is a line every three seconds. The run is as long as it takes to know how much is left.
set -m # a script's background jobs ignore SIGINT otherwise
"$beadsim" scene.yaml -o slow --set 'simulate={until: 30 s, method: rk4, step: 0.1 us}' --only peaks.csv >out 2>err </dev/null &
ok "lines of progress in a file" await grep -E '^simulating: [0-9]+ %, .* left$' err
kill -INT $! && wait $!
ok "... which never say that nothing is left" bash -c "! grep -q ' 0 s left' err"
film=(--set 'outputs=[{movie: m.mp4, size: [320, 240], fps: 240, duration: 100 s}]')
"$beadreel" scene.yaml -o slow "${film[@]}" --progress json >out 2>err </dev/null &
ok "a film is drawn" await grep -q '"what": "drawing"' err
kill -INT $! && wait $!
set +m
ok "... not simulated" bash -c "! grep -q '\"simulating\"' err"
ok "--progress=none is quiet" bash -c "'$beadsim' scene.yaml -o slow --set simulate.until='600 ms' --only peaks.csv --progress=none 2>&1 >/dev/null | (! grep .)"
"$beadreel" scene.yaml -o slow --set 'outputs=[{image: late.png, size: [300, 200]}]' --progress json >out 2>err
ok "what is written at the end is told before" grep -q '"what": "writing late.png", "done": 0,' err
named() { TERM=xterm script -qec "$beadreel scene.yaml -o slow --set 'outputs=[{image: late.png, size: [300, 200]}]'" typescript >/dev/null && grep -q 'writing late.png' typescript; }
bar() { TERM=xterm script -qec "$beadsim scene.yaml -o slow --set simulate.until='150 ms' --set simulate.method=rk4 \
    --set simulate.step='0.1us' --only peaks.csv" typescript >/dev/null && grep -q '\[[#.]*\] *[0-9]* %' typescript; }
if TERM=xterm script -qec true typescript >/dev/null 2>&1; then
    ok "a bar on a terminal" bar
    ok "... also of what is written at the end" named
else
    skip "a terminal (script, /dev/pts)" "a bar on a terminal"
fi
# 141: ended by SIGPIPE, as cat and grep are.
left() { "$@" 2>err | head -c 1 >/dev/null; is "${PIPESTATUS[0]}" 141 && is "$(cat err)" ""; }
is() { [ "$1" = "$2" ] || { echo "$1 is not $2"; return 1; }; }
ok "a reader that leaves, as head does, ends a file on stdout without a word" left "$beadsim" scene.yaml --set 'outputs=[{table: long.csv, show: sensors, beads: 1, every: 10 ns}]' -o - --quiet
ok "stdout to a full device" fails 1 bash -c "'$beadsim' scene.yaml -o slow --only peaks.csv >/dev/full"
ok "a closed pipe ends in order" bash -c "exec 3> >(true); wait \$!; '$beadsim' scene.yaml -o slow --only peaks.csv >&3 2>err2; [ \$? -eq 141 ]"

# Where the numbers mean nothing any more there is a message and no file.
wild() { # START END: of the chain; STEP [DAMPING]
    cat >wild.yaml <<YAML
$1damping: {coefficient: ${4:-1e6}, exponent: 1}, beads: [{bead: large-steel, count: 100}]$2
simulate: {step: $3}
outputs: [{table: wild.csv, show: peaks}]
YAML
    exits 1 "$beadsim" wild.yaml -o wild && [ ! -e wild/wild.csv ]
}
ok "energy out of bounds ends a run" wild 'chain: {' '}' '0.2 us'
ok "... and says why" grep -qE '^beadsim: wild\.yaml:1:8: chain: at [0-9.e-]+ s the energy is off by .* steps of 2e-07 s are too long for `rk8`' err
ok "energy out of bounds in a chain with a name" wild 'chains: [{name: A, ' '}]' '0.2 us'
ok "... which is told" grep -q '^beadsim: wild\.yaml:1:10: chain A: at ' err
ok "a front that damping spreads out ends a run" wild 'chains: [{name: A, ' '}]' auto
ok "... and says why" grep -qE '^beadsim: wild\.yaml:1:10: chain A: after [0-9.e-]+ s the front has not reached the end: .* or less damping' err
ok "damping that no step can follow ends a run" wild 'chains: [{name: A, ' '}]' auto 1e9
ok "... and says why" grep -qE '^beadsim: wild\.yaml:[0-9]+:[0-9]+: chain A: at 0 s velocities decay so fast that steps of .* damping is too strong' err
finish
