# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What a case gives on its mesh and on finer ones, and what that tends to.

With the results f_0, f_1, f_2 of meshes whose edges are halved each time, the
order of convergence is p = log2((f_0 - f_1) / (f_1 - f_2)), and the results tend
to f_2 + (f_2 - f_1) / (2^p - 1) (Richardson 1911; Roache 1994).
"""

import math

from quoin.studies import study

ORDERS = (0.4, 4.5)          # outside of these meshes are not yet fine enough
REFINEMENTS = "Mesh/Refinements"


def quantities(results):
    """{name: value}: factors of safety, and of each history its largest
    magnitude, with sign, and its last value."""
    found = {}
    for stage, bracket in results.summary.get("factor of safety", {}).items():
        if "stable at" in bracket and "failing at" in bracket:
            found[f"{stage}: factor of safety"] = 0.5 * (
                bracket["stable at"] + bracket["failing at"])
    histories = results.histories
    for name in list(histories)[1:]:
        column = [value for value in histories[name] if math.isfinite(value)]
        if column:
            found[f"{name}: largest"] = max(column, key=abs)
            found[f"{name}: last"] = column[-1]
    return found


def limit(values, order=1.0):
    """(what the values of ever finer meshes tend to, order of convergence).
    Of two values the order is @p order; of three or more it comes from the last
    three, and both are nan if these are not on their way to a limit."""
    values = list(values)
    last = values[-1] - values[-2]
    if last == 0.0:
        return values[-1], math.inf
    if len(values) > 2:
        ratio = (values[-2] - values[-3]) / last
        order = math.log2(ratio) if ratio > 0 else math.nan
        if not ORDERS[0] <= order <= ORDERS[1]:
            return math.nan, math.nan
    return values[-1] + last / (2.0 ** order - 1.0), order


def mesh_convergence(case, output, refinements=1, overrides=None, order=1.0,
                     **options):
    """Runs a case with Mesh/Refinements = 0, ..., @p refinements and returns
    {quantity: (values, limit, order)}, see quantities() and limit().

    @p overrides: {"Section/Name": value} of all runs. @p options: those of
    study(), in whose folder @p output the runs are. Throws ValueError if a run
    failed.
    """
    grid = {name: [value] for name, value in (overrides or {}).items()}
    grid[REFINEMENTS] = list(range(refinements + 1))
    table = study(case, grid, output, quantities, **options)
    for status, message in zip(table["status"], table["message"]):
        if status != "finished":
            raise ValueError(f"{case}: {message}")
    known = quantities_of(table)
    return {name: (values, *limit(values, order))
            for name, values in known.items()}


def quantities_of(table):
    """The columns of a study that quantities() gave, in order of refinement;
    those that each run has."""
    names = list(table)
    columns = {}
    for name in names[names.index("folder") + 1:]:
        pairs = sorted(zip(table[REFINEMENTS], table[name]))
        values = [float(value) for _, value in pairs]
        if all(math.isfinite(value) for value in values):
            columns[name] = values
    return columns
