#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A bar of stiffness EA in a bond of stiffness k and strength s by length, over
the length L, pulled at one end (Farmer 1975 for the elastic part).

Elastic, with b = sqrt(k/EA): slip of the pulled end u = F/(EA b tanh b L). The
bond slips over a length a from there on: F = s a + (s/b) tanh b (L - a),
u = s/k + F_e a/EA + s a^2/(2 EA), F_e = (s/b) tanh b (L - a). At last, a = L,
all of it: F = s L. Before it is the free length LF and the plate, in series.

Slip is positive towards the far end: it is -u.

pressure.csv: the bond has friction, and the rock presses on it.

rupture.csv: the bar yields at Y < s L in its free length, which breaks at the
strain EU.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
EA = 200e9 * np.pi * 0.0254 ** 2 / 4
BOND, LENGTH, FREE, PLATE = 1e9, 0.5, 0.1, 1e10
STRENGTH = 300e3
# of a bond with friction in rock under 2 MPa, mean of 3 and 1 MPa [N/m]
PRESSED = 100e3 + np.tan(np.radians(30)) * np.pi * 0.0254 * 2e6
YIELD, RUPTURE = 80e3, 5e-3
BETA = np.sqrt(BOND / EA)


def stiffness(bond):
    """Of the pull-out of a bar in an elastic bond [N/m]."""
    beta = np.sqrt(bond / EA)
    return EA * beta * np.tanh(beta * LENGTH)


def pulled(force, strength):
    """Slip of the pulled end at a force on the way to s L, and the length over
    which the bond slips [m]."""
    first = strength / BETA * np.tanh(BETA * LENGTH)
    if force <= first:
        return force / stiffness(BOND), 0.0
    low, high = 0.0, LENGTH
    for _ in range(60):
        a = (low + high) / 2
        elastic = strength / BETA * np.tanh(BETA * (LENGTH - a))
        low, high = (a, high) if strength * a + elastic < force else (low, a)
    return (strength / BOND + elastic * a / EA + strength * a ** 2 / (2 * EA),
            a)


def motion(times):
    return 1e-3 * np.where(times < 0.2, 2.5 * times ** 2, times - 0.1)


def write(name, strength, limit, breaks=False):
    times = np.arange(0, 1.601, 0.01)
    moved = motion(times)
    forces = np.linspace(0, limit, 4001)
    slips, lengths = np.transpose([pulled(force, strength)
                                   for force in forces])
    whole = slips + forces * (FREE / EA + 1 / PLATE)
    force = np.interp(moved, whole, forces)
    slip = np.where(moved <= whole[-1], np.interp(moved, whole, slips),
                    slips[-1] if breaks else
                    moved - limit * (FREE / EA + 1 / PLATE))
    slipped = np.interp(moved, whole, lengths)
    broken = np.zeros_like(times)
    if breaks:
        strain = limit / EA + (moved - whole[-1]) / FREE
        broken = np.where(strain >= RUPTURE, 1.0, 0.0)
        force = np.where(broken > 0, 0.0, force)
        slip = np.where(broken > 0, 0.0, slip)
    np.savetxt(os.path.join(HERE, name),
               np.transpose([times, force, -slip, force, broken, slipped]),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],pull [N],slip [m],plate [N],breaks [-],"
               "slipped [m]")


assert abs(BETA - 3.1413) < 1e-4
assert abs(stiffness(BOND) - 292e6) < 0.5e6
if __name__ == "__main__":
    write("reference.csv", STRENGTH, STRENGTH * LENGTH)
    write("pressure.csv", PRESSED, PRESSED * LENGTH)
    write("rupture.csv", STRENGTH, YIELD, True)
