# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Numbers of scripts/compare: an explicit and an implicit run of one model,
by the first curve of a plot.json, their joints and what they cost."""

import json
import os

import numpy as np

from quoin import run_parameters, vtu
from quoin.csv_table import unit_of
from quoin.figures.curve_figure import CurveFigure, peak_of, read_specs
from quoin.joint_comparison import agreement

SOLVERS = ("explicit", "implicit")
THRESHOLD = 1e-4                     # [m], above it a joint is open or slides
TURN = 0.02                          # of the range of x
FAR = 0.02                           # of the common way
PLATEAU = 1e-3                       # of the peak, by which a plateau may vary


def spec_of(case=None, path=None):
    """The first figure that describes a case, of the file @p path or of
    CASE.plot.json or plot.json beside the case, and the folder of that."""
    paths = [path] if path else [
        os.path.splitext(case)[0] + ".plot.json",
        os.path.join(os.path.dirname(case), "plot.json")] if case else []
    for candidate in paths:
        if path or os.path.exists(candidate):
            return read_specs(candidate)[0], os.path.dirname(candidate)
    raise ValueError("which curves? There is neither "
                     + (" nor ".join(paths) or "a case")
                     + ": give --spec plot.json")


def turns_back(x):
    """Whether x goes back by more than TURN of its range after it came as
    far as it does: cycles, not the noise of a displacement."""
    x = x * np.sign(x[np.abs(x - x[0]).argmax()] - x[0])
    return np.max(np.maximum.accumulate(x) - x) > TURN * np.ptp(x)


def way_of(x, is_cyclic):
    """Progress of the loading, which never decreases: x in its direction or,
    under cycles, the sum of the magnitudes of all its steps."""
    if is_cyclic:
        return np.append(0.0, np.cumsum(np.abs(np.diff(x))))
    sense = np.sign(x[np.abs(x - x[0]).argmax()] - x[0]) or 1.0
    return np.maximum.accumulate(sense * x)


def read_summary(folder):
    """summary.json, empty if the run did not come to write one."""
    try:
        with open(os.path.join(folder, "summary.json"),
                  encoding="utf-8") as file:
            return json.load(file)
    except OSError:
        return {}


class Run:
    """The curve of a run, as it is shown; its time and its way."""

    def __init__(self, figure, folder):
        curve = figure.spec["curves"][0]
        self.folder = folder
        self.time = figure.table(folder, curve).column(0)
        self.x, self.y = figure.points(folder, curve)
        known = np.isfinite(self.x) & np.isfinite(self.y)
        self.time, self.x, self.y = (
            v[known] for v in (self.time, self.x, self.y))
        peak = (peak_of(self.x, self.y, figure.x.get("limits"))
                if len(self.x) > 1 else None)
        if peak is None:
            raise ValueError(f"{folder}: its curve has fewer than two points "
                             f"within the limits of the figure")
        self.peak_row, self.peaks_at_end = peak
        self.peak = self.y[self.peak_row]
        self.summary = read_summary(folder)

    def use_way(self, is_cyclic):
        self.way = way_of(self.x, is_cyclic)

    def at(self, way):
        """y, where the way stands still its last value."""
        last = np.append(np.diff(self.way) > 0.0, True)
        return np.interp(way, self.way[last], self.y[last])

    def way_of_peak(self):
        """The way at the peak; of a curve that stays at its peak, as one that
        slides does, the end of that, as which of these values is the largest
        is a matter of rounding."""
        highest = np.abs(self.y) >= (1.0 - PLATEAU) * np.abs(self.peak)
        after = np.flatnonzero(~highest[self.peak_row:])
        last = self.peak_row + after[0] - 1 if len(after) else len(self.y) - 1
        return self.way[last]

    def fields(self):
        """Times [s] of the fields of joints and the way there, or None."""
        path = os.path.join(self.folder, "joints.pvd")
        series = vtu.read_pvd(path) if vtu.exists(path) else []
        times = np.array([time for time, _ in series])
        return (times, np.interp(times, self.time, self.way)) if series else None

    def numbers(self, x_unit, y_unit):
        """Numbers of one run for compare.json."""
        return {
            "folder": self.folder,
            f"peak{y_unit}": float(self.peak),
            f"at{x_unit}": float(self.x[self.peak_row]),
            "peak at its end": bool(self.peaks_at_end),
            f"end{x_unit}": float(self.x[-1]),
            "finished": self.summary.get("finished"),
            "steps": self.summary.get("steps"),
            "wall time [s]": self.summary.get("wall time [s]"),
            "energy residual share": self.summary.get("energy residual share"),
        }


def bracketed(label):
    unit = unit_of(label)
    return f" [{unit}]" if unit else ""


class Comparison:
    """Two runs, explicit and implicit, and the figure of their curves."""

    def __init__(self, spec, beside, explicit, implicit, threshold=THRESHOLD):
        self.figure = CurveFigure(
            spec, list(zip((explicit, implicit), SOLVERS)), beside)
        self.threshold = threshold
        self.runs = [Run(self.figure, folder)
                     for folder in (explicit, implicit)]
        self.is_cyclic = any(turns_back(run.x) for run in self.runs)
        for run in self.runs:
            run.use_way(self.is_cyclic)
        self.first = max(run.way[0] for run in self.runs)
        self.last = min(run.way[-1] for run in self.runs)
        if self.first >= self.last:
            raise ValueError(
                "the curves of the two runs have nothing in common: "
                + ", ".join(f"{name} from {run.way[0]:g} to {run.way[-1]:g}"
                            for name, run in zip(SOLVERS, self.runs)))
        self.peak_ways = [run.way[run.peak_row] for run in self.runs]
        self.notes = []

    def curves(self):
        """Differences of the curves by the peak of the explicit run, in the
        range that both have and up to the earlier of both peaks: beyond it one
        falls while the other still rises."""
        explicit, implicit = self.runs
        way = np.unique(np.concatenate([run.way for run in self.runs]))
        way = way[(way >= self.first) & (way <= self.last)]
        apart = np.abs(implicit.at(way) - explicit.at(way)) / abs(explicit.peak)
        before = way <= min(self.peak_ways)
        worst = int(apart.argmax())
        unit = bracketed(self.figure.x_label)
        mean = np.sum(0.5 * (apart[1:] + apart[:-1]) * np.diff(way))
        return {
            "largest difference up to the peak": float(
                apart[before].max()) if before.any() else None,
            "largest difference": float(apart[worst]),
            f"largest at{unit}": float(way[worst]),
            "mean difference": float(mean / (self.last - self.first)),
            f"from{unit}": float(self.first), f"to{unit}": float(self.last),
            "share of the explicit curve": float(
                (self.last - self.first) / (explicit.way[-1] - self.first)),
            "over": "the sum of all steps of x" if self.is_cyclic else "x"}

    def moments(self, way):
        """Times [s] of the fields of both runs for this @p way: the explicit
        one that is nearest to it, the implicit one nearest to that; and the
        way at both."""
        fields = [run.fields() for run in self.runs]
        if any(field is None for field in fields):
            return None
        found = []
        for times, ways in fields:
            k = int(np.abs(ways - way).argmin())
            found.append((float(times[k]), float(ways[k])))
            way = ways[k]
        return found

    def places(self):
        """The ways at which joints are compared: the earlier peak, up to which
        both should crack alike, and the last that both reach."""
        return {"at the peak": min(*(run.way_of_peak() for run in self.runs),
                                   self.last),
                "at the end": self.last}

    def joints(self):
        """Conditions of the joints at the peak and at the end, None if fields
        were not written."""
        unit = bracketed(self.figure.x_label)
        shear_stiffness = run_parameters.of_joint_sets(
            self.runs[0].folder, "Shear stiffness")
        found = {"threshold [m]": self.threshold}
        for name, way in self.places().items():
            moments = self.moments(way)
            if moments is None:
                self.notes.append("joints are not compared: a run has no "
                                  "fields of them")
                return None
            grids = [vtu.read_at(os.path.join(run.folder, "joints.pvd"), time)
                     for run, (time, _) in zip(self.runs, moments)]
            if any(grid is None for grid in grids):
                self.notes.append(f"no joints {name} in both runs")
                return None
            if any(grid.cells.shape[1] != 2 for grid in grids):
                self.notes.append("joints are not compared: those of three "
                                  "dimensions are no lines")
                return None
            ways = [way for _, way in moments]
            if abs(ways[1] - ways[0]) > FAR * (self.last - self.first):
                self.notes.append(
                    f"the fields {name} are far apart, at {ways[0]:.3g} and "
                    f"{ways[1]:.3g}{unit}: lower 'Output/Field interval'")
            found[name] = {
                **{f"{solver} at{unit}": way
                   for solver, way in zip(SOLVERS, ways)},
                **agreement(*grids, shear_stiffness, self.threshold)}
        return found

    def note_ends(self):
        unit = unit_of(self.figure.x_label)
        for name, run in zip(SOLVERS, self.runs):
            if not run.summary.get("finished", False):
                self.notes.append(
                    f"the {name} run ended early, at {run.x[-1]:.4g} {unit}: "
                    f"what is compared ends there")
            elif run.peaks_at_end:
                self.notes.append(f"the {name} curve has its largest value at "
                                  f"its end: that may not be its peak")
        if self.peak_ways[0] > self.last:
            self.notes.append("the implicit run does not reach the peak of "
                              "the explicit one")

    def numbers(self):
        """All that compare.json has."""
        self.notes = []
        self.note_ends()
        labels = [bracketed(label) for label in (self.figure.x_label,
                                                 self.figure.y_label)]
        explicit, implicit = (run.numbers(*labels) for run in self.runs)
        times = [run["wall time [s]"] for run in (explicit, implicit)]
        return {
            "title": self.figure.spec.get("title"),
            "explicit": explicit, "implicit": implicit,
            "peak, implicit by explicit": float(
                self.runs[1].peak / self.runs[0].peak),
            "wall time, explicit by implicit": (
                times[0] / times[1] if all(times) else None),
            "curves": self.curves(), "joints": self.joints(),
            "notes": self.notes}
