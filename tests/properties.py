#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that every scene has, on scenes drawn at random: tests/properties.py BEADSIM [CASES], CASES of each, 20 by default.

The seed is fixed: equal cases in every run. What fails is shrunk to the smallest scene, which is printed; it then belongs into the
suite as an example of its own. Prints TAP."""
import json
import os
import subprocess
import sys
import tempfile
import time

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from tap import finish, ok

BEADSIM = sys.argv[1]
CASES = int(sys.argv[2]) if len(sys.argv) > 2 else 20
WORK = tempfile.TemporaryDirectory(prefix="beadreel-properties-", dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)


# ---- scenes ----

def numbers(low, high):
    """To four digits, so that what fails is read easily."""
    return st.floats(low, high).map(lambda x: float(f"{x:.4g}"))


@st.composite
def material_maps(draw):
    return {name: {"mass": draw(numbers(1e-4, 1e-2)), "radius": draw(numbers(2e-3, 1e-2)), "modulus": draw(numbers(1e9, 2e11)),
                   "poisson": draw(numbers(0, 0.45))} for name in "abc"}


kinds = st.sampled_from("abc")
segments = st.lists(st.fixed_dictionaries({"cell": st.lists(kinds, min_size=1, max_size=3), "count": st.integers(1, 5)}), min_size=1,
                    max_size=3)


@st.composite
def scenes(draw, wall=True):
    """A chain of 1 to 45 beads of up to three materials, struck at its left end."""
    chain = {"striker": {"bead": draw(kinds), "velocity": draw(numbers(0.05, 2))}, "beads": draw(segments)}
    if wall and draw(st.booleans()):
        chain["wall"] = draw(st.sampled_from(["rigid", "brass", "ptfe"]))
    return {"materials": draw(material_maps()), "chain": chain, "simulate": {"accuracy": 1e-9, "until": "300 us"},
            "outputs": [{"table": "peaks.csv", "show": "peaks"}]}


def text_of(scene):
    """As the scene's file has it: numbers have units, and YAML reads JSON."""
    units = {"mass": "kg", "radius": "m", "modulus": "Pa", "velocity": "m/s"}

    def value(key, x):
        if isinstance(x, dict):
            return {k: value(k, v) for k, v in x.items()}
        if isinstance(x, list):
            return [value("", v) for v in x]
        return f"{x!r} {units[key]}" if key in units and isinstance(x, float) else x

    return json.dumps(value("", scene), indent=1)


def run(*arguments):
    done = subprocess.run([BEADSIM, *arguments], capture_output=True, text=True, check=False, timeout=120)
    if done.returncode:
        raise AssertionError(f"{' '.join(arguments)}: {done.stderr}")


def play(scene, *arguments):
    """The files that it makes: {name: bytes}."""
    with tempfile.TemporaryDirectory(dir=WORK.name) as folder:
        with open(f"{folder}/scene.yaml", "w", encoding="utf-8") as file:
            file.write(scene if isinstance(scene, str) else text_of(scene))
        run(f"{folder}/scene.yaml", "-o", f"{folder}/out", "-q", *arguments)
        return contents(f"{folder}/out")


def contents(folder):
    found = {}
    for name in os.listdir(folder):
        with open(f"{folder}/{name}", "rb") as file:
            found[name] = file.read()
    return found


def rows(table):
    lines = table.decode().splitlines()
    return [dict(zip(lines[0].split(","), line.split(","))) for line in lines[1:]]


def peaks(scene):
    """{contact: (force, time, state)}"""
    return {int(row["contact"]): (float(row["peak_force_N"]), float(row["time_s"] or "nan"), row["state"])
            for row in rows(play(scene)["peaks.csv"])}


def same_peaks(one, other, forces=1.0, times=1.0, place=lambda k: k):
    """Peaks of `other` are those of `one` times these factors, to what both runs say that they know: 1e-9, and a hundred times more
    where errors of one are those of rounding, grown by the collisions of the chain. Flat maxima: a time is known less well."""
    assert len(one) == len(other)
    largest = max(force for force, _, _ in one.values())
    for contact, (force, at, state) in one.items():
        force2, at2, state2 = other[place(contact)]
        if state or state2 or force < 1e-3 * largest:
            continue
        assert abs(force2 / (forces * force) - 1) < 1e-7, (contact, force, force2)
        assert abs(at2 - times * at) < 1e-4 * times * at, (contact, at, at2)


