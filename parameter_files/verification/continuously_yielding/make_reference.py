#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A continuously yielding joint: to 8 MPa and back to 2 MPa, then sheared.

Closure by the integral of the stiffness, kr (s/sr)^e, constant below the lowest
stress. Shear by many small increments of slip under the constant pressure.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, KN_POWER, KS, KS_POWER = 20e9, 0.5, 8e9, 0.4
REFERENCE, LOWEST = 1e6, 1e4
INITIAL, RESIDUAL, ROUGHNESS = np.radians(50), np.radians(30), 1e-3
PRESSURE, REACH, DURATION, SUBSTEPS = 2e6, 4e-3, 0.8, 200


def closure(s):
    """Closure of the linear beginning, followed by the integral of ds/kn."""
    first = np.minimum(s, LOWEST) / (KN * (LOWEST / REFERENCE)**KN_POWER)
    above = np.maximum(s, LOWEST)
    power = 1 - KN_POWER
    return first + REFERENCE**KN_POWER / KN / power * (above**power
                                                      - LOWEST**power)


def sheared(slips):
    """Shear traction and dilation at each of the slips."""
    stiffness = KS * (PRESSURE / REFERENCE)**KS_POWER
    tau, dilation, worn, now, reload, unloads = 0.0, 0.0, 0.0, 0.0, 0.0, False
    result = [(0.0, 0.0)]
    for target in slips[1:]:
        step = (target - now) / SUBSTEPS
        for _ in range(SUBSTEPS):
            now += step
            angle = RESIDUAL + (INITIAL - RESIDUAL) * np.exp(-worn / ROUGHNESS)
            strength = PRESSURE * np.tan(angle)
            share = abs(tau) / strength
            if tau * step < 0:
                factor, unloads = 1.0, True
            else:
                if unloads:  # loading begins anew
                    reload, unloads = min(0.75, share), False
                factor = min(1.0, (1 - share) / (1 - reload))
            tau += factor * stiffness * step
            plastic = (1 - factor) * abs(step)
            worn += plastic
            opened = np.arctan(abs(tau) / PRESSURE) - RESIDUAL
            dilation += np.tan(max(0.0, opened)) * plastic
        result.append((tau, dilation))
    return np.transpose(result)


times = np.arange(0, 1.4, 2e-3)
pressed = np.where(times < 0.1, 4e6 * (1 - np.cos(np.pi * times / 0.1)),
                   5e6 + 3e6 * np.cos(np.pi * (times - 0.1) / 0.1))
normal = np.where(times < 0.2, pressed, PRESSURE)
t = np.maximum(times - 0.2, 0)
slip = REACH * (1 - np.cos(np.pi * t / DURATION))
shear, dilation = sheared(slip)

np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, slip, dilation - closure(normal), -normal,
                         shear, shear]),
           delimiter=",", fmt="%.9g", comments="",  # 1 m^2
           header="time [s],slip [m],opening [m],normal [Pa],shear [Pa],force [N]")
