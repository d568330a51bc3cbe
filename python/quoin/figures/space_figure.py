# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Pictures of blocks in three dimensions for scripts/render, by VTK: their
surfaces, seen along parallel lines, perhaps cut or moved apart, with the states
of their joints on the faces of these, and crosses of the principal stresses
there."""

import os

from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_rgb, to_rgba_array
from matplotlib.patches import Patch
import numpy as np
from vtkmodules.util.numpy_support import (numpy_to_vtk, numpy_to_vtkIdTypeArray,
                                           vtk_to_numpy)
from vtkmodules.vtkCommonCore import reference, vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_TETRA, VTK_TRIANGLE, vtkCellArray,
                                           vtkDataObject, vtkStaticCellLocator,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkFiltersGeneral import vtkTableBasedClipDataSet
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

from quoin import joint_states, vtu
from quoin.colours import ORANGE, RED, YELLOW
from quoin.csv_table import scale_for
from quoin.figures.block_figure import Picture, round_down
from quoin.figures.figure_style import STRESSES
from quoin.figures.scene import Scene, beyond
from quoin.figures.stress_figure import CrossLines
from quoin.shared_motion import enlarged, shared_motion

STATES = {joint_states.OPEN: RED, joint_states.SLIPPING: ORANGE,
          joint_states.SLIPPED: YELLOW}
STRESS = "principal stress 3"        # the minor one
SHARP = 25.0                         # edges that are drawn [deg]
PIXELS = 1600                        # along the longer side of a picture


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


def add_array(data, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.AddArray(array)


def grid_of(points, cells):
    """The vtkUnstructuredGrid of tetrahedra or triangles."""
    grid, places, corners = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    corners.SetData(cells.shape[1], numpy_to_vtkIdTypeArray(
        cells.ravel().astype(np.int64), deep=True))
    grid.SetPoints(places)
    grid.SetCells({3: VTK_TRIANGLE, 4: VTK_TETRA}[cells.shape[1]], corners)
    return grid


def surface(blocks, places, cut=None):
    """The faces of blocks with their nodes at @p places, of what the Cut leaves in
    the mesh: vtkPolyData whose faces know their "cell", and whose points their
    "mesh place"."""
    grid = grid_of(places, blocks.cells)
    add_array(grid.GetPointData(), "mesh place", blocks.points)
    add_array(grid.GetCellData(), "cell", np.arange(len(blocks.cells)))
    faces = vtkDataSetSurfaceFilter()
    faces.SetInputData(grid)
    if cut is not None:
        add_array(grid.GetPointData(), "height",
                  cut.sign * (blocks.points[:, cut.axis] - cut.value))
        clip = vtkTableBasedClipDataSet()
        clip.SetInputData(grid)
        clip.SetInputArrayToProcess(
            0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "height")
        clip.InsideOutOn()
        faces.SetInputConnection(clip.GetOutputPort())
    faces.Update()
    if faces.GetOutput().GetNumberOfCells() == 0:
        raise ValueError(f"--cut: no block has a part on that side of {cut.text}")
    return faces.GetOutput()


def state_of_faces(faces, joints):
    """State of the joint on each face of surface(), by the place of its centre in
    the mesh; -1: none that is drawn."""
    states = np.full(faces.GetNumberOfCells(), -1)
    failed = np.isin(joints.cell_data["state"], list(STATES))
    if not failed.any():
        return states
    locator = vtkStaticCellLocator()
    locator.SetDataSet(grid_of(
        joints.points - joints.point_data["displacement"],
        joints.cells[failed]))
    locator.BuildLocator()
    first, corners = (vtk_to_numpy(array) for array in (
        faces.GetPolys().GetOffsetsArray(),
        faces.GetPolys().GetConnectivityArray()))
    places = vtk_to_numpy(faces.GetPointData().GetArray("mesh place"))
    centres = (np.add.reduceat(places[corners], first[:-1])
               / np.diff(first)[:, None])
    near = 1e-6 * np.ptp(places, axis=0).max()
    face, part, distance = map(reference, (0, 0, 0.0))
    for k, centre in enumerate(centres):
        if locator.FindClosestPointWithinRadius(centre, near, [0.0] * 3, face,
                                                part, distance):
            states[k] = joints.cell_data["state"][failed][face.get()]
    return states


def sharp_edges(faces):
    edges = vtkFeatureEdges()
    edges.SetInputData(faces)
    edges.SetFeatureAngle(SHARP)
    edges.ColoringOff()
    edges.Update()
    return edges.GetOutput()


def principal(blocks):
    """Principal stresses of the cells [Pa], (n, 3), and their directions, the
    columns of (n, 3, 3), averaged at the nodes, never across a joint, and then in
    the cells."""
    cells, x = blocks.cells, blocks.points
    edges = x[cells[:, 1:]] - x[cells[:, :1]]
    volume = np.abs(np.linalg.det(edges)) / 6.0
    xx, yy, zz, xy, xz, yz = blocks.cell_data["stress"].T
    tensor = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=1)

    def at_nodes(values):
        return np.bincount(cells.ravel(), np.repeat(values, 4),
                           minlength=len(x))

    weight = np.maximum(at_nodes(volume), 1e-300)
    nodal = np.stack([at_nodes(volume * t) / weight for t in tensor.T], axis=1)
    return np.linalg.eigh(nodal[cells].mean(axis=1).reshape(-1, 3, 3))


def seen(faces, page, low, high, spacing):
    """What is seen at the points of a grid over a box of the page: their places
    there, (n, 2) [m], and the cells (n)."""
    locator = vtkStaticCellLocator()
    locator.SetDataSet(faces)
    locator.BuildLocator()
    cells = vtk_to_numpy(faces.GetCellData().GetArray("cell"))
    far = beyond(faces) * page[2]
    places, found = [], []
    share, part, face = map(reference, (0.0, 0, 0))
    hit, parametric = [0.0] * 3, [0.0] * 3
    for y in np.arange(low[1] + 0.5 * spacing, high[1], spacing):
        for x in np.arange(low[0] + 0.5 * spacing, high[0], spacing):
            place = np.array([x, y]) @ page[:2]
            if locator.IntersectWithLine(place + far, place - far, 0.0, share,
                                         hit, parametric, part, face):
                places.append([x, y])
                found.append(cells[face.get()])
    return np.reshape(places, (-1, 2)), np.array(found, dtype=int)


class SpacePicture(Picture):
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
        right = np.array([-s, c, 0.0])
        towards = np.array([c * np.cos(elevation), s * np.cos(elevation),
                            np.sin(elevation)])
        self.page = np.array([right, np.cross(towards, right), towards])
        self.scale = options.scale or min(self.automatic_scale(f)
                                          for f in frames)
        self.is_shared = any(f.shared is not None for f in frames)
        self.set_sizes(frames)
        self.joints = self.contours = self.crosses = self.stresses = None
        if options.colour == "stress":
            values = [f.blocks.cell_data[STRESS] for f in frames]
            self.factor, self.unit = scale_for("Pa", max(
                np.quantile(np.abs(v), 0.99) for v in values))
            low = min(np.quantile(v, 0.01) for v in values)
            self.stresses = Normalize(self.factor * low or -1.0, 0.0, clip=True)
        self.states = {}                 # of joints on the faces of each frame
        self.faces = {frame: self.coloured_faces(frame) for frame in frames}
        places = np.concatenate([
            vtk_to_numpy(faces.GetPoints().GetData()) @ self.page[:2].T
            for faces in self.faces.values()])
        margin = 0.02 * np.ptp(places, axis=0).max()
        self.low = places.min(axis=0) - margin
        self.high = places.max(axis=0) + margin
        self.extent = self.high - self.low
        self.scene = Scene(self.page, self.low, self.high, PIXELS)
        self.is_panel = len(frames) > 1
        if options.principal:
            self.spacing = self.extent.max() / (
                options.crosses or (20 if self.is_panel else 32))
            self.crosses = CrossLines(
                [np.abs(principal(f.blocks)[0]).max(axis=1) for f in frames],
                self.spacing)

    @staticmethod
    def automatic_scale(frame):
        u = frame.position(2.0) - frame.blocks.points
        largest = np.linalg.norm(u - u.mean(axis=0), axis=1).max() / 2.0
        size = np.ptp(frame.blocks.points, axis=0).max()
        return (1.0 if largest <= 1e-12 * size
                else round_down(0.04 * size / largest))

    def colours(self, blocks):
        if self.stresses:
            return STRESSES(self.stresses(self.factor
                                          * blocks.cell_data[STRESS]))
        return super().colours(blocks)

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

    def coloured_faces(self, frame):
        """The surface, as it is drawn."""
        blocks = frame.blocks
        faces = surface(blocks, self.apart(blocks, frame.position(self.scale)),
                        self.options.cut)
        shade = to_rgba_array(self.colours(blocks))[
            vtk_to_numpy(faces.GetCellData().GetArray("cell")), :3]
        if frame.joints is not None and not self.options.blocks_only:
            states = state_of_faces(faces, frame.joints)
            self.states[frame] = set(states)
            for state, colour in STATES.items():
                shade[states == state] = to_rgb(colour)
        add_array(faces.GetCellData(), "colour",
                  np.rint(255 * shade).astype(np.uint8))
        faces.GetCellData().SetActiveScalars("colour")
        return faces

    def draw(self, axes, frame, with_count):
        """One moment; returns the handles of the legend."""
        faces = self.faces[frame]
        axes.grid(False)
        axes.imshow(self.scene.image(faces, sharp_edges(faces),
                                     self.options.mesh),
                    origin="lower", interpolation="antialiased",
                    extent=(self.low[0], self.high[0],
                            self.low[1], self.high[1]))
        axes.set_axis_off()
        handles = self.draw_crosses(axes, frame) if self.crosses else []
        return handles + [Patch(color=colour, label=joint_states.NAMES[state])
                          for state, colour in STATES.items()
                          if state in self.states.get(frame, ())]

    def draw_crosses(self, axes, frame):
        """On what is seen, in the directions of the stresses there."""
        places, cells = seen(self.faces[frame], self.page, self.low, self.high,
                             self.spacing)
        values, ways = principal(frame.blocks)
        ways = self.page[:2] @ ways[cells]
        strip = 0.06 * self.extent.max()
        self.crosses.draw_bar(axes, self.low, strip)
        axes.set_ylim(self.low[1] - strip, self.high[1])
        return self.crosses.draw_arms(
            axes, places, [(values[cells, k], ways[:, :, k]) for k in range(3)],
            0.7 if self.is_panel else 0.9)

    def remark(self):
        words = [super().remark(),
                 "blocks moved apart" if self.options.explode else "",
                 f"cut at {self.options.cut.text}" if self.options.cut else ""]
        return ", ".join(filter(None, words))

    def colour_bars(self):
        return super().colour_bars() + (
            [(ScalarMappable(self.stresses, STRESSES),
              f"minor principal stress [{self.unit}]")] if self.stresses else [])
