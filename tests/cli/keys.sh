#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The examples of beadreel-scene(5): every key has one, and every one is accepted where it belongs.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1

# SECTION|KEY|VALUE of all examples; SECTION|KEY| of a key without one.
"$beadreel" --help=man-keys | sed -e 's/\\-/-/g' -e "s/\\\\(aq/'/g" -e 's/\\e/\\/g' | awk '
    /^\.SS / { section = substr($0, 5) }
    /^\.B / { key = substr($0, 4) }
    /^Value: / {
        value = ""
        if (match($0, /Example: \\fB/)) { value = substr($0, RSTART + RLENGTH); sub(/\\fR\.$/, "", value); sub(/^[^:]*: /, "", value) }
        print section "|" key "|" value
    }' >examples
ok "there are examples" test "$(wc -l <examples)" -gt 100
without_example() { ! grep '|$' examples; }
ok "every key has one" without_example

cat >chain.yaml <<'YAML'
chain:
  beads:
    - {cell: [large-steel, aluminium], count: 64, spins: random}
    - {bead: small-steel, sensor: first}
    - {bead: brass, count: 50}
  wall: brass
outputs: [{table: t.csv}]
YAML
echo 'outputs: [{table: t.csv}]' >empty.yaml
echo '{chains: [{name: clean, beads: [{bead: brass}]}, {name: other, beads: [{bead: brass}]}], outputs: [{plot: p.png, show: peaks}]}' >pair.yaml
echo '{sweep: {cells: 16}, outputs: [{table: t.csv}]}' >sweep.yaml
echo '{chain: {striker: {velocity: 1 m/s}, beads: [{bead: brass, count: 50, disorder: {radius: normal 1 %, seed: 1}}]}, sweep: {over: {chain.striker.velocity: [1 m/s]}}, outputs: [{table: t.csv}]}' >over.yaml
for equation in 'fput, points: 31, start: {mode: 1}' 'kdv, low: -12, length: 34, start: {solitons: [{speed: 4, at: 0}]}' \
    'shock, length: 6.3, epsilon: 0.5, start: {simple-wave: 1, amplitude: 1}'; do
    echo "{chain: {equation: $equation}, simulate: {until: 1}, outputs: [{table: t.csv, show: measures}]}" >"${equation%%,*}.yaml"
done

printf 'time,force\n0,0\n1e-4,2\n' >scope.csv

# all_of SECTION : its keys with their examples, for a map that may need several of them.
all_of() { awk -F'|' -v section="$1" '$1 == section { printf "%s%s: %s", n++ ? ", " : "", $2, $3 }' examples; }

