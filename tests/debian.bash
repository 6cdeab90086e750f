# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the scripts that make a Debian system of their own (fresh.sh, arm64.sh, packages.sh): as root, with mmdebstrap, in a temporary
# directory that goes when they end, in memory where there is plenty: packages of libraries unpack in three quarters of the time.
# MIRROR=URL names another mirror than the host's.
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
me=$(basename "$0" .sh)${suite:+ $suite}
say() { echo "$me: $*"; }
# Exit status 77: it cannot be tried here.
cannot() { say "$*" >&2; exit 77; }

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
    umount -l "$root" 2>/dev/null
    rm -rf --one-file-system "$root" "$root.log" "$root.apt"
}
in_memory() { # of what is free, a half
    local free
    free=$(awk '/^MemAvailable:/ {print int($2 / 1048576)}' /proc/meminfo)
    [ "$free" -ge 16 ] && mount -t tmpfs -o "mode=755,size=$((free / 2))g" tmpfs "$root"
}

# What the host needs to reach a mirror: its own mirror, its proxies.
find_mirror() {
    local proxy
    mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 2>/dev/null | grep -m 1 -E '/debian/?$')}
    mirror=${mirror:-http://deb.debian.org/debian}
    eval "$(apt-config shell http_set Acquire::http::Proxy https_set Acquire::https::Proxy)"
    export http_proxy=${http_proxy:-${http_set:-}} https_proxy=${https_proxy:-${https_set:-}}
    for proxy in http_proxy https_proxy; do
        case ${!proxy} in '' | DIRECT) unset $proxy ;; esac
    done
}

# make_root SUITE [OPTION of mmdebstrap]... : a minimal system in $root.
make_root() {
    local suite=$1
    shift
    [ "$(id -u)" = 0 ] || cannot "only root can do this"
    command -v mmdebstrap >/dev/null || cannot "mmdebstrap is not installed"
    unshare --mount-proc --pid --fork true 2>/dev/null || cannot "no name spaces to be had here"
    find_mirror
    root=$(mktemp -d "${TMPDIR:-/tmp}/beadreel-${me%% *}.XXXXXX") || exit 1
    chmod 755 "$root"
    trap clean_up EXIT
    in_memory 2>/dev/null
    trap 'exit 130' INT
    trap 'exit 143' TERM HUP
    say "minimal system from $mirror"
    # Its apt is told what the host's is.
    apt-config dump Acquire | grep -E '^Acquire::(Check|Retries|[a-z]+::(Proxy|Verify|Timeout))' >"$root.apt"
    echo 'Acquire::Languages "none";' >>"$root.apt"
    alone mmdebstrap --quiet --variant=minbase --skip=cleanup/apt/lists --aptopt="$root.apt" "$@" "$suite" "$root" "$mirror" >"$root.log" 2>&1 ||
        { tail -n 20 "$root.log"; say "mmdebstrap failed" >&2; exit 1; }
    mkdir -p "$root/etc/dpkg/dpkg.cfg.d"
    echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/temporary" # nothing here outlives a power cut
    cp /etc/resolv.conf /etc/hosts "$root/etc/"
}

# within COMMAND... : in the new system, with the host's devices; of the host's environment, what make is told by it.
within() {
    # shellcheck disable=SC2016
    alone bash -c '
        root=$1; shift
        mount -t proc proc "$root/proc" && mount --rbind /dev "$root/dev" || exit 1
        exec chroot "$root" env -i "$@"' - "$root" PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive ${CFLAGS:+CFLAGS="$CFLAGS"} ${FAST:+FAST="$FAST"} ${WERROR:+WERROR="$WERROR"} ${FILMS:+FILMS="$FILMS"} ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
        ${no_proxy:+no_proxy="$no_proxy"} "$@"
}