# ---- properties ----

@given(scenes())
def units_do_not_matter(scene):
    """What one unit says, another says too."""
    other = text_of(scene)
    powers = {" kg": (" g", 3), " m/s": (" mm/s", 3), " m": (" mm", 3), " Pa": (" GPa", -9)}
    for before, (after, power) in powers.items():
        parts = other.split(f'{before}"')
        for i, part in enumerate(parts[:-1]):
            head, quote, number = part.rpartition('"')
            parts[i] = f"{head}{quote}{float(number)!r}e{power}" if "e" not in number else f"{head}{quote}{float(number) * 10.0**power!r}"
        other = f'{after}"'.join(parts)
    same_peaks(peaks(scene), peaks(other))


@given(scenes(), numbers(0.25, 4), numbers(0.5, 2), numbers(0.5, 2), numbers(0.5, 2))
def forces_and_times_scale(scene, speed, size, modulus, density):
    """Hertz's law has no scale: d ~ (m v^2 / A)^(2/5), F = A d^(3/2), t ~ d / v; A ~ modulus size^(1/2), m ~ density size^3."""
    scene["chain"].pop("wall", None)
    times = speed ** -0.2 * size * modulus ** -0.4 * density ** 0.4
    other = json.loads(json.dumps(scene))
    other["chain"]["striker"]["velocity"] *= speed
    for material in other["materials"].values():
        material["mass"] *= density * size ** 3
        material["radius"] *= size
        material["modulus"] *= modulus
    other["simulate"]["until"] = f"{300 * times!r} us"
    same_peaks(peaks(scene), peaks(other), speed ** 1.2 * size ** 2 * modulus ** 0.4 * density ** 0.6, times)


@given(scenes(wall=False))
def mirrored_chains_are_alike(scene):
    """Struck at the right end by the same bead, the mirrored chain has the mirrored peaks."""
    chain = scene["chain"]
    beads = [chain["striker"]["bead"]] + [b for s in chain["beads"] for _ in range(s["count"]) for b in s["cell"]]
    speed = chain["striker"]["velocity"]
    beads.reverse()
    other = dict(scene, chain={"striker": {"bead": beads[0]}, "beads": [{"bead": b} for b in beads[1:]],
                               "start": [{"bead": 0, "velocity": "0 m/s"}, {"bead": "last", "velocity": f"{-speed!r} m/s"}]})
    contacts = len(beads) - 1
    same_peaks(peaks(scene), peaks(other), place=lambda k: contacts - 1 - k)


@given(scenes())
def cells_may_be_written_twice(scene):
    """A cell of twice the beads, half as often; and each bead by itself: the same bytes."""
    twice, each = json.loads(json.dumps(scene)), json.loads(json.dumps(scene))
    for segment, doubled in zip(scene["chain"]["beads"], twice["chain"]["beads"]):
        segment["count"] *= 2
        doubled["cell"] = doubled["cell"] * 2
    each["chain"]["beads"] = [{"bead": b} for s in scene["chain"]["beads"] for _ in range(s["count"]) for b in s["cell"]]
    found = play(scene)
    assert found == play(twice)
    assert found == play(each)


MANY = [{"table": "peaks.csv", "show": "peaks"}, {"table": "beads.csv", "show": "bead-peaks"},
        {"table": "sensors.csv", "show": "sensors", "contacts": [0], "every": "2 us"},
        {"table": "extremes.csv", "show": "extremes", "field": "velocity", "every": "4 us"},
        {"table": "energy.csv", "show": "energy", "every": "8 us"}, {"table": "chain.csv", "show": "chain"},
        {"table": "spreading.csv", "show": "spreading", "every": "16 us"},
        {"table": "profiles.csv", "show": "profiles", "field": "velocity", "at": ["2 us", "256 us"]}]
