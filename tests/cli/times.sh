#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Times that are asked for are got, or an error says why not; runs that end by themselves have seen the first pulse whole.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >scene.yaml <<'YAML'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{bead: large-steel, count: 10}, {bead: large-steel, sensor: first}, {bead: large-steel, count: 8}, {bead: large-steel, sensor: last}]
  wall: brass
outputs:
  - {table: sensors.csv, show: sensors, every: 1 us, uncertainty: false}
  - {image: force.png, size: [320, 200]}
  - {table: peaks.csv}
  - {trajectory: run.h5}
YAML
last_time() { awk -F, '{ t = $1 } END { print t }' "$1"; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a - b < 2e-6 && b - a < 2e-6) }'; }

# ---- asked for ----

ok "later times than the run has by itself" exits 0 "$beadreel" scene.yaml -o long --set 'outputs.0.time=[0.1 ms, 3 ms]'
ok "... are in the table" near "$(last_time long/sensors.csv)" 3e-3
ok "... and planned" exits 0 "$beadreel" scene.yaml --plan --set 'outputs.1.time=[1 ms, 9 ms]'
ok "... by name" prints "time: until 9 ms, the latest that an output asks for"
ok "a still at such a time" exits 0 "$beadreel" scene.yaml --plan --set 'outputs=[{image: a.png, views: [beads], at: 5 ms}]'
ok "... is at it" prints "until 5 ms"
ok "profiles at such a time" exits 0 "$beadreel" scene.yaml --plan --set 'outputs=[{table: a.csv, show: profiles, at: [0, 5 ms]}]'
ok "... are at it" prints "until 5 ms"
ok "a panel with such a time" exits 0 "$beadreel" scene.yaml --plan --set 'outputs=[{image: a.png, panels: [[{time: [0, 5 ms]}]]}]'
ok "... has it" prints "until 5 ms"
ok "not beyond an end that is asked for" fails 2 "$beadreel" scene.yaml -o no --set simulate.until='1 ms' --set 'outputs.1.time=[0.1 ms, 3 ms]'
ok "... but says so" says "outputs.1.time: goes to 0.003 s; must not go beyond the end of the run at 0.001 s"

ok "the run by itself" exits 0 "$beadreel" scene.yaml -o own
end=$(last_time own/sensors.csv)
ok "... is shorter" awk -v end="$end" 'BEGIN { exit !(end < 1e-3) }'
ok "... as planned" bash -c "'$beadreel' scene.yaml --plan | grep -q 'time: until the first pulse has passed the end'"
ok "a file's times" exits 0 "$beadreel" own/run.h5 -o own/again.png --set 'outputs.0.time=[0.1 ms, 0.3 ms]'
ok "later times than a file has" fails 2 "$beadreel" own/run.h5 -o own/more.png --set 'outputs.0.time=[0.1 ms, 3 ms]'
ok "... are an error that says what it has" says "--set:1:16: time: is from 100 us to 3 ms, but own/run.h5 goes from 0 s to"
ok "... and nothing is made" [ ! -e own/more.png ]
ok "the early part that is stored" exits 0 "$beadreel" scene.yaml -o part --set 'outputs.3.time=[0.2 ms, 0.4 ms]' --only run.h5
ok "... has no earlier one" fails 2 "$beadreel" part/run.h5 -o part/more.png --set 'outputs.0.time=[0.1 ms, 0.3 ms]'

# ---- the first pulse ----

# Of the last column of sensors: its maximum, the last value.
whole() { awk -F, 'NR > 1 { if ($NF > most) most = $NF; now = $NF } END { exit !(most > 1 && now < 0.5 * most) }' "$1"; }
closed() { grep -q , "$1" && ! grep -q open "$1"; }
ok "the last sensor's pulse is whole" whole own/sensors.csv
ok "... no force was still rising" closed own/peaks.csv
# Behind the end of a free chain nothing comes back: a long run has the same peaks.
free=(--set chain.wall=none --only peaks.csv)
ok "a chain without a wall" exits 0 "$beadreel" scene.yaml -o free "${free[@]}"
ok "... and for longer" exits 0 "$beadreel" scene.yaml -o longer "${free[@]}" --set simulate.until='1 ms'
peaks() { awk -F, 'NR > 1 { printf "%d %.5g %.4g\n", $1, $2, $3 }' "$1"; }
ok "... has the same peaks" diff <(peaks free/peaks.csv) <(peaks longer/peaks.csv)
ok "... none rising" closed free/peaks.csv
n=0
for beads in '[{cell: [large-steel, aluminium], count: 30, spins: random, magnetism: 0}, {bead: small-steel, sensor: A}]' \
    '[{cell: [large-steel, ptfe], count: 20}]' '[{bead: glass, count: 3}]' '[{bead: brass}]' '[{bead: large-steel, count: 200}]'; do
    for wall in none brass rigid; do
        n=$((n + 1))
        ok "$wall, $beads" exits 0 "$beadsim" scene.yaml -o "many$n" --set "chain.beads=$beads" --set chain.wall=$wall --set 'outputs=[{table: peaks.csv}]'
        ok "... no force was still rising" closed "many$n/peaks.csv"
    done
done
# Times that no grid has are reached between samples.
ok "a moment next to another" exits 0 "$beadsim" shock --plan --set 'outputs=[{table: t.csv, show: profiles, at: [0, 1e-300, 3.86]}]'
ok "... takes no samples without number" bash -c "sed -n 's/.*, \([0-9]*\) times every.*/\1/p' '$T/out' | awk '{ exit !(\$1 > 0 && \$1 < 1e5) }'"
# A run that ends by itself leaves out the beads behind those that outputs see, and says so.
unseen() { # KEYS : the first contact that is seen
    printf '%s\n' 'chain: {beads: [{bead: large-steel, count: 40}]}' "outputs: [{table: t.csv, show: peaks$1}]" >unseen.yaml
    exits 0 "$beadsim" unseen.yaml --plan && { sed -n 's/.*to affect contact \([0-9]*\):.*/\1/p' "$T/out" | tr '\n' ' '; }
}
ok "all contacts are seen" [ "$(unseen '')" = "" ]
ok "... or those from one on" [ "$(unseen ', contacts: [20, 30]')" = "20 " ]
finish
