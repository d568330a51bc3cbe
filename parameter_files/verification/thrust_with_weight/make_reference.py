#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Slip and closure of an elastic bed under the weight and the thrust of a block."""
import os

HERE = os.path.dirname(os.path.abspath(__file__))
PRESSURE, SHARE = 2500.0 * 9.81 * 0.5, 0.3
NORMAL, SHEAR = 1e10, 5e9

with open(os.path.join(HERE, "reference.csv"), "w", encoding="utf-8") as file:
    file.write("time [s],slip [m],opening [m]\n0,%.12g,%.12g\n"
               % (SHARE * PRESSURE / SHEAR, -PRESSURE / NORMAL))
