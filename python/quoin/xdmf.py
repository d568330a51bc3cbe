# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Reads the XDMF files that quoin writes, with numpy only: raw little endian
arrays in a file beside, and a grid for each rank and time."""

import os
import xml.etree.ElementTree as ElementTree

import numpy as np

DTYPES = {("Float", "8"): "<f8", ("Int", "4"): "<i4", ("UChar", "1"): "u1"}


class Piece:
    """The grid of a rank at a time [s]; its arrays are read by read()."""

    def __init__(self, folder, time, element):
        self.folder = folder
        self.time = time
        self.element = element

    def array(self, parent):
        item = parent.find("DataItem")
        dtype = np.dtype(DTYPES[item.get("NumberType"), item.get("Precision")])
        shape = [int(n) for n in item.get("Dimensions").split()]
        return np.fromfile(os.path.join(self.folder, item.text), dtype,
                           int(np.prod(shape)),
                           offset=int(item.get("Seek"))).reshape(shape)

    def read(self):
        """time, points, cells, point data, cell data."""
        data = {"Node": {}, "Cell": {}}
        for field in self.element.iter("Attribute"):
            data[field.get("Center")][field.get("Name")] = self.array(field)
        return (self.time, self.array(self.element.find("Geometry")),
                self.array(self.element.find("Topology")), data["Node"],
                data["Cell"])


def read_xdmf(path):
    """A list of (time, [pieces of all ranks that have cells])."""
    series = ElementTree.parse(path).getroot().find("Domain/Grid")
    result = []
    for step in series.iterfind("Grid"):
        time = float(step.find("Time").get("Value"))
        result.append((time, [Piece(os.path.dirname(path), time, element)
                              for element in step.iterfind("Grid")]))
    return result
