#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What is seen in pictures of blocks in three dimensions: pixels of two cubes
side by side, whose colours and places are known."""
import itertools
import os
import subprocess
import sys
import tempfile
import time
import types
import unittest

import numpy as np

import synthetic_runs
from quoin import colours, joint_states, vtu
from quoin.figures import block_figure
from quoin.figures import figure_style
from quoin.figures import space_figure
from quoin.commands.options import Cut
from matplotlib.colors import to_rgb
import matplotlib.pyplot as plt

ALONG_X, ALONG_Y = [0., 0.], [-90., 0.]      # cameras; x or y away from these
N = 3                                # cells along an edge of a cube
space_figure.PIXELS = 500


def cube(x):
    """Points and tetrahedra of the unit cube whose least corner is at (x, 0, 0)."""
    index = np.arange((N + 1) ** 3).reshape((N + 1,) * 3)
    points = np.stack(np.indices(index.shape).reshape(3, -1), axis=1) / N
    cells = []
    for corner in itertools.product(range(N), repeat=3):
        for way in itertools.permutations(np.eye(3, dtype=int)):
            path = np.cumsum([corner, *way], axis=0)
            tetrahedron = [index[tuple(p)] for p in path]
            if np.linalg.det(way) < 0.:
                tetrahedron[2:] = tetrahedron[:1:-1]
            cells.append(tetrahedron)
    return points + [x, 0., 0.], np.array(cells, dtype=np.int32)


def two_cubes(displacement):
    """Blocks 0 and 1 at x = 0 to 1 and 1 to 2; @p displacement of (points, block)
    [m]."""
    (a, cells), (b, _) = cube(0.), cube(1.)
    n = len(cells)
    moved = np.concatenate([displacement(a, 0), displacement(b, 1)])
    return vtu.Grid(
        0., np.concatenate([a, b]), np.concatenate([cells, cells + len(a)]),
        {"displacement": moved, "velocity": 2. * moved},
        {"block": np.repeat(np.array([0, 1], np.int32), n),
         "material": np.repeat(np.array([0, 1], np.int32), n),
         "principal stress 3": np.repeat([-3e6, -1e6], n),
         # 3 MPa of compression along z, then 1 MPa of tension along y
         "stress": np.repeat([[0., 0., -3e6, 0., 0., 0.],
                              [0., 1e6, 0., 0., 0., 0.]], n, axis=0)})


def joint(shift=0.):
    """The face between the cubes, moved along x by @p shift: open where y < 1/2,
    slipping in y < 3/4, else intact."""
    y = [0., 0.5, 0.5, 0., 0.5, 0.75, 0.75, 0.5, 0.75, 1., 1., 0.75]
    z = [0., 0., 1., 1.] * 3
    moved = np.tile([shift, 0., 0.], (12, 1))
    corners = np.array([[0, 1, 2], [0, 2, 3]])
    return vtu.Grid(
        0., np.stack([np.ones(12), y, z], axis=1) + moved,
        np.concatenate([corners, corners + 4, corners + 8]),
        {"displacement": moved, "opening": np.zeros(12)},
        {"state": np.repeat(np.array(
            [joint_states.OPEN, joint_states.SLIPPING, joint_states.INTACT],
            np.uint8), 2)})


def still(points, _):
    return 0. * points


def lifted(points, block):
    """The second cube by 0.01 m."""
    return block * np.tile([0., 0., 0.01], (len(points), 1))


def sheared(points, _):
    """Along y, by 1 mm at the top."""
    return 1e-3 * points[:, [2]] * [0., 1., 0.]


def frame_of(displacement=still, joints=None):
    frame = space_figure.SpaceFrame.__new__(space_figure.SpaceFrame)
    frame.blocks, frame.joints = two_cubes(displacement), joints
    frame.label = frame.shared = None
    return frame


class Seen:
    """The picture of a frame, and the colours at places of the model."""

    def __init__(self, frame, **options):
        words = {"camera": ALONG_X, "scale": 1., "colour": "material",
                 "view": None, "since": None, "joints": "state", "cut": None,
                 "explode": None, "principal": False, "crosses": None,
                 "blocks_only": False, "mesh": False, "title": None}
        self.frame = frame
        self.picture = space_figure.SpacePicture(
            types.SimpleNamespace(**dict(words, **options)), [frame])
        self.figure, self.axes = plt.subplots()
        self.handles = self.picture.draw(self.axes, frame, True)
        plt.close(self.figure)
        self.image = np.asarray(self.axes.images[0].get_array())

    def pixel(self, *place):
        p = self.picture
        share = (p.page[:2] @ place - p.low) / (p.high - p.low)
        column, row = (share * (self.image.shape[1::-1])).astype(int)
        return self.image[row, column]


class Pictures(unittest.TestCase):
    def looks(self, seen, place, colour, facing=1.):
        """The pixel there has this colour, on a face that looks at the viewer,
        or whose normal has @p facing in common with the light's direction."""
        light = np.array([0.4, 0.5, 1.])    # to the right, up, to the viewer
        light = (facing if np.ndim(facing) else [0., 0., 1.]) @ light \
            / np.linalg.norm(light)
        np.testing.assert_allclose(
            seen.pixel(*place), 255. * np.array(to_rgb(colour))
            * (0.55 + 0.45 * light), atol=1.5)

    def is_white(self, seen, *place):
        self.assertEqual(seen.pixel(*place).tolist(), [255] * 3)

    def test_the_nearest_is_seen(self):
        seen = Seen(frame_of())
        first, second = colours.MATERIALS[:2]
        for y, z in itertools.product((0.1, 0.45, 0.9), repeat=2):
            self.looks(seen, (2., y, z), second)
        self.assertLess(seen.pixel(2., 1., 0.5).max(), 80)   # its edge
        for y, z in ((-0.015, 0.5), (1.015, 0.5), (0.5, 1.015)):
            self.is_white(seen, 2., y, z)
        seen = Seen(frame_of(), camera=[180., 0.])
        self.looks(seen, (0., 0.1, 0.45), first)
        # from above, x to the right: the one beside the other
        seen = Seen(frame_of(), camera=[-90., 89.9])
        self.looks(seen, (0.45, 0.4, 1.), first)
        self.looks(seen, (1.45, 0.4, 1.), second)

    def test_light_comes_from_above(self):
        seen = Seen(frame_of(), camera=[0., 45.])
        tilted = np.sqrt(0.5) * np.array([0., -1., 1.])
        self.looks(seen, (2., 0.4, 0.4), colours.MATERIALS[1], tilted)
        self.looks(seen, (1.6, 0.4, 1.), colours.MATERIALS[1], -tilted
                   + [0., 0., np.sqrt(2.)])

    def test_cut_has_the_values_of_its_cells(self):
        frame = frame_of(sheared)
        seen = Seen(frame, colour="displacement", cut=Cut("x<0.6"))
        blocks = frame.blocks
        corners = blocks.points[blocks.cells]
        base = np.linalg.inv((corners[:, 1:] - corners[:, :1]))
        for y, z in itertools.product(np.linspace(0.06, 0.94, 12), repeat=2):
            place = np.array([0.6, y, z])
            share = np.einsum("cj,cji->ci", place - corners[:, 0], base)
            inside = (share.min(axis=1) > 0.02) & (share.sum(axis=1) < 0.98)
            if inside.any():         # not on the border of two cells
                value = corners[inside.argmax(), :, 2].mean()   # [mm]
                self.looks(seen, place, figure_style.MAGNITUDES(
                    seen.picture.sizes(value))[:3])
        mappable, label = seen.picture.colour_bars()[0]
        self.assertEqual(label, "displacement [mm]")
        self.assertLess(mappable.norm.vmax, 1.)

    def test_cut_leaves_a_side(self):
        along_y = {"camera": ALONG_Y, "cut": Cut("x>0.25")}
        seen = Seen(frame_of(), **along_y)
        np.testing.assert_allclose(seen.picture.extent, [1.75 * 1.04,
                                                         1. + 0.07])
        self.looks(seen, (0.45, 0., 0.4), colours.MATERIALS[0])
        # the line of the joint, and none where cells meet
        self.assertLess(seen.pixel(1., 0., 0.4).max(), 80)
        self.looks(seen, (2. / 3., 0., 0.41), colours.MATERIALS[0])
        with_mesh = Seen(frame_of(), mesh=True, **along_y)
        self.assertGreater(np.ptp([
            with_mesh.pixel(2. / 3. + x, 0., 0.41)[0]
            for x in np.linspace(-0.005, 0.005, 41)]), 30)

    def test_cut_beside_the_blocks(self):
        with self.assertRaisesRegex(ValueError, "no block.* x = -1 m"):
            Seen(frame_of(), cut=Cut("x<-1"))

    def test_stress_of_the_blocks(self):
        seen = Seen(frame_of(), camera=ALONG_Y, colour="stress")
        for x, share in ((0.45, 0.), (1.45, 2. / 3.)):
            self.looks(seen, (x, 0., 0.4), figure_style.STRESSES(share)[:3])
        self.assertEqual(seen.picture.colour_bars()[0][1],
                         "minor principal stress [MPa]")

    def test_joint_states_on_faces(self):
        stone = colours.MATERIALS[0]
        wanted = [(0.2, colours.RED), (0.6, colours.ORANGE), (0.9, stone)]
        # moved as the fields have them, whatever is drawn of it
        for shift, cut in ((0., "x<1"), (0.03, "x<1.0000001")):
            seen = Seen(frame_of(joints=joint(shift)), cut=Cut(cut))
            for y, colour in wanted[:2] if shift else wanted:
                self.looks(seen, (1., y, 0.4), colour)
        self.assertEqual([h.get_label() for h in seen.handles],
                         ["open", "slipping"])
        # a cut beside the joint has the colours of stone
        seen = Seen(frame_of(joints=joint()), cut=Cut("x<0.99"))
        self.looks(seen, (0.99, 0.2, 0.4), stone)
        self.assertEqual(seen.handles, [])
        # parts of faces, above a cut across the joint
        seen = Seen(frame_of(joints=joint()), camera=[0., 30.], explode=6.,
                    cut=Cut("z>0.55"), blocks_only=False)
        self.looks(seen, (1. - 3., 0.2, 0.7), colours.RED,
                   np.array([0., -0.5, np.sqrt(0.75)]))
        seen = Seen(frame_of(joints=joint()), cut=Cut("x<1"), blocks_only=True)
        self.looks(seen, (1., 0.2, 0.4), stone)
        self.assertEqual(seen.handles, [])

    def test_blocks_move_apart(self):
        seen = Seen(frame_of(), camera=ALONG_Y, explode=0.5)
        # their centres are 1 m apart, and 1.5 m then
        np.testing.assert_allclose(seen.picture.extent, [2.6, 1.1])
        self.is_white(seen, 1., 0., 0.5)
        self.looks(seen, (0.70, 0., 0.4), colours.MATERIALS[0])
        self.looks(seen, (1.30, 0., 0.4), colours.MATERIALS[1])
        self.assertIn("moved apart", seen.picture.remark())

    def test_displacements_are_enlarged(self):
        seen = Seen(frame_of(lifted), camera=ALONG_Y, scale=20.)
        self.looks(seen, (1.45, 0., 1.15), colours.MATERIALS[1])
        self.is_white(seen, 0.45, 0., 1.05)
        self.is_white(seen, 1.45, 0., 0.15)
        # cut where it was in the mesh
        seen = Seen(frame_of(lifted), camera=ALONG_Y, scale=50.,
                    cut=Cut("z<0.5"))
        self.looks(seen, (1.45, 0., 0.9), colours.MATERIALS[1])
        self.is_white(seen, 0.45, 0., 0.6)
        # by 4 % of 2 m at most, each 5 mm off the mean
        self.assertEqual(Seen(frame_of(lifted), scale=None).picture.scale, 10.)

    def crosses(self, camera):
        """Those along an edge of a cube, their colours and sizes [m]; the length
        of 1 Pa."""
        seen = Seen(frame_of(), camera=camera, principal=True, crosses=8)
        lines = [(tuple(colour[:3]), *np.ptp(segment, axis=0))
                 for c in seen.axes.collections for segment, colour in
                 zip(c.get_segments(), itertools.cycle(c.get_colors()))
                 if np.ptp(segment, axis=0).max() > 1e-9
                 and tuple(colour[:3]) != (1., 1., 1.)]
        self.assertEqual([h.get_label() for h in seen.handles],
                         ["compression", "tension"])
        return lines, (0.9 * seen.picture.extent.max() / 8.
                       / seen.picture.crosses.reference)

    def test_crosses(self):
        lines, size = self.crosses(ALONG_Y)
        # of the first cube; the tension along y is seen as a point
        self.assertEqual(len(lines), 4 * 4)
        for colour, a, b in lines:
            self.assertEqual(colour, to_rgb(colours.COMPRESSION))
            np.testing.assert_allclose([a, b], [0., size * 3e6], atol=1e-12)
        # on the second one alone, behind which the first is hidden
        lines, size = self.crosses(ALONG_X)
        self.assertEqual(len(lines), 8 * 8)
        for colour, a, b in lines:
            self.assertEqual(colour, to_rgb(colours.TENSION))
            np.testing.assert_allclose([a, b], [size * 1e6, 0.], atol=1e-12)

    def test_options_of_two_dimensions(self):
        for option in ({"view": [0., 0., 1., 1.]}, {"since": "settle"},
                       {"joints": "mode"}):
            with self.assertRaisesRegex(ValueError, "two dimensions"):
                Seen(frame_of(), **option)


