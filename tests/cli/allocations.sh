#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Failing allocations: of those that the program's own code makes, each of a table fails once, every third of drawings, of which
# test_drawn_allocations has each. The result is the same as ever, or there is a message and none.
source "$(dirname "$0")/../shell.bash"
cat >"$T/scene.yaml" <<'YAML'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads:
    - {cell: [large-steel, aluminium], count: 3, spins: random, magnetism: 0.3, seed: 7}
    - {bead: small-steel, sensor: first}
simulate: {until: 100 us}
outputs:
  - {table: sensitivities.csv, show: sensitivities}
  - {plot: setup.svg, show: setup}
  - {report: report.html}
YAML
nm -D "$beadsim" 2>/dev/null | grep -q __asan_ && sanitized=1
shopt -s nullglob dotglob
# each STEP PROGRAM NAME
each() {
    local k all step=$1
    shift
    "$1" "$T/scene.yaml" --threads 1 --only "$2" -o "$T/whole" >/dev/null || return 1
    LD_PRELOAD=$BUILD/tests/fail_alloc.so FAIL_COUNT=$T/count "$1" "$T/scene.yaml" --threads 1 --only "$2" -o "$T/whole" >/dev/null
    all=$(cat "$T/count")
    [ "$all" -gt 50 ] || { echo "only $all allocations"; return 1; }
    for ((k = 1; k <= all; k += step)); do
        rm -rf "$T/few"
        LD_PRELOAD=$BUILD/tests/fail_alloc.so FAIL_AT=$k run "$1" "$T/scene.yaml" --threads 1 --only "$2" -o "$T/few"
        case $status in
        0) cmp "$T/few/$2" "$T/whole/$2" || { echo "allocation $k of $all"; return 1; } ;;
        1) mapfile -t lines <"$T/err" && left=("$T/few"/*) && [ ${#lines[@]} -eq 1 ] && [ ${#left[@]} -eq 0 ] || { echo "allocation $k of $all"; cat "$T/err"; return 1; } ;;
        *) echo "allocation $k of $all: status $status"; return 1 ;;
        esac
    done
}
if [ "${sanitized:-}" ]; then
    skip "a build without sanitizers" "allocations that fail"
else
    ok "a table of sensitivities" each 1 "$beadsim" sensitivities.csv
    ok "a drawing" each 3 "$beadreel" setup.svg
    ok "a report" each 3 "$beadreel" report.html
fi
finish
