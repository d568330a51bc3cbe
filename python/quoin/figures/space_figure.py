# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Pictures of blocks in three dimensions for scripts/render: their surfaces,
seen along parallel lines, perhaps cut or moved apart, with the states of their
joints on the faces of these, and crosses of the principal stresses there."""

import os

from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
import numpy as np

from quoin import joint_states, vtu
from quoin.colours import (COMPRESSION, MATERIALS, ORANGE, RED, TENSION,
                           YELLOW)
from quoin.csv_table import scale_for, with_unit
from quoin.figures.block_figure import PER, block_colours, round_down
from quoin.figures.figure_style import MAGNITUDES, STRESSES
from quoin.figures.stress_figure import LONGEST, round_near
from quoin.shared_motion import enlarged, shared_motion

SIDES = ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])  # normals outwards
STATES = {joint_states.OPEN: RED, joint_states.SLIPPING: ORANGE,
          joint_states.SLIPPED: YELLOW}
SHARP = np.cos(np.radians(25))       # of edges that are drawn
DARKEST = 0.55                       # of faces that the light grazes
PIXELS = 1600                        # along the longer side of a picture


def is_in_space(output):
    """Whether the blocks of a run are tetrahedra."""
    path = os.path.join(output, "blocks.pvd")
    if not vtu.exists(path):
        return False
    blocks = vtu.read_at(path)
    return blocks is not None and blocks.cells.shape[1] == 4


class SpaceFrame:
    """The fields of one moment."""

    def __init__(self, output, time, label=None):
        self.label = label
        self.blocks = vtu.read_at(os.path.join(output, "blocks.pvd"), time)
        joints = os.path.join(output, "joints.pvd")
        self.joints = vtu.read_at(joints, time) if vtu.exists(joints) else None
        if os.path.basename(os.path.abspath(output)) == "mechanism":
            self.label = f"factor {self.blocks.time:.4g}"
        self.shared = shared_motion(self.blocks)

    @property
    def time(self):
        return self.blocks.time

    def position(self, scale):
        X = self.blocks.points
        return enlarged(X, X + self.blocks.point_data["displacement"], scale,
                        self.shared)


def surface(cells):
    """Faces that belong to one tetrahedron only, and that tetrahedron."""
    faces = np.concatenate([cells[:, side] for side in SIDES])
    owner = np.tile(np.arange(len(cells)), 4)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0,
                                return_index=True, return_counts=True)
    once = first[count == 1]
    return faces[once], owner[once]


def state_of_faces(X, faces, joints):
    """State of the joint on each face of a block, by the place of its centre in
    the mesh; -1: none."""
    states = np.full(len(faces), -1)
    if joints is None or len(joints.cells) == 0:
        return states
    places = joints.points - joints.point_data["displacement"]
    size = np.ptp(X, axis=0).max()

    def key(centres):
        return [tuple(row) for row in np.rint(centres / (1e-6 * size))
                .astype(np.int64) // 4]

    known = {}
    for shift in (0, 2):             # on either side of a border of the grid
        for k, name in enumerate(key(places[joints.cells].mean(axis=1)
                                     + shift * 1e-6 * size)):
            known[shift, name] = joints.cell_data["state"][k]
        for k, name in enumerate(key(X[faces].mean(axis=1)
                                     + shift * 1e-6 * size)):
            if states[k] < 0:
                states[k] = known.get((shift, name), -1)
    return states


def clipped(polygon, heights):
    """The part of a convex polygon, (n, 3), where the heights of its corners are
    not positive."""
    result = []
    for k in range(len(polygon)):
        a, b = polygon[k - 1], polygon[k]
        ha, hb = heights[k - 1], heights[k]
        if (ha > 0) != (hb > 0):
            result.append(a + ha / (ha - hb) * (b - a))
        if hb <= 0:
            result.append(b)
    return np.array(result)


def section(corners, heights):
    """The polygon in which a tetrahedron meets the plane of zero height."""
    inside = [k for k in range(4) if heights[k] <= 0]
    outside = [k for k in range(4) if heights[k] > 0]

    def point(i, j):
        share = heights[i] / (heights[i] - heights[j])
        return corners[i] + share * (corners[j] - corners[i])

    if len(inside) == 2:
        (a, b), (c, d) = inside, outside
        return np.array([point(a, c), point(a, d), point(b, d), point(b, c)])
    alone = inside if len(inside) == 1 else outside
    others = outside if len(inside) == 1 else inside
    return np.array([point(alone[0], k) for k in others])


class Canvas:
    """Pixels of a picture, each with what is nearest to the viewer there."""

    def __init__(self, low, high):
        self.low = low
        self.per_metre = PIXELS / (high - low).max()
        size = np.ceil((high - low) * self.per_metre).astype(int) + 1
        self.nearness = np.full(size[::-1], -np.inf)
        self.cell = np.full(size[::-1], -1)   # whose face is seen there
        self.image = np.ones((size[1], size[0], 3))

    def pixels(self, corners):
        return np.column_stack([(corners[:, :2] - self.low) * self.per_metre,
                                corners[:, 2]])

    def add_triangle(self, corners, colour, cell=-1):
        a, b, c = self.pixels(corners)
        flat = np.array([a, b, c])[:, :2]
        first = np.maximum(np.floor(flat.min(axis=0)).astype(int), 0)
        last = np.minimum(np.ceil(flat.max(axis=0)).astype(int) + 1,
                          self.nearness.shape[::-1])
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if (first >= last).any() or area == 0.0:
            return
        x = np.arange(first[0], last[0])[None, :]
        y = np.arange(first[1], last[1])[:, None]
        v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        z = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])
        here = np.s_[first[1]:last[1], first[0]:last[0]]
        shown = ((v >= -1e-9) & (w >= -1e-9) & (v + w <= 1 + 1e-9)
                 & (z > self.nearness[here]))
        self.nearness[here][shown] = z[shown]
        self.image[here][shown] = colour
        self.cell[here][shown] = cell

    def add_line(self, ends, colour, width, lift):
        """@p lift: how much nearer it is taken to be [m]."""
        a, b = self.pixels(ends)
        n = int(2 * np.abs(b - a)[:2].max()) + 2
        points = a + np.linspace(0, 1, n)[:, None] * (b - a)
        for dx in range(width):
            for dy in range(width):
                x, y = np.rint(points[:, :2] + [dx, dy]
                               - (width - 1) / 2).astype(int).T
                inside = ((x >= 0) & (x < self.nearness.shape[1]) & (y >= 0)
                          & (y < self.nearness.shape[0]))
                x, y, z = x[inside], y[inside], points[inside, 2] + lift
                shown = z >= self.nearness[y, x]
                self.image[y[shown], x[shown]] = colour


class SpaceCrosses:
    """Crosses of the principal stresses on what is seen of the blocks, seen from
    where these are, in all frames of a figure with one scale. Stresses are averaged
    at the nodes, never across a joint, and then in the cells."""

    def __init__(self, frames, n_across):
        self.n_across = n_across
        sizes = [np.abs(self.principal(f.blocks)[0]).max(axis=1)
                 for f in frames]
        largest = max(size.max() for size in sizes)
        # The few crosses at a corner must not make all others invisible.
        self.reference = round_near(
            max(np.quantile(size, 0.9) for size in sizes) or largest)
        self.is_cut = largest > LONGEST * self.reference

    @staticmethod
    def principal(blocks):
        """Principal stresses of the cells [Pa], (n, 3), and their directions, the
        columns of (n, 3, 3)."""
        cells, x = blocks.cells, blocks.points
        edges = x[cells[:, 1:]] - x[cells[:, :1]]
        volume = np.abs(np.linalg.det(edges)) / 6.0
        xx, yy, zz, xy, xz, yz = blocks.cell_data["stress"].T
        tensor = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=1)

        def at_nodes(values):
            return np.bincount(cells.ravel(), np.repeat(values, 4),
                               minlength=len(x))

        weight = np.maximum(at_nodes(volume), 1e-300)
        nodal = np.stack([at_nodes(volume * t) / weight for t in tensor.T],
                         axis=1)
        return np.linalg.eigh(nodal[cells].mean(axis=1).reshape(-1, 3, 3))

    def draw(self, axes, canvas, blocks, page, lift):
        """Adds the crosses to what is on @p canvas, and the reference stress as a
        bar to @p axes; returns the handles of the legend."""
        height, width = canvas.cell.shape
        step = max(height, width) / self.n_across
        spacing = step / canvas.per_metre
        values, directions = self.principal(blocks)
        half = 0.45 * spacing / self.reference
        most = LONGEST * self.reference
        for y in np.arange(0.5 * step, height, step).astype(int):
            for x in np.arange(0.5 * step, width, step).astype(int):
                cell = canvas.cell[y, x]
                if cell < 0:
                    continue
                centre = np.append(canvas.low
                                   + np.array([x, y]) / canvas.per_metre,
                                   canvas.nearness[y, x])
                for s, way in zip(values[cell], directions[cell].T):
                    arm = (half * min(abs(s), most)) * (page @ way)
                    arm[2] = 0.0
                    ends = np.array([centre - arm, centre + arm])
                    colour = to_rgb(COMPRESSION if s < 0.0 else TENSION)
                    canvas.add_line(ends, 1.0, 5, lift)
                    canvas.add_line(ends, colour, 3, lift)
        length = 2.0 * half * self.reference
        x, y = canvas.low + 0.2 * spacing
        axes.plot([x, x + length], [y, y], color=COMPRESSION, linewidth=1.2,
                  solid_capstyle="butt", zorder=5)
        text = with_unit(self.reference, "Pa")
        if self.is_cut:
            text += f", cut at {with_unit(most, 'Pa')}"
        axes.text(x + 1.4 * length, y, text, fontsize=7.5, va="center",
                  zorder=5)
        return [Line2D([], [], color=COMPRESSION, label="compression"),
                Line2D([], [], color=TENSION, label="tension")]


class SpacePicture:
    """Draws frames with one scale, one view and one range of colours."""

    def __init__(self, options, frames):
        for name in ("view", "since"):
            if getattr(options, name):
                raise ValueError(f"--{name} is for two dimensions; these take "
                                 "--camera, --cut and --explode")
        if options.joints != "state":
            raise ValueError(f"--joints {options.joints} is for two "
                             "dimensions; take 'state'")
        self.options = options
        azimuth, elevation = np.radians(options.camera)
        c, s = np.cos(azimuth), np.sin(azimuth)
        self.right = np.array([-s, c, 0.0])
        self.towards = np.array([c * np.cos(elevation), s * np.cos(elevation),
                                 np.sin(elevation)])
        self.up = np.cross(self.towards, self.right)
        self.page = np.array([self.right, self.up, self.towards])
        self.light = self.towards + 0.5 * self.up + 0.4 * self.right
        self.light /= np.linalg.norm(self.light)
        self.scale = options.scale or min(self.automatic_scale(f)
                                          for f in frames)
        self.is_shared = any(f.shared is not None for f in frames)
        self.values = None
        if options.colour in PER or options.colour == "stress":
            sizes = [self.cell_values(f.blocks) for f in frames]
            largest = max(np.quantile(np.abs(s), 0.99) for s in sizes)
            unit = "Pa" if options.colour == "stress" else "m"
            self.factor, self.unit = scale_for(unit, largest)
            if options.colour == "stress":
                low = min(np.quantile(s, 0.01) for s in sizes)
                self.values = Normalize(self.factor * low or -1.0, 0.0,
                                        clip=True)
            else:
                self.values = Normalize(0.0, self.factor * largest or 1.0,
                                        clip=True)
        self.is_panel = len(frames) > 1
        self.crosses = None
        if options.principal:
            self.crosses = SpaceCrosses(
                frames, options.crosses or (20 if self.is_panel else 32))
        places = np.concatenate([np.concatenate(
            [p[:, :2] for p, _, _ in self.shapes(f)[0]]) for f in frames])
        self.low, self.high = places.min(axis=0), places.max(axis=0)
        self.extent = self.high - self.low

    @staticmethod
    def automatic_scale(frame):
        u = frame.position(2.0) - frame.blocks.points
        largest = np.linalg.norm(u - u.mean(axis=0), axis=1).max() / 2.0
        size = np.ptp(frame.blocks.points, axis=0).max()
        return (1.0 if largest <= 1e-12 * size
                else round_down(0.04 * size / largest))

    def cell_values(self, blocks):
        if self.options.colour == "stress":
            return blocks.cell_data["principal stress 3"]
        size = np.linalg.norm(blocks.point_data[self.options.colour], axis=1)
        return size[blocks.cells].mean(axis=1)

    def colours(self, blocks):
        """Colours of the cells, (n, 3)."""
        if self.values:
            scale = STRESSES if self.options.colour == "stress" else MAGNITUDES
            return scale(self.values(self.factor
                                     * self.cell_values(blocks)))[:, :3]
        if self.options.colour == "block":
            return np.array([to_rgb(c) for c in
                             block_colours(blocks.cell_data["block"])])
        return np.array([to_rgb(c) for c in MATERIALS])[
            blocks.cell_data["material"] % len(MATERIALS)]

    def apart(self, blocks, x):
        """Positions of points whose blocks have been moved apart."""
        if not self.options.explode:
            return x
        block = np.empty(len(x), dtype=int)
        block[blocks.cells] = blocks.cell_data["block"][:, None]
        count = np.maximum(np.bincount(block), 1)
        centre = np.stack([np.bincount(block, x[:, d]) / count
                           for d in range(3)], axis=1)
        return x + self.options.explode * (centre[block] - x.mean(axis=0))

    def shapes(self, frame):
        """(corners on the page and their nearness, colour, cell) of faces, and
        (ends, whether it is sharp) of edges."""
        blocks = frame.blocks
        X = blocks.points
        x = self.apart(blocks, frame.position(self.scale))
        colours = self.colours(blocks)
        faces, owner = surface(blocks.cells)
        shade = colours[owner]
        if not self.options.blocks_only:
            states = state_of_faces(X, faces, frame.joints)
            for state, colour in STATES.items():
                shade[states == state] = to_rgb(colour)
        normals = np.cross(x[faces[:, 1]] - x[faces[:, 0]],
                           x[faces[:, 2]] - x[faces[:, 0]])
        normals /= np.maximum(np.linalg.norm(normals, axis=1),
                              1e-300)[:, None]
        page = self.page
        cut = self.options.cut
        heights = (None if cut is None
                   else cut.sign * (X[:, cut.axis] - cut.value))
        found, lines = [], []

        def add(corners, colour, normal, cell):
            light = np.clip(normal @ self.light, 0.0, 1.0)
            found.append((corners @ page.T,
                          colour * (DARKEST + (1 - DARKEST) * light), cell))

        for face, colour, normal, cell in zip(faces, shade, normals, owner):
            if normal @ self.towards <= 0.0:
                continue
            corners = x[face]
            if heights is not None:
                corners = clipped(corners, heights[face])
                if len(corners) < 3:
                    continue
            add(corners, colour, normal, cell)
        if heights is not None:
            above = heights[blocks.cells] > 0
            for k in np.flatnonzero(above.any(axis=1) & ~above.all(axis=1)):
                normal = np.zeros(3)
                normal[cut.axis] = cut.sign
                add(section(x[blocks.cells[k]], heights[blocks.cells[k]]),
                    colours[k], normal, k)
        edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]],
                                        faces[:, [2, 0]]]), axis=1)
        order = np.lexsort((edges[:, 1], edges[:, 0]))
        of_face = np.tile(np.arange(len(faces)), 3)[order]
        edges = edges[order]
        for k in range(len(edges) - 1):
            if (edges[k] != edges[k + 1]).any():
                continue
            a, b = normals[of_face[k]], normals[of_face[k + 1]]
            if (not self.options.mesh and a @ b > SHARP
                    or max(a @ self.towards, b @ self.towards) <= 0.0):
                continue
            ends = x[edges[k]]
            if heights is not None:
                ends = clipped(ends, heights[edges[k]])[:2]
                if len(ends) < 2:
                    continue
            lines.append((ends @ page.T, a @ b <= SHARP))
        return found, lines

    def draw(self, axes, frame, with_count):
        """One moment; returns the handles of the legend."""
        axes.grid(False)
        margin = 0.02 * self.extent.max()
        low, high = self.low - margin, self.high + margin
        canvas = Canvas(low, high)
        faces, lines = self.shapes(frame)
        for corners, colour, cell in faces:
            for k in range(1, len(corners) - 1):
                canvas.add_triangle(corners[[0, k, k + 1]], colour, cell)
        for ends, is_sharp in lines:
            canvas.add_line(ends, 0.2 if is_sharp else 0.6,
                            3 if is_sharp else 1, 0.004 * self.extent.max())
        handles = [] if not self.crosses else self.crosses.draw(
            axes, canvas, frame.blocks, self.page, 0.5 * self.extent.max())
        axes.imshow(canvas.image, origin="lower",
                    extent=(low[0], high[0], low[1], high[1]),
                    interpolation="antialiased")
        axes.set_aspect("equal")
        axes.set_axis_off()
        if self.options.blocks_only or frame.joints is None:
            return handles
        present = frame.joints.cell_data["state"]
        return handles + [Patch(color=colour, label=joint_states.NAMES[state])
                for state, colour in STATES.items() if (present == state).any()]

    def caption(self, frame, digits="4g"):
        return frame.label or f"t = {frame.time:.{digits}} s"

    def remark(self):
        words = []
        if self.scale != 1.0:
            words.append(f"displacements × {self.scale:g}"
                         + (" without the motion of the whole"
                            if self.is_shared else ""))
        if self.options.explode:
            words.append("blocks moved apart")
        if self.options.cut:
            words.append(f"cut at {self.options.cut.text}")
        return ", ".join(words)

    def colour_bars(self):
        if not self.values:
            return []
        if self.options.colour == "stress":
            return [(ScalarMappable(self.values, STRESSES),
                     f"minor principal stress [{self.unit}]")]
        name = self.options.colour
        return [(ScalarMappable(self.values, MAGNITUDES),
                 f"{name} [{self.unit}{PER[name]}]")]
