#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sweeps: killed and gone on with, in parts, drawn again, one configuration alone.
source "$(dirname "$0")/../shell.bash"
cat >"$T/sweep.yaml" <<'YAML'
title: Sweep
sweep: {cells: 16, configurations: 12, seed: 7}
outputs:
  - {sweep: sweep.h5}
  - {table: force.csv}
  - {table: configurations.csv, show: configurations}
  - {plot: force.png, size: [640, 400]}
YAML
same() { cmp "$1" "$2"; }
lacks() { ! grep -qF -- "$1" "$T/out" || { cat "$T/out"; return 1; }; }
lacks_file() { ! grep -q -- "$1" "$2"; }

ok "a sweep runs" exits 0 "$beadreel" "$T/sweep.yaml" -o "$T/whole"
ok "no journal is left" test ! -e "$T/whole/sweep.h5.part"
ok "one row a magnetism" [ "$(wc -l <"$T/whole/force.csv")" -eq 10 ]
ok "one row a configuration" [ "$(wc -l <"$T/whole/configurations.csv")" -eq 98 ]
ok "beadsim with one thread: the same bytes" exits 0 "$beadsim" "$T/sweep.yaml" --threads 1 -o "$T/one"
ok "... of the file" same "$T/whole/sweep.h5" "$T/one/sweep.h5"
ok "... of the table" same "$T/whole/force.csv" "$T/one/force.csv"

# Killed ten times over, at moments spread over the run; each time the same command again.
mkdir "$T/killed"
RANDOM=4
for i in 1 2 3 4 5 6 7 8 9 10; do
    "$beadsim" "$T/sweep.yaml" --threads 2 --only sweep.h5 -o "$T/killed" >/dev/null 2>&1 &
    pid=$!
    sleep "0.0$((RANDOM % 9 + 1))"
    kill -KILL $pid 2>/dev/null
    wait $pid 2>/dev/null
done
ok "killed ten times over, it goes on to its end" exits 0 "$beadsim" "$T/sweep.yaml" --only sweep.h5 -o "$T/killed"
ok "... and the file is the same" same "$T/whole/sweep.h5" "$T/killed/sweep.h5"

# A table that cannot be written: what was computed is not lost. A directory in its place is seen before.
mkdir -p "$T/blocked/force.csv"
ok "a directory in the place of a table" fails 1 "$beadsim" "$T/sweep.yaml" -o "$T/blocked"
ok "... is seen before the run" test ! -e "$T/blocked/sweep.h5.part"
rmdir "$T/blocked/force.csv"
if nm -D "$beadsim" 2>/dev/null | grep -q __asan_; then
    skip "a build without sanitizers" "a table that cannot be written"
else
    printf '%s\n' '#define _GNU_SOURCE' '#include <dlfcn.h>' '#include <errno.h>' '#include <string.h>' 'int rename(const char *a, const char *b)' \
        '{ if (strstr(b, "force.csv")) { errno = EIO; return -1; } return ((int (*)(const char *, const char *))dlsym(RTLD_NEXT, "rename"))(a, b); }' >"$T/worn.c"
    ${CC:-cc} -w -shared -fPIC "$T/worn.c" -o "$T/worn.so" -ldl
    ok "a table that cannot be written" fails 1 env LD_PRELOAD="$T/worn.so" "$beadsim" "$T/sweep.yaml" -o "$T/blocked"
    ok "... leaves the journal" test -s "$T/blocked/sweep.h5.part"
    ok "... which says how far it got" exits 0 "$beadsim" --info "$T/blocked/sweep.h5.part"
    all_done() { grep -qE 'sweep.h5.part: journal of an unfinished sweep' "$T/out" && grep -qE '^([0-9]+) of \1 chains are done' "$T/out" || { cat "$T/out"; return 1; }; }
    ok "... all the way" all_done
    ok "... the next run computes nothing" exits 0 "$beadsim" "$T/sweep.yaml" -o "$T/blocked"
    ok "... and says so" lacks " chains"
    ok "... writes the same" same "$T/whole/force.csv" "$T/blocked/force.csv"
    ok "... and takes the journal away" test ! -e "$T/blocked/sweep.h5.part"
    # Forces and energies along the chains are kept, too.
    sed 's/cells: 16, configurations: 12/cells: 8, configurations: 3, magnetism: 0.5, measure: {decay: true}/; s/configurations.csv, show: configurations/decay.csv, show: decay/' "$T/sweep.yaml" >"$T/decay.yaml"
    ok "a sweep that measures decays" exits 0 "$beadsim" "$T/decay.yaml" -o "$T/decays"
    ok "... cannot write its table" fails 1 env LD_PRELOAD="$T/worn.so" "$beadsim" "$T/decay.yaml" -o "$T/worn"
    ok "... and goes on" exits 0 "$beadsim" "$T/decay.yaml" -o "$T/worn"
    ok "... with the same decays" same "$T/decays/decay.csv" "$T/worn/decay.csv"
