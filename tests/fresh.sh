#!/bin/bash
# The README's two commands on a bare Debian of this checkout's HEAD: tests/fresh.sh SUITE (bookworm or trixie), or `make fresh`.
# As root, with debootstrap: makes a minimal system in a temporary directory, adds make, git and ca-certificates, clones the
# commit into it, runs the commands there and removes it all. It takes 3 GB and some minutes.
# MIRROR=URL names another Debian mirror than the host's. Exit status 0 passed, 1 failed, 77 it cannot be tried here.
set -u
cd "$(dirname "$0")/.." || exit 1
suites="bookworm trixie"
suite=${1:-}
say() { echo "fresh${suite:+ $suite}: $*"; }
cannot() { say "$*" >&2; exit 77; }
[[ -n $suite && " $suites " == *" $suite "* ]] || { say "the suite is one of: $suites" >&2; exit 1; }
mapfile -t commands < <(grep -xE 'make deps [a-z]+' README.md)
[ ${#commands[@]} -eq 2 ] || { say "README.md has ${#commands[@]} commands 'make deps ...', not 2" >&2; exit 1; }
[ "$(id -u)" = 0 ] || cannot "only root can do this"
command -v debootstrap >/dev/null || cannot "debootstrap is not installed"
unshare --mount-proc --pid --fork true 2>/dev/null || cannot "no name spaces to be had here"

# What the host needs to reach a mirror: its own mirror, its proxies, what its apt is told of them.
mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 2>/dev/null | grep -m 1 -E '/debian/?$')}
mirror=${mirror:-http://deb.debian.org/debian}
eval "$(apt-config shell http_set Acquire::http::Proxy https_set Acquire::https::Proxy)"
export http_proxy=${http_proxy:-${http_set:-}} https_proxy=${https_proxy:-${https_set:-}}
for proxy in http_proxy https_proxy; do
    case ${!proxy} in '' | DIRECT) unset $proxy ;; esac
done

root=$(mktemp -d "${TMPDIR:-/tmp}/beadreel-fresh.XXXXXX") || exit 1
chmod 755 "$root"
# Mounts and processes live in name spaces that end with them and with the script: nothing of the host is below $root here.
inside=
alone() {
    unshare --mount-proc --pid --fork --kill-child --propagation private "$@" </dev/null &
    inside=$!
    wait $inside
    local status=$?
    inside=
    return $status
}
clean_up() {
    if [ -n "$inside" ]; then kill -KILL "$inside" && wait "$inside"; fi 2>/dev/null
    rm -rf --one-file-system "$root" "$root.log"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# within COMMAND... : in the new system, with the host's devices; nothing of the host's environment.
within() {
    # shellcheck disable=SC2016
    alone bash -c '
        root=$1; shift
        mount -t proc proc "$root/proc" && mount --rbind /dev "$root/dev" || exit 1
        exec chroot "$root" env -i "$@"' - "$root" PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
        ${no_proxy:+no_proxy="$no_proxy"} "$@"
}

say "minimal system from $mirror"
alone debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$root.log" 2>&1 ||
    { tail -n 20 "$root.log"; say "debootstrap failed" >&2; exit 1; }
cp /etc/resolv.conf /etc/hosts "$root/etc/"
apt-config dump Acquire | grep -E '^Acquire::(Check|Retries|[a-z]+::(Proxy|Verify|Timeout))' >"$root/etc/apt/apt.conf.d/90host"
within apt-get -q update && within apt-get -q -y install --no-install-recommends make git ca-certificates ||
    { say "make, git and ca-certificates cannot be installed" >&2; exit 1; }
git clone -q --no-hardlinks . "$root/root/beadreel" || exit 1
[ -z "$(git status --porcelain)" ] || say "what is not committed is left out"
say "commit $(git -C "$root/root/beadreel" log -1 --format='%h %s')"

failed=0 report=()
for command in "${commands[@]}"; do
    say "$command"
    SECONDS=0
    within sh -c "cd /root/beadreel && $command"
    status=$?
    report+=("$command: $([ $status -eq 0 ] && echo passed || echo "FAILED with status $status") in $SECONDS s")
    [ $status -eq 0 ] || failed=1
done
for line in "${report[@]}"; do say "$line"; done
exit $failed
