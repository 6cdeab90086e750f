#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The ready scenes give the bits of the reference: tests/reference/bits.txt.
source "$(dirname "$0")/../shell.bash"
reference=$top/tests/reference/bits.txt

run "$top/tests/bits.sh" "$BUILD"
ok "every ready scene runs" test "$status" -eq 0
# Files of another version of HDF5 may have other bytes.
trajectories='[.]h5 '
ok "states and tables have the same bits as the reference" diff <(grep -v -e "^#" -e "$trajectories" "$reference") <(grep -v -e "^#" -e "$trajectories" "$T/out")
if [ "$(head -n 1 "$T/out")" = "$(head -n 1 "$reference")" ]; then
    ok "trajectories have the same bits as the reference" diff <(grep "$trajectories" "$reference") <(grep "$trajectories" "$T/out")
else
    skip "what made the reference ($(head -n 1 "$reference" | cut -c3-))" "trajectories have the same bits as the reference"
fi
finish
