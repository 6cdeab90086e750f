#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The examples of the libraries, compiled with what is installed and nothing else; each against a number known from elsewhere.
source "$(dirname "$0")/shell.bash"
cd "$top" || exit 1
unset MAKEFLAGS MAKELEVEL MFLAGS WERROR
install_to() { run make --no-print-directory -o all BUILD="$BUILD" DESTDIR="$T/root" install; [ "$status" -eq 0 ]; }
ok "make install" install_to
root=$T/root${PREFIX:-/usr/local}
export BEADREEL_ASSETS=$root/share/beadreel
nm "$BUILD/libbeadsim.a" 2>/dev/null | grep -q __asan_ && TEST_CFLAGS=-fsanitize=address,undefined
installed_flags() { # LIBRARY PACKAGE...: what pkg-config says
    PKG_CONFIG_PATH=$root/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR='' pkg-config --define-variable=prefix="$root" \
        --define-variable=libdir="$root/lib" --cflags --libs "$1"
    [ $# -eq 1 ] || pkg-config --cflags --libs "${@:2}"
}
compile() { # NAME LIBRARY PACKAGE...
    # shellcheck disable=SC2046,SC2086
    (cd "$T" && ${CC:-cc} -std=c17 -Wall -Wextra -Wpedantic -Werror ${TEST_CFLAGS:-} -o "$1" "$top/tests/examples/$1.c" $(installed_flags "${@:2}") -lm \
        -Wl,-rpath,"$root/lib")
}
compute() { awk "$@" "$T/out" || { cat "$T/out"; return 1; }; }

ok "chain.c compiles" compile chain beadsim
ok "... runs" exits 0 "$T/chain"
# 272.3646 F^(1/6) m/s of these beads, after Nesterenko's equation with the exact constant; F is the peak of the contacts' forces.
speed() { compute '$1 == "contact" {force[$2 + 0] = $3; time[$2 + 0] = 1e-6 * $6}
    END {ratio = 4 * 2 * 4.76e-3 / (time[16] - time[12]) / (272.3646 * force[14] ^ (1 / 6)); exit !(ratio > 1 - 1e-4 && ratio < 1 + 1e-4)}'; }
ok "... the speed of the solitary wave follows from its peak force" speed
ok "... and the samples miss little of the largest peak" compute '/^contact  0/ {peak = $3} /^largest/ {seen = $5} END {exit !(seen <= peak && seen > 0.999 * peak)}'
only_there() { (mkdir "$T/empty" && cd "$T/empty" && "$T/chain" >"$T/out" && empty .); }
ok "... no file is written" only_there

ok "law.c compiles" compile law beadsim
ok "... runs" exits 0 "$T/law"
# A soliton of Toda's lattice whose largest force is sinh(k)^2 goes sinh(k) / k masses in a unit of time (Toda 1967).
soliton() { compute -v how="$1:" '$1 == how {force = $4; time[n++] = $7}
    END {s = sqrt(force); ratio = 20 / (time[1] - time[0]) / (s / log(s + sqrt(1 + force))); exit !(ratio > 1 - 1e-7 && ratio < 1 + 1e-7)}'; }
ok "... a chain made in C with a law of one's own has its solitons" soliton made
ok "... and so has a scene that calls the law by its name" soliton scene

cat >"$T/film.yaml" <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 40}]}
outputs:
- {movie: a.mp4, views: [beads, moving], size: [320, 240], fps: 10, duration: 1 s}
- {image: a.png, views: [moving, spacetime], size: [320, 240]}
- {momentum: a.txt, every: 10 us}
YAML
ok "film.c compiles" compile film beadreel cairo
ok "... runs" exits 0 "$T/film" "$T/film.yaml" "$T/film.d"
ok "... its results have names of their own" prints "momentum $T/film.d/a.txt: "
ok "... with the frames asked for" prints "movie $T/film.d/a.mp4: 10 items"
# Nothing is lost before the wave has reached the end; and of a solitary wave of spheres 5/9 of the energy moves (virial theorem).
momentum() { awk '$1 > 2e-4 && $1 < 6e-4 {n++; if (($2 / (0.4 * 3.63e-3) - 1) ^ 2 > 1e-16) exit bad = 1; sum += $3}
    END {exit bad || n < 30 || (sum / n / (5 / 9) - 1) ^ 2 > 1e-4}' "$1"; }
ok "... the momentum is that of the striker, and the share that moves 5/9" momentum "$T/film.d/a.txt"
ok "... -o FILE finds a sink of one's own by the ending" exits 0 "$T/film" "$T/film.yaml" "$T/other.txt"
ok "... and makes nothing else" diff "$T/film.d/a.txt" "$T/other.txt"
ok "... without the scene asking" exits 0 "$T/film" teaching "$T/teaching.txt"
ok "the programs know neither" exits 2 "$BUILD/beadreel" "$T/film.yaml"
finish
