# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Pictures of a run of blocks for scripts/render: the deformed blocks with
what joint_figure and stress_figure add to them."""

import os

from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
import numpy as np

from quoin import run_parameters, vtu
from quoin.colours import MATERIALS, STONES
from quoin.csv_table import scale_for
from quoin.figures.beam_lines import draw_beams
from quoin.figures.cable_figure import axial_forces, draw_cables
from quoin.figures.figure_style import MAGNITUDES
from quoin.figures.joint_figure import (CrackJoints, DamageJoints, SlipJoints,
                                        StateJoints, WaterJoints, block_size,
                                        contact_forces, draw_contacts,
                                        drawn_position)
from quoin.figures.stress_figure import Contours, Crosses
from quoin.joint_movement import (all_joints, bars_since, blocks_since,
                                  since)
from quoin.moments import check_times
from quoin.shared_motion import enlarged, shared_motion
from quoin.stages import begin, since_text, time_of

LARGEST_TURN = 0.3                   # [rad], see automatic_scale()


def is_in_space(output):
    """Whether the blocks of a run are tetrahedra."""
    path = os.path.join(output, "blocks.pvd")
    if not vtu.exists(path):
        return False
    blocks = vtu.read_at(path)
    return blocks is not None and blocks.cells.shape[1] == 4


class Frame:
    """The fields of one moment; joints and contacts may be None. Joints that
    were handed over have what their contacts bear (joint_movement.py)."""

    def __init__(self, output, time, label=None):
        def series(name):
            path = os.path.join(output, name)
            return vtu.read_at(path, time) if vtu.exists(path) else None

        self.label = label
        self.blocks = series("blocks.pvd")
        self.joints = series("joints.pvd")
        self.contacts = series("contacts.pvd")
        self.cables = series("cables.pvd")
        self.beams = series("beams.pvd")
        if self.blocks is None:
            raise ValueError(f"no blocks are listed in "
                             f"{os.path.join(output, 'blocks.pvd')}; was a "
                             f"field written?")
        if self.blocks.points.shape[1] == 3:
            raise ValueError(f"{output}: blocks in three dimensions are "
                             "drawn by scripts/render alone: take that, or "
                             "open blocks.pvd in ParaView")
        if os.path.basename(os.path.abspath(output)) == "mechanism":
            # the series of a factor of safety lists its fields by it
            self.label = f"factor {self.blocks.time:.4g}"
        for name in ("joints", "contacts", "cables", "beams"):
            # a series that ended earlier says nothing of this moment
            grid = getattr(self, name)
            if grid is not None and grid.time != self.blocks.time:
                setattr(self, name, None)
        self.joints = all_joints(self.joints, self.contacts,
                                 block_size(self.blocks))
        self.shared = shared_motion(self.blocks)

    def count_from(self, then, output):
        """Takes what came after another frame of the same run alone."""
        if then.time >= self.time:
            raise ValueError(f"--since: the fields at {then.time:g} s are not "
                             f"before those that are drawn, at {self.time:g} "
                             "s")
        self.blocks = blocks_since(self.blocks, then.blocks)
        self.shared = shared_motion(self.blocks)
        if self.joints is not None:
            self.joints = since(self.joints, then.joints, run_parameters
                                .of_joint_sets(output, "Shear stiffness"))
        if self.cables is not None:
            self.cables = bars_since(self.cables, then.blocks)
        if self.contacts is not None:
            # of contacts no one knows where they were then
            del self.contacts.point_data["displacement"]

    @property
    def time(self):
        return self.blocks.time

    def position(self, scale):
        """Drawn positions of the blocks' points."""
        X = self.blocks.points
        return enlarged(X, X + self.blocks.point_data["displacement"][:, :2],
                        scale, self.shared)


def round_down(value):
    """1, 2 or 5 times a power of ten, and not below 1."""
    value = max(value, 1.0)
    power = 10.0 ** np.floor(np.log10(value))
    return power * max(f for f in (1.0, 2.0, 5.0) if f * power <= value)


