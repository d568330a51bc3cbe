#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The check compare_solvers of the case tests, and the table that scripts/table
makes of its numbers, on runs whose answers are known."""
import contextlib
import io
import json
import os
import shutil
import subprocess
import sys
import unittest

from synthetic_runs import ROOT, SCRIPTS, SPEC, Folders, write_run

sys.path.insert(0, os.path.join(ROOT, "tests", "cases"))
import wall_checks  # noqa: E402
from common import Failure, write_result  # noqa: E402


class Check(Folders):
    def setUp(self):
        super().setUp()
        self.case = {"prm": "case.prm", "peak": 45e3}
        for name, text in (("case.prm", ""), ("plot.json", json.dumps(SPEC))):
            with open(os.path.join(self.folder, name), "w") as file:
                file.write(text)

    def check(self, status=2):
        self.case["quoin"] = self.quoin(status)
        with contextlib.redirect_stdout(io.StringIO()):
            return wall_checks.compare_solvers(
                self.case, self.folder, self.explicit, None)

    def test_errors(self):
        found = self.check()
        wanted = {"implicit peak of the tests": 0.2,
                  "peak, implicit by explicit": 0.1,
                  "curves up to the peak": 0.1, "open in one run only": 0.,
                  "explicit curve, missing": 0.25}
        self.assertEqual(set(found), set(wanted))
        for name, error in wanted.items():
            self.assertAlmostEqual(found[name], error, msg=name)

    def test_numbers_for_the_table(self):
        self.check()
        solvers = self.case["solvers"]
        self.assertEqual(solvers["tests [kN]"], 45.)
        self.assertEqual(solvers["explicit"], {
            "peak [kN]": 40., "at [mm]": 2., "wall time [s]": 50.})
        self.assertEqual(solvers["implicit"], {
            "peak [kN]": 36., "at [mm]": 2., "wall time [s]": 10.})
        self.assertAlmostEqual(solvers["curve difference"], 0.1)
        self.assertEqual(solvers["open in both"], 1.)

    def test_failures(self):
        with self.assertRaisesRegex(Failure, "exit status 1"):
            self.check(status=1)
        shutil.rmtree(self.implicit)
        shutil.rmtree(os.path.join(self.explicit, "implicit"))
        write_run(self.implicit, [0., 1e-3], [0., -2e4], {})
        with self.assertRaisesRegex(Failure, "joints cannot be compared"):
            self.check()

    def test_units(self):
        spec = dict(SPEC, y={"label": "force [N]"})
        with open(os.path.join(self.folder, "plot.json"), "w") as file:
            json.dump(spec, file)
        with self.assertRaisesRegex(Failure, r"no 'peak \[kN\]'"):
            self.check()

    def table(self, **values):
        results = os.path.join(self.folder, "results")
        os.makedirs(results, exist_ok=True)
        write_result(results, "tue_wall_j4d_solvers", title="wall W: by both solvers",
                     reference="tests", error=0.1, tolerance=0.2, seconds=1.,
                     passed=True, **values)
        return subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "table"), "--results",
             results, "--output", "-"], stdout=subprocess.PIPE, text=True,
            check=True).stdout

    def test_table(self):
        self.check()
        self.assertNotIn("## Walls", self.table())
        text = self.table(solvers=self.case["solvers"])
        self.assertIn("## Walls: explicit, implicit, experiment", text)
        self.assertIn("| wall W | 45.0 | 40.0 | 2.00 | 36.0 | 2.00 | 10.0 % "
                      "| 100 % | 50 | 10 |", text)
        solvers = dict(self.case["solvers"], **{"open in both": None})
        self.assertIn("| 10.0 % | - | 50", self.table(solvers=solvers))


if __name__ == "__main__":
    unittest.main()
