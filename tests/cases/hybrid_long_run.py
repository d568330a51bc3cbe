#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Undamped blocks with boundary elements beyond, long after a pulse.

Their energy must have left and must not grow, for soft and stiff blocks in a
circle, a square and at a free surface. Prints a row of a table for each run.
"""
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

FOLDER = os.path.join(common.VERIFICATION, "hybrid_long_run")
REGIONS = {"circle": "case.prm", "square": "case.prm",
           "half_plane": "half_plane.prm"}
YOUNG = 18.75e9  # of what is beyond [Pa]
FAST = ["Boundary elements/Passivity frequencies=0"]


def time_step(quoin, prm, sets):
    words = common.command(quoin, prm, "-", sets, 1, ["--check"])
    words = [word for word in words if word not in ("--quiet", "--output",
                                                    "-")]
    with tempfile.TemporaryDirectory() as folder:
        words += ["--output", os.path.join(folder, "output")]
        text = subprocess.run(words, env=common.environment(), check=True,
                              stdout=subprocess.PIPE,
                              universal_newlines=True).stdout
    return (float(re.search(r"stage pulse: time step (\S+) s", text).group(1)),
            int(re.search(r"time step \S+ s, (\d+) steps of the blocks,",
                          text).group(1)))


def run(quoin, region, ratio, n_steps):
    """Among others the shares of the energy put in that were left in the
    blocks at most in the fifth of the run up to 1e3, 1e4 ... steps."""
    prm = os.path.join(FOLDER, REGIONS[region])
    sets = FAST + ["Materials/rock/Young's modulus=%r" % (ratio * YOUNG)]
    if REGIONS[region] == "case.prm":
        sets.append("Mesh/File=%s.geo" % region)
    dt, n_substeps = time_step(quoin, prm, sets)
    sets += ["Stages/pulse/Duration=%r" % (n_steps * dt),
             "Histories/Interval=%r" % (max(1, n_steps // 10000) * 2.5 * dt),
             "Output/Checkpoint interval=0"]
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "output")
        seconds = common.run(quoin, prm, output, sets)
        energies = common.read_table(os.path.join(output, "energies.csv"))[0]
        ledger = common.read_table(os.path.join(output, "far_field.csv"))[0]
    step = energies["time"] / dt
    inside = energies["kinetic"] + energies["strain"]
    put_in = np.max(energies["external"])
    marks = [n for n in (1000, 10000, 100000, 1000000) if n <= n_steps]
    left = [float(np.max(inside[(step > 0.8 * n) & (step <= n * 1.001)])
                  / put_in) for n in marks]
    return {"marks": marks, "left": left, "substeps": n_substeps,
            "element steps": int(ledger["steps"][-1]),
            "residual": float(np.max(np.abs(energies["residual"])) / put_in),
            "mismatch": float(ledger["mismatch"][-1]),
            "radiated": ledger["radiated"] / put_in, "seconds": seconds}


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=1000000,
                        help="of the blocks")
    parser.add_argument("--regions", default=",".join(REGIONS))
    parser.add_argument("--ratios", default="0.1,1,10",
                        help="Young's modulus of the blocks by that beyond")
    options = parser.parse_args()
    results = common.begin(options, "hybrid_long_run")
    failed, worst, seconds = [], 0.0, 0.0
    for region in options.regions.split(","):
        for ratio in options.ratios.split(","):
            result = run(options.quoin, region, float(ratio), options.steps)
            print("| %s | %s | %d | %d | %s | %.0e | %.0e |" % (
                region.replace("_", "-"), ratio, result["substeps"],
                result["element steps"],
                ", ".join("%.1e" % x for x in result["left"]),
                result["residual"], result["mismatch"]), flush=True)
            name = "%s %s: " % (region, ratio)
            left = result["left"]
            worst = max(worst, left[-1] / left[0])
            seconds += result["seconds"]
            if any(b > a for a, b in zip(left, left[1:])):
                failed.append(name + "the energy grows")
            if not result["residual"] < 1e-6:
                failed.append(name + "residual %.1e" % result["residual"])
            if not result["mismatch"] < 1e-9:
                failed.append(name + "mismatch %.1e" % result["mismatch"])
            if np.min(result["radiated"]) < -1e-3:
                failed.append(name + "the boundary elements create energy")
    common.write_result(
        results, "hybrid_long_run",
        title="undamped blocks, boundary elements beyond, %d steps"
        % options.steps, reference="energy at the end by that after 1000 steps",
        error=worst, tolerance=1.0, seconds=round(seconds, 2), passed=not failed)
    if failed:
        raise Failure("; ".join(failed))
    print("passed: hybrid_long_run")


if __name__ == "__main__":
    common.main(body)
