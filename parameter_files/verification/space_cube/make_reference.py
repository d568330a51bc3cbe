#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Lame's equivoluminal vibration of a free cube."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, E, NU, EDGE, SIZE = 2500.0, 25e9, 0.25, 1.0, 1e-6
SPEED = (E / (2 * (1 + NU)) / RHO) ** 0.5
OMEGA = np.pi * 2**0.5 * SPEED / EDGE

if __name__ == "__main__":
    times = np.linspace(0, 6 * np.pi / OMEGA, 151)
    u = SIZE * np.cos(OMEGA * times)
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([times, u, -u, -u, 0 * u]), delimiter=",",
               fmt="%.9g", comments="",
               header="time [s],u [m],v [m],u_edge [m],w_edge [m]")