# base SECTION : into `scene`, `prefix` and `before`, where a section's keys belong, and what they need there.
base() {
    scene=chain before=()
    kind=${1#outputs (}
    kind=${kind%)} kind=${kind% of a sweep}
    file=$(awk -F'|' -v section="$1" -v key="$kind" '$1 == section && $2 == key { print $3 }' examples)
    case $1 in
    scene) prefix= ;;
    chain | chain.striker | chain.damping | chain.cradle | simulate) prefix=$1. ;;
    chain.starts) prefix=chain.start.0. before=('chain.start=[{bead: 1, velocity: 1 m/s}]' simulate.until=1ms) ;;
    chain.beads) prefix=chain.beads.0. ;;
    chain.beads.taper) prefix=chain.beads.0.taper. before=('chain.beads=[{bead: brass, count: 5, taper: {to: 2 mm}}]') ;;
    chain.drive) prefix=chain.drive. before=('chain.drive={force: sine, amplitude: 1 N, frequency: 1 kHz}' simulate.until=1ms) ;;
    chain.drive.file) prefix=chain.drive.force. before=('chain.drive={force: {file: scope.csv}, amplitude: 1 N}' simulate.until=1ms) ;;
    chain.beads.disorder) prefix=chain.beads.0.disorder. ;;
    chain.wall) prefix=chain.wall. before=('chain.wall={absorbing: 1 kg/s}') ;;
    'chain.law ('*')') prefix=chain.law. before=("chain.law={$(all_of "$1")}") ;;
    materials.NAME) prefix=materials.x. before=('materials={x: {modulus: 1 GPa, poisson: 0.3, radius: 1 mm, mass: 1 g}}') ;;
    materials.NAME.tolerance) prefix=materials.x.tolerance. before=('materials={x: {modulus: 1 GPa, poisson: 0.3, radius: 1 mm, mass: 1 g}}') ;;
    'chain (fput)' | 'chain (kdv)' | 'chain (shock)') scene=${1#* (} scene=${scene%)} prefix=chain. ;;
    'chain (equation)') scene=fput prefix=chain. ;;
    chain.piecewise) scene=fput prefix=chain.piecewise. before=('chain.piecewise={stiffness: 1.5, beyond: 0.05}') ;;
    'chain.start (mode)') scene=fput prefix=chain.start. ;;
    'chain.start (pulse)') scene=fput prefix=chain.start. before=('chain.start={pulse: 0.1, width: 5, at: 5}') ;;
    'chain.start (cosine)') scene=kdv prefix=chain.start. before=('chain.start={cosine: 1, amplitude: 1}') ;;
    'chain.start (simple-wave)') scene=shock prefix=chain.start. ;;
    'chain.start (solitons)') scene=kdv prefix=chain.start. ;;
    chain.start.solitons) scene=kdv prefix=chain.start.solitons.0. ;;
    outputs.speed) prefix=outputs.0.speed.0. before=('outputs=[{movie: m.mp4, speed: [{at: 0, factor: 1/5000}]}]') ;;
    outputs.captions) prefix=outputs.0.captions.0. before=('outputs=[{movie: m.mp4, captions: [{at: 0, text: x}]}]') ;;
    outputs.notes) prefix=outputs.0.notes.0. before=('outputs=[{movie: m.mp4, notes: [{at: 0, text: x}]}]') ;;
    outputs.card) prefix=outputs.0.card. before=('outputs=[{movie: m.mp4, card: {text: x}}]') ;;
    sweep) scene=sweep prefix=sweep. ;;
    sweep.measure) scene=sweep prefix=sweep.measure. before=('sweep.measure={peak: force}') ;;
    sweep.over) scene=over prefix=- before=("sweep.over={chain.striker.velocity: {$(all_of "$1")}}") ;; # its path has dots itself
    'outputs (image of a sweep)') scene=over prefix=outputs.0. before=("outputs=[{$kind: $file}]") ;;
    'outputs (sweep)' | 'outputs (sheet)' | 'outputs ('*' of a sweep)') scene=sweep prefix=outputs.0. before=("outputs=[{$kind: $file}]") ;;
    'outputs ('*')') prefix=outputs.0. before=("outputs=[{$kind: $file}]") ;;
    outputs.measured) prefix=outputs.0.measured. before=('outputs=[{plot: p.svg, beads: 3, measured: {points: "0 0, 1 1"}}]') ;;
    outputs.panels) prefix=outputs.0.panels.0.0. ;;
    *) prefix='?' ;;
    esac
}
# What a key needs besides, or instead.
needs() { # SECTION KEY
    case "$1: $2" in
    'outputs (plot of a sweep): scale' | 'outputs ('*' of a sweep): against' | 'outputs ('*' of a sweep): measure') scene=over ;;
    'sweep: over' | 'sweep: combine') scene=over ;;
    'outputs ('[pt]*' of a sweep): field') scene=over before=("outputs=[{$kind: $file, show: sensors, contacts: 3}]") ;;
    'outputs ('[pt]*' of a sweep): beads' | 'outputs ('[pt]*' of a sweep): contacts' | 'outputs ('[pt]*' of a sweep): time' | 'outputs ('[pt]*' of a sweep): every')
        scene=over before=("outputs=[{$kind: $file, show: sensors, beads: 3}]" simulate.until=3ms) ;;
    'outputs ('[pt]*' of a sweep): window' | 'outputs ('[pt]*' of a sweep): segment' | 'outputs ('[pt]*' of a sweep): frequencies')
        scene=over before=("outputs=[{$kind: $file, show: spectrum, beads: 3}]" simulate.until=3ms) ;;
    'outputs (table of a sweep): uncertainty') scene=over before=('outputs=[{table: t.csv, show: spreading}]' simulate.until=1ms) ;;
    'outputs (table): beads') before+=('outputs.0.show=sensors') ;;
    'outputs.measured: file' | 'outputs.measured: columns' | 'outputs.measured: time') before=('outputs=[{plot: p.svg, beads: 3, measured: {file: scope.csv}}]') ;;
    'outputs (plot): measured') before+=(outputs.0.beads=3) ;;
    'scene: fit') before=('outputs=[{plot: p.svg, beads: 3, measured: {points: "0 0, 5e-5 20, 7e-5 30, 2e-4 0"}}]' chain.striker.velocity=0.5m/s) ;;
    'chain: start' | 'chain: drive' | 'chain: cradle' | chain.cradle:* | 'chain.beads: spring' | 'chain.beads.disorder: spring' | 'chain.striker: spring')
        before=(simulate.until=1ms) ;;
    'chain.drive: displacement') before=('chain.drive={amplitude: 1 um, frequency: 1 kHz}' simulate.until=1ms) ;;
    'chain.drive: force') before=('chain.drive={amplitude: 1 N}' simulate.until=1ms) ;;
    'chain.drive: amplitude') before=('chain.drive={displacement: sine, frequency: 1 kHz}' simulate.until=1ms) ;;
    'chain.drive: to') before=('chain.drive={force: chirp, amplitude: 1 N, frequency: 1 kHz}' simulate.until=1ms) ;;
    'scene: chain' | 'scene: chains' | 'scene: sweep' | 'scene: sweeps') scene=empty ;;
    'chain.beads: bead' | 'chain.beads: sensor') before=('chain.beads=[{bead: brass}]') ;;
    'outputs (movie): race') scene=pair ;;
    'outputs.notes: chain') scene=pair before+=(chains.0.name=Clean) ;;
    'outputs (movie): background') before=('outputs=[{movie: m.webm}]') ;;
    'chain.beads: decorate') before=('chain.beads=[{bead: brass, count: 4}]') ;;
    'chain.beads: repeat') before=('chain.beads=[{of: [{bead: brass}]}]') ;;
    'chain.beads: of') before=('chain.beads=[{repeat: 2}]') ;;
    'materials.NAME: density') before=('materials={x: {modulus: 1 GPa, poisson: 0.3, radius: 1 mm}}') ;;
    'chain ('*': equation') scene=fput ;;
    'chain (kdv): start') before=(chain.length=200 chain.points=1024) ;;
    'sweep: spins') before=(sweep.cells=4) ;;
    'sweep: measure' | 'sweep.measure: sensor') scene=chain before=('sweep={measure: {peak: force}}' 'outputs=[{table: t.csv}]') ;;
    'sweep: tilt') before=(sweep.wall=brass) ;;
    'outputs (movie): window') before+=(outputs.0.follow=front) ;;
    *': poster-at') before+=(outputs.0.poster=p.png simulate.until=1ms) ;;
    *': letters') before+=('outputs.0.panels=[[{show: peaks}]]') ;;
    *': panels') scene=pair ;;
    'outputs.panels: '*) scene=pair before=('outputs=[{image: i.png, panels: [[{show: peaks}]]}]') ;;
    'outputs (image): at' | 'outputs (image): magnify') before+=('outputs.0.views=[beads]') ;;
    'outputs (plot): scale') before+=(outputs.0.show=peaks) ;;
    'outputs ('*'): parts') before+=(outputs.0.show=energy) ;;
    'outputs (plot): contact' | 'outputs (plot): compression') before+=(outputs.0.show=contact) ;;
    'outputs (plot): modes' | 'outputs (table): modes') scene=fput before=("outputs=[{$kind: $file, show: modes}]") ;;
    'outputs (plot): field' | 'outputs (table): field') before=("outputs=[{$kind: $file, show: profiles, at: [0]}]") ;;
    'outputs (plot of a sweep): theory') scene=over before=('outputs=[{plot: i.png, show: spreading}]' simulate.until=1ms) ;;
    'outputs (image): theory' | 'outputs (movie): theory') before+=('chain.beads=[{bead: brass, count: 40}]') ;;
    'outputs (plot): theory') before=("outputs=[{plot: i.png, show: profiles, at: [0], field: contact-force}]") ;;
    'outputs (plot): at' | 'outputs (table): at') before=("outputs=[{$kind: $file, show: profiles, at: [0]}]") ;;
    'outputs (plot): window' | 'outputs (plot): segment' | 'outputs (plot): frequencies' | 'outputs (table): window' | 'outputs (table): segment' | 'outputs (table): frequencies')
        before=("outputs=[{$kind: $file, show: spectrum, beads: 1}]") ;;
    'outputs (table): contacts') before=('outputs=[{table: t.csv, show: sensitivities}]') ;;
    'outputs (table): time' | 'outputs (table): every') before+=(outputs.0.show=sensors) ;;
    esac
}
accepted() { # SECTION KEY VALUE
    local settings=()
    base "$1"
    needs "$1" "$2"
    [ "$prefix" != '?' ] || { echo "unknown section: say in base() of tests/cli/keys.sh where its keys belong"; return 1; }
    [ "$prefix" = - ] || before+=("$prefix$2=$3")
    for setting in "${before[@]}"; do settings+=(--set "$setting"); done
    "$beadreel" --plan "$scene.yaml" "${settings[@]}" >/dev/null
}
while IFS='|' read -r section key value; do
    [ -z "$value" ] || ok "$section: $key: $value" accepted "$section" "$key" "$value"
done <examples
finish