fi
# Few cells behind soft ones: forces still rise when the front arrives at the end, and the table says so.
ok "a short chain with soft beads" exits 0 "$beadsim" "$T/sweep.yaml" -o "$T/soft" --only configurations.csv --set sweep.cells=8 --set sweep.fixed=3 \
    --set 'sweep.cell=[large-steel, large-steel, ptfe]'
ok "... warns" says "of $(($(wc -l <"$T/soft/configurations.csv") - 1)) chains a measured force was still rising"
ok "... has peaks that are none yet" grep -q ',open,' "$T/soft/configurations.csv"
ok "... and a long one has not" lacks_file ',open,' "$T/whole/configurations.csv"
ok "no fixed cells, written as 0.0" exits 0 "$beadsim" "$T/sweep.yaml" --set sweep.fixed=0.0 --set sweep.measure='{peak: none, decay: true}' \
    --set 'outputs=[{sweep: none.h5}]' -o "$T/none"

# The results are written as sweep.h5.new: never by two runs at once, under names of any length.
mkdir "$T/locked"
touch "$T/locked/sweep.h5.new"
ok "results that another run is writing" fails 2 flock "$T/locked/sweep.h5.new" "$beadsim" "$T/sweep.yaml" --only sweep.h5 -o "$T/locked"
ok "... are refused" says "another run is writing it"
ok "... and its file is as it was" [ "$(stat -c %s "$T/locked/sweep.h5.new")" = 0 ]
long=$(printf '%0252d' 0).h5
ok "a name of 255 bytes" exits 0 "$beadsim" "$T/sweep.yaml" --set "outputs=[{sweep: \"$long\"}]" -o "$T/long"
ok "... and the only one" [ "$(ls "$T/long")" = "$long" ]
# A failure before the first chain is finished leaves no journal.
(ulimit -f 0; run "$beadsim" "$T/sweep.yaml" --only sweep.h5 -o "$T/unwritten") 2>/dev/null
ok "nothing was computed: no journal" empty "$T/unwritten"

# Stopped: what is done stays; the next run takes it from there.
"$beadsim" "$T/sweep.yaml" --set sweep.configurations=200 --threads 1 --only sweep.h5 -o "$T/stopped" >/dev/null 2>"$T/err" &
pid=$!
for ((i = 0; i < 100; i++)); do
    [ "$(stat -c %s "$T/stopped/sweep.h5.part" 2>/dev/null || echo 0)" -gt 1000 ] && break
    sleep 0.05
done
kill -TERM $pid
wait $pid
status=$?
ok "SIGTERM: status 143" [ $status -eq 143 ]
ok "SIGTERM: the journal stays" test -s "$T/stopped/sweep.h5.part"
ok "another scene's journal is refused" fails 2 "$beadsim" "$T/sweep.yaml" --only sweep.h5 -o "$T/stopped"
ok "... with a word on why" says "another scene"
ok "the same scene goes on" exits 0 "$beadsim" "$T/sweep.yaml" --set sweep.configurations=200 --only sweep.h5 -o "$T/stopped"
adds_up() { awk '{for (i = 1; i < NF; i++) if ($i == "chains" && $(i + 1) == "of") sum = $(i - 1) + $(i + 3) - $(i + 2)} /there before/ {found = sum == 0 && $0 ~ /of [0-9]+, [1-9]/} END {exit !found}' "$T/out"; }
ok "... from what was there" adds_up

