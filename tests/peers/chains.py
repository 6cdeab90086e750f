# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains of the comparisons: their constants by the formulas of textbooks, not by the program, and what the program makes of them."""
import csv
import json
import math
import pathlib
import subprocess
import tempfile

GRAVITY = 9.80665

# Young's modulus in Pa, Poisson's ratio; thesis, Table 1, and Chung and Ooi (2011), tests 1 and 2.
MATERIALS = {
    "steel": (193e9, 0.30),
    "aluminium": (72.4e9, 0.33),
    "ptfe": (1.46e9, 0.46),
    "brass": (90.2e9, 0.34),
    "glass": (48e9, 0.20),
    "limestone": (20e9, 0.25),
    "rigid": (math.inf, 0.0),
}


class Chain:
    """Balls (material, radius in m, mass in kg), of which the first strikes the others at `velocity` m/s; all else as in scenes."""

    def __init__(self, balls, velocity, wall=None, precompression=0.0, tilt=0.0, damping=None):
        self.balls, self.velocity, self.wall = balls, velocity, wall
        self.precompression, self.tilt, self.damping = precompression, tilt, damping

    @property
    def masses(self):
        return [mass for _, _, mass in self.balls]

    def stiffnesses(self):
        """Of all contacts, the wall's last: 4/3 E sqrt(R), with Hertz's E and R of the pair."""
        sides = [(material, 1 / radius) for material, radius, _ in self.balls] + ([(self.wall, 0.0)] if self.wall else [])
        return [4 / 3 / (softness(a) + softness(b)) / math.sqrt(p + q) for (a, p), (b, q) in zip(sides, sides[1:])]

    def weight(self, mass):
        """Along the slope."""
        return mass * GRAVITY * math.sin(self.tilt)

    def static_forces(self):
        """Precompression, and the weight of the chain's balls above a contact; the striker has not landed yet."""
        above, forces = self.precompression, []
        for k in range(len(self.stiffnesses())):
            above += self.weight(self.masses[k]) if k else 0.0
            forces.append(above)
        return forces

    def scene(self, accuracy):
        kinds = {ball: f"ball-{i}" for i, ball in enumerate(dict.fromkeys(self.balls))}
        materials = {name: {"modulus": MATERIALS[m][0], "poisson": MATERIALS[m][1], "radius": r, "mass": mass}
                     for (m, r, mass), name in kinds.items()}
        if self.wall and self.wall != "rigid":
            materials["behind"] = {"modulus": MATERIALS[self.wall][0], "poisson": MATERIALS[self.wall][1]}
        names = [kinds[ball] for ball in self.balls]
        chain = {"striker": {"bead": names[0], "velocity": self.velocity}, "beads": [{"bead": name} for name in names[1:]],
                 "precompression": self.precompression, "tilt": self.tilt}
        if self.wall:
            chain["wall"] = "rigid" if self.wall == "rigid" else "behind"
        if self.damping:
            chain["damping"] = dict(zip(("coefficient", "exponent"), self.damping))
        return {"materials": materials, "chain": chain, "simulate": {"accuracy": accuracy}}


def softness(material):
    modulus, poisson = MATERIALS[material]
    return (1 - poisson**2) / modulus


def computed(beadsim, chain, end, tables, accuracy=1e-13):
    """The program's tables: [{"show": ...}, ...], each as a list of rows, mappings from header to text."""
    scene = chain.scene(accuracy)
    scene["simulate"]["until"] = end
    scene["outputs"] = [{"table": f"{i}.csv", **table} for i, table in enumerate(tables)]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.yaml").write_text(json.dumps(scene))
        command = [beadsim, folder / "scene.yaml", "-o", folder, "--progress", "none"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return [list(csv.DictReader((folder / table["table"]).open(newline=""))) for table in scene["outputs"]]


def state(beadsim, chain, time):
    """Displacements and velocities of the balls at a time."""
    tables = [{"show": "profiles", "field": field, "at": [time]} for field in ("displacement", "velocity")]
    places, speeds = computed(beadsim, chain, time, tables)
    return [float(row["displacement_m"]) for row in places], [float(row["velocity_m/s"]) for row in speeds]


def peaks(beadsim, chain, end):
    return [float(row["peak_force_N"]) for row in computed(beadsim, chain, end, [{"show": "peaks"}])[0]]


def apart(values, expected):
    """The largest difference, in units of the largest value expected."""
    return max(abs(a - b) for a, b in zip(values, expected, strict=True)) / max(map(abs, expected))
