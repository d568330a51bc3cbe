#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs a shear wall in several ways and compares the peak forces.

The failure load of a wall must not depend on how it is found: half the rate
of loading and other dampings must not move the peak of J4D by more than 2 %.
"""
import os
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

WALL = os.path.join(common.MASONRY, "tue_walls", "j4d.prm")
TOLERANCE = 0.02
# The peak is at 2 mm: 2.5 mm are enough.
SHORT = ["Stages/push/Duration=0.1255", "Output/Field interval=0"]
VARIANTS = {
    "half the rate": ["Stages/push/Kinetic energy limit=3.75e-4"],
    "local damping": ["Stages/push/Damping=local",
                      "Stages/push/Kinetic energy limit=1e-4"],
    "Rayleigh damping": ["Stages/push/Damping=Rayleigh",
                         "Stages/push/Rayleigh mass coefficient=200"],
    "crossed triangles": ["Mesh/Triangles=crossed"],
}


def peak(options, settings):
    with tempfile.TemporaryDirectory(prefix="quoin_") as output:
        seconds = common.run(options.quoin, WALL, output, SHORT + settings)
        table, _ = common.read_table(os.path.join(output, "histories.csv"))
    force = -table["horizontal"]
    if np.argmax(force) == len(force) - 1:
        raise Failure("the force still rises at the end")
    return float(np.max(force)), seconds


def main():
    options = common.arguments(__doc__.splitlines()[0]).parse_args()
    results = common.begin(options, "tue_wall_stability")
    base, total = peak(options, [])
    print("as shipped: %.2f kN" % (base / 1e3))
    errors = {}
    for name, settings in VARIANTS.items():
        value, seconds = peak(options, settings)
        total += seconds
        errors[name] = abs(value / base - 1)
        print("%s: %.2f kN, %.2e" % (name, value / 1e3, errors[name]))
    worst = max(errors.values())
    common.write_result(
        results, "tue_wall_stability",
        title="shear wall J4D: peak at half the rate, other dampings",
        reference="the wall as shipped", error=worst, tolerance=TOLERANCE,
        seconds=round(total, 1), passed=worst <= TOLERANCE, errors=errors)
    if worst > TOLERANCE:
        raise Failure("the peak moves by %.2e > %.0e" % (worst, TOLERANCE))
    print("passed")


if __name__ == "__main__":
    common.main(main)
