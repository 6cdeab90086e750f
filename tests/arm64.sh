#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The results on arm64 have the bits of x86-64: tests/arm64.sh PACKAGE..., or `make arm64-test`, which names what the build needs.
# Makes a minimal Debian 12 for arm64 with these packages (see debian.bash), compiles for it with the cross compiler, and runs every
# ready scene in QEMU: their hashes are those of tests/reference/bits.txt, made on x86-64. It ends with `N of M hashes are equal`.
# Exit status 0 all are equal, 1 not, 77 it cannot be tried here.
set -u
unset MAKEFLAGS MAKELEVEL MFLAGS
suite=bookworm
source "$(dirname "$0")/debian.bash"
reference=tests/reference/bits.txt
for command in aarch64-linux-gnu-gcc:gcc-aarch64-linux-gnu qemu-aarch64-static:qemu-user-static; do
    command -v "${command%:*}" >/dev/null || cannot "${command#*:} is not installed: run 'make deps-arm64' first"
done

# The packages are unpacked, but not set up: nothing runs in there. Links are made to lead to what they mean seen from outside.
packages=("$@")
make_root "$suite" --variant=extract --arch=arm64 --aptopt='APT::Install-Recommends false' --include="$(IFS=,; echo "${packages[*]}")"
find "$root/usr" -type l -lname '/*' -printf '%l %p\n' | while read -r to at; do ln -sfn "$root$to" "$at"; done

say "compiling"
libraries=$root/usr/lib/aarch64-linux-gnu build=$root/build
PKG_CONFIG_SYSROOT_DIR=$root PKG_CONFIG_PATH='' PKG_CONFIG_LIBDIR=$libraries/pkgconfig:$root/usr/share/pkgconfig \
    nice make -s BUILD="$build" CC="aarch64-linux-gnu-gcc --sysroot=$root" all "$build/tests/examples/states" >/dev/null ||
    { say "it does not compile" >&2; exit 1; }

say "every ready scene, in QEMU"
EMULATOR="nice qemu-aarch64-static -L $root" tests/bits.sh "$build" >"$root/bits.txt"
diff "$reference" "$root/bits.txt"
equal=$(comm -12 <(grep -v '^#' "$reference" | sort) <(sort "$root/bits.txt") | wc -l) all=$(grep -vc '^#' "$reference")
say "$equal of $all hashes are equal"
[ "$equal" -eq "$all" ]
