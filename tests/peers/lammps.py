# SPDX-License-Identifier: GPL-3.0-or-later
"""LAMMPS (pair_style granular, Hertz's law from moduli, velocity Verlet) on balls in a line, at falling steps."""
import math
import pathlib
import random
import subprocess
import tempfile

from chains import MATERIALS, Chain, apart, softness, state

STEPS = [0.4e-6 / 2**k for k in range(10)]

SETTINGS = """units si
atom_style sphere
boundary f f f
newton off
atom_modify sort 0 0 map array
comm_modify vel yes
region box block -0.1 {end!r} -0.1 0.1 -0.1 0.1
create_box {types} box
{atoms}
velocity all set 0 0 0
set atom 1 vx {velocity!r}
neighbor 0.002 bin
pair_style granular
{pairs}
{wall}
fix motion all nve
timestep {step!r}
thermo 1000000
run {steps}
write_dump all custom state id x vx modify sort id format float %.17g
"""
CONTACT = "tangential linear_nohistory 0 0 damping velocity"


def places(chain):
    """Of centres, from the first ball's; and of the wall."""
    x, centres = 0.0, []
    for _, radius, _ in chain.balls:
        x += radius
        centres.append(x)
        x += radius
    return [centre - centres[0] for centre in centres], x - centres[0]


def deck(chain, time, step):
    kinds = list(dict.fromkeys(material for material, _, _ in chain.balls))
    centres, behind = places(chain)
    atoms = []
    for i, (centre, (material, radius, mass)) in enumerate(zip(centres, chain.balls), 1):
        atoms += [f"create_atoms {kinds.index(material) + 1} single {centre!r} 0 0",
                  f"set atom {i} diameter {2 * radius!r}", f"set atom {i} mass {mass!r}"]
    pairs = [f"pair_coeff {i} {i} hertz/material {MATERIALS[m][0]!r} 0 {MATERIALS[m][1]!r} {CONTACT}" for i, m in enumerate(kinds, 1)]
    # LAMMPS of 2021 damps pairs that it mixes itself.
    pairs += [f"pair_coeff {i} {j} hertz {4 / 3 / (softness(m) + softness(n))!r} 0 {CONTACT}"
              for i, m in enumerate(kinds, 1) for j, n in enumerate(kinds, 1) if i < j]
    wall = ""
    if chain.wall:
        modulus = 4 / 3 / (softness(chain.balls[-1][0]) + softness(chain.wall))
        wall = f"group last id {len(centres)}\nfix wall last wall/gran granular hertz {modulus!r} 0 {CONTACT} xplane NULL {behind!r}"
    return SETTINGS.format(end=behind + 0.1, types=len(kinds), atoms="\n".join(atoms), velocity=chain.velocity, pairs="\n".join(pairs),
                           wall=wall, step=step, steps=round(time / step))


def moved(chain, time, step):
    """Displacements and velocities at a time."""
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "in.chain").write_text(deck(chain, time, step))
        subprocess.run(["lmp", "-in", "in.chain", "-log", "none", "-screen", "none"], cwd=folder, check=True)
        rows = [line.split() for line in pathlib.Path(folder, "state").read_text().splitlines()[9:]]
    return [float(x) - start for (_, x, _), start in zip(rows, places(chain)[0], strict=True)], [float(v) for _, _, v in rows]


def three_chains():
    """With the time of their comparison."""
    large, light = ("steel", 4.76e-3, 3.63e-3), ("aluminium", 4.76e-3, 1.26e-3)
    yield "30 steel balls, back from a wall of brass", Chain([large] * 31, 1.0, wall="brass"), 0.8e-3
    spins = "1111110111011011100"
    dimers = [ball for spin in spins for ball in ((large, light) if spin == "1" else (light, large))]
    yield "19 steel:aluminium dimers, six reversed", Chain([large] + dimers, 0.443), 0.8e-3
    draw = random.Random(13)
    density = {"steel": 7800, "aluminium": 2700, "ptfe": 2200}
    balls = []
    for _ in range(20):
        material, radius = draw.choice(list(density)), round(draw.uniform(2e-3, 8e-3), 5)
        balls.append((material, radius, density[material] * 4 / 3 * math.pi * radius**3))
    yield "20 balls of three materials, radii 2 to 8 mm", Chain([large] + balls, 2.0), 1.2e-3


def extrapolated(coarse, fine):
    """Without the error of order 2: from a step and half of it."""
    return [(4 * b - a) / 3 for a, b in zip(coarse, fine, strict=True)]


def compare(beadsim):
    """(chain, time, [(step, difference of displacements, of velocities, of velocities extrapolated from this and the step before)])"""
    for name, chain, time in three_chains():
        ours, found, before = state(beadsim, chain, time), [], None
        for step in STEPS:
            theirs = moved(chain, time, step)
            better = apart(extrapolated(before, theirs[1]), ours[1]) if before else float("nan")
            found.append((step, apart(theirs[0], ours[0]), apart(theirs[1], ours[1]), better))
            before = theirs[1]
        yield name, time, found
