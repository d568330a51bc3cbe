# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws axial force and moment of beams and liners along their lines.

  scripts/beam_figure OUTPUT_DIR
  scripts/beam_figure OUTPUT_DIR --time 0.2 --out beams.pdf

Of the fields in beams.pvd, at the last time or that of --time, it draws N and M
across the lines where they were placed: positive values on their left.
"""

import os
import sys

import matplotlib.pyplot as plt

from quoin import figures, vtu  # noqa: F401  (the look)
from quoin.commands.options import Parser
from quoin.figures.beam_lines import draw_diagram

def draw_field(axes, grid, name, unit):
    place = grid.points - grid.point_data["displacement"][:, :2]
    draw_diagram(axes, grid, place, name)
    value = grid.point_data[name] / 1e3
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.set_title(f"{name}, {value.min():.4g} to {value.max():.4g} {unit}")


def draw(options):
    path = os.path.join(options.output, "beams.pvd")
    if not vtu.exists(path):
        raise ValueError(f"{path}: the run has no beams")
    grid = vtu.read_at(path, options.time)
    if grid is None or len(grid.cells) == 0:
        raise ValueError(f"{path}: no beam is placed at that time")
    figure, axes = plt.subplots(1, 2, figsize=(9.0, 4.4),
                                constrained_layout=True)
    draw_field(axes[0], grid, "axial force", "kN")
    draw_field(axes[1], grid, "moment", "kN m")
    name = options.out or os.path.join(options.output, "beams.png")
    figure.savefig(name, dpi=200)
    return name


def main():
    parser = Parser(__doc__)
    parser.add_argument("output", metavar="OUTPUT_DIR")
    parser.add_argument("--time", type=float,
                        help="of the fields [s], default the last")
    parser.add_argument("--out", metavar="FILE",
                        help="default OUTPUT_DIR/beams.png")
    try:
        print(draw(parser.parse_args()))
    except (OSError, ValueError) as error:
        sys.exit(f"beam_figure: {error}")


if __name__ == "__main__":
    main()
