# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws curves from the tables of one or several runs, with references.

  scripts/plot OUTPUT_DIR --x ux --y fh
  scripts/plot OUTPUT_DIR --x "ux [m]" --y fh --x-factor 1e3 --y-factor 1e-3 \\
               --x-label "displacement [mm]" --y-label "force [kN]" --peak \\
               --reference reference.csv --out force_displacement.png
  scripts/plot OUTPUT_DIR --spec plot.json
  scripts/plot RUN1 RUN2 --spec plot.json --label Coulomb --label composite \\
               --band 46 52 --out both.pdf

A column is named in full, "ux [m]", or without its unit, "ux". Without --x
it is the first column, without --y all others that are not zero throughout. Those of
each unit stand on axes of their own, unless --y-label has a unit in brackets for all.
Factors of 1e3, 1e-3, ... change the unit that is written there; a label without a
unit gets it. Without factor, label, reference and band the unit is one in which the
numbers can be read: mm, kN, MPa. A reference is drawn from its
columns of the same names, or else from its first two columns, with its own
numbers unless --reference-scaled applies the factors to it, too.

--band A B shades what lies between two numbers on the y axis, as the smallest
and the largest peak of a series of tests, or between two curves, each the
first two columns of a csv file whose x grows; with the numbers as they are
unless --reference-scaled is given. It may be repeated, with a --band-label each.

--after TIME draws the rows from that time on alone, --after STAGE those since that
stage began.

--peak marks the largest magnitude of each curve, within the limits of the x
axis, and says it in the legend.

A case describes its figures in plot.json beside its prm file, either one
object or a list of them:

  {
    "out": "force_displacement.png",     name in OUTPUT_DIR; .pdf, .svg
    "title": "Shear wall",
    "size": [85, 65],                    [mm]
    "table": "histories.csv",            or energies.csv
    "peak": true,                        of all curves
    "after": "push",                     a stage, or a time [s]
    "legend": "lower right",             or true, false
    "x": {"column": "ux", "factor": 1e3, "label": "displacement [mm]",
          "limits": [0, 4]},
    "y": {"label": "horizontal force [kN]", "factor": -1e-3,
          "limits": [0, 80]},
    "curves": [{"column": "fh", "label": "quoin", "factor": -1e-3,
                "x": "ux", "style": "-", "color": "k", "peak": true}],
    "runs": [{"folder": "output_coarse", "label": "coarse"}],
    "references": [{"file": "reference.csv", "x": "ux", "y": "fh",
                    "x_factor": 1, "y_factor": 1, "label": "experiment",
                    "style": "o", "color": "0.3", "peak": true}],
    "bands": [{"from": 46, "to": 52, "over": [0, 2], "label": "peaks"},
              {"curves": [{"file": "test_1.csv", "x": 0, "y": 1},
                          {"file": "test_2.csv", "y_factor": 1e-3}],
               "label": "tests", "color": "0.7"}]
  }