# Spacings are exact multiples of each other, so that a common grid rounds times alike.
SAMPLED = ("sensors.csv", "extremes.csv", "energy.csv", "chain.csv", "spreading.csv")


def close(one, other):
    """Are the values of two tables of peaks or profiles the same to 1e-7 of the largest?"""
    name = "peak_force_N" if b"peak_force_N" in one else "velocity_m/s"
    a, b = ([float(row[name]) for row in rows(table)] for table in (one, other))
    largest = max(abs(x) for x in a)
    return len(a) == len(b) and all(abs(x - y) <= 1e-7 * largest for x, y in zip(a, b))


@given(scenes(), st.permutations(MANY), st.integers(1, 4), st.integers(0, len(MANY) - 1))
def outputs_do_not_know_each_other(scene, order, threads, only):
    """Their order and the number of threads change no byte; nor does the others' presence, where a table is one of samples. A run
    for peaks or profiles alone ends when these are known, by another last step."""
    scene["outputs"] = MANY
    found = play(scene)
    scene["outputs"] = order
    again = play(scene, "--threads", str(threads))
    assert [name for name in found if found[name] != again.get(name)] == []
    name = MANY[only]["table"]
    alone = play(scene, "--only", name)
    assert list(alone) == [name] and (alone[name] == found[name] if name in SAMPLED else close(found[name], alone[name]))


@given(st.integers(2, 10), st.integers(1, 3), st.integers(1, 999), st.integers(2, 4), st.booleans())
def parts_make_the_whole(cells, configurations, seed, parts, decay):
    """A sweep in parts, merged in another order, is the whole one, byte by byte."""
    measure = {"peak": "none", "decay": True} if decay else {"peak": "force", "sensor": ["first", "second"]}
    scene = {"sweep": {"configurations": configurations, "seed": seed, "magnetism": [0, 0.5], "measure": measure},
             "outputs": [{"sweep": "s.h5"}]}
    if decay:
        scene["sweep"]["cells"] = 2 * cells
    else:
        scene["chain"] = {"beads": [{"cell": ["large-steel", "aluminium"], "count": 2 * cells, "spins": "random"},
                                    {"bead": "small-steel", "sensor": "first"}, {"bead": "large-steel", "count": 3},
                                    {"bead": "small-steel", "sensor": "second"}, {"bead": "large-steel", "count": 5}]}
    whole = play(scene)["s.h5"]
    with tempfile.TemporaryDirectory(dir=WORK.name) as folder:
        names = []
        with open(f"{folder}/scene.yaml", "w", encoding="utf-8") as file:
            file.write(text_of(scene))
        for part in range(parts, 0, -1):
            run(f"{folder}/scene.yaml", "-o", folder, "-q", "--shard", f"{part}/{parts}")
            names.append(f"{folder}/s.{part}of{parts}.h5")
        run("--merge", *names, "-o", f"{folder}/merged.h5")
        with open(f"{folder}/merged.h5", "rb") as file:
            assert file.read() == whole


@given(scenes(), st.integers(1, 9), st.sampled_from(["force", "contact-force", "velocity", "displacement"]))
def trajectories_say_it_again(scene, every, field):
    """A table made from the trajectory is the one made at once: to the bit for displacements and what follows from them."""
    times = f"{every} us"
    scene["outputs"] = [{"trajectory": "run.h5", "every": times, "fields": ["displacement", "velocity"]},
                        {"table": "extremes.csv", "show": "extremes", "field": field, "every": times, "uncertainty": False},
                        {"table": "profiles.csv", "show": "profiles", "field": field, "at": [times, f"{2 * every} us"],
                         "uncertainty": False}]
    with tempfile.TemporaryDirectory(dir=WORK.name) as folder:
        with open(f"{folder}/scene.yaml", "w", encoding="utf-8") as file:
            file.write(text_of(scene))
        run(f"{folder}/scene.yaml", "-o", f"{folder}/out", "-q")
        once = contents(f"{folder}/out")
        for name in ("extremes.csv", "profiles.csv"):
            run(f"{folder}/out/run.h5", "-o", f"{folder}/{name}", "-q")
            with open(f"{folder}/{name}", "rb") as file:
                assert file.read() == once[name], name


