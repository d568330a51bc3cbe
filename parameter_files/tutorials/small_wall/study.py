#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The force at which the small wall slides and its peak, for some angles of
friction and cohesions, against N tan(phi).

  parameter_files/tutorials/small_wall/study.py [--output study] [--quoin FILE]
"""
import argparse
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, *[os.pardir] * 3, "python"))
import quoin  # noqa: E402
from quoin import figures  # noqa: E402,F401  (the look)
import matplotlib.pyplot as plt  # noqa: E402

WEIGHT = 15e3                        # [N], on the bed joints
GRID = {"Joints/mortar/Friction angle": [20, 25, 30, 35, 40, 45],
        "Joints/mortar/Cohesion": [0.2e6, 0.375e6]}


def forces(results):
    histories = results.histories
    slides = histories["displacement"] > 0.4e-3
    return {"peak [N]": histories["force"].max(),
            "sliding [N]": histories["force"][slides].mean()}


def draw(table, path):
    figure, axes = plt.subplots(figsize=(5.5, 3.6), constrained_layout=True)
    angle, cohesion, peak, sliding = (
        np.asarray(table[name]) for name in (*GRID, "peak [N]", "sliding [N]"))
    phi = np.linspace(18, 46, 50)
    axes.plot(phi, 1e-3 * WEIGHT * np.tan(np.radians(phi)), "k-",
              linewidth=1, label="N tan φ")
    for k, value in enumerate(GRID["Joints/mortar/Cohesion"]):
        of = cohesion == value
        name = f"cohesion {1e-6 * value:g} MPa"
        axes.plot(angle[of], 1e-3 * peak[of], f"C{k}^--",
                  label=f"peak, {name}")
        axes.plot(angle[of], 1e-3 * sliding[of], f"C{k}o",
                  markersize=9 - 4 * k, markerfacecolor="none",
                  label=f"sliding, {name}")
    axes.set_xlabel("angle of friction [°]")
    axes.set_ylabel("horizontal force [kN]")
    axes.legend(fontsize=8)
    figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--output", default=os.path.join(HERE, "output_study"))
    parser.add_argument("--quoin", help="the executable")
    options = parser.parse_args()
    table = quoin.study(os.path.join(HERE, "case.prm"), GRID, options.output,
                        forces, processes=2, quoin=options.quoin)
    print(table)
    draw(table, os.path.join(options.output, "study.png"))


if __name__ == "__main__":
    main()
