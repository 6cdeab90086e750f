#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Stopped runs: status 128+n; the trajectory's .part can be read up to there, and finished files of earlier runs stay. Killed ones
# leave the same. What stands in the way of unfinished files is neither followed nor waited for.
source "$(dirname "$0")/../shell.bash"
cat >"$T/long.yaml" <<'YAML'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 400, spins: random, magnetism: 0.2, seed: 3}]
  wall: brass
simulate: {until: 2 s, method: rk4, step: 0.1 us}
outputs:
  - {trajectory: run.h5, every: 100 us, fields: [displacement, velocity]}
  - {table: peaks.csv, show: peaks}
  - {image: force.png, field: force, size: [320, 200], range: [0, 30]}
YAML

has_samples() { "$beadsim" --info "$1" | grep -q '^samples: [1-9]'; }
# stopped SIGNAL DIRECTORY PROGRAM : start, wait until it has written samples, signal, leave $status.
stopped() {
    mkdir "$2"
    "$3" "$T/long.yaml" -o "$2" --progress none >"$T/out" 2>"$T/err" &
    local pid=$!
    await has_samples "$2/run.h5.part"
    kill -s "$1" $pid
    wait $pid
    status=$?
}
status_is() { [ "$status" -eq "$1" ] || { echo "status $status"; cat "$T/err"; return 1; }; }
one_line() { [ "$(wc -l <"$T/err")" -eq 1 ] || { cat "$T/err"; return 1; }; }
# Nothing half-written has a final name; the trajectory's part knows that its run was stopped.
left_readable() {
    [ "$(ls "$1")" = run.h5.part ] && "$beadreel" --info "$1/run.h5.part" >"$T/info" || { ls "$1"; return 1; }
    grep -q 'stopped or killed' "$T/info" || { cat "$T/info"; return 1; }
}
drawn() { "$beadreel" "$T/int/run.h5.part" -o "$T/part.png" >/dev/null && [ -s "$T/part.png" ]; }

# The test's own: a signal that comes before the program has begun meets a copy of this shell, which must not clear up.
too_early() {
    for i in 1 2 3; do
        sleep 5 >"$T/out" &
        kill -FPE $!
        wait $!
        [ -d "$T" ] || return
    done
}
ok "a signal before the program has begun removes nothing" too_early

# In a script, background jobs ignore SIGINT unless job control is on.
set -m
stopped INT "$T/int" "$beadreel"
ok "SIGINT: status 130" status_is 130
ok "SIGINT: one line on stderr" one_line
ok "SIGINT: what is left can be read" left_readable "$T/int"
ok "... and drawn" drawn
stopped TERM "$T/term" "$beadsim"
ok "SIGTERM: status 143" status_is 143
ok "SIGTERM: what is left can be read" left_readable "$T/term"
stopped HUP "$T/hup" "$beadsim"
ok "SIGHUP: status 129" status_is 129
ok "SIGHUP: what is left can be read" left_readable "$T/hup"
# A fault's signal that comes from outside: killed by it, and what is written stays. The address sanitizer would report it.
(ulimit -c 0 && export ASAN_OPTIONS="${ASAN_OPTIONS:-}:handle_segv=0" && stopped SEGV "$T/segv" "$beadsim" && echo $status >"$T/segv.status")
ok "SIGSEGV from another process: status 139" test "$(cat "$T/segv.status")" = 139
ok "... and the trajectory knows it" eval '"$beadsim" --info "$T/segv/run.h5.part" | grep -q "stopped or killed"'
limited() { (ulimit -f 64; exec "$beadsim" "$T/long.yaml" --set simulate.until='20 ms' --set outputs.0.every='1 us' -o "$T/limit" 2>"$T/err"); }
too_large() {
    limited >"$T/out"
    status=$?
    status_is 1 && one_line && says "File too large" && empty "$T/limit"
}
ok "a file-size limit is a write error" too_large
fifo() {
    mkdir "$T/fifo" && mkfifo "$T/fifo/peaks.csv.part"
    timeout 20 "$beadsim" "$T/long.yaml" --only peaks.csv -o "$T/fifo" 2>"$T/err"
    status=$?
    status_is 1 && one_line && says "not a regular file" && [ -p "$T/fifo/peaks.csv.part" ]
}
ok "a FIFO in the way does not block" fifo
linked() {
    mkdir "$T/link" && echo precious >"$T/victim" && ln -s ../victim "$T/link/peaks.csv.part"
    "$beadsim" "$T/long.yaml" --only peaks.csv -o "$T/link" 2>"$T/err"
    status=$?
    status_is 1 && one_line && says "symbolic link" && [ "$(cat "$T/victim")" = precious ]
}
ok "a link in the way is not followed" linked
stopped KILL "$T/kill" "$beadsim"
ok "SIGKILL: status 137" status_is 137

# No output has begun while a run scouts for the range of colours.
scouting() {
    "$beadreel" "$T/long.yaml" --set "outputs=[{movie: m.mp4, size: [160, 120]}, {trajectory: run.h5}]" -o "$T/scout" --progress json \
        >"$T/out" 2>"$T/err" &
    local pid=$!
    await says '"what": "scouting ranges"'
    kill -TERM $pid
    wait $pid
    status=$?
    status_is 143 && says "stopped by signal" && empty "$T/scout"
}
ok "stopped while scouting: nothing is left" scouting

