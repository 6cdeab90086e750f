#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The files of a default build: their defences, and that they do not depend on where they are built.
source "$(dirname "$0")/shell.bash"
if nm "$BUILD/libbeadsim.a" 2>/dev/null | grep -qE '__(asan|tsan|gcov)_'; then
    skip "a build with the default flags" "defences of programs and libraries"
    finish
fi
has() { # PATTERN COMMAND...
    local pattern=$1
    shift
    "$@" 2>/dev/null >"$T/elf"
    grep -qE -- "$pattern" "$T/elf" || { head -n 5 "$T/elf"; return 1; }
}
for file in beadreel beadsim libbeadsim.so libbeadreel.so; do
    elf=$BUILD/$file
    ok "$file: its address is drawn at random" has 'Type: +DYN' readelf -hW "$elf"
    ok "... tables of the loader are read-only (RELRO)" has GNU_RELRO readelf -lW "$elf"
    ok "... and filled before it starts (BIND_NOW)" has 'BIND_NOW|Flags:.* NOW' readelf -dW "$elf"
    ok "... the stack cannot be run" has 'GNU_STACK.* RW ' readelf -lW "$elf"
    ok "... and has canaries" has '__stack_chk_fail' readelf -sW --dyn-syms "$elf"
    ok "... copies know the size of their target (FORTIFY)" has '__(mem|s|v?s[n]?)[a-z]*_chk' readelf -sW --dyn-syms "$elf"
done
# Debian 12's own start files lack the mark, and so have linked programs; each of our objects has it.
case $(uname -m) in
x86_64) mark='x86 feature: IBT, SHSTK' ;;
*) mark='AArch64 feature: BTI, PAC' ;;
esac
marked() { # ARCHIVE
    local objects
    objects=$(ar t "$1" | wc -l)
    [ "$objects" -gt 50 ] && [ "$(readelf -nW "$1" 2>/dev/null | grep -c "$mark")" -eq "$objects" ]
}
for library in libbeadsim libbeadreel; do ok "$library: every jump has its marked target ($mark)" marked "$BUILD/$library.a"; done
nowhere() { ! grep -lF -- "$top/" "$BUILD"/beadreel "$BUILD"/beadsim "$BUILD"/lib*.so "$BUILD"/lib*.a; }
ok "no file says where it was built" nowhere
ok "compiled in two directories, files are the same" "$top/tests/twice.sh" "$T/twice" sim/chain/law.o render/draw/axis.o render/paint/gl_osmesa.o
finish
