#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
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
  - {trajectory: two.h5, every: 1 us, beads: [3, 10], xdmf: true}
YAML
cat >"$T/utf8.yaml" <<'YAML'
title: "Stahl: 45 °, µm"
chain: {beads: [{bead: large-steel, count: 12}]}
simulate: {until: 0.4 ms}
outputs:
  - {trajectory: utf8.h5, every: 1 us, fields: [velocity, contact-force]}
YAML
export NODE_PATH=$top/build/npm/node_modules
demo() { exits 0 "$beadsim" clean-vs-delocalised --only run.h5 --set outputs.run.h5.xdmf=true -o "$T"; }
for scene in one two utf8 run; do
    case $scene in
    run) ok "the demo runs" demo ;;
    *) ok "$scene runs" exits 0 "$beadsim" "$T/$scene.yaml" -o "$T" ;;
    esac
done
# All by one process: what it imports takes longer than what it reads.
run "$python" -W ignore "$top/tests/readers.py" python "$T/one.h5" "$T/two.h5" "$T/utf8.h5" "$T/run.h5"
relay

named() { exits 0 "$beadsim" "$T/two.yaml" -o "$T" --json && prints '"name": "two.xdmf"' && prints '"kind": "xdmf"'; }
ok "the file for ParaView is one of the results" named
colon() { fails 2 "$beadsim" "$T/two.yaml" -o "$T" --set 'outputs.0.trajectory=a:b.h5' && says "colon"; }
ok "... not of a name with a colon" colon
still() { fails 2 "$beadsim" "$T/two.yaml" -o "$T" --set 'outputs.0.fields=[velocity]' && says "add displacement"; }
ok "... nor without places" still

# While a run writes, h5py reads what was flushed; HDF5's locks, which the writer does not need, are left out. The run takes minutes, but
# has few megabytes to write in the time given to the reader.
cat >"$T/long.yaml" <<'YAML'
chain: {beads: [{bead: large-steel, count: 300}], precompression: 10 N, wall: rigid}
simulate: {until: 100 s}
outputs:
  - {trajectory: long.h5, every: 100 us, beads: [0, 1]}
YAML
"$beadsim" "$T/long.yaml" -o "$T/long" --progress=none >/dev/null 2>"$T/long.err" &
writer=$!
reads() {
    "$python" - "$T/long/long.h5.part" <<'PYTHON'
import sys, time
import h5py, numpy as np
samples = []
while len(samples) < 2:  # two states of the file, the second with more samples
    try:
        with h5py.File(sys.argv[1], "r", locking=False) as file:
            t = file["time"][:]
            v = file["particles/chain/velocity/value"]
            if len(t) > (samples[-1] if samples else 10):
                assert len(v) >= len(t) and np.isfinite(v[: len(t)]).all() and (np.diff(t) > 0).all()
                assert np.abs(v[len(t) // 2]).max() > 0
                samples.append(len(t))
    except OSError:  # not there yet, or seen in the midst of a flush
        pass
    time.sleep(0.01)
PYTHON
}
ok "h5py reads while the run writes" timeout 100 bash -c "$(declare -p python T); $(declare -f reads); reads"
at_work() { [ "$1" -eq 130 ] || { cat "$T/long.err"; return 1; }; }
kill -INT "$writer" && wait "$writer"
ok "the writer was still at work" at_work $?
finish
