# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Surfaces and lines that VTK draws where nobody sees it, as images."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight,
                                         vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow,
                                         vtkWindowToImageFilter)

from quoin.screen import open_screen

DARKEST = 0.55                       # of faces that the light grazes
SAMPLES = 4                          # of a pixel


def actor(shape, has_colours, **properties):
    """What draws polygons or lines, perhaps in the colours of their cells;
    properties as those of vtkProperty."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(shape)
    mapper.SetScalarVisibility(has_colours)
    mapper.SetScalarModeToUseCellData()
    mapper.SetColorModeToDirectScalars()
    result = vtkActor()
    result.SetMapper(mapper)
    for name, value in properties.items():
        getattr(result.GetProperty(), "Set" + name)(value)
    return result


def beyond(faces):
    """A distance from the origin at which there is none of these [m]."""
    return 2.0 * np.linalg.norm(np.reshape(faces.GetBounds(), (3, 2)))


class Scene:
    """One window for all images of a box on a page, seen along parallel lines.

    @p page: the directions to the right, upwards and towards the viewer, rows of
    (3, 3). @p low, @p high: of the box on the page, (2) [m]. @p pixels: along its
    longer side.
    """

    def __init__(self, page, low, high, pixels):
        open_screen()
        right, up, towards = page
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(1.0, 1.0, 1.0)
        self.renderer.AutomaticLightCreationOff()
        light = vtkLight()
        light.PositionalOff()
        light.SetPosition(*(towards + 0.5 * up + 0.4 * right))
        self.renderer.AddLight(light)
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        self.middle = 0.5 * (low + high) @ page[:2]
        self.towards = towards
        camera.SetFocalPoint(*self.middle)
        camera.SetViewUp(*up)
        size = high - low
        camera.SetParallelScale(0.5 * size[1])
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(SAMPLES)
        self.window.SetSize(*np.rint(pixels * size / size.max()).astype(int))
        self.window.AddRenderer(self.renderer)
        self.lift = 0.004 * size.max()

    def image(self, faces, lines, mesh=False):
        """Faces, with their edges if @p mesh, and dark lines on them, polygons and
        lines of vtkPolyData, as (height, width, 3), from the bottom."""
        self.renderer.RemoveAllViewProps()
        self.renderer.AddActor(actor(
            faces, True, Interpolation=0, Ambient=DARKEST, Diffuse=1.0 - DARKEST,
            EdgeVisibility=mesh, EdgeColor=(0.6, 0.6, 0.6)))
        edges = actor(lines, False, Color=(0.2, 0.2, 0.2), LineWidth=3.0,
                      Lighting=False)
        edges.SetPosition(*(self.lift * self.towards))
        self.renderer.AddActor(edges)
        self.renderer.GetActiveCamera().SetPosition(
            *(self.middle + beyond(faces) * self.towards))
        self.renderer.ResetCameraClippingRange()
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        image = grab.GetOutput()
        width, height, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(
            height, width, 3)
