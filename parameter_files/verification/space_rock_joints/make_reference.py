#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Rock joints pressed to 8 MPa and back to 2 MPa, then sheared along a path that
turns, by many small increments of the slip vector under the constant pressure.

The laws are those of ../barton_bandis and ../continuously_yielding, whose
closures are taken from there, for the size of the traction and the slip along
it. What remains of slip, across the traction, is elastic and turns it.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
PRESSURE, SUBSTEPS = 2e6, 400
KN, CLOSURE, ROUGHNESS = 10e9, 0.3e-3, 10 * np.log10(100e6 / PRESSURE)
SLIP = 1e-3 * np.array([0, 0.3, 0.6, 1, 2, 4, 10, 25, 100])
SHARE = [-28.0 / ROUGHNESS, 0, 0.75, 1, 0.85, 0.7, 0.5, 0.4, 0]


def barton_bandis(slips):
    """Shear traction and dilation at each of the slips."""
    ks = 5e9
    tau, now, dilation, worn = np.zeros(2), np.zeros(2), 0.0, 0.0
    for target in slips:
        step = (target - now) / SUBSTEPS
        for _ in range(SUBSTEPS):
            now = now + step
            tau = tau + ks * step
            size = np.hypot(*tau)
            angle = ROUGHNESS * np.interp(worn + size / ks, SLIP, SHARE)
            limit = PRESSURE * np.tan(np.radians(28.0 + angle))
            if size > limit:
                plastic = (size - limit) / ks
                away = tau @ now / (size * np.hypot(*now))
                opened = away * np.tan(np.radians(max(0.0, angle) / 2)) * plastic
                dilation = max(0.0, dilation + opened)
                worn += plastic
                tau = tau * (limit / size)
        yield [*tau, dilation]


def continuously_yielding(slips):
    """Shear traction and dilation at each of the slips."""
    ks = 8e9 * (PRESSURE / 1e6)**0.4
    tau, now, dilation, worn = np.zeros(2), np.zeros(2), 0.0, 0.0
    reload, unloads = 0.0, False
    for target in slips:
        step = (target - now) / SUBSTEPS
        now = target
        for _ in range(SUBSTEPS):
            size = np.hypot(*tau)
            along = tau @ step / size if size > 0 else np.hypot(*step)
            strength = PRESSURE * np.tan(np.radians(
                30.0 + 20.0 * np.exp(-worn / 1e-3)))
            plastic = 0.0
            if along >= 0:
                if unloads:  # loading begins anew
                    reload = min(0.75, size / strength)
                factor = min(1.0, (1 - size / strength) / (1 - reload))
                plastic = (1 - factor) * along
            unloads = along < 0
            tau = tau + ks * step
            if size > 0:
                tau = tau * (1 - ks * plastic / np.hypot(*tau))
            worn += plastic
            angle = np.arctan(size / PRESSURE) - np.radians(30.0)
            dilation += np.tan(max(0.0, angle)) * plastic
        yield [*tau, dilation]


def closure(name, s):
    if name == "barton_bandis":
        return s / (KN + s / CLOSURE)
    # kn = 20 GPa/m (s/1 MPa)^0.5 above 10 kPa
    low = np.minimum(s, 1e4) / 2e9
    return low + 1e3 / 10e9 * (np.sqrt(np.maximum(s, 1e4)) - 1e2)


def main():
    times = np.arange(0, 1.4, 5e-3)
    pressed = np.where(times < 0.1, 4e6 * (1 - np.cos(np.pi * times / 0.1)),
                       5e6 + 3e6 * np.cos(np.pi * (times - 0.1) / 0.1))
    normal = np.where(times < 0.2, pressed, PRESSURE)
    t = np.maximum(times - 0.2, 0)
    slips = np.transpose([4e-3 * (1 - np.cos(np.pi * t / 0.8)),
                          2e-3 * (1 - np.cos(np.pi * t / 0.4))])
    for law in (barton_bandis, continuously_yielding):
        name = law.__name__
        x, y, dilation = np.transpose(list(law(slips)))
        # 1 m^2; the lower block holds the upper one back
        np.savetxt(os.path.join(HERE, "reference_%s.csv" % name),
                   np.transpose([times, *slips.T,
                                 dilation - closure(name, normal), -normal,
                                 -x, -y]),
                   delimiter=",", fmt="%.9g", comments="",
                   header="time [s],slip_x [m],slip_y [m],opening [m],"
                   "normal [Pa],force_x [N],force_y [N]")


if __name__ == "__main__":
    sys.exit(main())
