#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""One Coulomb joint in direct shear under constant normal stress.

Shear traction: slope ks to the peak c + |s| tan phi, then the residual one;
elastic on reversal, then the residual one the other way. No dilation.

reset.csv: 2 mm forth, 1 mm back and 0.1 mm forth again, where slip, displacement
and the state of the joint count from the beginning of the way back.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, KS, STRESS = 10e9, 5e9, 1e6
PEAK = 0.5e6 + STRESS * np.tan(np.radians(30))
RESIDUAL = 0.1e6 + STRESS * np.tan(np.radians(25))
END, BACK = 4e-3, 2e-3

times = np.arange(0, 1.3, 2e-3)
pressed = np.where(times < 0.1, (1 - np.cos(np.pi * times / 0.1)) / 2, 1.0)
normal = -STRESS * pressed
t = np.maximum(times - 0.1, 0)
slip = np.where(t < 0.8, 5e-3 * t, END - 5e-3 * (t - 0.8))
forward = np.where(KS * slip <= PEAK, KS * slip, RESIDUAL)
backward = np.maximum(RESIDUAL - KS * (END - slip), -RESIDUAL)
shear = np.where(t < 0.8, forward, backward)

INTACT, SLIPPING, SLIPPED = 0, 1, 2  # codes of JointState
BACK_AT, AGAIN_AT, SPEED = 0.5, 0.7, 5e-3


def reset():
    times = np.arange(0, 0.7205, 2.5e-3)
    pressed = np.where(times < 0.1, (1 - np.cos(np.pi * times / 0.1)) / 2, 1.0)
    forth = SPEED * np.clip(times - 0.1, 0, 0.4)
    back = SPEED * np.clip(times - BACK_AT, 0, 0.2)
    again = SPEED * np.maximum(times - AGAIN_AT, 0)
    slip = np.where(times < BACK_AT, forth, again - back)
    shear = np.where(
        times < BACK_AT, np.where(KS * forth <= PEAK, KS * forth, RESIDUAL),
        np.maximum(RESIDUAL - KS * back, -RESIDUAL) + KS * again)
    # at rest it is stuck: before the peak, on the way back until it slips
    # the other way, and on the last way, where it has slipped
    state = np.where(
        times < AGAIN_AT,
        np.where(np.where(times < BACK_AT, KS * forth <= PEAK,
                          KS * back <= 2 * RESIDUAL), INTACT, SLIPPING),
        SLIPPED)
    np.savetxt(os.path.join(HERE, "reset.csv"),
               np.transpose([times, slip, -STRESS * pressed / KN,
                             -STRESS * pressed, shear, state, slip, slip,
                             slip]),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],slip [m],opening [m],normal [Pa],shear [Pa],"
                      "state [-],moved [m],past [m],block [m]")


reset()
np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, slip, normal / KN, normal, shear]),
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],slip [m],opening [m],normal [Pa],shear [Pa]")
