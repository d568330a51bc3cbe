# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Stresses in the blocks for scripts/render: crosses of the principal stresses
on a regular grid, and filled contours of the most compressive one.

Both begin with stresses that are averaged at the nodes, weighted by the areas
of the cells, never across a joint: constant-strain triangles scatter about
their mean.
"""

from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
import numpy as np

from quoin.colours import COMPRESSION, TENSION
from quoin.csv_table import scale_for, with_unit
from quoin.figures.figure_style import STRESSES

LONGEST = 2.5                        # of the reference, in a cross


def round_near(value):
    """The nearest of 1, 2 or 5 times a power of ten."""
    if value <= 0.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    steps = np.array([1.0, 2.0, 5.0, 10.0]) * power
    return float(steps[np.abs(np.log(steps / value)).argmin()])


def cell_areas(blocks):
    """[m^2]"""
    a, b, c = (blocks.points[blocks.cells[:, k]] for k in range(3))
    return 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1]
                        - (b - a)[:, 1] * (c - a)[:, 0])


def nodal_stress(blocks):
    """xx, yy and xy at the nodes [Pa]; nan at nodes without cells."""
    cells = blocks.cells
    area = cell_areas(blocks)
    n = len(blocks.points)

    def total(value):
        return np.bincount(cells.ravel(), np.repeat(value, 3), minlength=n)

    stress = blocks.cell_data["stress"][:, :3]
    with np.errstate(invalid="ignore"):
        return (np.stack([total(area * s) for s in stress.T], axis=1)
                / total(area)[:, None])


def principal(stress):
    """Largest and smallest principal stress and the angle of the first."""
    xx, yy, xy = stress.T
    centre, half = 0.5 * (xx + yy), 0.5 * (xx - yy)
    radius = np.hypot(half, xy)
    return centre + radius, centre - radius, 0.5 * np.arctan2(xy, half)


def grid_points(blocks, spacing):
    """Points of a regular grid in the cells before deformation: (cell of each,
    weights of its three nodes)."""
    corners = blocks.points[blocks.cells]
    # Half a spacing off the edge, so that no row lies on the contour.
    corners = corners - blocks.points.min(axis=0) - 0.5 * spacing
    low = np.ceil(corners.min(axis=1) / spacing).astype(int)
    high = np.floor(corners.max(axis=1) / spacing).astype(int)
    number = np.maximum(high - low + 1, 0)
    count = number.prod(axis=1)
    cell = np.repeat(np.arange(len(count)), count)
    index = np.arange(len(cell)) - np.repeat(np.cumsum(count) - count, count)
    ij = low[cell] + np.stack([index % number[cell, 0],
                               index // number[cell, 0]], axis=1)
    p = ij * spacing

    a, b, c = (corners[cell, k] for k in range(3))

    def cross(u, v):
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    weight = np.stack([cross(b - p, c - p), cross(c - p, a - p),
                       cross(a - p, b - p)], axis=1)
    weight /= cross(b - a, c - a)[:, None]
    inside = (weight >= -1e-9).all(axis=1)
    # A point on an edge is in two cells, perhaps of two blocks: one will do.
    _, first = np.unique(ij[inside], axis=0, return_index=True)
    return cell[inside][first], weight[inside][first]


class CrossLines:
    """Crosses of all frames of a figure with one scale."""

    def __init__(self, sizes, spacing):
        """@p sizes: of each frame the larger magnitudes of principal stresses
        [Pa]; @p spacing: of the crosses [m]."""
        largest = max(size.max() for size in sizes)
        # The few crosses at a corner must not make all others invisible.
        self.reference = round_near(
            max(np.quantile(size, 0.9) for size in sizes) or largest)
        self.is_cut = largest > LONGEST * self.reference
        self.half = 0.45 * spacing / self.reference

    def draw_arms(self, axes, centre, arms, width):
        """@p centre (n, 2) [m]; @p arms: stresses (n) [Pa] and their directions
        (n, 2), shorter than 1 where these leave the page. Returns the handles of
        the legend."""
        for s, way in arms:
            size = np.minimum(np.abs(s), LONGEST * self.reference)
            half = self.half * size[:, None] * way
            lines = np.stack([centre - half, centre + half], axis=1)
            # White below them, or they are lost on dark colours of blocks.
            axes.add_collection(LineCollection(
                lines, colors="white", linewidths=width + 0.8, zorder=2.9))
            axes.add_collection(LineCollection(
                lines, colors=np.where(s < 0.0, COMPRESSION, TENSION),
                linewidths=width, zorder=3))
        return [Line2D([], [], color=COMPRESSION, label="compression"),
                Line2D([], [], color=TENSION, label="tension")]

    def draw_bar(self, axes, corner, strip):
        """The reference stress as a bar in the scale of the crosses, in a
        strip as high as @p strip [m] below this corner, which it clears."""
        length = 2.0 * self.half * self.reference
        x, y = corner
        axes.axhspan(y - strip, y, color="white", linewidth=0, zorder=4)
        y -= 0.55 * strip
        axes.plot([x, x + length], [y, y], color=COMPRESSION, linewidth=1.2,
                  solid_capstyle="butt", clip_on=False, zorder=5)
        text = with_unit(self.reference, "Pa")
        if self.is_cut:
            text += f", cut at {with_unit(LONGEST * self.reference, 'Pa')}"
        axes.text(x + 1.4 * length, y, text, fontsize=7.5, va="center",
                  clip_on=False, zorder=5)


class Crosses(CrossLines):
    """Crosses on a regular grid in the blocks before deformation."""

    def __init__(self, frames, size, n_across):
        self.spacing = size / n_across
        values = [self.values(frame.blocks) for frame in frames]
        super().__init__([np.maximum(np.abs(s1), np.abs(s2))
                          for _, _, s1, s2, _ in values], self.spacing)

    def values(self, blocks):
        cell, weight = grid_points(blocks, self.spacing)
        nodes = blocks.cells[cell]
        stress = np.einsum("ck,ckd->cd", weight, nodal_stress(blocks)[nodes])
        return (nodes, weight, *principal(stress))

    def draw(self, axes, frame, position, width):
        nodes, weight, s1, s2, angle = self.values(frame.blocks)
        centre = np.einsum("ck,ckd->cd", weight, position[nodes])
        return self.draw_arms(axes, centre, [
            (s, np.stack([np.cos(turned), np.sin(turned)], axis=1))
            for s, turned in ((s1, angle), (s2, angle + 0.5 * np.pi))], width)


class Contours:
    """Filled contours of the most compressive stress, with one scale."""

    def __init__(self, frames):
        values = np.concatenate([self.values(f.blocks) for f in frames])
        values = values[np.isfinite(values)]
        low, high = np.quantile(values, [0.01, 0.99])
        largest = max(abs(low), abs(high))
        if high - low <= 1e-3 * largest:
            # the same everywhere: its colour is in the middle
            low, high = low - (largest or 1.0), high + (largest or 1.0)
        self.factor, self.unit = scale_for("Pa", largest)
        self.levels = MaxNLocator(9, steps=[1, 2, 2.5, 5, 10]).tick_values(
            self.factor * low, self.factor * high)
        values = values * self.factor
        self.rounding = 1e-6 * self.factor * largest or 1.0
        self.extend = {(True, True): "both", (True, False): "min",
                       (False, True): "max", (False, False): "neither"}[
            values.min() < self.levels[0], values.max() > self.levels[-1]]

    @staticmethod
    def values(blocks):
        """Principal stress at the nodes [Pa]."""
        return principal(nodal_stress(blocks))[1]

    def draw(self, axes, blocks, position):
        # Blocks share no nodes, so that contours end at joints.
        # Rounded, or stress-free rigid blocks scatter about the level zero.
        value = np.nan_to_num(self.factor * self.values(blocks))
        value = self.rounding * np.round(value / self.rounding)
        axes.tricontourf(*position.T, blocks.cells, value,
                         levels=self.levels, cmap=STRESSES,
                         extend=self.extend)

    def mappable(self):
        return ScalarMappable(BoundaryNorm(self.levels, STRESSES.N,
                                           extend=self.extend), STRESSES)
