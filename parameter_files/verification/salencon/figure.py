#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs the hole with and without dilation and draws radial displacement and
stresses over the closed form.

  parameter_files/verification/salencon/figure.py --quoin build/quoin \\
      --out salencon.png
"""
import argparse
import os
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(HERE)))
sys.path.insert(0, os.path.join(ROOT, "python"))
from quoin.figures import figure_style  # noqa: E402,F401
import matplotlib.pyplot as plt  # noqa: E402
from quoin import vtu  # noqa: E402

import make_reference as exact  # noqa: E402

RUNS = (("$\\psi = 30°$", 30, "ring.geo", "C0"),
        ("$\\psi = 0$", 0, "ring_coarse.geo", "C1"))


def run(quoin, output, dilation, mesh):
    subprocess.run([quoin, os.path.join(HERE, "case.prm"), "--quiet",
                    "--output", output,
                    "--set", "Materials/rock/Dilation angle=%g" % dilation,
                    "--set", "Mesh/File=" + mesh], check=True)
    return vtu.read_at(os.path.join(output, "blocks.pvd"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin", required=True)
    parser.add_argument("--out", required=True)
    options = parser.parse_args()
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6))
    r = np.linspace(1, 5, 400)
    for label, dilation, mesh, color in RUNS:
        with tempfile.TemporaryDirectory() as scratch:
            grid = run(options.quoin, scratch, dilation, mesh)
        x = grid.points[:, :2]
        at = np.hypot(x[:, 0], x[:, 1])
        radial = -np.sum(x * grid.point_data["displacement"][:, :2], 1) / at
        left.plot(at, 1e3 * radial, ".", color=color, markersize=3,
                  label=label)
        left.plot(r, -1e3 * exact.displacement(r, dilation), color="k",
                  linewidth=0.8)
        if dilation == 0:
            continue
        centre = x[grid.cells].mean(axis=1)
        at = np.hypot(centre[:, 0], centre[:, 1])
        n = centre / at[:, None]
        s = grid.cell_data["stress"]
        along = (s[:, 0] * n[:, 0]**2 + s[:, 1] * n[:, 1]**2
                 + 2 * s[:, 2] * n[:, 0] * n[:, 1])
        around = s[:, 0] + s[:, 1] - along
        for values, name, shade in ((along, "radial", "C0"),
                                    (around, "hoop", "C2"),
                                    (s[:, 3], "along the hole", "0.7")):
            right.plot(at, -values / 1e6, ".", color=shade, markersize=3,
                       label=name)
    for stress in exact.stresses(r):
        right.plot(r, -stress / 1e6, color="k", linewidth=0.8)
    for axes in (left, right):
        axes.set_xlabel("r [m]")
        axes.legend(markerscale=3)
    left.set_ylabel("displacement towards the hole [mm]")
    right.set_ylabel("pressure [MPa], $\\psi = 30°$")
    figure.tight_layout()
    figure.savefig(options.out, dpi=110)


if __name__ == "__main__":
    main()
