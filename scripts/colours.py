# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The colours of all figures, chosen so that they differ for colour-blind
readers, too, and in lightness when they are printed grey.

Joints and cracks are warm colours, the values in blocks a blue scale, so that
one can be read on the other. Curves take the palette of @cite OkabeIto2008
without its yellow, which is lost on white.
"""

ORANGE, RED, VIOLET, YELLOW = "#e05c00", "#8b0a1a", "#3f2a96", "#f5c400"
INTACT = "0.62"
COMPRESSION, TENSION = "#1f4e9c", "#c0282d"
CURVES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
          "#000000")
MATERIALS = ("#f0ebe0", "#b7cde8", "#ecd48a", "#b0aeb4", "#e9b9a6")
# tints of one stone, that need not be told apart
STONES = ("#d9c9ad", "#c9b693", "#e3d7c0", "#bfb3a0", "#d3bf9f", "#cbbfae",
          "#b9a888")
# names of matplotlib's: from little to much, of stress from none to compression
MAGNITUDES, STRESSES, FIELD = "PuBu", "PuBu_r", "magma_r"
# from sound to lost, darker all the way
DAMAGE = ("0.75", "#f5a83c", "#e8602c", "#b01030", "#4a0a28")
