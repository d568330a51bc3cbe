# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The moments of a run that a figure shows: given as times, or by the values
of a history."""

from collections import namedtuple
import os

import numpy as np

from quoin import vtu
from quoin.csv_table import Table, unit_of, with_unit

SLACK = 1e-3                         # of the range of a history
# label: what is written above the picture, None: the time
Moment = namedtuple("Moment", "time label", defaults=(None,))


def recorded_times(output, series):
    """The times [s] at which a series, e.g. "blocks.pvd", has fields."""
    times = [time for time, _ in vtu.read_pvd(os.path.join(output, series))]
    if not times:
        raise ValueError(f"no fields are listed in "
                         f"{os.path.join(output, series)}; was a field "
                         f"written?")
    return np.array(times)


def check_times(output, series, wanted):
    """Refuses times [s] that are farther from all fields than these are from
    each other."""
    recorded = recorded_times(output, series)
    gap = max(np.diff(recorded), default=0.5 * abs(recorded[0]))
    for time in wanted:
        if not recorded[0] - gap <= time <= recorded[-1] + gap:
            raise ValueError(f"no field was written near {time:g} s: they are "
                             f"from {recorded[0]:g} to {recorded[-1]:g} s")


def decimals(step):
    """As many as tell numbers apart that differ by so much."""
    return int(np.clip(np.ceil(-np.log10(step) - 1e-9), 0, 12))


def time_form(times, digits=4):
    """The form in which times [s] are written above pictures beside each other:
    with so many digits, or the decimals that it takes to tell them apart, such
    as those of a blast after a long stage."""
    times = np.unique(times)
    if len({f"{time:.{digits}g}" for time in times}) == len(times):
        return f"{digits}g"
    return f"{decimals(np.diff(times).min())}f"


def film_form(times):
    """The same for a film, as long in all of its pictures."""
    span = np.ptp(times)
    return "2f" if span == 0.0 else (
        f"{max(2, decimals(span / (len(times) - 1)))}f")


def time_when(time, value, wanted, name):
    """When a history first reaches a value [s], on the line between rows.

    @p wanted is a number, "peak" (the largest magnitude) or "end". A history
    that never reaches it is a ValueError.
    """
    known = np.isfinite(value)
    time, value = time[known], value[known]
    if len(value) == 0:
        raise ValueError(f"'{name}' has no values")
    if wanted == "end":
        return time[-1]
    if wanted == "peak":
        return time[np.abs(value).argmax()]
    beyond = (value >= wanted) if wanted >= value[0] else (value <= wanted)
    if not beyond.any():
        # A run ends a step before its last value: 3.9999 mm stands for 4.
        nearest = np.abs(value - wanted).argmin()
        if abs(value[nearest] - wanted) <= SLACK * np.ptp(value):
            return time[nearest]
        raise ValueError(f"'{name}' never reaches {wanted:g}: it is from "
                         f"{value.min():g} to {value.max():g}")
    k = int(beyond.argmax())
    if k == 0:
        return time[0]
    return np.interp(wanted, *(zip(*sorted(
        [(value[k - 1], time[k - 1]), (value[k], time[k])]))))


def read_at(text):
    """"displacement=1e-3,2e-3,peak" as a column and what it is to reach."""
    column, sign, words = text.rpartition("=")
    wanted = []
    for word in (word.strip() for word in words.split(",")):
        if word not in ("peak", "end"):
            try:
                word = float(word)
            except ValueError:
                sign = ""
        wanted.append(word)
    if not sign or not column.strip():
        raise ValueError(f"expected COLUMN=VALUE,VALUE,... in the units of the "
                         f"table, or peak, or end, not '{text}'")
    return column.strip(), wanted


def moments_at(output, text, series="blocks.pvd"):
    """The fields that are nearest to where a history first reaches values,
    each with the value that it has there."""
    column, wanted = read_at(text)
    table = Table(os.path.join(output, "histories.csv"))
    time, value = table.column(0), table.column(column)
    name = table.full_name(column)
    recorded = recorded_times(output, series)
    moments = {}
    for target in wanted:
        when = time_when(time, value, target, name)
        field = recorded[np.abs(recorded - when).argmin()]
        if field in moments:
            raise ValueError(
                f"{column} = {moments[field][0]} and {target} have the same "
                f"nearest field, at {field:g} s; lower 'Output/Field "
                f"interval'")
        there = with_unit(np.interp(field, time, value), unit_of(name),
                          "#.3g")
        moments[field] = (target, Moment(
            field, f"{name.split(' [')[0]} {there}"
            + (f" ({target})" if target in ("peak", "end") else "")))
    return [moment for _, moment in moments.values()]
