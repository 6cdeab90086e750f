# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact results: collisions, statics, small motion by eigenvectors, similarity; and the solitary wave by its own equation."""
import math

import numpy as np

from chains import Chain, apart, computed, peaks, state

STEEL, ALUMINIUM = ("steel", 4.76e-3, 3.63e-3), ("aluminium", 4.76e-3, 1.26e-3)
# Contact time times the speed, in units of the largest compression: twice the integral of dx / sqrt(1 - x^(5/2)) from 0 to 1.
DURATION = 0.8 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9)


def ball(material, radius, density):
    return material, radius, density * 4 / 3 * math.pi * radius**3


def relative(value, expected):
    return abs(value / expected - 1)


def measures(beadsim, chain, end, **table):
    rows = computed(beadsim, chain, end, [{"show": "measures", **table}])[0]
    return {row["name"]: float(row["value"]) for row in rows if row["value"]}


def collision(beadsim, chain):
    """Two balls: energy at rest against each other is m v^2/2 = 2/5 A d^(5/2), m the reduced mass."""
    (m, n), (stiffness,), v = chain.masses, chain.stiffnesses(), chain.velocity
    squeezed = (5 * m * n / (m + n) * v**2 / (4 * stiffness)) ** 0.4
    duration = DURATION * squeezed / v
    end = 1.5 * duration
    found = measures(beadsim, chain, end)
    yield "largest force", relative(peaks(beadsim, chain, end)[0], stiffness * squeezed**1.5)
    yield "contact time", relative(found["striker's contact time"], duration)
    yield "velocities after", apart(state(beadsim, chain, end)[1], [(m - n) / (m + n) * v, 2 * m / (m + n) * v])


def statics(beadsim):
    chain = Chain([STEEL, ALUMINIUM, ball("ptfe", 2.38e-3, 2200), ("steel", 2.38e-3, 0.45e-3)], 0.1, "brass", 20.0, math.radians(60))
    rows = computed(beadsim, chain, 1e-5, [{"show": "chain"}])[0]
    column = next(name for name in rows[0] if name.startswith("stiffness"))
    yield "stiffness of contacts, the wall's too", max(map(relative, [float(row[column]) for row in rows], chain.stiffnesses()))
    yield "precompression and weight", max(map(relative, [float(row["static_force_N"]) for row in rows], chain.static_forces()))


def small_motion(beadsim, kinds, velocity, press=20.0, count=24, time=1e-3):
    """Velocities of a precompressed chain, against the sum of its linear modes, for a slow striker. Largest relative difference."""
    chain = Chain((list(kinds) * count)[:count], velocity, precompression=press)
    mass = np.array(chain.masses)
    spring = 1.5 * np.array(chain.stiffnesses()) ** (2 / 3) * press ** (1 / 3)
    matrix = np.diag(np.append(spring, 0) + np.append(0, spring)) - np.diag(spring, 1) - np.diag(spring, -1)
    squares, modes = np.linalg.eigh(matrix / np.sqrt(np.outer(mass, mass)))
    part = modes[0] * math.sqrt(mass[0]) * velocity
    speeds = modes @ (part * np.cos(np.sqrt(np.maximum(squares, 0)) * time)) / np.sqrt(mass)
    return apart(state(beadsim, chain, time)[1], list(speeds))


def similarity(beadsim, factor=1000.0):
    """Striking 1000 times as fast makes forces larger by 1000^(6/5)."""
    kinds = [STEEL, ALUMINIUM, ALUMINIUM, STEEL, STEEL, ALUMINIUM] * 5
    slow, fast = (peaks(beadsim, Chain(kinds, v), 1.5e-3 * v**-0.2) for v in (0.01, 0.01 * factor))
    return apart([force / factor**1.2 for force in fast], slow)


def solitary_wave(points=4096, half=16.0):
    """Compressions r(x) with c^2 r'' = s(x - 1) - 2 s + s(x + 1), s = r^(3/2), for c = m = A = spacing = 1, by Petviashvili's
    iteration of R = S sinc^2(k / 2) in Fourier space. Then c / F^(1/6), and widths at half height of the force and the velocity.
    """
    x = (np.arange(points) - points // 2) * 2 * half / points
    k = 2 * math.pi * np.fft.rfftfreq(points, 2 * half / points)
    sinc, r = np.sinc(k / (2 * math.pi)), 1.5 * np.exp(-(x**2))
    for _ in range(200):
        before, after = np.fft.rfft(r), sinc**2 * np.fft.rfft(r**1.5)
        r = np.maximum(np.fft.irfft(after * (np.vdot(before, before) / np.vdot(before, after)).real ** 3, points), 0)
    # m v' is the difference of the forces on both sides: V = S sinc(k / 2), half a spacing aside.
    speed = np.fft.irfft(sinc * np.fft.rfft(r**1.5), points)
    return r.max() ** -0.25, width(x, r**1.5), width(x, speed)


def width(x, pulse):
    """At half height, by a polynomial of degree 7 through the eight points about it."""
    there = np.flatnonzero(pulse > pulse.max() / 2)[-1] + np.arange(-3, 5)
    return 2 * np.polyval(np.polyfit((pulse[there] - pulse.max() / 2) / pulse.max(), x[there], 7), 0)


def wave_in_chain(beadsim):
    """The same of a wave along 100 steel balls. Widths are read between samples: those of every 2 us, which the program takes if not
    told, leave 2e-8 to 4e-7 of them, as the pulse happens to lie.
    """
    chain = Chain([STEEL] * 101, 0.4)
    rows = computed(beadsim, chain, "auto", [{"show": "peaks"}])[0]
    found = measures(beadsim, chain, "auto", every=0.25e-6)
    times, force = [float(row["time_s"]) for row in rows], float(rows[70]["peak_force_N"])
    beats = (80 - 60) / (times[80] - times[60]) * math.sqrt(STEEL[2]) / chain.stiffnesses()[0] ** (1 / 3)
    return beats / force ** (1 / 6), found["force width"], found["velocity width"]


def compare(beadsim):
    """(what, difference, the most it may be)"""
    glass, limestone = ball("glass", 0.01, 2800), ball("limestone", 0.01, 2500)
    for name, chain in (("glass balls at 20 m/s", Chain([glass] * 2, 20.0)), ("limestone balls at 20 m/s", Chain([limestone] * 2, 20.0)),
                        ("steel on aluminium, 0.01 m/s", Chain([STEEL, ALUMINIUM], 0.01))):
        for what, difference in collision(beadsim, chain):
            yield f"{name}: {what}", difference, 1e-6 if what == "contact time" else 1e-11
    for what, difference in statics(beadsim):
        yield f"4 balls on a slope, pressed with 20 N, and a wall: {what}", difference, 1e-14
    for name, kinds in (("steel balls", [STEEL]), ("steel and aluminium in turn", [STEEL, ALUMINIUM])):
        for velocity, most in ((1e-3, 1e-2), (1e-5, 1e-4), (1e-7, 1e-6)):
            difference = small_motion(beadsim, kinds, velocity)
            yield f"24 {name}, pressed with 20 N, struck at {velocity:g} m/s: sum of linear modes", difference, most
    yield "30 balls struck 1000 times as fast: forces 1000^(6/5) times as large", similarity(beadsim), 1e-11
    wave = zip(("speed / F^(1/6)", "width of the force", "width of the velocity"), wave_in_chain(beadsim), solitary_wave(), strict=True)
    for what, value, expected in wave:
        yield f"solitary wave, from its own equation: {what}, {expected:.10f}", relative(value, expected), 1e-11