@given(scenes(), st.integers(1, 8), st.integers(2, 4))
def coarse_samples_are_among_the_fine(scene, every, step):
    """Every second, third, ... sample of a finer table is the coarser table, but for uncertainties, which are the largest so far."""
    scene["outputs"] = [{"table": f"{name}.csv", "show": "sensors", "contacts": [0], "every": f"{spacing} us", "uncertainty": False}
                        for name, spacing in (("fine", every), ("coarse", step * every))]
    found = {name: table.splitlines() for name, table in play(scene).items()}
    fine, coarse = found["fine.csv"][1:], found["coarse.csv"][1:]
    assert len(coarse) == (len(fine) + step - 1) // step
    assert coarse == fine[::step]


@given(scenes(wall=False))
def energy_and_momentum_are_kept(scene):
    """The striker's, by all beads: sum m v, and energies of beads, at random times."""
    scene["outputs"] = [{"table": "chain.csv", "show": "chain"},
                        {"table": "v.csv", "show": "profiles", "field": "velocity", "at": ["3 us", "37 us", "299 us"]},
                        {"table": "u.csv", "show": "profiles", "field": "displacement", "at": ["3 us", "37 us", "299 us"]},
                        {"table": "e.csv", "show": "profiles", "field": "energy", "at": ["3 us", "37 us", "299 us"]}]
    found = {name: rows(table) for name, table in play(scene).items()}
    masses = [float(row["mass_kg"]) for row in found["chain.csv"]]
    speed = scene["chain"]["striker"]["velocity"]
    for moment in sorted({row["time_s"] for row in found["v.csv"]}):
        v, u, e = ([float(row[column]) for row in found[name] if row["time_s"] == moment]
                   for name, column in (("v.csv", "velocity_m/s"), ("u.csv", "displacement_m"), ("e.csv", "energy_J")))
        assert len(v) == len(masses)
        momentum = masses[0] * speed
        assert abs(sum(m * x for m, x in zip(masses, v)) - momentum) < 1e-12 * momentum
        assert abs(sum(m * x for m, x in zip(masses, u)) - momentum * float(moment)) < 1e-11 * momentum * float(moment)
        energy = 0.5 * masses[0] * speed ** 2
        assert abs(sum(e) - energy) < 1e-7 * energy, (moment, sum(e), energy)


EXPONENTS = {"m/s": 1, "N": 1.2, "m": 0.8, "J": 2, "kg m/s": 1, "1/s": 0.2, "s": -0.2}
OTHER = {"front speed": 0.2, "local front speed": 0.2, "strike / bar speed": 1, "compression / radius": 0.8,
         "pressure / yield strength": 0.4}


BETWEEN = ("striker's contact time", "striker's compression", "compression / radius", "pressure / yield strength")  # of samples


@given(numbers(0.01, 0.5), numbers(1.5, 30), st.sampled_from([1.0, 2.5, 6.0]))
def measures_scale_with_the_strike(speed, factor, heavy):
    """v by a: forces by a^1.2, times by a^-.2, all else by its unit; ratios stay, among them those of a train of pulses."""
    def measures(velocity):
        scene = {"materials": {"a": {"mass": 2e-3, "radius": 5e-3, "modulus": 7e10, "poisson": 0.3},
                               "hammer": {"mass": 2e-3 * heavy, "radius": 5e-3, "modulus": 7e10, "poisson": 0.3}},
                 "chain": {"striker": {"bead": "hammer", "velocity": velocity}, "beads": [{"cell": ["a"], "count": 120}]},
                 "simulate": {"accuracy": 1e-8}, "outputs": [{"table": "m.csv", "show": "measures"}]}
        return {row["name"]: (float(row["value"]), row["unit"]) for row in rows(play(scene)["m.csv"])}

    assume(speed * factor < 2)
    slow, fast = measures(speed), measures(speed * factor)
    names = {n for n in slow if not n.startswith(("front arrival", "participation", "clean", "decay", "striker's velocity"))}
    assert names <= set(fast) and len(names) > 20
    for name in names:
        value, unit = slow[name]
        by = factor ** OTHER.get(name, EXPONENTS.get(unit, 0))
        tolerance = 1e-3 if "1 %" in name or "ahead" in name or "pulse" in name else 2e-4 if name in BETWEEN else 1e-5
        assert abs(fast[name][0] - by * value) <= tolerance * abs(by * value), (name, value, fast[name][0], by)


