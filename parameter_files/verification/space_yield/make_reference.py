#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Uniform stress in a perfectly plastic Mohr-Coulomb cube, small strains.

N s1 - s3 = q with q = 2 c sqrt(N), flow along N_psi s1 - s3; on the edges of the
pyramid two planes share the flow, tension is cut off at s_t with flow along s1.

Under given stresses the factor F of safety divides c and t = tan(phi) until
(s1 - s3)/2 = c/F cos(phi') - (s1 + s3)/2 sin(phi') with tan(phi') = t/F, which is
F^2 = ((c - t (s1 + s3)/2) / ((s1 - s3)/2))^2 - t^2, whatever s2 is.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, C = 100e9, 0.25, 1e6


def number(degrees):
    s = np.sin(np.radians(degrees))
    return (1 + s) / (1 - s)


N, N_PSI = number(30), number(10)
Q = 2 * C * np.sqrt(N)
RAMP = np.linspace(0, 1, 5)
TIME = 0.02 / np.pi * np.arccos(1 - 2 * RAMP)


def along_z(strain, side, limit, stiffness, poisson, flow):
    """Stress zz, elastic strain and the lateral strain: -poisson of the elastic
    axial strain and flow of the plastic one."""
    elastic = np.clip(stiffness * strain, *sorted((0, limit - side))) / stiffness
    return side + stiffness * elastic, elastic, (-poisson * elastic
                                                 + flow * (strain - elastic))


def triaxial(strain, side, limit, flow):
    sz, _, lateral = along_z(strain, side, limit, E, NU, flow)
    return np.full_like(sz, side), np.full_like(sz, side), sz, lateral, lateral


def compression():
    """s1 = s2 along the sides: the edge on which s3 alone flows twice."""
    return triaxial(-2e-4 * RAMP, -2e6, -2e6 * N - Q, -N_PSI / 2)


def extension():
    """s2 = s3 along the sides."""
    return triaxial(2e-4 * RAMP, -10e6, (-10e6 + Q) / N, -1 / (2 * N_PSI))


def cut():
    """Tension along z up to the cut-off."""
    return triaxial(2e-4 * RAMP, -1e6, 0.5e6, 0.0)


def plane():
    """No strain along y, whose stress is the second one."""
    sz, elastic, ux = along_z(-2e-4 * RAMP, -2e6, -2e6 * N - Q, E / (1 - NU**2),
                              NU / (1 - NU), -N_PSI)
    sy = -2e6 + NU * (sz + 2e6)
    return np.full_like(sz, -2e6), sy, sz, ux, np.zeros_like(sz)


def apex():
    """All sides move outwards to the tip of the pyramid, c / tan(phi)."""
    u = 1e-4 * RAMP
    s = np.minimum(-2e6 + E / (1 - 2 * NU) * u, C / np.tan(np.radians(30)))
    return s, s, s, u, u


def factor(s1, s3, degrees):
    t = np.tan(np.radians(degrees))
    return np.sqrt(((C - t * (s1 + s3) / 2) / ((s1 - s3) / 2))**2 - t**2)


for make in (compression, extension, cut, plane, apex):
    np.savetxt(os.path.join(HERE, "reference_%s.csv" % make.__name__),
               np.column_stack([TIME, *make()]), delimiter=",", fmt="%.8g",
               comments="", header="time [s],sx [Pa],sy [Pa],sz [Pa],ux [m],"
               "uy [m]")
np.savetxt(os.path.join(HERE, "factors.csv"),
           [[factor(-2e6, -6e6, 30), factor(-2e6, -3.1e6, 0)]], delimiter=",",
           fmt="%.8g", comments="", header="friction [-],no friction [-]")
