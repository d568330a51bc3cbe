#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Load factors of rigid blocks against the displacement of their loads.

A body that turns by theta about an edge is in balance if the moments of its
weight W and of the loads p of the factor 1 cancel,
factor = W arm_W(theta) / (P arm_P(theta)), and the displacement of the loads
along themselves is the integral of arm_P. A body that slides is in balance
with the strength of its bed.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
G, DENSITY, START = 9.81, 2000.0, 0.5


def moved(t, v, ramp):
    """'Control function', t from the start of the stage."""
    return v * np.where(t < ramp, t**2 / (2 * ramp), t - ramp / 2)


def save(name, times, w, factor):
    np.savetxt(os.path.join(HERE, name),
               np.transpose([START + times, factor, w]), delimiter=",",
               fmt="%.9g", comments="", header="time [s],factor [-],moved [m]")


def turned(w, ratio, weight, load, direction, point=None):
    """Factor at the displacements w of the load, or of the point, along the
    load: places from the edge, the load towards direction; ratio: weight by
    load. The body turns clockwise."""
    theta = np.linspace(0, 0.6, 60001)
    c, s = np.cos(theta), np.sin(theta)
    place = np.array([c * load[0] + s * load[1], c * load[1] - s * load[0]])
    x, y = load if point is None else point
    way = direction @ np.array([c * x + s * y - x, c * y - s * x - y])
    arm_weight = -(c * weight[0] + s * weight[1])
    # clockwise moment of the load
    arm_load = place[1] * direction[0] - place[0] * direction[1]
    return np.interp(w, way, ratio * arm_weight / arm_load)


times = np.linspace(0.01, 4, 400)
w = 2e-3 * times**2
save("overturning.csv", times, w,
     turned(w, 1, (-0.5, 1), (-0.5, 1), np.array([1, 0])))

# over 11 degrees, which small displacements are not for
w = 0.05 * times
save("overturning_far.csv", times, w,
     turned(w, 1, (-0.5, 1), (-0.5, 1), np.array([1, 0])))
w = 2e-3 * times**2

save("overturning_top.csv", times, 2 * w,
     turned(2 * w, 1, (-0.5, 1), (-0.5, 1), np.array([1, 0]), (-0.5, 2)))

weight, axle = DENSITY * 4 * 0.4 * G, 10e3
save("axle.csv", times, w,
     turned(w, weight / axle, (-1.1, 0.2), (0.7, 0.4), np.array([0, -1])))

# the triangle has half the weight as its sum, at two thirds of the height
times = np.linspace(0.01, 2, 200)
w = 1e-3 * times**2
save("triangle_overturning.csv", times, w,
     turned(w, 2, (-0.5, 1.5), (-0.5, 2), np.array([1, 0])))

# joints slide at mu W / p of what is above them: least at the top block
heights = np.array([0, 1 / 3, 2 / 3])
least = np.min(2 * np.tan(np.radians(15)) / (1 + heights))
save("triangle_sliding.csv", times, w, np.full(len(times), least))

# sliding of the block
w = moved(times, 1e-3, 1)
save("sliding.csv", times, w, np.full(len(times), np.tan(np.radians(20))))

# slip weakening: ks (s - p) = peak - (peak - residual) p / Dc
w = moved(times, 4e-3, 1)
pressure, ks, critical = DENSITY * 0.25 * G, 1e8, 3e-3
peak = 2e3 + pressure * np.tan(np.radians(20))
residual = 0.2e3 + pressure * np.tan(np.radians(10))
fall = (peak - residual) / critical
tau = np.maximum((peak - fall * w) / (1 - fall / ks), residual)
save("softening.csv", times, w, np.minimum(ks * w, tau) / pressure)
print("peak of the softening bed: %.6g" % (peak / pressure))


def bond():
    """Largest factor of the wall in bond, of half bricks of 0.2 m."""
    sys.path.insert(0, os.path.dirname(HERE))
    from limit_analysis import Blocks, LimitAnalysis

    half, blocks, below = 0.2, Blocks(), [(-1, 0, 4)]
    for course in range(4):
        y = course * half
        ends = [0, 2, 4] if course % 2 == 0 else [0, 1, 3, 4]
        row = []
        for a, b in zip(ends, ends[1:]):
            corners = [(a, y), (b, y), (b, y + half), (a, y + half)]
            row.append((blocks.add_block(
                [(half * x, height) for x, height in corners]), a, b))
        for low, a, b in below:
            for high, c, d in row:
                first, last = max(a, c), min(b, d)
                if last > first:
                    blocks.add_joint(low, high, [(half * first, y),
                                                 (half * last, y)], (0, 1))
        for (left, _, x), (right, _, _) in zip(row, row[1:]):
            blocks.add_joint(left, right, [(half * x, y),
                                           (half * x, y + half)], (1, 0))
        below = row
    return LimitAnalysis(blocks, np.tan(np.radians(40))).associative()


print("largest factor of the wall in bond: %.6g" % bond())