# ---- what the plan allows is made ----

DEFINITIONS = json.load(open("assets/scene.schema.json", encoding="utf-8"))["definitions"]
STRUCK = {"chain": {"beads": [{"cell": ["large-steel", "aluminium"], "count": 4}, {"bead": "small-steel", "sensor": "a"}],
                    "wall": "brass"}}
SWEPT = {**STRUCK, "sweep": {"over": {"chain.striker.velocity": ["0.1 m/s", "0.3 m/s"], "chain.wall": ["rigid", "none"]}}}
WORDS = [0, 1, 3, 9, 20, -1, 1e-3, "0.1 ms", "5 ms", ["0 ms", "0.1 ms"], ["0.05 ms", "5 ms"], [8, 12], [20, 30], [0, 1], [30, 20],
         "auto", "last", "all", "log", "velocity", "contact-force", ["0 Hz", "5 kHz"], ["5 kHz", "2 kHz"], "front speed", "sepia"]


def words_of(key):
    """Words and examples of the schema."""
    while "$ref" in key:
        key = DEFINITIONS[key["$ref"].split("/")[-1]]
    found = key.get("enum", []) + key.get("examples", []) + [True, False] * (key.get("type") == "boolean")
    for other in key.get("anyOf", []) + key.get("oneOf", []):
        found = found + words_of(other)
    return found


@st.composite
def asked(draw):
    """A scene with one output of any kind, right or wrong."""
    scene = draw(st.sampled_from([STRUCK, SWEPT]))
    kind, ending = draw(st.sampled_from([("plot", "svg"), ("table", "csv"), ("image", "png")]))
    keys = DEFINITIONS[f"outputs:{kind}{'-of-a-sweep' if scene is SWEPT else ''}"]["properties"]
    output = {kind: f"f.{ending}"}
    for key in draw(st.lists(st.sampled_from(sorted(set(keys) - {kind, "panels", "measured"})), max_size=3, unique=True)):
        output[key] = draw(st.sampled_from(words_of(keys[key]) * 3 + WORDS))
    return {**scene, "simulate": {"until": draw(st.sampled_from(["0.1 ms", "1 ms"]))}, "outputs": [output]}


@given(asked())
def what_a_plan_allows_is_made(scene):
    with tempfile.TemporaryDirectory(dir=WORK.name) as folder:
        with open(f"{folder}/scene.yaml", "w", encoding="utf-8") as file:
            json.dump(scene, file)
        command = [BEADSIM.replace("beadsim", "beadreel"), f"{folder}/scene.yaml", "-o", f"{folder}/out", "-q"]
        plan, made = (subprocess.run([*command, *more], capture_output=True, text=True, check=False, timeout=120)
                      for more in (["--plan"], []))
        assert plan.returncode == made.returncode, (scene["outputs"], plan.stderr, made.stderr)


def main():
    tests = [units_do_not_matter, forces_and_times_scale, mirrored_chains_are_alike, cells_may_be_written_twice,
             outputs_do_not_know_each_other, parts_make_the_whole, trajectories_say_it_again, coarse_samples_are_among_the_fine,
             energy_and_momentum_are_kept, measures_scale_with_the_strike, what_a_plan_allows_is_made]
    how = settings(max_examples=CASES, derandomize=CASES <= 20, database=None, deadline=None,
                   suppress_health_check=list(HealthCheck))
    for test in tests:
        began = time.time()
        try:
            how(test)()
            ok(True, test.__name__)
            if CASES > 20:
                print(f"# {time.time() - began:.1f} s", flush=True)
        except Exception as error:  # pylint: disable=broad-except
            ok(False, test.__name__, f"{type(error).__name__}: {error}", *getattr(error, "__notes__", []))
    finish()


main()
