# SPDX-License-Identifier: GPL-3.0-or-later
"""The same pictures with matplotlib.
   pictures_matplotlib.py movie RUN.h5 OUT.mp4 FRAMES    of FRAMES frames: beads, profile, space-time image of each chain
   pictures_matplotlib.py image RUN.h5 OUT.png           space-time image with axes"""
import sys

import h5py
import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.animation import FFMpegWriter
from matplotlib.collections import EllipseCollection

DPI = 100


def read(path):
    with h5py.File(path) as f:
        chain = f["particles/chain"]
        time = f["time"][:]
        force = chain["bead_force/value"][:]
        place = chain["rest_position"][:].reshape(force.shape[1], -1)[:, 0] if "rest_position" in chain else None
        move = chain["displacement/value"][:] if "displacement" in chain else None
        return time, force, place, chain["radius"][:], move, chain["chain"][:]


def image(run, out):
    time, force, *_ = read(run)
    fig, ax = plt.subplots(figsize=(19.2, 10.8), dpi=DPI)
    shown = ax.imshow(force, aspect="auto", cmap="inferno", interpolation="antialiased",
                      extent=(0, force.shape[1], 1e3 * time[-1], 1e3 * time[0]))
    ax.set(xlabel="bead", ylabel="time (ms)")
    fig.colorbar(shown, label="bead force (N)")
    fig.savefig(out)


def movie(run, out, frames):
    time, force, place, radius, move, chain = read(run)
    names = np.unique(chain)
    fig, axes = plt.subplots(3 * len(names), 1, figsize=(19.2, 10.8), dpi=DPI)
    drawn = []
    for k, name in enumerate(names):
        mine = chain == name
        beads, profile, shown = axes[3 * k:3 * k + 3]
        d = 2e3 * radius[mine]
        balls = EllipseCollection(d, d, np.zeros_like(d), units="x", cmap="inferno", transOffset=beads.transData,
                                  offsets=np.c_[1e3 * place[mine], np.zeros_like(d)])
        balls.set_clim(0, 45)
        beads.add_collection(balls)
        beads.set(xlim=(1e3 * place[mine][0], 1e3 * place[mine][-1]), ylim=(-10, 10))
        line, = profile.plot(force[0, mine])
        profile.set(ylim=(0, 45), ylabel="force (N)")
        picture = np.full((600, mine.sum()), np.nan)
        heat = shown.imshow(picture, aspect="auto", cmap="inferno", vmin=0, vmax=45, extent=(0, mine.sum(), 1e3 * time[-1], 0))
        shown.set(ylabel="time (ms)", xlabel="bead")
        drawn.append((mine, balls, line, picture, heat))
    label = fig.suptitle("")
    writer = FFMpegWriter(fps=60, codec="libx264", extra_args=["-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p"])
    with writer.saving(fig, out, DPI):
        for i in range(frames):
            sample = i * (len(time) - 1) // 599
            label.set_text(f"t = {1e3 * time[sample]:.3f} ms")
            for mine, balls, line, picture, heat in drawn:
                where = place[mine] + 200 * move[sample, mine]
                balls.set_offsets(np.c_[1e3 * where, np.zeros_like(where)])
                balls.set_array(force[sample, mine])
                line.set_ydata(force[sample, mine])
                picture[i] = force[sample, mine]
                heat.set_data(picture)
            writer.grab_frame()


if sys.argv[1] == "movie":
    movie(sys.argv[2], sys.argv[3], int(sys.argv[4]))
else:
    image(sys.argv[2], sys.argv[3])
