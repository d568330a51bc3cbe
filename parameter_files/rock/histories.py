#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws histories of several runs over each other, from the end of their first
stage on.

  parameter_files/rock/histories.py --out wall.png --columns wall_vx,edge_vx \\
      "boundary elements=output" "viscous=output_viscous"
"""
import argparse
import os
import re
import sys

import numpy as np

sys.path.insert(0, os.path.join(
    os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
from quoin.figures import figure_style  # noqa: E402,F401
import matplotlib.pyplot as plt  # noqa: E402

STYLES = ({"color": "C0"}, {"color": "C1", "linestyle": "--"},
          {"color": "0.4", "linewidth": 3, "alpha": 0.5})


def read(folder):
    with open(os.path.join(folder, "log.txt")) as stream:
        begin = float(re.search(r"ended at t = (\S+) s", stream.read()).group(1))
    path = os.path.join(folder, "histories.csv")
    with open(path) as stream:
        labels = stream.readline().strip().split(",")
    values = np.loadtxt(path, delimiter=",", skiprows=1).T
    table = {label.partition(" [")[0]: v for label, v in zip(labels, values)}
    units = {label.partition(" [")[0]: label.partition(" [")[2].rstrip("]")
             for label in labels}
    table["time"] = table["time"] - begin
    return table, units


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", help="LABEL=OUTPUT_DIR")
    parser.add_argument("--columns", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--until", type=float, help="[s]")
    options = parser.parse_args()
    columns = options.columns.split(",")
    figure, axes = plt.subplots(len(columns), 1, sharex=True, squeeze=False,
                                figsize=(7, 1.2 + 1.7 * len(columns)))
    for k, run in enumerate(options.runs):
        label, _, folder = run.partition("=")
        table, units = read(folder)
        keep = table["time"] >= 0
        for axis, column in zip(axes[:, 0], columns):
            axis.plot(1e3 * table["time"][keep], table[column][keep],
                      label=label, zorder=3 - k, **STYLES[k])
            axis.set_ylabel("%s [%s]" % (column, units[column]))
    axes[0, 0].legend(ncol=len(options.runs), fontsize="small")
    axes[-1, 0].set_xlabel("time [ms]")
    axes[-1, 0].set_xlim(0, 1e3 * options.until if options.until else None)
    figure.tight_layout()
    figure.savefig(options.out, dpi=110)


if __name__ == "__main__":
    main()