# What is found beside its journal would seem to be unfinished: the file of a part is there when nothing is left to do.
cat >"$T/late.yaml" <<'YAML'
sweep: {cells: 800, magnetism: [1], configurations: 1}
outputs: [{sweep: sweep.h5}]
YAML
late() { # FILE BYTES : stopped as soon as that file of a part is there, and longer
    local pid
    rm -rf "$T/late"
    "$beadsim" "$T/late.yaml" --shard 1/2 -o "$T/late" >/dev/null 2>"$T/err" &
    pid=$!
    for ((i = 0; i < 3000; i++)); do [ "$(stat -c %s "$T/late/$1" 2>/dev/null || echo 0)" -gt "$2" ] && break; sleep 0.01; done
    kill -TERM $pid 2>/dev/null
    wait $pid
}
one_file() { [ "$(ls "$T/late")" = "$1" ] || { ls "$T/late"; return 1; }; }
late sweep.1of2.h5 0
ok "SIGTERM after a part: it is there, without a journal" one_file sweep.1of2.h5
late sweep.1of2.h5.part 72 # its head
ok "... and before: the journal alone" one_file sweep.1of2.h5.part
ok "... with which the part goes on" exits 0 "$beadsim" "$T/late.yaml" --shard 1/2 -o "$T/late"
ok "... to its end" one_file sweep.1of2.h5

# Parts, by GNU parallel where it is installed.
if command -v parallel >/dev/null && parallel --version 2>/dev/null | grep -q 'GNU parallel'; then
    ok "parts by GNU parallel" exits 0 parallel --will-cite -j 2 "$beadsim" "$T/sweep.yaml" --shard {}/4 -o "$T/parts" ::: 1 2 3 4
else
    skip "GNU parallel (parallel)" "parts by GNU parallel"
    for k in 1 2 3 4; do "$beadsim" "$T/sweep.yaml" --shard $k/4 -o "$T/parts" >/dev/null; done
fi
p=$T/parts/sweep
ok "a part says what it is" exits 0 "$beadsim" --info "$p.3of4.h5"
ok "... which part" prints "part 3 of 4"
ok "parts are merged, in any order" exits 0 "$beadsim" --merge "$p.3of4.h5" "$p.1of4.h5" "$p.4of4.h5" "$p.2of4.h5" -o "$T/merged.h5"
ok "... to the same bytes" same "$T/whole/sweep.h5" "$T/merged.h5"
ok "a missing part" fails 2 "$beadsim" --merge "$p.3of4.h5" "$p.1of4.h5" "$p.4of4.h5" -o "$T/no.h5"
ok "... is named" says "part 2 of 4 is missing"
ok "a part twice" fails 2 "$beadsim" --merge "$p.3of4.h5" "$p.3of4.h5" -o "$T/no.h5"
cp "$p.1of4.h5" "$T/part.h5"
ok "a part is not replaced" fails 2 "$beadsim" --merge "$p.3of4.h5" "$T/part.h5" "$p.4of4.h5" "$p.2of4.h5" -o "$T/part.h5"
ok "..." cmp "$T/part.h5" "$p.1of4.h5"
cp "$T/whole/sweep.h5" "$T/own.h5"
ok "a sweep is not replaced by one of its chains" fails 2 "$beadsim" "$T/own.h5" --configuration 0 -o "$T/own.h5"
ok "..." says "own.h5: would replace what it is made of; give another name or directory with -o"
ok "..." same "$T/whole/sweep.h5" "$T/own.h5"
ok "a foreign file" fails 2 "$beadsim" --merge "$p.1of4.h5" "$T/stopped/sweep.h5" -o "$T/no.h5"
ok "... is named" says "$T/stopped/sweep.h5"
ok "no file is left of these" test ! -e "$T/no.h5"
ok "a part that is none" fails 2 "$beadsim" "$T/sweep.yaml" --shard 5/4
ok "parts of a scene without sweep" fails 2 "$beadsim" clean-vs-delocalised --shard 1/4

