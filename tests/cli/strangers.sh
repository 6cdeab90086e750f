#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Files of strangers, and machines that refuse: nothing hangs, nothing ends by a signal, nothing is left half-written.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
nm -D "$beadsim" 2>/dev/null | grep -q __asan_ && sanitized=1
scene() { # OUTPUTS [KEYS]
    printf 'chain: {beads: [{bead: large-steel, count: 3}]}\noutputs: [%s]\n%s\n' "$1" "${2:-}"
}
# refuse FUNCTION RESULT ERRNO [LIBRARY] : a library to load before a program, in which FUNCTION fails; called by LIBRARY only.
refuse() {
    cat >"$1.c" <<C
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <string.h>
int $1();
int $1(void *a, void *b, void *c, void *d)
{
    Dl_info caller;
    if (dladdr(__builtin_return_address(0), &caller) && strstr(caller.dli_fname, "${4:-}")) {
        errno = $3;
        return $2;
    }
    int (*real)(void *, void *, void *, void *) = (int (*)(void *, void *, void *, void *))dlsym(RTLD_NEXT, "$1");
    return real(a, b, c, d);
}
C
    ${CC:-cc} -w -shared -fPIC "$1.c" -o "$1.so" -ldl
}

# ---- what is read ----
mkfifo pipe.yaml
waits() { # SIGNAL : a scene that never comes
    timeout --preserve-status -k 20 -s "$1" 1 "$beadsim" pipe.yaml -o no 2>err
    [ $? -eq $((128 + $(kill -l "$1"))) ] || { cat err; return 1; }
}
ok "a pipe that stays empty: SIGTERM ends the wait" waits TERM
ok "... SIGINT, too" waits INT
through() {
    (scene '{table: a.csv}' >pipe.yaml) & # opens once there is a reader
    timeout 20 "$beadsim" pipe.yaml -o piped && [ -s piped/a.csv ]
}
ok "a scene through a pipe" through
standard() { scene '{table: a.csv}' | "$beadsim" - -o standard && cmp standard/a.csv piped/a.csv; }
ok "a scene from standard input" standard
mkdir -p .config/beadreel && mkfifo .config/beadreel/config.yaml
scene '{table: a.csv}' >plain.yaml
ok "own settings are no pipe" fails 1 timeout 20 "$beadsim" plain.yaml -o no
ok "..." says "config.yaml: cannot be read: it is not a regular file"
rm -r .config
scene '{image: a.png, colormap: /proc/kmsg}' >kernel.yaml # says that it is a regular file, of no length
ok "a colour map in /proc" fails 2 timeout 20 "$beadreel" kernel.yaml -o no
ok "..." says "outputs.0.colormap: /proc/kmsg: has 0 colours"

mkfifo pipe.h5 pipe.png
for how in --verify --reproduce --merge; do
    ok "a pipe that says it is a result, $how" fails 1 timeout 20 "$beadreel" $how pipe.h5 -o no.h5
    ok "..." says "pipe.h5: cannot be read: it is not a regular file"
done
ok "... and a picture" fails 1 timeout 20 "$beadreel" --reproduce pipe.png
ok "..." says "pipe.png: cannot be read: it is not a regular file"

# ---- what is read is not replaced ----
mkdir -p .config/beadreel
printf 'materials: mine.yaml\ncolormaps: {own: own.csv}\n' >.config/beadreel/config.yaml
printf 'mine: {modulus: 193 GPa, poisson: 0.3, radius: 4.76 mm, mass: 3.63 g}\n' >.config/beadreel/mine.yaml
printf '0 0 0\n255 255 255\n' | tee map.csv >.config/beadreel/own.csv
printf 't,v\n0,0\n1e-5,0.5\n2e-5,0\n' | tee drive.csv >seen.csv
ln map.csv hard.csv && ln -s drive.csv soft.csv && ln -s .config/beadreel/config.yaml config.csv && ln -s .config/beadreel/mine.yaml mine.csv
ln -s "$BEADREEL_ASSETS/materials.yaml" ready.csv
cat >parts.yaml <<'Y'
chain: {drive: {displacement: {file: drive.csv}, amplitude: 1 um}, beads: [{bead: large-steel, sensor: first}, {bead: mine}]}
simulate: {until: 50 us}
outputs: [{table: a.csv}, {image: b.png, colormap: map.csv}, {image: c.png, colormap: own}, {plot: d.png, show: sensors, measured: seen.csv}]
Y
for file in map.csv drive.csv seen.csv .config/beadreel/own.csv hard.csv soft.csv config.csv mine.csv ready.csv; do
    cp "$file" before
    ok "-o $file, which the run reads" fails 2 "$beadreel" parts.yaml -o "$file"
    ok "... is said" says "beadreel: $file: would replace what it is made of; give another name or directory with -o"
    ok "... also where the scene names it" fails 2 "$beadreel" parts.yaml --set outputs.0.table="$file" -o .
    ok "... and is as before" cmp "$file" before
