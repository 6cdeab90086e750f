#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Wrong scenes and files: one clear line, status 1 or 2, and no file left behind.
source "$(dirname "$0")/../shell.bash"
mkdir "$T/out.d"

# refused STATUSES PROGRAM ARGUMENT... : with -o to a directory that stays empty.
refused() {
    local expected=$1
    shift
    (cd "$T" && fails "$expected" timeout 60 "$@") && grep -qE '^(beadreel|beadsim): .{8,}' "$T/err" && empty "$T/out.d"
}

# told PROGRAM SCENE ARGUMENT... : each fault of the scene in one line of its own.
told() {
    local line lines
    run timeout 60 "$1" "$2" "${@:3}"
    mapfile -t lines <"$T/err"
    [[ $status == [12] ]] && [ ${#lines[@]} -gt 0 ] && [ ! -s "$T/out" ] && empty "$T/out.d" || { cat "$T/out" "$T/err"; return 1; }
    for line in "${lines[@]}"; do [[ $line == "${1##*/}: $2"?*:\ ?* ]] || { echo "$line"; return 1; }; done
}

# test_scene_wrong judges what is said of each; here, that a program ends with it. Runs read scenes as plans do: a few show that. With
# sanitizers a start takes longest, and test_scene_wrong has read all of them: every fifth.
nm -D "$beadsim" 2>/dev/null | grep -q __asan_ && step=5
count=0
for scene in "$top"/tests/bad/*.yaml; do
    [ -e "$scene" ] || continue
    name=${scene##*/}
    [ $((count++ % ${step:-1})) -eq 0 ] || continue
    ok "--plan refuses $name" told "$beadreel" "$scene" --plan
    [ $((count % 50)) -eq 1 ] || continue
    ok "beadreel refuses $name" told "$beadreel" "$scene" -o "$T/out.d"
    ok "beadsim refuses $name" told "$beadsim" "$scene" -o "$T/out.d"
done
ok "wrong scenes were tried" test $count -gt 200

# Times past the end of a run that ends when the front arrives: known only after the scouting run.
late() {
    cat >"$T/late.yaml" <<YAML
chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 4}]}
outputs:
  - {$1}
YAML
    refused "1 2" "$beadreel" "$T/late.yaml" --plan && says "late.yaml:3:$2"
}
ok "a caption after the end" late "movie: a.mp4, size: [320, 180], captions: [{at: 0 s, text: a}, {at: 9 ms, text: b}]" \
    "74: captions.1.at: is 0.009 s; must be before the end of what is shown, at 8.7"
ok "a poster after it" late "movie: a.mp4, size: [320, 180], poster: p.png, poster-at: 9 ms" "64: poster-at: is 0.009 s; the movie ends at 8.7"

cat >"$T/good.yaml" <<'YAML'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{bead: large-steel, count: 8}]
outputs:
  - {trajectory: run.h5, every: 1 us, fields: [displacement, velocity]}
  - {table: peaks.csv, show: peaks}
YAML
good=$T/good.yaml
mkdir "$T/made"
ok "the good scene runs" exits 0 "$beadsim" "$good" -o "$T/made"
run_h5=$T/made/run.h5

ok "no such file" refused "1 2" "$beadreel" "$T/none.yaml" -o "$T/out.d"
ok "... names it" says none.yaml
ok "a directory for a scene" refused "1 2" "$beadreel" "$T/out.d" -o "$T/out.d"
for ending in png jpg svg pdf eps mp4 webm gif csv html; do
    cp "$T/made/peaks.csv" "$T/made.$ending"
    for how in --only=none --plan --info; do
        ok "a result, .$ending, for a scene, $how" refused 2 "$beadreel" $how "$T/made.$ending"
        ok "..." says "made.$ending: is a result, not a scene; if beadreel made it, --reproduce does so again"
    done
