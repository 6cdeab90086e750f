#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Archives for other machines, where nothing else is: the demo runs there, and all its files come.
#   tests/bare.sh tarball FILE SUITE       (make tarball) on a minimal Debian (bookworm, trixie) or Ubuntu (noble)
#   tests/bare.sh image LAYOUT VERSION     (make image) unpacked by umoci, in a chroot
# As root, with mmdebstrap or umoci. Ends with `N passed, M failed`; exit status 77: it cannot be tried here.
set -u
kind=$1 file=$(realpath "$2") suite=$3
source "$(dirname "$0")/debian.bash"
passed=0 failed=0
check() { # WHAT COMMAND...
    local what=$1
    shift
    if "$@" >"$root.said" 2>&1; then passed=$((passed + 1)) && say "ok: $what"; else failed=$((failed + 1)) && say "FAILED: $what" && tail -n 5 "$root.said"; fi
}
case $kind in
tarball)
    # Debian has no keys of Ubuntu's to look its packages up by.
    [ "$suite" != noble ] || MIRROR="deb [trusted=yes] ${MIRROR:-http://archive.ubuntu.com/ubuntu} noble main"
    make_root "$suite" --include=apt # every one has it, and with it the library of C++, which the archive leaves to the system
    mkdir -p "$root/some place" "$root/demo" && tar -xf "$file" -C "$root/some place" || exit 1
    program=/$(cd "$root" && echo "some place"/*/bin/beadreel)
    ;;
image)
    [ "$(id -u)" = 0 ] || cannot "only root can do this"
    command -v umoci >/dev/null || cannot "umoci is not installed"
    bundle=$(mktemp -d) root=$bundle/rootfs
    trap 'rm -rf "$bundle"' EXIT
    umoci unpack --image "$file:$suite" "$bundle" || exit 1
    program=/usr/bin/$(python3 -c 'import json, sys; print(*json.load(open(sys.argv[1]))["process"]["args"][:1])' "$bundle/config.json")
    mkdir -p "$root/demo" "$root/proc" "$root/dev"
    check "the image has no compiler, no package manager, no shell" eval '! ls "$root"/usr/bin/{gcc,apt-get,dpkg} "$root"/bin/sh'
    ;;
esac
# As a container does: with /proc and /dev, and with no environment but this.
within() {
    # shellcheck disable=SC2016
    alone bash -c 'mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && exec env -i PATH=/usr/bin:/bin HOME=/demo LANG=C.UTF-8 /usr/sbin/chroot "$@"' \
        - "$root" "$program" "$@"
}
check "it says its version" within --version
check "the demo runs" within clean-vs-delocalised -o /demo --progress=none
for f in waves.mp4 figure.pdf force.png peaks.csv run.h5; do check "... and makes $f" test -s "$root/demo/$f"; done
check "a report, too" within teaching -o /demo/report.html --progress=none
check "the tables are those of the source tree" cmp "$root/demo/peaks.csv" <(BEADREEL_ASSETS=assets build/beadsim clean-vs-delocalised --only peaks.csv -o "$root/here" -q >/dev/null && cat "$root/here/peaks.csv")
rm -f "$root.said"
echo "$passed passed, $failed failed"
exit $((failed > 0))