def largest_turn(blocks, x):
    """The largest rotation of a block whose points went to @p x [rad], from the
    best rigid fit."""
    cells, block = blocks.cells, blocks.cell_data["block"]
    node_block = np.empty(len(blocks.points), dtype=int)
    node_block[cells] = block[:, None]
    # blocks share no nodes; a node without cells belongs to none
    used = np.zeros(len(blocks.points), dtype=bool)
    used[cells] = True
    X, x = blocks.points[used], x[used]
    _, owner = np.unique(node_block[used], return_inverse=True)
    count = np.bincount(owner)

    def about_centre(p):
        centre = np.stack([np.bincount(owner, p[:, d]) / count
                           for d in range(2)], axis=1)
        return p - centre[owner]

    X, x = about_centre(X), about_centre(x)
    sine = np.bincount(owner, X[:, 0] * x[:, 1] - X[:, 1] * x[:, 0])
    cosine = np.bincount(owner, X[:, 0] * x[:, 0] + X[:, 1] * x[:, 1])
    return np.abs(np.arctan2(sine, cosine)).max()


def automatic_scale(frame):
    """Shows the largest displacement, rigid translation taken off, as about
    4 % of the size, unless a block would seem turned by more than
    LARGEST_TURN: enlarged rotations blow blocks up. Infinite if nothing has
    moved."""
    blocks = frame.blocks
    x = blocks.points + blocks.point_data["displacement"][:, :2]
    if frame.shared is not None:
        x = frame.shared.taken_off(x)
    u = x - blocks.points
    largest = np.linalg.norm(u - u.mean(axis=0), axis=1).max()
    size = np.ptp(blocks.points, axis=0).max()
    if largest <= 1e-12 * size:
        return np.inf
    turn = max(largest_turn(blocks, x), 1e-12)
    return round_down(min(0.04 * size / largest, LARGEST_TURN / turn))


def outline(blocks):
    """The edges that belong to one cell only: the contours of the blocks."""
    c = blocks.cells
    edges = np.sort(np.concatenate([c[:, [0, 1]], c[:, [1, 2]], c[:, [2, 0]]]))
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return unique[count == 1]


def block_colours(number):
    """Tints of stone that differ between neighbours, and stay with a block."""
    mixed = number.astype(np.uint64) * np.uint64(2654435761) >> np.uint64(7)
    return np.array(STONES)[mixed % np.uint64(len(STONES))]


PER = {"velocity": "/s", "displacement": ""}


def cell_size(blocks, name):
    """Magnitude of a vector, averaged over the corners of each cell."""
    size = np.linalg.norm(blocks.point_data[name], axis=1)
    return size[blocks.cells].mean(axis=1)


def frames_of(output, moments, since):
    """Frames of these moments; with @p since, a time [s] or a stage, of what
    came after the fields nearest to it or to the beginning of that stage."""
    frames = [Frame(output, *moment) for moment in moments]
    if since is not None:
        time = time_of(output, since, begin)
        check_times(output, "blocks.pvd", [time])
        then = Frame(output, time)
        for frame in frames:
            frame.count_from(then, output)
    return frames


