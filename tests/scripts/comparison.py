#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""scripts/compare on runs whose answers are known."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from synthetic_runs import (NOTHING, SCRIPTS, SLID, SPEC, WIDE, Folders,
                            joint_grid, write_run)
from quoin import joint_comparison
from quoin import run_parameters
from quoin import solver_comparison
from quoin.vtu import Grid


class Numbers(Folders):
    def test_peaks_and_costs(self):
        numbers = self.compare().numbers()
        self.assertEqual(
            [numbers[s]["peak [kN]"] for s in ("explicit", "implicit")],
            [40., 36.])
        self.assertEqual(numbers["implicit"]["at [mm]"], 2.)
        self.assertEqual(numbers["explicit"]["end [mm]"], 4.)
        self.assertAlmostEqual(numbers["peak, implicit by explicit"], 0.9)
        self.assertEqual(numbers["wall time, explicit by implicit"], 5.)
        self.assertEqual(numbers["implicit"]["steps"], 3)
        self.assertEqual(len(numbers["notes"]), 1)
        self.assertIn("implicit run ended early, at 3 mm",
                      numbers["notes"][0])
        json.dumps(numbers)

    def test_differences(self):
        curves = self.compare().numbers()["curves"]
        self.assertAlmostEqual(curves["largest difference"], 0.1)
        self.assertAlmostEqual(curves["largest difference up to the peak"],
                               0.1)
        self.assertEqual(curves["largest at [mm]"], 2.)
        self.assertEqual((curves["from [mm]"], curves["to [mm]"]), (0., 3.))
        self.assertAlmostEqual(curves["share of the explicit curve"], 0.75)
        # a tenth of the triangle and of the trapezoid below the curve
        self.assertAlmostEqual(curves["mean difference"],
                               0.1 * (40. + 35.) / 3. / 40.)

    def test_beyond_the_earlier_peak_is_not_before_the_peak(self):
        shutil.rmtree(self.implicit)
        write_run(self.implicit, 1e-3 * np.array([0., 1., 2.]),
                  -1e3 * np.array([0., 22., 20.]), {})
        curves = self.compare().numbers()["curves"]
        self.assertAlmostEqual(curves["largest difference up to the peak"],
                               0.05)
        self.assertAlmostEqual(curves["largest difference"], 0.5)

    def test_the_peak_of_a_plateau_is_its_end(self):
        forces = {0.: 0., 1.: 39.99, 2.: 40., 3.: 39.98, 4.: 30.}
        run = object.__new__(solver_comparison.Run)
        run.way, run.y = (np.array(v) for v in (list(forces),
                                                list(forces.values())))
        run.peak_row, run.peak = 2, 40.
        self.assertEqual(run.way_of_peak(), 3.)
        run.y = -np.array([0., 39.99, 40., 39.9, 39.99])
        run.peak = -40.
        self.assertEqual(run.way_of_peak(), 2.)
        run.y = np.array([0., 20., 40., 40., 40.])
        run.peak = 40.
        self.assertEqual(run.way_of_peak(), 4.)

    def test_fields_are_of_the_same_displacement(self):
        joints = self.compare().numbers()["joints"]
        peak, end = joints["at the peak"], joints["at the end"]
        self.assertEqual((peak["explicit at [mm]"], peak["implicit at [mm]"]),
                         (2., 2.))
        self.assertEqual((end["explicit at [mm]"], end["implicit at [mm]"]),
                         (3., 3.))
        self.assertEqual(peak["same class"], 1.)
        self.assertEqual(peak["explicit [m]"],
                         {"closed": 0.5, "sliding": 1., "open": 1.5})
        # open in one only: half of the first face and half of the second;
        # of these one slides in the other run
        self.assertAlmostEqual(end["same class"], 0.5)
        self.assertEqual(end["open in both"], 0.)

    def test_the_implicit_field_follows_the_explicit_one(self):
        rows = 1e-3 * np.array([0., 1.5, 2., 2.6, 2.7]), -1e3 * np.array(
            [0., 30., 40., 34., 33.])
        still = joint_grid(NOTHING, NOTHING)
        for folder, fields in ((self.explicit, (0, 3)),
                               (self.implicit, (0, 1, 4))):
            shutil.rmtree(folder)
            write_run(folder, *rows, {k: still for k in fields})
        peak = self.compare().numbers()["joints"]["at the peak"]
        self.assertAlmostEqual(peak["explicit at [mm]"], 2.6)
        self.assertAlmostEqual(peak["implicit at [mm]"], 2.7)

    def test_a_run_that_stops_before_the_peak(self):
        shutil.rmtree(self.implicit)
        write_run(self.implicit, [0., 1.5e-3], [0., -30e3],
                  {0: joint_grid(NOTHING, NOTHING),
                   1: joint_grid(WIDE, SLID)}, finished=False)
        numbers = self.compare().numbers()
        self.assertAlmostEqual(numbers["curves"]["largest difference"], 0.)
        self.assertTrue(numbers["implicit"]["peak at its end"])
        self.assertEqual(numbers["joints"]["at the peak"]["explicit at [mm]"],
                         2.)
        self.assertTrue(any("does not reach the peak" in note
                            for note in numbers["notes"]))
        self.assertTrue(any("fields at the peak are far apart" in note
                            for note in numbers["notes"]))

    def test_nothing_in_common(self):
        shutil.rmtree(self.implicit)
        write_run(self.implicit, [5e-3, 6e-3], [0., -30e3], {})
        with self.assertRaisesRegex(ValueError, "nothing in common"):
            self.compare()


