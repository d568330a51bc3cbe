#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What the case tests and their table make of runs that crash or end early."""
import contextlib
import io
import json
import os
import subprocess
import sys
import types
import unittest

import numpy as np

from synthetic_runs import ROOT, SCRIPTS, Scratch

CASES = os.path.join(ROOT, "tests", "cases")
sys.path.insert(0, CASES)
import bracket  # noqa: E402
import compare  # noqa: E402
from common import Failure, write_result  # noqa: E402

# Stands for quoin: writes these files into the folder of --output and ends.
QUOIN = """#!/usr/bin/python3
import os, sys
folder = sys.argv[sys.argv.index("--output") + 1]
os.makedirs(folder, exist_ok=True)
for name, text in %r.items():
    with open(os.path.join(folder, name), "w") as file:
        file.write(text)
%s
"""
ENDS = {"finished": "sys.exit(0)", "wrong input": "sys.exit(1)",
        "failed": "sys.exit(2)", "aborted": "os.abort()",
        "segmentation fault": "os.kill(os.getpid(), 11)"}
# The tests that leave results, and what these are called.
TESTS = {("compare.py", "column"): ["column"],
         ("bracket.py", "arch_seismic"): ["arch_seismic"],
         ("convergence.py",): ["convergence_h", "convergence_dt"],
         ("extremes.py",): ["extremes"], ("hybrid.py",): ["hybrid_hole"],
         ("hybrid_long_run.py",): ["hybrid_long_run"],
         ("field_formats.py",): ["field_formats"],
         ("interrupt.py",): ["interrupt"],
         ("ranks.py",): ["ranks"], ("reflection.py",): ["boundary_reflection"],
         ("resume.py",): ["resume"],
         ("resume_ranks.py",): ["resume_ranks"],
         ("wall_stability.py",): ["tue_wall_stability"]}


def table(header, *rows):
    return "\n".join([header] + [",".join("%g" % value for value in row)
                                 for row in rows]) + "\n"


class Broken(Scratch):
    def setUp(self):
        super().setUp()
        self.results = os.path.join(self.folder, "results")
        os.mkdir(self.results)

    def quoin(self, end, log="", summary={}, **files):
        """A program that writes <name>.csv, a log and a summary and ends as ENDS
        says."""
        path = os.path.join(self.folder, "quoin")
        texts = {name + ".csv": text for name, text in files.items()}
        with open(path, "w") as file:
            file.write(QUOIN % (dict(texts, **{
                "log.txt": log, "summary.json": json.dumps(summary)}),
                ENDS[end]))
        os.chmod(path, 0o755)
        return path

    def options(self, end, **files):
        return types.SimpleNamespace(quoin=self.quoin(end, **files), keep=None,
                                     results=self.results)

    def result(self, name):
        with open(os.path.join(self.results, name + ".json")) as file:
            return json.load(file)


class Results(Broken):
    def test_a_crash_leaves_no_row_that_passed(self):
        quoin = self.quoin("aborted")
        written = {words[0] for words in TESTS}
        for name in sorted(os.listdir(CASES)):
            if not name.endswith(".py"):
                continue
            with open(os.path.join(CASES, name)) as file:
                self.assertEqual("write_result(" in file.read(),
                                 name in written or name == "common.py", name)
        for words, names in TESTS.items():
            for name in names:
                write_result(self.results, name, title="of an earlier run",
                             reference="", error=0.1, tolerance=0.2,
                             seconds=1., passed=True)
            done = subprocess.run(
                [sys.executable, os.path.join(CASES, words[0]), "--quoin",
                 quoin, "--results", self.results, *words[1:]],
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                timeout=120)
            self.assertEqual(done.returncode, 1, done.stdout)
            for name in names:
                self.assertEqual(self.result(name),
                                 {"case": name, "passed": False})
        write_result(self.results, "fill", title="the fill", reference="Hooke",
                     error=0.1, tolerance=0.2, seconds=1., passed=True)
        write_result(self.results, "wedge", title="the wedge", reference="",
                     error=0.3, tolerance=0.2, seconds=1., passed=False)
        # of a case that was taken out since
        write_result(self.results, "gone", passed=False)
        text = subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "table"), "--results",
             self.results, "--output", "-"], stdout=subprocess.PIPE, text=True,
            check=True).stdout
        self.assertNotIn("earlier", text)
        self.assertNotIn("gone", text)
        self.assertIn("| column | | | **no result** | | |", text)
        self.assertIn("| fill | the fill | Hooke | 1.0e-01 | 2.0e-01 | 1.0 |",
                      text)
        self.assertIn("Outside their tolerance: wedge.", text)
        self.assertIn("Ended without a result: arch_seismic, bound", text)
        self.assertIn("column, convergence_dt", text)


