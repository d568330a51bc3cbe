# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Pictures of a run of boundary elements for scripts/render: the field in the
domain, if it was sampled, and the boundary."""

import os

from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
import matplotlib.pyplot as plt
import numpy as np

from quoin import vtu
from quoin.colours import FIELD

UNITS = {"velocity": "m/s", "displacement": "m"}


def is_field_run(output):
    """Whether there are boundary elements and no blocks."""
    return (vtu.exists(os.path.join(output, "boundary.pvd"))
            and not vtu.exists(os.path.join(output, "blocks.pvd")))


class FieldFrame:
    """Field and boundary at one moment; the field may be None."""

    def __init__(self, output, time, label=None):
        def series(name):
            path = os.path.join(output, name)
            return vtu.read_at(path, time) if vtu.exists(path) else None

        self.label = label
        self.boundary = series("boundary.pvd")
        if self.boundary is None:
            raise ValueError("no field was written to boundary.pvd")
        self.time = self.boundary.time
        self.field = series("field.pvd")
        if self.field is not None and self.field.time != self.time:
            self.field = None

    def magnitude(self, name):
        """Magnitude of the field at its points, or of the boundary on its
        elements."""
        data = (self.boundary.cell_data if self.field is None
                else self.field.point_data)
        return np.linalg.norm(data[name][:, :2], axis=1)


class FieldPicture:
    """Draws frames with one view and one range of colours."""

    DIGITS = 3                       # of a time

    def __init__(self, options, frames):
        self.options = options
        self.name = ("displacement" if options.colour == "displacement"
                     else "velocity")
        if options.view:
            self.low, self.high = np.reshape(options.view, (2, 2))
        else:
            places = [(f.field or f.boundary).points for f in frames]
            self.low = np.min([p.min(axis=0) for p in places], axis=0)
            self.high = np.max([p.max(axis=0) for p in places], axis=0)
        self.extent = np.maximum(self.high - self.low,
                                 0.1 * (self.high - self.low).max())
        # A few points at the source must not make all others pale.
        largest = max(np.quantile(f.magnitude(self.name), 0.995)
                      for f in frames)
        self.values = Normalize(0.0, largest or 1.0, clip=True)

    def draw(self, axes, frame, with_count):
        """One moment; there is no legend."""
        axes.grid(False)
        lines = frame.boundary.points[frame.boundary.cells]
        value = frame.magnitude(self.name)
        if frame.field is not None:
            x, y = frame.field.points.T
            axes.tripcolor(x, y, frame.field.cells, value, norm=self.values,
                           cmap=FIELD, shading="gouraud", rasterized=True)
            axes.add_collection(LineCollection(lines, colors="0.1",
                                               linewidths=1.0))
        else:
            axes.add_collection(LineCollection(
                lines, colors=plt.get_cmap(FIELD)(self.values(value)),
                linewidths=2.0))
        margin = 0.0 if self.options.view else 0.04 * self.extent.max()
        axes.set_xlim(self.low[0] - margin, self.high[0] + margin)
        axes.set_ylim(self.low[1] - margin, self.high[1] + margin)
        axes.set_aspect("equal")
        return []

    def caption(self, frame, form):
        for factor, unit in ((1.0, "s"), (1e3, "ms")):
            if frame.time * factor >= 0.1:
                break
        if factor != 1.0 and form.endswith("f"):
            form = f"{max(0, int(form[:-1]) - 3)}f"  # decimals of seconds
        return frame.label or f"t = {frame.time * factor:.{form}} {unit}"

    def remark(self):
        return ""

    def colour_bars(self):
        return [(ScalarMappable(self.values, plt.get_cmap(FIELD)),
                 f"{self.name} [{UNITS[self.name]}]")]
