#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The method of characteristics of joint_wave_p, with S speed and ks."""
import importlib.util
import os

HERE = os.path.dirname(os.path.abspath(__file__))
spec = importlib.util.spec_from_file_location(
    "characteristics",
    os.path.join(HERE, "..", "joint_wave_p", "make_reference.py"))
characteristics = importlib.util.module_from_spec(spec)
spec.loader.exec_module(characteristics)

if __name__ == "__main__":
    characteristics.write(HERE, False, 2650.0, 5830.0 / 3**0.5, 2e9, 30.0,
                          0.05, 0.2)
