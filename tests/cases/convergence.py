#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Observed order of convergence in the mesh size and in the time step.

The P pulse of joint_wave_p. In h the error against the exact solution on
meshes of 4, 2 and 1 m with the step a fixed share of the critical one; in dt
the differences between shares of 0.8, 0.4 and 0.2 on the 2 m mesh.
"""
import importlib.util
import os
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

FOLDER = os.path.join(common.VERIFICATION, "joint_wave_p")
TIMES = np.arange(0.02, 0.11, 2e-4)
COLUMNS = ("v_below", "v_above")
C, Z, STIFFNESS, JOINTS = 5830.0, 2650.0 * 5830.0, 3.5e9, [100.0]


def exact():
    spec = importlib.util.spec_from_file_location(
        "characteristics", os.path.join(FOLDER, "make_reference.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)

    def incident(t):
        return module.ricker(t, 0.01, 50.0, 0.03)

    t, *waves, _ = module.solve(incident, JOINTS, Z, C, STIFFNESS, 0.12)
    return np.array([
        np.interp(TIMES, t, module.velocity(y, incident, JOINTS, C, t, *waves))
        for y in (40.0, 160.0)])


def computed(quoin, sets):
    with tempfile.TemporaryDirectory(prefix="quoin_") as output:
        seconds = common.run(quoin, os.path.join(FOLDER, "case.prm"), output,
                             sets)
        table, _ = common.read_table(os.path.join(output, "histories.csv"))
    table = common.strictly_increasing(table)
    return np.array([common.cubic(TIMES, table["time"], table[name])
                     for name in COLUMNS]), seconds


def rms(values):
    return float(np.sqrt(np.mean(values**2)))


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--minimum", type=float, default=1.8,
                        help="smallest order that passes")
    options = parser.parse_args()
    results = common.begin(options, "convergence_h", "convergence_dt")
    reference = exact()
    scale = rms(reference)
    total = 0.0

    errors = []
    for mesh in ("joint_wave_p_h4.geo", "joint_wave_p_h2.geo",
                 "joint_wave_p.geo"):
        values, seconds = computed(options.quoin, ["Mesh/File=" + mesh])
        total += seconds
        errors.append(rms(values - reference) / scale)
    space = [float(np.log2(a / b)) for a, b in zip(errors, errors[1:])]
    print("mesh size 4, 2, 1 m: errors %s, orders %s"
          % (", ".join("%.3e" % e for e in errors),
             ", ".join("%.2f" % o for o in space)))

    runs = []
    for share in (0.8, 0.4, 0.2):
        values, seconds = computed(options.quoin, [
            "Mesh/File=joint_wave_p_h2.geo",
            "Time stepping/Share of critical time step=%g" % share])
        total += seconds
        runs.append(values)
    steps = [rms(a - b) / scale for a, b in zip(runs, runs[1:])]
    time = float(np.log2(steps[0] / steps[1]))
    print("time step shares 0.8, 0.4, 0.2: differences %s, order %.2f"
          % (", ".join("%.3e" % s for s in steps), time))

    passed = space[-1] >= options.minimum and time >= options.minimum
    for name, title, order in (
            ("convergence_h", "order in the mesh size", space[-1]),
            ("convergence_dt", "order in the time step", time)):
        common.write_result(
            results, name, title=title, reference="order 2 (shown: 2 - order)",
            error=max(2 - order, 0.0), tolerance=2 - options.minimum,
            seconds=round(total / 2, 2), passed=order >= options.minimum,
            order=order)
    if not passed:
        raise Failure("order %.2f in h, %.2f in dt, at least %.1f wanted"
                      % (space[-1], time, options.minimum))
    print("passed: convergence: order %.2f in h, %.2f in dt"
          % (space[-1], time))


if __name__ == "__main__":
    common.main(body)
