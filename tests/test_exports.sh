#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the shared libraries export and need.
source "$(dirname "$0")/shell.bash"
only_bead() {
    nm -D --defined-only "$1" | awk '$2 ~ /[A-Z]/ {print $3}' | grep -vE '^(bead_|__asan_|__odr_asan|__gcov_|mangle_path$|_init$|_fini$)' >"$T/others"
    [ ! -s "$T/others" ] || { cat "$T/others"; return 1; }
    nm -D --defined-only "$1" | grep -q ' T bead_'
}
# Every function marked BEAD_API in a public header is there.
declared_are_there() {
    cat "$BUILD"/libbead{sim,reel}.so >/dev/null || return 1
    { nm -D --defined-only "$BUILD/libbeadsim.so"; nm -D --defined-only "$BUILD/libbeadreel.so"; } | awk '{print $3}' | sort -u >"$T/have"
    cat "$top"/include/beadreel/*.h | tr '\n' ' ' | grep -oE 'BEAD_API[^;]*;' | grep -oE 'bead_[a-z0-9_]+\(' | tr -d '(' | sort -u >"$T/want"
    comm -13 "$T/have" "$T/want" >"$T/missing"
    [ ! -s "$T/missing" ] || { cat "$T/missing"; return 1; }
}
# Neither more nor less than is listed: what is gone breaks programs, what comes is a promise. `make symbols` writes the lists anew.
promised() { awk '/^ / {sub("@Base", "", $1); print $1}' "$top/tests/reference/$1.symbols"; }
as_listed() {
    nm -D --defined-only "$BUILD/$1.so" | awk '$3 ~ /^bead_/ {print $3}' | sort >"$T/have"
    { promised "$1"; cat "$top/tests/reference/$1.internal"; } | sort | diff - "$T/have"
}
# What is promised is declared in a public header, and what is exported for the house alone is not.
declared_as_listed() {
    { promised libbeadsim; promised libbeadreel; } | sort | diff - <(sort "$T/want" | grep -v '^bead_view_infos$') | grep -v 'bead_view_infos$' | grep '^[<>]' && return 1
    ! cat "$top"/tests/reference/*.internal | grep -xFf - "$T/want"
}
no_graphics() { ! readelf -d "$1" | grep NEEDED | grep -iE 'osmesa|libgl|png|avcodec|avformat|avutil|swscale|cairo|pango|libx11'; }
no_hdf5() { ! readelf -d "$1" | grep NEEDED | grep hdf5; }
soname() { readelf -d "$1" | grep SONAME | grep -qF "[$2]"; }
# Processes that read strangers' files end themselves.
no_direct_exit() { ! nm -A "$1" | grep -vE ':(h5_apart|sandbox).o:.* _exit$' | grep -E ' U (exit|abort|_exit|printf|puts|putchar|perror)$'; }

# Functions whose last bit depends on the processor or on the C library's version: sim/base/wide.h and elementary.h have others. Powers
# are left to damping and power laws.
other_bits='exp2?|expm1|log2?|log1p|sin|cos|sincos|tan|a(sin|cos|tan)h?|atan2|sinh|cosh|tanh|hypot|fma|tgamma|lgamma|(exp|log|pow|sin|cos|sqrt|cbrt)l'
same_everywhere() {
    nm -D --undefined-only "$1" | grep -E " ($other_bits)(@|$)" || return 0
    echo "sim/base/elementary.h and wide.h have others; the calls are in:"
    nm -A "$BUILD"/sim/*/*.o | grep -E " U ($other_bits)$"
    return 1
}

ok "libbeadsim takes no function with different bits from the C library" same_everywhere "$BUILD/libbeadsim.so"
ok "libbeadsim.so exports bead_* only" only_bead "$BUILD/libbeadsim.so"
ok "libbeadreel.so exports bead_* only" only_bead "$BUILD/libbeadreel.so"
ok "every function of the public headers is exported" declared_are_there
ok "what is promised is what public headers declare" declared_as_listed
ok "libbeadsim.so exports what is listed" as_listed libbeadsim
ok "libbeadreel.so exports what is listed" as_listed libbeadreel
ok "libbeadsim.so needs no graphics" no_graphics "$BUILD/libbeadsim.so"
ok "beadsim needs no graphics" no_graphics "$BUILD/beadsim"
for part in beadsim beadreel libbeadsim.so libbeadreel.so; do ok "$part starts without HDF5" no_hdf5 "$BUILD/$part"; done
ok "soname of libbeadsim" soname "$BUILD/libbeadsim.so" libbeadsim.so.0
ok "soname of libbeadreel" soname "$BUILD/libbeadreel.so" libbeadreel.so.0
ok "libbeadsim neither exits nor prints" no_direct_exit "$BUILD/libbeadsim.a"
ok "libbeadreel neither exits nor prints" no_direct_exit "$BUILD/libbeadreel.a"
finish