class Picture:
    """Draws frames with one scale, one view and one range of colours."""

    DIGITS = 4                       # of a time

    def __init__(self, options, frames):
        self.options = options
        self.scale = options.scale
        if self.scale is None:
            self.scale = min(automatic_scale(f) for f in frames)
            self.scale = self.scale if np.isfinite(self.scale) else 1.0
        self.is_shared = any(f.shared is not None for f in frames)
        if options.view:
            self.low, self.high = np.reshape(options.view, (2, 2))
        else:
            places = [f.position(self.scale) for f in frames]
            places += [drawn_position(f.beams, self.scale, f.shared)[:, :2]
                       for f in frames if f.beams and len(f.beams.cells)]
            self.low = np.min([p.min(axis=0) for p in places], axis=0)
            self.high = np.max([p.max(axis=0) for p in places], axis=0)
        self.extent = self.high - self.low

        self.contours = self.crosses = None
        self.set_sizes(frames)
        if options.colour == "stress":
            self.contours = Contours(frames)
        self.is_panel = len(frames) > 1
        if options.principal:
            size = np.ptp(frames[0].blocks.points, axis=0).max()
            self.crosses = Crosses(frames, size, options.crosses
                                   or (20 if self.is_panel else 32))
        self.joints = None if options.blocks_only else self.joint_style(frames)
        forces = [contact_forces(f.contacts) for f in frames if f.contacts]
        self.force = max([np.quantile(f, 0.99) for f in forces], default=0.0)
        self.axial_force = max([axial_forces(f.cables).max() for f in frames
                                if f.cables and len(f.cables.cells)],
                               default=0.0)

    def set_sizes(self, frames):
        """The range of colours of magnitudes, in the unit of their bar."""
        self.sizes = None
        if self.options.colour in PER:
            # A few extremes must not make all others pale.
            largest = max(np.quantile(cell_size(f.blocks, self.options.colour),
                                      0.99) for f in frames)
            self.factor, self.unit = scale_for("m", largest)
            self.sizes = Normalize(0.0, self.factor * largest or 1.0,
                                   clip=True)

    def joint_style(self, frames):
        if self.options.joints == "mode":
            return CrackJoints(self.options.output, frames,
                               self.options.widest)
        if self.options.joints == "damage":
            return DamageJoints(frames)
        if self.options.joints == "slip":
            return SlipJoints(frames, self.options.widest)
        if self.options.joints == "water":
            return WaterJoints(frames)
        return StateJoints(self.options.since is not None)

    def draw(self, axes, frame, with_count):
        """One moment; returns the handles of the legend."""
        position = frame.position(self.scale)
        axes.grid(False)
        self.draw_blocks(axes, frame.blocks, position)
        handles, contacts = [], []
        if frame.contacts and self.force > 0.0 and self.joints:
            # below the joints that they once were
            contacts = draw_contacts(
                axes, frame.contacts, drawn_position(
                    frame.contacts, self.scale, frame.shared), self.force)
        if frame.joints and self.joints:
            handles += self.joints.draw(
                axes, frame.joints, drawn_position(
                    frame.joints, self.scale, frame.shared), with_count)
        handles += contacts
        if frame.cables and len(frame.cables.cells) and self.joints:
            handles += draw_cables(
                axes, frame.cables, drawn_position(
                    frame.cables, self.scale, frame.shared), self.axial_force)
        if frame.beams and len(frame.beams.cells) and self.joints:
            handles += draw_beams(
                axes, frame.beams, drawn_position(
                    frame.beams, self.scale, frame.shared), self.options.beams)
        margin = 0.0 if self.options.view else 0.02 * self.extent.max()
        below = margin
        if self.crosses:
            handles += self.crosses.draw(axes, frame, position,
                                         0.7 if self.is_panel else 0.9)
            strip = 0.06 * self.extent.max()
            self.crosses.draw_bar(axes, self.low - [0.0, margin], strip)
            below += strip
        axes.set_xlim(self.low[0] - margin, self.high[0] + margin)
        axes.set_ylim(self.low[1] - below, self.high[1] + margin)
        axes.set_aspect("equal")
        return handles

    def draw_blocks(self, axes, blocks, position):
        contour = position[outline(blocks)]
        show_mesh = self.options.mesh
        if self.contours:
            self.contours.draw(axes, blocks, position)
        else:
            colours = self.colours(blocks)
            axes.add_collection(PolyCollection(
                position[blocks.cells], facecolors=colours,
                edgecolors="0.75" if show_mesh else colours,
                linewidths=0.15 if show_mesh else 0.4))
        axes.add_collection(
            LineCollection(contour, colors="0.35", linewidths=0.4))

    def colours(self, blocks):
        """Colours of the cells."""
        if self.sizes:
            return MAGNITUDES(self.sizes(
                self.factor * cell_size(blocks, self.options.colour)))
        if self.options.colour == "block":
            return block_colours(blocks.cell_data["block"])
        return np.array(MATERIALS)[
            blocks.cell_data["material"] % len(MATERIALS)]

    def caption(self, frame, form):
        """Which moment it is, by its time in this form."""
        return frame.label or f"t = {frame.time:.{form}} s"

    def remark(self):
        """Remark that applies to all output times."""
        words = [] if self.scale == 1.0 else [
            f"displacements × {self.scale:g}"
            + (" without the motion of the whole" if self.is_shared else "")]
        if self.options.since is not None:
            words.append(since_text(self.options.since))
        return ", ".join(words)

    def colour_bars(self):
        """(mappable, label) of each scale of colours."""
        bars = []
        if self.sizes:
            name = self.options.colour
            bars.append((ScalarMappable(self.sizes, MAGNITUDES),
                         f"{name} [{self.unit}{PER[name]}]"))
        if self.contours:
            bars.append((self.contours.mappable(),
                         f"minor principal stress [{self.contours.unit}]"))
        if self.joints and self.joints.mappable():
            bars.append((self.joints.mappable(), self.joints.bar_label))
        return bars
