#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Torture the program: tests/torture/torture.sh BUILD KILLS ALLOCATIONS|all [PAIRS [PART...]]
# It is killed at random moments, run twice at once, starved of disk, file size, descriptors and memory, and sent every signal. What must
# hold: no file under a final name that is not whole; unfinished files can be read; exit statuses as documented; a failure says why in
# one line and leaves nothing unfinished. KILLS that hit; each of the ALLOCATIONS fails in a run of its own; PAIRS of runs at once for
# each kind of output. PART: kills, pairs, want, signals, allocations; all unless given. Ends with a table of counts and `N passed,
# M failed`. SEED=n: other moments.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$(realpath "$1") kills=$2 allocations=$3 pairs=${4:-5}
parts=("${@:5}")
[ ${#parts[@]} -gt 0 ] || parts=(kills pairs want signals allocations)
export BEADREEL_ASSETS=$PWD/assets
beadreel=$build/beadreel
T=$(mktemp -d "${TMPDIR:-/tmp}/beadreel-torture.XXXXXX") || exit 1
leave() {
    case $BASHPID in "$$") ;; *) return ;; esac # a copy of this shell that a signal met before it had become the program
    ! mountpoint -q "$T/disk" || umount "$T/disk"
    rm -rf "$T"
}
trap leave EXIT
mkdir "$T/tmp"
export TMPDIR=$T/tmp # nothing may stay there
RANDOM=${SEED:-1}
kinds=(trajectory sweep movie image table)
columns=(runs finished refused failed ended whole parts unreadable broken wrong)
declare -A count seconds
passed=0 failed=0

# ---- scenes: about .3 s each ----

chain='chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads:
    - {cell: [large-steel, aluminium], count: COUNT, spins: random, magnetism: 0.3, seed: 7}
    - {bead: small-steel, sensor: first}
simulate: {until: UNTIL}
outputs:'
scene() { # NAME COUNT UNTIL < outputs
    { sed "s/COUNT/$2/; s/UNTIL/$3/" <<<"$chain"; cat; } >"$T/$1.yaml"
}
scene trajectory 60 '4 ms' <<'YAML'
  - {trajectory: run.h5, every: 1 us, fields: [displacement, velocity, force]}
YAML
scene movie 3 '100 us' <<'YAML'
  - {movie: m.mp4, duration: 1 s, size: [160, 120], fps: 20, poster: poster.png}
  - {movie: m.gif, duration: 1 s, size: [160, 120], fps: 20}
YAML
scene image 30 '1 ms' <<'YAML'
  - {image: [force.png, force.pdf], size: [640, 400]}
  - {plot: sensors.svg, show: sensors}
YAML
scene table 60 '5 ms' <<'YAML'
  - {table: peaks.csv, show: peaks}
  - {table: sensors.csv, show: sensors}
YAML
scene every 3 '100 us' <<'YAML'
  - {trajectory: run.h5, every: 5 us, fields: all}
  - {image: [force.png, force.pdf], size: [320, 200]}
  - {plot: sensors.svg, show: sensors}
  - {movie: m.mp4, duration: 0.2 s, size: [160, 120], fps: 10, poster: poster.png, captions: [{at: 0, text: "*F*_{max}"}]}
  - {movie: m.gif, duration: 0.2 s, size: [160, 120], fps: 10}
  - {plot: setup.svg, show: setup}
  - {table: peaks.csv, show: peaks}
  - {table: m.csv, show: measures}
  - {report: run.html}
YAML
cat >"$T/few.yaml" <<'YAML'
sweep: {cells: 4, fixed: 2, magnetism: [0, 1], configurations: 2, measure: {decay: true, beads: [1, 2]}}
outputs:
  - {sweep: sweep.h5}
  - {table: sweep.csv}
  - {plot: sweep.png, size: [320, 200]}
  - {sheet: sheet.png}
  - {report: sweep.html}
YAML
cat >"$T/sweep.yaml" <<'YAML'
sweep: {cells: 32, magnetism: [0, 0.5, 1], configurations: 40}
outputs: [{sweep: sweep.h5}, {table: sweep.csv}, {plot: sweep.png, size: [320, 200]}]
YAML

