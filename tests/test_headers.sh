#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every public header compiles alone, as C17 and as C++17 with all warnings, and can be included twice.
source "$(dirname "$0")/shell.bash"
cd "$top" || exit 1
flags="-std=c17 -Wall -Wextra -Wpedantic -Wstrict-prototypes -Werror -fsyntax-only -Iinclude $(pkg-config --cflags cairo)"
for header in include/beadreel/*.h; do
    name=${header#include/}
    printf '#include "%s"\n#include "%s"\nextern int not_empty;\n' "$name" "$name" >"$T/alone.c"
    # shellcheck disable=SC2086
    ok "$name compiles alone" ${CC:-cc} $flags "$T/alone.c"
done
flags="-std=c++17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -Iinclude $(pkg-config --cflags cairo)"
for header in include/beadreel/*.h; do
    name=${header#include/}
    printf '#include "%s"\n#include "%s"\n' "$name" "$name" >"$T/alone.cc"
    if command -v "${CXX:-g++}" >/dev/null; then
        # shellcheck disable=SC2086
        ok "$name compiles as C++" "${CXX:-g++}" $flags "$T/alone.cc"
    else
        skip "a C++ compiler (g++)" "$name compiles as C++"
    fi
done
finish
