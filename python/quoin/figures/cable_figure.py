# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Bolts and cables for block_figure: lines as wide as they are loaded."""

from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
import numpy as np

from quoin import colours
from quoin.csv_table import with_unit

WIDEST, THINNEST = 3.5, 0.7          # [pt]
BROKEN = 2                           # state of an element


def axial_forces(cables):
    return np.abs(cables.cell_data["axial force"])


def draw_cables(axes, cables, position, largest_force):
    """Draws bars at the given positions; returns the handles of the legend."""
    force = axial_forces(cables)
    broken = cables.cell_data["state"] == BROKEN
    width = THINNEST + (WIDEST - THINNEST) * np.clip(
        force / max(largest_force, 1e-300), 0.0, 1.0)
    lines = position[cables.cells]
    handles = []
    for shown, style, what in ((~broken, "solid", "bolt"),
                               (broken, "dotted", "broken bolt")):
        if not shown.any():
            continue
        axes.add_collection(LineCollection(
            lines[shown], colors=colours.BAR, linewidths=width[shown],
            linestyles=style, capstyle="butt", zorder=4))
        label = what if style == "dotted" or largest_force == 0.0 \
            else f"{what}, {with_unit(largest_force, 'N')}"
        handles.append(Line2D([], [], color=colours.BAR, linestyle=style,
                              linewidth=WIDEST if style == "solid"
                              else THINNEST, label=label))
    return handles
