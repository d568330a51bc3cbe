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

from synthetic_runs import (SLID, WIDE, NOTHING, Scratch, joint_grid,
                            write_run)
from quoin import damage_table, joint_movement, shared_motion, stages
from quoin.commands import joint_damage
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

    def test_a_block_that_turned_over(self):
        joints = faces()
        joints.cell_data["handed over"] = np.ones(2, dtype=np.uint8)
        for turn, shown in ((50., [0, 1]), (70., [0])):
            gap = 2. * np.sin(np.radians(turn / 2.))
            joints.point_data["opening"] = np.array([0., 0., 0., gap])
            found = joint_movement.all_joints(joints, None, 1.)
            self.assertEqual(list(found.cell_data["joint set"]), shown)

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


def bar_in(blocks):
    """A bolt from the lower block to the upper one, where these are."""
    X = np.array([[1.5, 0.25], [1.5, 0.75], [0.5, 1.25], [0.75, 1.5]])
    u = np.zeros((4, 3))
    for k, corners in enumerate(([1, 2, 3], [1, 2, 3], [5, 6, 9], [6, 8, 9])):
        # affine in each cell, and in each block
        A = np.column_stack([blocks.points[corners], np.ones(3)])
        u[k] = np.append(X[k], 1.) @ np.linalg.solve(
            A, blocks.point_data["displacement"][corners])
    return Grid(blocks.time, X + u[:, :2], np.arange(4).reshape(-1, 2),
                {"displacement": u, "bond slip": np.zeros(4)}, {})


def reset(grid, earlier, earlier_slip=None):
    """The grid as a run writes it if displacements, and slips, were reset
    where they were @p earlier."""
    data = {**grid.point_data, "earlier displacement": earlier,
            "displacement": grid.point_data["displacement"] - earlier}
    points = grid.points
    if earlier_slip is None:
        # joints and bars lie where they are now
        points = points + earlier[:, :2] * ("bond slip" not in data)
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

    def test_bars(self):
        before, whole = bar_in(self.then), bar_in(self.now)
        seen = reset(whole, before.point_data["displacement"])
        found = joint_movement.bars_since(seen, self.then)
        np.testing.assert_allclose(
            found.point_data["displacement"],
            whole.point_data["displacement"]
            - before.point_data["displacement"], atol=1e-14)
        self.same(joint_movement.bars_since(whole, self.then), found)
        # enlarged they stay in their blocks
        np.testing.assert_allclose(
            joint_figure.drawn_position(found, 20.), before.points
            + 20. * (whole.points - before.points), atol=1e-12)

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


class Stages(Scratch):
    def setUp(self):
        super().setUp()
        self.folder = os.path.join(self.folder, "run")
        write_run(self.folder, [0., 1.], [0., 1.],
                  {0: joint_grid(NOTHING, NOTHING),
                   1: joint_grid(NOTHING, SLID),
                   2: joint_grid(NOTHING, WIDE)}, ends={"settle": 1.})

    def test_times(self):
        self.assertEqual(stages.times_or_names("1e-3, push"), [1e-3, "push"])
        for name, at, wanted in (("settle", stages.begin, 0.),
                                 ("settle", stages.end, 1.),
                                 ("push", stages.begin, 1.)):
            self.assertEqual(stages.time_of(self.folder, name, at), wanted)
        self.assertEqual(stages.time_of(self.folder, 3., stages.end), 3.)
        for at in (stages.begin, stages.end):
            self.assertEqual(stages.time_of(self.folder, "push + 0.25", at),
                             1.25)
        self.assertEqual(stages.stage_and_time("push+pull"),
                         ("push+pull", None))
        self.assertEqual([stages.since_text(moment) for moment in
                          (0.5, "push", "push+1e-3")],
                         ["since t = 0.5 s", "since push began",
                          "since 0.001 s after push began"])
        self.assertIsNone(stages.time_of(self.folder, None, stages.begin))

    def test_names_that_are_none(self):
        for name, at, words in (
                ("pull", stages.begin, "nor a stage; these are settle, push"),
                ("push", stages.end, "that has ended; these are settle")):
            with self.assertRaisesRegex(ValueError, words):
                stages.time_of(self.folder, name, at)
        os.remove(os.path.join(self.folder, "summary.json"))
        with self.assertRaisesRegex(ValueError, "once one has ended"):
            stages.begin(self.folder, "push")

    def test_since_a_stage_began(self):
        frame, = block_figure.frames_of(self.folder, [(2, None)], "push")
        np.testing.assert_allclose(frame.joints.point_data["slip"],
                                   [2e-4, 0., 2e-4, 3e-4])

    def test_damage_since_a_stage_began(self):
        times, length, columns = damage_table.read(self.folder, (), 1.)
        self.assertEqual(list(times), [1., 2.])
        self.assertEqual(list(length), [3., 3.])
        self.assertEqual(columns["failed"][0], 0.)
        whole = damage_table.read(self.folder)
        self.assertEqual(list(whole[0]), [0., 1., 2.])
        with self.assertRaisesRegex(ValueError, "no field was written"):
            damage_table.read(self.folder, (), 99.)


    def test_one_threshold_for_all_moments(self):
        """A joint that opened by 1 um counts neither then nor later, when
        another one opens by 1 mm."""
        little, much = [[1e-6, 1e-6], [0., 0.]], [[1e-6, 1e-6], [1e-3, 1e-3]]
        folder = self.folder + "_2"
        write_run(folder, [0., 1.], [0., 1.],
                  {k: joint_grid(opening, NOTHING)
                   for k, opening in enumerate((NOTHING, little, much))})
        columns = damage_table.read(folder, (), 0.)[2]
        self.assertEqual(list(columns["failed"]), [0., 0., 2.])


    def test_joints_that_are_excavated_have_not_failed(self):
        """Faces of 1 and 2 m, of which the first is open by 0.2 mm at an end,
        both there, then the first one alone, then none."""
        folder = self.folder + "_3"
        both = joint_grid(WIDE, NOTHING)
        write_run(folder, [0., 1., 2.], [0., 0., 0.], {
            0: both, 1: joint_grid(WIDE, NOTHING, [0]), 2: joint_grid([], [])})
        times, length, columns = damage_table.read(folder)
        self.assertEqual(list(length), [3., 1., 0.])
        self.assertEqual(list(columns["failed"]), [1.5, 0.5, 0.])
        np.testing.assert_allclose(
            joint_damage.share(columns["failed"], length),
            [50., 50., np.nan])

    def test_joints_that_are_placed_later(self):
        """They are intact, not less than failed, and count from zero."""
        folder = self.folder + "_4"
        write_run(folder, [0., 1., 2.], [0., 0., 0.], {
            0: joint_grid([], []), 1: joint_grid(NOTHING, NOTHING, [0]),
            2: joint_grid(WIDE, NOTHING)})
        for since in (None, 0.):
            _, length, columns = damage_table.read(folder, (), since)
            self.assertEqual(list(length), [0., 1., 3.])
            self.assertEqual(list(columns["failed"]), [0., 0., 1.5])


