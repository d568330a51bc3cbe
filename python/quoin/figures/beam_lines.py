# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Beams and liners with N or M drawn across their lines."""

from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
import numpy as np

from quoin.colours import BAR, COMPRESSION, TENSION
from quoin.csv_table import with_unit

SHARE = 0.15  # of the size of the beams: the largest value
UNITS = {"axial force": "N", "moment": "N m"}


def normals(grid, place):
    """The mean left normal at each point."""
    way = place[grid.cells[:, 1]] - place[grid.cells[:, 0]]
    across = np.column_stack([-way[:, 1], way[:, 0]])
    across /= np.linalg.norm(across, axis=1)[:, None]
    total = np.zeros_like(place)
    for k in (0, 1):
        np.add.at(total, grid.cells[:, k], across)
    return total / np.linalg.norm(total, axis=1)[:, None]


def draw_line(axes, grid, place, width=1.2):
    axes.add_collection(LineCollection(place[grid.cells], colors="black",
                                       linewidths=width, zorder=5))


def draw_diagram(axes, grid, place, name):
    """Draws the lines and @p name across them, positive values on their left;
    returns the largest magnitude."""
    value = grid.point_data[name]
    most = np.abs(value).max()
    size = np.ptp(place, axis=0).max()
    far = place + (SHARE * size / (most or 1.0)) * value[:, None] \
        * normals(grid, place)
    a, b = grid.cells.T
    axes.add_collection(PolyCollection(
        np.stack([place[a], place[b], far[b], far[a]], axis=1), alpha=0.35,
        linewidths=0.0, zorder=3,
        facecolors=np.where(value[a] + value[b] > 0, TENSION, COMPRESSION)))
    draw_line(axes, grid, place)
    return most


def draw_beams(axes, grid, place, name):
    """Of render: lines alone, or with @p name across them; returns the handles
    of the legend."""
    if name not in UNITS:
        draw_line(axes, grid, place, 2.0)
        return [Line2D([], [], color=BAR, linewidth=2.0, label="beam")]
    most = draw_diagram(axes, grid, place, name)
    value = grid.point_data[name]
    return [Patch(color=colour, alpha=0.35, label=f"{name} {sign} to "
                  + with_unit(most, UNITS[name]))
            for colour, sign, shown in ((TENSION, "> 0", value > 0),
                                        (COMPRESSION, "< 0", value < 0))
            if shown.any()]
