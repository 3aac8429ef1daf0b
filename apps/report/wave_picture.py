# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the stress of a uniaxial run over place and time.

    python3 apps/report/wave_picture.py results/bar docs/elastic-bar-split.png

Needs the distribution's packages python3-h5py, python3-numpy, python3-matplotlib.
"""
import re
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

directory, picture = sys.argv[1], sys.argv[2]
times = [float(t) for t in re.findall(r'<Time Value="([^"]+)"', open(directory + "/results.xdmf").read())]

figure, axes = plt.subplots(figsize=(8, 4.5))
with h5py.File(directory + "/results.h5") as results:
    states = sorted(name for name in results if name.isdigit())
    largest = 0
    rows = []
    for time, state in zip(times, states):
        for body in results[state].values():
            if not isinstance(body, h5py.Group):
                continue
            x = body["points"][:, 0]
            stress = body["stress"][:, 0]
            if len(stress) == len(x) - 1:  # a mesh: stress stands in the elements
                order = np.argsort(x)
                x = 0.5 * (x[order][1:] + x[order][:-1])
            order = np.argsort(x)
            rows.append((time, x[order], stress[order]))
            largest = max(largest, np.abs(stress).max())
    for time, x, stress in rows:
        shown = axes.scatter(1e3 * x, np.full_like(x, 1e6 * time), c=1e-6 * stress, s=14, marker="s", cmap="RdBu_r",
                             vmin=-1e-6 * largest, vmax=1e-6 * largest, linewidths=0)
axes.set_xlabel("place in mm")
axes.set_ylabel("time in us")
figure.colorbar(shown, label="axial stress in MPa (tension positive)")
figure.tight_layout()
figure.savefig(picture, dpi=110)