done
cp "$T/made/peaks.csv" "$T/made.h5"
ok "a trajectory without its beginning" refused 2 "$beadreel" "$T/made.h5" -o "$T/out.d"
ok "..." says "made.h5: not an HDF5 file, or damaged at its beginning"
: >"$T/empty.yaml"
ok "an empty file" refused "1 2" "$beadreel" "$T/empty.yaml" -o "$T/out.d"
head -c 100000 /dev/zero >"$T/zeros.yaml"
ok "zeros" refused "1 2" "$beadreel" "$T/zeros.yaml" -o "$T/out.d"
head -c 100000 /dev/urandom >"$T/noise.yaml"
ok "noise" refused "1 2" "$beadreel" "$T/noise.yaml" -o "$T/out.d"
ok "a character device" refused "1 2" "$beadreel" /dev/zero -o "$T/out.d"
ok "an output directory below a file" refused "1 2" "$beadreel" "$good" -o "$good/below"
ok "an output directory in /proc" refused "1 2" "$beadreel" "$good" -o /proc/beadreel
ok "an output that is a directory" bash -c "mkdir -p '$T/taken/run.h5/x' && ! '$beadsim' '$good' -o '$T/taken' >/dev/null 2>&1 && [ ! -e '$T/taken/run.h5.part' ]"
ok "--info of no file" refused "1 2" "$beadreel" --info "$T/none.h5"

# HDF5 files that are damaged or somebody else's.
size=$(stat -c %s "$run_h5" 2>/dev/null || echo 0)
ok "a trajectory as no file of ours" refused 2 "$beadreel" "$run_h5" -o "$T/out.d/run.xyz"
ok "... says what it could be" grep -q '^beadreel: --output: .*run.xyz.*\.png.*\.mp4.*\.csv' "$T/err"
ok "the trajectory draws" exits 0 "$beadreel" "$run_h5" -o "$T/made/whole.png"
for cut in 10 100 1000 $((size / 4)) $((size / 2)) $((size - 100)); do
    head -c "$cut" "$run_h5" >"$T/cut.h5"
    ok "a trajectory cut to $cut bytes" refused "1 2" "$beadreel" "$T/cut.h5" -o "$T/out.d/cut.png"
    ok "--info of one cut to $cut bytes" refused "1 2" "$beadreel" --info "$T/cut.h5"
done
foreign() {
    h5copy -i "$run_h5" -o "$T/foreign.h5" -s /particles -d /other && refused "1 2" "$beadreel" "$T/foreign.h5" -o "$T/out.d/foreign.png"
}
ok "an HDF5 file of another kind" foreign
h5copy -i "$run_h5" -o "$T/half.h5" -s /h5md -d /h5md >/dev/null 2>&1
h5copy -i "$run_h5" -o "$T/half.h5" -s /particles -d /particles >/dev/null 2>&1
ok "an H5MD file without a scene" refused "1 2" "$beadreel" "$T/half.h5" -o "$T/out.d/half.png"
ok "a trajectory without -o" refused "1 2" "$beadreel" "$run_h5"
ok "a trajectory into an unknown kind of file" refused "1 2" "$beadreel" "$run_h5" -o "$T/out.d/run.xyz"
ok "a trajectory for beadsim into a picture" refused "1 2" "$beadsim" "$run_h5" -o "$T/out.d/run.png"

# One byte changed at many places: no crash, no hang, whatever the answer.
flipped() {
    local at
    for at in $(seq 0 $((size / 40 + 1)) $((size - 1))); do
        cp "$run_h5" "$T/flipped.h5"
        printf '\377' | dd of="$T/flipped.h5" bs=1 seek="$at" conv=notrunc 2>/dev/null
        run timeout 60 "$beadreel" --info "$T/flipped.h5"
        [ "$status" -le 2 ] || { echo "status $status with byte $at changed"; cat "$T/err"; return 1; }
    done
}
ok "a trajectory with changed bytes never crashes" flipped
finish
