#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Records of an earthquake in three components, and the surface that they move.

The incident velocities f are wavelets. x.at2 has the acceleration of the first in g, with
a baseline that is off by a line, y.vt2 twice the second in cm/s, z.csv the acceleration of
the third in m/s^2, early and off by a constant. The surface at H above the base moves
with 2 f(t - H/c).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
G, H, CS, CP = 9.80665, 20.0, 3000 / 3**0.5, 3000.0
EARLY = 0.01  # of the third record [s]


def ricker(t, frequency, centre):
    """Ricker's wavelet and its rate."""
    w = np.pi * frequency
    a = (w * (t - centre))**2
    return ((1 - 2 * a) * np.exp(-a),
            w**2 * (t - centre) * (4 * a - 6) * np.exp(-a))


def along_x(t):
    return [8e-3 * part for part in ricker(t, 50, 0.04)]


def along_y(t):
    return -5e-3 * np.sin(2 * np.pi * 40 * (t - 0.045)) * np.exp(
        -((t - 0.045) / 0.01)**2)


def along_z(t):
    return [4e-3 * part for part in ricker(t, 60, 0.035)]


def write_record(name, heading, values, step):
    """A record in the format of the PEER database."""
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write("PEER NGA STRONG MOTION DATABASE RECORD\n"
                     "A wavelet, see make_reference.py\n%s\n"
                     "NPTS= %6d, DT= %.5f SEC\n"
                     % (heading, len(values), step))
        for first in range(0, len(values), 5):
            stream.write(" ".join("%15.7E" % value
                                  for value in values[first:first + 5]) + "\n")


step = 2.5e-4
t = np.arange(0, 0.1 + step / 2, step)
write_record("x.at2", "ACCELERATION TIME SERIES IN UNITS OF G",
             along_x(t)[1] / G + 0.02 - 0.5 * t, step)
write_record("y.vt2", "VELOCITY TIME SERIES IN UNITS OF CM/S",
             2 * along_y(t) / 0.01, step)
t = t[:-50]
np.savetxt(os.path.join(HERE, "z.csv"),
           np.transpose([t, along_z(t + EARLY)[1] - 0.3]), delimiter=",",
           fmt="%.9g", comments="", header="time [s],acceleration [m/s^2]")

t = np.arange(0, 0.09, 5e-4)
columns = [2 * along_x(t - H / CS)[0], 2 * along_y(t - H / CS),
           2 * along_z(t - H / CP)[0]]
np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([t] + 2 * columns), delimiter=",", fmt="%.9g",
           comments="", header="time [s],middle_x [m/s],middle_y [m/s],"
           "middle_z [m/s],corner_x [m/s],corner_y [m/s],corner_z [m/s]")
