#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The README's two commands on a bare Debian of this checkout's HEAD: tests/fresh.sh SUITE [TEST...] (bookworm or trixie), or `make fresh`.
# Makes a minimal system (see debian.bash), adds make, git and ca-certificates, clones the commit into it, runs the commands there
# and removes it all. It takes 3 GB and some minutes. With tests named, only these are built and run, and the demo's film is small.
# Exit status 0 passed, 1 failed, 77 it cannot be tried here.
set -u
suites="bookworm trixie"
suite=${1:-}
source "$(dirname "$0")/debian.bash"
[[ -n $suite && " $suites " == *" $suite "* ]] || { say "the suite is one of: $suites" >&2; exit 1; }
mapfile -t commands < <(grep -xE 'make deps [a-z]+' README.md)
[ ${#commands[@]} -eq 2 ] || { say "README.md has ${#commands[@]} commands 'make deps ...', not 2" >&2; exit 1; }
make_root "$suite" --include=make,git,ca-certificates
git clone -q --no-hardlinks . "$root/root/beadreel" || exit 1
[ -z "$(git status --porcelain)" ] || say "what is not committed is left out"
say "commit $(git -C "$root/root/beadreel" log -1 --format='%h %s')"

programs=()
for test in "${@:2}"; do if compgen -G "tests/*/$test.c" >/dev/null; then programs+=("build/tests/$test"); fi; done
failed=0 report=()
for command in "${commands[@]}"; do
    if [ $# -gt 1 ]; then
        case $command in
        "make deps demo") command+=" DEMO_SETTINGS='--set outputs.waves.mp4.size=[320,180] --set outputs.waves.mp4.duration=2s'" ;;
        "make deps test") command="make deps all ${programs[*]} && tests/run.sh build ${*:2}" ;;
        esac
    fi
    say "$command"
    SECONDS=0
    within sh -c "cd /root/beadreel && $command"
    status=$?
    report+=("$command: $([ $status -eq 0 ] && echo passed || echo "FAILED with status $status") in $SECONDS s")
    [ $status -eq 0 ] || failed=1
done
for line in "${report[@]}"; do say "$line"; done
exit $failed
