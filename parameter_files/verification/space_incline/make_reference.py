#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A rigid block on a plane: u'' = g(t) (sin b - cos b tan phi), and its factor of
safety, tan(phi)/tan(b), with more friction."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DIP, AZIMUTH, FRICTION = np.radians([35.0, 30.0, 25.0])
RAMP, GRAVITY = 0.1, 9.81

times = np.arange(0, 0.3 + 1e-9, 5e-3)
rate = GRAVITY * (np.sin(DIP) - np.cos(DIP) * np.tan(FRICTION))
# the integral of the integral of (1 - cos(pi t / T)) / 2, and of 1 from T on
w = np.pi / RAMP
rising = 0.5 * (times**2 / 2 - (1 - np.cos(w * times)) / w**2)
end = 0.5 * (RAMP**2 / 2 - 2 / w**2)
after = times - RAMP
path = rate * np.where(times < RAMP, rising,
                       end + 0.5 * RAMP * after + after**2 / 2)
down = np.array([np.cos(DIP) * np.cos(AZIMUTH), np.cos(DIP) * np.sin(AZIMUTH),
                 -np.sin(DIP)])
motion = np.outer(path, down)
np.savetxt(os.path.join(HERE, "reference.csv"),
           np.column_stack([times, motion, path, motion]), delimiter=",",
           fmt="%.9g", comments="",
           header="time [s],ux [m],uy [m],uz [m],slip [m],"
           "slip_x [m],slip_y [m],slip_z [m]")
np.savetxt(os.path.join(HERE, "reference_safety.csv"),
           [[np.tan(np.radians(40)) / np.tan(DIP)]], fmt="%.6g", comments="",
           header="factor [-]")