# Drawn again.
ok "a table again" exits 0 "$beadsim" "$T/whole/sweep.h5" -o "$T/again.csv"
ok "... is the same" same "$T/whole/force.csv" "$T/again.csv"
# Axis of forces as asked: its ends are labelled, nothing beyond.
ranged() {
    "$beadreel" "$T/whole/sweep.h5" -o "$T/ranged.pdf" --set outputs.0.range='[0.25, 0.75]' >/dev/null || return 1
    pdftotext "$T/ranged.pdf" - | grep -xE '[01]\.[0-9]+' | sort -u >"$T/labels"
    grep -qx 0.25 "$T/labels" && grep -qx 0.75 "$T/labels" && ! grep -qxE '0\.([0189][05]|20)' "$T/labels" || { cat "$T/labels"; return 1; }
}
if command -v pdftotext >/dev/null; then
    ok "a plot of a range" ranged
else
    skip "pdftotext (poppler-utils)" "a plot of a range"
fi
ok "a plot again" exits 0 "$beadreel" "$T/whole/sweep.h5" -o "$T/again.png" --set 'outputs.force.png.size=[640, 400]'
ok "a setting that would change the physics" fails 2 "$beadreel" "$T/whole/sweep.h5" -o "$T/x.png" --set sweep.seed=1
ok "without -o" fails 2 "$beadreel" "$T/whole/sweep.h5"

# One configuration alone: the same peak, to the last digit.
ok "a configuration runs" exits 0 "$beadsim" "$T/whole/sweep.h5" --configuration 17 -o "$T/one.csv"
row=$(grep '^17,' "$T/whole/configurations.csv")
IFS=, read -r _ _ _ force time bead spins _ <<<"$row"
ok "... its peak is that of the sweep" grep -q "^$bead,$force,$time,," "$T/one.csv"
ok "... as a movie" exits 0 "$beadreel" "$T/whole/sweep.h5" --configuration 17 -o "$T/one.mp4" --set 'outputs.0.size=[320, 180]' --set outputs.0.duration=0.1
ok "... as a trajectory" exits 0 "$beadsim" "$T/whole/sweep.h5" --configuration 17 -o "$T/one.h5"
ok "... that tells its spins" exits 0 "$beadsim" --info "$T/one.h5"
ok "... the stored ones" prints "$spins"
ok "a configuration that is not there" fails 2 "$beadsim" "$T/whole/sweep.h5" --configuration 97 -o "$T/x.csv"
ok "--plan says what is computed" exits 0 "$beadsim" --plan "$T/sweep.yaml"
ok "... of which beads" prints "beads 35 to 37"
head -c 3000 "$T/whole/sweep.h5" >"$T/cut.h5"
ok "a damaged file" fails 1 "$beadsim" "$T/cut.h5" -o "$T/x.csv"
ok "parts into a file of another kind" fails 2 "$beadsim" --merge "$T/whole/sweep.h5" -o "$T/x.csv"

# Bytes changed here and there: one line of a message, or none, whatever HDF5 thinks of it. (HDF5 1.10 itself reads a few bytes too
# far in some of them, which only sanitizers see.)
python3 - "$T/whole/sweep.h5" "$T/odd" <<'PY'
import random, sys
whole = open(sys.argv[1], "rb").read()
random.seed(2009)
for i in range(40):
    odd = bytearray(whole)
    for k in range(20): odd[random.randrange(len(odd))] = random.randrange(256)
    open(f"{sys.argv[2]}.{i}.h5", "wb").write(odd)
PY
odd=0
for i in {0..39}; do
    "$beadsim" "$T/odd.$i.h5" -o "$T/odd.csv" >/dev/null 2>"$T/err"
    status=$?
    [ $status -le 2 ] && [ "$(wc -l <"$T/err")" -eq $((status > 0)) ] || grep -q libhdf5 "$T/err" || odd=$((odd + 1))
