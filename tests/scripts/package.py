#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The package quoin: what it reads of runs whose answers are known, and its
studies, by a program that stands for quoin."""
import contextlib
import csv
import fcntl
import importlib.util
import io
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

import numpy as np

from synthetic_runs import NOTHING, ROOT, WIDE, Scratch, joint_grid, write_run
import quoin
from quoin import frames, mesh_convergence, running, studies
from quoin.commands import mesh_convergence as mesh_command

# Stands for quoin: writes the product of the overrides a and b, plus the element
# size of a refined mesh, and how often it was called; refuses a = 3, fails at a = 4,
# is killed at a = 5 and 6 and goes on from its checkpoint at 5, which 6 does not
# know; 7 lasts long.
QUOIN = """#!/usr/bin/python3
import fcntl, os, signal, sys, time
words = sys.argv
folder = words[words.index("--output") + 1]
values = dict(text.split("=") for k, text in enumerate(words)
              if words[k - 1] == "--set")
a, b = float(values["S/a"]), float(values.get("b", 1))
size = (2.0 ** -int(values["Mesh/Refinements"])
        if "Mesh/Refinements" in values else 0)
with open("%s", "a") as file:
    file.write(f"{a:g}\\n")
if a == 3:
    sys.exit(print("Error: section 'S': a is 3", file=sys.stderr) or 1)
os.makedirs(folder + "/checkpoint", exist_ok=True)
lock = open(folder + "/lock", "w")
fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
with open(folder + "/log.txt", "w") as file:
    file.write("Warning: soft\\n" * 2 + "fine\\nWarning: coarse\\n")
if a == 4:
    sys.exit(print("Error: it fell over", file=sys.stderr) or 2)
if a == 6 and "--resume" in words:
    sys.exit(print("Error: another version", file=sys.stderr) or 1)
latest = folder + "/checkpoint/latest"
if a == 5 and "--resume" not in words or a == 6 and not os.path.exists(latest):
    open(latest, "w").close()
    os.kill(os.getpid(), 9)
if a == 7:
    def end(number, frame):
        open(latest, "a").write(str(number))
        sys.exit(128 + number)
    signal.signal(signal.SIGTERM, end)
    open(folder + "/begun", "w").close()
    time.sleep(60)
with open(os.path.join(folder, "histories.csv"), "w") as file:
    file.write(f"time [s],p [N]\\n0,0\\n1,{a * b + size}\\n")
with open(os.path.join(folder, "summary.json"), "w") as file:
    file.write("{}")
