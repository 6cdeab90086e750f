#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The man pages: up to date with the programs, well-formed, their scenes and commands right.
source "$(dirname "$0")/shell.bash"
pages=("$top"/assets/man/*.[15])

ok "the generated parts are up to date" "$top/assets/man/make.sh" --check "$BUILD" "${pages[@]}"
stale() { # a page that lacks an option is found, and mended
    sed '/^\\fB\\-\\-plan/d' "$top/assets/man/beadreel.1" >"$T/beadreel.1"
    ! "$top/assets/man/make.sh" --check "$BUILD" "$T/beadreel.1" >"$T/out" && prints "run 'make man'" || return 1
    "$top/assets/man/make.sh" "$BUILD" "$T/beadreel.1" && cmp "$T/beadreel.1" "$top/assets/man/beadreel.1"
}
ok "a page that is not is found" stale
every_key() {
    "$beadreel" --list keys | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p' | sort -u | while read -r key; do
        grep -qx -- "\.B ${key//-/\\\\-}" "$top/assets/man/beadreel-scene.5" || { echo "$key"; return 1; }
    done
}
ok "beadreel-scene(5) has every key" every_key

for page in "${pages[@]}"; do
    name=$(basename "$page")
    if command -v mandoc >/dev/null; then
        ok "$name: mandoc has no complaint" bash -c "! mandoc -T lint '$page' | grep ."
        ok "$name: as HTML" bash -c "mandoc -T html '$page' | grep -q '<h1'"
    else
        skip mandoc "$name: mandoc has no complaint"
    fi
    if command -v man >/dev/null && command -v groff >/dev/null; then
        ok "$name: man has no complaint" bash -c "! LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z '$page' 2>&1 >/dev/null | grep ."
    else
        skip man-db "$name: man has no complaint"
    fi
done

# The examples, as a reader sees them: blocks of .EX.
examples() { sed -n '/^\.EX/,/^\.EE/p' "$1" | sed -e 's/\\-/-/g' -e "s/\\\\(aq/'/g" -e 's/\\e/\\/g'; }
scenes_plan() {
    local count=0 scene
    examples "$top/assets/man/beadreel-scene.5" | awk -v to="$T/scene" '/^\.EX/ {n++; next} /^\.EE/ {next} {print >(to n ".yaml")}'
    for scene in $(grep -l '^outputs:' "$T"/scene*.yaml); do
        "$beadreel" --plan "$scene" >/dev/null || { cat "$scene"; return 1; }
        count=$((count + 1))
    done
    [ $count -ge 3 ]
}
ok "the scenes of beadreel-scene(5) are right" scenes_plan
ok "no line ends with a blank" bash -c "! grep -n ' $' ${pages[*]@Q}"
finish
