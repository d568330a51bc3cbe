# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Tables of columns: data frames of pandas if it is installed, else Columns,
whose columns are asked for in the same way."""

import numpy as np

try:
    import pandas
except ImportError:
    pandas = None


class Columns(dict):
    """{name: array}, all of one length; table["ux"], table.columns and
    len(table) are what they are of a data frame."""

    def __init__(self, columns):
        super().__init__((name, np.asarray(values))
                         for name, values in columns.items())

    @property
    def columns(self):
        return list(self)

    def __missing__(self, name):
        raise KeyError(f"there is no column '{name}'; there are "
                       + (", ".join(map(str, self)) or "none"))

    def __len__(self):
        return len(next(iter(self.values()), ()))

    def __repr__(self):
        rows = [self.columns] + [
            [f"{value:.6g}" if isinstance(value, float) else str(value)
             for value in row] for row in zip(*self.values())]
        widths = [max(map(len, column)) for column in zip(*rows)]
        return "\n".join("  ".join(map(str.rjust, row, widths))
                         for row in rows)


def frame(columns):
    """A table of {name: values}."""
    return pandas.DataFrame(columns) if pandas else Columns(columns)
