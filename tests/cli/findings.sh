#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The thesis's claims: assets/findings.md is what its template and the runs give. Longer runs are taken from assets/findings/long;
# `make stress` makes these, too.
source "$(dirname "$0")/../shell.bash"
python=$(command -v python3)
if [ -z "$python" ]; then
    skip "python3" "findings.md is as its template and the runs have it"
    finish
fi
ok "the template and the runs make a document" exits 0 "$python" "$top/assets/findings/make.py" "$beadsim"
ok "... which is findings.md, to the letter" diff "$T/out" "$top/assets/findings.md"
finish
