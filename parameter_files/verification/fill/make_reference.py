#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Settlement without lateral strain of a column, height H, by its own weight and
that of a block, height h, on a joint of the stiffness kn with the pressure p on it, by
Hooke's law with the modulus M = E (1 - nu)/((1 + nu)(1 - 2 nu)) of each:

  top of the column    u_c = -(rho g H^2/2 + q H)/M,   q = share (rho_f g h + p),
  joint, where there   q/kn closed since the block was placed,
  top of the block     -(rho_f g h^2/2 + p h)/M_f - q/kn + u_c - u_c when placed.

q is what the block exerts, or what is not released of that. A row a stage.

With water of the pressure w in the joint the law of the joint bears q - w; water and joint
together exert q, and go together when the block is excavated.
"""
import os

HERE = os.path.dirname(os.path.abspath(__file__))
G, HEIGHT, BLOCK, STIFFNESS = 10.0, 4.0, 2.0, 1e10
PRESSURE, WATER = 10e3, 20e3


def modulus(young, nu):
    return young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


SOIL = (2000.0, modulus(2e9, 0.25))
CONCRETE = (2500.0, modulus(4e9, 0.2))


def column(q):
    density, m = SOIL
    return -(density * G * HEIGHT**2 / 2 + q * HEIGHT) / m


def placed(material):
    """Column, block, gap of the joint, its traction."""
    density, m = material
    q = density * G * BLOCK + PRESSURE
    settles = column(q) - column(0)
    top = (-(density * G * BLOCK / 2 + PRESSURE) * BLOCK / m - q / STIFFNESS
           + settles)
    return column(q), top, -q / STIFFNESS, -q


def above_water(material):
    """Column, traction and pressure of the water of the joint."""
    settled, _, _, traction = placed(material)
    return settled, traction + WATER, WATER


def write(name, columns, rows):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write("stage [-]," + columns + "\n")
        for i, row in enumerate(rows):
            stream.write("%d," % (i + 1)
                         + ",".join("%.9g" % value for value in row) + "\n")


def main():
    weight = SOIL[0] * G * BLOCK + PRESSURE
    write("reference.csv",
          "base_top [m],fill_top [m],opening [m],traction [Pa]",
          [(column(0), 0, 0, 0), placed(SOIL),
           (column(0.5 * weight), 0, 0, 0), (column(0), 0, 0, 0),
           placed(CONCRETE)])
    write("reference_water.csv",
          "base_top [m],traction [Pa],pressure [Pa]",
          [(column(0), 0, 0), above_water(SOIL), (column(0.5 * weight), 0, 0),
           (column(0), 0, 0), above_water(CONCRETE)])


if __name__ == "__main__":
    main()
