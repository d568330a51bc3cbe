#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Factors of safety of a cut and slopes by limit analysis, for reference.csv.

A rigid body above a logarithmic spiral through the toe turns about the
spiral's centre: an upper bound of the limit load for any centre (Chen 1975),
the least of which is above the exact one by about 1 %. It is compared with
Chen's table. Of the vertical cut without friction the exact stability number
is between 3.7752 and 3.7776 (Pastor, Thai and Francescato 2000; Martin 2011); what
meshes make of it is in mesh_limit.py.
Needs scipy (python3-scipy).
"""
import os

import numpy as np
from scipy.optimize import brentq, minimize

import mesh_limit

HEIGHT, WEIGHT = 1.0, 20e3  # [m], [N/m^3]
CUT = 3.776                 # exact stability number, no friction


def bound(centre, slope, friction):
    """Stability number gamma H/c of the spiral with this centre, for H = 1,
    the toe at the origin and the crest at (cot(slope), 1)."""
    x, y = centre
    crest = 1 / np.tan(slope) if slope < np.pi / 2 else 0.0
    t = np.tan(friction)
    # Polar angles clockwise from the direction of negative x, the toe's last:
    # r = r_toe exp((angle - toe) tan(phi)) gets shorter towards the crest.
    toe = np.arctan2(-y, -x)
    reach = np.hypot(x, y)
    angles = toe + np.linspace(0, np.pi, 4001)
    r = reach * np.exp(-(angles - toe) * t)
    px, py = x + r * np.cos(angles), y + r * np.sin(angles)
    above = np.nonzero(py >= 1)[0]
    if not len(above) or above[0] == 0:
        return np.inf
    last = above[0]
    share = (1 - py[last - 1]) / (py[last] - py[last - 1])
    end = angles[last - 1] + share * (angles[last] - angles[last - 1])
    top = px[last - 1] + share * (px[last] - px[last - 1])
    if top <= crest:
        return np.inf
    px = np.concatenate([px[:last], [top, crest]])
    py = np.concatenate([py[:last], [1.0, 1.0]])
    qx, qy = np.roll(px, -1), np.roll(py, -1)
    cross = px * qy - qx * py
    area = cross.sum() / 2
    middle = ((px + qx) * cross).sum() / (6 * area)
    work = area * (middle - x)
    swept = end - toe
    arc = (1 - np.exp(-2 * swept * t)) / (2 * t) if t > 0 else swept
    if work <= 0:
        return np.inf
    return reach**2 * arc / work


def stability_number(slope, friction):
    best = np.inf
    for x in (-2.0, -1.0, -0.3, 0.3):
        for y in (1.2, 1.6, 2.5, 4.0):
            found = minimize(bound, (x, y), (slope, friction),
                             method="Nelder-Mead",
                             options={"xatol": 1e-7, "fatol": 1e-9,
                                      "maxiter": 4000})
            best = min(best, found.fun)
    return best


def factor(slope, friction, cohesion, number=stability_number):
    """Factor of safety on cohesion and tan(friction)."""
    degrees = np.radians
    return brentq(
        lambda f: WEIGHT * HEIGHT * f / cohesion - number(
            degrees(slope), np.arctan(np.tan(degrees(friction)) / f)),
        0.5, 5, xtol=1e-5)


def main():
    for slope, friction, published in ((90, 0, 3.83), (90, 20, 5.50),
                                       (60, 10, 7.26), (45, 20, 16.16)):
        found = stability_number(np.radians(slope), np.radians(friction))
        print("slope %g, friction %g: %.3f, Chen %.2f"
              % (slope, friction, found, published))
    rows = {"cut": 12e3 * CUT / (WEIGHT * HEIGHT),
            "cut_with_friction": factor(90, 20, 5e3),
            "slope_60": factor(60, 10, 4e3),
            "slope_45": factor(45, 20, 2e3)}
    for n in (8, 16, 48):
        rows["cut_mesh_%d" % n] = mesh_limit.factor(n)[0]
    name = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                        "reference.csv")
    with open(name, "w") as stream:
        stream.write(",".join(n + " [-]" for n in rows) + "\n")
        stream.write(",".join("%.4f" % v for v in rows.values()) + "\n")
    print(rows)


if __name__ == "__main__":
    main()
