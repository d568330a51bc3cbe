#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A Barton-Bandis joint: pressed to 8 MPa and back to 2 MPa, then sheared.

Closure by the hyperbola, turned round. Shear by many small increments of slip
under the constant pressure: |tau| = min(trial, s tan(phi_mob)), with the
roughness that the inelastic slip so far and the elastic slip have mobilised.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, CLOSURE, KS = 10e9, 0.3e-3, 5e9
JRC, JCS, RESIDUAL, PEAK_SLIP = 10.0, 100e6, 28.0, 1e-3
PRESSURE, REACH, DURATION, SUBSTEPS = 2e6, 4e-3, 0.8, 200
SLIP = [0, 0.3, 0.6, 1, 2, 4, 10, 25, 100]
ROUGHNESS = JRC * np.log10(JCS / PRESSURE)
# JRC mobilised by JRC; at first the roughness is less than none
SHARE = [-RESIDUAL / ROUGHNESS, 0, 0.75, 1, 0.85, 0.7, 0.5, 0.4, 0]


def roughness_angle(slip):
    return ROUGHNESS * np.interp(slip / PEAK_SLIP, SLIP, SHARE)


def sheared(slips):
    """Shear traction and dilation at each of the slips."""
    tau, dilation, worn, now = 0.0, 0.0, 0.0, 0.0
    result = [(0.0, 0.0)]
    for target in slips[1:]:
        step = (target - now) / SUBSTEPS
        for _ in range(SUBSTEPS):
            now += step
            trial = tau + KS * step
            angle = roughness_angle(worn + abs(trial) / KS)
            limit = PRESSURE * np.tan(np.radians(RESIDUAL + angle))
            tau = np.sign(trial) * min(abs(trial), limit)
            plastic = (abs(trial) - abs(tau)) / KS
            worn += plastic
            opened = np.tan(np.radians(max(0.0, angle) / 2)) * plastic
            if trial * now < 0:
                opened = -min(opened, dilation)
            dilation += opened
        result.append((tau, dilation))
    return np.transpose(result)


times = np.arange(0, 1.4, 2e-3)
pressed = np.where(times < 0.1, 4e6 * (1 - np.cos(np.pi * times / 0.1)),
                   5e6 + 3e6 * np.cos(np.pi * (times - 0.1) / 0.1))
normal = np.where(times < 0.2, pressed, PRESSURE)
t = np.maximum(times - 0.2, 0)
slip = REACH * (1 - np.cos(np.pi * t / DURATION))
shear, dilation = sheared(slip)
closure = normal / (KN + normal / CLOSURE)

np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, slip, dilation - closure, -normal, shear, shear]),
           delimiter=",", fmt="%.9g", comments="",  # 1 m^2
           header="time [s],slip [m],opening [m],normal [Pa],shear [Pa],force [N]")