class Geometry(unittest.TestCase):
    corners = np.array([[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.],
                        [1., 1., 1.]])
    cells = np.array([[0, 1, 2, 3], [1, 2, 3, 4]])

    def faces(self, cells, cut=None):
        """Corners and owners of the faces of a surface."""
        blocks = vtu.Grid(0., self.corners, np.array(cells), {}, {})
        found = space_figure.surface(blocks, self.corners, cut)
        places, owner = (space_figure.vtk_to_numpy(data.GetArray(name))
                         for data, name in (
                             (found.GetPointData(), "mesh place"),
                             (found.GetCellData(), "cell")))
        return [places[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]]
                for ids in (found.GetCell(n).GetPointIds()
                            for n in range(len(owner)))], owner.tolist()

    def test_surface_of_two_tetrahedra(self):
        faces, owner = self.faces(self.cells)
        self.assertEqual(sorted(owner), [0, 0, 0, 1, 1, 1])
        for face in faces:
            self.assertFalse(np.allclose(face.sum(axis=1), 1.))

    def test_sections(self):
        def area(face):
            a = face[0]
            return 0.5 * np.linalg.norm(sum(np.cross(b - a, c - a) for b, c in
                                            zip(face[1:], face[2:])))

        for text, wanted in (("x<0.5", [0.125, 0.375, 0.375, 0.5,
                                        0.375 * 3 ** 0.5]),
                             ("x>0.5", [0.125, 0.125, 0.125,
                                        0.125 * 3 ** 0.5])):
            faces, _ = self.faces(self.cells[:1], Cut(text))
            np.testing.assert_allclose(sorted(map(area, faces)), wanted)

    def test_principal_stresses(self):
        # 3 MPa along (1, 1, 0), -2 MPa along z, -1 MPa across both
        way = np.array([1., 1., 0.]) / np.sqrt(2)
        across = np.array([1., -1., 0.]) / np.sqrt(2)
        tensor = (3e6 * np.outer(way, way) - 1e6 * np.outer(across, across)
                  - 2e6 * np.diag([0., 0., 1.]))
        stress = tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        blocks = vtu.Grid(0., self.corners, self.cells, {},
                          {"stress": np.tile(stress, (2, 1))})
        values, directions = space_figure.principal(blocks)
        np.testing.assert_allclose(values, [[-2e6, -1e6, 3e6]] * 2)
        self.assertAlmostEqual(abs(directions[0, :, 2] @ way), 1.)
        self.assertAlmostEqual(abs(directions[1, 2, 0]), 1.)


