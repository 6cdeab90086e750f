#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fill in the generated parts of the man pages: assets/man/make.sh [--check] BUILD PAGE...
# A part stands between `.\" begin: COMMAND` and `.\" end`; COMMAND is `beadreel ...` or `beadsim ...`. What --help=man and
# --help=man-keys print is man source already; what --list prints becomes a list of terms. The version in .TH follows the program.
# With --check: write nothing, and fail where a page differs.
set -eu
check=
[ "$1" != --check ] || { check=1; shift; }
build=$1
shift
new=$(mktemp)
trap 'rm -f "$new"' EXIT

# `name  description` lines as .TP items; columns of a table become a sentence.
terms() {
    sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/'/\\\\(aq/g" |
        awk '{
            at = match($0, /  +/)
            name = at ? substr($0, 1, at - 1) : $0; words = at ? substr($0, at + RLENGTH) : ""
            gsub(/  +/, ", ", words)
            print ".TP\n.B " name "\n" words
        }' | sed '/^$/d'
}
# Break long lines of text; never in front of a word that would look like a request.
wrap() {
    awk '/^\.EX/ { example = 1 } /^\.EE/ { example = 0 }
        example || /^\./ || length($0) <= 80 { print; next }
        {
            line = $1
            for (i = 2; i <= NF; i++)
                if (length(line) + 1 + length($i) > 80 && $i !~ /^[.\047]/) { print line; line = $i } else line = line " " $i
            print line
        }'
}
generate() { # COMMAND
    local program=${1%% *} arguments=${1#* }
    # shellcheck disable=SC2086
    case $arguments in
    --list*) "$build/$program" $arguments | terms ;;
    *) "$build/$program" $arguments ;;
    esac
}
fill() {
    local line
    while IFS= read -r line; do
        [ -z "$skipping" ] || [[ $line == '.\" end'* ]] || continue
        skipping=
        printf '%s\n' "$line"
        if [[ $line == '.\" begin: '* ]]; then
            generate "${line#'.\" begin: '}"
            skipping=1
        fi
    done
}
version=$("$build/beadreel" --version | head -n 1)
status=0
for page; do
    skipping=
    sed "s/^\(\.TH [^ ]* [0-9] [^ ]*\) \"[^\"]*\"/\1 \"$version\"/" "$page" | fill | wrap >"$new"
    if [ -z "$check" ]; then
        cat "$new" >"$page"
    else
        diff "$page" "$new" || { echo "${page##*/}: run 'make man'."; status=1; }
    fi
done
exit $status
