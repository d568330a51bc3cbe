#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes reference.csv, reference_8.csv and reference_explicit.csv, the pressure
[kPa] on a simply supported strip of wall by its mean deflection, with opening and
damage of its middle joint at the edge in tension, and reference_crack_4.csv and
reference_crack_6.csv, the pressure at which that edge cracks.

Joints have plane sections between units that bend and shear as beams. With n
faces over the thickness t a joint has n + 1 rows of points, each with the area
A/n, the outer two with half of that: the trapezoidal rule. Their second moment of
area is (1 + 2/n^2) that of the section, so that the edge cracks at

  M = (ft + N/A) W (1 + 2/n^2),   W = A t/6,   M = q b h^2/8 + N w.

A row carries sigma = kn (u - p), at most ft exp(-ft p/GfI), at which p grows: the
plastic opening, which unloading leaves as it is. Each joint balances

  sum sigma A = -N,   sum sigma A y = q b z (h - z)/2 + N w(z)

with the deflection w of the kinks in all joints, of the units and of the slip of
joints. The kink of the middle joint grows, and the pressure is what it asks for.

The controlled displacement is the mean of the deflection over the height, but for
the loads on nodes that supports hold: half a layer of elements at either end.
"""
import csv
import os

import numpy as np

COURSES, COURSE, THICKNESS = 4, 0.2, 0.12
HEIGHT = COURSES * COURSE
NORMAL_STIFFNESS, SHEAR_STIFFNESS = 20e9, 8e9
STRENGTH, ENERGY = 0.25e6, 18.0
COMPRESSION = 0.1e6    # N/A [Pa]
YOUNG, POISSON = 200e9, 0.15
# all by the length of the strip
MODULUS = THICKNESS**2 / 6


def rows(faces):
    """Distances of the points from the middle, and their areas."""
    y = np.linspace(-THICKNESS / 2, THICKNESS / 2, faces + 1)
    area = np.full(faces + 1, THICKNESS / faces)
    area[[0, -1]] /= 2
    return y, area


def strength(plastic):
    return STRENGTH * np.exp(-STRENGTH * plastic / ENERGY)


def traction(opening, plastic):
    """Traction, its derivative by the opening, and the plastic opening at the end
    of an increment that begins with @p plastic."""
    more = np.zeros_like(opening)
    beyond = NORMAL_STIFFNESS * (opening - plastic) > strength(plastic)
    for _ in range(50):    # Newton's method
        bound = strength(plastic + more)
        excess = NORMAL_STIFFNESS * (opening - plastic - more) - bound
        step = excess / (NORMAL_STIFFNESS - STRENGTH / ENERGY * bound)
        more = np.where(beyond, np.maximum(more + step, 0), 0)
        if not np.any(np.abs(step[beyond]) > 1e-16):
            break
    plastic = plastic + more
    softening = -STRENGTH / ENERGY * strength(plastic)
    slope = np.where(
        beyond,
        NORMAL_STIFFNESS * softening / (NORMAL_STIFFNESS + softening),
        NORMAL_STIFFNESS)
    return NORMAL_STIFFNESS * (opening - plastic), slope, plastic


def kinked(z, joint):
    """Deflection at z by a kink of 1 at the height of a joint."""
    return np.where(z <= joint, z * (1 - joint / HEIGHT),
                    joint * (1 - z / HEIGHT))


def strip(faces, layers, kinks):
    """Mean deflection [m], pressure [Pa], opening [m] and damage at the edge of
    the middle joint, for increasing kinks of that."""
    y, area = rows(faces)
    z = COURSE * np.arange(1, COURSES)
    count, middle = len(z), len(z) // 2
    normal = COMPRESSION * THICKNESS
    lever = z * (HEIGHT - z) / 2              # moment by the pressure
    by_kinks = kinked(z[:, None], z[None, :])

    # deflection of the units and by slip of the joints, by the pressure
    x = (np.arange(4000) + 0.5) * HEIGHT / 4000
    curvature = (x * (HEIGHT - x) / 2 * HEIGHT / 4000
                 / (YOUNG * THICKNESS**3 / 12 / (1 - POISSON**2)))
    shear = 5 / 6 * THICKNESS * YOUNG / 2 / (1 + POISSON)
    slip = (HEIGHT / 2 - z) / (SHEAR_STIFFNESS * THICKNESS)
    slipped = np.array([np.sum(slip * ((z < at - 1e-9) + (z < at + 1e-9)) / 2)
                        for at in z])
    elastic = slipped + lever / shear + np.array(
        [np.sum(curvature * kinked(at, x)) for at in z])
    elastic_mean = (np.sum(slip * (HEIGHT - z)) / HEIGHT
                    + HEIGHT**2 / 12 / shear
                    + np.sum(curvature * x * (HEIGHT - x) / 2) / HEIGHT)
    free = 1 - 1 / layers                     # share of the load

    closure = np.full(count, -COMPRESSION / NORMAL_STIFFNESS)
    turn, pressure = np.zeros(count), 0.0
    plastic = np.zeros((count, len(y)))
    table = []
    for kink in kinks:
        for _ in range(50):
            sigma, slope, new = traction(closure[:, None] + turn[:, None] * y,
                                         plastic)
            deflection = by_kinks @ turn + pressure * elastic
            residual = np.concatenate([
                sigma @ area + normal,
                sigma @ (area * y) - pressure * lever - normal * deflection,
                [turn[middle] - kink]])
            matrix = np.zeros((2 * count + 1, 2 * count + 1))
            matrix[:count, :count] = np.diag(slope @ area)
            matrix[:count, count:-1] = np.diag(slope @ (area * y))
            matrix[count:-1, :count] = np.diag(slope @ (area * y))
            matrix[count:-1, count:-1] = (np.diag(slope @ (area * y**2))
                                          - normal * by_kinks)
            matrix[count:-1, -1] = -lever - normal * elastic
            matrix[-1, count + middle] = 1
            step = np.linalg.solve(matrix, -residual)
            closure += step[:count]
            turn += step[count:-1]
            pressure += step[-1]
            if np.max(np.abs(step[:-1])) < 1e-13:
                break
        else:
            raise RuntimeError("no equilibrium at a kink of %g" % kink)
        plastic = new
        mean = lever / HEIGHT @ turn + pressure * elastic_mean
        table.append((mean / free, pressure,
                      closure[middle] + turn[middle] * y[-1],
                      1 - strength(plastic[middle, -1]) / STRENGTH))
    return np.array(table).T


def cracks(faces, layers):
    """Pressure [Pa] at which the edge of the middle joint cracks."""
    kink = (STRENGTH + COMPRESSION) / NORMAL_STIFFNESS / (THICKNESS / 2)
    return strip(faces, layers, [(1 - 1e-9) * kink])[1, 0]


def write(name, columns, rows):
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    with open(path, "w", newline="") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(columns)
        for row in rows:
            table.writerow(["%.9g" % value for value in row])


def write_curve(name, curve, times, moved):
    values = [np.interp(moved, curve[0], row) for row in curve[1:]]
    write(name, ["time [s]", "factor [-]", "opening [m]", "damage [-]"],
          zip(times, values[0] / 1e3, values[1], values[2]))


def pushed(time):
    """Control function of the explicit run."""
    return 1.7e-3 * np.where(time < 0.04, 12.5 * time**2, time - 0.02)


def main():
    kinks = np.linspace(0, 3e-3, 2001)
    for faces in (2, 4, 6, 8, 16, 64):
        layers = int(np.ceil(COURSE / (THICKNESS / faces) - 1e-9)) * COURSES
        curve = strip(faces, layers, kinks)
        edge = cracks(faces, layers)
        by_hand = ((STRENGTH + COMPRESSION) * MODULUS * (1 + 2 / faces**2)
                   * 8 / HEIGHT**2)
        most = np.argmax(curve[1])
        print("%2d faces: cracks at %.6g kPa (without N w %.6g), bears %.6g kPa at "
              "%.4g mm" % (faces, edge / 1e3, by_hand / 1e3,
                           curve[1, most] / 1e3, 1e3 * curve[0, most]))
        if faces in (4, 6):
            write("reference_crack_%d.csv" % faces, ["time [s]", "factor [-]"],
                  [(2, edge / 1e3)])
        if faces in (4, 8):
            times = np.linspace(0, 1, 51)
            name, speed = (("reference.csv", 0.333e-3) if faces == 4
                           else ("reference_8.csv", 0.32e-3))
            write_curve(name, curve, 1 + times, speed * times)
        if faces == 4:
            times = np.linspace(0, 0.22, 45)
            write_curve("reference_explicit.csv", curve, 0.02 + times,
                        pushed(times))


if __name__ == "__main__":
    main()
