#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Load cycle of a block with a slipping crack (Olsson 1982, Brady 1985).

With the compliance of block and sticking joint 1/k = H/(E' W) + 1/(K L) at 45
degrees and K = kn = ks, slip on the length l adds
(1 -+ tan phi) / (2 ks (L - l)), minus while loading, plus in back-slip.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, H, W = 85.1e9, 0.2063, 2.0, 1.0
STIFFNESS, PHI, SLIPPING = 220e9, np.radians(16.0), 0.54
LENGTH = W / np.cos(np.pi / 4)

elastic = H * (1 - NU**2) / (E * W) + 1 / (STIFFNESS * LENGTH)
slip = 1 / (2 * STIFFNESS * (LENGTH - SLIPPING))
load = 1 / (elastic + (1 - np.tan(PHI)) * slip)
unload = 1 / elastic
back = 1 / (elastic + (1 + np.tan(PHI)) * slip)


def force(displacement, peak, unloading):
    """Compressive force; back-slip starts when the reversed shear traction
    reaches the friction: after a share 2 tan phi / (1 + tan phi) of the
    load."""
    top = load * peak
    if not unloading:
        return load * displacement
    drop = 2 * np.tan(PHI) / (1 + np.tan(PHI)) * top
    knee = peak - drop / unload
    if displacement > knee:
        return top - unload * (peak - displacement)
    return top - drop - back * (knee - displacement)


if __name__ == "__main__":
    times = np.arange(0, 0.1 + 1e-9, 5e-4)
    u = 0.5e-3 * (1 - np.cos(2 * np.pi * times / 0.1))
    f = [force(x, 1e-3, t > 0.05) for t, x in zip(times, u)]
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([times, -u, -np.array(f)]), delimiter=",",
               fmt="%.9g", comments="",
               header="time [s],displacement [m],force [N]")
    np.savetxt(os.path.join(HERE, "slopes.csv"), [[load, unload, back]],
               delimiter=",", fmt="%.6g", comments="",
               header="load [N/m],unload [N/m],back-slip [N/m]")
