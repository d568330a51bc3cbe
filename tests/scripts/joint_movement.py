#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Joints that were handed over to contacts, and what came after a time, on two
blocks whose motion is known."""
import os
import tempfile
import types
import unittest

import numpy as np

from synthetic_runs import SLID, WIDE, NOTHING, joint_grid, write_run
from quoin import joint_movement
from quoin.figures import block_figure, joint_figure
from quoin.joint_states import INTACT, OPEN, SLIPPED, SLIPPING
from quoin.vtu import Grid

# a block of one square below y = 1 and one above, with a joint of two faces
POINTS = np.array([[0., 0.], [2., 0.], [2., 1.], [1., 1.], [0., 1.],
                   [0., 1.], [1., 1.], [2., 1.], [2., 2.], [0., 2.]])
# of both senses
CELLS = np.array([[0, 1, 3], [1, 2, 3], [0, 4, 3], [5, 6, 9], [6, 8, 9],
                  [6, 8, 7]])
IS_UPPER = np.arange(10) >= 5


def moved_blocks(angle=0., shift=(0., 0.), slip=0., opening=0., time=1.):
    """Both turned and shifted, the upper one also along and off the joint."""
    turn = np.array([[np.cos(angle), -np.sin(angle)],
                     [np.sin(angle), np.cos(angle)]])
    x = (POINTS + np.outer(IS_UPPER, [slip, opening])) @ turn.T + shift
    return Grid(time, POINTS, CELLS, {
        "displacement": np.hstack([x - POINTS, np.zeros((10, 1))])}, {
        "block": np.repeat([0, 1], 3)})


def faces(ends=((0., 1.), (2., 1.))):
    """Faces of the joint at the start, at these ends of x; nothing moved."""
    x = np.array(ends).ravel()
    n = len(x)
    none = np.zeros(n)
    return Grid(0., np.stack([x, none + 1.], axis=1),
                np.arange(n).reshape(-1, 2),
                {"displacement": np.zeros((n, 3)), "opening": none,
                 "slip": none, "normal traction": none,
                 "shear traction": none, "damage": none, "crushing": none,
                 "point state": np.zeros(n, dtype=np.uint8)},
                {"length": np.ones(n // 2),
                 "joint set": np.arange(n // 2, dtype=np.int32),
                 "state": np.zeros(n // 2, dtype=np.uint8)})


class HandedOver(unittest.TestCase):
    def shown(self, contacts=None, slip=0., opening=0., over=(1, 1),
              farthest=1.):
        joints = faces()
        joints.point_data["slip"] = np.full(4, slip)
        joints.point_data["opening"] = np.full(4, opening)
        joints.cell_data["handed over"] = np.array(over, dtype=np.uint8)
        joints.cell_data["state"][:] = OPEN
        return joint_movement.all_joints(joints, contacts, farthest)

    def test_blocks_that_went_away(self):
        self.assertIsNone(self.shown(slip=0.8, opening=0.8))
        self.assertEqual(len(self.shown(slip=0.8, opening=0.8, farthest=1.2)
                             .cells), 2)
        found = self.shown(slip=-0.8, opening=0.8, over=(0, 1))
        self.assertEqual(list(found.cell_data["joint set"]), [0])
        self.assertIsNone(joint_movement.all_joints(None, None, 1.))

    def test_what_a_contact_on_the_line_says(self):
        # on the first face alone
        contact = faces(((0.1, 0.9),))
        contact.point_data["shear traction"] = np.full(2, 5e3)
        contact.point_data["crushing"] = np.full(2, 2e-4)
        contact.cell_data["state"] = np.array([SLIPPING], dtype=np.uint8)
        found = self.shown(contacts=contact, slip=0.01, opening=1e-5)
        self.assertEqual(list(found.cell_data["state"]), [SLIPPING, OPEN])
        data = found.point_data
        np.testing.assert_array_equal(data["shear traction"],
                                      [5e3, 5e3, 0., 0.])
        np.testing.assert_array_equal(data["crushing"], [2e-4, 2e-4, 0., 0.])
        np.testing.assert_array_equal(data["slip"], 0.01)
        # one that is no contact keeps its own
        found = self.shown(contacts=contact, over=(0, 1))
        self.assertEqual(list(found.cell_data["state"]), [OPEN, OPEN])


class Since(unittest.TestCase):
    def since(self, opening, slip, then, states=(3, 3), traction=0.):
        now = joint_grid(opening, slip, turned=[1])
        now.cell_data["state"] = np.array(states, dtype=np.uint8)
        now.point_data["shear traction"] = np.full(4, traction)
        return joint_movement.since(now, then, [1e9])

    def test_what_was_there_before_is_taken_off(self):
        found = self.since([[3e-4, 1e-4], [0., 4e-4]], SLID,
                           joint_grid(WIDE, NOTHING, order=[1, 0]))
        # turned faces come in the order of now
        np.testing.assert_allclose(
            found.point_data["opening"][found.cells],
            [[1e-4, 1e-4], [1e-4, 0.]], atol=1e-18)
        np.testing.assert_allclose(found.point_data["slip"][found.cells],
                                   [[0., 0.], [0., -2e-4]], atol=1e-18)
        np.testing.assert_allclose(
            found.point_data["displacement"][found.cells][..., 0],
            0.1 * found.point_data["opening"][found.cells], atol=1e-18)

    def test_states_of_what_moved(self):
        before = joint_grid(NOTHING, SLID)
        still = self.since(NOTHING, [[0., 1e-4], [-2e-4, 0.]], before, (1, 2))
        self.assertEqual(list(still.cell_data["state"]), [SLIPPING, INTACT])
        # 1 MPa strains the joint by 1 mm along: no slip that stays
        elastic = self.since(NOTHING, [[1e-3, 1e-3], [1e-3, 2e-3]], before,
                             (2, 2), traction=1e6)
        self.assertEqual(list(elastic.cell_data["state"]), [INTACT, SLIPPED])
        self.assertEqual(list(self.since(NOTHING, SLID, before)
                              .cell_data["state"]), [INTACT, INTACT])

    def test_closing_is_no_opening(self):
        found = self.since([[-1e-3, -1e-3], [0., 0.]], NOTHING,
                           joint_grid([[-2e-3, -2e-3], [0., 0.]], NOTHING))
        self.assertEqual(list(found.cell_data["state"]), [INTACT, INTACT])

    def test_blocks(self):
        then, now = moved_blocks(slip=0.1), moved_blocks(slip=0.3, angle=0.2)
        found = joint_movement.blocks_since(now, then)

        def place(blocks):
            return blocks.points + blocks.point_data["displacement"][:, :2]
        np.testing.assert_allclose(found.points, place(then))
        np.testing.assert_allclose(place(found), place(now))
        # then: the upper block alone, its points in another order
        other = np.array([9, 5, 8, 7, 6])
        half = Grid(0., POINTS[other], np.array([[1, 4, 0]]), {
            "displacement": then.point_data["displacement"][other]}, {
            "block": np.array([1])})
        half.cells = np.array([[1, 4, 0], [4, 2, 3], [4, 3, 2]])
        half.cell_data = {"block": np.ones(3, dtype=int)}
        found = joint_movement.blocks_since(now, half)
        np.testing.assert_allclose(found.points[5:], place(then)[5:])
        np.testing.assert_allclose(found.points[:5], POINTS[:5])
        np.testing.assert_allclose(place(found), place(now))


def reset(grid, earlier, earlier_slip=None):
    """The grid as a run writes it if displacements, and slips, were reset
    where they were @p earlier."""
    data = {**grid.point_data, "earlier displacement": earlier,
            "displacement": grid.point_data["displacement"] - earlier}
    points = grid.points
    if earlier_slip is None:  # joints lie where they are now
        points = points + earlier[:, :2]
    else:
        data["earlier slip"] = earlier_slip
        data["slip"] = data["slip"] - earlier_slip
    return Grid(grid.time, points, grid.cells, data, grid.cell_data)


class AfterAReset(unittest.TestCase):
    """Nothing of what scripts compare is another one."""

    then = moved_blocks(angle=0.1, slip=0.05, time=1.)
    now = moved_blocks(angle=0.3, shift=(1., 0.), slip=0.2, opening=1e-3,
                       time=2.)

    def same(self, one, other):
        np.testing.assert_allclose(one.points, other.points, atol=1e-14)
        for name, values in one.point_data.items():
            np.testing.assert_allclose(other.point_data[name], values,
                                       atol=1e-14)

    def test_blocks(self):
        seen = reset(self.now, self.then.point_data["displacement"])
        # where they are and what they did is all that the reset leaves
        np.testing.assert_allclose(
            seen.points + seen.point_data["displacement"][:, :2],
            self.now.points + self.now.point_data["displacement"][:, :2])
        self.same(joint_movement.blocks_since(self.now, self.then),
                  joint_movement.blocks_since(seen, self.then))

    def whole(self, slip, opening, time):
        """Joints that have moved, in a run without reset."""
        joints = faces()
        joints.time = time
        joints.points = joints.points + [0.5 * slip, 0.5 * opening]
        joints.point_data["displacement"] = np.tile(
            [0.5 * slip, 0.5 * opening, 0.], (4, 1))
        joints.point_data["slip"] = slip * np.array([1., 2., 3., 4.])
        joints.point_data["opening"] = np.full(4, opening)
        return joints

    def test_joints(self):
        then, now = self.whole(0.05, 0., 1.), self.whole(0.2, 1e-3, 2.)
        seen = reset(now, then.point_data["displacement"],
                     then.point_data["slip"])
        stiffness = [1e9, 1e9]
        self.same(joint_movement.since(now, then, stiffness),
                  joint_movement.since(seen, then, stiffness))

    def test_faces_handed_over(self):
        """They are as far apart as they are since the start, and contacts have
        no earlier part."""
        now = self.whole(0.2, 0., 2.)
        now.cell_data["handed over"] = np.array([0, 1], dtype=np.uint8)
        seen = reset(now, now.point_data["displacement"],
                     now.point_data["slip"])
        contacts = faces([(1., 2.)])
        contacts.points = contacts.points + [0.1, 0.]
        contacts.point_data["normal traction"] = np.full(2, -5.)
        contacts.cell_data["state"][:] = SLIPPING
        shown = joint_movement.all_joints(seen, contacts, 1.)
        self.assertEqual(list(shown.cell_data["state"]), [INTACT, SLIPPING])
        np.testing.assert_allclose(shown.point_data["normal traction"],
                                   [0., 0., -5., -5.])
        np.testing.assert_allclose(shown.point_data["slip"], 0., atol=1e-15)
        np.testing.assert_allclose(shown.point_data["earlier slip"],
                                   now.point_data["slip"])
        self.assertEqual(
            len(joint_movement.all_joints(seen, None, 0.5).cells), 1)


class Pictures(unittest.TestCase):
    def test_scale_of_slip(self):
        frame = types.SimpleNamespace(joints=joint_grid(WIDE, [[-3e-3, -1e-3],
                                                               [0., 0.]]))
        style = joint_figure.SlipJoints([frame])
        self.assertAlmostEqual(style.size.vmax, 0.99 * 2., delta=1e-9)
        self.assertEqual(style.bar_label, "slip of joints [mm]")
        self.assertEqual(joint_figure.SlipJoints([frame], 0.5).size.vmax, 0.5)
        self.assertEqual(joint_figure.SlipJoints([frame], 0.5).bar_label,
                         "slip of joints [m]")

    def test_frames_of_a_run(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = os.path.join(scratch, "run")
            write_run(folder, [0., 1.], [0., 1.],
                      {0: joint_grid(NOTHING, NOTHING),
                       1: joint_grid(NOTHING, SLID),
                       2: joint_grid(NOTHING, WIDE)})
            frame, = block_figure.frames_of(folder, [(2, None)], 1)
            np.testing.assert_allclose(frame.joints.point_data["slip"],
                                       [2e-4, 0., 2e-4, 3e-4])
            for time, words in ((2, "not before"), (9, "no field was written")):
                with self.assertRaisesRegex(ValueError, words):
                    block_figure.frames_of(folder, [(2, None)], time)


if __name__ == "__main__":
    unittest.main()
