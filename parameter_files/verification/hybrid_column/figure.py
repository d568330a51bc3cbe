#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs the column as hybrid, of boundary elements and of blocks alone, and
draws all three beside the series.

  parameter_files/verification/hybrid_column/figure.py --quoin build/quoin \\
      --out column.png
"""
import argparse
import os
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(HERE)))
sys.path.insert(0, os.path.join(ROOT, "python"))
from quoin.figures import figure_style  # noqa: E402,F401

# with the series of the damping that each has
MODELS = (("hybrid", "case.prm", "reference.csv", "C0", "-"),
          ("boundary elements", "boundary_elements.prm", "reference_decay.csv",
           "C1", "--"),
          ("blocks", "blocks.prm", "reference.csv", "C2", "-."))
STATIC = 1e-3  # of the top [m]


def read(path):
    with open(path) as stream:
        names = [name.partition(" [")[0]
                 for name in stream.readline().strip().split(",")]
    return dict(zip(names, np.loadtxt(path, delimiter=",", skiprows=1).T))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin", required=True)
    parser.add_argument("--out", required=True, help="the picture")
    options = parser.parse_args()
    series = read(os.path.join(HERE, "reference.csv"))
    figure, axes = plt.subplots(4, 1, sharex=True, figsize=(7, 8))
    for axis, point in zip(axes, "ABCD"):
        axis.plot(1e3 * series["time"], 1e3 * series[point], "k", linewidth=2.5,
                  alpha=0.25, label="series")
        axis.set_ylabel("%s: u [mm]" % point)
    for name, prm, theory, colour, style in MODELS:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([options.quoin, os.path.join(HERE, prm), "--output",
                            folder, "--quiet"], check=True)
            run = read(os.path.join(folder, "histories.csv"))
        theory = read(os.path.join(HERE, theory))
        errors = []
        for axis, point in zip(axes, "ABCD"):
            u = (run[point] if point in run else
                 0.5 * (run[point + "_above"] + run[point + "_below"]))
            axis.plot(1e3 * run["time"], 1e3 * u, style, color=colour,
                      linewidth=1, label=name)
            exact = np.interp(run["time"], theory["time"], theory[point])
            inside = run["time"] <= theory["time"][-1]
            error = (u - exact)[inside] / STATIC
            errors.append("%s %.1f (rms %.2f)" % (
                point, 100 * np.max(np.abs(error)),
                100 * np.sqrt(np.mean(error**2))))
        print("%-18s error [%% of the static displacement]: %s"
              % (name, ", ".join(errors)))
    axes[0].legend(ncol=4, loc="lower right", fontsize="small")
    axes[-1].set_xlabel("time [ms]")
    axes[-1].set_xlim(0, 300)
    figure.tight_layout()
    figure.savefig(options.out, dpi=110)


if __name__ == "__main__":
    main()
