#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Where the implicit coupling and the staggered one hold: a row of a table for
each formulation and step of the boundary elements.

  parameter_files/verification/hybrid_column/schemes.py --quoin build/quoin
"""
import argparse
import os
import re
import subprocess
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
FORMULATIONS = {
    "collocation (the paper's)": ["Formulation=collocation", "Decay=20.28",
                                  "Mass damping=0"],
    "Galerkin": ["Formulation=Galerkin", "Decay=20.28", "Mass damping=0"],
    "convolution quadrature": []}
STATIC, PERIOD = 1e-3, 0.031


def read(path):
    with open(path) as stream:
        names = [name.partition(" [")[0]
                 for name in stream.readline().strip().split(",")]
    rows = np.genfromtxt(path, delimiter=",", skip_header=1, ndmin=2)
    return dict(zip(names, rows.T))


def outcome(quoin, sets, damped):
    reference = read(os.path.join(HERE, "reference.csv"))
    with tempfile.TemporaryDirectory() as folder:
        words = [quoin, os.path.join(HERE, "case.prm"), "--output", folder,
                 "--set", "Boundary elements/Passivity frequencies=0"]
        for text in sets:
            words += ["--set", text]
        done = subprocess.run(words, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT,
                              universal_newlines=True)
        substeps = re.search(r"time step \S+ s, (\d+) block step", done.stdout)
        run = read(os.path.join(folder, "histories.csv"))
    t, u = run["time"], np.abs(run["B"])
    bad = np.flatnonzero(~(u < 3 * STATIC))
    if bad.size or done.returncode:
        end = t[bad[0]] if bad.size else t[-1]
        return int(substeps.group(1)), "**fails** after %.1f" % (end / PERIOD)
    if not damped:
        return int(substeps.group(1)), "holds"
    inside = t <= reference["time"][-1]
    error = np.interp(t[inside], reference["time"], reference["B"])
    error = np.max(np.abs(run["B"][inside] - error)) / STATIC
    return int(substeps.group(1)), "%.1f %%" % (100 * error)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin", required=True)
    parser.add_argument("--ratios", default="0.5,1,1.5,2")
    options = parser.parse_args()
    undamped = ["Boundary elements/Decay=0", "Boundary elements/Mass damping=0",
                "Stages/load/Damping=none",
                "Stages/load/Rayleigh mass coefficient=0"]
    for name, formulation in FORMULATIONS.items():
        for ratio in options.ratios.split(","):
            sets = ["Boundary elements/" + text for text in formulation]
            sets.append("Boundary elements/Step ratio=" + ratio)
            cells = []
            for extra in ([], undamped):
                for coupling in ("implicit", "staggered"):
                    substeps, text = outcome(
                        options.quoin,
                        sets + extra + ["Boundary elements/Coupling="
                                        + coupling], not extra)
                    cells.append(text)
            print("| %s | %s | %d | %s |" % (name, ratio, substeps,
                                             " | ".join(cells)), flush=True)


if __name__ == "__main__":
    main()
