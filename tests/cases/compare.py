#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs a case of cases.json and compares its histories with the reference.

Every column of the reference but the time is compared with the column of the
same name of histories.csv, interpolated at the reference's times, or at its
values of the history "against", such as the load time. The error is
the largest difference relative to the column's peak (its "scale" if given). A
case may add a check of checks.py or wall_checks.py, which returns further
errors. Each is bounded by its entry in "tolerances", or by "tolerance". The
energy balance must close, and the run warn of nothing but what "warnings" says.
"""
import importlib
import json
import os
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import checks  # noqa: E402
import common  # noqa: E402
from common import Failure  # noqa: E402


def load_cases():
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)),
                           "cases.json")) as stream:
        return json.load(stream)


def compare_columns(case, histories, units, reference, reference_units):
    """{column: (max error, rms error)}, relative to the column's scale."""
    if "against" in case:
        histories = dict(histories, time=histories[case["against"]])
    histories = common.strictly_increasing(histories)
    t = reference["time"]
    keep = np.ones(len(t), dtype=bool)
    for start, end in case.get("skip", []):
        keep &= (t < start) | (t > end)
    last = histories["time"][-1]
    if not case.get("final"):
        # the last row may be a step or an interval of the histories early;
        # a run need not go on to rows that are skipped
        if t[keep][-1] > 1.01 * last:
            raise Failure("the run ended at %g s, the reference at %g s"
                          % (last, t[keep][-1]))
        keep &= t <= last
    columns = case.get("columns") or [n for n in reference if n != "time"]
    errors = {}
    for name in columns:
        if name not in histories:
            raise Failure("histories.csv has no column '%s' but: %s"
                          % (name, ", ".join(histories)))
        if units[name] != reference_units[name]:
            raise Failure("column '%s' is in [%s], expected [%s]"
                          % (name, units[name], reference_units[name]))
        exact = reference[name]
        if case.get("final"):
            value, wanted = histories[name][-1:], exact[-1:]
        else:
            wanted = exact[keep]
            interpolate = common.cubic if case.get("smooth") else np.interp
            value = interpolate(t[keep], histories["time"], histories[name])
        scale = case.get("scale", {}).get(name) or np.max(np.abs(exact)) or 1.0
        if not np.all(np.isfinite(value)):
            raise Failure("column '%s' is not finite" % name)
        difference = (value - wanted) / scale
        errors[name] = (float(np.max(np.abs(difference))),
                        float(np.sqrt(np.mean(difference**2))))
    return errors


def iterations_a_step(output):
    """Iterations per step of the implicit solver: few if its derivatives are
    those of its forces."""
    with open(os.path.join(output, "summary.json")) as stream:
        summary = json.load(stream)
    return summary["iterations"] / summary["steps"]


def most_linear_iterations(output):
    """Iterations of the iterative linear solver for a system: 1 where multigrid
    has one level alone, the factors, 0 of LU factors."""
    rows, _ = common.read_table(os.path.join(output, "convergence.csv"))
    return np.max(rows["linear iterations"])


def check_of(name):
    """The function of checks.py or wall_checks.py. The latter takes half a second to
    load, with all that draws figures, which hundreds of cases do without."""
    if hasattr(checks, name):
        return getattr(checks, name)
    return getattr(importlib.import_module("wall_checks"), name)


def run_case(case, options):
    name = case["name"]
    results = common.begin(options, name)
    folder = os.path.join(common.VERIFICATION, case["folder"])
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        output = options.keep or scratch
        prm = os.path.join(folder, case.get("prm", "case.prm"))
        seconds = common.run(options.quoin, prm,
                             output, case.get("set", []))
        histories, units = common.read_table(
            os.path.join(output, "histories.csv"))
        errors = {}
        if "reference" in case:
            reference, reference_units = common.read_table(
                os.path.join(folder, case["reference"]))
            errors.update(compare_columns(case, histories, units, reference,
                                          reference_units))
        extra = {}
        if "check" in case:
            case["quoin"] = options.quoin
            extra = check_of(case["check"])(case, folder, output, histories)
        iterations = ("iterations a step" in case
                      and iterations_a_step(output))
        linear = ("linear iterations" in case
                  and most_linear_iterations(output))
        failed = common.unexpected_warnings(case.get("warnings", []), output,
                                            case.get("possible warnings", []))
        residual = common.energy_residual_share(output)
    tolerance = case["tolerance"]
    tolerances = {"energy residual": common.MOST_RESIDUAL,
                  **case.get("tolerances", {})}
    unknown = set(tolerances) - set(errors) - set(extra) - {"energy residual"}
    if unknown:
        raise Failure("%s: tolerances of what is not compared: %s"
                      % (name, ", ".join(sorted(unknown))))
    if iterations and iterations > case["iterations a step"]:
        failed.append("%.2f iterations a step > %g"
                      % (iterations, case["iterations a step"]))
    if "linear iterations" in case:
        least, most = case["linear iterations"]
        print("  %-30s %d  from %d to %d"
              % ("linear iterations", linear, least, most))
        if not least <= linear <= most:
            failed.append("%d linear iterations, not from %d to %d"
                          % (linear, least, most))
    print("  %-30s %.3e  tolerance %.1e"
          % ("energy residual / throughput", residual,
             tolerances["energy residual"]))
    if not residual <= tolerances["energy residual"]:
        failed.append("energy residual %.1e of the throughput > %g"
                      % (residual, tolerances["energy residual"]))
    worst = 0.0
    for column, (largest, rms) in errors.items():
        bound = tolerances.get(column, tolerance)
        worst = max(worst, largest / bound * tolerance)
        print("  %-14s max %.3e  rms %.3e  tolerance %.1e"
              % (column, largest, rms, bound))
        if largest > bound:
            failed.append("%s %.3e > %.1e" % (column, largest, bound))
    for label, error in extra.items():
        bound = tolerances.get(label, tolerance)
        worst = max(worst, error / bound * tolerance)
        print("  %-30s %.3e  tolerance %.1e" % (label, error, bound))
        if not error <= bound:
            failed.append("%s %.3e > %.1e" % (label, error, bound))
    common.write_result(
        results, name, title=case["title"], reference=case["source"],
        error=worst, tolerance=tolerance, seconds=round(seconds, 2),
        passed=not failed, wall=case.get("wall"), solvers=case.get("solvers"),
        errors={**{k: v[0] for k, v in errors.items()}, **extra})
    if failed:
        raise Failure("%s: %s" % (name, "; ".join(failed)))
    print("passed: %s: error %.2e, tolerance %.1e, %.1f s"
          % (name, worst, tolerance, seconds))


def main():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", help="names; none: all of them")
    parser.add_argument("--keep", help="output folder to keep")
    parser.add_argument("--list", action="store_true", help="names only")
    options = parser.parse_args()
    cases = load_cases()
    if options.list:
        print("\n".join(case["name"] for case in cases))
        return
    known = {case["name"]: case for case in cases}
    for name in options.cases:
        if name not in known:
            raise Failure("no case '%s'; there are: %s"
                          % (name, ", ".join(known)))
    failures = []
    for name in options.cases or known:
        print(name)
        try:
            run_case(known[name], options)
        except Failure as failure:
            print("FAILED: %s" % failure)
            failures.append(name)
    if failures:
        raise Failure("%d of %d cases: %s"
                      % (len(failures), len(options.cases or known),
                         ", ".join(failures)))


if __name__ == "__main__":
    common.main(main)