done
scene '{image: a.png, colormap: map.csv}' >map.yaml
mkdir over && cp drive.csv over/one.csv && cp drive.csv over/two.csv
printf '%s\n' 'chain: {drive: {displacement: {file: one.csv}, amplitude: 1 um}, beads: [{bead: large-steel, count: 5}]}' \
    'simulate: {until: 50 us}' 'outputs: [{table: a.csv}]' \
    'sweep: {over: {chain.drive.displacement: [{file: one.csv}, {file: two.csv}]}, measure: {beads: [2, 4]}}' >over/over.yaml
ok "a file that only a sweep's values name" fails 2 "$beadsim" over/over.yaml -o over/two.csv
ok "..." says "over/two.csv: would replace what it is made of"
ok "... is as before" cmp over/two.csv drive.csv
ok "... and are beside the scene" exits 0 "$beadsim" over/over.yaml -o overs
ok "a crate" exits 0 "$beadsim" plain.yaml -o crate --crate
cp crate/ro-crate-scene.yaml before && echo '# mine' | tee -a before >>crate/ro-crate-scene.yaml
ok "... does not replace the scene that it is made of" fails 2 "$beadsim" crate/ro-crate-scene.yaml -o crate --crate
ok "..." cmp crate/ro-crate-scene.yaml before
rm crate/*.csv
ok "... and is refused before it is run" fails 2 "$beadsim" crate/ro-crate-scene.yaml -o crate --crate
ok "..." test "$(ls crate)" = "$(printf 'ro-crate-metadata.json\nro-crate-scene.yaml')"
rm -r .config

mkfifo seen.png && mkdir folder.csv && ln -s plain.yaml here.png
for kind in '{image: seen.png}' '{movie: film.mp4, poster: seen.png, duration: .1 s}'; do
    scene "$kind" >fifo.yaml
    ok "a pipe in the place of $kind" fails 1 timeout 20 "$beadreel" fifo.yaml -o .
    ok "..." says "seen.png: is a pipe or a device, and files replace what is there; -o - writes to standard output"
done
ok "... or of -o" fails 1 timeout 20 "$beadreel" map.yaml -o seen.png
ok "... stays" test -p seen.png
scene '{table: folder.csv}' >folder.yaml
ok "a directory in the place of a file" fails 1 "$beadsim" folder.yaml -o .
ok "... is told before the run" says "folder.csv: cannot be written: Is a directory"
ok "... and nothing is left" test ! -e folder.csv.part -a ! -e film.mp4 -a ! -e film.mp4.part
scene '{image: here.png}' >here.yaml
ok "a symbolic link is replaced" exits 0 "$beadreel" here.yaml -o .
ok "... not what it points at" test ! -L here.png -a "$(head -c 5 plain.yaml)" = chain

# ---- what is shown ----
quiet() { ! LC_ALL=C grep -qP '[\x01-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\xa8-\xae]' "$@"; }
printf '"ch\\u009b31main\\u202e": 1\n%s\n' "$(scene '{table: a.csv}')" >key.yaml
ok "an unknown key with C1 and bidi characters" fails 2 "$beadsim" key.yaml
ok "... is told without them" quiet err
for name in '\e[31mred' '\uffff' '\u009b31m'; do
    printf 'materials: {"%s": {modulus: 193 GPa, poisson: 0.3, radius: 4.76 mm, mass: 3.63 g}}\n%s\n' "$name" \
        "$(scene '{table: a.csv}')" >name.yaml
    ok "a material is not named $name" fails 2 "$beadsim" --plan name.yaml
    ok "..." quiet err
done
bidi() { "$beadsim" --info turned.yaml >out && quiet out && grep -q '^title: a  b$' out; }
scene '{table: a.csv}' 'title: "a\u202e\u202cb"' >turned.yaml
ok "a title that turns the line is shown without that" bidi
for title in '\u202eb' '\u202a\u202db\u202c' '\u2067b' '\u2068\u202eb\u202c' '\u2067\u2066b\u2069' '\u202b\u2067b\u202c\u2069'; do
    scene '{table: a.csv}' "title: \"a$title\"" >turned.yaml
    ok "a title $title, which turns what follows" fails 2 "$beadsim" --plan turned.yaml
    ok "..." says "turned.yaml:3:8: title: turns the direction of the text"
done
for title in '\u202eb\u202c' '\u2067b\u2069c' '\u2068\u202eb\u2069' '\u2069\u202cb' '\u200fb' 'אבג 1' '\u202a\u2067b\u2069\u202c'; do
    scene '{table: a.csv}' "title: \"a$title\"" >turned.yaml
    ok "a title $title, which does not" exits 0 "$beadsim" --plan turned.yaml
done
python=$([ -x /usr/bin/python3 ] && echo /usr/bin/python3 || echo python3) # the one that has Debian's packages
if $python -c 'import h5py' 2>/dev/null; then
    scene '{trajectory: method.h5, every: 5 us}' >method.yaml && "$beadsim" method.yaml -o . >/dev/null
    printf 'sweep: {cells: 4, configurations: 2}\noutputs: [{sweep: version.h5}]\n' >version.yaml && "$beadsim" version.yaml -o . >/dev/null
    $python -c '
import h5py, numpy as np
evil = b"\x1b]0;title\x07\x1b[31mred"
with h5py.File("method.h5", "r+") as file:
    del file["parameters/beadreel/outcome/method"]
    file["parameters/beadreel/outcome/method"] = np.array([evil], dtype="S30")
with h5py.File("version.h5", "r+") as file:
    file.attrs["version"] = np.bytes_(evil)'
    for file in method version; do
        ok "--info of escapes in a file: its $file" exits 0 "$beadsim" --info $file.h5
        ok "..." prints '[31mred'
        ok "... are obeyed by no terminal" quiet out
    done
else
    skip "python3-h5py" "--info of escapes in files"
fi

quietly() { exits 0 "$@" && quiet out err; }
evil=$'\e[31m\xc2\x9bred\xe2\x80\xae'
scene '{table: a.csv}, {trajectory: run.h5, every: 5 us}' >"$evil.yaml"
ok "a run of a file that is named like an escape" quietly "$beadsim" "$evil.yaml" -o "$evil"
ok "... made all the same" test -s "$evil/run.h5"
ok "... its plan" quietly "$beadsim" --plan "$evil.yaml" -o "$evil"
ok "... its digests" quietly "$beadsim" --verify "$evil/run.h5"
ok "... the same again" quietly "$beadsim" --reproduce "$evil/run.h5"
ok "... one of that name to start from" quietly "$beadsim" --new paper -o "$evil.new.yaml"
ok "... the drawing of it" quietly "$beadreel" "$evil/run.h5" -o drawn.png

# ---- a trajectory without a film ----
scene '{trajectory: run.h5, every: 5 us}' >run.yaml
"$beadsim" run.yaml -o . >/dev/null
ok "a frame of no film" fails 2 "$beadreel" run.h5 --frame 50%
ok "..." says "--frame: run.h5 has no movie"

# ---- spreadsheets ----
cat >cells.yaml <<'YAML'
chains:
  - {name: "=HYPERLINK(1)", beads: [{bead: large-steel, count: 3}, {bead: brass, sensor: "@x, y"}]}
  - {name: "-5+cmd|x!A0", beads: [{bead: large-steel, count: 3}, {bead: brass, sensor: "-5 N"}]}
outputs: [{table: t.csv, show: peaks}, {table: s.csv, show: sensors, every: 50 us}, {table: c.csv, show: chain}]
YAML
ok "names that are formulas" exits 0 "$beadsim" cells.yaml -o .
formulas() { # cells that a spreadsheet computes
    python3 -c 'import csv, sys
for name in sys.argv[1:]:
    for row in csv.reader(open(name)):
        for cell in row:
            if cell[:1] in "=@+" and cell or cell[:1] == "-" and not cell[1:2].isdigit(): sys.exit(cell)' "$@"
}
ok "... are none in tables" formulas t.csv s.csv c.csv
ok "... and names still" grep -q "^'=HYPERLINK(1),0," t.csv
ok "... in every column" grep -q '"'"'"'@x, y"' c.csv
ok "a number with a sign stays one" grep -q ',-5 N,' c.csv
ok "... and one that computes does not" grep -q "^'-5+cmd|x!A0," t.csv

# ---- damage ----
printf 'sweep: {cells: 4, configurations: 2}\noutputs: [{sweep: sweep.h5}]\n' >sweep.yaml && "$beadsim" sweep.yaml -o . >/dev/null
for file in run sweep; do
    ok "$file.h5 is whole" exits 0 "$beadsim" --verify $file.h5
    ok "... and says so" prints "$file.h5: whole: $(stat -c %s $file.h5) bytes as they were written"
    for at in 9 $(($(stat -c %s $file.h5) / 2)) $(($(stat -c %s $file.h5) - 20)); do
        cp $file.h5 flipped.h5
        byte=$(od -An -tu1 -j "$at" -N 1 flipped.h5)
        printf '%b' "\\x$(printf %x $((byte ^ 16)))" | dd of=flipped.h5 bs=1 seek="$at" conv=notrunc status=none
        ok "a bit of $file.h5 flipped at $at" fails 1 "$beadsim" --verify flipped.h5
        ok "... is told" says "flipped.h5: damaged: "
        ok "... by --info, too" fails 1 "$beadsim" --info flipped.h5
    done
done
ok "a damaged sweep is not taken for a run" fails "1 4" "$beadsim" flipped.h5 --configuration 0 -o none
ok "..." says "flipped.h5: damaged: "
truncate -s -1000 run.h5
ok "a file cut off" fails 1 "$beadsim" --verify run.h5
ok "..." says "run.h5: has no digests: it is unfinished"
ok "a scene is not verified" fails 1 "$beadsim" --verify run.yaml
ok "... and says what is" says "run.yaml: not an HDF5 file: only trajectories and the files of sweeps have digests"

# ---- no threads, no time ----
if [ "${sanitized:-}" ] || ! refuse pthread_create 11 11 libglib; then
    skip "a compiler, and a build without sanitizers" "GLib without threads"
else
    threadless() {
        LD_PRELOAD=$T/pthread_create.so run "$beadreel" "$1" -o none
        [ $status -eq 1 ] && says GLib-ERROR && says "no unfinished file is left" && empty none
    }
    scene '{image: a.png}, {plot: b.pdf, show: setup}, {table: c.csv}, {trajectory: d.h5, every: 5 us}' >drawn.yaml
    ok "GLib gives up without threads: it says so, and nothing is left" threadless drawn.yaml
fi
scene '{trajectory: run.h5, every: 100 us, fields: [displacement]}' 'simulate: {until: 20 s, method: rk4, step: 0.1 us}' >long.yaml
limited() {
    (ulimit -S -t 1 && exec "$beadsim" long.yaml -o limited --progress none) >out 2>err
    status=$?
    [ $status -eq 152 ] && says "stopped by signal 24" && "$beadsim" --info limited/run.h5.part >/dev/null
}
ok "a limit of CPU time stops a run in good order" limited

if [ "${sanitized:-}" ]; then
    skip "a build without sanitizers" "small stacks"
else
    scene '{movie: a.mp4, duration: 1 s, size: [320, 240]}, {image: b.png}, {trajectory: c.h5, every: 5 us}' >film.yaml
    stack() { # STATUS DIRECTORY LIMIT...
        run bash -c 'ulimit -c 0; ulimit "${@:4}" && exec "$1" "$2" -o "$3" --progress none' - "$beadreel" film.yaml "$2" "${@:3}"
        [ $status -eq "$1" ] || { echo "status $status"; cat err; return 1; }
    }
    ok "a shell's small stack is made larger" stack 0 soft -S -s 64
    ok "64 kB of stack, and no more: too few" stack 139 hard -s 64
    ok "... which is told" says "no unfinished file is left"
    printf '%s\n' '#include <stdio.h>' '#include <string.h>' '#include <unistd.h>' 'static pid_t first;' \
        '__attribute__((constructor)) static void begin(void) { first = getpid(); }' \
        '__attribute__((destructor)) static void end(void) { char line[160]; FILE *f = first == getpid() ? fopen("/proc/self/status", "r") : 0;' \
        'while (f && fgets(line, sizeof line, f)) if (!strncmp(line, "VmPeak:", 7)) fputs(line, stderr); }' >peak.c
    ${CC:-cc} -w -shared -fPIC peak.c -o peak.so
    addresses() { # LIMIT in kB : the most that a run has had, in MiB
        (ulimit -v "$1" && LD_PRELOAD=$T/peak.so "$beadreel" film.yaml -o addresses --threads 4 --canvas plain --progress none) 2>&1 >/dev/null |
            awk '/^VmPeak/ { print int($2 / 1024) }'
    }
    spared() {
        local all few
        all=$(addresses unlimited) few=$(addresses 50000000) # a thread or more had its own heap, 64 MiB less what the shared one grows by
        [ "$few" -gt 50 ] && [ $((all - few)) -ge 48 ] || { echo "$all MiB, $few MiB"; return 1; }
    }
    ok "where addresses are limited, threads share one heap" spared
    scene '{movie: a.mp4, duration: 0.2 s, size: [320, 240]}' >frames.yaml
    scene '{trajectory: read.h5, every: 5 us}' >read.yaml && "$beadsim" read.yaml -o . -q
    few() { # MEGABYTES PROGRAM OPTIONS... : it may succeed or fail, but no signal ends it
        rm -rf few
        run bash -c 'ulimit -c 0; ulimit -v $(($1 * 1000)) && exec timeout 60 "${@:2}"' - "$@" --progress none
        [ $status -le 2 ] && ! compgen -G 'few/[a-r]*.part' >/dev/null || { echo "$*: status $status"; cat err; return 1; }
    }
    scene '{table: m.csv}, {plot: p.png}, {sweep: s.h5}' 'sweep: {over: {chain.striker.velocity: [1 m/s, 2 m/s]}}' >swept.yaml
    few_of_all() {
        local size file
        for size in 60 150 240 330 420 440 450 460 470 480 490 510 600 750 900; do
            few "$size" "$beadreel" frames.yaml -o few && few "$size" "$beadreel" frames.yaml -o few/a.png || return 1
        done
        for size in 60 180 260 300; do
            few "$size" "$beadreel" swept.yaml -o few || return 1 # the journal s.h5.part may stay
            for file in a.webm a.gif a.html; do few "$size" "$beadreel" frames.yaml -o few/$file || return 1; done
        done
        for size in 40 60 90 125 150 300; do
            few "$size" "$beadsim" read.yaml -o few && few "$size" "$beadreel" read.h5 -o few/a.pdf || return 1
            for file in read.yaml read.h5; do few "$size" "$beadsim" --info "$file" || return 1; done
        done
    }
    ok "few addresses end no film, picture, page, sweep, run or description by a signal" few_of_all
    ok "... beads are painted without Mesa, which would fall" few 480 "$beadreel" frames.yaml -o few
    ok "... as it says" prints "painted by the plain canvas"
    ok "... Mesa asked for by name" few 480 "$beadreel" frames.yaml -o few --canvas osmesa
    ok "... is refused" says "needs 4 GiB of free addresses (ulimit -v); --canvas plain does without"
    ok "... so is AV1" few 900 "$beadreel" frames.yaml --set outputs.0.codec=av1 -o few
    ok "..." says "a.mp4: AV1 needs 4 GiB of free addresses (ulimit -v); other codecs need less"
    echo 'int png_write_end(void *png, void *info) { volatile char some[4096]; some[0] = 1; return png_write_end(png, info) + some[0]; }' >deep.c
    ${CC:-cc} -w -O0 -shared -fPIC deep.c -o deep.so
    deep() {
        (ulimit -c 0 && LD_PRELOAD=$T/deep.so run "$beadreel" film.yaml -o deep --progress none; exit $status) 2>/dev/null
        [ $? -eq 139 ] && says "no unfinished file is left" && empty deep
    }
    ok "a stack that runs out while files are written: it is told, and nothing is left" deep
fi

# ---- the process that reads HDF5 files ----
scene '{trajectory: read.h5, every: 5 us}' >read.yaml && "$beadsim" read.yaml -o . >/dev/null
# intrude WHAT : a library whose pread does that in each process but the first.
intrude() {
    cat >"$1.c" <<C
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>
static pid_t first;
static ssize_t (*real)(int, void *, size_t, off_t);
__attribute__((constructor)) static void begin(void)
{
    first = getpid();
    real = (ssize_t (*)(int, void *, size_t, off_t))dlsym(RTLD_NEXT, "pread");
}
static void say(const char *what, int result)
{
    dprintf(2, "intruder: %s: %s\n", what, result < 0 ? strerror(errno) : "done");
}
ssize_t pread(int file, void *bytes, size_t size, off_t at)
{
    static int done;
    if (getpid() != first && !done++) {
        $2
    }
    return real(file, bytes, size, at);
}
C
    ${CC:-cc} -w -shared -fPIC "$1.c" -o "$1.so" -ldl
}
if [ "${sanitized:-}" ] || ! intrude intruder 'say("write", open("intruded", O_WRONLY | O_CREAT, 0600));
    say("connect", socket(AF_INET, SOCK_STREAM, 0)); say("run", execl("/bin/true", "true", NULL)); say("memory", malloc(1u << 30) ? 0 : -1);'; then
    skip "a compiler, and a build without sanitizers" "a sandbox around HDF5"
else
    ok "who takes over the process that reads a trajectory" exits 0 env LD_PRELOAD="$T/intruder.so" "$beadsim" --info read.h5
    for what in write connect run; do ok "... cannot $what" says "intruder: $what: Operation not permitted"; done
    ok "... has not much memory" says "intruder: memory: Cannot allocate memory"
    ok "... and has written nothing" test ! -e intruded
    for part in 1 2; do "$beadsim" sweep.yaml --shard $part/2 -o parts >/dev/null; done
    ok "the same of one that merges" exits 0 env LD_PRELOAD="$T/intruder.so" "$beadsim" --merge parts/*.h5 -o merged.h5
    ok "..." says "intruder: write: Operation not permitted"
    ok "... into the same bytes" cmp merged.h5 sweep.h5
    intrude fault 'raise(SIGSEGV);'
    ok "a fault within HDF5 ends no program" fails 1 env LD_PRELOAD="$T/fault.so" "$beadsim" --info read.h5
    ok "... it is damage" says "read.h5: damaged: HDF5 crashes on it (Segmentation fault)"
    ok "... nor one that draws" fails 1 env LD_PRELOAD="$T/fault.so" "$beadreel" read.h5 -o fault.png
    ok "... nor one that merges" fails 1 env LD_PRELOAD="$T/fault.so" "$beadsim" --merge parts/*.h5 -o fault.h5
    ok "... and nothing is left" test "$(echo fault.* intruded*)" = "fault.c fault.so intruded*"
    scene '{image: read.png}' >image.yaml && "$beadreel" image.yaml -o . >/dev/null
    # libpng asks how many bytes to read: this one does what else it can.
    sed 's/pread(int file, void \*bytes, size_t size, off_t at)/png_read_info(void *file, void *bytes)/
        s/"pread"/"png_read_info"/; s/return real.*/((void (*)(void *, void *))real)(file, bytes); return 0;/' intruder.c >png.c
    sed 's/if (getpid() != first/raise(SIGSEGV);\n&/' png.c >png_fault.c
    for name in png png_fault; do ${CC:-cc} -w -shared -fPIC $name.c -o $name.so -ldl; done
    ok "who takes over the process that finds a picture's scene" exits 0 env LD_PRELOAD="$T/png.so" "$beadreel" --reproduce read.png
    for what in write connect run; do ok "... cannot $what" says "intruder: $what: Operation not permitted"; done
    ok "... has not much memory" says "intruder: memory: Cannot allocate memory"
    ok "... and has written nothing" test ! -e intruded
    ok "a fault within libpng ends no program" fails 1 env LD_PRELOAD="$T/png_fault.so" "$beadreel" --reproduce read.png
    ok "... it is damage" says "read.png: damaged: its reader crashes on it (Segmentation fault)"
    # reads FUNCTION RESULT PARAMETERS ARGUMENTS WHAT COMMAND... : a program in which FUNCTION, which reads WHAT, does what else it can.
    reads() {
        printf '%s\n' '#define _GNU_SOURCE' '#include <dlfcn.h>' '#include <errno.h>' '#include <stdio.h>' '#include <sys/socket.h>' '#include <unistd.h>' \
            "$2 $1($3) { static int done; if (!done++) {" \
            'if (socket(AF_INET, SOCK_STREAM, 0) < 0 && errno == EPERM) fputs("intruder: connect: refused\n", stderr);' \
            'if (execl("/bin/true", "true", (char *)0) < 0 && errno == EPERM) fputs("intruder: run: refused\n", stderr); errno = 0; }' \
            "return (($2 (*)($3))dlsym(RTLD_NEXT, \"$1\"))($4); }" >"reads_$1.c"
        ${CC:-cc} -w -shared -fPIC "reads_$1.c" -o "reads_$1.so" -ldl
        ok "who takes over the reading of $5" exits 0 env LD_PRELOAD="$T/reads_$1.so" "${@:6}"
        for what in connect run; do ok "... cannot $what" says "intruder: $what: refused"; done
    }
    reads yaml_parser_delete void "void *p" p "a scene" "$beadsim" plain.yaml -o plain
    reads strtod double "const char *a, char **b" "a, b" "a colour map" "$beadreel" map.yaml -o plain
    sed 's/outputs: .*/outputs: [{table: a.csv}]/' parts.yaml | sed 's/, {bead: mine}//' >wave.yaml
    reads strtod double "const char *a, char **b" "a, b" "a wave" "$beadsim" wave.yaml -o plain
    printf '%s\n' '#include <signal.h>' 'int rename(const char *a, const char *b) { raise(SIGKILL); return -1; }' >killed.c
    ${CC:-cc} -w -shared -fPIC killed.c -o killed.so
    (LD_PRELOAD=$T/killed.so "$beadsim" sweep.yaml -o journal) >/dev/null 2>&1
    reads pread ssize_t "int f, void *b, size_t n, off_t at" "f, b, n, at" "a journal" "$beadsim" --info journal/sweep.h5.part
    ok "..." grep -q 'chains are done' out
    refuse syscall -1 38 beadsim
    ok "a kernel without sandboxes" exits 0 env LD_PRELOAD="$T/syscall.so" "$beadsim" --info read.h5
    ok "... is told" says "warning: this kernel has no seccomp: such files are read in a process of their own, but in no sandbox"