class Ways(unittest.TestCase):
    def test_noise_and_cycles(self):
        grows = np.array([0., 1., 0.99, 2., 3.])
        self.assertFalse(solver_comparison.turns_back(grows))
        self.assertFalse(solver_comparison.turns_back(-grows))
        self.assertFalse(solver_comparison.turns_back(np.zeros(3)))
        np.testing.assert_array_equal(
            solver_comparison.way_of(-grows, False), [0., 1., 1., 2., 3.])
        cycle = np.array([0., 1., -1., 0.5])
        self.assertTrue(solver_comparison.turns_back(cycle))
        np.testing.assert_array_equal(
            solver_comparison.way_of(cycle, True), [0., 1., 3., 4.5])

    def test_cycles_are_compared_over_their_way(self):
        with tempfile.TemporaryDirectory() as folder:
            u = 1e-3 * np.array([0., 1., -1., 1.])
            f = -1e3 * np.array([0., 10., -10., 8.])
            paths = [os.path.join(folder, name) for name in "ei"]
            write_run(paths[0], u, f, {})
            write_run(paths[1], u, 0.8 * f, {})
            numbers = solver_comparison.Comparison(
                SPEC, folder, *paths).numbers()
            self.assertAlmostEqual(numbers["curves"]["largest difference"],
                                   0.2)
            self.assertEqual(numbers["curves"]["to [mm]"], 5.)
            self.assertIsNone(numbers["joints"])
            self.assertIn("joints are not compared", numbers["notes"][-1])

    def test_joints_in_space_are_not_compared(self):
        triangle = Grid(0., np.eye(3), np.array([[0, 1, 2]]),
                        {"displacement": np.zeros((3, 3))},
                        {"joint set": np.zeros(1, np.int32)})
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in "ei"]
            for path in paths:
                write_run(path, [0., 1.], [0., 1e3],
                          {0: triangle, 1: triangle})
            numbers = solver_comparison.Comparison(
                SPEC, folder, *paths).numbers()
            self.assertIsNone(numbers["joints"])
            self.assertIn("those of three dimensions", numbers["notes"][-1])


