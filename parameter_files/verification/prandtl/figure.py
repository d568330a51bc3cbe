#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs the footing with crossed and with plain triangles and draws pressure
over settlement and the plastic shear under the footing.

  parameter_files/verification/prandtl/figure.py --quoin build/quoin \\
      --out prandtl.png
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

RUNS = (("plain, 0.25 m", "plain", "ground.geo", "C3"),
        ("crossed, 0.25 m", "crossed", "ground.geo", "C0"),
        ("crossed, 0.125 m", "crossed", "ground_fine.geo", "C2"))


def run(quoin, output, kind, mesh):
    subprocess.run([quoin, os.path.join(HERE, "case.prm"), "--quiet",
                    "--output", output, "--set", "Mesh/Triangles=" + kind,
                    "--set", "Mesh/File=" + mesh], check=True)
    table = np.genfromtxt(os.path.join(output, "histories.csv"),
                          delimiter=",", skip_header=1)
    return table, vtu.read_at(os.path.join(output, "blocks.pvd"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin", required=True)
    parser.add_argument("--out", required=True)
    options = parser.parse_args()
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(10, 3.6), gridspec_kw={"width_ratios": (1, 1.5)})
    for label, kind, mesh, color in RUNS:
        with tempfile.TemporaryDirectory() as scratch:
            table, grid = run(options.quoin, scratch, kind, mesh)
        left.plot(-1e3 * table[:, 1], -table[:, 2] / 2 / 1e3, color=color,
                  label=label)
    left.axhline(2 + np.pi, color="k", linewidth=0.8, label="$2 + \\pi$")
    left.set_xlabel("settlement [mm]")
    left.set_ylabel("pressure / cohesion [-]")
    left.legend(loc="lower right")
    shear = grid.cell_data["plastic shear strain"]
    picture = right.tripcolor(
        grid.points[:, 0], grid.points[:, 1], grid.cells,
        facecolors=1e3 * shear, cmap="magma_r",
        vmax=1e3 * np.quantile(shear, 0.99))
    right.plot([0, 2], [0.05, 0.05], color="k", linewidth=4)
    right.set_xlim(0, 8)
    right.set_ylim(-4, 0.2)
    right.set_aspect("equal")
    right.grid(False)
    right.set_title("plastic shear strain [$10^{-3}$], crossed, 0.125 m")
    figure.colorbar(picture, ax=right, shrink=0.8)
    figure.tight_layout()
    figure.savefig(options.out, dpi=100)


if __name__ == "__main__":
    main()
