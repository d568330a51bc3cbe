# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Tables of a run and of references, and how their numbers are shown."""

import csv
import re

import numpy as np

# of a unit: (from which magnitude, factor, what it becomes)
SHOWN = {
    "m": ((0.1, 1.0, "m"), (0.0, 1e3, "mm")),
    "N": ((1e6, 1e-6, "MN"), (1e3, 1e-3, "kN"), (0.0, 1.0, "N")),
    "Pa": ((1e4, 1e-6, "MPa"), (10.0, 1e-3, "kPa"), (0.0, 1.0, "Pa")),
    "s": ((0.1, 1.0, "s"), (0.0, 1e3, "ms")),
}


# factor: what stands before the unit then
PREFIXES = {1.0: "", 1e3: "m", 1e6: "µ", 1e9: "n", 1e-3: "k", 1e-6: "M",
            1e-9: "G"}
PREFIXED = re.compile(r"(m|N|Pa|s|J|W)(?![\w^²])")


class Table:
    """A csv file: lines that begin with # are comments, and the header row
    may be missing."""

    def __init__(self, path):
        self.path = path
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = [
                    [entry.strip() for entry in row]
                    for row in csv.reader(file)
                    if row and not row[0].lstrip().startswith("#")
                ]
        except OSError as error:
            raise ValueError(f"{path}: {error.strerror}") from error
        if not rows:
            raise ValueError(f"{path}: there is nothing in it")
        self.names = []
        try:
            [float(entry) for entry in rows[0]]
        except ValueError:
            self.names = rows.pop(0)
        n = len(self.names) or len(rows[0])
        try:
            # A row that is being written by a running program is left out.
            self.rows = np.array(
                [[float(e or "nan") for e in row] for row in rows
                 if len(row) == n]
            ).reshape(-1, n)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error

    def find(self, column):
        """The index of a column, or None."""
        if isinstance(column, int):
            return column if 0 <= column < self.rows.shape[1] else None
        if column in self.names:
            return self.names.index(column)
        bare = [name.split(" [")[0] for name in self.names]
        return bare.index(column) if bare.count(column) == 1 else None

    def place(self, column):
        """The index of a column that must be there."""
        index = self.find(column)
        if index is None:
            raise ValueError(
                f"{self.path}: there is no column '{column}'; it has "
                + (", ".join(self.names) or f"{self.rows.shape[1]} columns")
            )
        return index

    def column(self, column):
        return self.rows[:, self.place(column)]

    def full_name(self, column):
        index = self.place(column)
        return self.names[index] if self.names else str(column)


def unit_of(label):
    """What stands in brackets at the end of "force [kN]", or nothing."""
    found = re.search(r"\[([^\[\]]*)\]\s*$", label or "")
    return found.group(1) if found and found.group(1) != "-" else ""


def scale_for(unit, largest):
    """Factor and unit in which engineers read values up to @p largest, which
    are in @p unit of the SI."""
    for least, factor, shown in SHOWN.get(unit, ()):
        if largest >= least:
            return factor, shown
    return 1.0, unit


def as_text(value, form="#.3g"):
    """A number without the point at which this form may end."""
    return f"{value:{form}}".rstrip(".")


def with_unit(value, unit, form=".3g"):
    """A number as it is shown, e.g. 0.00102, "m" as "1.02 mm"."""
    factor, shown = scale_for(unit, abs(value))
    return f"{as_text(value * factor, form)} {shown}".rstrip()


def scaled_name(name, factor):
    """What stands at an axis for a column times a factor: "ux [m]" and 1e3 as
    "ux [mm]", -1e-3 of a force as "-fh [kN]", other factors as they are."""
    prefix = PREFIXES.get(float(f"{abs(factor):.9g}"))
    sign = "-" if factor < 0.0 else ""
    if prefix == "":
        return sign + name
    if prefix is None or not PREFIXED.match(unit_of(name)):
        return f"{factor:g} × {name}"
    return sign + name.replace(" [", f" [{prefix}")
