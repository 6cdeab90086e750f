#!/bin/bash
# Write the options part of the man page from the program's table: tests/man_options.sh [--check] PROGRAM PAGE
# With --check: fail where it differs.
set -eu
check=
[ "$1" != --check ] || { check=1; shift; }
new=$(mktemp)
trap 'rm -f "$new"' EXIT
{
    sed '/^\.\\" options: begin/q' "$2"
    "$1" --help=man
    sed -n '/^\.\\" options: end/,$p' "$2"
} >"$new"
if [ -n "$check" ]; then
    diff "$2" "$new" || { echo "Run 'make man'."; exit 1; }
else
    cat "$new" >"$2"
fi
