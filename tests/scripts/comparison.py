#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""scripts/compare on runs whose answers are known: folders written here, and a
program that stands for quoin and copies them."""
import json
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
sys.path.insert(0, SCRIPTS)

import joint_comparison  # noqa: E402
import run_parameters  # noqa: E402
import solver_comparison  # noqa: E402
import vtu  # noqa: E402

SPEC = {"x": {"column": "u", "factor": 1e3, "label": "displacement [mm]"},
        "y": {"label": "force [kN]"},
        "curves": [{"column": "f", "factor": -1e-3}]}
TYPES = {"f": "Float64", "i": "Int32", "u": "UInt8"}
PARAMETERS = """subsection Joints
  set Names = mortar
  subsection mortar
    set Shear stiffness = 1e9
    set Law = Coulomb
    set Peak crushing = 1e-4
  end
end
"""
# Stands for quoin: copies the folder of the solver that is asked for.
QUOIN = """#!/usr/bin/python3
import shutil, sys
words = sys.argv
solver = words[-1].split("=")[1]
if "--set" not in words or not words[-1].startswith("Solver="):
    sys.exit(1)
shutil.copytree("%s/" + solver, words[words.index("--output") + 1],
                dirs_exist_ok=True)
sys.exit({"explicit": 0, "implicit": %d}[solver])
"""


def write_vtu(path, time, points, cells, point_data, cell_data):
    """As quoin writes them: XML with appended raw data."""
    blocks, offset = [], 0

    def array(name, values):
        nonlocal offset
        values = np.ascontiguousarray(values)
        kind = TYPES[values.dtype.kind]
        n = values.shape[1] if values.ndim > 1 else 1
        raw = values.astype(vtu.DTYPES[kind]).tobytes()
        blocks.append(np.uint64(len(raw)).tobytes() + raw)
        text = (f'<DataArray type="{kind}" Name="{name}" format="appended" '
                f'NumberOfComponents="{n}" offset="{offset}"/>')
        offset += len(blocks[-1])
        return text

    def group(name, data):
        return (f"<{name}>" + "".join(array(*item) for item in data.items())
                + f"</{name}>")

    flat = np.hstack([points, np.zeros((len(points), 1))])
    header = (
        "<VTKFile><UnstructuredGrid>"
        + group("FieldData", {"TimeValue": np.array([time])})
        + f'<Piece NumberOfPoints="{len(points)}" '
        + f'NumberOfCells="{len(cells)}">'
        + group("Points", {"points": flat})
        + group("Cells", {
            "connectivity": cells.ravel().astype(np.int32),
            "offsets": (np.arange(1, len(cells) + 1)
                        * cells.shape[1]).astype(np.int32)})
        + group("PointData", point_data) + group("CellData", cell_data)
        + '</Piece></UnstructuredGrid><AppendedData encoding="raw">_')
    with open(path, "wb") as file:
        file.write(header.encode() + b"".join(blocks)
                   + b"</AppendedData></VTKFile>")


def joint_grid(opening, slip, order=None, turned=()):
    """Faces of 1 m in a row, 2 m, ..., two values of opening and slip [m]
    each; faces in another @p order, some with their ends @p turned."""
    n = len(opening)
    ends = np.cumsum([0.] + [1. + k for k in range(n)])
    x = np.stack([ends[:-1], ends[1:]], axis=1)
    values = [x, np.array(opening, float), np.array(slip, float)]
    for face in turned:
        for value in values:
            value[face] = value[face, ::-1]
    order = range(n) if order is None else order
    x, opening, slip = (value[list(order)].ravel() for value in values)
    moved = np.stack([0.1 * opening, 0.1 * x, 0. * x], axis=1)
    return vtu.Grid(
        0., np.stack([x, 0. * x], axis=1) + moved[:, :2],
        np.arange(2 * len(order)).reshape(-1, 2),
        {"displacement": moved, "opening": opening, "slip": slip,
         "shear traction": 0. * x, "damage": (opening > 2e-4) * 1.,
         "point state": (opening > 0.).astype(np.uint8),
         "crushing": 0. * x},
        {"length": 1. + np.array(order),
         "joint set": np.zeros(len(order), np.int32),
         "state": np.zeros(len(order), np.uint8)})


def write_run(folder, u, f, grids, wall_time=10., finished=True):
    """A run whose histories have these rows, a second apart, and fields of
    joints and of one block at the times that @p grids have."""
    os.makedirs(os.path.join(folder, "fields"))
    with open(os.path.join(folder, "histories.csv"), "w") as file:
        file.write("time [s],u [m],f [N]\n")
        file.writelines(f"{k},{a},{b}\n" for k, (a, b) in enumerate(zip(u, f)))
    with open(os.path.join(folder, "summary.json"), "w") as file:
        json.dump({"finished": finished, "steps": len(u),
                   "wall time [s]": wall_time,
                   "energy residual share": 1e-5}, file)
    with open(os.path.join(folder, "used_parameters.prm"), "w") as file:
        file.write(PARAMETERS)
    corners = np.array([[0., 0.], [3., 0.], [3., 1.], [0., 1.]])
    zero = np.zeros((4, 3))
    for name in ("joints", "blocks"):
        sets = []
        for time, grid in grids.items():
            path = f"fields/{name}_{time}.vtu"
            sets.append(f'<DataSet timestep="{time}" file="{path}"/>')
            words = ((grid.points, grid.cells, grid.point_data, grid.cell_data)
                     if name == "joints" else
                     (corners, np.array([[0, 1, 2], [0, 2, 3]]),
                      {"displacement": zero, "velocity": zero},
                      {"block": np.zeros(2, np.int32),
                       "material": np.zeros(2, np.int32)}))
            write_vtu(os.path.join(folder, path), float(time), *words)
        with open(os.path.join(folder, name + ".pvd"), "w") as file:
            file.write("<VTKFile><Collection>" + "".join(sets)
                       + "</Collection></VTKFile>")


NOTHING = [[0., 0.], [0., 0.]]
WIDE = [[2e-4, 0.], [0., 3e-4]]
SLID = [[0., 0.], [-2e-4, 0.]]


class Folders(unittest.TestCase):
    """An explicit run that settles, peaks at 40 kN and 2 mm and falls, and an
    implicit one that is 10 % lower and ends at 3 mm, in fewer rows."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.explicit, self.implicit = (
            os.path.join(self.folder.name, name)
            for name in solver_comparison.SOLVERS)
        u = 1e-3 * np.array([0., 0., 1., 2., 3., 4.])
        f = -1e3 * np.array([5., 0., 20., 40., 30., 20.])
        write_run(self.explicit, u, f, {
            1: joint_grid(NOTHING, NOTHING), 3: joint_grid(WIDE, SLID),
            4: joint_grid(WIDE, WIDE), 5: joint_grid(WIDE, WIDE)}, 50.)
        write_run(self.implicit, 1e-3 * np.array([0., 2., 3.]),
                  -1e3 * np.array([0., 36., 27.]),
                  {0: joint_grid(NOTHING, NOTHING),
                   1: joint_grid(WIDE, SLID, [1, 0], turned=[0]),
                   2: joint_grid(NOTHING, WIDE)}, finished=False)

    def compare(self, spec=None):
        return solver_comparison.Comparison(
            spec or SPEC, self.folder.name, self.explicit, self.implicit)


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
        # a tenth of the triangle and of the trapezoid below the curve
        self.assertAlmostEqual(curves["mean difference"],
                               0.1 * (40. + 35.) / 3. / 40.)

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
        self.case = os.path.join(self.folder.name, "case.prm")
        with open(self.case, "w") as file:
            file.write("include common.inc\n")
        with open(os.path.join(self.folder.name, "common.inc"), "w") as file:
            file.write("set Output directory = results  # here\n")
        with open(os.path.join(self.folder.name, "plot.json"), "w") as file:
            json.dump(SPEC, file)

    def call(self, *words):
        done = subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "compare"), *words],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            timeout=120)
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout, done.stderr

    def quoin(self, status):
        path = os.path.join(self.folder.name, "quoin")
        with open(path, "w") as file:
            file.write(QUOIN % (self.folder.name, status))
        os.chmod(path, 0o755)
        return path

    def test_output_directory(self):
        self.assertEqual(run_parameters.output_of(self.case),
                         os.path.join(self.folder.name, "results"))
        self.assertEqual(
            run_parameters.output_of(self.case, ["Output directory=/x"]), "/x")

    def test_runs_both(self):
        status, printed, error = self.call(self.case, "--quoin", self.quoin(2),
                                           "--set", "Thickness=1")
        self.assertEqual((status, error), (0, ""))
        output = os.path.join(self.folder.name, "results_compare")
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
        output = os.path.join(self.folder.name, "both")
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
