# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Joints and contacts for scripts/render: joints by their state, as cracks by
mode and width, by their damage, by their slip or by the water in them."""

from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.lines import Line2D
import numpy as np

from quoin import colours, run_parameters
from quoin.csv_table import scale_for, with_unit
from quoin.figures.stress_figure import cell_areas, round_near
from quoin.joint_comparison import inelastic_slip
from quoin.joint_states import INTACT, NAMES, OPEN, SLIPPED, SLIPPING
from quoin.shared_motion import enlarged
from quoin.vtu import from_the_start

# state: (name, colour, line width), drawn in this order
STATES = {
    INTACT: (NAMES[INTACT], colours.INTACT, 0.4),
    SLIPPED: (NAMES[SLIPPED], colours.YELLOW, 1.6),
    SLIPPING: (NAMES[SLIPPING], colours.ORANGE, 1.8),
    OPEN: (NAMES[OPEN], colours.RED, 2.0),
}
# how a crack moves: (name, colour), in the order in which they are drawn
MODES = (("inelastic slip", colours.ORANGE), ("tensile opening", colours.RED),
         ("crushing", colours.VIOLET))
SHEAR, TENSION, CRUSHING = 0, 1, 2
WIDEST_CRACK, THINNEST_CRACK = 4.0, 0.6      # [pt]
LEAST_SHARE = 0.02                   # of the widest, below it is no crack
DAMAGE_COLOURS = LinearSegmentedColormap.from_list(
    "damage", colours.DAMAGE)
WATER_COLOURS = LinearSegmentedColormap.from_list(
    "water", colours.VALUES[2:])
HAIRLINE = 1e-5                      # [m], drawn widest where nothing failed
GAP = 0.05                           # of the size of a block: no crack any more
WIDEST_CONTACT = 5.0                 # [pt]


def drawn_position(grid, scale, motion=None):
    """Drawn positions of joints and contacts, whose points are at their
    current places, without the @p motion that all blocks share; None where
    those cannot be enlarged."""
    if scale == 1.0:
        return grid.points
    if "displacement" not in grid.point_data:
        return None
    u = grid.point_data["displacement"][:, :2]
    return enlarged(grid.points - u, grid.points, scale, motion)


def add_lines(axes, lines, **look):
    axes.add_collection(LineCollection(lines, capstyle="round", **look))


def add_cracks(axes, lines, **look):
    """Flat at their ends, which round ones would seem to move, and a little
    longer than the faces, so that no seams show."""
    longer = 0.02 * np.diff(lines, axis=1)[:, 0]
    lines = lines + np.stack([-longer, longer], axis=1)
    axes.add_collection(LineCollection(lines, **look))


class StateJoints:
    """Joints by the worse state of their ends; @p is_since: of those that
    moved since a time."""

    def __init__(self, is_since=False):
        self.is_since = is_since

    def draw(self, axes, joints, position, with_count):
        state = joints.cell_data["state"]
        handles = []
        for number, (name, colour, width) in STATES.items():
            lines = position[joints.cells[state == number]]
            if len(lines) == 0:
                continue
            add_lines(axes, lines, colors=colour, linewidths=width)
            if number == INTACT and self.is_since:
                name += " or did not move"
            count = f" ({len(lines)})" if with_count else ""
            handles.append(Line2D([], [], color=colour,
                                  linewidth=max(width, 1.0),
                                  label=name + count))
        return handles

    def mappable(self):
        return None


def block_size(blocks):
    """Side of a square as large as the median of the blocks [m]."""
    area = np.bincount(blocks.cell_data["block"], cell_areas(blocks))
    return np.sqrt(np.median(area[area > 0.0]))


def crack_modes(joints, shear_stiffness, peak_crushing):
    """Mode of each face and how wide it is [m]: the mean of its ends.

    A face is crushed once its plastic closing is beyond that at the
    compressive strength of its set, @p peak_crushing [m]; otherwise it opens
    or slips, whichever is more. Faces that never failed have no width, and
    inelastic_slip(), by @p shear_stiffness [Pa/m], is what counts.
    """
    joints = from_the_start(joints)
    of_set = joints.cell_data["joint set"]

    def mean(name):
        return joints.point_data[name][joints.cells].mean(axis=1)

    opening = np.maximum(mean("opening"), 0.0)
    slip = np.abs(inelastic_slip(joints, shear_stiffness).mean(axis=1))
    mode = np.where(opening >= slip, TENSION, SHEAR)
    width = np.maximum(opening, slip)
    if "crushing" in joints.point_data:
        crushing = mean("crushing")
        is_crushed = crushing > np.asarray(peak_crushing)[of_set]
        mode = np.where(is_crushed, CRUSHING, mode)
        width = np.where(is_crushed, crushing, width)
    return mode, np.where(joints.cell_data["state"] == INTACT, 0.0, width)


def usual_width(widths, block_size):
    """Width of wide cracks [m], from the widths of faces, without joints of
    units that have come away and without bed joints on which all blocks slide,
    which would make all others thin. @p block_size [m]."""
    failed = widths[widths > 0.0]
    cracks = failed[failed < GAP * block_size]
    if len(cracks) == 0:
        cracks = failed if len(failed) else np.array([HAIRLINE])
    return np.quantile(
        cracks[cracks >= 0.1 * np.quantile(cracks, 0.95)], 0.8)


class CrackJoints:
    """Cracks coloured by mode and as wide as they open, slip or close; one
    scale for all frames."""

    def __init__(self, output, frames, widest=None):
        grids = [f.joints for f in frames if f.joints is not None]
        self.can_crush = any("crushing" in g.point_data for g in grids)
        self.properties = (
            run_parameters.of_joint_sets(output, "Shear stiffness"),
            run_parameters.peak_crushing(output))
        widths = np.concatenate(
            [crack_modes(grid, *self.properties)[1] for grid in grids]
            or [np.zeros(0)])
        self.widest = widest or round_near(
            usual_width(widths, block_size(frames[0].blocks)))

    def draw(self, axes, joints, position, with_count):
        mode, width = crack_modes(joints, *self.properties)
        is_crack = width >= LEAST_SHARE * self.widest
        add_lines(axes, position[joints.cells[~is_crack]],
                  colors=STATES[INTACT][1], linewidths=STATES[INTACT][2])
        for number, (_, colour) in enumerate(MODES):
            chosen = is_crack & (mode == number)
            add_cracks(axes, position[joints.cells[chosen]], colors=colour,
                       linewidths=self.line_width(width[chosen]))
        return self.legend()

    def line_width(self, width):
        return np.clip(WIDEST_CRACK * np.asarray(width) / self.widest,
                       THINNEST_CRACK, WIDEST_CRACK)

    def legend(self):
        modes = [Line2D([], [], color=colour, linewidth=2.0, label=name)
                 for number, (name, colour) in enumerate(MODES)
                 if number != CRUSHING or self.can_crush]
        widths = [
            Line2D([], [], color="0.35", linewidth=self.line_width(w),
                   label=("≥ " if w == self.widest else "")
                   + with_unit(w, "m"))
            for w in self.widest * np.array([0.2, 0.5, 1.0])]
        least = with_unit(LEAST_SHARE * self.widest, "m")
        intact = Line2D([], [], color=STATES[INTACT][1], linewidth=0.6,
                        label=f"intact or below {least}")
        return modes + [intact] + widths

    def mappable(self):
        return None


class DamageJoints:
    """Joints by the share of their bond that they lost."""

    bar_label = "damage of joints [-]"

    def __init__(self, frames):
        if not any(f.joints is not None and "damage" in f.joints.point_data
                   for f in frames):
            raise ValueError("--joints damage is for joints of 'Law = "
                             "composite', which write a damage")

    def draw(self, axes, joints, position, with_count):
        damage = joints.point_data["damage"][joints.cells].mean(axis=1)
        order = np.argsort(damage)
        add_cracks(axes, position[joints.cells[order]],
                   colors=DAMAGE_COLOURS(damage[order]),
                   linewidths=0.4 + 2.0 * damage[order])
        return []

    def mappable(self):
        return ScalarMappable(Normalize(0.0, 1.0), DAMAGE_COLOURS)


class SlipJoints:
    """Joints by how far they slipped, elastically or not, in either sense;
    one scale for all frames, up to @p widest [m] or what 99 % stay below in
    the frame that slipped most, so that one loose face does not make all
    others pale."""

    def __init__(self, frames, widest=None):
        widest = widest or max(
            [np.quantile(self.slip(f.joints), 0.99) for f in frames
             if f.joints is not None], default=0.0) or HAIRLINE
        self.factor, unit = scale_for("m", widest)
        self.size = Normalize(0.0, self.factor * widest, clip=True)
        self.bar_label = f"slip of joints [{unit}]"

    @staticmethod
    def slip(joints):
        """Slip of each face, the mean of its ends [m]."""
        return np.abs(joints.point_data["slip"])[joints.cells].mean(axis=1)

    def draw(self, axes, joints, position, with_count):
        share = self.size(self.factor * self.slip(joints))
        order = np.argsort(share)
        lines = position[joints.cells[order]]
        add_cracks(axes, lines, colors=DAMAGE_COLOURS(share[order]),
                   linewidths=0.4 + 3.0 * share[order])
        return []

    def mappable(self):
        return ScalarMappable(self.size, DAMAGE_COLOURS)


class WaterJoints:
    """Joints by the pressure of their water, and as wide as it flows; one scale
    for all frames, of the flow up to what 98 % stay below."""

    def __init__(self, frames):
        grids = [f.joints for f in frames if f.joints is not None
                 and "water pressure" in f.joints.point_data]
        if not grids:
            raise ValueError("--joints water is for runs of section 'Water'")
        self.flow = max(np.quantile(self.mean(g, "flow"), 0.98)
                        for g in grids) or 1.0
        largest = max(self.mean(g, "water pressure").max()
                      for g in grids) or 1.0
        self.factor, unit = scale_for("Pa", largest)
        self.size = Normalize(0.0, self.factor * largest, clip=True)
        self.bar_label = f"water pressure in joints [{unit}]"

    @staticmethod
    def mean(joints, name):
        return np.abs(joints.point_data[name])[joints.cells].mean(axis=1)

    def draw(self, axes, joints, position, with_count):
        pressure = self.size(self.factor * self.mean(joints, "water pressure"))
        flow = np.clip(self.mean(joints, "flow") / self.flow, 0.0, 1.0)
        add_cracks(axes, position[joints.cells],
                   colors=WATER_COLOURS(pressure), linewidths=0.4 + 3.0 * flow)
        return [Line2D([], [], color=WATER_COLOURS(0.6), linewidth=3.4,
                       label="flow, " + with_unit(self.flow, "m³/s"))]

    def mappable(self):
        return ScalarMappable(self.size, WATER_COLOURS)


def contact_forces(contacts):
    """Compression of each contact, per thickness [N/m]."""
    traction = contacts.point_data["normal traction"][contacts.cells]
    return np.maximum(
        -traction.mean(axis=1) * contacts.cell_data["length"], 0.0)


def draw_contacts(axes, contacts, position, largest_force):
    """Draws contacts at the given positions, None: nowhere; returns the
    handles of the legend."""
    force = contact_forces(contacts)
    state = contacts.cell_data["state"]
    shown = (force > 1e-3 * largest_force) & (state != OPEN)
    if position is None or not shown.any():
        return []
    slipping = state[shown] == SLIPPING
    width = np.clip(WIDEST_CONTACT * force[shown] / largest_force, 0.3,
                    1.5 * WIDEST_CONTACT)
    add_lines(axes, position[contacts.cells[shown]], linewidths=width,
              colors=np.where(slipping, STATES[SLIPPING][1],
                              colours.COMPRESSION))
    handles = [Line2D([], [], color=colours.COMPRESSION,
                      linewidth=WIDEST_CONTACT, solid_capstyle="round",
                      label="contact, " + with_unit(largest_force, "N") + "/m")]
    if slipping.any():
        handles.append(Line2D([], [], color=STATES[SLIPPING][1],
                              linewidth=WIDEST_CONTACT / 2,
                              solid_capstyle="round",
                              label="slipping contact"))
    return handles
