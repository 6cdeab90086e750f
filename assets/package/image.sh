#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# An image for containers (OCI), made without a daemon: image.sh TARBALL LAYOUT VERSION makes the directory LAYOUT, whose image has the
# tag VERSION. In it: Debian's C and C++ run-time libraries, the tarball's folder below /opt, and nothing else. Needs root, mmdebstrap,
# umoci and a mirror of Debian. To use it: skopeo copy oci:LAYOUT:VERSION docker-daemon:beadreel:VERSION, or podman pull oci:LAYOUT:VERSION.
set -euo pipefail
cd "$(dirname "$0")/../.."
tarball=$1 layout=$2 version=$3
for program in mmdebstrap umoci; do command -v $program >/dev/null || { echo >&2 "$program is missing"; exit 1; }; done
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 0)}
suite=$(. /etc/os-release && echo "$VERSION_CODENAME") # the libraries of the tarball are of this release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mmdebstrap --quiet --variant=extract --include=base-files,base-passwd,libc6,libgcc-s1,libstdc++6 --aptopt='APT::Install-Recommends false' \
    "$suite" "$work/root"
rm -rf "$work"/root/var/{cache,lib/apt,log} "$work"/root/usr/share/{doc,man,locale,info}
mkdir -p "$work/root/opt/beadreel" "$work/root/work"
tar -xf "$tarball" -C "$work/root/opt/beadreel" --strip-components=1
mkdir -p "$work/root/usr/bin" && ln -s ../../opt/beadreel/bin/beadreel ../../opt/beadreel/bin/beadsim "$work/root/usr/bin"
find "$work/root" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
rm -rf "$layout"
umoci init --layout "$layout"
umoci new --image "$layout:$version"
umoci insert --image "$layout:$version" "$work/root" /
umoci config --image "$layout:$version" --config.entrypoint beadreel --config.cmd=--help --config.workingdir /work --config.user 1000:1000 \
    --config.env HOME=/work --config.label org.opencontainers.image.licenses=GPL-3.0-or-later
