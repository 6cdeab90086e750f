#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Properties that every scene has, on scenes drawn at random; thousands of them: make properties.
source "$(dirname "$0")/../shell.bash"
cd "$top" || exit 1
python=/usr/bin/python3
if ! "$python" -c 'import hypothesis' 2>/dev/null; then
    skip "python3-hypothesis" "properties of random scenes"
    finish
fi
run "$python" tests/properties.py "$beadsim" "${CASES:-14}"
relay
finish