class SharedMotion(unittest.TestCase):
    def grid(self, x):
        return Grid(0., POINTS, CELLS, {
            "displacement": np.hstack([x - POINTS, np.zeros((10, 1))])}, {})

    def drawn(self, x, scale=10.):
        return shared_motion.enlarged(
            POINTS, x, scale, shared_motion.shared_motion(self.grid(x)))

    def test_a_shaken_table(self):
        """The lower block is drawn where it was, the slip of the other one ten
        times as long."""
        x = POINTS + [0.3, -0.1] + np.outer(IS_UPPER, [0.02, 0.01])
        np.testing.assert_allclose(
            self.drawn(x), POINTS + np.outer(IS_UPPER, [0.2, 0.1]),
            atol=1e-14)
        np.testing.assert_allclose(self.drawn(x, 1.), x)

    def test_a_turn_of_the_whole(self):
        for angle in (0.6, 2.5, 3.14159):
            blocks = moved_blocks(angle=angle, shift=(5., 1.), slip=1e-3)
            motion = shared_motion.shared_motion(blocks)
            self.assertAlmostEqual(motion.turn, angle)
            moved = self.drawn(POINTS
                               + blocks.point_data["displacement"][:, :2])
            np.testing.assert_allclose(
                moved - POINTS, np.outer(IS_UPPER - 0.5, [10. * 1e-3, 0.]),
                atol=1e-12)

    def test_what_is_no_motion_of_the_whole(self):
        lean = np.outer(POINTS[:, 1], [0.1, 0.])
        at_rest = np.where(IS_UPPER[:, None], [0.3, 0.], 0.)
        opposite = np.where(IS_UPPER[:, None], [0.3, 0.], [-0.2, 0.])
        # as on a hinge at the corner
        turn = POINTS @ [[0., 0.1], [-0.1, 0.]]
        for u in (lean, at_rest, opposite, turn, np.zeros((10, 2)),
                  np.tile([1e-3, 0.], (10, 1)) + 20. * at_rest):
            self.assertIsNone(
                shared_motion.shared_motion(self.grid(POINTS + u)))

    def test_a_shear_on_a_shaken_table_does_not_turn_it(self):
        x = POINTS + [1., 0.] + np.outer(POINTS[:, 1], [0.1, 0.])
        motion = shared_motion.shared_motion(self.grid(x))
        self.assertEqual(motion.turn, 0.)
        np.testing.assert_allclose(motion.shift, [1., 0.])

    def test_joints_stay_on_their_blocks(self):
        blocks = moved_blocks(angle=0.6, shift=(5., 1.), slip=1e-3)
        motion = shared_motion.shared_motion(blocks)
        at = np.flatnonzero(IS_UPPER)[:2]
        u = blocks.point_data["displacement"][at]
        joints = Grid(0., POINTS[at] + u[:, :2], np.array([[0, 1]]),
                      {"displacement": u}, {})
        x = POINTS + blocks.point_data["displacement"][:, :2]
        np.testing.assert_allclose(
            joint_figure.drawn_position(joints, 10., motion),
            self.drawn(x)[at])

    def test_in_space(self):
        corners = np.vstack([np.zeros(3), np.eye(3)])
        u = np.tile([0., 0., 2.], (4, 1)) + 0.1 * corners
        motion = shared_motion.shared_motion(Grid(
            0., corners, np.array([[0, 1, 2, 3]]), {"displacement": u}, {}))
        np.testing.assert_allclose(motion.shift, [0., 0., 2.])
        np.testing.assert_allclose(motion.taken_off(corners + u),
                                   1.1 * corners)


if __name__ == "__main__":
    unittest.main()
