#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs the holes with the implicit solver and draws the wall's displacement over
the share of the support that is gone: elastic, yielding and lined.

  parameter_files/verification/excavated_hole/figure.py --quoin build/quoin \\
      --out excavated_hole.png
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

import make_reference as exact  # noqa: E402


def run(quoin, prm, column, stages, settings=()):
    """Share that is gone and the column [mm]; stages: shares from, to and the
    times of the ramps, which are smooth."""
    words = [word for value in ("Solver=implicit",) + tuple(settings)
             for word in ("--set", value)]
    with tempfile.TemporaryDirectory() as output:
        subprocess.run([quoin, os.path.join(HERE, prm), "--quiet", "--output",
                        output] + words, check=True)
        table = np.genfromtxt(os.path.join(output, "histories.csv"),
                              delimiter=",", names=True)
    time = table["time_s"]
    share, begins = np.zeros_like(time), 0.0
    for start, end, duration in stages:
        s = np.clip((time - begins) / duration, 0, 1)
        share += (end - start) * 0.5 * (1 - np.cos(np.pi * s))
        begins += duration
    return share, -1e3 * table[column]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin", default="build/quoin")
    parser.add_argument("--out", default="excavated_hole.png")
    options = parser.parse_args()
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2))
    shares = np.linspace(0, 1, 101)

    hydrostatic = ("Loads/in_situ/Stress=-10e6, -10e6, 0",)
    x, u = run(options.quoin, "case.prm", "side_m",
               ((0, 0.5, 1), (0.5, 1, 1)), hydrostatic)
    left.plot(x, u, "o", ms=3, label="elastic")
    left.plot(shares, -1e3 * exact.elastic(shares, 0, -10e6, -10e6)[0],
              "k-", lw=0.8, label="closed forms")
    x, u = run(options.quoin, "lining.prm", "wall_m",
               ((0, 0.5, 1), (0.5, 1, 1)))
    left.plot(x, u, "s", ms=3, label="lined at 0.5")
    lined = [-1e3 * stage[0] for stage in exact.lining()]
    left.plot([0.5, 1], lined, "k-", lw=0.8)
    left.set_title("elastic, 10 MPa")

    x, u = run(options.quoin, "yielding.prm", "side_m",
               ((0, 0.8, 0.1), (0.8, 1, 0.1)))
    right.plot(x, u, "o", ms=3, color="C3", label="Mohr-Coulomb")
    begins = 1 - exact.EDGE_PRESSURE / exact.PRESSURE
    elastic = (exact.PRESSURE * exact.RADIUS / (2 * exact.SHEAR))
    right.plot(shares,
               [1e3 * elastic * s if s < begins
                else -1e3 * exact.yielding(s, exact.RADIUS) for s in shares],
               "k-", lw=0.8, label="closed form")
    right.set_title("yielding, 30 MPa")
    for axes in (left, right):
        axes.set_xlabel("share of the support that is gone [-]")
        axes.set_ylabel("wall, inwards [mm]")
        axes.legend()
    figure.tight_layout()
    figure.savefig(options.out, dpi=130)


if __name__ == "__main__":
    main()
