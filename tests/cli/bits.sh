#!/bin/bash
# The ready scenes give the bits of the reference: tests/reference/bits.txt.
source "$(dirname "$0")/../shell.bash"
reference=$top/tests/reference/bits.txt

run "$top/tests/bits.sh" "$BUILD"
ok "every ready scene runs" test "$status" -eq 0
if [ "$(head -n 1 "$T/out")" = "$(head -n 1 "$reference")" ]; then
    ok "states, tables and trajectories have the same bits as the reference" diff "$reference" "$T/out"
else
    skip "what made the reference ($(head -n 1 "$reference" | cut -c3-))" "states, tables and trajectories have the same bits as the reference"
fi
finish
