#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the shared libraries export, with the version that brought each function: tests/symbols.sh BUILD, or `make symbols`.
# Writes anew tests/reference/libbead*.symbols, the promises (BEAD_API), as Debian's dpkg-gensymbols has them, where what was there
# keeps its version; and libbead*.internal, what is exported for the other library and the programs alone (BEAD_INTERNAL). A promise
# that is gone needs a new soname: see include/beadreel/api.h.
set -eu
build=$1
cd "$(dirname "$0")/.."
version=$(sed -n 's/^#define BEADREEL_VERSION "\(.*\)"/\1/p' include/beadreel/api.h)
promised=$(cat include/beadreel/*.h | tr '\n' ' ' | grep -oE 'BEAD_API[^;]*;' | grep -oE 'bead_[a-z0-9_]+[([]' | tr -d '([')
for name in libbeadsim libbeadreel; do
    list=tests/reference/$name.symbols
    nm -D --defined-only "$build/$name.so" | awk '$3 ~ /^bead_/ {print $3}' | LC_ALL=C sort | grep -vxF "$promised" >"${list%symbols}internal" || true
    touch "$list"
    {
        echo "$(readelf -d "$build/$name.so" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p') ${name}0 #MINVER#"
        nm -D --defined-only "$build/$name.so" | awk -v version="$version" -v list="$list" -v internal="${list%symbols}internal" '
            BEGIN { while ((getline line <list) > 0) { split(line, part, " "); known[part[1]] = part[2] } }
            BEGIN { while ((getline line <internal) > 0) other[line] }
            $3 ~ /^bead_/ && !($3 in other) { name = $3 "@Base"; print " " name, (name in known ? known[name] : version) }' | LC_ALL=C sort
    } >"$list.new"
    mv "$list.new" "$list"
done
