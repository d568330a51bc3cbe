#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Two blocks between two abutments, which reach below and above them."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from block_geometry import Geometry  # noqa: E402

LENGTH, HEIGHT = 2, 1  # of a block


def main():
    geometry = Geometry("Flat arch of two blocks of %g m x %g m."
                        % (LENGTH, HEIGHT))
    for group, side in (("left", -1), ("right", 1)):
        face, back = side * LENGTH, side * (LENGTH + 0.5)
        top = HEIGHT + 0.5
        geometry.add(group, [(back, -0.5), (face, -0.5), (face, top),
                             (back, top)], shared=False)
        geometry.add("block", [(face, 0), (0, 0), (0, HEIGHT),
                               (face, HEIGHT)])
    geometry.write(os.path.join(HERE, "spreading_arch.geo"))


if __name__ == "__main__":
    main()
