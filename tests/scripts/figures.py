#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The figures of scripts/: what they read off a run, on data whose answers are
known, and whether every script draws a picture of a real run or says in a
sentence why not."""
import csv
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__))))
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, os.path.join(ROOT, "python"))

from quoin.commands import beam_figure  # noqa: E402
from quoin.figures import curve_figure  # noqa: E402
from quoin import colours  # noqa: E402
from quoin import damage_table  # noqa: E402
from quoin.figures import joint_figure  # noqa: E402
from quoin import moments  # noqa: E402
from quoin import results as quoin_results  # noqa: E402
from quoin import run_parameters  # noqa: E402
from quoin.figures import stress_figure  # noqa: E402
import synthetic_runs  # noqa: E402
from quoin import vtu  # noqa: E402
from quoin.vtu import Grid  # noqa: E402

SMALL_WALL = os.path.join(ROOT, "parameter_files", "tutorials", "small_wall")
COMPOSITE = ("Law=composite", "Shear fracture energy=125",
             "Tensile fracture energy=18", "Compressive strength=10.5e6",
             "Compressive fracture energy=5000", "Peak crushing=0.09e-3")
quoin = None


class Says(unittest.TestCase):
    def says(self, words, function, *arguments):
        """The function stops with a sentence that has these words."""
        with self.assertRaises(ValueError) as caught:
            function(*arguments)
        for word in words:
            self.assertIn(word, str(caught.exception))


class Moments(Says):
    time = np.array([0., 1., 2., 3., 4.])
    value = np.array([0., 2., 1., 4., 3.])

    def when(self, wanted, value=None):
        return moments.time_when(
            self.time, self.value if value is None else value, wanted, "u")

    def test_first_time_between_rows(self):
        self.assertAlmostEqual(self.when(0.5), 0.25)
        self.assertAlmostEqual(self.when(1.5), 0.75)     # and not 1.5, 2.2
        self.assertAlmostEqual(self.when(2.5), 2.5)
        self.assertEqual(self.when(0.), 0.)

    def test_downwards(self):
        self.assertAlmostEqual(self.when(-1.5, -self.value), 0.75)
        self.assertAlmostEqual(self.when(-3., -self.value), 2. + 2. / 3.)

    def test_peak_and_end(self):
        self.assertEqual(self.when("peak"), 3.)
        self.assertEqual(self.when("peak", -self.value), 3.)
        self.assertEqual(self.when("end"), 4.)

    def test_of_a_block_that_is_deleted(self):
        gone = np.where(self.time < 2.5, self.value, np.nan)
        self.assertEqual(self.when("peak", gone), 1.)
        self.assertEqual(self.when("end", gone), 2.)
        self.assertAlmostEqual(self.when(1.5, gone), 0.75)
        self.says(["never reaches 3", "from 0 to 2"], self.when, 3., gone)

    def test_a_step_short_of_the_value(self):
        self.assertEqual(self.when(4.001), 3.)
        self.says(["never reaches 4.1", "from 0 to 4"], self.when, 4.1)
        self.says(["never reaches -1"], self.when, -1.)

    def test_text(self):
        self.assertEqual(moments.read_at("u = 1e-3, peak,end"),
                         ("u", [1e-3, "peak", "end"]))
        for text in ("u", "u=", "=1", "u=1,two"):
            self.says(["COLUMN=VALUE", text], moments.read_at, text)

    def test_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "histories.csv"), "w") as file:
                file.write("time [s],push [m]\n")
                file.writelines(f"{0.01 * k},{2e-5 * k}\n"
                                for k in range(101))
            with open(os.path.join(folder, "blocks.pvd"), "w") as file:
                file.write("<VTKFile><Collection>" + "".join(
                    f'<DataSet timestep="{0.1 * k}" file="{k}.vtu"/>'
                    for k in range(11)) + "</Collection></VTKFile>")
            found = moments.moments_at(folder, "push=0.63e-3,1.2e-3,end")
            self.assertEqual([round(m.time, 9) for m in found],
                             [0.3, 0.6, 1.0])
            # the value at the field, not the one that was asked for
            self.assertEqual([m.label for m in found],
                             ["push 0.600 mm", "push 1.20 mm",
                              "push 2.00 mm (end)"])
            self.says(["same nearest field", "Field interval"],
                      moments.moments_at, folder, "push=0.6e-3,0.61e-3")
            self.says(["no column 'pull'", "push [m]"],
                      moments.moments_at, folder, "pull=1")


class Curves(Says):
    def test_envelope(self):
        x, low, high = curve_figure.envelope(
            [("a", np.array([0., 2., 4.]), np.array([0., 2., 0.])),
             ("b", np.array([1., 3.]), np.array([2., 0.]))])
        np.testing.assert_allclose(x, [1., 2., 3.])
        np.testing.assert_allclose(low, [1., 1., 0.])
        np.testing.assert_allclose(high, [2., 2., 1.])

    def test_envelope_errors(self):
        rise = ("rise.csv", np.array([0., 1.]), np.array([0., 1.]))
        self.says(["cycle.csv", "grows"], curve_figure.envelope,
                  [rise, ("cycle.csv", np.array([0., 1., 0.5]), np.zeros(3))])
        self.says(["no x in common", "far.csv from 2 to 3"],
                  curve_figure.envelope,
                  [rise, ("far.csv", np.array([2., 3.]), np.zeros(2))])

    def test_peak(self):
        x, y = np.array([0., 1., 2., 3.]), np.array([0., -3., 2., -5.])
        self.assertEqual(curve_figure.peak_of(x, y, None), (3, True))
        self.assertEqual(curve_figure.peak_of(x, y, [0., 2.5]), (1, False))
        self.assertIsNone(curve_figure.peak_of(x, y, [8., 9.]))

    def test_descriptions(self):
        curves = [{"column": "f"}]
        wrong = [
            ({"curves": []}, ["no \"curves\""]),
            ({"curves": [{"label": "f"}]}, ["curves need 'column'"]),
            ({"curves": curves, "bend": []}, ["no key 'bend'", "bands"]),
            ({"curves": curves, "peak": "yes"}, ["'peak'", "true or false"]),
            ({"curves": curves, "x": {"limits": [1]}},
             ["x: 'limits'", "two numbers"]),
            ({"curves": curves, "y": {"factor": "1e-3"}}, ["a number"]),
            ({"curves": curves, "runs": ["a"]}, ["'runs'", "list of objects"]),
            ({"curves": curves, "runs": [{}]}, ["runs need 'folder'"]),
            ({"curves": curves, "bands": [{}]}, ["'from' and 'to'"]),
            ({"curves": curves, "bands": [{"from": 1.}]}, ["both"]),
            ({"curves": curves, "bands": [{"from": 2, "to": 1}]},
             ["from 2 to 1"]),
            ({"curves": curves, "bands": [{"from": 1, "curves": []}]},
             ["either"]),
            ({"curves": curves, "bands": [{"curves": [{"file": "a"}]}]},
             ["two or more"]),
            ({"curves": curves, "bands": [{"curves": [{}, {}]}]},
             ["need 'file'"]),
        ]
        for spec, words in wrong:
            self.says(words, curve_figure.check_figure, spec)


def square(stress):
    """A unit square of two triangles under a uniform stress [Pa]."""
    return Grid(0., np.array([[0., 0.], [1., 0.], [1., 1.], [0., 1.]]),
                np.array([[0, 1, 2], [0, 2, 3]]), {},
                {"stress": np.tile(np.append(stress, 0.), (2, 1))})


class Stresses(unittest.TestCase):
    def test_points_are_a_regular_grid(self):
        cell, weight = stress_figure.grid_points(square([0., 0., 0.]), 0.25)
        grid = square([0., 0., 0.])
        place = np.einsum("ck,ckd->cd", weight, grid.points[grid.cells[cell]])
        wanted = [(x, y) for x in (.125, .375, .625, .875)
                  for y in (.125, .375, .625, .875)]
        np.testing.assert_allclose(sorted(map(tuple, np.round(place, 12))),
                                   wanted)

    def test_principal_stresses(self):
        nodal = stress_figure.nodal_stress(square([-3e6, 1e6, 2e6]))
        np.testing.assert_allclose(nodal, np.tile([-3e6, 1e6, 2e6], (4, 1)))
        s1, s2, angle = stress_figure.principal(nodal[:1])
        root = np.sqrt(8.) * 1e6
        np.testing.assert_allclose([s1[0], s2[0]], [-1e6 + root, -1e6 - root])
        # what the direction of s1 must give back: n.S.n = s1
        n = np.array([np.cos(angle[0]), np.sin(angle[0])])
        S = np.array([[-3e6, 2e6], [2e6, 1e6]])
        self.assertAlmostEqual(n @ S @ n / s1[0], 1.)

    def test_scale_of_crosses(self):
        class Frame:
            blocks = square([-4.4e6, 0., 0.])
        crosses = stress_figure.Crosses([Frame], 1., 4)
        self.assertEqual(crosses.reference, 5e6)
        self.assertFalse(crosses.is_cut)
        self.assertEqual(stress_figure.Contours.values(Frame.blocks).min(),
                         -4.4e6)


def joints():
    """Six faces of 1, 2, ... 6 m in sets 0 and 1: intact but strained, open,
    slipped, open and slipped more, crushed, closed in hardening."""
    each = {"opening": [0., 3e-3, -1e-4, 1e-3, -2e-3, -1e-4],
            "slip": [1e-3, 1e-3, -4e-3, 2e-3, 1e-3, 0.],
            "shear traction": [1e6, 0., -1e6, 0., 0., 0.],
            "point state": [0, 3, 1, 3, 2, 2],
            "damage": [0., 1., 0.6, 1., 0.2, 0.],
            "crushing": [0., 0., 0., 0., 1.5e-3, 0.05e-3]}
    return Grid(0., np.zeros((12, 2)), np.arange(12).reshape(6, 2),
                {name: np.repeat(v, 2) for name, v in each.items()},
                {"state": np.array(each["point state"]),
                 "joint set": np.array([0, 0, 0, 1, 0, 0]),
                 "length": np.arange(1., 7.)})


class Joints(unittest.TestCase):
    peak = [1e-4, np.inf]

    def test_modes_and_widths(self):
        mode, width = joint_figure.crack_modes(joints(), [1e9, 1e9], self.peak)
        np.testing.assert_allclose(
            width, [0., 3e-3, 3e-3, 2e-3, 1.5e-3, 0.], atol=1e-15)
        self.assertEqual(list(mode[1:5]),
                         [joint_figure.TENSION, joint_figure.SHEAR,
                          joint_figure.SHEAR, joint_figure.CRUSHING])

    def test_lengths(self):
        found = damage_table.lengths(joints(), self.peak)
        self.assertEqual(found, {"all": 21., "intact": 1., "slipping": 3.,
                                 "open": 6., "damaged": 9., "crushed": 5.})
        found = damage_table.lengths(joints(), self.peak, sets=[1])
        self.assertEqual((found["all"], found["open"], found["crushed"]),
                         (4., 4., 0.))

    def test_areas_in_space(self):
        """Two triangles, one of whose corners is open."""
        grid = Grid(0., np.zeros((6, 3)), np.arange(6).reshape(2, 3),
                    {"point state": np.array([0, 0, 3, 0, 0, 0])},
                    {"joint set": np.array([0, 0]),
                     "area": np.array([3., 6.])})
        self.assertEqual(damage_table.lengths(grid, [np.inf]),
                         {"all": 9., "intact": 8., "slipping": 0., "open": 1.})

    def test_half_a_face(self):
        grid = joints()
        grid.point_data["point state"][2] = 0
        self.assertEqual(damage_table.lengths(grid, self.peak)["open"], 5.)

    def test_line_widths_are_proportional(self):
        cracks = joint_figure.CrackJoints.__new__(joint_figure.CrackJoints)
        cracks.widest = 1e-3
        np.testing.assert_allclose(
            cracks.line_width([0., 0.5e-3, 1e-3, 9e-3]),
            [joint_figure.THINNEST_CRACK, joint_figure.WIDEST_CRACK / 2,
             joint_figure.WIDEST_CRACK, joint_figure.WIDEST_CRACK])


class Pictures(unittest.TestCase):
    """A run of the small wall with softening joints, which crack."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.output = os.path.join(cls.folder.name, "run")
        words = [quoin, os.path.join(SMALL_WALL, "case.prm"), "--quiet",
                 "--output", cls.output, "--set", "Output/Field interval=1e-3"]
        for entry in COMPOSITE:
            words += ["--set", "Joints/mortar/" + entry]
        subprocess.run(words, check=True, timeout=120)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def script(self, name, *words, **variables):
        done = subprocess.run([sys.executable, os.path.join(SCRIPTS, name),
                               self.output, *words], stdout=subprocess.PIPE,
                              env=dict(os.environ, **variables),
                              stderr=subprocess.PIPE, text=True, timeout=120)
        return done.returncode, done.stdout, done.stderr

    def draws(self, name, *words, ending=".png"):
        path = os.path.join(self.folder.name, name + ending)
        if os.path.exists(path):
            os.remove(path)
        status, printed, error = self.script(name, *words, "--out", path)
        self.assertEqual((status, error), (0, ""))
        self.assertIn(path, printed)
        self.assertGreater(os.path.getsize(path), 5000)
        return path

    def refuses(self, says, name, *words, **variables):
        status, _, error = self.script(name, *words, **variables)
        self.assertEqual(status, 1, error)
        self.assertNotIn("Traceback", error)
        self.assertEqual(len(error.strip().splitlines()), 1)
        self.assertIn(says, error)

    def colours(self, path):
        from matplotlib.image import imread
        pixels = np.round(255 * imread(path)[..., :3]).astype(int)
        return {tuple(p) for p in np.unique(pixels.reshape(-1, 3), axis=0)}

    def has(self, path, *colours):
        from matplotlib.colors import to_rgb
        found = self.colours(path)
        for colour in colours:
            self.assertIn(tuple(int(round(255 * c)) for c in to_rgb(colour)),
                          found)

    def test_plot(self):
        spec = os.path.join(SMALL_WALL, "plot.json")
        path = self.draws("plot", self.output, "--spec", spec, "--peak",
                          "--label", "one", "--label", "two",
                          "--band", "13", "15")
        self.has(path, "C1")
        self.draws("plot", "--spec", spec, ending=".pdf")
        self.refuses("No such file or directory", "plot", "--spec", spec,
                     "--out", os.path.join(self.folder.name, "no", "p.png"))
        self.refuses("give one each", "plot", "--spec", spec,
                     "--label", "a", "--label", "b")
        self.refuses("two numbers or two csv files", "plot", "--x",
                     "displacement", "--y", "force", "--band", "13", "no.csv")

    def test_plot_of_a_block_that_is_deleted(self):
        gone = os.path.join(self.folder.name, "gone")
        os.makedirs(gone, exist_ok=True)
        with open(os.path.join(self.output, "histories.csv")) as file:
            rows = [line.strip().split(",") for line in file]
        column = [name.split(" [")[0] for name in rows[0]].index("force")
        for row in rows[len(rows) // 2:]:
            row[column] = "nan"
        with open(os.path.join(gone, "histories.csv"), "w") as file:
            file.writelines(",".join(row) + "\n" for row in rows)
        self.draws("plot", gone, "--spec",
                   os.path.join(SMALL_WALL, "plot.json"), "--peak",
                   "--label", "stands", "--label", "falls")

    def test_band_of_curves(self):
        paths = [os.path.join(self.folder.name, name)
                 for name in ("a.csv", "b.csv")]
        for path, peak in zip(paths, (13, 15)):
            with open(path, "w") as file:
                file.write(f"0,0\n0.1,{peak}\n0.5,{peak - 3}\n")
        words = ("--x", "displacement", "--y", "force", "--x-factor", "1e3",
                 "--y-factor", "1e-3", "--band", *paths)
        self.draws("plot", *words)
        with open(paths[1], "a") as file:
            file.write("0.4,9\n")
        self.refuses("b.csv: a band needs", "plot", *words)

    def test_render(self):
        red, blue = joint_figure.MODES[1][1], stress_figure.COMPRESSION
        self.has(self.draws("render", "--joints", "mode",
                            "--at", "displacement=0.1e-3,0.3e-3,end"), red)
        self.has(self.draws("render", "--principal", "--at", "force=peak"),
                 blue)
        self.draws("render", "--colour", "stress", "--times", "0,0.03,0.05")
        self.draws("render", "--joints", "damage")
        self.has(self.draws("render", "--joints", "slip", "--since", "0.02"),
                 colours.DAMAGE[-1])
        self.draws("render")
        self.refuses("not before", "render", "--time", "0.01", "--since",
                     "0.01")
        self.draws("render", "--times", "settle,0.05", "--since", "settle")
        self.refuses("nor a stage; these are settle, push", "render",
                     "--since", "pull")
        self.refuses("never reaches 0.1", "render", "--at", "displacement=0.1")
        for time in ("1e9", "-1"):
            self.refuses("no field was written near", "render", "--time=" + time)

    def test_joint_damage(self):
        path = self.draws("joint_damage", "--against", "displacement")
        with open(os.path.splitext(path)[0] + ".csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), [
            "displacement [m]", "failed [%]", "slipping [%]", "open [%]",
            "damaged [%]", "crushed [%]"])
        failed = [float(row["failed [%]"]) for row in rows]
        self.assertEqual(failed[0], 0.)
        self.assertGreater(failed[-1], 5.)
        self.assertLessEqual(max(failed), 100.)
        self.draws("joint_damage", "--since", "push")
        with open(os.path.splitext(path)[0] + ".csv") as file:
            since = list(csv.DictReader(file))
        self.assertLess(len(since), len(rows))
        self.assertGreater(float(since[0]["time [s]"]), 0.)
        self.assertEqual(float(since[0]["failed [%]"]), 0.)
        self.refuses("no joint set 'head'; there are mortar", "joint_damage",
                     "--sets", "head")

    def test_beam_figure(self):
        self.refuses("the run has no beams", "beam_figure")
        lined = os.path.join(self.folder.name, "lined")
        done = subprocess.run(
            [quoin, os.path.join(ROOT, "parameter_files", "rock",
                                 "lined_tunnel", "case.prm"),
             "--quiet", "--output", lined,
             "--set", "Beams/shotcrete/Compressive strength=20e6",
             "--set", "Beams/shotcrete/Tensile strength=1.5e6"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.output = lined
        # The lines of the diagram are those of the program's utilisation.
        (name, area, modulus, crush, tear), = beam_figure.strengths_of(
            lined).values()
        self.assertEqual(name, "shotcrete")
        data = vtu.read_at(os.path.join(lined, "beams.pvd")).point_data
        mean = data["axial force"] / area
        bent = np.abs(data["moment"]) / modulus
        np.testing.assert_allclose(
            np.maximum((bent - mean) / crush, (bent + mean) / tear).clip(0),
            data["utilisation"], rtol=1e-9, atol=1e-12)
        self.has(self.draws("beam_figure", "--diagram"), "black")
        self.has(self.draws("beam_figure"), "black")
        self.draws("render", "--scale", "1", "--beams", "moment")
        self.refuses("for runs of section 'Water'", "render", "--joints",
                     "water")
        self.draws("beam_figure", "--time", "behind")
        self.refuses("no beam is placed", "beam_figure", "--time", "face")
        self.refuses("no field was written near 99 s", "beam_figure",
                     "--time", "99")

    def test_wall_figure(self):
        self.draws("wall_figure", "--spec",
                   os.path.join(SMALL_WALL, "plot.json"),
                   "--at", "displacement=0.1e-3,0.3e-3,end")
        self.refuses("No such file", "wall_figure", "--spec", "no.json",
                     "--at", "displacement=end")
        path = os.path.join(self.folder.name, "units.json")
        with open(path, "w") as file:
            file.write('{"curves": [{"column": "force"}, {"column": "slip"}]}')
        self.refuses("several units", "wall_figure", "--spec", path,
                     "--at", "displacement=end")

    def test_paraview_view(self):
        """ParaView need not be there; whoever has none is told what to do."""
        status, printed, _ = self.script("paraview_view", "--help")
        self.assertEqual(status, 0)
        self.assertIn("--animate", printed)
        if importlib.util.find_spec("paraview") is None \
                and shutil.which("pvpython") is None:
            self.refuses("Install it", "paraview_view")
        else:
            self.refuses("xvfb-run", "paraview_view", DISPLAY="")
        if importlib.util.find_spec("paraview") and shutil.which("xvfb-run"):
            for view in ("crosses", "stress"):
                path = os.path.join(self.folder.name, view + ".png")
                subprocess.run(
                    ["xvfb-run", "-a", "-s", "-noreset", sys.executable,
                     os.path.join(SCRIPTS, "paraview_view"), self.output,
                     "--view", view, "--time", "0.02", "--out", path],
                    check=True, timeout=120, stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE)
                self.has(path, {"crosses": colours.COMPRESSION,
                                "stress": colours.VALUES[-1]}[view])

    @unittest.skipUnless(importlib.util.find_spec("paraview")
                         and shutil.which("xvfb-run"), "ParaView is not there")
    def test_paraview_view_of_a_shaken_table(self):
        """A block of two triangles that moves by 3 m, one corner by 3.01 m."""
        folder = os.path.join(self.folder.name, "shaken")
        synthetic_runs.write_run(folder, [0.], [0.], {
            0: synthetic_runs.joint_grid(synthetic_runs.NOTHING,
                                         synthetic_runs.NOTHING)})
        corners = np.array([[0., 0.], [3., 0.], [3., 1.], [0., 1.]])
        moved = np.tile([3., 0., 0.], (4, 1)) + np.outer([0, 0, 1, 0],
                                                         [0.01, 0., 0.])
        synthetic_runs.write_vtu(
            os.path.join(folder, "fields", "blocks_0.vtu"), 0., corners,
            np.array([[0, 1, 2], [0, 2, 3]]), {"displacement": moved},
            {"block": np.zeros(2, np.int32), "material": np.zeros(2, np.int32)})
        os.remove(os.path.join(folder, "joints.pvd"))
        done = subprocess.run(
            ["xvfb-run", "-a", "-s", "-noreset", sys.executable,
             os.path.join(SCRIPTS, "paraview_view"), folder, "--view",
             "material", "--scale", "50"], check=True, timeout=120,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertIn("without the motion of the whole", done.stdout)
        # drawn where it was: its left edge at the left of the picture
        from matplotlib.colors import to_rgb
        from matplotlib.image import imread
        pixels = imread(os.path.join(folder, "view.png"))[..., :3]
        stone = (np.abs(pixels - to_rgb(colours.MATERIALS[0])) < 0.02).all(
            axis=2)
        self.assertLess(np.flatnonzero(stone.any(axis=0))[0],
                        0.2 * pixels.shape[1])

    def test_study(self):
        """The worked study of the user guide: once cracked through, a wall
        slides at N tan(phi), with any cohesion, as long as it slides on one
        bed joint."""
        output = os.path.join(self.folder.name, "study")
        subprocess.run(
            [sys.executable, os.path.join(SMALL_WALL, "study.py"), "--quoin",
             quoin, "--output", output], check=True, timeout=300,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        with open(os.path.join(output, "study.csv")) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 12)
        for row in rows:
            angle = float(row["Joints/mortar/Friction angle"])
            if angle < 45.:
                self.assertAlmostEqual(
                    float(row["sliding [N]"])
                    / (15e3 * np.tan(np.radians(angle))), 1., delta=2e-3)
            self.assertGreater(float(row["peak [N]"]),
                               float(row["sliding [N]"]))
        self.assertGreater(
            os.path.getsize(os.path.join(output, "study.png")), 5000)

    def test_parameters(self):
        self.assertEqual(run_parameters.joint_sets(self.output), ["mortar"])
        self.assertEqual(run_parameters.peak_crushing(self.output), [0.09e-3])
        self.assertEqual(
            run_parameters.of_joint_sets(self.output, "Shear stiffness"),
            [36e9])


if __name__ == "__main__":
    quoin = synthetic_runs.program_of_words(__doc__)
    unittest.main()
