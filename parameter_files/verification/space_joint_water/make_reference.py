#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A block on a joint that dips by b, with water of the force U in it.

The joint bears W z - U n, with its upward normal n; the block slides with
u'' = W/m sin b - (W/m cos b - U/m) tan(phi) down the plane, and the factor of
safety is (W cos b - U) tan(phi) / (W sin b).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DIP, AZIMUTH = np.radians(35), np.radians(30)   # of the steepest way, x to y
DENSITY, GRAVITY, UNIT_WEIGHT = 2500.0, 9.81, 9810.0
AREA, HEIGHT, CORNER = 1.0, 0.5, 1.3            # in plan; z of the corner [m]
MASS = DENSITY * AREA * HEIGHT
WEIGHT = MASS * GRAVITY
DROP = np.tan(DIP) * np.array([np.cos(AZIMUTH), np.sin(AZIMUTH)])
NORMAL = np.cos(DIP) * np.array([*DROP, 1.0])
DOWN = np.array([np.cos(DIP) * np.cos(AZIMUTH), np.cos(DIP) * np.sin(AZIMUTH),
                 -np.sin(DIP)])


def uniform(pressure):
    return pressure * AREA / np.cos(DIP)


def below(level, n=1000):
    """Force of water at rest whose level is above a part of the joint."""
    middle = (np.arange(n) + 0.5) / n
    x, y = np.meshgrid(middle, middle)
    z = CORNER - DROP[0] * x - DROP[1] * y
    return UNIT_WEIGHT * np.mean(np.maximum(level - z, 0)) * AREA / np.cos(DIP)


def write(name, header, rows):
    np.savetxt(os.path.join(HERE, name), rows, delimiter=",", fmt="%.10g",
               comments="", header=header)


def at_rest(uplift):
    return [1.0, *(np.array([0, 0, WEIGHT]) - uplift * NORMAL)]


def factor(uplift, degrees):
    return ((WEIGHT * np.cos(DIP) - uplift) * np.tan(np.radians(degrees))
            / (WEIGHT * np.sin(DIP)))


def slide(pressure, degrees, rise=0.1, step=1e-3, duration=0.3):
    """Displacement while gravity and water rise together by half a cosine."""
    t = np.arange(0, duration + step / 2, step)
    least = (GRAVITY * np.sin(DIP) - (GRAVITY * np.cos(DIP)
             - uniform(pressure) / MASS) * np.tan(np.radians(degrees)))
    omega = np.pi / rise
    early = 0.5 * (t**2 / 2 - (1 - np.cos(omega * t)) / omega**2)
    at_end = 0.5 * (rise**2 / 2 - 2 / omega**2)
    late = at_end + 0.5 * rise * (t - rise) + 0.5 * (t - rise)**2
    moved = least * np.where(t < rise, early, late)
    return np.column_stack([t, moved[:, None] * DOWN])


def main():
    forces = "time [s],force_x [N],force_y [N],force_z [N]"
    for name, uplift in (("uniform", uniform(3e3)), ("level", below(1.1))):
        print(name, "uplift %.6g, of the normal force %.4f"
              % (uplift, uplift / (WEIGHT * np.cos(DIP))))
        write("reference_%s.csv" % name, forces, [at_rest(uplift)])
    write("factors.csv", "uniform [-],level [-],dry [-]",
          [[factor(uniform(3e3), 60), factor(below(1.1), 60), factor(0, 60)]])
    write("reference_slide.csv", "time [s],ux [m],uy [m],uz [m]",
          slide(3e3, 25))


if __name__ == "__main__":
    main()
