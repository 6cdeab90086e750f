#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Movies of runs that end before their time: what a signal or a kill leaves, `name.part`, plays up to there, and an earlier movie of
# the same name stays. Whole ones leave no part, and mp4 files have their index in front.
source "$(dirname "$0")/../shell.bash"
cat >"$T/long.yaml" <<'YAML'
title: Long
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 400, spins: random, magnetism: 0.2, seed: 3}]
  wall: brass
simulate: {until: 1 s, method: rk4, step: 0.1 us}
outputs:
  - {movie: [m.mp4, m.webm, m.mkv, m.gif, m.apng], size: [160, 120], duration: 600 s, fps: 30, range: [0, 30]}
YAML
short=(--set simulate.until='0.5 ms' --set 'outputs=[{movie: [m.mp4, m.webm, m.mkv, m.gif, m.apng], size: [160, 120], duration: 0.5 s, fps: 20}]')
extensions="mp4 webm mkv gif apng"
status_is() { [ "$status" -eq "$1" ] || { echo "status $status"; cat "$T/err"; return 1; }; }

# ended SIGNAL EXTENSION DIRECTORY : start, wait until there is something to see, signal, leave $status.
ended() {
    "$beadreel" "$T/long.yaml" --only "m.$2" --canvas plain -o "$3" >"$T/out" 2>"$T/err" &
    local pid=$! i
    local enough=20000 # bytes of more than 16 frames
    case $2 in gif | apng) enough=200000 ;; esac
    for ((i = 0; i < 600; i++)); do
        [ "$(stat -c %s "$3/m.$2.part" 2>/dev/null || echo 0)" -gt $enough ] && break
        kill -0 $pid 2>/dev/null || break
        sleep 0.1
    done
    kill -s "$1" $pid
    wait $pid 2>/dev/null
    status=$?
}
# plays SIGNAL FILE : every frame there is can be decoded, and there are many. A kill may halve the last one, within a write.
plays() {
    local all=()
    [ "$1" = TERM ] || all=(-frames:v 16)
    shift
    ffmpeg -v warning -i "$1" "${all[@]}" -f null - >"$T/said" 2>&1 </dev/null && [ ! -s "$T/said" ] || { cat "$T/said"; return 1; }
    frames=$(ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=nb_read_frames -of csv=p=0 "$1")
    [ "${frames%%,*}" -ge 16 ] || { echo "frames: $frames"; return 1; }
}
# Names of the boxes of an mp4 file, in order.
boxes() { "$python" -c 'import struct, sys
data, at = open(sys.argv[1], "rb").read(), 0
while at < len(data):
    size, name = struct.unpack(">I4s", data[at:at + 8])
    print(name.decode(), end=" ")
    at += size' "$1"; }

ok "movies" exits 0 "$beadreel" "$T/long.yaml" "${short[@]}" --canvas plain -o "$T/whole"
ok "... leave no part" test "$(ls "$T/whole" | tr '\n' ' ')" = "m.apng m.gif m.mkv m.mp4 m.webm "
for n in 1 3; do
    "$beadreel" "$T/long.yaml" "${short[@]}" --canvas plain --threads $n -o "$T/threads" >/dev/null
    for e in $extensions; do ok "same m.$e with $n threads" cmp "$T/whole/m.$e" "$T/threads/m.$e"; done
done
python=/usr/bin/python3
if "$python" -c 1 2>/dev/null; then
    ok "mp4: the index is in front, and there are no fragments" test "$(boxes "$T/whole/m.mp4")" = "ftyp moov free mdat "
else
    skip "python3" "mp4: the index is in front, and there are no fragments"
fi

(cd "$T/whole" && md5sum m.* >"$T/whole.md5")
kept() { (cd "$1" && md5sum --quiet -c "$T/whole.md5"); }
for signal in KILL TERM; do
    cp -r "$T/whole" "$T/$signal"
    for e in $extensions; do
        ended $signal "$e" "$T/$signal"
        ok "SIG$signal, m.$e" status_is "$((128 + $(kill -l $signal)))"
        if command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null; then
            ok "... the part plays" plays $signal "$T/$signal/m.$e.part"
        else
            skip "ffmpeg" "... the part plays"
        fi
    done
    ok "SIG$signal: earlier movies stay" kept "$T/$signal"
    ok "... beside five parts, and nothing else" test "$(ls "$T/$signal" | wc -l)" -eq 10
done
over() { "$beadreel" "$T/long.yaml" "${short[@]}" --canvas plain -o "$T/KILL" >/dev/null && [ "$(ls "$T/KILL" | wc -l)" -eq 5 ] && kept "$T/KILL"; }
ok "a whole run takes the parts away" over

# In the way of the part, or of the file it becomes, stands a link.
linked() {
    mkdir -p "$T/link" && echo precious >"$T/victim" && ln -sf ../victim "$T/link/$1"
    fails 1 "$beadreel" "$T/long.yaml" "${short[@]}" --only m.mp4 -o "$T/link" && says "symbolic link" &&
        [ "$(cat "$T/victim")" = precious ] && rm "$T/link/$1" && empty "$T/link"
}
for name in m.mp4.part m.mp4.part.part; do ok "a link at $name is not followed" linked $name; done
finish
