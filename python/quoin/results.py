# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What a run left in its output folder."""

import json
import os

import numpy as np

from quoin import moments, run_parameters, stages, vtu
from quoin.csv_table import Table, unit_of
from quoin.frames import frame
from quoin.joint_states import NAMES


class Results:
    """Tables, fields and joints of a run, read from its folder whenever they
    are asked for: of a run that still goes on, what is there by now."""

    def __init__(self, output):
        self.output = output
        if not os.path.isdir(output):
            raise ValueError(f"{output}: there is no such folder")

    def table(self, name):
        """A table of the output folder, e.g. "histories.csv", as a data frame
        (see frames.py) whose columns have no units in their names unless two
        would be the same; units() has them."""
        table = Table(os.path.join(self.output, name))
        return frame(dict(zip(short_names(table.names), table.rows.T)))

    def units(self, name="histories.csv"):
        """{column: unit} of a table, "" of numbers without."""
        names = Table(os.path.join(self.output, name)).names
        return dict(zip(short_names(names), map(unit_of, names)))

    @property
    def histories(self):
        """A row each time, the first column is "time" [s]."""
        return self.table("histories.csv")

    @property
    def energies(self):
        """All energies [J] and the residual of their balance, at the times of
        the histories."""
        return self.table("energies.csv")

    @property
    def summary(self):
        """summary.json: sizes, steps, rates, figures to judge the run by."""
        with open(os.path.join(self.output, "summary.json"),
                  encoding="utf-8") as file:
            return json.load(file)

    @property
    def warnings(self):
        """Warnings in log.txt: a list of texts, each once."""
        try:
            with open(os.path.join(self.output, "log.txt"),
                      encoding="utf-8") as file:
                lines = file.read().splitlines()
        except FileNotFoundError:
            return []
        mark = "Warning: "
        return list(dict.fromkeys(line[len(mark):] for line in lines
                                  if line.startswith(mark)))

    @property
    def parameters(self):
        """All parameters as the run used them: nested dictionaries of texts,
        e.g. parameters["Joints"]["mortar"]["Cohesion"]."""
        return run_parameters.read(self.output)

    def series(self):
        """The names of the fields, e.g. ["blocks", "joints"]."""
        return sorted(name for name, end in map(os.path.splitext,
                                                os.listdir(self.output))
                      if end in (".pvd", ".xdmf"))

    def times(self, series="blocks"):
        """The times [s] at which a series has fields."""
        return np.array([time for time, _ in vtu.read_pvd(
            self._series(series))])

    def fields(self, series="blocks", time=None):
        """The Grid of a series nearest to a time [s] or to the end of a stage,
        by default the last: its points, cells, and point_data and cell_data,
        arrays by name. None if the series is empty then. A time at which the
        run had not begun or had ended is refused."""
        path = self._series(series)
        time = stages.time_of(self.output, time, stages.end)
        if time is not None and vtu.read_pvd(path):
            moments.check_times(self.output, series + ".pvd", [time])
        return vtu.read_at(path, time)

    def field(self, name, time=None, series="blocks"):
        """An array of a series by its name, of its points or its cells."""
        grid = self.fields(series, time)
        known = {} if grid is None else {**grid.cell_data, **grid.point_data}
        if name not in known:
            raise ValueError(f"{self._series(series)}: there is no field "
                             f"'{name}'; there are "
                             + (", ".join(sorted(known)) or "none"))
        return known[name]

    def joints(self, time=None):
        """A row each face of a joint of a plane model, at the time [s] nearest
        to this or to the end of this stage, by default the last.

        "x", "y" [m]: its middle now; "length" [m]; "set", the name in section
        'Joints'; "state": intact, slipping, slipped or open, the worse of its
        ends; and all else that the fields have, as the mean of both ends:
        "opening", "slip" [m], "normal traction", "shear traction" [Pa],
        tension and opening positive, ...
        """
        grid = self.fields("joints", time)
        if grid is None:
            return frame({})
        if grid.cells.shape[1] != 2:
            raise ValueError(f"{self._series('joints')}: joints in three "
                             "dimensions are no lines: take fields('joints')")
        sets = np.array(run_parameters.joint_sets(self.output))
        x, y = grid.points[grid.cells].mean(axis=1).T
        columns = {"x": x, "y": y, "length": grid.cell_data["length"],
                   "set": sets[grid.cell_data["joint set"]],
                   "state": np.array([NAMES[s] for s in
                                      grid.cell_data["state"]])}
        for name, values in grid.point_data.items():
            if values.ndim == 1 and name != "point state":
                columns[name] = values[grid.cells].mean(axis=1)
        return frame(columns)

    def _series(self, name):
        path = os.path.join(self.output, name + ".pvd")
        if not vtu.exists(path):
            raise ValueError(f"{path}: there is no such file; the run has "
                             f"fields of {', '.join(self.series()) or 'none'}")
        return path


def short_names(names):
    """Names of columns without their units, unless two would be the same."""
    bare = [name.split(" [")[0] for name in names]
    return [short if bare.count(short) == 1 else name
            for short, name in zip(bare, names)]


def read(output):
    """The Results of a run in the folder @p output."""
    return Results(output)
