#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The wheel, in an environment in which there is nothing else: it brings what it needs, and runs scenes.
source "$(dirname "$0")/../shell.bash"
python=/usr/bin/python3
for need in "python3-pip:$python -m pip --version" "python3-venv:$python -m venv -h" "patchelf:command -v patchelf"; do
    ${need#*:} >/dev/null 2>&1 || { skip "${need%%:*}" "the wheel"; finish; }
done
unset MAKEFLAGS MAKELEVEL MFLAGS PYTHONPATH BEADREEL BEADREEL_ASSETS

ok "pip makes a wheel of the source tree" exits 0 env BUILD="$BUILD" "$python" -m pip wheel -q --no-index --no-deps \
    --config-settings level=0 --wheel-dir "$T" "$top"
wheel=$(ls "$T"/*.whl)
uncompressed() { "$python" -c 'import sys, zipfile; assert all(i.compress_size >= i.file_size for i in zipfile.ZipFile(sys.argv[1]).infolist())' "$wheel"; }
ok "... compressed as much as asked: not at all" uncompressed
sources() {
    "$python" -c "import sys; sys.path.insert(0, '$top/assets/package'); import wheel; print(wheel.build_sdist('$T'))" >"$T/out" &&
        tar -tf "$T/$(cat "$T/out")" | grep -q '/PKG-INFO$'
}
if git -C "$top" rev-parse -q --verify HEAD >/dev/null 2>&1; then ok "... and a source distribution" sources; else skip "a git checkout" "... and a source distribution"; fi
ok "an environment" "$python" -m venv --without-pip "$T/venv"
ok "... in which it installs" exits 0 "$python" -m pip --python "$T/venv/bin/python" install -q --no-index --no-deps "$wheel"
bare() { (cd "$T" && env -i HOME="$T" LANG=C.UTF-8 PATH="$T/venv/bin:/usr/bin:/bin" "$@"); }

# What wheels may ask of a system: PEP 600.
allowed='^(lib(c|m|dl|rt|pthread|resolv|util|gcc_s|stdc\+\+)\.so\..*|ld-linux-[^ ]*)$'
manylinux() {
    local file name bad=0
    for file in "$T"/venv/bin/bead* "$T"/venv/lib/beadreel/*; do
        readelf -d "$file" >"$T/dynamic" || return 1
        grep -q 'R\(UN\)\?PATH.*\[$ORIGIN' "$T/dynamic" || { echo "$file: no \$ORIGIN"; bad=1; }
        while read -r name; do
            [ -e "$T/venv/lib/beadreel/$name" ] || [[ $name =~ $allowed ]] || { echo "$file needs $name"; bad=1; }
        done < <(sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' "$T/dynamic")
    done
    return $bad
}
ok "all that programs and libraries need is in the wheel or in every Linux" manylinux
newest() { readelf -VW "$T"/venv/bin/bead* "$T"/venv/lib/beadreel/* | grep -o 'Name: GLIBC_2\.[0-9]*' | sed 's/.*\.//' | sort -n | tail -n 1; }
ok "... of the version that its name promises" eval '[[ $wheel == *-manylinux_2_$(newest)_$(uname -m).whl ]]'
opened() { # each library that the program opens by name comes from the environment
    bare env LD_DEBUG=files LD_DEBUG_OUTPUT="$T/opened" beadreel clean-vs-delocalised -o "$T/demo" --canvas plain --set 'outputs=[{movie: a.mp4,
        duration: 0.1 s, size: [320, 240]}, {image: a.png}, {trajectory: a.h5, every: 100 us}]' || return 1
    grep -q "calling init: $T/venv/.*/libavcodec" "$T"/opened.* || return 1
    ! cat "$T"/opened.* | sed -n 's/.*calling init: //p' | grep -v "^$T/venv" | grep -vE '/(lib(c|m|dl|rt|pthread|resolv|util|gcc_s|stdc\+\+)\.so|ld-linux)'
}
ok "a film, an image and a trajectory with these libraries alone" opened
cat >"$T/try.py" <<'PY'
import beadreel
run = beadreel.run("clean-vs-delocalised", only=["figure.pdf", "force.png", "run.h5"])
assert run.outputs["force.png"].read_bytes()[:4] == b"\x89PNG" and run.outputs["run.h5"].stat().st_size > 100000
print(__import__("beadreel._program")._program.program())
PY
ok "the Python module runs the demo" exits 0 bare python try.py
ok "... with the program of the environment" prints "$T/venv/bin/beadreel"
same_picture() { # its fonts are those of the system that it was made on
    local what='outputs=[{image: b.png, size: [640, 360]}]'
    BEADREEL_ASSETS=$top/assets "$beadreel" clean-vs-delocalised -o "$T/here" --set "$what" && bare beadreel clean-vs-delocalised -o "$T/there" --set "$what" &&
        cmp "$T/here/b.png" "$T/there/b.png"
}
ok "pictures are those of the source tree" same_picture
ok "pip removes it" exits 0 "$python" -m pip --python "$T/venv/bin/python" uninstall -q -y beadreel
ok "... whole" eval '[ -z "$(find "$T/venv" -name "*beadreel*" -not -type d)" ]'
finish
