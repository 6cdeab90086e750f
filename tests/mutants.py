#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the tests notice small faults? tests/mutants.py [--count N] [--seed N] [ROOM...], or `make mutants`; by hand, from a commit.
`--again LOG` tries the survivors of an earlier run, whose output LOG is, and no others.

Draws faults by seed, each one change of one line of the last commit: another comparison, operator or constant, two arguments
swapped, a statement dropped (but none that frees: leaks are for the sanitizers). A fault that the compiler refuses or warns of, or that
leaves the object file as it was, is none and is drawn again. Each meets the tests that run its line, until one fails; first those that are
quick and have many of their lines in its file. Which test runs which line is measured once, with gcov, and kept in build-mutants/. Hashes
and golden pictures do not count: they say that something changed, not that it is wrong. What none notices meets the first tests again, its
file compiled with the sanitizers of `make asan`, as .ci/run does for those that are not long: steps past an end of memory rarely change
what is drawn. Prints each fault with the CPU seconds of the tests that it met, then the survivors and the score of each room.
tests/mutants.txt lists faults proved harmless, with reasons.

Why not a tool: universalmutator (PyPI) draws from the same kind of patterns, but knows no map from lines to tests and runs all of
them for each fault; Mull needs its own plugin for each release of LLVM, and tests that are one process. Neither is in Debian."""
import argparse
import concurrent.futures
import json
import math
import os
import random
import re
import shutil
import subprocess
import threading

NO_TRUTH = ("bits", "test_golden")
SANITIZED = ("CFLAGS=-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all", "STRICT_LINK=", "WERROR=")
LITTLE_MEMORY = ("limits", "strangers")  # is too little for sanitizers
SANITIZED_TESTS, SANITIZED_SCRIPTS = 4, 2  # that a fault meets once more
ABOUT_SOURCES = ("test_arrows", "test_exports", "test_headers", "test_make", "test_readme", "test_spdx", "test_run", "test_library",
                 "test_truths")

SWAPS = [(r" < ", (" <= ", " >= ")), (r" > ", (" >= ", " <= ")), (r" <= ", (" < ",)), (r" >= ", (" > ",)), (r" == ", (" != ",)),
         (r" != ", (" == ",)), (r" \+ ", (" - ",)), (r" - ", (" + ",)), (r" \* ", (" / ",)), (r" / ", (" * ",)), (r" && ", (" || ",)),
         (r" \|\| ", (" && ",)), (r" \+= ", (" -= ",)), (r" -= ", (" += ",)), (r"\bfmax\(", ("fmin(",)), (r"\bfmin\(", ("fmax(",)),
         (r"\+\+;", ("--;",)), (r"(?<=[(\[ ])!(?=\w)", ("",)), (r"(?<![\w.])0\.5(?![\w.])", ("0.501",)), (r"(?<![\w.])1(?![\w.])", ("2", "0")),
         (r"(?<![\w.])2(?![\w.])", ("3",)), (r"(?<![\w.])0(?![\w.])", ("1",)), (r"\btrue\b", ("false",)), (r"\bfalse\b", ("true",)),
         (r"\((\w+), (\w+)\)", (r"(\2, \1)",)), (r"^(\s+)[\w\->\[\].]+ [-+*/]?= [^;]*;$", (r"\1;",)),
         (r"^(\s+)(?!\w*(?:free|destroy|release)\w*\()\w+\([^;]*\);$", (r"\1;",))]
NO_CODE = re.compile(r"^\s*(/\*|\*|//|#|struct|enum|static const|const|case|default|\{|\}|$)|\*/\s*$")


class Fault:
    """Line `number` (from 1) of `file` becomes `after`."""

    def __init__(self, file, number, before, after):
        self.file, self.number, self.before, self.after = file, number, before, after

    def __str__(self):
        return f"{self.file}:{self.number}: {self.before.strip()} -> {self.after.strip()}"

    def key(self):
        return f"{self.file}: {self.before.strip()} -> {self.after.strip()}"


def possible(file):
    """All faults of one file."""
    with open(file, encoding="utf-8") as source:
        lines = source.read().split("\n")
    for number, line in enumerate(lines, 1):
        if not line.startswith(" ") or NO_CODE.search(line):
            continue
        text = re.sub(r'"(\\.|[^"\\])*"|/\*.*?\*/', lambda m: "\0" * len(m.group()), line)  # no faults in words
        for pattern, others in SWAPS:
            for found in re.finditer(pattern, text):
                for other in others:
                    other = other if file.startswith("sim/") else other.replace("0.501", "0.6")  # pixels hide a thousandth
                    after = line[:found.start()] + found.expand(other.replace("\\", "\\")) + line[found.end():]
                    if "\0" not in after and after != line:
                        yield Fault(file, number, line, after)


def run(command, folder, seconds=None, **more):
    """Each process may take so many seconds of CPU, so that other work on the machine does not matter; what waits for ever is ended, too."""
    if seconds:
        command, seconds = ["prlimit", f"--cpu={math.ceil(seconds)}", *command], 20 * seconds
    try:
        return subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", timeout=seconds, check=False, start_new_session=True, **more)
    except subprocess.TimeoutExpired:
        return None


def seconds_of(done):
    """Of CPU, as tests/run.sh has them."""
    found = done and re.search(r"([\d.]+) s of CPU", done.stdout)
    return float(found[1]) if found else 0


def copy_of_commit(folder):
    if not os.path.isdir(folder):
        os.makedirs(folder)
        subprocess.run(f"git archive HEAD | tar -x -C '{folder}'", shell=True, check=True)


def tests_of(folder):
    """Names as tests/run.sh has them."""
    programs = [os.path.basename(f) for f in os.listdir(f"{folder}/build/tests") if re.fullmatch(r"test_\w+", f)]
    scripts = [f[:-3] for d in ("tests", "tests/cli") for f in os.listdir(f"{folder}/{d}")
               if f.endswith(".sh") and (d == "tests/cli" or f.startswith("test_"))]
    return sorted(set(programs + scripts) - set(NO_TRUTH) - set(ABOUT_SOURCES))


def lines_run(folder, counts, test):
    """[seconds, {file: [lines that it runs]}] of one test, whose counters go to a folder of their own; None where it fails."""
    prefix = len(os.path.abspath(f"{folder}/build").strip("/").split("/"))
    subprocess.run(f"rm -rf '{counts}' && mkdir '{counts}' && cd '{folder}/build' && cp --parents $(find sim render -name '*.gcno') "
                   f"'{counts}'", shell=True, check=True)
    done = run(["tests/run.sh", "build", test], folder, 1200, env=dict(os.environ, TEST_TIMEOUT="3600", GCOV_PREFIX=counts,
                                                                       GCOV_PREFIX_STRIP=str(prefix), GCOV_ERROR_FILE="/dev/null"))
    lines = {}
    if done is not None and not done.returncode:
        found = subprocess.run("find . -name '*.gcda' | xargs -r gcov --json-format --stdout 2>/dev/null", shell=True, cwd=counts,
                               capture_output=True, text=True, check=False).stdout
        for record in found.splitlines():
            for file in json.loads(record)["files"] if record.startswith("{") else []:
                path = os.path.relpath(os.path.join(folder, file["file"]), folder)
                hit = {line["line_number"] for line in file["lines"] if line["count"]}
                lines[path] = sorted(hit | set(lines.get(path, [])))
    shutil.rmtree(counts)
    return [seconds_of(done), lines] if lines else None


def measure_map(work, names, jobs):
    """{test: [seconds, {file: [lines that it runs]}]} of the tests `names`, or of all, with a build of --coverage; those of earlier
    runs are kept."""
    kept, reached = f"{work}/map.json", {}
    if os.path.exists(kept):
        with open(kept, encoding="utf-8") as file:
            reached = json.load(file)
        if not names:
            return reached
    folder = f"{work}/coverage"
    copy_of_commit(folder)
    built = run(["make", "-s", f"-j{jobs}", "counted", "CFLAGS=-O0 -g --coverage -fprofile-update=atomic", "WERROR="], folder)
    if built.returncode:
        raise SystemExit(built.stdout[-2000:])
    run(["sh", "-c", "find build -name '*.gcda' -delete"], folder)
    lock = threading.Lock()

    def measure(test):
        found = lines_run(folder, os.path.abspath(f"{work}/counts-{test}"), test)
        with lock:
            if not found:
                print(f"{test} fails without a fault, or runs nothing, and is left out", flush=True)
                return
            reached[test] = found
            print(f"{test}: {found[0]:.1f} s, {sum(map(len, found[1].values()))} lines", flush=True)
            with open(f"{kept}.new", "w", encoding="utf-8") as file:
                json.dump(reached, file)
            os.replace(f"{kept}.new", kept)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for done in [pool.submit(measure, test) for test in names or tests_of(folder) if test not in reached]:
            done.result()
    return reached


class Tree:
    """A copy of the commit, built, in which one fault at a time is tried."""

    def __init__(self, folder, most_seconds):
        self.folder, self.most_seconds = folder, most_seconds
        copy_of_commit(folder)
        with open(f"{folder}/Makefile", encoding="utf-8") as file:
            self.makefile = file.read()
        with open(f"{folder}/tests/long.txt", encoding="utf-8") as file:
            self.long = {line.split(" ")[0] for line in file}
        built = run(["make", "-s", "counted", "CFLAGS=-O2", "WERROR=-Werror"], folder)
        if built.returncode:
            raise SystemExit(built.stdout[-2000:])

    def make(self, *targets):
        return run(["make", "-s", "-j1", "CFLAGS=-O2", "WERROR=-Werror", *targets], self.folder)

    def try_fault(self, fault, reached):
        """None: it is none. Else the test that notices, "" where none does, and the seconds of all that it met."""
        source = f"{self.folder}/{fault.file}"
        target = f"build/{fault.file[:-2]}.o"
        with open(source, encoding="utf-8") as file:
            text = file.read()
        with open(f"{self.folder}/{target}", "rb") as file:
            as_it_was = file.read()
        lines = text.split("\n")
        lines[fault.number - 1] = fault.after
        try:
            with open(source, "w", encoding="utf-8") as file:
                file.write("\n".join(lines))
            os.unlink(f"{self.folder}/{target}")  # times of files are too coarse to tell which is newer
            if self.make(target).returncode:
                return None
            with open(f"{self.folder}/{target}", "rb") as file:
                if file.read() == as_it_was:
                    return None
            noticed, spent = self.meet(fault, reached)
            return noticed or self.meet_sanitized(fault, target, reached), spent
        finally:
            with open(source, "w", encoding="utf-8") as file:
                file.write(text)
            if os.path.exists(f"{self.folder}/{target}"):
                os.unlink(f"{self.folder}/{target}")
            self.make(target)

    def tests_that_run(self, fault, reached):
        """Those that run the line, or where gcov knows none, as in tables and behind the first line of a statement, the next one
        above within the statement; else all that run any of the file, or of a file of tables alone, of its room."""
        with open(f"{self.folder}/{fault.file}", encoding="utf-8") as file:
            lines = file.read().split("\n")
        known = {number for _, files in reached.values() for number in files.get(fault.file, ())}
        at = fault.number
        while at not in known and at > 1 and lines[at - 2].startswith("  ") and not re.search(r"[;{}]\s*(/\*.*)?$", lines[at - 2]):
            at -= 1
        if at in known:
            tests = [t for t in reached if at in reached[t][1].get(fault.file, ())]
            if fault.file.startswith("sim/hdf5/"):  # what reads files is a process of its own, whose counters are lost
                tests += [t for t in reached if t not in tests and reached[t][1].get("sim/hdf5/h5_apart.c")]
            return tests
        room = os.path.dirname(fault.file)
        return ([t for t in reached if reached[t][1].get(fault.file)]
                or [t for t in reached if any(os.path.dirname(file) == room for file in reached[t][1])])

    def in_order(self, fault, reached):
        """A test named like the file is likelier to notice, and so is one of whose lines many are there; a script takes the time to
        link the programs, too."""
        words = set(re.split(r"\W+|_", fault.file[:-2]))

        def seconds_a_share(test):
            seconds, files = reached[test]
            share = len(files.get(fault.file, ())) / sum(map(len, files.values()))
            return (seconds + (0.3 if self.is_program(test) else 3)) / (share + 1e-6) / (3 if words & set(test.split("_")) else 1)

        return sorted(self.tests_that_run(fault, reached), key=seconds_a_share)

    def is_program(self, test):
        return os.path.exists(f"{self.folder}/build/tests/{test}")

    def fails(self, test, reached, *settings):
        """What notices, "" where nothing does, and the seconds. Of a script under sanitizers it is their report: of one file alone, the
        rest does not know of them. They cannot look for leaks in sandboxes."""
        program, environment = self.is_program(test), dict(os.environ)
        if self.make(*([f"build/tests/{test}"] if program else ["all"]), *settings).returncode:
            return "the linker", 0
        if settings and not program:
            environment["ASAN_OPTIONS"] = "detect_leaks=0"
        done = run(["tests/run.sh", "build", test], self.folder, 2 * reached[test][0] + 10, env=environment)
        good = done is not None and (not done.returncode or
                                     (settings and not program and not re.search("AddressSanitizer|runtime error:", done.stdout)))
        return "" if good else test, seconds_of(done)

    def meet(self, fault, reached):
        spent = 0
        for test in self.in_order(fault, reached):
            if spent > self.most_seconds:
                break
            noticed, seconds = self.fails(test, reached)
            spent += seconds
            if noticed:
                return noticed, spent
        return "", spent

    def has_own_allocator(self, test):
        """Such a program does not go together with the sanitizers' own, unless compiled with them, too."""
        return bool(re.search(rf"^with_{test} = .*(fail_alloc|with_test_allocations)", self.makefile, re.M))

    def meet_sanitized(self, fault, target, reached):
        os.unlink(f"{self.folder}/{target}")
        if self.make(target, *SANITIZED).returncode:
            return ""
        order = self.in_order(fault, reached)
        programs = [t for t in order if self.is_program(t) and not self.has_own_allocator(t)]
        scripts = [t for t in order if not self.is_program(t) and t not in self.long and t not in LITTLE_MEMORY]
        for test in programs[:SANITIZED_TESTS] + scripts[:SANITIZED_SCRIPTS]:
            noticed = self.fails(test, reached, *SANITIZED)[0]
            if noticed:
                return f"{noticed}, sanitized"
        return ""