done
ok "damaged files: one line of a message" [ $odd -eq 0 ]
# Four spins each, from up down to all up: a point each, at domain lengths 1, 2 and 4.
cat >"$T/order.yaml" <<'YAML'
sweep: {cells: 4, spins: ["1010", "1100", "1111"]}
outputs: [{plot: order.svg, against: domain length}]
YAML
ok "peaks against the order of spins" exits 0 "$beadreel" "$T/order.yaml" -o "$T"
ok "... have its name at the axis" grep -q "domain length" "$T/order.svg"
# The plane of magnetism and number of cells has the threshold of the table over it, sweep by sweep.
cat >"$T/plane.yaml" <<'YAML'
sweeps: [{name: long, cells: 40, magnetism: [0, 0.1, 0.2, 0.6, 0.8, 0.9, 1], configurations: 6}, {name: short, cells: 20, magnetism: all, configurations: 6}]
outputs: [{plot: plane.svg, show: plane}, {table: plane.csv}]
YAML
ok "a plane of cells and magnetism" exits 0 "$beadreel" "$T/plane.yaml" -o "$T"
threshold() { # CELLS NAME : of the curve, and of the table
    awk -F, -v n="$1" -v name="$2" 'NR == FNR {if ($1 > 0.99 * n && $1 < 1.01 * n) drawn = $2; next}
        FNR == 1 {for (i = 1; i <= NF; i++) column[$i] = i}
        $1 == name {t = $column["threshold"]} END {print drawn, t; exit !(t > 0.3 && t < 0.9 && drawn > t - 5e-3 && drawn < t + 5e-3)}' "$T/points" "$T/plane.csv"
}
ok "... whose line can be read" eval 'python3 "$top/tests/curves.py" "$T/plane.svg" - >"$T/points"'
ok "... is at the threshold of 20 cells" threshold 20 short
ok "... and at that of 40" threshold 40 long
# Means, quantiles, the plateau and the threshold at 1e-3 are off from those at 1e-6 by no more than the row says. Quantiles share the
# mean's part: all values within it leave each quantile within it. While errors are small what a threshold says is proportional to them.
knows() { # ROUGH FINE
    awk -F, 'function off(a, b) {return a > b ? a - b : b - a}
        FNR == 1 {for (i = 1; i <= NF; i++) column[$i] = i; next}
        NR == FNR {for (name in column) rough[FNR, name] = $column[name]; next}
        {
            part = rough[FNR, "uncertainty"] / rough[FNR, "mean"]
            said["mean"] = rough[FNR, "uncertainty"]; said["mean_N"] = rough[FNR, "uncertainty_N"]
            said["plateau"] = rough[FNR, "plateau_uncertainty"]; said["threshold"] = rough[FNR, "threshold_uncertainty"]
            split("median minimum maximum lower_quartile upper_quartile", quantiles, " ")
            for (i in quantiles) said[quantiles[i]] = part * rough[FNR, quantiles[i]]
            for (name in said) {
                error = off(rough[FNR, name], $column[name])
                moved += error > 0
                if (!(error <= said[name])) {print FNR, name, error, said[name]; bad++}
            }
            ratio = said["threshold"] / $column["threshold_uncertainty"]
            if (!(part < 2.1e-3 && ratio > 980 && ratio < 1020)) {print FNR, part, ratio; bad++}
            rows++
        }
        END {exit !(rows == 18 && moved > 100 && bad == 0)}' "$1" "$2"
}
ok "the same with less accuracy" exits 0 "$beadreel" "$T/plane.yaml" --set simulate.accuracy=1e-3 -o "$T/rough.csv"
ok "... is off by no more than it says" knows "$T/rough.csv" "$T/plane.csv"

# With a step instead of an accuracy, too: all chains differ, and only what is measured says by how much.
cat >"$T/stepped.yaml" <<END
sweeps: [{name: a, cells: 40, magnetism: [0, 0.1, 1], configurations: 6}, {name: b, cells: 20, magnetism: [0, 1], configurations: 6}]
outputs: [{table: a.csv}]
END
ok "a sweep to 1e-10" exits 0 "$beadreel" "$T/stepped.yaml" --set simulate.accuracy=1e-10 -o "$T/exact.csv"
ok "... and in steps of 8 us" exits 0 "$beadreel" "$T/stepped.yaml" --set "simulate.step=8 us" -o "$T/stepped.csv"
ok "... whose means are off by no more than they say" python3 - "$T/stepped.csv" "$T/exact.csv" <<'END'
import csv
import sys

stepped, exact = (list(csv.DictReader(open(name))) for name in sys.argv[1:])
off = [[abs(float(a[mean]) - float(b[mean])) / float(a[said]) for a, b in zip(stepped, exact)]
       for mean, said in (('mean', 'uncertainty'), ('mean_N', 'uncertainty_N'))]
sys.exit(not (len(stepped) == 5 and max(map(max, off)) <= 1 and max(map(max, off)) > 0.01))
END
finish
