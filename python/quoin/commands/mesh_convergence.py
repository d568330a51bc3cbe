# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs a case on its mesh and on finer ones, and says what the results tend to.

  scripts/mesh_convergence CASE.prm
  scripts/mesh_convergence CASE.prm --refinements 2 --only "factor of safety"
  scripts/mesh_convergence CASE.prm --set Solver=implicit

Edges are halved in each refinement (entry Refinements of section Mesh); a plane
model then has four times the cells, and an explicit run takes eight times as
long. Shown are factors of safety and, of each history, the value of largest
magnitude and the last one: on each mesh, what they tend to, how far the finest
mesh is from that, and the order of convergence. With one refinement the order is
taken as --order says: 1 where materials yield, also if the elements have order
2. With two or more it is measured; where the last three values are not on their
way to a limit nothing is said: refine further. A collapse load or a factor of
safety of finite elements lies above the limit.

Results go to the output directory of the case with _mesh at its end (or --output
DIR): a folder each run, study.csv, and mesh_convergence.csv, the table on the
screen. Runs that are there already are not made again, unless the parameter file,
the mesh or a table has changed.
"""

import csv
import math
import os
import sys

from quoin import run_parameters
from quoin.commands.options import Parser, positive
from quoin.mesh_convergence import mesh_convergence


def rows_of(found, refinements):
    """The table: a heading and a row each quantity."""
    heading = ["quantity"] + [f"mesh {i}" for i in range(refinements + 1)]
    rows = [heading + ["limit", "finest mesh off [%]", "order"]]
    for name, (values, limit, order) in found.items():
        off = 100 * (values[-1] / limit - 1) if limit else math.nan
        rows.append([name] + [f"{value:.6g}" for value in values]
                    + [shown(limit, ".6g"), shown(off, ".2g"),
                       shown(order, ".2f")])
    return rows


def shown(value, form):
    return "-" if not math.isfinite(value) else format(value, form)


def settings(texts):
    """{"Section/Name": value} of "Section/Name=value"."""
    for text in texts:
        if "=" not in text:
            raise ValueError(f"--set takes \"Section/Name=value\", not "
                             f"'{text}'")
    return dict(text.split("=", 1) for text in texts)


def compare_meshes(options):
    output = options.output or run_parameters.output_of(
        options.case, options.set) + "_mesh"
    found = mesh_convergence(
        options.case, output, options.refinements, settings(options.set),
        options.order, quoin=options.quoin)
    found = {name: value for name, value in found.items()
             if options.only in name}
    if not found:
        raise ValueError(f"no result of {options.case} has "
                         f"'{options.only}' in its name" if options.only else
                         f"{options.case} has neither histories nor a factor "
                         "of safety to compare")
    rows = rows_of(found, options.refinements)
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join([row[0].ljust(widths[0])] + [
            cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]))
    with open(os.path.join(output, "mesh_convergence.csv"), "w", newline="",
              encoding="utf-8") as file:
        csv.writer(file).writerows(rows)


def main():
    parser = Parser(__doc__)
    parser.add_argument("case", metavar="CASE.prm")
    parser.add_argument("--refinements", type=positive(int), default=1,
                        help="of the finest mesh, default 1")
    parser.add_argument("--order", type=positive(float), default=1.0,
                        help="of convergence with one refinement, default 1")
    parser.add_argument("--only", default="", metavar="TEXT",
                        help="quantities that have it in their names")
    parser.add_argument("--set", action="append", default=[],
                        metavar="Section/Name=VALUE", help="of all runs")
    parser.add_argument("--output", metavar="DIR")
    parser.add_argument("--quoin", metavar="FILE",
                        help="the executable, default build/quoin")
    options = parser.parse_args()
    try:
        compare_meshes(options)
    except (OSError, ValueError) as error:
        sys.exit(f"mesh_convergence: {error}")


if __name__ == "__main__":
    main()
