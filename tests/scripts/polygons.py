#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Polygons and arches as geometries: areas and joints against closed forms, as
the program meshes them, and what is refused."""
import json
import os
import subprocess
import sys
import unittest

import numpy as np

from synthetic_runs import SCRIPTS, Scratch, program_of_words
from quoin import geometry, vtu
from quoin.geometry import Polygon

CASE = """set Plane assumption = plane strain
subsection Mesh
  set File         = blocks.geo
  set Joints along = joint
end
subsection Materials
  set Names = all
  subsection all
    set Groups          = {groups}
    set Density         = 2000
    set Young's modulus = 1e9
    set Poisson's ratio = 0.2
  end
end
subsection Joints
  set Names = joint
  subsection joint
    set Law              = Coulomb
    set Normal stiffness = 1e9
    set Shear stiffness  = 1e9
    set Friction angle   = 30
  end
end
subsection Loads
  set Names = {loads}
  subsection gravity
    set Type     = gravity
    set Vertical = -9.81
  end
  {held}
end
subsection Stages
  set Names = fall
  subsection fall
    set Loads    = {loads}
    set End      = time
    set Duration = 1e-4
  end
end
"""
BASE = """subsection base
    set Type     = prescribed motion
    set Boundary = base
    set Vertical = 0
  end"""
# three bricks in running bond, of which the lower ones hang on the upper one
WALL = [Polygon("left", "brick", [(0., 0.), (1., 0.), (1., .5), (0., .5)]),
        Polygon("right", "brick", [(1., 0.), (1., .5), (2., .5), (2., 0.)]),
        Polygon("top", "cap", [(.25, .5), (1.5, .5), (1.5, 1.), (.25, 1.)])]


def square(name, x, y, side=1.):
    return Polygon(name, "b", [(x, y), (x + side, y), (x + side, y + side),
                               (x, y + side)])


class Partitions(unittest.TestCase):
    def refuses(self, words, polygons):
        with self.assertRaises(ValueError) as caught:
            geometry.partition(polygons)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_shared_edges(self):
        made = geometry.partition(WALL)
        # left: a vertex of top on its top; right: one; top: the middle joint
        self.assertEqual(made.hanging, 3)
        shared = [e for e, use in made.edges.items() if len(use) == 2]
        lengths = sorted(np.linalg.norm(made.points[a] - made.points[b])
                         for a, b in shared)
        np.testing.assert_allclose(lengths, [.5, .5, .75])
        for loop, polygon in zip(made.loops, WALL):
            self.assertAlmostEqual(geometry.area_of(made.points[loop]),
                                   abs(geometry.area_of(polygon.vertices)))

    def test_nearly_the_same_points(self):
        made = geometry.partition([square("a", 0., 0.),
                                   square("b", 1. + 1e-7, -1e-7)])
        self.assertEqual(len(made.points), 6)

    def test_overlaps(self):
        a = square("a", 0., 0.)
        for b in (square("b", .5, .5),                # edges cross
                  square("b", .25, .25, .5),          # within
                  square("b", 0., 0.),                # the same
                  square("b", .5, 0.),                # along two edges
                  Polygon("b", "b", [(.5, 0.), (1., .5), (.5, 1.), (0., .5)]),
                  square("b", -1., -1., 3.)):
            for pair in ([a, b], [b, a]):
                self.refuses(["'a'", "'b'", "overlap at ("], pair)

    def test_touching_is_no_overlap(self):
        a = square("a", 0., 0.)
        for b, joints in ((square("b", 1., 1.), 0), (square("b", 1., .5), 1),
                          (square("b", 2.5, 0.), 0),
                          (Polygon("b", "b", [(1., 0.), (2., 0.), (2., 2.),
                                              (0., 2.), (0., 1.), (1., 1.)]),
                           2)):
            made = geometry.partition([a, b])
            self.assertEqual(sum(len(use) == 2 for use in
                                 made.edges.values()), joints)

    def test_bad_polygons(self):
        self.refuses(["no polygons"], [])
        self.refuses(["'a' crosses itself at (0.6, 0.6)"],
                     [Polygon("a", "b", [(0, 0), (1, 1), (1, 0), (0, 1.5),
                                         (0, 1)])])
        self.refuses(["'a' touches itself at (1, 1)"], [Polygon("a", "b", [
            (0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)])])
        self.refuses(["'a' has no area"],
                     [Polygon("a", "b", [(0, 0), (1, 1), (2, 2)])])
        self.refuses(["'a' needs three"], [Polygon("a", "b", [(0, 0), (1, 1)])])
        self.refuses(["'a' needs three"],
                     [Polygon("a", "b", [(0, 0), (1, np.nan), (2, 0)])])
        self.refuses(["group ''"], [square("a", 0, 0)._replace(group="")])
        self.refuses(["2 polygons 'a'"], [square("a", 0, 0),
                                          square("a", 5, 5)])


class Geometries(Scratch):
    def setUp(self):
        super().setUp()
        self.path = os.path.join(self.folder, "blocks.geo")

    def mesh(self, polygons, has_base=False, **words):
        """Result of writing polygons, and blocks and joints of a run of one
        step."""
        written = geometry.write_geo(self.path, polygons, **words)
        case = os.path.join(self.folder, "case.prm")
        with open(case, "w") as file:
            file.write(CASE.format(
                groups=", ".join(written["areas"]), held=BASE * has_base,
                loads="gravity" + ", base" * has_base))
        output = os.path.join(self.folder, "output")
        subprocess.run([quoin, case, "--quiet", "--output", output],
                       check=True, timeout=60, stderr=subprocess.PIPE)
        return (written, *(vtu.read_at(os.path.join(output, name + ".pvd"), 0.)
                           for name in ("blocks", "joints")))

    def areas(self, blocks):
        """Areas of the blocks of a mesh [m^2], sorted."""
        a, b, c = blocks.points[blocks.cells].transpose(1, 0, 2)
        return np.sort(np.bincount(blocks.cell_data["block"], 0.5 * np.abs(
            geometry.cross(b - a, c - a))))

    def test_wall(self):
        written, blocks, joints = self.mesh(
            WALL, elements=3, has_base=True,
            boundaries={"base": (0., 0., 2., 0.)})
        self.assertEqual(written["blocks"], 3)
        self.assertEqual(written["joints"], 3)
        self.assertEqual(written["areas"], {"brick": 1., "cap": .625})
        np.testing.assert_allclose(self.areas(blocks), [.5, .5, .625])
        self.assertEqual(len(joints.cells), 9)      # three on each
        self.assertAlmostEqual(joints.cell_data["length"].sum(), 1.75)

    def test_arch(self):
        """A voussoir is a piece of a ring between two chords; the fill is what
        a rectangle leaves of all others."""
        span, rise, thick, n, width, high, cover = 4., 1., .4, 9, .8, .5, .3
        radius, half = 2.5, np.arcsin(0.8)
        written, blocks, joints = self.mesh(geometry.arch(
            span, rise, thick, n, springer=(width, high), backing=.8,
            cover=cover), size={"": .3, "voussoir": .2})
        step = 2. * half / n
        voussoir = .5 * np.sin(step) * ((radius + thick) ** 2 - radius ** 2)
        self.assertAlmostEqual(written["areas"]["voussoir"], n * voussoir)
        top = thick * .6                             # of the springers
        springer = width * high + width * top - .5 * top * thick * .8
        self.assertAlmostEqual(written["areas"]["springer"], 2. * springer)
        outline = 2. * (.5 * span + width) * (rise + thick + cover)
        below = .5 * n * np.sin(step) * radius ** 2 \
            - .5 * span * (radius - rise)            # within the intrados
        self.assertAlmostEqual(sum(written["areas"].values()),
                               outline - below + 2. * width * high)
        np.testing.assert_allclose(self.areas(blocks).sum(),
                                   sum(written["areas"].values()))
        self.assertEqual(len(self.areas(blocks)), n + 5)
        np.testing.assert_allclose(
            np.abs(self.areas(blocks) - voussoir).min(), 0., atol=1e-12)
        # n + 1 radial joints, the extrados cut twice by the backing's top,
        # which is a joint on either side, as the tops of the springers are
        self.assertEqual(written["joints"], n + 1 + n + 2 + 2 + 2)
        self.assertEqual(written["hanging vertices"], 2)
        self.assertAlmostEqual(joints.cell_data["length"].sum(),
                               written["joint length [m]"])

    def test_semicircle(self):
        written, blocks, joints = self.mesh(
            geometry.arch(2., 1., .2, 8), size=.2)
        self.assertEqual((written["joints"], len(self.areas(blocks))), (7, 8))
        np.testing.assert_allclose(
            self.areas(blocks), .5 * np.sin(np.pi / 8) * (1.2 ** 2 - 1.))
        self.assertAlmostEqual(joints.cell_data["length"].sum(), 7 * .2)

    def test_arches_that_are_none(self):
        for words, arguments in (
                ("more than half of span", (2., 1.1, .2, 8)),
                ("thickness = 0", (2., 1., 0., 8)),
                ("voussoirs = 1", (2., 1., .2, 1)),
                ("0.2 or more wide", (2., 1., .2, 8, (.1, .5))),
                ("need springer", (2., 1., .2, 8, None, .5)),
                ("backing = 2", (2., 1., .2, 8, (.3, .5), 2.)),
                ("cover = 0", (2., 1., .2, 8, (.3, .5), None, 0.))):
            with self.assertRaisesRegex(ValueError, words):
                geometry.arch(*arguments)

    def test_bad_words(self):
        for words, arguments in (
                ("either a mesh size", {}),
                ("either a mesh size", {"size": 1., "elements": 2}),
                ("0 elements", {"elements": 0}),
                ("no mesh size for the group 'cap'", {"size": {"brick": 1.}}),
                ("size -1 of the group 'brick'", {"size": -1.}),
                ("the joints have this name",
                 {"size": 1., "boundaries": {"joint": (0., 0., 1., 0.)}}),
                ("no outer edge lies on",
                 {"size": 1., "boundaries": {"base": (0., 9., 1., 9.)}}),
                ("line has no length",
                 {"size": 1., "boundaries": {"base": (0., 9., 0., 9.)}})):
            with self.assertRaisesRegex(ValueError, words):
                geometry.write_geo(self.path, WALL, **arguments)

    def script(self, *words):
        done = subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "polygons"), *words],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            cwd=self.folder)
        return done.returncode, done.stdout, done.stderr

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)
        return name

    def test_script(self):
        rows = [(p.name, p.group, *v) for p in WALL for v in p.vertices]
        for mark in (",", ";"):
            self.write("w.csv", "\n".join(mark.join(map(str, row)) for row in [
                ("name", "group", "x", "y"), *rows]))
            status, text, error = self.script("w.csv", "--size", "0.25")
            self.assertEqual((status, error), (0, ""))
            self.assertIn("w.geo: 3 blocks, 3 joints of 1.75 m in all, 3 vert",
                          text)
        self.write("w.json", json.dumps([p._asdict() for p in WALL]))
        status, text, _ = self.script("w.json", "--size", ".25", "--size",
                                      "cap=.5", "--boundary", "base=0,0,2,0")
        self.assertEqual(status, 0)
        self.assertIn("cap: 0.625 m^2", text)
        with open(os.path.join(self.folder, "w.geo")) as file:
            self.assertIn('Physical Curve("base")', file.read())
        self.assertIn("17 joints", self.script("--elements", "2", "--arch",
            "span=4,rise=1,thickness=.4,voussoirs=16,springer=.8x.5")[1])

    def test_script_refuses(self):
        for words, *arguments in (
                ("'group' is missing", self.write("a.csv", "name,x,y\na,0,0\n")),
                ("could not convert", self.write(
                    "b.csv", "name,group,x,y\na,b,zero,0\n")),
                ("in 'b' before", self.write(
                    "c.csv", "name,group,x,y\na,b,0,0\na,c,0,0\n")),
                ("'vertices' is missing", self.write(
                    "d.json", '[{"name": "a", "group": "b"}]')),
                ("Expecting value", self.write("e.json", "[")),
                ("No such file", "f.csv"), ("no polygons",)):
            status, _, error = self.script(*arguments, "--size", "1")
            self.assertEqual(status, 1)
            self.assertIn(words, error)
            self.assertEqual(len(error.splitlines()), 1)
        for words, text in (("'height=1' is none of", "height=1"),
                            ("rise, thickness, voussoirs is missing",
                             "span=1"), ("'span=x'", "span=x")):
            status, _, error = self.script("--size", "1", "--arch", text)
            self.assertEqual(status, 2)
            self.assertIn(words, error)


if __name__ == "__main__":
    quoin = program_of_words(__doc__)
    unittest.main()
