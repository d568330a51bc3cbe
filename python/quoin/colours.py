# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The colours of all figures, chosen so that they differ for colour-blind
readers, too, and in lightness when they are printed grey.
Without any import, for ParaView's Python.

Joints and cracks are warm colours, the values in blocks a blue scale, so that
one can be read on the other. Curves take the palette of @cite Wong2011
without its yellow, which is lost on white.
"""

ORANGE, RED, VIOLET, YELLOW = "#e05c00", "#8b0a1a", "#3f2a96", "#f5c400"
INTACT = "#9e9e9e"
BAR = "#000000"
COMPRESSION, TENSION = "#1f4e9c", "#c0282d"
CURVES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
          "#000000")
MATERIALS = ("#f0ebe0", "#b7cde8", "#b0aeb4", "#d9a898")
# tints of one stone, that need not be told apart
STONES = ("#d9c9ad", "#c9b693", "#e3d7c0", "#bfb3a0", "#d3bf9f", "#cbbfae",
          "#b9a888")
# values in blocks, from little to much: PuBu of @cite HarrowerBrewer2003
VALUES = ("#fff7fb", "#ece7f2", "#d0d1e6", "#a6bddb", "#74a9cf", "#3690c0",
          "#0570b0", "#045a8d", "#023858")
FIELD = "magma_r"                    # matplotlib's
# from sound to lost, darker all the way
DAMAGE = ("#c8c8c8", "#f5a83c", "#e8602c", "#b01030", "#4a0a28")
