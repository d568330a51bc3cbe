#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Brackets a limit: it stands on one side of it and collapses on the other.

The cases are those of brackets.json. The reference is one value or a pair (low,
high) of the columns of the case's reference.csv; the two ends of the bracket
lie a margin or a share outside it. At the end on the safe side the "columns"
must stay below "bound" (and, if "at rest", have stopped), at the other end they
must exceed it. "steps" bisections between give the limit itself. "tolerances"
bound the errors of the check and the energy residual of the runs that stand,
which warn of nothing but what "warnings" says.
"""
import importlib.util
import json
import os
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import checks  # noqa: E402
import common  # noqa: E402
from common import Failure  # noqa: E402


def load_cases():
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)),
                           "brackets.json")) as stream:
        return {case["name"]: case for case in json.load(stream)}


def write_geometry(folder, path, value):
    spec = importlib.util.spec_from_file_location(
        "geometry_of_" + os.path.basename(folder),
        os.path.join(folder, "make_geometry.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.write(path, value)


def motion(case, histories):
    """Largest of the columns at each time; a column x means x1, x2, ... too."""
    names = [name for name in histories
             if name.rstrip("0123456789") in case["columns"]
             or name in case["columns"]]
    if not names:
        raise Failure("histories.csv has none of the columns "
                      + ", ".join(case["columns"]))
    return np.max(np.abs([histories[name] for name in names]), axis=0)


def run(case, folder, options, value, check=False):
    """Whether it stands, and its largest motion."""
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        output = os.path.join(scratch, "output")
        file = os.path.join(scratch, "geometry.geo")
        if case.get("geometry"):
            write_geometry(folder, file, value)
        sets = [text.format(value="%.6g" % value,
                            file=os.path.relpath(file, folder))
                for text in case["set"]]
        failure, start = None, time.monotonic()
        try:
            common.run(options.quoin,
                       os.path.join(folder, case.get("prm", "case.prm")),
                       output, sets)
        except common.RunFailed as stopped:
            # blocks that fall may end the run; what they did before counts
            failure = stopped
        seconds = time.monotonic() - start
        try:
            histories, _ = common.read_table(
                os.path.join(output, "histories.csv"))
        except Failure:
            raise failure or Failure("no histories")
        size = motion(case, histories)
        largest = float(np.max(size))
        if failure and largest < case["bound"]:
            raise failure
        last = size[histories["time"] > 0.8 * histories["time"][-1]]
        resting = np.ptp(last) < 0.02 * largest
        stands = (largest < case["bound"]
                  and (resting or not case.get("at rest")))
        print("  %.5g: %s, largest motion %.3g m, %s, %.1f s" % (
            value, "stands" if stands else "collapses", largest,
            "at rest" if resting else "moving", seconds), flush=True)
        extra = {}
        if check and "check" in case:
            extra = getattr(checks, case["check"])(case, folder, output,
                                                   histories)
        failed = []
        if stands:
            extra.update(checks.energy_residual(case, folder, output,
                                                histories))
            failed = common.unexpected_warnings(case.get("warnings", []),
                                                output)
    tolerances = {"energy residual": common.MOST_RESIDUAL,
                  **case.get("tolerances", {})}
    for label, error in extra.items():
        bound = tolerances[label]
        print("    %-28s %.3e  tolerance %.1e" % (label, error, bound))
        if not error <= bound:
            failed.append("%s %.3e > %.1e" % (label, error, bound))
    if failed:
        raise Failure("%s at %.5g: %s" % (case["name"], value,
                                          "; ".join(failed)))
    return stands, largest


def run_case(case, options):
    results = common.begin(options, case["name"])
    folder = os.path.join(common.VERIFICATION, case["folder"])
    table, _ = common.read_table(os.path.join(folder, "reference.csv"))
    low, high = (table[case["reference"][i]][0] for i in (0, -1))
    below = low - case.get("margin", low * case.get("share", 0))
    above = high + case.get("margin", high * case.get("share", 0))
    safe, unsafe = ((above, below) if case["stands"] == "above"
                    else (below, above))
    start = time.monotonic()
    if not run(case, folder, options, safe)[0]:
        raise Failure("%s: does not stand at %.5g" % (case["name"], safe))
    stands, largest = run(case, folder, options, unsafe, check=True)
    if stands or largest < case["bound"]:
        raise Failure("%s: does not collapse at %.5g" % (case["name"], unsafe))
    steps = case.get("steps", 0) if options.steps is None else options.steps
    for _ in range(steps):
        middle = (safe + unsafe) / 2
        safe, unsafe = ((middle, unsafe)
                        if run(case, folder, options, middle)[0]
                        else (safe, middle))
    found = (safe + unsafe) / 2
    error = max(low - found, found - high, 0) / found
    tolerance = max((low - below) / low, (above - high) / high)
    common.write_result(
        results, case["name"], title=case["title"],
        reference=case["source"], error=error, tolerance=tolerance,
        seconds=round(time.monotonic() - start, 2), passed=True,
        limit=found, between=sorted((safe, unsafe)))
    print("passed: %s: limit between %.5g and %.5g, reference %s, %.1f s"
          % (case["name"], *sorted((safe, unsafe)),
             "%.5g" % low if low == high else "%.5g to %.5g" % (low, high),
             time.monotonic() - start))


def main():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", help="names; none: all of them")
    parser.add_argument("--steps", type=int,
                        help="bisections between the ends (default: the "
                        "case's own)")
    options = parser.parse_args()
    cases = load_cases()
    failures = []
    for name in options.cases or cases:
        if name not in cases:
            raise Failure("no case '%s'; there are: %s"
                          % (name, ", ".join(cases)))
        print(name)
        try:
            run_case(cases[name], options)
        except Failure as failure:
            print("FAILED: %s" % failure)
            failures.append(name)
    if failures:
        raise Failure("%d cases: %s" % (len(failures), ", ".join(failures)))


if __name__ == "__main__":
    common.main(main)
