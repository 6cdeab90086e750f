#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The Makefile: dependencies, a machine on which nothing is installed, installation.
source "$(dirname "$0")/shell.bash"
cd "$top" || exit 1
unset MAKEFLAGS MAKELEVEL MFLAGS WERROR
quiet() { run "$@"; [ "$status" -eq 0 ] || { tail -n 5 "$T/out" "$T/err"; return 1; }; }

# Stand-ins for a machine without packages: until apt-get has run, dpkg-query and pkg-config know nothing.
mkdir "$T/bin"
cat >"$T/bin/dpkg-query" <<SH
#!/bin/sh
[ -e "$T/installed" ] && printf 'install ok installed'
SH
cat >"$T/bin/pkg-config" <<SH
#!/bin/sh
[ -e "$T/installed" ] || exit 127
PATH=${PATH}
exec pkg-config "\$@"
SH
cat >"$T/bin/apt-get" <<SH
#!/bin/sh
echo "\$@" >>"$T/apt"
mkdir "$T/lock" || exit 100
sleep 0.5
case " \$* " in *" install "*) touch "$T/installed" ;; esac
rmdir "$T/lock"
SH
# Of packages that may be wanting, this release has OSMesa.
printf '#!/bin/sh\n[ "$*" != "madison libosmesa6" ] || echo found\n' >"$T/bin/apt-cache"
printf '#!/bin/sh\nexec "$@"\n' >"$T/bin/sudo"
printf '#!/bin/sh\necho "$@" >>"%s"\n' "$T/npm" >"$T/bin/npm"
chmod +x "$T"/bin/*
bare() { PATH="$T/bin:$PATH" quiet "$@"; }
bare_fails() { ! PATH="$T/bin:$PATH" make --no-print-directory "$@" >"$T/out" 2>"$T/err" && grep -q 'make deps' "$T/err"; }
object=$T/b/sim/chain/law.o

ok "make before make deps says what to do" bare_fails BUILD="$T/b" "$object"
ok "make deps all in one command" bare make -j4 BUILD="$T/b" deps "$object"
ok "... installed with apt-get" grep -q 'install .*libhdf5-dev' "$T/apt"
ok "... and what the release need not have, as it has it" grep -q 'install .*libosmesa6' "$T/apt"
ok "... and compiled afterwards" test -s "$object"
moved() { # ROOM: dependencies of the build name a source that has left it
    printf '%s: %s/left.c\n' "$object" "$1" >"$T/b/old.d"
    bare make --no-print-directory BUILD="$T/b" "$object" || return 1
    rm "$T/b/old.d"
}
for room in sim/chain render/draw tests tests/sim tests/film; do
    ok "an old build is brought up to date after a source has left $room" moved "$room"
done
mkdir -p "$T/b/tests"
printf 'tests/sim/test_strip.c:\n' >"$T/b/tests/test_strip.d"
in_its_room() { make -n BUILD="$T/b" "$T/b/tests/test_strip" >"$T/out" 2>"$T/err" && grep -q ' tests/render/test_strip\.c ' "$T/out"; }
ok "... and after a test has changed rooms" in_its_room
rm -rf "$T/apt" "$T/b/tests"
ok "make deps where all is there" bare make deps
ok "... installs nothing" test ! -e "$T/apt"
rm -f "$T/installed"
ok "make deps deps-ci: one apt-get at a time" bare make -j4 deps deps-ci
ok "... and from npm, without scripts of theirs" grep -q -e '--ignore-scripts' "$T/npm"
printf '#!/bin/sh\n' >"$T/bin/apt-cache"
rm -f "$T/installed" "$T/apt"
without_osmesa() { bare make deps && grep -q 'install .*libhdf5-dev' "$T/apt" && ! grep -q osmesa "$T/apt"; }
ok "make deps where the release has no OSMesa" without_osmesa
ok "make help lists the targets" bash -c "make help | grep -q '^  install '"
no_root() {
    rm -f "$T/installed" "$T/bin/sudo"
    printf '#!/bin/sh\necho 1000\n' >"$T/bin/id"
    chmod +x "$T/bin/id"
    mkdir "$T/few"
    for tool in sh bash make sed awk nproc find mkdir printf echo cat; do ln -s "$(command -v $tool)" "$T/few/$tool"; done
    ! PATH="$T/bin:$T/few" make deps >"$T/out" 2>"$T/err" && grep -q '^  apt-get .*install .*libhdf5-dev' "$T/err"
}
ok "make deps without root says what to run" no_root

ok "make fresh takes a suite of Debian" fails 1 "$top/tests/fresh.sh" potato
ok "... and names those it knows" says "bookworm trixie"

# A compiler that finds something odd stops developers, not users.
odd() { quiet make --no-print-directory BUILD="$T/odd" CPPFLAGS='-DODD=1 -DODD=2' "$@" "$T/odd/${object#"$T/b/"}"; }
strict() { ! odd WERROR=-Werror && grep -q 'ODD' "$T/err"; }
ok "warnings are errors with WERROR=-Werror" strict
ok "... and only then" odd

# Installed programs, used from elsewhere.
install_to() { quiet make --no-print-directory -o all BUILD="$BUILD" DESTDIR="$T/root" install; }
ok "make install" install_to
root=$T/root${PREFIX:-/usr/local}
relative() { [ "$(readlink "$root/lib/libbeadsim.so")" = libbeadsim.so.0 ] && [ -e "$root/lib/libbeadsim.so" ]; }
ok "library links are relative" relative
no_asset_env() (cd "$T" && env -u BEADREEL_ASSETS "$@")
ok "the installed program finds its scenes" no_asset_env "$root/bin/beadreel" --info clean-vs-delocalised
for page in man1/beadreel.1 man1/beadsim.1 man5/beadreel-scene.5; do
    ok "manual page $page" test -s "$root/share/man/$page"
done
# What pkg-config says of an installed library.
installed_flags() {
    PKG_CONFIG_PATH=$root/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR='' pkg-config --define-variable=prefix="$root" \
        --define-variable=libdir="$root/lib" --cflags --libs "$1"
}
compile_example() {
    # shellcheck disable=SC2046,SC2086
    ${CC:-cc} ${TEST_CFLAGS:-} -o "$T/minimal" "$top/tests/examples/minimal.c" $(installed_flags beadsim) -Wl,-rpath,"$root/lib"
}
sanitized() { nm "$BUILD/libbeadsim.a" 2>/dev/null | grep -q __asan_; }
sanitized && TEST_CFLAGS=-fsanitize=address,undefined
ok "a program compiles with the installed library" compile_example
cat >"$T/version.cc" <<'CPP'
// A C++ program with both libraries.
#include <beadreel/render.h>
#include <beadreel/session.h>
#include <cstdio>
#include <cstring>

int main()
{
    bead_job job;
    bead_session *session;
    bead_message msg;
    BEAD_DEFAULT(&job);
    if (bead_session_open(&job, &session, &msg) != BEAD_ERROR_USAGE || !std::strstr(msg.text, "no scene"))
        return 1;
    std::puts((*bead_render_sinks())->name);
    return std::strcmp(bead_version(), BEADREEL_VERSION);
}
CPP
compile_cpp() {
    # shellcheck disable=SC2046
    "${CXX:-g++}" ${TEST_CFLAGS:-} -o "$T/version" "$T/version.cc" $(installed_flags beadreel) -Wl,-rpath,"$root/lib" && "$T/version" | grep -qx image
}
if command -v "${CXX:-g++}" >/dev/null; then
    ok "a C++ program links with the installed libraries, and runs" compile_cpp
else
    skip "a C++ compiler (g++)" "a C++ program links with the installed libraries, and runs"
fi
cat >"$T/small.yaml" <<'YAML'
chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 5}]}
outputs: [{table: peaks.csv, show: peaks}]
YAML
ok "... and runs" bash -c "cd '$T' && BEADREEL_ASSETS='$root/share/beadreel' ./minimal small.yaml . | grep 'peak force'"
in_root() { quiet make --no-print-directory -o all BUILD="$BUILD" DESTDIR="$T/root" "$@"; }
ok "make install says that ldconfig may be needed" bash -c "
    make --no-print-directory -o all BUILD='$BUILD' PREFIX='$T/home' DESTDIR= install | grep -q 'ldconfig' && [ -x '$T/home/bin/beadreel' ]"
multiarch() {
    quiet make --no-print-directory -o all BUILD="$BUILD" PREFIX=/usr DESTDIR="$T/usr" install &&
        [ -e "$T/usr/usr/lib/$(${CC:-cc} -print-multiarch)/pkgconfig/beadsim.pc" ]
}
ok "... libraries of /usr lie where Debian has them" multiarch
ok "make install again" in_root install
ok "make uninstall" in_root uninstall
ok "... leaves no file and no directory" empty "$T/root"
ok "make uninstall where nothing is" in_root uninstall
relative() { # "$T/a place", as seen from here
    local to
    to=$(realpath -m --relative-to=. "$T/a place")
    for target in install uninstall; do
        quiet make --no-print-directory -o all BUILD="$BUILD" DESTDIR="$to" $target || return 1
        [ -x "$T/a place/usr/local/bin/beadreel" ] || [ $target = uninstall ] || return 1
    done
    empty "$T/a place"
}
ok "DESTDIR may be relative, and have spaces" relative
no_prefix() { ! make --no-print-directory -o all BUILD="$BUILD" DESTDIR="$T/none" PREFIX=usr install >"$T/out" 2>&1 && grep -q 'PREFIX must' "$T/out" && [ ! -e "$T/none" ]; }
ok "... PREFIX may not" no_prefix
kept() { # what was there before, and what others put there
    mkdir -p "$root/bin" && touch "$T/root/etc" && in_root install || return 1
    touch "$root/share/man/man1/other.1" && in_root uninstall || return 1
    [ "$(cd "$T/root" && find . -mindepth 1 | sort | tr '\n' ' ')" = "$(cd "$T/root" &&
        printf '%s\n' ./etc "${root#"$T/root"}"{/bin,/share/man/man1/other.1} | sed 's,^/,./,' |
        while read -r n; do while [ "$n" != . ]; do echo "$n"; n=$(dirname "$n"); done; done | sort -u | tr '\n' ' ')" ]
}
ok "... leaves what is not its own" kept

# The archive of the sources: all that git has, and it builds.
dist_is_whole() {
    quiet make --no-print-directory BUILD="$T/dist" dist && mkdir "$T/sources" && tar xf "$T"/dist/beadreel-*.tar.gz -C "$T/sources" || return 1
    (cd "$T"/sources/beadreel-* && find . -type f -o -type l | sed 's,^\./,,' | LC_ALL=C sort) | diff - <(git ls-tree -r --name-only HEAD | LC_ALL=C sort)
}
if git rev-parse -q --verify HEAD >/dev/null 2>&1; then
    ok "make dist has every file" dist_is_whole
    ok "... sums that fit" bash -c "cd '$T/dist' && [ \$(wc -l <SHA256SUMS) = 2 ] && sha256sum --quiet -c SHA256SUMS"
    cat >"$T/sbom.py" <<'PY'
# SPDX 2.3: what is listed is what is in the archive; its sums add up; every relationship has two ends.
import glob, hashlib, json, sys, tarfile
archive = glob.glob(sys.argv[1] + "/*.tar.gz")[0]
bom = json.load(open(archive.replace(".tar.gz", ".spdx.json")))
assert (bom["spdxVersion"], bom["dataLicense"]) == ("SPDX-2.3", "CC0-1.0")
package, sha1 = bom["packages"][0], sorted(f["checksums"][0]["checksumValue"] for f in bom["files"])
assert package["packageVerificationCode"]["packageVerificationCodeValue"] == hashlib.sha1("".join(sha1).encode()).hexdigest()
assert package["checksums"][0]["checksumValue"] == hashlib.sha256(open(archive, "rb").read()).hexdigest()
tar = tarfile.open(archive)
there = {"./" + m.name.split("/", 1)[1]: hashlib.sha256(tar.extractfile(m).read()).hexdigest() for m in tar if m.isfile()}
assert there == {f["fileName"]: f["checksums"][1]["checksumValue"] for f in bom["files"]}
terms = {f["fileName"]: f["licenseConcluded"] for f in bom["files"]}
assert terms["./assets/colormaps/batlow.txt"] == "MIT" and terms["./assets/colormaps/viridis.txt"] == "CC0-1.0" and terms["./LICENSE"] == "GPL-3.0-or-later"
ids = [x["SPDXID"] for x in bom["packages"] + bom["files"]] + ["SPDXRef-DOCUMENT"]
assert len(set(ids)) == len(ids) and all({r["spdxElementId"], r["relatedSpdxElement"]} <= set(ids) for r in bom["relationships"])
assert sum(r["relationshipType"] == "DEPENDS_ON" for r in bom["relationships"]) > 10
PY
    ok "... and a list of what is in it" python3 "$T/sbom.py" "$T/dist"
    again() { cp "$T/dist/SHA256SUMS" "$T/sums" && quiet make --no-print-directory BUILD="$T/dist" dist && cmp "$T/sums" "$T/dist/SHA256SUMS"; }
    ok "make dist again: the same bytes" again
    ok "... which compile" bash -c "cd '$T'/sources/beadreel-* && make --no-print-directory BUILD=b b/sim/chain/law.o"
else
    skip "a git checkout" "make dist has every file"
fi

# Packages are built in a folder of the build, and hold a folder called vendor_completions.d.
packages_are_no_matter() { mkdir -p "$T/b/deb/x/vendor_completions.d" && quiet make --no-print-directory BUILD="$T/b" "$object"; }
ok "make while packages are built" packages_are_no_matter

# debian/ says again what the Makefile and the headers have.
variable() { make -pn help 2>/dev/null | sed -n "s/^$1 = //p"; }
same_dependencies() {
    diff <(variable BUILD_DEPS | tr ' ' '\n' | grep -vxE '|gcc|libc6-dev' | sort) \
        <(sed -n '/^Build-Depends:/,/^[A-Z]/p' debian/control | grep -oE '^ (lib|fonts|pkg)[a-z0-9.-]+' | tr -d ' ' | sort)
}
ok "debian/control needs what BUILD_DEPS names" same_dependencies
ok "debian/changelog has the version" bash -c \
    "[ \"\$(sed -n '1s/.*(\(.*\)).*/\1/p' debian/changelog)\" = \"\$(sed -n 's/^#define BEADREEL_VERSION \"\(.*\)\"/\1/p' include/beadreel/api.h)\" ]"
release_is_checked() { # a tag of another version is found; and nothing of the version is amiss
    ! make release-check TAG=v9.9 >"$T/out" 2>&1 && prints "the tag is v9.9" && ! grep 'another version' "$T/out"
}
ok "make release-check" release_is_checked
finish