class Limits(Broken):
    """A motion of 2 m counts as a collapse."""

    case = {"name": "limit", "columns": ["x"], "bound": 1., "set": []}

    def stands(self, end, moved, log="", residual=0., **case):
        files = {"histories": table("time [s],x [m]", (0, 0), (1, moved)),
                 "energies": table(
                     "time,kinetic,strain,joint,friction,fracture,crushing,"
                     "plastic,damping,viscous,contact,external,residual",
                     [0] * 13, [1] * 12 + [residual])}
        with contextlib.redirect_stdout(io.StringIO()):
            return bracket.run(dict(self.case, **case), self.folder,
                               self.options(end, log=log, **files), 0.3)[0]

    def test_a_run_that_failed_may_have_collapsed(self):
        self.assertTrue(self.stands("finished", 0.5))
        self.assertFalse(self.stands("finished", 2.))
        self.assertFalse(self.stands("failed", 2.))
        with self.assertRaisesRegex(Failure, "exit status 2"):
            self.stands("failed", 0.5)

    def test_a_crash_is_no_collapse(self):
        for end, status in (("wrong input", 1), ("aborted", -6),
                            ("segmentation fault", -11)):
            with self.assertRaisesRegex(Failure, "exit status %d" % status):
                self.stands(end, 2.)

    def test_what_stands_warns_of_nothing(self):
        log = "Warning: the load jumps\n"
        self.assertTrue(self.stands("finished", 0.5, log, warnings=["jumps"]))
        with self.assertRaisesRegex(Failure, "warns: Warning: the load"):
            self.stands("finished", 0.5, log)
        self.assertFalse(self.stands("finished", 2., log))

    def test_what_stands_keeps_its_energy(self):
        self.assertTrue(self.stands("finished", 0.5, residual=9e-5))
        self.assertTrue(self.stands("finished", 0.5, residual=2e-4,
                                    tolerances={"energy residual": 1e-3}))
        with self.assertRaisesRegex(Failure, "energy residual 2.000e-04"):
            self.stands("finished", 0.5, residual=2e-4)
        self.assertFalse(self.stands("finished", 2., residual=2e-4))


class Columns(Broken):
    def compare(self, end, log="", residual=0., **case):
        """A run that ends at the time @p end, the reference at 1 s, with an
        energy residual by the throughput."""
        times = np.linspace(0., end, 21)
        histories = table("time [s],u [m]", *zip(times, times))
        with open(os.path.join(self.folder, "reference.csv"), "w") as file:
            file.write(table("time [s],u [m]", (0, 0), (0.5, 0.52), (1, 1)))
        case = dict({"name": "case", "folder": self.folder, "title": "",
                     "source": "", "reference": "reference.csv",
                     "tolerance": 0.1}, **case)
        with contextlib.redirect_stdout(io.StringIO()):
            compare.run_case(case, self.options(
                "finished", log=log, histories=histories,
                summary={"largest energy residual [J]": 5. * residual,
                         "energy throughput [J]": 5.}))
        return self.result("case")

    def test_runs_that_end_early(self):
        self.assertTrue(self.compare(0.995)["passed"])
        for end in (0.98, 0.8):
            with self.assertRaisesRegex(Failure, "ended at %g s" % end):
                self.compare(end)

    def test_warnings(self):
        log = "a run\nWarning: the load jumps\nfinished\n"
        self.assertTrue(self.compare(1., log, warnings=["jumps"])["passed"])
        with self.assertRaisesRegex(Failure, "warns: Warning: the load"):
            self.compare(1., log)
        with self.assertRaisesRegex(Failure, "does not warn: jumps"):
            self.compare(1., "a run\n", warnings=["jumps"])

    def test_energy_residual(self):
        self.assertTrue(self.compare(1., residual=9e-5)["passed"])
        self.assertTrue(self.compare(
            1., residual=2e-4, tolerances={"energy residual": 1e-3})["passed"])
        with self.assertRaisesRegex(Failure, "energy residual 2.0e-04"):
            self.compare(1., residual=2e-4)

    def test_tolerances(self):
        self.assertTrue(self.compare(1., tolerance=0.021)["passed"])
        with self.assertRaisesRegex(Failure, "u 2.000e-02 > 1.0e-02"):
            self.compare(1., tolerances={"u": 0.01})
        self.assertEqual(self.result("case")["passed"], False)
        with self.assertRaisesRegex(Failure, "not compared: energy$"):
            self.compare(1., tolerances={"energy": 0.01})


if __name__ == "__main__":
    unittest.main()
