#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Arch of 157.5 degrees, seven voussoirs bounded by arcs of six chords."""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from block_geometry import Geometry  # noqa: E402

# radius of the centre line
RADIUS, THICKNESS, EMBRACE, VOUSSOIRS = 10.0, 1.5, np.radians(157.5), 7
CHORDS = 6


def arc(radius, start, end):
    angles = np.linspace(start, end, CHORDS + 1)
    return radius * np.transpose([np.cos(angles), np.sin(angles)])


def joints():
    """Angles of the joints from left to right."""
    return (np.pi + EMBRACE) / 2 - EMBRACE * np.arange(VOUSSOIRS + 1) \
        / VOUSSOIRS


def voussoirs():
    angles = joints()
    inner, outer = RADIUS - THICKNESS / 2, RADIUS + THICKNESS / 2
    for left, right in zip(angles, angles[1:]):
        yield np.concatenate([arc(outer, right, left),
                              arc(inner, left, right)])


def main():
    geometry = Geometry("Arch of 157.5 degrees, t/R = 0.15, 7 voussoirs.")
    angles = joints()
    for angle, side in ((angles[0], 1), (angles[-1], -1)):
        along = np.array([np.cos(angle), np.sin(angle)])
        away = side * THICKNESS * np.array([-along[1], along[0]])
        a, b = (along * (RADIUS + s * THICKNESS / 2) for s in (-1, 1))
        geometry.add("abutment", [a, b, b + away, a + away])
    for polygon in voussoirs():
        geometry.add("voussoir", polygon)
    geometry.write(os.path.join(HERE, "arch_seismic.geo"))


if __name__ == "__main__":
    main()
