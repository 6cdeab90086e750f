#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every plot of a run and of a sweep says what its table says: see tests/plots.py.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
python3 "$top/tests/plots.py" "$beadreel" >"$T/out" 2>"$T/err"
relay
finish
