#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Stereonets: projection and mean planes by closed forms, what is read of a
table, and the message about a table of another section."""
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from synthetic_runs import SCRIPTS
from quoin.commands import stereonet

TABLE = """kind,name,dip [deg],dip direction [deg],P32 asked [1/m],P32 made [1/m],P10 made [1/m],volume [m^3]
set,bedding,10,90,0.5,0.48,0.47,
plane,bedding,20,90,,,,
plane,bedding,20,270,,,,
set,cross,85,0,1,1,0.98,
plane,cross,80,0,,,,
plane,cross,90,180,,,,
block,1,,,,,,2.5
"""


class Projection(unittest.TestCase):
    def test_a_horizontal_plane_is_the_middle_and_the_rim(self):
        np.testing.assert_allclose(stereonet.project(stereonet.pole(0, 0)), 0,
                                   atol=1e-15)
        rim = np.linalg.norm(stereonet.great_circle(0.0, 0.0), axis=1)
        np.testing.assert_allclose(rim, 1)

    def test_poles_lie_opposite_to_the_dip(self):
        # Equal areas: sqrt(2) sin(dip/2) from the middle.
        for dip, direction in ((30, 90), (60, 200), (90, 315)):
            at = stereonet.project(stereonet.pole(dip, direction))
            size = np.sqrt(2) * np.sin(np.radians(dip) / 2)
            turn = np.radians(direction)
            np.testing.assert_allclose(
                at, [-size * np.sin(turn), -size * np.cos(turn)], atol=1e-14)

    def test_lines_of_a_great_circle_lie_in_the_plane(self):
        # The lowest of them dips as the plane does, in its direction.
        at = stereonet.great_circle(40.0, 130.0)
        steps = np.linalg.norm(np.diff(at, axis=0), axis=1)
        self.assertLess(np.max(steps), 0.02)  # from rim to rim, no jump
        lowest = at[np.argmin(np.linalg.norm(at, axis=1))]
        np.testing.assert_allclose(
            np.linalg.norm(lowest), np.sqrt(2) * np.sin(np.radians(25)))
        np.testing.assert_allclose(
            np.degrees(np.arctan2(lowest[0], lowest[1])) % 360, 130)

    def test_the_mean_of_two_planes_halves_them(self):
        dip, direction, concentration = stereonet.mean_plane(
            stereonet.pole(np.array([20., 20.]), np.array([80., 100.])))
        self.assertAlmostEqual(direction, 90)
        # tan of the mean: that of the dip times the cosine of half the angle
        self.assertAlmostEqual(np.tan(np.radians(dip)),
                               np.tan(np.radians(20)) * np.cos(np.radians(10)))
        size = 2 * np.hypot(np.cos(np.radians(20)),
                            np.sin(np.radians(20)) * np.cos(np.radians(10)))
        self.assertAlmostEqual(concentration, 1 / (2 - size))


class Files(unittest.TestCase):
    def run_script(self, folder, *words):
        return subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "stereonet"), folder, *words],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def test_a_table_is_read_and_drawn(self):
        with tempfile.TemporaryDirectory(prefix="quoin_") as folder:
            with open(os.path.join(folder, "rock_statistics.csv"), "w") as file:
                file.write(TABLE)
            sets = stereonet.read_sets(folder)
            self.assertEqual([len(poles) for _, poles in sets.values()], [2, 2])
            dip, _, _ = stereonet.mean_plane(sets["bedding"][1])
            self.assertAlmostEqual(dip, 0)
            # 80 and 90 degrees, of which the second dips the other way
            dip, direction, _ = stereonet.mean_plane(sets["cross"][1])
            self.assertAlmostEqual(dip, 85)
            self.assertAlmostEqual(np.cos(np.radians(direction)), 1)
            for name, words in (("net.png", ["--out"]), ("stereonet.png", [])):
                out = os.path.join(folder, name)
                run = self.run_script(folder, *words, *[out] * len(words))
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(run.stdout.strip(), out)
                self.assertGreater(os.path.getsize(out), 10000)

    def test_another_table_is_refused(self):
        with tempfile.TemporaryDirectory(prefix="quoin_") as folder:
            with open(os.path.join(folder, "rock_statistics.csv"), "w") as file:
                file.write("quantity,asked\ndip,30\n")
            run = self.run_script(folder)
            self.assertEqual(run.returncode, 1)
            self.assertIn("is not of a section 'Rock box'", run.stderr)
            run = self.run_script(os.path.join(folder, "none"))
            self.assertEqual(run.returncode, 1)
            self.assertIn("rock_statistics.csv", run.stderr)


if __name__ == "__main__":
    unittest.main()