class Joints(unittest.TestCase):
    opening = [[2e-4, 0.], [5e-4, 5e-4], [0., 0.]]
    slip = [[0., 2e-4], [0., 0.], [0., -5e-5]]

    def agree(self, first, second):
        return joint_comparison.agreement(first, second, [1e9], 1e-4)

    def test_classes(self):
        grid = joint_grid(self.opening, self.slip)
        found = joint_comparison.classes(grid, [1e9], 1e-4)
        self.assertEqual(found.tolist(), [[2, 1], [2, 2], [0, 0]])
        # slip that is elastic does not count
        grid.point_data["shear traction"][1] = 2e5
        found = joint_comparison.classes(grid, [1e9], 1e-4)
        self.assertEqual(found[0].tolist(), [2, 0])

    def test_slip_of_initial_stresses_is_elastic(self):
        """What the run says counts, and not the stiffness of a set, but for
        joints that have become contacts."""
        grid = joint_grid(self.opening, self.slip)
        n = len(grid.points)
        grid.point_data["opening"] = np.zeros(n)
        grid.point_data["slip"] = np.zeros(n)
        grid.point_data["shear traction"] = np.full(n, 1e6)
        found = joint_comparison.classes(grid, [1e9], 1e-4)
        self.assertEqual(found.tolist(), [[1, 1]] * 3)
        grid.point_data["inelastic slip"] = np.zeros(n)
        grid.cell_data["handed over"] = np.array([0, 0, 1])
        found = joint_comparison.classes(grid, [1e9], 1e-4)
        self.assertEqual(found.tolist(), [[0, 0], [0, 0], [1, 1]])

    def test_faces_in_another_order(self):
        first = joint_grid(self.opening, self.slip)
        second = joint_grid(self.opening, self.slip, [2, 0, 1], turned=[0])
        found = self.agree(first, second)
        self.assertEqual(found["same class"], 1.)
        self.assertEqual(found["cracked in both"], 1.)
        self.assertEqual(found["length [m]"], 6.)

    def test_faces_that_one_run_lost(self):
        first = joint_grid(self.opening, self.slip)
        second = joint_grid(self.opening, self.slip, [2, 0])
        for found in (self.agree(first, second), self.agree(second, first)):
            self.assertEqual(found["length [m]"], 4.)
            self.assertEqual(found["same class"], 1.)

    def test_shares(self):
        first = joint_grid(self.opening, self.slip)
        second = joint_grid([[0., 0.], [5e-4, 0.], [0., 0.]], 3 * [[0., 0.]])
        found = self.agree(first, second)
        self.assertAlmostEqual(found["same class"], 4. / 6.)
        self.assertAlmostEqual(found["open in both"], 1. / 2.5)
        self.assertAlmostEqual(found["cracked in both"], 1. / 3.)
        self.assertAlmostEqual(found["same damage"], 5. / 6.)
        sound = joint_grid(NOTHING, NOTHING)
        self.assertIsNone(self.agree(sound, sound)["open in both"])


class Script(Folders):
    def setUp(self):
        super().setUp()
        self.case = os.path.join(self.folder, "case.prm")
        with open(self.case, "w") as file:
            file.write("include common.inc\n")
        with open(os.path.join(self.folder, "common.inc"), "w") as file:
            file.write("set Output directory = results  # here\n")
        with open(os.path.join(self.folder, "plot.json"), "w") as file:
            json.dump(SPEC, file)

    def call(self, *words):
        done = subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "compare"), *words],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            timeout=120)
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout, done.stderr

    def test_output_directory(self):
        self.assertEqual(run_parameters.output_of(self.case),
                         os.path.join(self.folder, "results"))
        self.assertEqual(
            run_parameters.output_of(self.case, ["Output directory=/x"]), "/x")

    def test_runs_both(self):
        status, printed, error = self.call(self.case, "--quoin", self.quoin(2),
                                           "--set", "Thickness=1")
        self.assertEqual((status, error), (0, ""))
        output = os.path.join(self.folder, "results_compare")
        for name in ("compare.png", "cracks.png"):
            self.assertGreater(
                os.path.getsize(os.path.join(output, name)), 5000)
        with open(os.path.join(output, "compare.json")) as file:
            numbers = json.load(file)
        self.assertEqual(numbers["implicit"]["folder"],
                         os.path.join(output, "implicit"))
        self.assertIn("10.00 % of the peak", printed)
        self.assertIn("note: the implicit run ended early", printed)

    def test_folders_at_hand(self):
        output = os.path.join(self.folder, "both")
        words = ("--explicit", self.explicit, "--implicit", self.implicit,
                 "--output", output)
        self.assertEqual(self.call(self.case, *words, "--at", "2,3")[0], 0)
        status, _, error = self.call(*words)
        self.assertEqual(status, 1)
        self.assertIn("give --spec plot.json", error)
        status, _, error = self.call(self.case, *words, "--at", "top")
        self.assertEqual(status, 1)
        self.assertIn("not 'top'", error)

    def test_refusals(self):
        status, _, error = self.call(self.case, "--quoin", self.quoin(1))
        self.assertEqual(status, 1)
        self.assertIn("implicit run ended with exit status 1", error)
        status, _, error = self.call(self.case, "--explicit", self.explicit)
        self.assertEqual(status, 1)
        self.assertIn("give both", error)


if __name__ == "__main__":
    unittest.main()