# ---- judging ----

add() { count[$1,$2]=$((${count[$1,$2]:-0} + ${3:-1})); }
# fault WHAT COLUMN TEXT : what must not be.
fault() {
    add "$1" "$2"
    bad=1
    echo "FAULT: $1: ${3}" | head -c 600
    echo
    tail -n 3 "$T/err"
}
readable() { # unfinished file: --info says what it is, or that nothing can be known of it yet
    "$beadreel" --info "$1" >"$T/info" 2>&1 && return
    [ $? -eq 1 ] && grep -q 'unfinished file' "$T/info"
}
# Every file in a directory: whole, as in one of the references, or unfinished and readable.
judge_files() { # WHAT DIRECTORY REFERENCE...
    local what=$1 directory=$2 file name reference same
    shift 2
    for file in "$directory"/{*,.[!.]*}; do
        [ -e "$file" ] || continue
        name=${file##*/} same=
        for reference; do cmp -s "$file" "$reference/$name" && same=1; done
        if [ -n "$same" ]; then
            add "$what" whole
        elif [[ $name == *.part || $name == sweep.h5.new ]]; then # .new: a sweep's results, as its .part is the journal
            add "$what" parts
            case $name in *.h5.part) readable "$file" || fault "$what" unreadable "$name: $(head -n 1 "$T/info")" ;; esac
        else
            fault "$what" broken "$name ($(stat -c %s "$file") bytes) is not that of a whole run"
        fi
    done
}
judge_status() { # WHAT STATUS ALLOWED...
    local what=$1 status=$2
    shift 2
    [[ " $* " == *" $status "* ]] || fault "$what" wrong "status $status, not one of $*"
    case $status in 0) add "$what" finished ;; 1) add "$what" failed ;; 2) add "$what" refused ;; *) add "$what" ended ;; esac
    case $status in 1 | 2) [ "$(grep -cv '^Fontconfig' "$T/err")" -eq 1 ] || fault "$what" wrong "status $status with other than one line" ;; esac
}
# A failure leaves nothing unfinished, but for the sweep's journal, if there is a result in it; what was finished before stays, whole.
judge_left() { # WHAT STATUS DIRECTORY
    local left
    [ "$2" -ne 0 ] || return
    left=$(find "$3" "$T/tmp" -type f \( -name '*.part' -o -name '*.new' -o -path "$T/tmp/*" \) ! -name sweep.h5.part 2>/dev/null)
    [ -z "$left" ] || fault "$1" wrong "status $2 left ${left//$'\n'/ }"
    [ ! -e "$3/sweep.h5.part" ] || { "$beadreel" --info "$3/sweep.h5.part" | grep -qE '^[1-9][0-9]* of [0-9]+ chains are done'; } ||
        fault "$1" wrong "status $2 left an empty journal"
}
begin() { add "$1" runs; bad=0; : >"$T/err"; }
end() { if [ $bad -eq 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi; }
draw() { "$beadreel" "$T/$1.yaml" --canvas plain --threads 1 -o "$2" "${@:3}" >"$T/out" 2>"$T/err" </dev/null; }
# thousandths of a second, as seconds
pause() { sleep "$(($1 / 1000)).$(printf %03d $(($1 % 1000)))"; }

# The shortest of three: a machine may be busy.
for kind in "${kinds[@]}" every few; do
    for i in 1 2 3; do
        start=$(date +%s%3N)
        rm -rf "$T/whole-$kind"
        draw "$kind" "$T/whole-$kind" || { cat "$T/err"; echo "0 passed, 1 failed"; exit 1; }
        took=$(($(date +%s%3N) - start))
        [ $i -gt 1 ] && [ "${seconds[$kind]}" -le $took ] || seconds[$kind]=$took
    done
    printf '%-12s takes %d ms\n' "$kind" "${seconds[$kind]}"
done

# ---- kills ----

killed() { # KIND : into the directory left by the run before
    begin "kill: $1"
    "$beadreel" "$T/$1.yaml" --canvas plain --threads $((1 + RANDOM % 3)) -o "$T/kill-$1" >"$T/out" 2>"$T/err" </dev/null &
    local pid=$!
    pause $((RANDOM % (seconds[$1] * 11 / 10 + 1)))
    { kill -KILL $pid; wait $pid; } 2>/dev/null
    local status=$?
    hit=$((hit + (status == 137)))
    judge_status "kill: $1" $status 137 0
    judge_files "kill: $1" "$T/kill-$1" "$T/whole-$1"
    end
}
over_what_is_left() { # KIND
    begin "rerun: $1"
    draw "$1" "$T/kill-$1"
    judge_status "rerun: $1" $? 0
    diff -rq "$T/kill-$1" "$T/whole-$1" >"$T/info" || fault "rerun: $1" broken "$(cat "$T/info")"
    judge_files "rerun: $1" "$T/kill-$1" "$T/whole-$1"
    end
}
torture_kills() {
    # Runs that had ended before are none of the kills.
    for ((i = 0, hit = 0; hit < kills && i < 4 * kills; i++)); do
        kind=${kinds[i % ${#kinds[@]}]}
        killed "$kind"
        case $((RANDOM % 4)) in
        0) over_what_is_left "$kind" ;;
        1) rm -rf "$T/kill-$kind" ;;
        esac
    done
    for kind in "${kinds[@]}"; do over_what_is_left "$kind"; done
}

# ---- two at once ----

two() { # KIND : the second differs, so that it is known whose files are there
    local what="two runs: $1" first second
    rm -rf "$T/two"
    begin "$what"
    "$beadreel" "$T/$1.yaml" --canvas plain --threads 1 -o "$T/two" >"$T/out1" 2>"$T/err1" </dev/null &
    local pid=$!
    pause $((RANDOM % seconds[$1]))
    draw "$1" "$T/two" "${other[@]}"
    second=$?
    wait $pid
    first=$?
    judge_status "$what" $second 0 2
    [ $second -ne 2 ] || grep -q 'another run' "$T/err" || fault "$what" wrong "refused without saying why"
    mv "$T/err1" "$T/err"
    judge_status "$what" $first 0 2
    [ $first -ne 2 ] || grep -q 'another run' "$T/err" || fault "$what" wrong "refused without saying why"
    [ $first -eq 0 ] || [ $second -eq 0 ] || fault "$what" wrong "both are refused"
    judge_files "$what" "$T/two" "$T/whole-$1" "$T/other"
    ! ls "$T"/two/*.part >"$T/info" 2>&1 || fault "$what" wrong "left $(cat "$T/info")"
    end
}
torture_pairs() {
    for kind in "${kinds[@]}" every; do
        other=(--set title=other --set simulate.step='0.9 us')
        rm -rf "$T/other"
        draw "$kind" "$T/other" "${other[@]}" || { cat "$T/err"; failed=$((failed + 1)); continue; }
        for ((i = 0; i < pairs; i++)); do two "$kind"; done
    done
}

# ---- want of disk, file size, descriptors ----

starved() { # WHAT SCENE COMMAND... : status 0 or 1; with a limit set by COMMAND
    local what=$1 name=$2
    shift 2
    begin "$what"
    (eval "$1"; draw "$name" "$T/starved")
    local status=$?
    judge_status "$what" $status 0 1
    judge_files "$what" "$T/starved" "$T/whole-$name"
    judge_left "$what" $status "$T/starved"
    rm -rf "$T/starved"/* "$T/starved"
    end
}
torture_want() {
    for name in every sweep; do
        for limit in 1 2 4 8 16 32 64 128 256; do starved "file-size limit" $name "ulimit -f $limit"; done
        for limit in 4 5 6 7 8 9 10 12 14 16 20; do starved "descriptors" $name "ulimit -n $limit"; done
    done
    mkdir "$T/disk"
    ln -s disk/out "$T/starved" 2>/dev/null
    if [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o size=64k beadreel-torture "$T/disk" 2>/dev/null; then
        rm -f "$T/starved"
        on_disk() { # SCENE KIB
            begin "small disk"
            mount -o remount,size="$2"k "$T/disk" || return
            draw "$1" "$T/disk/out"
            local status=$?
            judge_status "small disk" $status 0 1
            judge_files "small disk" "$T/disk/out" "$T/whole-$1"
            judge_left "small disk" $status "$T/disk/out"
            rm -rf "$T/disk/out"
            end
        }
        for name in every sweep trajectory; do for size in 4 8 12 16 24 32 64 96 128 192 256 384 512; do on_disk $name $size; done; done
        umount "$T/disk"
    else
        rm -f "$T/starved"
        echo "small disks are skipped: no tmpfs can be mounted here"
    fi
}

# ---- signals ----

signalled() { # NUMBER KIND
    rm -rf "$T/signal"
    begin "signals"
    "$beadreel" "$T/$2.yaml" --canvas plain --threads 1 -o "$T/signal" >"$T/out" 2>"$T/err" </dev/null &
    local pid=$! expected="0 $((128 + $1))"
    pause $((seconds[$2] / 4 + RANDOM % (seconds[$2] / 2)))
    kill -s "$1" $pid 2>/dev/null
    case $1 in 17 | 18 | 23 | 28) expected=0 ;; 25) expected="0 1 153" ;; esac # ignored by default; the size limit's is a write error
    { wait $pid; } 2>/dev/null
    local status=$?
    judge_status "signals" $status $expected
    judge_files "signals" "$T/signal" "$T/whole-$2"
    end
}
torture_signals() {
    set -m # background jobs of a script ignore SIGINT and SIGQUIT otherwise
    for ((signal = 1; signal <= 31; signal++)); do
        case $signal in 19 | 20 | 21 | 22) continue ;; esac # these only pause
        for kind in trajectory movie; do signalled $signal $kind; done
    done 2>/dev/null
    set +m
}

# ---- failing allocations ----

fail() { # SCENE K
    begin "allocations: $1"
    (export LD_PRELOAD=$build/tests/fail_alloc.so FAIL_AT=$2; draw "$1" "$T/memory")
    local status=$?
    judge_status "allocations: $1" $status 0 1
    judge_files "allocations: $1" "$T/memory" "$T/whole-$1"
    judge_left "allocations: $1" $status "$T/memory"
    if [ -e "$T/memory/sweep.h5.part" ]; then # which is there to go on from
        draw "$1" "$T/memory" && judge_files "allocations: $1" "$T/memory" "$T/whole-$1"
        [ ! -e "$T/memory/sweep.h5.part" ] || fault "allocations: $1" wrong "the journal of allocation $2 is of no use"
    fi
    rm -rf "$T/memory"
    [ $bad -eq 0 ] || echo "  allocation $2"
    end
}
torture_allocations() {
    for name in every few; do
        (export LD_PRELOAD=$build/tests/fail_alloc.so FAIL_COUNT=$T/allocations; draw $name "$T/memory")
        all=$(cat "$T/allocations")
        echo "$name: $all allocations of the program's own"
        rm -rf "$T/memory"
        [ "$all" -gt 100 ] || { failed=$((failed + 1)); continue; }
        if [ "$allocations" = all ]; then
            for ((k = 1; k <= all; k++)); do fail $name $k; done
        else
            for ((i = 0; i < allocations; i++)); do fail $name $((1 + (RANDOM * 32768 + RANDOM) % all)); done
        fi
    done
}

for part in "${parts[@]}"; do "torture_$part" || failed=$((failed + 1)); done

# ---- the table ----

printf '\n%-22s' ''
printf '%11s' "${columns[@]}"
echo
cut -d, -f1 < <(printf '%s\n' "${!count[@]}") | sort -u | while read -r what; do
    printf '%-22s' "$what"
    for column in "${columns[@]}"; do printf '%11d' "${count[$what,$column]:-0}"; done
    echo
done
echo "unreadable, broken and wrong are meant to be 0."
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
