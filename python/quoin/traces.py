# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Mapped traces of joints, from CSV tables or DXF drawings, as the files that
"Kind = traces" in section 'Rock joints' reads, cut at an outline."""

from collections import namedtuple
import csv
import re

import numpy as np

from quoin.geometry import cross, is_inside

UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "km": 1e3, "in": 0.0254,
         "ft": 0.3048}               # [m]
DXF_UNITS = {"1": "in", "2": "ft", "4": "mm", "5": "cm", "6": "m", "7": "km"}
# points: (n, 2) [m], a polyline
Trace = namedtuple("Trace", "name set points")
# of a trace: its length [m] as read and within the outline, parts that are
# left, [(n, 2)], and the middles of parts that are not [m]
Cut = namedtuple("Cut", "trace length inside parts lost")


def read(path, layers=()):
    """Traces of a .dxf or else of a CSV file, of these @p layers of the drawing
    or sets of the table, by default of all, and what was passed over, {what:
    how often}."""
    found, passed = (read_dxf(path) if path.lower().endswith(".dxf") else
                     (read_csv(path), {}))
    known = list(dict.fromkeys(trace.set for trace in found))
    for name in layers:
        if name not in known:
            raise ValueError(f"{path}: there are no traces in '{name}'; there "
                             f"are in {', '.join(known) or 'none'}")
    for name in known:
        if layers and name not in layers:
            passed[f"traces of {name}"] = sum(t.set == name for t in found)
    points = [t for t in found if length_of(t) == 0.0]
    if points:
        passed["traces without length"] = len(points)
    return [t for t in found if length_of(t) > 0.0
            and (not layers or t.set in layers)], passed


def length_of(trace):
    """[m]"""
    return np.linalg.norm(np.diff(trace.points, axis=0), axis=1).sum()


def mean_dip(traces):
    """Mean and standard deviation of the dips of traces, weighted by length
    [deg]; from the x axis, anticlockwise, as in section 'Rock joints', between
    -90 and 90. Of a dip and one 180 degrees larger, which are the same."""
    ways = np.vstack([np.diff(t.points, axis=0) for t in traces])
    length = np.linalg.norm(ways, axis=1)
    # twice the angle has one value for both senses of a line
    double = (length * np.exp(2j * np.arctan2(ways[:, 1], ways[:, 0]))).sum()
    alike = min(abs(double) / length.sum(), 1.0)
    return (0.5 * np.degrees(np.angle(double)),
            0.5 * np.degrees(np.sqrt(-2.0 * np.log(max(alike, 1e-12))) + 0.0))


def read_csv(path):
    """Traces of a table with a header, separated by semicolons, tabs or commas:
    x1, y1, x2, y2, a trace each row, or x, y and id, a row each point of
    a polyline; id and set if there are any. Units in brackets behind the names
    are passed over; without commas between them numbers may have a decimal one."""
    with open(path, newline="", encoding="utf-8-sig") as file:
        lines = file.read().splitlines()
    heading = next((line for line in lines if line.strip()
                    and not line.startswith("#")), "")
    mark = next((m for m in ";\t" if m in heading), ",")
    names, found = None, {}
    for number, words in enumerate(csv.reader(lines, delimiter=mark), 1):
        words = [word.strip() for word in words]
        if not any(words) or words[0].startswith("#"):
            continue
        if names is None:
            names = [re.sub(r"\s*[\[(].*", "", w).lower() for w in words]
            ends = check_heading(path, names)
            continue
        row = dict(zip(names, words))
        try:
            if len(words) < len(names):
                raise ValueError("has too few columns")
            points = [[number_of(row[name], mark) for name in pair]
                      for pair in ends]
        except ValueError as error:
            raise ValueError(f"{path}, line {number}: {error}") from error
        group = row.get("set") or "traces"
        name = row.get("id") or str(number)
        key = (name, group) if len(ends) == 1 else number
        found.setdefault(key, Trace(name, group, [])).points.extend(points)
    if names is None:
        check_heading(path, [])
    for trace in found.values():
        if len(trace.points) < 2:
            raise ValueError(f"{path}: trace '{trace.name}' has one point")
    return [t._replace(points=np.array(t.points)) for t in found.values()]


def check_heading(path, names):
    """The columns of the points of a row."""
    if {"x1", "y1", "x2", "y2"} <= set(names):
        return (("x1", "y1"), ("x2", "y2"))
    if {"id", "x", "y"} <= set(names):
        return (("x", "y"),)
    raise ValueError(f"{path}: the first row names the columns "
                     f"{', '.join(names) or '(none)'}; it needs x1, y1, x2, y2,"
                     " or id, x, y, and may have id and set")


def number_of(word, mark):
    value = float(word if mark == "," else word.replace(",", "."))
    if not np.isfinite(value):
        raise ValueError(f"'{word}' is no length")
    return value


def dxf_pairs(path):
    """(code, value) of an ASCII DXF file."""
    with open(path, "rb") as file:
        content = file.read()
    if content.startswith(b"AutoCAD Binary DXF"):
        raise ValueError(f"{path}: a binary DXF file; save it as ASCII DXF")
    lines = content.decode("utf-8-sig", "replace").splitlines()
    for k in range(0, len(lines) - 1, 2):
        try:
            yield int(lines[k]), lines[k + 1].strip()
        except ValueError as error:
            raise ValueError(f"{path}, line {k + 1}: '{lines[k].strip()}' is "
                             "no group code of a DXF file") from error


def dxf_entities(path):
    """(type, [(code, value), ...]) of the section ENTITIES."""
    section, entity = None, None
    for code, value in dxf_pairs(path):
        if code == 0:
            if entity and section == "ENTITIES":
                yield entity
            entity = (value, [])
            section = None if value == "ENDSEC" else section
        elif code == 2 and entity and entity[0] == "SECTION":
            section, entity = value, None
        elif entity:
            entity[1].append((code, value))


def unit_of_drawing(path):
    """The unit that a DXF drawing names, $INSUNITS, or None."""
    pairs = dxf_pairs(path)
    for _, value in pairs:
        if value == "ENTITIES":
            return None
        if value == "$INSUNITS":
            return DXF_UNITS.get(next(pairs, (70, ""))[1])
    return None


def read_dxf(path):
    """Traces of the lines and polylines of an ASCII DXF drawing, in x and y;
    the set is the layer, the name the handle. Returns also {what: how often}
    of arcs in polylines, which become their chords, and of other entities,
    which are passed over: also those in blocks."""
    traces, passed, open_line = [], {}, None

    def count(what):
        passed[what] = passed.get(what, 0) + 1

    def add(name, group, points, is_closed):
        points = np.array(points + points[:1] * is_closed, dtype=float)
        if len(points) > 1:
            traces.append(Trace(name, group, points))

    for kind, pairs in dxf_entities(path):
        first = dict(reversed(pairs))
        name = first.get(5) or str(len(traces) + 1)
        group = first.get(8) or "0"
        flags = int(first.get(70, 0))
        xs, ys = ([float(v) for c, v in pairs if c == code]
                  for code in (10, 20))
        if kind == "LINE":
            add(name, group, [(xs[0], ys[0]), (float(first[11]),
                                               float(first[21]))], False)
        elif kind == "LWPOLYLINE":
            add(name, group, list(zip(xs, ys)), bool(flags & 1))
        elif kind == "POLYLINE" and not flags & (16 | 64):
            open_line = (name, group, [], bool(flags & 1))
        elif kind == "VERTEX" and open_line:
            # control points of splines are not on the curve
            open_line[2].extend(zip(xs, ys) if not flags & 16 else ())
        elif kind == "SEQEND" and open_line:
            add(*open_line)
            open_line = None
        elif kind not in ("VERTEX", "SEQEND"):
            count(kind)
        for code, value in pairs:
            if code == 42 and kind in ("LWPOLYLINE", "VERTEX") \
                    and float(value) != 0.0:
                count("arcs in polylines, now chords")
    return traces, passed


def read_outline(text):
    """"x, y; x, y; ...", as 'Outline' of section 'Rock', (n, 2) [m]."""
    try:
        points = np.array([[float(word) for word in pair.split(",")]
                           for pair in text.split(";") if pair.strip()])
    except ValueError:
        points = np.zeros(0)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
        raise ValueError(f"the outline '{text}' is not three or more points "
                         "'x, y; x, y; ...' [m]")
    return points


def pieces(a, b, outline):
    """Shares of the line from a to b at which it crosses an outline, with 0
    and 1, and whether each piece between them is inside."""
    c, d = outline, np.roll(outline, -1, axis=0)
    turn = cross(b - a, d - c)
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = cross(c - a, d - c) / turn, cross(c - a, b - a) / turn
    met = s[(turn != 0.0) & (s > 1e-9) & (s < 1.0 - 1e-9) & (t >= 0.0)
            & (t <= 1.0)]
    cuts = np.concatenate([[0.0], np.sort(met), [1.0]])
    # through a corner it crosses two sides at one place
    cuts = cuts[np.diff(cuts, prepend=-1.0) > 1e-9]
    return cuts, [is_inside(a + 0.5 * (p + q) * (b - a), outline)
                  for p, q in zip(cuts, cuts[1:])]


def cut(trace, outline):
    """The Cut of a trace at an outline (n, 2) [m], or None for no outline."""
    length = length_of(trace)
    if outline is None:
        return Cut(trace, length, length, [trace.points], [])
    parts, lost, inside = [], [], 0.0
    was_inside = False
    for a, b in zip(trace.points, trace.points[1:]):
        if not (a != b).any():
            continue
        cuts, within = pieces(a, b, outline)
        for p, q, is_in in zip(cuts, cuts[1:], within):
            ends = [a + p * (b - a), a + q * (b - a)]
            if is_in:
                inside += np.linalg.norm(ends[1] - ends[0])
                if was_inside:
                    parts[-1].append(ends[1])
                else:
                    parts.append(ends)
            else:
                lost.append(0.5 * (ends[0] + ends[1]))
            was_inside = is_in
    return Cut(trace, length, inside, [np.array(p) for p in parts], lost)


def file_name(stem, group):
    """Name of the file with the traces of a set."""
    return f"{stem}_{re.sub(r'[^A-Za-z0-9_-]+', '_', group)}.csv"


def write(stem, cuts):
    """Writes a file of x1, y1, x2, y2 [m] for each set of these Cuts and,
    where something was cut off, STEM_cut.csv, which says what and where.
    Returns {set: file}; sets without a trace inside have none."""
    rows, lost = {}, []
    for one in cuts:
        for part in one.parts:
            for a, b in zip(part, part[1:]):
                rows.setdefault(one.trace.set, []).append((*a, *b))
        lost += [[one.trace.name, one.trace.set, f"{one.length:.6g}",
                  f"{one.inside:.6g}", f"{x:.6g}", f"{y:.6g}"]
                 for x, y in one.lost]
    files = {group: file_name(stem, group) for group in rows}
    taken = [file_name(stem, "cut"), *files.values()]
    for group, path in files.items():
        if taken.count(path) > 1:
            raise ValueError(f"the set '{group}' would go to {path}, as "
                             "something else does: rename it")
    for group, path in files.items():
        write_rows(path, ["x1", "y1", "x2", "y2"],
                   [[f"{value:.10g}" for value in row]
                    for row in rows[group]])
    if lost:
        write_rows(file_name(stem, "cut"),
                   ["id", "set", "length [m]", "inside [m]", "x [m]", "y [m]"],
                   lost)
    return files


def write_rows(path, heading, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([heading, *rows])


def summary(cuts):
    """{set: {"traces", "length [m]", "outside", "outside [m]", "cut",
    "cut off [m]"}}: as read, those wholly outside, and those of which a part
    was cut off, with that length."""
    found = {}
    for one in cuts:
        row = found.setdefault(one.trace.set, dict.fromkeys(
            ("traces", "length [m]", "outside", "outside [m]", "cut",
             "cut off [m]"), 0))
        row["traces"] += 1
        row["length [m]"] += one.length
        kind = ("outside", "outside [m]") if not one.parts else (
            "cut", "cut off [m]")
        row[kind[0]] += bool(one.lost)
        row[kind[1]] += one.length - one.inside if one.lost else 0.0
    return found
