#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Traces from tables and drawings: what is read, what is cut where, and that
the program reads the files that are left."""
import os
import subprocess
import sys
import unittest

import numpy as np

from synthetic_runs import SCRIPTS, Scratch, program_of_words
from quoin import traces

CASE = """set Plane assumption = plane strain
subsection Rock
  set Outline      = 0, 0; 10, 0; 10, 10; 0, 10
  set Element size = 2
end
subsection Rock joints
  set Names = J1
  subsection J1
    set Kind = traces
    set File = map_J1.csv
  end
end
subsection Materials
  set Names = rock
  subsection rock
    set Density         = 2600
    set Young's modulus = 1e10
    set Poisson's ratio = 0.25
  end
end
subsection Joints
  set Names = J1
  subsection J1
    set Law              = Coulomb
    set Normal stiffness = 1e9
    set Shear stiffness  = 1e9
    set Friction angle   = 30
  end
end
subsection Loads
  set Names = gravity
  subsection gravity
    set Type     = gravity
    set Vertical = -9.81
  end
end
subsection Stages
  set Names = fall
  subsection fall
    set Loads    = gravity
    set End      = time
    set Duration = 1e-4
  end
end
"""
SQUARE = np.array([[0., 0.], [10., 0.], [10., 10.], [0., 10.]])
# a U, open upwards
NOTCHED = np.array([[0., 0.], [10., 0.], [10., 10.], [7., 10.], [7., 4.],
                    [3., 4.], [3., 10.], [0., 10.]])
# codes and values of entities
DRAWING = [
    (0, "SECTION"), (2, "BLOCKS"), (0, "LINE"), (10, 9), (20, 9), (11, 8),
    (21, 8), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES"),
    (0, "LINE"), (5, "1A"), (8, "J1"), (10, -1), (20, 2), (30, 7), (11, 12),
    (21, 2), (31, 7),
    (0, "LWPOLYLINE"), (5, "1B"), (8, "J2"), (90, 3), (70, 1), (10, 1),
    (20, 1), (10, 4), (20, 1), (42, 0.5), (10, 4), (20, 5),
    (0, "POLYLINE"), (5, "1C"), (8, "J1"), (66, 1), (10, 0), (20, 0), (70, 0),
    (0, "VERTEX"), (8, "J1"), (10, 5), (20, 5),
    (0, "VERTEX"), (8, "J1"), (10, 5), (20, 15),
    (0, "SEQEND"), (0, "CIRCLE"), (8, "J1"), (10, 0), (20, 0), (40, 3),
    (0, "ENDSEC"), (0, "EOF")]


class Files(Scratch):
    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def drawing(self, pairs):
        return self.write("map.dxf", "\n".join(f"{c:3}\n{v}"
                                               for c, v in pairs) + "\n")

    def script(self, *words):
        done = subprocess.run(
            [sys.executable, os.path.join(SCRIPTS, "traces"), *words],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            cwd=self.folder)
        return done.returncode, done.stdout, done.stderr


class Read(Files):
    def test_tables(self):
        for text in ("# a map\nid,set,x1,y1,x2,y2\na,J1,0,.5,3,4\n,,1,2,3,4\n",
                     "Set;Y1 [m];X1 [m];X2 [m];Y2 [m];ID\n"
                     "J1;0,5;0;3;4;a\n\n;2,0;1;3;4;\n",
                     "set\tx1\ty1\tx2\ty2\tid\nJ1\t0,0\t,5\t3\t4\ta\n"
                     "\t1\t2\t3\t4\t\n",
                     "\ufeffx1 (m), y1, x2, y2, note, id, set\n"
                     "0,.5,3,4,\"x, y\",a,J1\n1,2,3,4,,,\n"):
            found, passed = traces.read(self.write("map.csv", text))
            self.assertEqual(passed, {})
            self.assertEqual([t.set for t in found], ["J1", "traces"])
            self.assertEqual(found[0].name, "a")
            np.testing.assert_array_equal(found[0].points, [[0., .5], [3., 4.]])
            np.testing.assert_array_equal(found[1].points, [[1., 2.], [3., 4.]])

    def test_layers(self):
        path = self.drawing(DRAWING)
        found, passed = traces.read(path, ["J2"])
        self.assertEqual([t.name for t in found], ["1B"])
        self.assertEqual(passed["traces of J1"], 2)
        with self.assertRaisesRegex(ValueError, "in 'J3'; there are in J1, J2"):
            traces.read(path, ["J2", "J3"])

    def test_traces_without_length(self):
        found, passed = traces.read(self.write(
            "map.csv", "x1,y1,x2,y2\n0,0,1,1\n2,2,2,2\n"))
        self.assertEqual((len(found), passed), (1, {"traces without length":
                                                    1}))

    def test_mean_dip(self):
        """Mean dip of steep traces that lean to both sides of the vertical."""
        def trace(angle, length, turned=1.):
            way = length * turned * np.array([np.cos(np.radians(angle)),
                                              np.sin(np.radians(angle))])
            return traces.Trace("a", "J", np.array([[0., 0.], way]))
        dip, deviation = traces.mean_dip([trace(88., 1.), trace(-84., 1., -1.)])
        self.assertAlmostEqual(dip % 180., 92.)
        self.assertAlmostEqual(deviation, 4., delta=0.02)
        dip, deviation = traces.mean_dip([trace(20., 3.), trace(200., 1.)])
        self.assertAlmostEqual(dip, 20.)
        self.assertAlmostEqual(deviation, 0., delta=1e-5)
        deviation = traces.mean_dip([trace(30., 40.)])[1]
        self.assertEqual(f"{deviation:.1f}", "0.0")

    def test_unit_that_a_drawing_names(self):
        head = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015"),
                (9, "$INSUNITS"), (70, 4), (0, "ENDSEC")]
        self.assertEqual(traces.unit_of_drawing(self.drawing(head + DRAWING)),
                         "mm")
        status, text, _ = self.script("map.dxf")
        self.assertEqual(status, 0)
        self.assertIn("read 3 traces, x -1 to 12 m, y 1 to 15 m, 10 to 13 m long",
                      text)
        self.assertIn("its unit is mm; taken for m: see --unit", text)
        text = self.script("map.dxf", "--unit", "mm")[1]
        self.assertIn("x -0.001 to 0.012 m", text)
        self.assertNotIn("the drawing says", text)
        self.assertIsNone(traces.unit_of_drawing(self.drawing(DRAWING)))

    def test_polylines(self):
        found, _ = traces.read(self.write(
            "map.csv", "id,x,y\na,0,0\nb,5,5\na,1,0\nb,6,6\na,1,1\n"))
        np.testing.assert_array_equal(found[0].points,
                                      [[0., 0.], [1., 0.], [1., 1.]])
        self.assertEqual(len(found[1].points), 2)

    def test_bad_tables(self):
        for words, text in (
                ("needs x1, y1, x2, y2", "a,b\n1,2\n"),
                ("needs x1, y1, x2, y2", ""),
                ("line 3: could not convert", "x1,y1,x2,y2\n0,0,1,1\n0,0,o,1\n"),
                ("line 2: has too few", "x1,y1,x2,y2\n0,0,1\n"),
                ("line 2: 'nan'", "x1,y1,x2,y2\n0,0,1,nan\n"),
                ("'a' has one point", "id,x,y\na,1,2\n")):
            with self.assertRaisesRegex(ValueError, "map.csv.*" + words):
                traces.read(self.write("map.csv", text))

    def test_drawing(self):
        found, passed = traces.read(self.drawing(DRAWING))
        self.assertEqual(passed, {"CIRCLE": 1,
                                  "arcs in polylines, now chords": 1})
        self.assertEqual([(t.name, t.set) for t in found],
                         [("1A", "J1"), ("1B", "J2"), ("1C", "J1")])
        for trace, points in zip(found, (
                [[-1, 2], [12, 2]], [[1, 1], [4, 1], [4, 5], [1, 1]],
                [[5, 5], [5, 15]])):
            np.testing.assert_array_equal(trace.points, points)

    def test_bad_drawings(self):
        for words, text in (("binary DXF", "AutoCAD Binary DXF\r\n\x1a\0"),
                            ("line 3: 'x' is no group", "0\nSECTION\nx\ny\n")):
            with self.assertRaisesRegex(ValueError, words):
                traces.read(self.write("map.dxf", text))


class Cuts(Files):
    def cut(self, points, outline=SQUARE):
        return traces.cut(traces.Trace("a", "J", np.array(points, float)),
                          outline)

    def test_within_and_outside(self):
        one = self.cut([(1, 1), (4, 5)])
        self.assertEqual((one.length, one.inside, one.lost), (5., 5., []))
        one = self.cut([(11, 1), (14, 5)])
        self.assertEqual((one.length, one.inside, one.parts), (5., 0., []))
        np.testing.assert_allclose(one.lost, [[12.5, 3.]])

    def test_through_a_notch(self):
        one = self.cut([(-1, 6), (11, 6)], NOTCHED)
        self.assertAlmostEqual(one.inside, 6.)
        np.testing.assert_allclose(one.parts, [[(0, 6), (3, 6)],
                                               [(7, 6), (10, 6)]])
        np.testing.assert_allclose(one.lost, [(-.5, 6), (5, 6), (10.5, 6)])

    def test_a_polyline_stays_in_one_piece(self):
        one = self.cut([(-2, 5), (5, 5), (5, 12)])
        self.assertEqual(len(one.parts), 1)
        np.testing.assert_allclose(one.parts[0], [(0, 5), (5, 5), (5, 10)])
        self.assertAlmostEqual(one.length - one.inside, 4.)

    def test_outline(self):
        np.testing.assert_array_equal(
            traces.read_outline("0, 0; 10, 0; 10, 10; 0, 10"), SQUARE)
        for text in ("0,0; 1,1", "0,0; 1; 1,1", "a,b; 1,1; 2,2"):
            with self.assertRaisesRegex(ValueError, "three or more points"):
                traces.read_outline(text)

    def test_files_that_the_program_reads(self):
        """A persistent joint makes two blocks of the rock."""
        self.drawing(DRAWING)
        status, text, error = self.script(
            "map.dxf", "--outline", "0, 0; 10, 0; 10, 10; 0, 10")
        self.assertEqual((status, error), (0, ""))
        for line in ("1 CIRCLE were passed over",
                     "1 arcs in polylines, now chords",
                     "J1: 2 traces of 23 m, dip 0.0 +- 57.8 degrees, 0 of "
                     "0 m outside, 2 cut by 8 m: map_J1.csv",
                     "J2: 1 traces of 12 m, dip 58.3 +- ",
                     "0 of 0 m outside, 0 cut by 0 m: map_J2.csv",
                     "trace 1A is outside at (-0.5, 2) m",
                     "all 3 places are in map_cut.csv"):
            self.assertIn(line, text)
        with open(os.path.join(self.folder, "map_cut.csv")) as file:
            self.assertEqual(file.read().splitlines()[1:],
                             ["1A,J1,13,10,-0.5,2", "1A,J1,13,10,11,2",
                              "1C,J1,10,5,5,12.5"])
        done = subprocess.run([quoin, "--check", self.write("case.prm", CASE)],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, check=True)
        self.assertIn("joints 'J1': 2 traces, 15 m in the rock, of which "
                      "10 m are joints",
                      done.stdout + done.stderr)
        self.assertIn("2 blocks", done.stdout)

    def test_scale_and_shift(self):
        self.write("map.csv", "x1,y1,x2,y2\n1000,2000,4000,6000\n")
        status, text, _ = self.script("map.csv", "--scale", "1e-3", "--shift",
                                      "-1,-2", "--out", "face")
        self.assertEqual(status, 0)
        self.assertIn("1 traces of 5 m", text)
        with open(os.path.join(self.folder, "face_traces.csv")) as file:
            self.assertEqual(file.read(), "x1,y1,x2,y2\n0,0,3,4\n")

    def test_script_refuses(self):
        empty = self.drawing(DRAWING[:10] + DRAWING[-8:])
        two = self.write("two.csv", "set,x1,y1,x2,y2\nJ 1,0,0,1,1\n"
                         "J_1,0,0,1,1\n")
        for words, *arguments in (
                ("no traces in it; it has 1 CIRCLE", empty),
                ("would go to", two), ("three or more", two, "--outline", "0"),
                ("No such file", "no.csv")):
            status, _, error = self.script(*arguments)
            self.assertEqual(status, 1)
            self.assertIn(words, error)
            self.assertEqual(len(error.splitlines()), 1)


if __name__ == "__main__":
    quoin = program_of_words(__doc__)
    unittest.main()
