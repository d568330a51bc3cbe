# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Figures of curves for scripts/plot, from a description as in plot.json."""

import json
import os
import re

import matplotlib.pyplot as plt
import numpy as np

from quoin.colours import CURVES
from quoin.csv_table import Table, scaled_name, unit_of
from quoin.stages import begin, time_of

MILLIMETRES = 1.0 / 25.4
STYLES = ("-", "--", ":", "-.")
BAND = "#b8c4cc"
AT_END = 0.02                        # of the range of x


def read_specs(path):
    """The figures that a plot.json describes, at least one."""
    try:
        with open(path, encoding="utf-8") as file:
            specs = json.load(file)
    except OSError as error:
        raise ValueError(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise ValueError(f"{path}: {error}") from error
    specs = specs if isinstance(specs, list) else [specs]
    if not specs:
        raise ValueError(f"{path}: it describes no figure")
    return specs


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_column(value):
    return isinstance(value, str) or (isinstance(value, int)
                                      and not isinstance(value, bool))


def is_pair(value):
    return (isinstance(value, list) and len(value) == 2
            and all(is_number(v) for v in value))


NUMBER = (is_number, "a number")
TEXT = (lambda v: v is None or isinstance(v, str), "a text")
COLUMN = (is_column, "the name of a column or its number from 0")
MOMENT = (lambda v: is_number(v) or isinstance(v, str),
          "a time [s] or the name of a stage")
PAIR = (is_pair, "two numbers, [from, to]")
FLAG = (lambda v: isinstance(v, bool), "true or false")
PLACE = (lambda v: isinstance(v, (bool, str)), "true, false or a place such "
         "as \"lower right\"")
OBJECT = (lambda v: isinstance(v, dict), "an object, {...}")
LIST = (lambda v: isinstance(v, list) and all(isinstance(e, dict) for e in v),
        "a list of objects, [{...}, ...]")

KEYS = {
    "figure": {"out": TEXT, "title": TEXT, "table": TEXT, "x": OBJECT,
               "y": OBJECT, "curves": LIST, "references": LIST,
               "bands": LIST, "runs": LIST, "peak": FLAG, "legend": PLACE,
               "size": PAIR, "after": MOMENT},
    "x": {"column": COLUMN, "factor": NUMBER, "label": TEXT, "limits": PAIR},
    "y": {"factor": NUMBER, "label": TEXT, "limits": PAIR},
    "curves": {"column": COLUMN, "label": TEXT, "factor": NUMBER, "x": COLUMN,
               "style": TEXT, "color": TEXT, "table": TEXT, "peak": FLAG},
    "references": {"file": TEXT, "x": COLUMN, "y": COLUMN, "x_factor": NUMBER,
                   "y_factor": NUMBER, "label": TEXT, "style": TEXT,
                   "color": TEXT, "peak": FLAG},
    "bands": {"from": NUMBER, "to": NUMBER, "over": PAIR, "curves": LIST,
              "label": TEXT, "color": TEXT},
    "curves of a band": {"file": TEXT, "x": COLUMN, "y": COLUMN,
                         "x_factor": NUMBER, "y_factor": NUMBER},
    "runs": {"folder": TEXT, "label": TEXT},
}
NEEDED = {"curves": ("column",), "references": ("file",),
          "curves of a band": ("file",), "runs": ("folder",)}


def check(what, entry):
    """A misspelt key must not be passed over in silence."""
    if not isinstance(entry, dict):
        raise ValueError(f"the description's {what} must be an object, {{...}}")
    for key, value in entry.items():
        if key not in KEYS[what]:
            raise ValueError(
                f"the description's {what} has no key '{key}'; it knows "
                + ", ".join(sorted(KEYS[what])))
        is_good, wanted = KEYS[what][key]
        if not is_good(value):
            raise ValueError(f"the description's {what}: '{key}' must be "
                             f"{wanted}, not {value!r}")
    for key in NEEDED.get(what, ()):
        if key not in entry:
            raise ValueError(f"the description's {what} need '{key}'")


def check_figure(spec):
    """Stops at the first entry that the description should not have."""
    check("figure", spec)
    for what in ("x", "y"):
        check(what, spec.get(what, {}))
    for what in ("curves", "references", "bands", "runs"):
        for entry in spec.get(what, []):
            check(what, entry)
    for band in spec.get("bands", []):
        for entry in band.get("curves", []):
            check("curves of a band", entry)
        if ("curves" in band) == ("from" in band or "to" in band):
            raise ValueError("a band has either 'from' and 'to' or 'curves'")
        if "curves" in band and len(band["curves"]) < 2:
            raise ValueError("a band needs two or more 'curves', between "
                             "which it lies")
        if "curves" not in band:
            if not ("from" in band and "to" in band):
                raise ValueError("a band without 'curves' needs both 'from' "
                                 "and 'to'")
            if band["from"] > band["to"]:
                raise ValueError(f"a band goes from the smaller value to the "
                                 f"larger, not from {band['from']:g} to "
                                 f"{band['to']:g}")
    if not spec.get("curves"):
        raise ValueError("the description of the figure has no \"curves\"")


def reference_points(reference, beside):
    """x and y of a csv file beside the description."""
    data = Table(os.path.join(beside, reference["file"]))
    return (data.column(reference.get("x", 0)) * reference.get("x_factor", 1.0),
            data.column(reference.get("y", 1)) * reference.get("y_factor", 1.0))


def envelope(curves):
    """x, smallest and largest y of curves where all of them are; each needs
    an x that grows. @p curves: (name, x, y)."""
    for name, x, _ in curves:
        if len(x) < 2 or not (np.diff(x) > 0.0).all():
            raise ValueError(f"{name}: a band needs curves of two or more "
                             f"points whose x grows from row to row")
    first = max(x[0] for _, x, _ in curves)
    last = min(x[-1] for _, x, _ in curves)
    if first >= last:
        raise ValueError("the curves of a band have no x in common: "
                         + ", ".join(f"{name} from {x[0]:g} to {x[-1]:g}"
                                     for name, x, _ in curves))
    x = np.unique(np.concatenate([x for _, x, _ in curves]))
    x = x[(x >= first) & (x <= last)]
    y = np.array([np.interp(x, *curve[1:]) for curve in curves])
    return x, y.min(axis=0), y.max(axis=0)


def draw_band(axes, band, beside):
    look = {"color": band.get("color", BAND), "alpha": 0.55, "linewidth": 0,
            "label": band.get("label", "experiments"), "zorder": 1}
    if "curves" not in band:
        if "over" in band:
            axes.fill_between(band["over"], band["from"], band["to"], **look)
        else:
            axes.axhspan(band["from"], band["to"], **look)
        return
    axes.fill_between(*envelope(
        [(curve["file"], *reference_points(curve, beside))
         for curve in band["curves"]]), **look)


def peak_of(x, y, limits):
    """Index of the largest magnitude within the limits of x, and whether the
    curve rises to its end there; None if there is nothing."""
    seen = np.isfinite(x) & np.isfinite(y)
    if limits:
        seen &= (x >= min(limits)) & (x <= max(limits))
    if not seen.any():
        return None
    k = int(np.where(seen, np.abs(y), -1.0).argmax())
    return k, abs(x[seen][-1] - x[k]) <= AT_END * np.ptp(x[seen])


def look_of(style, colour):
    """The colour, unless the style has one."""
    return {} if re.search(r"[bgrcmykw]|C\d", style) else {"color": colour}


def has_unit(label):
    return bool(label) and "[" in label


def labelled(label, name):
    """A label with the unit of a column, if it has none, or the column's name,
    if there is no label."""
    if not label:
        return name
    unit = unit_of(name)
    return label if has_unit(label) or not unit else f"{label} [{unit}]"


class CurveFigure:
    """Draws one description of one or several runs, (folder, label)."""

    def __init__(self, spec, runs, beside):
        check_figure(spec)
        self.spec = spec
        self.beside = beside
        self.runs = list(runs) + [
            (os.path.join(beside, run["folder"]), run.get("label"))
            for run in spec.get("runs", [])]
        self.x = spec.get("x", {})
        self.y = spec.get("y", {})
        self.tables = {}
        main = self.table(self.runs[0][0], {})
        self.x_label = labelled(self.x.get("label"), scaled_name(
            main.full_name(self.x.get("column", 0)),
            self.x.get("factor", 1.0)))
        self.y_label = self.label_of(self.panels()[0])

    def table(self, folder, curve):
        name = curve.get("table", self.spec.get("table", "histories.csv"))
        path = os.path.join(folder, name)
        if path not in self.tables:
            self.tables[path] = self.rows_after(folder, Table(path))
        return self.tables[path]

    def rows_after(self, folder, table):
        """The rows from "after" on, of the run in this folder."""
        if self.spec.get("after") is None:
            return table
        if table.names[:1] != ["time [s]"]:
            raise ValueError(f"{table.path}: its rows have no time, after "
                             f"which they could be drawn")
        after = time_of(folder, self.spec["after"], begin)
        table.rows = table.rows[table.rows[:, 0] >= after]
        if len(table.rows) == 0:
            raise ValueError(f"{table.path}: no row is after {after:g} s")
        return table

    def points(self, folder, curve):
        """x and y of a curve of a run, as they are shown."""
        data = self.table(folder, curve)
        x = data.column(curve.get("x", self.x.get("column", 0)))
        return (x * self.x.get("factor", 1.0),
                data.column(curve["column"]) * self.factor(curve))

    def factor(self, curve):
        return curve.get("factor", self.y.get("factor", 1.0))

    def name_of(self, curve):
        """Name of the column, with the unit in which it is shown."""
        return scaled_name(self.table(self.runs[0][0], curve).full_name(
            curve["column"]), self.factor(curve))

    def panels(self):
        """The curves of each axes with their numbers: those of one unit share
        one, unless the y axis has a label with a unit for all."""
        curves = list(enumerate(self.spec["curves"]))
        if has_unit(self.y.get("label")):
            return [curves]
        panels = {}
        for c, curve in curves:
            panels.setdefault(unit_of(self.name_of(curve)), []).append(
                (c, curve))
        return list(panels.values())

    def label_of(self, panel):
        """Label of the y axis."""
        name = self.name_of(panel[0][1])
        if self.y.get("label") or len(panel) == 1:
            return labelled(self.y.get("label"), name)
        return f"[{unit_of(name)}]" if unit_of(name) else ""

    def place_at(self, time):
        """Point of the first curve of the first run at a time [s]."""
        folder, curve = self.runs[0][0], self.spec["curves"][0]
        when = self.table(folder, curve).column(0)
        return [np.interp(time, when, value)
                for value in self.points(folder, curve)]

    def line(self, axes, entry, points, style, colour, label, **look):
        """A curve, with its peak if that is wanted."""
        x, y = points
        style = entry.get("style", style)
        look.update(look_of(style, colour) if "color" not in entry
                    else {"color": entry["color"]})
        line = axes.plot(x, y, style, **look)[0]
        peak = (peak_of(x, y, self.x.get("limits"))
                if entry.get("peak", self.spec.get("peak", False)) else None)
        if peak is not None:
            k, at_end = peak
            label += (f", peak {y[k]:.3g} {unit_of(axes.get_ylabel())}".rstrip()
                      + f" at {x[k]:.3g} {unit_of(self.x_label)}".rstrip()
                      + (" (at its end)" if at_end else ""))
            axes.plot(x[k], y[k], "o", color=line.get_color(), markersize=5,
                      markeredgecolor="white", zorder=4, clip_on=False)
        line.set_label(label)

    def draw_references(self, axes, panel):
        """Draws the references of the panel's columns; others are in the first
        one."""
        markers = iter("os^Dv<>p*" * 4)
        here = [curve["column"] for _, curve in panel]
        known = [curve["column"] for curve in self.spec["curves"]]
        for reference in self.spec.get("references", []):
            column = reference.get("y")
            if (column not in here if column in known else panel[0][0] > 0):
                continue
            # Experiments are marked at their peak only if they ask for it.
            entry = dict(reference, peak=reference.get("peak", False))
            self.line(
                axes, entry, reference_points(reference, self.beside),
                style=next(markers), colour="0.45",
                markersize=4, markerfacecolor="none",
                label=reference.get(
                    "label", os.path.splitext(reference["file"])[0]))

    def draw_runs(self, axes, panel):
        several = len(self.runs) > 1
        for r, (folder, run_label) in enumerate(self.runs):
            run_label = run_label or os.path.basename(os.path.abspath(folder))
            for c, curve in panel:
                name = curve.get("label") or self.name_of(curve)
                label = (name if not several else run_label
                         if len(panel) == 1 else f"{run_label}: {name}")
                self.line(axes, curve, self.points(folder, curve),
                          style=STYLES[(c if several else c // len(CURVES))
                                       % len(STYLES)],
                          colour=f"C{r if several else c}", label=label)

    def draw(self, axes, panel=None):
        """Everything of a panel, by default the first one, but the title and
        the legend."""
        panel = panel or self.panels()[0]
        axes.set_xlabel(self.x_label)
        axes.set_ylabel(self.label_of(panel))
        if panel[0][0] == 0:
            for band in self.spec.get("bands", []):
                draw_band(axes, band, self.beside)
        # References first, so that the program's own curves lie on top.
        self.draw_references(axes, panel)
        self.draw_runs(axes, panel)
        for limits, setter in ((self.x, axes.set_xlim),
                               (self.y, axes.set_ylim)):
            if "limits" in limits:
                setter(*limits["limits"])

    def has_legend(self, axes):
        handles, _ = axes.get_legend_handles_labels()
        return self.spec.get("legend", len(handles) > 1
                             or self.spec.get("peak", False))

    def draw_legend(self, axes, **look):
        wanted = self.has_legend(axes)
        if wanted:
            # readable where no place is free of curves
            axes.legend(loc=wanted if isinstance(wanted, str) else "best",
                        frameon=True, framealpha=0.85, edgecolor="none",
                        **look)

    def save(self, path=None):
        """Writes the picture and returns its name."""
        size = np.array(self.spec.get("size", [152.4, 106.7])) * MILLIMETRES
        panels = self.panels()
        size[1] *= 1.0 if len(panels) == 1 else 0.6 * len(panels)
        figure, all_axes = plt.subplots(
            len(panels), figsize=size, constrained_layout=True, sharex=True,
            squeeze=False)
        for axes, panel in zip(all_axes.flat, panels):
            self.draw(axes, panel)
            axes.label_outer()
            self.draw_legend(axes, fontsize=8.5)
        if self.spec.get("title"):
            all_axes[0, 0].set_title(self.spec["title"])
        figure.align_ylabels()
        path = path or os.path.join(
            self.runs[0][0], self.spec.get("out", "force_displacement.png"))
        figure.savefig(path)
        plt.close(figure)
        return path
