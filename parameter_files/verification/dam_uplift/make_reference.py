#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""References by statics of a rigid dam, iterated: see README.md."""
import os

HERE = os.path.dirname(os.path.abspath(__file__))
GAMMA, CONCRETE = 9810.0, 2400 * 9.81
HEIGHT, WIDTH, STIFFNESS = 50.0, 40.0, 1e9


def diagram(head, tail, crack, drain=0.0, efficiency=0.0, outlet=None):
    """Corners (distance from the heel, level) of the uplift."""
    corners = [(0.0, head), (crack, head)]
    if drain > crack:
        line = tail + (head - tail) * (WIDTH - drain) / (WIDTH - crack)
        low = max(tail, tail if outlet is None else outlet)
        corners.append((drain, min(line, low + (1 - efficiency)
                                   * (line - low))))
    return corners + [(WIDTH, tail)]


def resultant(corners):
    """Force and moment about the heel [N, N m] of the pressures."""
    force = moment = 0.0
    for (x0, h0), (x1, h1) in zip(corners, corners[1:]):
        length = x1 - x0
        force += GAMMA * length * (h0 + h1) / 2
        moment += GAMMA * length * (x0 * (h0 + h1) / 2
                                    + length * (h0 + 2 * h1) / 6)
    return force, moment


def dam(head, tail=0.0, full_head=True, **drains):
    """Opening at the heel, traction at the toe, length of the crack and force
    on the joint: an effective stress that is linear and no tension."""
    weight = CONCRETE * HEIGHT * WIDTH / 2
    crack = water = 0.0
    for _ in range(10000):
        up, about_heel = resultant(diagram(head, tail, water, **drains))
        # The water before and behind the dam, whose face there is inclined.
        normal = weight - up + GAMMA * tail**2 / 2 * WIDTH / HEIGHT
        moment = (weight * WIDTH / 3 - about_heel + GAMMA * head**3 / 6
                  - GAMMA * tail**3 / 6
                  + GAMMA * tail**2 / 2 * WIDTH / HEIGHT
                  * (WIDTH - tail / 3 * WIDTH / HEIGHT))
        place = moment / normal
        crack = max(0.0, WIDTH - 3 * (WIDTH - place))
        if full_head:
            water = crack
    if crack > 0:
        toe = -2 * normal / (WIDTH - crack)
        heel = -toe / STIFFNESS * crack / (WIDTH - crack)
    else:
        tilt = 6 * normal * (place - WIDTH / 2) / WIDTH**2
        toe, heel = -normal / WIDTH - tilt, (tilt - normal / WIDTH) / STIFFNESS
    return heel, toe, crack, normal


def main():
    cases = {
        "crack": dam(50.0),
        "given": dam(50.0, full_head=False),
        "drain": dam(42.0, 5.0, drain=6.0, efficiency=0.6),
        "gallery": dam(42.0, 5.0, drain=6.0, efficiency=0.6, outlet=8.0),
        "drained_crack": dam(50.0, drain=8.0, efficiency=0.2),
    }
    for name, values in cases.items():
        print(name, values)
        with open(os.path.join(HERE, name + ".csv"), "w") as stream:
            stream.write("time [s],heel [m],toe [Pa],crack [m],vertical [N]\n"
                         + ",".join("%.12g" % value
                                    for value in (1.0,) + values) + "\n")


if __name__ == "__main__":
    main()
