#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Confined columns of 1 m: what a weight or pressure shortens them by, and their
joint."""


def modulus(young, nu=0.25):
    return young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


G, LOW, HIGH, PRESSURE = 10.0, 2000.0, 1800.0, 50e3
WEIGHT = HIGH * G  # of the upper cube, by its area


def stages():
    """Displacement of the top of the lower and of the upper cube since each
    stage began [m], the traction of the joint [Pa], its opening since the upper
    cube was placed [m]."""
    closed = -WEIGHT / 5e9
    fill = -WEIGHT / modulus(1e9)
    press = -PRESSURE / modulus(0.25e9)
    return [
        (-LOW * G / 2 / modulus(1e9), 0.0, 0.0, 0.0),
        (fill, fill + closed - WEIGHT / 2 / modulus(0.5e9), -WEIGHT, closed),
        (press, press - PRESSURE / 2e9 - PRESSURE / modulus(0.5e9),
         -WEIGHT - PRESSURE, closed - PRESSURE / 2e9)]


if __name__ == "__main__":
    for row in stages():
        print("low %.6g, high %.6g, traction %.6g, opening %.6g" % row)