Only "curves" with their "column" are needed. The factor of "y" applies to
curves that have none; "x" of a curve replaces the common column. "style" is
matplotlib's, e.g. "--" or "k.". "runs" come beside those of the command line.
The files of references and bands and the folders of runs are looked for beside
plot.json; columns of files are names or numbers from 0 (default 0 and 1). A
band lies between "from" and "to" of the y axis as it is shown, over all x
unless "over" says where, or between the lowest and the highest of two or more
"curves", where all of them are. A curve may have a "table" of its own.
"""

import os
import sys

import numpy as np

from quoin.commands.options import Parser
from quoin.csv_table import Table, scale_for, unit_of
from quoin.figures.curve_figure import CurveFigure, read_specs
from quoin.stages import time_or_name


def scales_beside(options):
    """Factors of x and y of references and bands."""
    if not options.reference_scaled:
        return 1.0, 1.0
    return options.x_factor or 1.0, options.y_factor or 1.0


def references_from(options, x, columns):
    scale_x, scale_y = scales_beside(options)
    references = []
    for path in options.reference:
        other = Table(path)
        pairs = [(x, column) for column in columns
                 if other.find(x) is not None
                 and other.find(column) is not None]
        for x_column, y_column in pairs or [(0, 1)]:
            references.append({
                "file": os.path.abspath(path),
                "label": os.path.splitext(os.path.basename(path))[0],
                "x": x_column, "x_factor": scale_x,
                "y": y_column, "y_factor": scale_y,
            })
    return references


def bands_from(options):
    labels = options.band_label
    if labels and len(labels) != len(options.band):
        raise ValueError(f"there are {len(options.band)} --band and "
                         f"{len(labels)} --band-label; give one each")
    bands = bands_without_labels(options)
    for band, label in zip(bands, labels):
        band["label"] = label
    return bands


def bands_without_labels(options):
    bands = []
    for pair in options.band:
        try:
            first, last = (float(word) for word in pair)
            bands.append({"from": first, "to": last})
            continue
        except ValueError:
            pass
        for word in pair:
            if not os.path.exists(word):
                raise ValueError(f"--band takes two numbers or two csv files, "
                                 f"not '{pair[0]}' and '{pair[1]}'")
        scale_x, scale_y = scales_beside(options)
        bands.append({"curves": [
            {"file": os.path.abspath(word), "x_factor": scale_x,
             "y_factor": scale_y} for word in pair]})
    return bands


def factors_of(data, columns):
    """{column: factor} by which columns of a table become readable: those of
    one unit by the largest of all."""
    largest = {}
    for column in columns:
        unit = unit_of(data.full_name(column))
        size = np.abs(data.column(column))
        largest[unit] = max(largest.get(unit, 0.0),
                            size[np.isfinite(size)].max(initial=0.0))
    factors = {unit: scale_for(unit, size)[0] if size > 0.0 else 1.0
               for unit, size in largest.items()}
    return {column: factors[unit_of(data.full_name(column))]
            for column in columns}


def spec_from_options(options):
    """The description that the command line stands for."""
    data = Table(os.path.join(options.output[0], options.table))
    x = options.x if options.x is not None else data.names[0]
    columns = options.y or [
        name for i, name in enumerate(data.names) if i != data.find(x)
        and np.any(data.column(i) != 0.0)
    ] or [name for name in data.names if data.find(name) != data.find(x)]
    spec = {
        "table": options.table,
        "x": {"column": x, "factor": options.x_factor,
              "label": options.x_label},
        "y": {"factor": options.y_factor, "label": options.y_label},
        "curves": [{"column": column} for column in columns],
        "references": references_from(options, x, columns),
    }
    # what comes beside has its own numbers
    is_alone = not (options.reference or options.band)
    if is_alone and not (options.x_factor or options.x_label):
        spec["x"]["factor"] = factors_of(data, [x])[x]
    if is_alone and not (options.y_factor or options.y_label):
        factors = factors_of(data, columns)
        for curve in spec["curves"]:
            curve["factor"] = factors[curve["column"]]
    for axis in ("x", "y"):
        spec[axis]["factor"] = spec[axis]["factor"] or 1.0
    return spec


def draw(options):
    if options.label and len(options.label) != len(options.output):
        raise ValueError(f"there are {len(options.output)} runs and "
                         f"{len(options.label)} --label; give one each")
    specs = (read_specs(options.spec) if options.spec
             else [spec_from_options(options)])
    if options.out and len(specs) > 1:
        raise ValueError(f"{options.spec} describes {len(specs)} figures and "
                         f"names them itself: leave --out away")
    runs = list(zip(options.output,
                    options.label or [None] * len(options.output)))
    for spec in specs:
        if isinstance(spec, dict):
            if options.title:
                spec["title"] = options.title
            if options.peak:
                spec["peak"] = True
            if options.after is not None:
                spec["after"] = options.after
            if options.band or options.band_label:
                spec["bands"] = spec.get("bands", []) + bands_from(options)
        figure = CurveFigure(spec, runs, os.path.dirname(options.spec or ""))
        print(figure.save(options.out))


def main():
    parser = Parser(__doc__)
    parser.add_argument("output", metavar="OUTPUT_DIR", nargs="+")
    parser.add_argument("--label", metavar="TEXT", action="append", default=[],
                        help="of each run, in their order; default the names "
                             "of the folders")
    parser.add_argument("--spec", metavar="plot.json")
    parser.add_argument("--table", default="histories.csv")
    parser.add_argument("--x", metavar="COLUMN")
    parser.add_argument("--y", metavar="COLUMN", nargs="+", action="extend")
    parser.add_argument("--x-factor", type=float)
    parser.add_argument("--y-factor", type=float)
    parser.add_argument("--x-label")
    parser.add_argument("--y-label")
    parser.add_argument("--title")
    parser.add_argument("--peak", action="store_true",
                        help="mark the peak and say it in the legend")
    parser.add_argument("--reference", metavar="CSV", action="append",
                        default=[])
    parser.add_argument("--reference-scaled", action="store_true")
    parser.add_argument("--band", nargs=2, metavar=("A", "B"),
                        action="append", default=[],
                        help="two numbers on the y axis, or two csv files")
    parser.add_argument("--band-label", metavar="TEXT", action="append",
                        default=[], help="of each band, in their order, "
                        "default experiments")
    parser.add_argument("--after", type=time_or_name, metavar="TIME",
                        help="draw the rows from this time [s] on, or since "
                             "the stage of this name began")
    parser.add_argument("--out", metavar="FILE", help=".png, .pdf or .svg")
    try:
        draw(parser.parse_args())
    except (OSError, ValueError) as error:
        sys.exit(f"plot: {error}")


if __name__ == "__main__":
    main()
