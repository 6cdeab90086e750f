#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the shared libraries export, with the version that brought each function: tests/symbols.sh BUILD, or `make symbols`.
# Writes tests/reference/libbead*.symbols anew, as Debian's dpkg-gensymbols has them; what was there keeps its version. A function
# that is gone needs a new soname: see include/beadreel/api.h.
set -eu
build=$1
cd "$(dirname "$0")/.."
version=$(sed -n 's/^#define BEADREEL_VERSION "\(.*\)"/\1/p' include/beadreel/api.h)
for name in libbeadsim libbeadreel; do
    list=tests/reference/$name.symbols
    touch "$list"
    {
        echo "$(readelf -d "$build/$name.so" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p') ${name}0 #MINVER#"
        nm -D --defined-only "$build/$name.so" | awk -v version="$version" -v list="$list" '
            BEGIN { while ((getline line <list) > 0) { split(line, part, " "); known[part[1]] = part[2] } }
            $3 ~ /^bead_/ { name = $3 "@Base"; print " " name, (name in known ? known[name] : version) }' | LC_ALL=C sort
    } >"$list.new"
    mv "$list.new" "$list"
done
