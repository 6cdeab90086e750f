#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every number of every table knows its error.
source "$(dirname "$0")/../shell.bash"
run /usr/bin/python3 -B "$top/tests/known.py" "$beadsim" "$top/assets/scene.schema.json"
relay
finish
