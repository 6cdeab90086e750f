# SPDX-License-Identifier: GPL-3.0-or-later
# For shell tests: `source "$(dirname "$0")/../shell.bash"`. Prints TAP; everything is written below $T, which is removed.
set -u
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
BUILD=${BUILD:-$top/build}
export BEADREEL_ASSETS=${BEADREEL_ASSETS:-$top/assets}
beadreel=$BUILD/beadreel
beadsim=$BUILD/beadsim
T=$(mktemp -d "${TMPDIR:-/tmp}/beadreel.XXXXXX") || exit 1
# leave : a signal may meet a process of the background before it has become its program; that copy of the shell comes here, too.
leave() { case $BASHPID in "$$") rm -rf "$T" ;; esac; }
trap leave EXIT
export PYTHONDONTWRITEBYTECODE=1
# Debian's, which has Debian's packages, and starts sooner than what may stand before it in the PATH.
[ ! -x /usr/bin/python3 ] || python3() { /usr/bin/python3 "$@"; }
export XDG_CONFIG_HOME=$T/.config XDG_CONFIG_DIRS=/nowhere # not the settings of who runs the tests
tests=0 failures=0

# ok DESCRIPTION COMMAND... : passes where the command does.
ok() {
    local what=$1
    shift
    tests=$((tests + 1))
    if "$@" >"$T/.said" 2>&1; then
        echo "ok $tests - $what"
    else
        failures=$((failures + 1))
        echo "not ok $tests - $what"
        echo "# failed: $*"
        sed 's/^/#   /' "$T/.said" | head -10
    fi
}
# skip MISSING DESCRIPTION : a test left out, as this machine lacks a program or library; with its Debian package.
skip() {
    tests=$((tests + 1))
    echo "# missing: $1"
    echo "ok $tests - $2 # SKIP"
}
# run COMMAND... : leaves $status, $T/out and $T/err.
run() {
    "$@" >"$T/out" 2>"$T/err" </dev/null
    status=$?
}
# exits STATUS COMMAND...
exits() {
    local expected=$1
    shift
    run "$@"
    [ "$status" -eq "$expected" ] || { echo "status $status, not $expected"; cat "$T/err"; return 1; }
}
# fails STATUSES COMMAND... : one line on stderr but for progress, none on stdout, one of the statuses ("1 2").
fails() {
    local expected=" $1 " line lines said=0 progress='^[a-z].*: [0-9]+ %'
    shift
    run "$@"
    [[ "$expected" == *" $status "* ]] || { echo "status $status, not$expected"; cat "$T/out" "$T/err"; return 1; }
    mapfile -t lines <"$T/err"
    for line in "${lines[@]}"; do [[ $line =~ $progress ]] || said=$((said + 1)); done
    [ $said -eq 1 ] || { echo "stderr is not one line:"; cat "$T/err"; return 1; }
    [ ! -s "$T/out" ] || { echo "stdout is not empty:"; cat "$T/out"; return 1; }
}
# says TEXT : stderr of the last run has it.
says() {
    local line lines
    mapfile -t lines <"$T/err" # no program for a few lines: hundreds of tests ask this
    for line in "${lines[@]}"; do [[ $line != *"$1"* ]] || return 0; done
    echo "'$1' is not in:"
    cat "$T/err"
    return 1
}
prints() { grep -qF -- "$1" "$T/out" || { echo "'$1' is not in:"; cat "$T/out"; return 1; }; }
# relay [PREFIX] : the checks (TAP) that the last run printed become checks of this test.
relay() {
    local line missing="a part of it"
    while read -r line; do
        case $line in
        "# missing: "*) missing=${line#* missing: } ;;
        "ok "*" # SKIP") line=${line% # SKIP} && skip "$missing" "${1:-}${line#ok * - }" ;;
        "ok "*) ok "${1:-}${line#ok * - }" true ;;
        "not ok "*) ok "${1:-}${line#not ok * - }" false ;;
        "#"*) echo "$line" ;;
        esac
    done <"$T/out"
    ok "${1:-}the checks came to their end" eval 'grep -q "^1\.\." "$T/out" || { cat "$T/err"; false; }'
}
# find_browser : $browser is a Chromium that runs here.
find_browser() {
    browser=$(command -v chromium || command -v google-chrome) &&
        timeout 60 "$browser" --headless --no-sandbox --disable-gpu --dump-dom about:blank >/dev/null 2>&1
}
# await COMMAND... : until the command succeeds, at most a minute, or $patience seconds.
await() {
    local until=$((SECONDS + ${patience:-60}))
    until "$@" >/dev/null 2>&1; do
        [ $SECONDS -lt $until ] || { echo "waited in vain for: $*"; return 1; }
        sleep 0.02
    done
}
# empty DIRECTORY
empty() { ! compgen -G "$1/*" && ! compgen -G "$1/.[!.]*" || { ls -lA "$1"; return 1; }; }
# dimers CELLS : a scene whose `chain` can be continued: dimers under 20 N, whose bands end at 4710.94, 8102.20 and 9372.22 Hz.
dimers() { # CELLS
    cat <<YAML
materials:
  heavy: {modulus: 193 GPa, poisson: 0.3, mass: 28.84 g, radius: 9.53 mm}
  light: {modulus: 73.5 GPa, poisson: 0.33, mass: 9.75 g, radius: 9.53 mm}
chain:
  precompression: 20 N
  wall: rigid
  beads: [{cell: [heavy, light], count: $1}]
YAML
}
# plain_canvas : from here on without Mesa, whose start takes longer than small pictures.
plain_canvas() { mkdir -p "$XDG_CONFIG_HOME/beadreel" && echo 'canvas: plain' >"$XDG_CONFIG_HOME/beadreel/config.yaml"; }
# finish : the last command of a test.
finish() {
    echo "1..$tests"
    exit $((failures > 0))
}
