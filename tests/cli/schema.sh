#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The JSON Schema of scenes: up to date, and telling right scenes from wrong ones.
source "$(dirname "$0")/../shell.bash"
cd "$top" || exit 1
python=/usr/bin/python3

ok "--list schema" exits 0 "$beadreel" --list schema
ok "the file of it is up to date (make man)" cmp "$T/out" assets/scene.schema.json
ok "both programs have the same" exits 0 "$beadsim" --list schema
ok "... schema" cmp "$T/out" assets/scene.schema.json
if ! "$python" -c 'import jsonschema, yaml' 2>/dev/null; then
    skip "python3-jsonschema, python3-yaml" "scenes pass the schema"
    finish
fi
run "$python" tests/schema.py assets/scene.schema.json
relay
finish
