#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# H5Web, run as it is in a browser, shows trajectories: of one chain the axis is that of its beads, of two there is none.
# h5web.sh BUILD, after `make deps-peers`
BUILD=$(realpath "$1")
source "$(dirname "$0")/../shell.bash"
python=/usr/bin/python3
export NODE_PATH=$top/build/npm/node_modules
if ! [ -d "$NODE_PATH/@h5web/h5wasm" ]; then
    skip "H5Web (npm for make deps-peers)" "H5Web shows trajectories"
elif ! find_browser; then
    skip "a Chromium that runs here (chromium)" "H5Web shows trajectories"
else
    cat >"$T/one.yaml" <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 8}], wall: brass}
outputs:
  - {trajectory: one.h5, every: 1 us, fields: [displacement, velocity, force, contact-force, energy]}
YAML
    ok "one chain runs" exits 0 "$beadsim" "$T/one.yaml" -o "$T"
    ok "the demo runs" exits 0 "$beadsim" clean-vs-delocalised --only run.h5 -o "$T"
    ok "H5Web is bundled" "$NODE_PATH/.bin/esbuild" "$top/tests/stress/h5web.jsx" --bundle --format=esm --jsx=automatic --outfile="$T/main.js"
    PYTHONPATH=$top/tests run timeout 240 "$python" "$top/tests/stress/h5web.py" "$browser" "$T" one.h5 run.h5
    relay ""
fi
finish
