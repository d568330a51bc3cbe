#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws the cases of both laws of rock joints beside their references.

  figure.py BARTON_BANDIS_RUN CONTINUOUSLY_YIELDING_RUN rock_joints.png
"""
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

CASES = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def read(path):
    with open(path) as stream:
        rows = [row for row in csv.reader(stream)
                if row and not row[0].startswith("#")]
    names = [name.split(" [")[0].strip() for name in rows[0]]
    return dict(zip(names, np.array(rows[1:], dtype=float).T))


def draw(axes, table, style, label):
    sheared = table["time"] >= 0.2
    pressed = ~sheared
    slip = 1e3 * table["slip"][sheared]
    lift = table["opening"] - table["opening"][sheared][0]
    axes[0].plot(-1e3 * table["opening"][pressed],
                 -1e-6 * table["normal"][pressed], style, label=label)
    axes[1].plot(slip, 1e-6 * table["shear"][sheared], style, label=label)
    axes[2].plot(slip, 1e3 * lift[sheared], style, label=label)


def main():
    figure, rows = plt.subplots(2, 3, figsize=(9, 5.4))
    cases = ("barton_bandis", "continuously_yielding")
    titles = ("Barton-Bandis", "continuously yielding")
    for axes, case, title, run in zip(rows, cases, titles, sys.argv[1:3]):
        draw(axes, read(os.path.join(run, "histories.csv")), "-", "quoin")
        thin = read(os.path.join(CASES, case, "reference.csv"))
        draw(axes, {name: column[::10] for name, column in thin.items()},
             "k.", "equations")
        axes[0].set(xlabel="closure [mm]", ylabel="pressure [MPa]",
                    title=title)
        axes[1].set(xlabel="slip [mm]", ylabel="shear traction [MPa]")
        axes[2].set(xlabel="slip [mm]", ylabel="dilation [mm]")
        axes[0].legend(frameon=False)
    figure.tight_layout()
    figure.savefig(sys.argv[3], dpi=110)


if __name__ == "__main__":
    main()
