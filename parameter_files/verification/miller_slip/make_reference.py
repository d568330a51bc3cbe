#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Harmonic shear wave on a cohesive joint between two half-spaces.

The joint passes the incident wave clipped at +-tau_s; what it does not pass is
reflected. With s = tau_s / tau_max and th = asin s the transmission T,
reflection R and absorption A coefficients (square roots of the energy fluxes)
follow from integrals over a quarter of a period.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, G, TAU, FREQUENCY = 2650.0, 10e9, 1e6, 1.0
COHESIONS = {"2.5": 2.5e6, "0.5": 0.5e6, "0.1": 0.1e6, "0.02": 0.02e6}
C = (G / RHO) ** 0.5
Z = RHO * C
K = 10e9


def coefficients(cohesion):
    s = min(cohesion / TAU, 1.0)
    th = np.arcsin(s)
    t2 = 4 / np.pi * (th / 2 - np.sin(2 * th) / 4 + s**2 * (np.pi / 2 - th))
    r2 = 4 / np.pi * ((np.pi / 2 - th) / 2 + np.sin(2 * th) / 4
                      - 2 * s * np.cos(th) + s**2 * (np.pi / 2 - th))
    return t2**0.5, max(r2, 0.0) ** 0.5, max(1 - t2 - r2, 0.0) ** 0.5


def incident(t):
    return np.where(t > 0, TAU / Z * np.sin(2 * np.pi * FREQUENCY * t), 0.0)


if __name__ == "__main__":
    rows = [(c, *coefficients(c)) for c in COHESIONS.values()]
    np.savetxt(os.path.join(HERE, "coefficients.csv"), rows, delimiter=",",
               fmt="%.6g", comments="", header="cohesion [Pa],T,R,A")
    times = np.arange(0, 3.2, 0.005)
    for label, cohesion in COHESIONS.items():
        limit = cohesion / Z
        v_above = np.clip(incident(times - 150 / C), -limit, limit)
        back = incident(times - 150 / C)  # joint at 100 m, point at 50 m
        v_below = (incident(times - 50 / C)
                   + back - np.clip(back, -limit, limit))
        at_joint = np.clip(incident(times - 100 / C), -limit, limit)
        np.savetxt(os.path.join(HERE, "reference_%s.csv" % label),
                   np.transpose([times, v_below, v_above, -Z * at_joint]),
                   delimiter=",", fmt="%.9g", comments="",
                   header="time [s],v_below [m/s],v_above [m/s],"
                          "traction [Pa]")
