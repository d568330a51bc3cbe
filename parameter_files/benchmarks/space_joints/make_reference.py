#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Pressures between which the largest one of out_of_plane.prm lies, "pressure
between" of its case.

A bed joint has three faces over the thickness, so four rows of points, of a sixth,
a third, a third and a sixth of its area. Plane sections turn it under the weight
above; a row carries kn (u - p), at most ft exp(-ft p/GfI), at which its plastic
opening p grows. The largest moment by length m follows.

Not less: a strip that is clamped at its base and propped at its head bears what
brings the lowest bed joint to its m by elastic moments,

  M(z) = q (H^2/8 - 5 H z/8 + z^2/2),

as that softens before, and the supported ends only help. As units are not rigid, kn
is in series with a row of elements of either unit.

Not more: yield lines along the lowest bed joint and along one at z, which parts
into diagonals to the corners at the distance c from the ends, all of them at
their m at once, with rigid units. The ends turn about their supports: across
vertical lines the head joint of a course and the torsion of an overlap of units
resist. With a = z - z0, b = H - z, per displacement of the middle line

  work = L (m0/a + m (1/a + 1/b)) + 2 mh (a + b)/c,
  volume = (a + b) (L/2 - c/3).
"""
import numpy as np

LENGTH, HEIGHT, THICKNESS, COURSE, OVERLAP = 12.0, 2.0, 0.12, 0.1, 0.12
FACES, ELEMENT = 3, 0.05
TENSION, ENERGY, COHESION, FRICTION = 0.25e6, 18.0, 0.35e6, 0.75
STIFFNESS, YOUNG, WEIGHT = 82e9, 16.7e9, 1900 * 9.81


def rows(faces, width):
    """Points over a width, from its middle, and what length each stands for."""
    y = np.linspace(-width / 2, width / 2, faces + 1)
    share = np.full(faces + 1, width / faces)
    share[[0, -1]] /= 2
    return y, share


def largest_moment(stress, stiffness):
    """Of a joint by its length [N] under a compression."""
    y, share = rows(FACES, THICKNESS)
    closure, plastic, most = -stress / stiffness, np.zeros(FACES + 1), 0.0
    for turn in np.linspace(0, 1e-3, 501):
        for _ in range(100):
            opening = closure + turn * y
            more = np.zeros(FACES + 1)
            beyond = stiffness * (opening - plastic) \
                > TENSION * np.exp(-TENSION * plastic / ENERGY)
            for _ in range(30):
                bound = TENSION * np.exp(-TENSION * (plastic + more) / ENERGY)
                step = ((stiffness * (opening - plastic - more) - bound)
                        / (stiffness - TENSION / ENERGY * bound))
                more = np.where(beyond, np.maximum(more + step, 0), 0)
                if not np.any(np.abs(step[beyond]) > 1e-15):
                    break
            sigma = stiffness * (opening - plastic - more)
            softening = -TENSION / ENERGY * sigma
            slope = np.where(beyond,
                             stiffness * softening / (stiffness + softening),
                             stiffness)
            excess = sigma @ share + stress * THICKNESS
            if abs(excess) < 1e-6 * TENSION * THICKNESS:
                break
            closure -= excess / (slope @ share)
        plastic = plastic + more
        most = max(most, sigma @ (share * y))
    return most


def torsion(stress):
    """Of the overlap of two units [N m], all of its points slipping about its
    middle."""
    x, along = rows(FACES, OVERLAP)
    y, across = rows(FACES, THICKNESS)
    lever = np.sum(np.hypot(*np.meshgrid(x, y)) * np.outer(across, along))
    return (COHESION + FRICTION * stress) * lever


def least():
    in_series = 1 / (1 / STIFFNESS + 2 * THICKNESS / FACES / YOUNG)
    moment = largest_moment(WEIGHT * (HEIGHT - COURSE), in_series)
    return moment / (HEIGHT**2 / 8 - 5 * HEIGHT * COURSE / 8 + COURSE**2 / 2)


def most():
    base = largest_moment(WEIGHT * (HEIGHT - COURSE), STIFFNESS)
    span, found = HEIGHT - COURSE, np.inf
    c = np.linspace(0.2, LENGTH / 2, 581)
    for z in COURSE * np.arange(8, 16):
        stress = WEIGHT * (HEIGHT - z)
        a, b = z - COURSE, HEIGHT - z
        along = (base / a
                 + largest_moment(stress, STIFFNESS) * (1 / a + 1 / b))
        across = (largest_moment(0, STIFFNESS)
                  + torsion(WEIGHT * HEIGHT / 2) / COURSE)
        work = LENGTH * along + 2 * across * span / c
        found = min(found, np.min(work / (span * (LENGTH / 2 - c / 3))))
    return found


if __name__ == "__main__":
    print("between %.4g and %.4g kPa" % (least() / 1e3, most() / 1e3))
