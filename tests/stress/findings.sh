#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The claims of the thesis with all runs, those of minutes, too:  findings.sh BUILD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
assets/findings/make.py --all "$1/beadsim" > "$work/findings.md" && diff "$work/findings.md" assets/findings.md && echo "  findings.md is as all runs have it  ok"