"""


class Results(Scratch):
    def setUp(self):
        super().setUp()
        self.folder = os.path.join(self.folder, "run")
        write_run(self.folder, [0., 1e-3, 2e-3], [0., -5., -4.],
                  {0: joint_grid(NOTHING, NOTHING),
                   2: joint_grid(WIDE, NOTHING)}, ends={"settle": 0.})
        self.results = quoin.read(self.folder)

    def test_tables(self):
        histories = self.results.histories
        self.assertEqual(list(histories.columns), ["time", "u", "f"])
        self.assertEqual(histories["f"].min(), -5.)
        self.assertEqual(len(histories), 3)
        self.assertEqual(self.results.units(), {"time": "s", "u": "m",
                                                "f": "N"})
        with open(os.path.join(self.folder, "energies.csv"), "w") as file:
            file.write("time [s],a [m],a [m/s]\n0,1,2\n")
        self.assertEqual(list(self.results.energies.columns),
                         ["time", "a [m]", "a [m/s]"])

    def test_without_pandas(self):
        known, frames.pandas = frames.pandas, None
        try:
            histories = self.results.histories
        finally:
            frames.pandas = known
        self.assertEqual(histories.columns, ["time", "u", "f"])
        self.assertEqual(len(histories), 3)
        with self.assertRaisesRegex(KeyError, "'g'; there are time, u, f"):
            histories["g"]
        np.testing.assert_array_equal(histories["u"], [0., 1e-3, 2e-3])
        self.assertEqual(repr(histories).splitlines()[1].split(),
                         ["0", "0", "0"])

    def test_summary_and_parameters(self):
        self.assertEqual(self.results.summary["steps"], 3)
        self.assertEqual(
            self.results.parameters["Joints"]["mortar"]["Law"], "Coulomb")

    def test_fields(self):
        self.assertEqual(self.results.series(), ["blocks", "joints"])
        np.testing.assert_array_equal(self.results.times(), [0., 2.])
        self.assertEqual(self.results.field("displacement").shape, (4, 3))
        np.testing.assert_array_equal(
            self.results.field("opening", 0.3, "joints"), np.zeros(4))
        with self.assertRaisesRegex(ValueError, "no field 'stress'; there are "
                                    "block, displacement, material"):
            self.results.field("stress")
        with self.assertRaisesRegex(ValueError, "near 9 s: they are from 0 "):
            self.results.field("displacement", 9.)
        with self.assertRaisesRegex(ValueError, "'push' is neither a time"):
            self.results.fields(time="push")
        with self.assertRaisesRegex(ValueError, "fields of blocks, joints"):
            self.results.times("contacts")
        with self.assertRaisesRegex(ValueError, "no such folder"):
            quoin.read(self.folder + "s")

    def test_joints(self):
        joints = self.results.joints()
        self.assertEqual(list(joints["state"]), ["intact", "intact"])
        self.assertEqual(list(joints["set"]), ["mortar", "mortar"])
        np.testing.assert_allclose(joints["length"], [1., 2.])
        # the mean of both ends
        np.testing.assert_allclose(joints["opening"], [1e-4, 1.5e-4])
        np.testing.assert_allclose(joints["x"], [0.5 + 1e-5, 2. + 1.5e-5])
        for time in (0., "settle"):
            self.assertEqual(list(self.results.joints(time)["opening"]),
                             [0., 0.])


class Runs(Scratch):
    def setUp(self):
        super().setUp()
        self.calls = os.path.join(self.folder, "calls")
        self.case = os.path.join(self.folder, "case.prm")
        with open(self.case, "w") as file:
            file.write("set Output directory = here\n")
        self.quoin = os.path.join(self.folder, "quoin")
        with open(self.quoin, "w") as file:
            file.write(QUOIN % self.calls)
        os.chmod(self.quoin, 0o755)

    def called(self):
        """The values of a of all runs that were made since the last call."""
        if not os.path.exists(self.calls):
            return []
        with open(self.calls) as file:
            values = sorted(int(line) for line in file)
        os.remove(self.calls)
        return values

    def test_run(self):
        results = quoin.run(self.case, {"S/a": 2, "b": 4.5}, quoin=self.quoin)
        self.assertEqual(results.output, os.path.join(self.folder, "here"))
        self.assertEqual(results.histories["p"].max(), 9.)
        with self.assertRaisesRegex(quoin.RunFailed, "a is 3") as caught:
            quoin.run(self.case, {"S/a": 3}, quoin=self.quoin)
        self.assertEqual(caught.exception.status, 1)

    def test_entries(self):
        self.assertEqual(running.entry("A/b", True), "A/b=yes")
        self.assertEqual(running.entry("A/b", [0.1, 2]), "A/b=0.1, 2")
        self.assertEqual(running.entry("A/b", "none"), "A/b=none")

    def test_program(self):
        self.assertEqual(running.executable(self.quoin), self.quoin)
        os.environ["QUOIN"] = "some/quoin"
        self.addCleanup(os.environ.pop, "QUOIN")
        self.assertEqual(running.executable(), os.path.abspath("some/quoin"))

    def study(self, a, b=(1, 2), progress=None, **others):
        return quoin.study(
            self.case, {"S/a": a, "b": b}, os.path.join(self.folder, "study"),
            lambda results: {"peak": results.histories["p"].max()},
            quoin=self.quoin, progress=progress, **others)

    def test_study(self):
        table = self.study([1, 2], processes=2)
        self.assertEqual(self.called(), [1, 1, 2, 2])
        self.assertEqual(list(zip(table["S/a"], table["b"], table["peak"])),
                         [(1, 1, 1.), (1, 2, 2.), (2, 1, 2.), (2, 2, 4.)])
        self.assertEqual(set(table["status"]), {"finished"})
        with open(os.path.join(self.folder, "study", "study.csv")) as file:
            self.assertEqual(len(file.readlines()), 5)

    def test_finished_runs_are_not_made_again(self):
        self.study([1, 2])
        self.called()
        table = self.study([1, 2, 8])
        self.assertEqual(self.called(), [8, 8])
        self.assertEqual(len(table), 6)
        with open(self.case, "a") as file:
            file.write("set Thickness = 2\n")
        self.study([1])
        self.assertEqual(self.called(), [1, 1])

    def test_failures_are_kept(self):
        says = io.StringIO()
        table = self.study([3, 1, 4], (1,), says)
        self.assertEqual(self.called(), [1, 3, 4])
        self.assertEqual(list(table["status"]),
                         ["failed", "finished", "failed"])
        self.assertIn("a is 3", table["message"][0])
        self.assertIn("it fell over", table["message"][2])
        np.testing.assert_array_equal(table["peak"], [np.nan, 1., np.nan])
        self.assertIn("3/3", says.getvalue())
        self.assertIn("S/a=4", says.getvalue())
        self.study([3, 1, 4], (1,))
        self.assertEqual(self.called(), [])
        self.study([3, 1, 4], (1,), again=True)
        self.assertEqual(self.called(), [3, 4])

    def test_an_interrupted_run_goes_on_from_its_checkpoint(self):
        """Or from its beginning, where the checkpoint is of no use."""
        for a, calls in ((5, [5]), (6, [6, 6])):
            with self.assertRaises(quoin.RunFailed):
                self.study([1, a], (1,))
            self.assertIn(a, self.called())
            table = self.study([1, a], (1,))
            self.assertEqual(self.called(), calls)
            self.assertEqual(set(table["status"]), {"finished"})

    def test_warnings(self):
        table = self.study([2, 3, 4], (1,))
        np.testing.assert_array_equal(table["warnings"], [2, 0, 2])
        self.assertEqual(quoin.read(table["folder"][0]).warnings,
                         ["soft", "coarse"])

    def csv(self):
        with open(os.path.join(self.folder, "study", "study.csv")) as file:
            return [row["status"] for row in csv.DictReader(file)]

    def test_the_table_is_written_after_each_run(self):
        seen = []
        says = mock.Mock(write=lambda text: seen.append(self.csv())
                         if "finished in" in text else None)
        self.study([1, 2], (1,), says)
        # said just before its row is written
        self.assertEqual(seen, [["to come", "to come"],
                                ["finished", "to come"]])
        self.assertEqual(self.csv(), ["finished", "finished"])

    def test_a_changed_mesh(self):
        """And what that includes; the same again after it was changed back."""
        names = [os.path.join(self.folder, name)
                 for name in ("hill.geo", "sizes.geo", "blow.txt")]

        def write(path, text):
            with open(path, "w") as file:
                file.write(text)

        write(names[0], 'Include "sizes.geo";\nPoint(1) = {0, 0, 0};\n')
        for path in names[1:]:
            write(path, "size = 1;\n")
        with open(self.case, "a") as file:
            file.write("set File = hill.geo\nset Value = table blow.txt; 2\n")
        self.study([1], (1,))
        self.called()
        for path in names:
            with open(path) as file:
                before = file.read()
            write(path, before + "// finer\n")
            self.study([1], (1,))
            self.assertEqual(self.called(), [1], path)
            write(path, before)
            self.study([1], (1,))
            self.assertEqual(self.called(), [], path)

    def test_a_run_that_another_process_makes(self):
        folder = self.study([1], (1,))["folder"][0]
        self.called()
        os.remove(os.path.join(folder, "run.json"))
        with open(os.path.join(folder, "lock"), "w") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            table = self.study([1, 2], (1,))
            self.assertEqual(list(table["status"]), ["under way", "finished"])
            self.assertEqual(self.called(), [2])
        self.study([1, 2], (1,))
        self.assertEqual(self.called(), [1])

    def test_no_run_outlives_its_study(self):
        """Ended by Ctrl-C, or killed. What the run writes then is what a
        checkpoint is, and it gets one signal alone."""
        for number in (signal.SIGINT, signal.SIGKILL):
            output = os.path.join(self.folder, f"study_{number}")
            python = subprocess.Popen(
                [sys.executable, "-c", "import quoin, sys; quoin.study("
                 f"{self.case!r}, {{'S/a': [7, 1]}}, {output!r}, "
                 f"quoin={self.quoin!r})"], stderr=subprocess.PIPE,
                env=dict(os.environ, PYTHONPATH=os.path.join(ROOT, "python")))
            folder = os.path.join(output, studies.fingerprint(
                self.case, {"S/a": 7}))

            def wait_for(what):
                for _ in range(300):
                    if what():
                        return
                    time.sleep(0.05)
                self.fail(f"still not after {number!r}")

            wait_for(lambda: os.path.exists(os.path.join(folder, "begun")))
            python.send_signal(number)
            python.communicate(timeout=20)
            wait_for(lambda: not running.is_under_way(folder))
            with open(os.path.join(folder, "checkpoint", "latest")) as file:
                self.assertEqual(file.read(), "15")
            self.assertFalse(os.path.exists(os.path.join(folder, "run.json")))
            self.assertEqual(self.called(), [7])

    def test_mesh_convergence(self):
        found = mesh_convergence.mesh_convergence(
            self.case, os.path.join(self.folder, "meshes"), 2, {"S/a": 2},
            quoin=self.quoin, progress=None)
        values, limit, order = found["p: largest"]
        self.assertEqual(values, [3., 2.5, 2.25])
        self.assertAlmostEqual(limit, 2., 12)
        self.assertAlmostEqual(order, 1., 12)
        with self.assertRaisesRegex(ValueError, "it fell over"):
            mesh_convergence.mesh_convergence(
                self.case, os.path.join(self.folder, "fallen"), 1, {"S/a": 4},
                quoin=self.quoin, progress=None)

    def test_mesh_convergence_as_a_script(self):
        output = os.path.join(self.folder, "meshes")
        words = [self.case, "--set", "S/a=2", "--output", output, "--quoin",
                 self.quoin]
        def said(*more):
            with mock.patch.object(sys, "argv", ["mesh_convergence"] + words
                                   + list(more)), \
                    contextlib.redirect_stdout(io.StringIO()) as says, \
                    contextlib.redirect_stderr(io.StringIO()):
                mesh_command.main()
            return says.getvalue()
        self.assertRegex(said(), r"p: largest +3 +2.5 +2 +25 +1.00\n")
        with open(os.path.join(output, "mesh_convergence.csv")) as file:
            self.assertIn("p: last,3,2.5,2,25,1.00\n", file.read())
        with self.assertRaisesRegex(SystemExit, "has 'q' in its name"):
            said("--only", "q")
        with self.assertRaisesRegex(SystemExit, "not 'S'"):
            said("--set", "S")

    def test_limits_of_meshes(self):
        limit, order = mesh_convergence.limit([1 + 3 * 4.**-k
                                               for k in range(3)])
        self.assertAlmostEqual(limit, 1., 12)
        self.assertAlmostEqual(order, 2., 12)
        self.assertEqual(mesh_convergence.limit([5., 4.], order=2)[0],
                         4 - 1 / 3)
        self.assertEqual(mesh_convergence.limit([5., 5.])[0], 5.)
        for values in ([1., 2., 1.5], [1., 2., 3.], [1., 2., 2.]):
            limit, order = mesh_convergence.limit(values)
            self.assertEqual(limit == limit, values[1] == values[2])

    def test_grids(self):
        self.assertEqual(
            studies.combinations({("a", "b"): [(1, 2), (3, 4)], "c": [5]}),
            [{"a": 1, "b": 2, "c": 5}, {"a": 3, "b": 4, "c": 5}])
        for grid in ({"a": []}, {("a", "b"): [(1, 2, 3)]}, {"a": 1},
                     {"a": "12"}, {("a", "b"): [1]}):
            with self.assertRaisesRegex(ValueError, "one or more values"):
                studies.combinations(grid)


class Package(unittest.TestCase):
    def test_reading_needs_no_matplotlib(self):
        """ParaView's Python has none."""
        subprocess.run(
            [sys.executable, "-c", "import sys; sys.modules['matplotlib'] = "
             "None; import quoin, quoin.commands.paraview_view"], check=True,
            env=dict(os.environ, PYTHONPATH=os.path.join(ROOT, "python")))

    @unittest.skipUnless(importlib.util.find_spec("pip")
                         and importlib.util.find_spec("setuptools"),
                         "pip and setuptools are not needed otherwise")
    def test_installation(self):
        with tempfile.TemporaryDirectory() as folder:
            # pip builds in the folder of the sources
            shutil.copytree(os.path.join(ROOT, "python"), folder + "/python",
                            ignore=shutil.ignore_patterns("__pycache__"))
            subprocess.run(
                [sys.executable, "-m", "pip", "install", "--quiet",
                 "--no-build-isolation", "--no-deps", "--no-index",
                 "--target", folder + "/there", folder + "/python"],
                check=True, stderr=subprocess.PIPE)
            said = subprocess.run(
                [folder + "/there/bin/quoin-plot", "--help"], check=True,
                stdout=subprocess.PIPE, text=True,
                env=dict(os.environ, PYTHONPATH=folder + "/there")).stdout
            self.assertIn("usage: quoin-plot", said)

    def test_version(self):
        """The version is that of the program."""
        with open(os.path.join(ROOT, "CMakeLists.txt")) as file:
            version = file.read().split("project(quoin VERSION ")[1].split()[0]
        with open(os.path.join(ROOT, "python", "pyproject.toml")) as file:
            self.assertIn(f'\nversion = "{version}"\n', file.read())


if __name__ == "__main__":
    unittest.main()
