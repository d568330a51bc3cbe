#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Least thickness of a semicircular arch under its own weight.

A line of thrust is fixed by the horizontal thrust H and by its moment H y at
the middle of the span: symmetric, so no shear there. On every radial joint it
must pass between intrados and extrados, which gives two linear inequalities in
(H, H y) each. The arch stands if some polygon of these half planes is left.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def clip(polygon, a, b, c):
    """The part of a convex polygon where a x + b y + c >= 0."""
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        at_p, at_q = (a * x[0] + b * x[1] + c for x in (p, q))
        if at_p >= 0:
            kept.append(p)
        if at_p * at_q < 0:
            s = at_p / (at_p - at_q)
            kept.append(tuple(u + s * (v - u) for u, v in zip(p, q)))
    return kept


def weights(thickness, number, arcs):
    """Weight and x of the centroid of each voussoir, R = 1, unit weight 1."""
    corners = np.pi * np.arange(number + 1) / number
    half = np.pi / number / 2
    inner, outer = 1 - thickness / 2, 1 + thickness / 2
    middle = (corners[1:] + corners[:-1]) / 2
    if arcs:
        area = half * (outer**2 - inner**2)
        radius = (2 * np.sin(half) * (outer**3 - inner**3)
                  / (3 * half * (outer**2 - inner**2)))
    else:
        area = np.sin(half) * np.cos(half) * (outer**2 - inner**2)
        radius = (2 * np.cos(half) * (outer**3 - inner**3)
                  / (3 * (outer**2 - inner**2)))
    return corners, np.full(number, area), radius * np.cos(middle)


def stands(thickness, number, arcs):
    """Right half; a voussoir at the crown is cut in two."""
    corners, weight, x = weights(thickness, number, arcs)
    polygon = [(0.0, -10.0), (10.0, -10.0), (10.0, 10.0), (0.0, 10.0)]
    for angle in corners[corners < np.pi / 2 + 1e-9]:
        # everything between the joint and the crown
        on = (x > 1e-9) & (corners[:-1] > angle - 1e-9)
        total, moment = weight[on].sum(), (weight * x)[on].sum()
        if number % 2:
            half = weight[number // 2] / 2
            total += half
            moment += half * half_centroid(thickness, number, arcs)
        for radius, side in ((1 - thickness / 2, 1), (1 + thickness / 2, -1)):
            px, py = radius * np.cos(angle), radius * np.sin(angle)
            # the thrust passes outside the inner, inside the outer corner
            polygon = clip(polygon, -side * py, side,
                           side * (moment - total * px))
            if not polygon:
                return False
    return True


def half_centroid(thickness, number, arcs):
    """x of the centroid of half the voussoir at the crown."""
    half = np.pi / number / 2
    inner, outer = 1 - thickness / 2, 1 + thickness / 2
    if arcs:
        moment = (1 - np.cos(half)) * (outer**3 - inner**3) / 3
        return moment / (half * (outer**2 - inner**2) / 2)
    # quadrilateral between x = 0 and the joint
    a, b = inner * np.sin(half), outer * np.sin(half)
    return (a**2 + a * b + b**2) / (3 * (a + b))


def least(number, arcs):
    low, high = 0.05, 0.2
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = ((low, middle) if stands(middle, number, arcs)
                     else (middle, high))
    return high


def main():
    values = [least(27, False), least(27, True), least(1001, True)]
    names = ["27 straight voussoirs", "27 voussoirs", "1001 voussoirs"]
    for name, value in zip(names, values):
        print("%-22s t/R = %.5f" % (name, value))
    np.savetxt(os.path.join(HERE, "reference.csv"), [values], fmt="%.5f",
               delimiter=",", comments="",
               header=",".join(name + " [-]" for name in names))


if __name__ == "__main__":
    main()
