#!/bin/bash
# Readers of other people open a trajectory of a real run, finished or stopped; where they are installed.
source "$(dirname "$0")/../shell.bash"
python=/usr/bin/python3
if ! "$python" -c 'import h5py' 2>/dev/null; then
    skip "python3-h5py" "readers open a trajectory"
    finish
fi

cat >"$T/one.yaml" <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 8}], wall: brass}
outputs:
  - {trajectory: one.h5, every: 1 us, fields: [displacement, velocity, force, contact-force, energy]}
YAML
cat >"$T/two.yaml" <<'YAML'
chains:
  - {name: first, beads: [{bead: large-steel, count: 12}]}
  - {name: second, beads: [{bead: aluminium, count: 9}], precompression: 2 N, wall: rigid}
simulate: {until: 0.4 ms}
outputs:
  - {trajectory: two.h5, every: 1 us, beads: [3, 10]}
YAML
for scene in one two; do
    ok "$scene runs" exits 0 "$beadsim" "$T/$scene.yaml" -o "$T"
    run "$python" -W ignore "$top/tests/readers.py" "$T/$scene.h5"
    while read -r line; do
        case $line in
        "# missing: "*) missing=${line#* missing: } ;;
        "ok "*" # SKIP") line=${line% # SKIP} && skip "$missing" "$scene: ${line#ok * - }" ;;
        "ok "*) ok "$scene: ${line#ok * - }" true ;;
        "not ok "*) ok "$scene: ${line#not ok * - }" false ;;
        esac
    done <"$T/out"
    ok "$scene: the checks came to their end" grep -q "^1\.\." "$T/out"
done
finish
