#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A polarised shear wave along a direction d on a joint with a cohesion and a
shear stiffness.

With the velocity f of the incident wave at the joint and g of what it passes, both
sides carry z g, and the upper side lags at the rate 2 (f - g). While the joint
sticks, z g' = 2 ks (f - g); z g is at most the cohesion.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, G, TAU, KS, FREQUENCY = 2650.0, 10e9, 1e6, 20e9, 5.0
C = (G / RHO) ** 0.5
Z = RHO * C
BELOW, JOINT, ABOVE = 10.0, 20.0, 30.0
DIRECTION = np.array([-0.48, 0.36, 0.8])
ANGLE = np.pi / 3
COHESIONS = {"2.5": 2.5e6, "0.5": 0.5e6, "0.1": 0.1e6, "0.02": 0.02e6}
DT = 2e-6


def incident(t):
    return np.where(t > 0, TAU / Z * np.sin(2 * np.pi * FREQUENCY * t), 0.0)


def passed(f, cohesion):
    """g at the times of f, exact for f linear within a step that sticks."""
    rate = 2 * KS / Z
    decay = np.exp(-rate * DT)
    last = 1 - (1 - decay) / (rate * DT)
    limit = cohesion / Z
    g = np.zeros_like(f)
    for i in range(1, len(f)):
        g[i] = min(max(decay * g[i - 1] + (1 - decay - last) * f[i - 1]
                       + last * f[i], -limit), limit)
    return g


def polarisation():
    """SV waves lie in the vertical plane of d, SH waves across it."""
    across = np.cross([0, 0, 1.0], DIRECTION)
    across /= np.linalg.norm(across)
    return (np.cos(ANGLE) * np.cross(across, DIRECTION)
            + np.sin(ANGLE) * across)


def main():
    way = polarisation()
    fine = np.arange(0, 0.44, DT)
    times = np.arange(0, 0.4395, 1e-3)
    f = incident(fine - JOINT / C)
    for name, cohesion in COHESIONS.items():
        g = passed(f, cohesion)

        def late(values, distance):
            return np.interp(times - distance / C, fine, values, left=0)

        below = incident(times - BELOW / C) + late(f - g, JOINT - BELOW)
        above = late(g, ABOVE - JOINT)
        slip = -late(np.cumsum(2 * (f - g)) * DT, 0)
        np.savetxt(os.path.join(HERE, "reference_askew_%s.csv" % name),
                   np.column_stack([times, np.outer(below, way),
                                    np.outer(above, way), np.outer(slip, way),
                                    np.abs(Z * late(g, 0)), 0 * times]),
                   delimiter=",", fmt="%.7g", comments="",
                   header="time [s],x_below [m/s],y_below [m/s],z_below [m/s],"
                   "x_above [m/s],y_above [m/s],z_above [m/s],slip_x [m],"
                   "slip_y [m],slip_z [m],traction [Pa],normal [Pa]")


if __name__ == "__main__":
    main()
