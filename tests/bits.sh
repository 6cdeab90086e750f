#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Hash every result of the ready scenes, to compare two builds bit by bit: tests/bits.sh BUILD [SCENE...]
# EMULATOR=COMMAND runs the programs of another processor. The first line names the library that writes trajectories, whose bytes (not
# numbers) may depend on its version. Then, for each scene, come the hash of all
# states of its chains and one line per file: the files that beadsim makes of the scene, and below all/ a trajectory and tables that
# every scene is asked for. Long scenes are shortened: sweeps to a few configurations, equations to their first part.
# Make the reference anew with `tests/bits.sh build >tests/reference/bits.txt`, and say in the commit why results changed.
set -u
cd "$(dirname "$0")/.." || exit 1
build=$(realpath "$1")
shift
export XDG_CONFIG_HOME=/nowhere XDG_CONFIG_DIRS=/nowhere # the settings of nobody
export BEADREEL_ASSETS=assets # trajectories hold the path of their scene
read -ra emulator <<<"${EMULATOR:-}"
work=$(mktemp -d "${TMPDIR:-/tmp}/beadreel-bits.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT

chain_outputs='{trajectory: run.h5}, {table: measures.csv, show: measures, uncertainty: false}'
bead_outputs="$chain_outputs, {table: chain.csv, show: chain}, {table: peaks.csv, show: peaks}, {table: bead-peaks.csv, show: bead-peaks}"
sweep_outputs='{sweep: sweep.h5}, {table: configurations.csv, show: configurations}'

# shortened SCENE : leaves in `settings` what makes it short, and in `all` the outputs that every scene of its kind can have.
shortened() {
    local file=$BEADREEL_ASSETS/scenes/$1.yaml i
    settings=() all=$bead_outputs
    if grep -q '^ *equation:' "$file"; then all=$chain_outputs; fi
    if grep -q '^sweeps*:' "$file"; then all=$sweep_outputs; fi
    case $1 in
    fput-kdv) settings=(simulate.until=200 'outputs.1.at=[0, 200]') ;;
    zabusky-kruskal) settings=(simulate.until=1.2) ;;
    thesis/fig8) settings=(simulate.until=1 'outputs.0.at=[0, 1]' 'outputs.1.at=[0, 1]') ;;
    cradle) settings=(simulate.until=0.05) ;;
    kdv) settings=(chain.points=400) ;;
    shock) settings=(simulate.until=4 'outputs.2.at=[0, 2, 3.86]') ;;
    martinez2016) settings=(simulate.until=20 'sweep.over={chain.beads.0.disorder.seed: 1..2}') ;;
    sweep) settings=(sweep.configurations=2) ;;
    thesis/fig6) settings=(sweep.configurations=1) ;;
    thesis/decay) settings=(sweep.configurations=1 'sweep.magnetism=[0.9]') ;;
    thesis/fig7) for i in 0 1 2 3; do settings+=("sweeps.$i.configurations=2" "sweeps.$i.magnetism=[1, 0.5]"); done ;;
    esac
}

# That of OpenSSL uses the processor's own instructions: four times as fast.
sums() { if command -v openssl >/dev/null; then openssl dgst -r -sha256 "$@" | sed 's/ \*/ /'; else sha256sum "$@"; fi; }

# of_files SCENE DIRECTORY : one line a file.
of_files() {
    (cd "$2" && mapfile -t files < <(find . -type f | LC_ALL=C sort) && sums "${files[@]}") | while read -r hash file; do
        echo "$1 ${file#./} ${hash:0:16}"
    done
}

of_scene() {
    local dir=$work/now states
    shortened "$1"
    mkdir "$dir" "$dir/all"
    local set=()
    for s in "${settings[@]}"; do set+=(--set "$s"); done
    "${emulator[@]}" "$build/beadsim" "$1" -o "$dir" "${set[@]}" --progress=none >/dev/null 2>"$work/err" &&
        states=$("${emulator[@]}" "$build/tests/examples/states" "$1" "$dir/all" "${settings[@]}" "outputs=[$all]" 2>"$work/err") || {
        echo "$1 failed: $(head -n 1 "$work/err")"
        rm -rf "$dir"
        return 1
    }
    [ "$all" = "$sweep_outputs" ] || echo "$1 states $states"
    of_files "$1" "$dir"
    rm -rf "$dir"
}

echo "# $("${emulator[@]}" "$build/beadsim" --list libraries | grep -o -m 1 '^libhdf5[^ ]*')"
if [ $# -eq 0 ]; then
    mapfile -t scenes < <(cd "$BEADREEL_ASSETS/scenes" && find . -name '*.yaml' | sed 's,^\./,,; s,\.yaml$,,' | LC_ALL=C sort)
    set -- "${scenes[@]}"
fi
failed=0
for scene; do of_scene "$scene" || failed=1; done
exit "$failed"
