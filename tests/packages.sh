#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages: tests/packages.sh DIRECTORY [SUITE], or `make deb-test`. Asks lintian of those in the directory, which are for the
# host's release; installs them on a bare system of it (see debian.bash), uses them there as a plain user, and removes them. Minutes.
# With a suite (bookworm or trixie), the packages of HEAD are first built on a system of that, into the directory.
# Ends with `N passed, M failed`; exit status 77: it cannot be tried here.
set -u
directory=$(realpath "$1") || exit 1
suite=${2:-$(. /etc/os-release && echo "${VERSION_CODENAME:-}")}
source "$(dirname "$0")/debian.bash"
command -v lintian >/dev/null || cannot "lintian is not installed: run 'make deps-ci' first"
passed=0 failed=0
check() { # WHAT COMMAND...
    local what=$1
    shift
    if "$@"; then passed=$((passed + 1)) && say "ok: $what"; else failed=$((failed + 1)) && say "FAILED: $what"; fi
}
finish() { echo "$passed passed, $failed failed"; exit $((failed > 0)); }

add() { within apt-get -q -y install --no-install-recommends "$@" >"$root.log" 2>&1 || { tail -n 20 "$root.log"; return 1; }; }
build_packages() {
    mkdir -p "$root/made/beadreel" && git archive HEAD | tar -x -C "$root/made/beadreel" && add build-essential &&
        within sh -c 'cd /made/beadreel && apt-get -q -y build-dep --no-install-recommends ./ && dpkg-buildpackage -us -uc' \
            >"$root.log" 2>&1 || { tail -n 20 "$root.log"; return 1; }
    rm -rf "$directory" && mkdir -p "$directory" && find "$root/made" -maxdepth 1 -type f -exec cp {} "$directory" \;
}
if [ $# -gt 1 ]; then
    make_root "$suite"
    check "packages are built" build_packages
    clean_up
    [ "$failed" -eq 0 ] || finish
fi

# Without what only warns, and reads all texts for it: a quarter of the time.
without=files/unicode/trojan,files/contents/line-length,languages/python/distutils,binaries/spelling
check "lintian has no errors" lintian --allow-root --fail-on error --dont-check-part $without "$directory"/*.changes
packages="beadreel beadreel-data libbeadreel0 libbeadreel-dev python3-beadreel"
all_there() { diff <(for d in "$directory"/*.deb; do dpkg-deb -f "$d" Package; done | sort) <(printf '%s\n' $packages | sort); }
check "five packages" all_there

make_root "$suite"
mkdir "$root/deb" && cp "$directory"/*.deb tests/examples/minimal.c "$root/deb"
visitor() { within setpriv --reuid=visitor --regid=visitor --init-groups env HOME=/home/visitor sh -c "cd && $1"; }
within useradd --create-home visitor
# shellcheck disable=SC2046
check "beadreel and its data install" add $(cd "$root/deb" && printf '/deb/%s\n' beadreel_*.deb beadreel-data_*.deb)
check "the demo runs as a plain user" visitor "beadreel clean-vs-delocalised -o x --set 'outputs.waves.mp4.size=[320, 180]' --set 'outputs.waves.mp4.duration=2 s'"
for f in waves.mp4 figure.pdf force.png peaks.csv run.h5; do check "... and makes $f" test -s "$root/home/visitor/x/$f"; done
check "its manual is there" test -s "$root/usr/share/doc/beadreel/html/index.html"
# shellcheck disable=SC2046
check "the other packages install" add $(cd "$root/deb" && printf '/deb/%s\n' *.deb)
check "the Python module runs a scene" visitor \
    'python3 -c "import beadreel; assert beadreel.run(\"clean-vs-delocalised\", only=\"peaks.csv\").peaks[\"peak_force_N\"].max() > 80"'
check "a compiler installs" add gcc libc6-dev pkg-config
check "a program compiles with the libraries, and runs" visitor \
    'cc -o minimal /deb/minimal.c $(pkg-config --cflags --libs beadsim) && ./minimal /usr/share/beadreel/scenes/sensors.yaml out'
# shellcheck disable=SC2086
check "the packages go" within apt-get -qq -y purge $packages
check "... and leave nothing" test -z "$(find "$root/usr" -name '*beadreel*' ! -path '*/lintian/*' | head)"
finish