def is_running(*words):
    """Whether a program runs whose command line begins with these words."""
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/cmdline") as file:
                if tuple(file.read().split("\0")[:len(words)]) == words:
                    return True
        except OSError:
            pass                        # it has just ended
    return False


class Script(unittest.TestCase):
    """scripts/render of a run of two moments, without a screen."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = cls.scratch.name
        for name in ("blocks", "joints"):
            sets = []
            for moment, moved in enumerate((still, lifted)):
                path = f"{name}_{moment}.vtu"
                sets.append(f'<DataSet timestep="{moment}" file="{path}"/>')
                grid = two_cubes(moved) if name == "blocks" else joint()
                synthetic_runs.write_vtu(
                    os.path.join(cls.folder, path), float(moment), grid.points,
                    grid.cells, grid.point_data, grid.cell_data)
            with open(os.path.join(cls.folder, name + ".pvd"), "w") as file:
                file.write("<VTKFile><Collection>" + "".join(sets)
                           + "</Collection></VTKFile>")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def render(self, *words, **variables):
        done = subprocess.run(
            [sys.executable, os.path.join(synthetic_runs.SCRIPTS, "render"),
             self.folder, *words], text=True, timeout=120,
            env=dict(os.environ, **dict({"DISPLAY": ""}, **variables)),
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        return done.returncode, done.stdout, done.stderr

    def test_two_dimensions_refuse_it(self):
        self.assertTrue(block_figure.is_in_space(self.folder))
        with self.assertRaisesRegex(ValueError, "three dimensions"):
            block_figure.Frame(self.folder, None)

    def test_page_of_two_moments(self):
        from matplotlib.image import imread
        path = os.path.join(self.folder, "page.png")
        self.assertEqual(self.render(
            "--times", "0,1", "--camera=0,30", "--explode", "3", "--out", path),
            (0, path + "\n", ""))
        image = imread(path)[..., :3]
        half = image.shape[1] // 2
        red = np.array(to_rgb(colours.RED))
        for part in (image[:, :half], image[:, half:]):
            shares = part / red
            self.assertGreater((np.ptp(shares, axis=2) < 0.1).sum(), 1000)

    def test_film(self):
        from PIL import Image
        path = os.path.join(self.folder, "film.gif")
        self.assertEqual(self.render("--animate", path, "--camera=-90,0",
                                     "--scale", "30"), (0, path + "\n", ""))
        rows = []
        with Image.open(path) as film:
            self.assertEqual(film.n_frames, 2)
            for k in range(2):
                film.seek(k)
                blue = np.abs(
                    np.asarray(film.convert("RGB"), float) - 0.93 * 255
                    * np.array(to_rgb(colours.MATERIALS[1]))).max(axis=2) < 12
                rows.append(np.flatnonzero(blue.any(axis=1)).mean()
                            / blue.shape[0])
        self.assertLess(rows[1], rows[0] - 0.1)     # it went up

    def refuses(self, says, **variables):
        status, _, error = self.render(**variables)
        self.assertEqual((status, len(error.splitlines())), (1, 1), error)
        self.assertIn(says, error)

    def test_what_must_be_installed(self):
        self.refuses("apt-get install xvfb", PATH=self.folder)
        path = os.path.join(self.folder, "Xvfb")
        with open(path, "w") as file:
            file.write("#!/bin/sh\nexit 1\n")
        os.chmod(path, 0o755)
        self.refuses("does not start", PATH=self.folder)
        os.makedirs(os.path.join(self.folder, "vtkmodules"), exist_ok=True)
        with open(os.path.join(self.folder, "vtkmodules", "__init__.py"),
                  "w") as file:
            file.write("raise ModuleNotFoundError(name='vtkmodules')\n")
        self.refuses("apt-get install python3-vtk9", PYTHONPATH=self.folder)

    def start(self, ends, path=os.environ["PATH"]):
        """A program that opens a screen, says its number, and goes on."""
        return subprocess.Popen(
            [sys.executable, "-c", "import os; from quoin import screen; "
             "screen.open_screen(); print(os.environ['DISPLAY'], flush=True); "
             + ends], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, text=True,
            env=dict(os.environ, DISPLAY="", PATH=path, PYTHONPATH=os.path.join(
                synthetic_runs.ROOT, "python")))

    def wait_for(self, *words, running):
        """Waits until programs with these words run, or none does."""
        end = time.monotonic() + 20.
        while is_running(*words) != running and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(is_running(*words), running, words)

    def test_the_screen_ends_with_the_program(self):
        for is_killed, ends in ((True, "input()"), (False, "1/0")):
            program = self.start(ends)
            number = program.stdout.readline().strip()
            if is_killed:
                self.assertTrue(is_running("Xvfb", number))
                program.kill()
            program.communicate()
            self.wait_for("Xvfb", number, running=False)

    def test_the_screen_ends_with_a_program_that_waits_for_it(self):
        path = os.path.join(self.folder, "Xvfb")
        with open(path, "w") as file:
            file.write("#!/bin/sh\nexec sleep 98765\n")
        os.chmod(path, 0o755)
        program = self.start("", self.folder + ":" + os.environ["PATH"])
        self.wait_for("sleep", "98765", running=True)
        program.kill()
        program.communicate()
        self.wait_for("sleep", "98765", running=False)
        os.remove(path)


if __name__ == "__main__":
    unittest.main()
