#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A joint that softens in series with a spring, in closed form.

The displacement U is that of both: U = sigma/ke + delta, delta = sigma/kn + w,
and sigma = ft exp(-ft w/GfI) once it has failed. Where U grows there is one
solution before the strength is reached, and one, on the far side of the
snap-back, beyond.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KE, KN, FT, GI = 1e9, 82e9, 0.25e6, 18.0
COMPLIANCE = 1 / KE + 1 / KN
PEAK = FT * COMPLIANCE               # U at which it fails


def traction(displacement):
    """Traction of the solution that is reached as U grows [Pa]."""
    # beyond, U = sigma COMPLIANCE + w falls with w up to the snap-back's end
    turn = GI / FT * np.log(COMPLIANCE * FT**2 / GI)
    low, high = np.full_like(displacement, turn), displacement.copy()
    for _ in range(200):
        w = 0.5 * (low + high)
        short = FT * np.exp(-FT * w / GI) * COMPLIANCE + w < displacement
        low, high = np.where(short, w, low), np.where(short, high, w)
    return np.where(displacement < PEAK, displacement / COMPLIANCE,
                    FT * np.exp(-FT * w / GI))


def opening(displacement):
    return displacement - traction(displacement) / KE


def lost():
    """Neither stored nor taken by the crack when it jumps [J/m^2]."""
    after = traction(np.array([PEAK * (1 + 1e-12)]))[0]
    return (0.5 * COMPLIANCE * (FT**2 - after**2) - GI * (1 - after / FT))


def main():
    t = np.linspace(0, 1, 101)
    u = 0.4e-3 * t
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([t, u, opening(u), traction(u)]), delimiter=",",
               fmt="%.9g", comments="",
               header="time [s],displacement [m],opening [m],normal [Pa]")


if __name__ == "__main__":
    main()