fi

if [ "${sanitized:-}" ]; then
    skip "a build without sanitizers" "a merge that is stopped"
else
    printf '%s\n' '#define _GNU_SOURCE' '#include <dlfcn.h>' '#include <signal.h>' 'int rename(const char *a, const char *b)' \
        '{ raise(SIGTERM); return ((int (*)(const char *, const char *))dlsym(RTLD_NEXT, "rename"))(a, b); }' >late.c
    ${CC:-cc} -w -shared -fPIC late.c -o late.so -ldl
    late() {
        (LD_PRELOAD=$T/late.so run "$beadsim" --merge parts/*.h5 -o late.h5; exit $status) 2>/dev/null
        [ $? -eq 143 ] && cmp late.h5 sweep.h5 && [ ! -e late.h5.new ]
    }
    ok "SIGTERM while a merged file is written: it is whole" late
fi

# ---- no locks ----
if [ "${sanitized:-}" ] || ! refuse flock -1 37; then # ENOLCK
    skip "a compiler, and a build without sanitizers" "file systems without locks"
else
    lockless() { LD_PRELOAD=$T/flock.so "$@"; }
    LD_PRELOAD=$T/flock.so "$beadsim" long.yaml -o shared --progress none >first 2>&1 &
    first=$!
    await test -s shared/run.h5.part.lock # the claim is written after it is made
    ok "without locks, the second of two runs is refused" fails 2 lockless "$beadsim" long.yaml -o shared
    ok "... and told of the first" says "another run is writing it, process $first on $(uname -n); if that is gone, remove shared/run.h5.part.lock"
    kill -KILL $first
    wait $first 2>/dev/null
    mkdir claimed && : >claimed/run.h5.part.lock
    ok "a claim that is still empty names nobody" fails 2 lockless "$beadsim" run.yaml -o claimed
    ok "... but its file" says "another run begins to write it; if there is none, remove claimed/run.h5.part.lock"
    ok "the claim of a killed run is taken over" exits 0 lockless "$beadsim" run.yaml -o shared
    ok "... with a word" says "warning: this file system has no locks: until the end, files such as shared/run.h5.part.lock"
    ok "... and nothing stays" test "$(ls shared)" = run.h5
fi
finish
