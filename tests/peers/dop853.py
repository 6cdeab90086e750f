# SPDX-License-Identifier: GPL-3.0-or-later
"""SciPy's DOP853, from contact event to contact event, on cradles, walls, slopes, precompressed and damped chains."""
import math

import numpy as np
from scipy.integrate import solve_ivp

from chains import Chain, apart, peaks, state

TOLERANCE = 1e-13


class Motion:
    """u'' = F(u, u') / m; which contacts are closed changes only between calls of the solver."""

    def __init__(self, chain):
        self.mass, self.stiffness = np.array(chain.masses), np.array(chain.stiffnesses())
        self.wall = len(self.stiffness) == len(self.mass)
        static = np.array(chain.static_forces())
        self.rest = (static / self.stiffness) ** (2 / 3)
        # What presses the ends, and the weight: with the striker's left out, these hold the contacts' static forces.
        self.load = np.diff(np.concatenate(([0.0], static, [] if self.wall else [0.0])))
        self.load[0] += chain.weight(chain.masses[0])
        self.damping, self.exponent = chain.damping or (0.0, 1.0)
        self.closed = np.ones(len(self.stiffness), bool)
        self.largest = static

    def across(self, y):
        """Compressions of the contacts, and their rates."""
        u, v = np.split(y, 2)
        if self.wall:
            u, v = np.append(u, 0.0), np.append(v, 0.0)
        return self.rest - np.diff(u), -np.diff(v)

    def forces(self, y):
        d, rate = self.across(y)
        force = self.stiffness * np.maximum(d, 0) ** 1.5
        return force + self.damping * np.sign(rate) * np.abs(rate) ** self.exponent if self.damping else force

    def rates(self, _, y):
        force = np.where(self.closed, self.forces(y), 0.0)
        pushed = self.load - (force if self.wall else np.append(force, 0.0))
        pushed[1:] += force[: len(pushed) - 1]
        return np.concatenate((np.split(y, 2)[1], pushed / self.mass))

    def growth(self, y, change):
        """How fast the forces grow."""
        (d, rate), (_, faster) = self.across(y), self.across(change)
        damping = self.exponent * np.abs(rate) ** (self.exponent - 1) * faster if self.damping else 0.0
        return 1.5 * self.stiffness * np.sqrt(np.maximum(d, 0)) * rate + self.damping * damping

    def events(self):
        """A closed contact opens where its force would pull; an open one closes at a touch. Then, not ending the call, maxima."""

        def change(k):
            def value(_, y):
                return self.forces(y)[k] if self.damping and self.closed[k] else self.across(y)[0][k]

            value.terminal, value.direction = True, -1 if self.closed[k] else 1
            return value

        def maximum(k):
            def value(t, y):
                return self.growth(y, self.rates(t, y))[k]

            value.direction = -1
            return value

        contacts = range(len(self.closed))
        return [change(k) for k in contacts] + [maximum(k) for k in contacts]

    def run(self, y, end):
        n, time, scale = len(self.mass), 0.0, np.abs(y).max()
        # Balls that touch and approach close their contact.
        d, rate = self.across(y)
        self.closed = (d > 0) | ((d == 0) & (rate > 0))
        tolerance = TOLERANCE * np.repeat((1e-5, 1.0), n) * scale
        while time < end:
            part = solve_ivp(self.rates, (time, end), y, "DOP853", rtol=TOLERANCE, atol=tolerance, events=self.events())
            time, y = part.t[-1], part.y[:, -1]
            for peak in part.y_events[len(self.closed) :]:
                for there in peak:
                    self.largest = np.maximum(self.largest, np.where(self.closed, self.forces(there), 0.0))
            if part.status == 1:
                k = next(k for k, times in enumerate(part.t_events) if len(times) and k < len(self.closed))
                self.closed[k] = not self.closed[k]
        return y[n:]


def chains():
    """With the time of their end."""
    steel, light = ("steel", 4.76e-3, 3.63e-3), ("aluminium", 4.76e-3, 1.26e-3)
    for n in (2, 3, 4, 5):
        yield f"cradle of {n} steel balls", Chain([steel] * n, 1.0), 0.2e-3
    yield "cradle of 5 balls, steel and aluminium in turn", Chain([steel, light, steel, light, steel], 1.0), 0.3e-3
    yield "3 steel balls and a wall of brass", Chain([steel] * 3, 1.0, wall="brass"), 0.3e-3
    yield "3 steel balls and a rigid wall", Chain([steel] * 3, 1.0, wall="rigid"), 0.3e-3
    yield "5 steel balls on a slope of 10 degrees", Chain([steel] * 5, 0.1, wall="brass", tilt=math.radians(10)), 0.5e-3
    yield "6 balls pressed together with 20 N", Chain([steel, light] * 3, 0.5, wall="brass", precompression=20.0), 0.3e-3
    yield "2 balls, damping 50 N (s/m)^1.8", Chain([steel] * 2, 1.0, damping=(50.0, 1.8)), 0.1e-3
    yield "4 balls, damping 20 N s/m", Chain([steel] * 4, 1.0, damping=(20.0, 1.0)), 0.2e-3


def compare(beadsim):
    """(chain, largest difference of velocities at the end, of peak forces)"""
    for name, chain, end in chains():
        motion = Motion(chain)
        start = np.zeros(2 * len(chain.masses))
        start[len(chain.masses)] = chain.velocity
        speeds = motion.run(start, end)
        yield name, apart(state(beadsim, chain, end)[1], speeds), apart(peaks(beadsim, chain, end), motion.largest)
