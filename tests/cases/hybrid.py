#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Boundary elements beyond blocks against a larger model of blocks alone.

A jointed region about a hole is shaken. While nothing comes back from the sides
of a region five times as large, both must move alike. Then the small one goes
on, undamped: its energy must leave, and its balance must close. A run whose
boundary elements feed it must stop and say so.
"""
import os
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

FOLDER = os.path.join(common.VERIFICATION, "hybrid_hole")
FAST = ["Boundary elements/Passivity frequencies=0"]


def table(folder, name):
    return common.strictly_increasing(
        common.read_table(os.path.join(folder, name))[0])


# by collocation at short steps and without damping, which grows
FED = ["Boundary elements/Formulation=collocation",
       "Boundary elements/Step ratio=0.5", "Boundary elements/Mass damping=0",
       "Stages/load/Damping=none", "Stages/load/Rayleigh mass coefficient=0"]


def stops_when_fed(quoin, folder):
    """Whether it ended with status 2 and the reason."""
    prm = os.path.join(common.VERIFICATION, "hybrid_column", "case.prm")
    done = subprocess.run(
        common.command(quoin, prm, os.path.join(folder, "fed"), FAST + FED),
        env=common.environment(), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, universal_newlines=True)
    print("fed by its boundary elements: exit status %d, %s"
          % (done.returncode, done.stdout.strip()))
    return (done.returncode == 2
            and "the boundary elements have created energy" in done.stdout)


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--tolerance", type=float, default=0.02,
                        help="of the rms difference by the peak")
    parser.add_argument("--duration", type=float, default=0.2,
                        help="of the long run [s]")
    options = parser.parse_args()
    results = common.begin(options, "hybrid_hole")
    with tempfile.TemporaryDirectory() as folder:
        runs, seconds = {}, {}
        for name, prm, overrides in (
                ("small", "case.prm", FAST), ("large", "large.prm", []),
                ("long", "case.prm", FAST + [
                    "Stages/pulse/Duration=%g" % options.duration,
                    "Histories/Interval=2e-4"])):
            output = os.path.join(folder, name)
            seconds[name] = common.run(
                options.quoin, os.path.join(FOLDER, prm), output, overrides)
            runs[name] = {part: table(output, part + ".csv")
                          for part in ("histories", "energies")}
            if name != "large":
                runs[name]["ledger"] = table(output, "far_field.csv")
        stopped = stops_when_fed(options.quoin, folder)
    small, large = runs["small"]["histories"], runs["large"]["histories"]
    worst = 0.0
    for column in list(small)[1:]:
        reference = np.interp(small["time"], large["time"], large[column])
        error = small[column] - reference
        rms = np.sqrt(np.mean(error**2)) / np.max(np.abs(reference))
        print("%-12s rms %.2e, max %.2e of the peak"
              % (column, rms,
                 np.max(np.abs(error)) / np.max(np.abs(reference))))
        worst = max(worst, float(rms))

    energies, ledger = runs["long"]["energies"], runs["long"]["ledger"]
    inside = (energies["kinetic"] + energies["strain"]
              + energies["joint"])
    put_in = np.max(energies["external"])
    part = len(inside) // 10
    left = float(np.max(inside[-part:]) / put_in)
    before = float(np.max(inside[part:2 * part]) / put_in)
    residual = float(np.max(np.abs(energies["residual"])) / put_in)
    mismatch = float(ledger["mismatch"][-1])
    substeps = ledger["substeps"]
    print("long run, %d steps of the boundary elements: %.1e of the energy "
          "left, residual %.1e, mismatch %.1e, substeps %.1e of the energy"
          % (ledger["steps"][-1], left, residual, mismatch,
             substeps[-1] / put_in))
    print("seconds: small %.1f, large %.1f" % (seconds["small"],
                                               seconds["large"]))
    checks = [(stopped, "a run that its boundary elements feed goes on"),
              (worst <= options.tolerance, "rms %.3g" % worst),
              (left <= 1e-4 and left < before,
               "energy left %.3g, before %.3g" % (left, before)),
              (residual <= 1e-9, "residual %.3g" % residual),
              (mismatch <= 1e-9, "mismatch %.3g" % mismatch),
              (np.all(np.diff(substeps) >= -1e-12 * put_in),
               "substeps create energy")]
    failed = [text for passed, text in checks if not passed]
    common.write_result(
        results, "hybrid_hole",
        title="jointed region about a hole, boundary elements beyond",
        reference="blocks alone, five times the size, three transits",
        error=worst, tolerance=options.tolerance,
        seconds=round(seconds["small"], 2), passed=not failed)
    if failed:
        raise Failure("; ".join(failed))
    print("passed: hybrid_hole: error %.2e, tolerance %.1e"
          % (worst, options.tolerance))


if __name__ == "__main__":
    common.main(body)
