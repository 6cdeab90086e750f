#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Which sources lack the line that names their licence: tests/spdx.sh [--write] [FILE]... With --write they get it. Without files, all
# sources that git has. Scenes, tables and pictures have none: what is computed from a scene keeps its text. Colour maps have their own.
set -u
write=
[ "${1:-}" != --write ] || { write=1; shift; }
licence="SPDX-License-Identifier: GPL-3.0-or-later"
# The line, in the comments of a file's language, as `line`; fails where the file is no source.
line_of() {
    case $1 in
    *.c | *.h | *.cc | *.js | *.css) line="/* $licence */" ;;
    *.vert | *.frag) line="// $licence" ;;
    *.sh | *.bash | *.fish | *.py | *.yml | */_beadreel | Makefile | .ci/run | debian/rules) line="# $licence" ;;
    *.m) line="% $licence" ;;
    *.html) line="<!-- $licence -->" ;;
    *.[15]) line=".\\\" $licence" ;;
    *) return 1 ;;
    esac
}
# Behind a first line that must be the first.
insert() { # FILE LINE
    local at=1
    head -n 1 "$1" | grep -qE '^(#!|#version|#compdef|<!DOCTYPE)' && at=2
    { head -n $((at - 1)) "$1"; printf '%s\n' "$2"; tail -n +$at "$1"; } >"$1.spdx" && cat "$1.spdx" >"$1"
    rm -f "$1.spdx"
}
if [ $# -eq 0 ]; then
    cd "$(dirname "$0")/.." || exit 1
    mapfile -t files < <(git ls-files)
    set -- "${files[@]}"
fi
sources=()
for file; do if [ -f "$file" ] && line_of "$file"; then sources+=("$file"); fi; done
[ ${#sources[@]} -gt 0 ] || exit 0
mapfile -t named < <(awk -v line="$licence" 'FNR > 3 { nextfile } index($0, line) { print FILENAME }' "${sources[@]}")
mapfile -t without < <(comm -23 <(printf '%s\n' "${sources[@]}" | sort) <(printf '%s\n' "${named[@]}" | sort))
status=0
for file in "${without[@]}"; do
    line_of "$file"
    if [ -n "$write" ]; then insert "$file" "$line"; else echo "$file: no '$licence'"; status=1; fi
done
exit $status
