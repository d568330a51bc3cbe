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
import numpy as np

from quoin import figures, vtu  # noqa: F401  (the look)
from quoin.colours import COMPRESSION, TENSION
from quoin.commands.options import Parser

SHARE = 0.15  # of the model's size: the largest value


def normals(grid, place):
    """The mean left normal at each point."""
    way = place[grid.cells[:, 1]] - place[grid.cells[:, 0]]
    across = np.column_stack([-way[:, 1], way[:, 0]])
    across /= np.linalg.norm(across, axis=1)[:, None]
    total = np.zeros_like(place)
    for k in (0, 1):
        np.add.at(total, grid.cells[:, k], across)
    return total / np.linalg.norm(total, axis=1)[:, None]


def draw_field(axes, grid, name, unit):
    place = grid.points - grid.point_data["displacement"][:, :2]
    value = grid.point_data[name] / 1e3
    most = np.abs(value).max()
    size = np.ptp(place, axis=0).max()
    far = place + (SHARE * size / (most or 1.0)) * value[:, None] \
        * normals(grid, place)
    for a, b in grid.cells:
        corners = np.array([place[a], place[b], far[b], far[a]])
        positive = value[a] + value[b] > 0
        axes.fill(*corners.T, color=TENSION if positive else COMPRESSION, alpha=0.35,
                  linewidth=0)
        axes.plot(*place[[a, b]].T, color="black", linewidth=1.2)
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
