# SPDX-License-Identifier: GPL-3.0-or-later
"""Solve a problem of precision_stream with SciPy: precision_scipy.py FILE DOP853|LSODA TOLERANCE > stream.

Only the solver's own steps are timed, not writing them."""
import sys
import time

import numpy as np
from scipy.integrate import DOP853, LSODA


def main():
    problem = np.loadtxt(sys.argv[1])
    n, v0, early, end = int(problem[0, 0]), *problem[0, 1:]
    scale = problem[1, 0]
    mass, stiffness, d0, f0 = problem[2:].T
    solver_class = {"DOP853": DOP853, "LSODA": LSODA}[sys.argv[2]]
    tolerance = float(sys.argv[3])
    force = np.zeros(n + 1)
    beyond = np.zeros(n + 1)  # displacements and the wall's, 0
    evaluations = 0

    def rates(_, y):
        nonlocal evaluations
        evaluations += 1
        beyond[:n] = y[:n]
        d = np.maximum(d0 + (beyond[:-1] - beyond[1:]), 0)
        force[1:] = stiffness * (d * np.sqrt(d)) - f0
        return np.concatenate((y[n:], (force[:-1] - force[1:]) / mass))

    y = np.zeros(2 * n)
    y[n] = v0
    absolute = tolerance * np.concatenate((np.full(n, scale), np.full(n, v0)))
    cpu, start = 0.0, 0.0
    for stop in (early, end):
        clock = time.process_time()
        solver = solver_class(rates, start, y, stop, rtol=2.3e-14, atol=absolute)
        cpu += time.process_time() - clock
        while solver.status == "running":
            clock = time.process_time()
            solver.step()
            cpu += time.process_time() - clock
            sys.stdout.buffer.write(np.concatenate(([solver.t], solver.y)).tobytes())
        if solver.status == "failed":
            return 1
        start, y = stop, solver.y
    last = np.zeros(2 * n + 1)
    last[:3] = -1, cpu, evaluations
    sys.stdout.buffer.write(last.tobytes())
    return 0


sys.exit(main())
