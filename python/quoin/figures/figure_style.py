# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The look that all figures share."""

import matplotlib
import matplotlib.colors

from quoin.colours import CURVES, VALUES

matplotlib.use("Agg")
matplotlib.rcParams.update(
    {
        "figure.dpi": 100,
        "savefig.dpi": 200,
        "font.size": 10,
        "axes.titlesize": 11,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.prop_cycle": matplotlib.cycler(color=CURVES),
        "axes.grid": True,
        "grid.color": "0.9",
        "grid.linewidth": 0.6,
        "axes.axisbelow": True,
        "legend.frameon": False,
        "lines.linewidth": 1.5,
    }
)

# from none to much; of compression, which is negative, the other way round
MAGNITUDES = matplotlib.colors.LinearSegmentedColormap.from_list(
    "values", VALUES)
STRESSES = MAGNITUDES.reversed()