# A sweep without a file of its results cannot be continued, and says so; with one it can.
cat >"$T/sweep.yaml" <<'YAML'
sweep: {cells: 60, configurations: 400}
outputs: [{table: a.csv}, {sweep: a.h5}]
YAML
# Enough chains that its journal has some, if it has one.
sweeping() { # OUTPUT...
    rm -f "$T/err" # what the run before has said
    "$beadsim" "$T/sweep.yaml" "${@/#/--only=}" -o "$T/swept" --progress json >"$T/out" 2>"$T/err" &
    local pid=$!
    await grep -q '"chains": [1-9][0-9][0-9]' "$T/err"
    kill -TERM $pid
    wait $pid
    status=$?
    status_is 143 && says "stopped by signal 15"
}
ok "a sweep without a file is stopped" sweeping a.csv
ok "... which loses its chains" says "the same command starts over: no output {sweep: sweep.h5} keeps the chains"
ok "a sweep with one is stopped" sweeping a.csv a.h5
ok "... which loses nothing" eval '! says "starts over" >/dev/null && [ -s "$T/swept/a.h5.part" ]'

# A run that is stopped over the results of an earlier one.
short=(--set simulate.until='1 ms')
"$beadreel" "$T/long.yaml" "${short[@]}" -o "$T/again" >/dev/null
(cd "$T/again" && md5sum run.h5 peaks.csv force.png >"$T/whole.md5")
again() {
    rm -rf "$T/kept" && cp -r "$T/again" "$T/kept"
    "$beadreel" "$T/long.yaml" -o "$T/kept" >"$T/out" 2>"$T/err" &
    local pid=$!
    await has_samples "$T/kept/run.h5.part"
    kill -INT $pid
    wait $pid
    status=$?
    status_is 130 && (cd "$T/kept" && md5sum --quiet -c "$T/whole.md5") && [ -s "$T/kept/run.h5.part" ]
}
ok "a stopped run leaves an earlier one's results" again

# Two runs with the same outputs: the second says so at once and leaves the first alone.
both() {
    mkdir "$T/both"
    "$beadreel" "$T/long.yaml" --set simulate.until='10 ms' -o "$T/both" >"$T/first" 2>&1 &
    local pid=$!
    await test -s "$T/both/run.h5.part"
    kill -STOP $pid # so that it cannot end before the other begins
    "$beadreel" "$T/long.yaml" --only "$1" -o "$T/both" >"$T/out" 2>"$T/err"
    status=$?
    kill -CONT $pid
    wait -f $pid || { cat "$T/first"; return 1; } # -f: not only until it is stopped
    status_is 2 && one_line && says "another run" && [ "$(ls "$T/both")" = $'force.png\npeaks.csv\nrun.h5' ] || { ls "$T/both"; return 1; }
    rm -r "$T/both"
}
for name in run.h5 peaks.csv force.png; do ok "two runs with the same $name" both $name; done
killed_says() { grep -q 'samples: [1-9]' "$T/info" && grep -q 'killed: nothing but its samples is known' "$T/info" && ! grep -qw nan "$T/info" || { cat "$T/info"; return 1; }; }
killed_readable() { "$beadreel" --info "$T/kill/run.h5.part" >"$T/info" && grep -q 'stopped or killed' "$T/info"; }
ok "SIGKILL: the .part can be read" killed_readable
ok "... and says how far the run got" killed_says
head -c 5000 /dev/zero >"$T/early.h5.part"
ok "killed before the first flush" fails 1 "$beadreel" --info "$T/early.h5.part"
ok "... says so" says "early.h5.part: is an unfinished file"

# Runs that begin and end while their file is read.
part=$T/kill/run.h5.part
has_some() { grep -q 'samples: [1-9]' "$T/out"; }
begun() {
    cp "$part" "$T/begun.h5.part" && head -c 8 /dev/zero | dd of="$T/begun.h5.part" conv=notrunc status=none
    (sleep 0.3; head -c 8 "$part" | dd of="$T/begun.h5.part" conv=notrunc status=none) &
    exits 0 "$beadsim" --info "$T/begun.h5.part" && has_some
}
ok "a file whose head is written in a moment is waited for" begun
wait
cp "$part" "$T/done.h5"
ok "what was run.h5.part a moment ago is run.h5" exits 0 "$beadsim" --info "$T/done.h5.part"
ok "... and its samples are there" has_some
if nm -D "$beadsim" 2>/dev/null | grep -q __asan_; then
    skip "a build without sanitizers" "a file that is renamed while it is read"
else
    cp "$part" "$T/renamed.h5.part"
    printf '%s\n' '#define _GNU_SOURCE' '#include <dlfcn.h>' '#include <stdio.h>' '#include <stdlib.h>' 'int socketpair(int a, int b, int c, int *d)' \
        '{ rename(getenv("PART"), getenv("DONE")); return ((int (*)(int, int, int, int *))dlsym(RTLD_NEXT, "socketpair"))(a, b, c, d); }' >"$T/renames.c"
    ${CC:-cc} -w -shared -fPIC "$T/renames.c" -o "$T/renames.so" -ldl
    ok "a file that is renamed while it is read" exits 0 env PART="$T/renamed.h5.part" DONE="$T/renamed.h5" LD_PRELOAD="$T/renames.so" "$beadsim" \
        --info "$T/renamed.h5.part"
    ok "..." has_some
    ok "... which it was" test ! -e "$T/renamed.h5.part"
fi
finish
