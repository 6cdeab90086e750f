#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Programs that run wherever they are put: bundle.sh BUILD FOLDER, which must not be there. Below it: bin, the libraries that they need
# (lib/beadreel), assets with fonts and manual pages (share), the Python module (lib/python). Of the system they use what every Linux
# has, as wheels may (manylinux): the C and C++ run-time libraries; and Mesa, where it is installed. Needs patchelf.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$1 folder=$2
command -v patchelf >/dev/null || { echo >&2 "patchelf is missing: run 'make deps-ci' first."; exit 1; }
[ ! -e "$folder" ] || { echo >&2 "$folder is there already"; exit 1; }
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)

make -s staged BUILD="$build" DESTDIR="$folder" PREFIX= LIBDIR=/lib PYTHONDIR=/lib/python ZSHDIR=/share/zsh/site-functions
rm -rf "$folder/include" "$folder/lib/pkgconfig" "$folder"/lib/*.a "$folder"/lib/*.so*

# The files of the libraries that the programs open by name; Mesa belongs to the system.
opened() {
    "$build/beadreel" --list libraries | sed -n 's/^\(lib\(av\|hdf5\)[^ ]*\) .*/\1/p' | while read -r name; do
        /sbin/ldconfig -p | sed -n "s|^\t$name (.*) => ||p" | head -n 1
    done
}
# name and file of all that these need
needed() { ldd "$@" | sed -n 's/^\t\(lib[^ ]*\) => \(\/[^ ]*\) .*/\1 \2/p' | sort -u; }
of_every_linux() { grep -vE '^lib(c|m|dl|rt|pthread|resolv|util|gcc_s|stdc\+\+)\.so\.'; }

mapfile -t libraries < <(opened)
[ ${#libraries[@]} -ge 5 ] || { echo >&2 "HDF5 and FFmpeg are not all installed"; exit 1; }
to=$folder/lib/beadreel
mkdir -p "$to"
for file in "${libraries[@]}"; do echo "${file##*/} $file"; done | cat - <(needed "$folder"/bin/* "${libraries[@]}") | of_every_linux |
    sort -u >"$folder/.needed"
while read -r name file; do install -m 644 "$file" "$to/$name"; done <"$folder/.needed"
strip --strip-unneeded "$folder"/bin/* 2>/dev/null
patchelf --set-rpath '$ORIGIN/../lib/beadreel' "$folder"/bin/*
patchelf --set-rpath '$ORIGIN' "$to"/*

fonts=$folder/share/beadreel/fonts
install -D -m 644 assets/package/fonts.conf "$fonts/fonts.conf"
find /usr/share/fonts \( -name 'Lato-Regular.ttf' -o -name 'Lato-Bold.ttf' -o -name 'Lato-Italic.ttf' -o -name 'Lato-BoldItalic.ttf' \
    -o -name 'STIX-*.otf' -o -name STIXMath-Regular.otf \) | tee "$folder/.fonts" | xargs -I{} cp {} "$fonts"
[ "$(find "$fonts" -name '*.?tf' | wc -l)" -ge 8 ] || { echo >&2 "fonts-lato and fonts-stix are not both installed"; exit 1; }

# The licences of all that, as Debian has them.
licences=$folder/share/doc/beadreel
install -D -m 644 LICENSE "$licences/LICENSE"
if command -v dpkg-query >/dev/null; then
    # Packages have files below /lib or /usr/lib, and not the links of alternatives.
    sed 's/.* //' "$folder/.needed" "$folder/.fonts" | xargs realpath | sed 's,^\(/usr\)\?\(.*\),/usr\2\n\2,' | { xargs dpkg-query -S 2>/dev/null || true; } |
        sed 's/:.*//' | tr -d ' ' | tr , '\n' | sort -u | while read -r package; do
        [ ! -r "/usr/share/doc/$package/copyright" ] || install -D -m 644 "/usr/share/doc/$package/copyright" "$licences/licences/$package"
    done
fi
rm "$folder/.needed" "$folder/.fonts"
