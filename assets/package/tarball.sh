#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The bundle of bundle.sh as an archive that runs wherever it is unpacked, and an SPDX list of what is in it: tarball.sh BUILD NAME makes
# BUILD/NAME.tar.gz and BUILD/NAME.spdx.json. The same bundle makes the same bytes.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$1 name=$2
unset MAKEFLAGS MAKELEVEL MFLAGS
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 0)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
assets/package/bundle.sh "$build" "$work/$name"
tar -C "$work" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --format=gnu -cf - "$name" | gzip -9n >"$build/$name.tar.gz"
# Packages of Debian whose files are in it, by their licences.
mapfile -t packages < <(cd "$work/$name/share/doc/beadreel/licences" 2>/dev/null && dpkg-query -W -f='${Package}=${Version}\n' -- * | sort -u)
assets/package/sbom.py "$build/$name.tar.gz" "${packages[@]}" >"$build/$name.spdx.json"
printf '%s\n' "$build/$name.tar.gz" "$build/$name.spdx.json"
