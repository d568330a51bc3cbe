# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws axial force and moment of beams and liners along their lines.

  scripts/beam_figure OUTPUT_DIR
  scripts/beam_figure OUTPUT_DIR --time 0.2 --out beams.pdf
  scripts/beam_figure OUTPUT_DIR --diagram

Of the fields in beams.pvd, at the last time or that of --time, a time or the end of a
stage, it draws N and M across the lines where they were placed: positive values on
their left. --diagram
draws M against N of all nodes of beams with strengths, one picture each: within the
lines the elastic stresses of the outer fibres, N/A and M by the section modulus, stay
below the strengths divided by 1, 1.5 and 2.
"""

import os
import sys

import matplotlib.pyplot as plt
import numpy as np

from quoin import figures, run_parameters, vtu  # noqa: F401  (the look)
from quoin.colours import COMPRESSION
from quoin.commands.options import Parser
from quoin.figures.beam_lines import draw_diagram
from quoin.moments import check_times
from quoin.stages import end, time_of, time_or_name

NEEDED = ("Thickness", "Area", "Second moment", "Depth",
          "Compressive strength", "Tensile strength")


def draw_field(axes, grid, name, unit):
    place = grid.points - grid.point_data["displacement"][:, :2]
    draw_diagram(axes, grid, place, name)
    value = grid.point_data[name] / 1e3
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.set_title(f"{name}, {value.min():.4g} to {value.max():.4g} {unit}")


def strengths_of(output):
    """Of each beam with a section and strengths: name, A [m2], section modulus
    [m3], strength in compression and in tension [Pa], by its number."""
    beams = run_parameters.read(output).get("Beams", {})
    names = [name.strip() for name in beams.get("Names", "").split(",")]
    result = {}
    for number, entries in enumerate(beams.get(name, {}) for name in names):
        value = {key: float(text) for key, text in entries.items()
                 if key in NEEDED and text != "unlimited"}
        if not {"Compressive strength", "Tensile strength"} <= set(value):
            continue
        width = value["Thickness"]
        area = width or value["Area"]
        second = width ** 3 / 12 if width else value["Second moment"]
        depth = value["Depth"] or np.sqrt(12 * second / area)
        result[number] = (names[number], area, 2 * second / depth,
                          value["Compressive strength"],
                          value["Tensile strength"])
    return result


def draw_diagrams(figure, grid, sections):
    for axes, (number, (name, area, modulus, crush, tear)) in zip(
            figure.subplots(1, len(sections), squeeze=False).flat,
            sections.items()):
        at = np.unique(grid.cells[grid.cell_data["beam"] == number])
        for factor, width in ((1.0, 1.6), (1.5, 1.0), (2.0, 0.6)):
            thrust = np.array([-crush, 0.5 * (tear - crush), tear]) / factor
            moment = np.array([0.0, 0.5 * (tear + crush), 0.0]) / factor
            for side in (1, -1):
                axes.plot(side * moment * modulus / 1e3, thrust * area / 1e3,
                          color="black", linewidth=width,
                          label=f"factor {factor:g}" if side > 0 else None)
        axes.plot(grid.point_data["moment"][at] / 1e3,
                  grid.point_data["axial force"][at] / 1e3, "o",
                  markersize=3.0, color=COMPRESSION, label=name)
        axes.set_xlabel("moment [kN m]")
        axes.set_ylabel("axial force [kN]")
        axes.legend(fontsize=8)


def draw(options):
    path = os.path.join(options.output, "beams.pvd")
    if not vtu.exists(path):
        raise ValueError(f"{path}: the run has no beams")
    time = time_of(options.output, options.time, end)
    if time is not None:
        check_times(options.output, "beams.pvd", [time])
    grid = vtu.read_at(path, time)
    if grid is None or len(grid.cells) == 0:
        raise ValueError(f"{path}: no beam is placed at that time")
    title = f"t = {grid.time:.4g} s"
    if options.diagram:
        sections = {number: section for number, section
                    in strengths_of(options.output).items()
                    if np.any(grid.cell_data["beam"] == number)}
        if not sections:
            raise ValueError("no beam that is placed has a 'Compressive "
                             "strength' and a 'Tensile strength'")
        figure = plt.figure(figsize=(4.8 * len(sections), 4.4),
                            constrained_layout=True)
        draw_diagrams(figure, grid, sections)
        figure.suptitle(title)
        name = options.out or os.path.join(options.output, "thrust_moment.png")
        figure.savefig(name, dpi=200)
        return name
    figure, axes = plt.subplots(1, 2, figsize=(9.0, 4.4),
                                constrained_layout=True)
    draw_field(axes[0], grid, "axial force", "kN")
    draw_field(axes[1], grid, "moment", "kN m")
    figure.suptitle(title)
    name = options.out or os.path.join(options.output, "beams.png")
    figure.savefig(name, dpi=200)
    return name


def main():
    parser = Parser(__doc__)
    parser.add_argument("output", metavar="OUTPUT_DIR")
    parser.add_argument("--time", type=time_or_name,
                        help="of the fields [s], or a stage: its end; default "
                             "the last")
    parser.add_argument("--diagram", action="store_true",
                        help="M against N, with lines of the strengths")
    parser.add_argument("--out", metavar="FILE",
                        help="default OUTPUT_DIR/beams.png, or "
                             "thrust_moment.png")
    try:
        print(draw(parser.parse_args()))
    except (OSError, ValueError) as error:
        sys.exit(f"beam_figure: {error}")


if __name__ == "__main__":
    main()