def main():
    ask = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    ask.add_argument("--count", type=int, default=100)
    ask.add_argument("--seed", type=int, default=1)
    ask.add_argument("--work", default="build-mutants", help="folder for copies of the commit, and for the map; default: %(default)s")
    ask.add_argument("--jobs", type=int, default=os.cpu_count(), help="faults tried at a time; default: a core each")
    ask.add_argument("--tests", nargs="+", help="only these, not all; kept with the map")
    ask.add_argument("--seconds", type=float, default=60, help="of CPU, of tests for one fault; default: %(default)g")
    ask.add_argument("--again", metavar="LOG", help="output of an earlier run: only its survivors")
    ask.add_argument("rooms", nargs="*", default=["sim", "render"])
    said = ask.parse_args()
    with open("tests/mutants.txt", encoding="utf-8") as file:
        harmless = {line.split(" # ")[0].strip() for line in file if line.strip() and not line.startswith("#")}
    reached = measure_map(said.work, said.tests, said.jobs)
    files = sorted(f for f in subprocess.run(["git", "ls-files", *said.rooms], capture_output=True, text=True, check=True).stdout.split()
                   if f.endswith(".c") and not f.startswith("sim/cli/beadsim"))
    all_faults = [fault for file in files for fault in possible(file)]
    random.Random(said.seed).shuffle(all_faults)
    if said.again:
        with open(said.again, encoding="utf-8") as file:
            survivors = {re.sub(r":\d+: ", ": ", line.split(" s  ", 1)[1].strip()) for line in file if line.startswith("SURVIVED")}
        all_faults = [fault for fault in all_faults if fault.key() in survivors]
    todo = (fault for fault in all_faults if fault.key() not in harmless)
    lock, results = threading.Lock(), []

    def work(number):
        tree = Tree(f"{said.work}/tree{number}", said.seconds)
        while True:
            with lock:
                fault = next(todo, None) if len(results) < said.count else None
            if fault is None:
                return
            found = tree.try_fault(fault, reached)
            if found is None:
                continue
            with lock:
                if len(results) < said.count:
                    results.append((fault, *found))
                    print(f"{found[0] or 'SURVIVED':24} {found[1]:5.1f} s  {fault}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(said.jobs) as pool:
        for done in [pool.submit(work, number) for number in range(said.jobs)]:
            done.result()
    print("\nSurvivors:")
    rooms = {}
    for fault, test, _ in results:
        room = rooms.setdefault(os.path.dirname(fault.file), [0, 0])
        room[0] += bool(test)
        room[1] += 1
        if not test:
            print(f"  {fault}")
    print("\nNoticed, by room:")
    for room, (noticed, count) in sorted(rooms.items()):
        print(f"  {room:20} {noticed:4} of {count:4}")
    print(f"{sum(bool(r[1]) for r in results)} of {len(results)} noticed, "
          f"{sum(r[2] for r in results) / max(len(results), 1):.1f} s of CPU a fault")


main()
