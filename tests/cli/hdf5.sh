#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# HDF5 is opened when a trajectory or a sweep's file is written or read, and not before; where it is missing, the rest works.
source "$(dirname "$0")/../shell.bash"
cat >"$T/scene.yaml" <<'YAML'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 8}]
  wall: brass
simulate: {until: 0.2 ms}
outputs:
  - {table: peaks.csv}
  - {image: force.png, size: [320, 180]}
  - {trajectory: run.h5}
YAML
cat >"$T/sweep.yaml" <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 16, spins: random}, {bead: large-steel, count: 8}]}
sweep: {magnetism: all, configurations: 4}
outputs:
  - {sweep: sweep.h5}
  - {table: statistics.csv}
YAML
# loaded COMMAND... : the libraries that it loads, at its start or later. (libasan opens for the program.)
loaded() { LD_DEBUG=files "$@" 2>&1 >/dev/null | sed -n 's/.*calling init: .*\/\(lib[^ /]*\).*/\1/p' | sort -u; }
# opened COMMAND... : those that the program itself opens.
opened() { LD_DEBUG=files "$@" 2>&1 >/dev/null | sed -n 's/.*file=\(libhdf5[^ ]*\) .*dynamically loaded by [^ ]*\(beadsim\|beadreel\|libasan\)[^ ]* .*/\1/p' | sort -u; }
without_hdf5() { loaded "$@" >"$T/loaded"; grep -q '^libc[.]' "$T/loaded" && ! grep hdf5 "$T/loaded"; }
listed() { opened "$beadsim" "$T/scene.yaml" -o "$T/there" >"$T/opened" && [ "$(wc -l <"$T/opened")" -eq 2 ] && "$1" --list libraries | grep -o '^libhdf5[^ ]*' | sort -u | diff - "$T/opened"; }

ok "a table starts without HDF5" without_hdf5 "$beadsim" "$T/scene.yaml" -o "$T/there" --only peaks.csv
ok "... and is made" test -s "$T/there/peaks.csv"
ok "so does a picture" without_hdf5 "$beadreel" "$T/scene.yaml" -o "$T/there" --only force.png
ok "... and is made" test -s "$T/there/force.png"
ok "a trajectory opens what beadsim --list libraries names" listed "$beadsim"
ok "... and beadreel --list libraries" listed "$beadreel"
ok "... and is made" test -s "$T/there/run.h5"
ok "a sweep's file is made" exits 0 "$beadsim" "$T/sweep.yaml" -o "$T/there"

# As where HDF5 is not installed: what is found in its place is none.
mkdir "$T/none"
while read -r missing; do echo 'int nothing;' | cc -shared -fPIC -x c - -o "$T/none/$missing"; done <"$T/opened"
missing=$(tail -n 1 "$T/opened")
not_there() { env LD_LIBRARY_PATH="$T/none" "$@"; }
said() { says "need HDF5: " && says "$missing" && says "(install lib"; }
ok "without HDF5, a table is made" exits 0 not_there "$beadsim" "$T/scene.yaml" -o "$T/table" --only peaks.csv
ok "... the same" cmp "$T/there/peaks.csv" "$T/table/peaks.csv"
ok "a trajectory is not" fails 1 not_there "$beadsim" "$T/scene.yaml" -o "$T/trajectory"
ok "... and the message says what to install" said
ok "... and nothing is left" empty "$T/trajectory"
ok "a sweep's file is not" fails 1 not_there "$beadsim" "$T/sweep.yaml" -o "$T/sweep" --progress=none
ok "... and the message says what to install" said
ok "... before a chain has run" empty "$T/sweep"
for file in run.h5 sweep.h5; do
    ok "$file is not drawn" fails 1 not_there "$beadreel" "$T/there/$file" -o "$T/wave.png"
    ok "... and the message says what to install" said
    ok "$file is not described" fails 1 not_there "$beadreel" --info "$T/there/$file"
    ok "... and the message says what to install" said
    ok "no chain of $file is run" fails 1 not_there "$beadreel" "$T/there/$file" --configuration 1 -o "$T/wave.png"
    ok "... and the message says what to install" said
done

# It is installed, but cannot be opened: the loader's reason is told, and there is nothing to install.
mkdir "$T/short"
while read -r short; do : >"$T/short/$short"; done <"$T/opened"
reason() { says "$1" && ! says "install" >/dev/null; }
ok "a library that is cut off" fails 1 env LD_LIBRARY_PATH="$T/short" "$beadsim" "$T/scene.yaml" -o "$T/trajectory"
ok "... is told as such" reason "file too short"
ok "parts are not merged" fails 1 not_there "$beadsim" --merge "$T/there/sweep.h5" -o "$T/whole.h5"
ok "... and the message says what to install" said
finish
