#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Seeds of the fuzz targets, from the ready scenes, the wrong scenes of the tests, and runs of small scenes:
#   tests/fuzz/seeds.sh BUILD DIRECTORY     one directory of seeds for each target
set -eu
cd "$(dirname "$0")/../.."
build=$1 seeds=$2
export BEADREEL_ASSETS=$PWD/assets
mkdir -p "$seeds"/{scene,plan,set,trajectory,sweep,journal}
find assets/scenes tests/bad tests/golden -name '*.yaml' | while read -r scene; do
    cp "$scene" "$seeds/scene/$(tr / - <<<"${scene#*/}")"
done
cp "$seeds"/scene/{scenes,golden}-* "$seeds/plan"

n=0
while read -r setting; do
    n=$((n + 1))
    printf '%b' "$setting" >"$seeds/set/$n"
done <<'SETTINGS'
simulate.method=rkn8\nsimulate.step=0.1 us
chain.striker.velocity=1 m/s
outputs.0.size=[640, 360]\noutputs.1.field=velocity
outputs.+={table: b.csv, show: measures}
outputs.m.mp4.captions.0.text="*F*_{max}"
chain.beads.0.magnetism=0.5\nchain.beads.0.spins="010"
chain={beads: [{bead: brass, count: 3}]}
materials.light.mass=1 g
simulate.until=follow
outputs=[]
SETTINGS

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chain='striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 3, spins: random, magnetism: 0.3, seed: 7}]'
trajectory() {
    printf 'chain: {%s}\nsimulate: {until: 60 us}\noutputs: [{trajectory: %s.h5, every: 10 us, fields: %s}]\n' "$chain" "$1" "$2" >"$work/scene.yaml"
    "$build/beadsim" "$work/scene.yaml" -o "$seeds/trajectory" >"$work/log" 2>&1 || { cat "$work/log"; return 1; }
}
trajectory all all
trajectory displacement '[displacement]'
trajectory force '[force, energy]'
cat >"$work/sweep.yaml" <<'YAML'
sweep: {cells: 4, fixed: 4, magnetism: [0, 0.5], configurations: 4, measure: {decay: true, beads: [1, 2]}}
simulate: {step: 1 us}
outputs: [{sweep: sweep.h5}]
YAML
sweep() { "$build/beadsim" "$work/sweep.yaml" "$@" >"$work/log" 2>&1; }
sweep -o "$seeds/sweep" || { cat "$work/log"; exit 1; }
sweep --shard 1/2 -o "$seeds/sweep" || { cat "$work/log"; exit 1; }
# Journals are what a sweep leaves that cannot write on.
for kib in 1 2 4; do
    (ulimit -f $kib; sweep -o "$work/limit$kib") || true
    cp "$work/limit$kib/sweep.h5.part" "$seeds/journal/$kib" || exit 1
done
