#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Extreme chains: the tables of the programs stress_*, and scenes whose front never comes, which must end with a message.
#   stress.sh BUILD       status 1 if a row FAILED; STRESS_QUICK=1: seconds instead of minutes
build=$1
status=0
for program in stability ranges sizes accuracy uncertainty long; do
    "$build/tests/stress/stress_$program" || status=1
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# front STATUS NAME CHAIN: the default end, when the front has passed (status 0), or a message (1).
front() {
    wanted=$1
    shift
    printf 'materials: {light: {mass: 3.63e-9 kg, radius: 4.76 mm, modulus: 193 GPa, poisson: 0.3}}\n' > "$work/scene.yaml"
    printf 'chain: {%s}\noutputs: [{table: peaks.csv, show: peaks}]\n' "$2" >> "$work/scene.yaml"
    timeout 60 "$build/beadsim" "$work/scene.yaml" -o "$work/out" > "$work/log" 2>&1
    got=$?
    verdict=ok
    [ "$got" = "$wanted" ] || verdict=FAILED status=1
    printf '  %-34s status %d: %s  %s\n' "$1" "$got" "$(tail -n 1 "$work/log" | sed "s,$work/,,g" | cut -c 1-160)" "$verdict"
}
echo "Until the front has passed, or a message says that it does not:"
front 1 'light last bead' 'beads: [{cell: [large-steel, light], count: 10}]'
front 0 'heavy last bead' 'beads: [{cell: [light, large-steel], count: 10}]'
front 0 'strong damping' 'damping: {coefficient: 100, exponent: 1}, beads: [{bead: large-steel, count: 100}]'
front 1 'very strong damping' 'damping: {coefficient: 1e6, exponent: 1}, beads: [{bead: large-steel, count: 100}]'
front 1 'heavy bead within' 'beads: [{bead: light, count: 10}, {bead: large-steel}, {bead: light, count: 10}]'
front 0 'compressed, light striker' 'striker: {bead: light, velocity: 1 m/s}, precompression: 1 N, beads: [{bead: large-steel, count: 20}]'
exit $status
