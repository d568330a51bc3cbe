#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Tension and shear of joints by the composite law, in closed form.

Tension: opening u = sigma/kn + w, sigma = ft exp(-ft w/GfI) once failed. Shear
under the pressure p: slip v = tau/ks + k, tau = c exp(-c k/GfII) + p tan(phi).
Triplet: the same in two joints, each of which gives tau A to an outer unit.
"""
import os

import numpy as np

AREA = 0.21 * 0.1
HERE = os.path.dirname(os.path.abspath(__file__))
KN, KS, FT, GI, C, GII, TAN, P = (82e9, 36e9, 0.25e6, 18.0, 0.35e6, 125.0,
                                  np.tan(np.radians(36.8698976)), 0.5e6)


def softened(total, stiffness, strength, energy, constant):
    """Traction at the displacement @p total, and the share that is lost."""
    lo, hi = np.zeros_like(total), np.maximum(total, 0)
    for _ in range(200):
        plastic = 0.5 * (lo + hi)
        traction = strength * np.exp(-strength * plastic / energy) + constant
        short = traction / stiffness + plastic < total
        lo, hi = np.where(short, plastic, lo), np.where(short, hi, plastic)
    elastic = stiffness * total <= strength + constant
    return (np.where(elastic, stiffness * total, traction),
            np.where(elastic, 0, 1 - np.exp(-strength * plastic / energy)))


def write(name, header, *columns):
    np.savetxt(os.path.join(HERE, name), np.transpose(columns), delimiter=",",
               fmt="%.9g", comments="", header=header)


t = np.arange(0, 0.4, 1e-3)
opening = 0.2e-3 * (1 - np.cos(np.pi * t / 0.4))
sigma, damage = softened(opening, KN, FT, GI, 0.0)
write("reference_tension.csv", "time [s],opening [m],normal [Pa],damage [-]", t,
      opening, sigma, damage)
slip = 1e-3 * (1 - np.cos(np.pi * t / 0.4))
tau, damage = softened(slip, KS, C, GII, P * TAN)
write("reference_shear.csv", "time [s],slip [m],shear [Pa],damage [-]", t + 0.1,
      slip, tau, damage)
for pressure in (0.1e6, 0.5e6, 1.0e6):
    tau, _ = softened(slip, KS, C, GII, pressure * TAN)
    write("reference_triplet_%g.csv" % (pressure / 1e6),
          "time [s],slip [m],lower [Pa],upper [Pa],below [N],above [N]",
          t + 0.1, slip, tau, -tau, -tau * AREA, -tau * AREA)
