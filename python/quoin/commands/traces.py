# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Turns mapped traces of joints into files for section 'Rock joints'.

  scripts/traces map.dxf --outline "0,0; 60,0; 60,20; 25,45; 0,45"
  scripts/traces map.dxf --unit mm --layers bedding,cross
  scripts/traces map.csv --unit mm --shift=-1200,-300 --out face

CSV: a header and the columns x1, y1, x2, y2, or id, x, y of polylines, point by
point; id and set if there are any; separated by commas, or by semicolons or tabs
(then with decimal commas, if you like). DXF: ASCII; lines and polylines, whose
layer is their set; what else is in it is counted and passed over. --layers takes
some of the layers or sets.

Coordinates are in --unit, by default metres, whatever unit a drawing names, and
are moved by --shift [m]. The screen shows how many traces were read, where they
lie, how long they are, and mean and deviation of the dip of each set. With
--outline, written as in section 'Rock', traces are cut there, and it is said how
many of what length lie outside or were cut; FACE_cut.csv says where. The
traces of each set go to FACE_SET.csv, for

  subsection SET
    set Kind = traces
    set File = FACE_SET.csv
  end
"""

import os
import sys

import numpy as np

from quoin import traces
from quoin.commands.options import Parser, numbers, positive

MOST_PLACES = 5                      # on the screen


def at_places(found, passed, options):
    """The traces in metres, and lines on what was read."""
    factor = traces.UNITS[options.unit or "m"] * options.scale
    found = [t._replace(points=factor * t.points + options.shift)
             for t in found]
    low, high = (np.array([pick(t.points, axis=0) for t in found])
                 for pick in (np.min, np.max))
    (x0, y0), (x1, y1) = low.min(axis=0), high.max(axis=0)
    lengths = [traces.length_of(t) for t in found]
    lines = [f"read {len(found)} traces, x {x0:.6g} to {x1:.6g} m, y {y0:.6g} "
             f"to {y1:.6g} m, {min(lengths):.3g} to {max(lengths):.3g} m long"]
    if options.file.lower().endswith(".dxf"):
        unit = traces.unit_of_drawing(options.file)
        if unit not in (None, options.unit or "m") and options.scale == 1.0:
            lines.append(f"the drawing says that its unit is {unit}; taken "
                         f"for {options.unit or 'm'}: see --unit")
    lines += [f"{n} {what} were passed over" if "chords" not in what
              else f"{n} {what}" for what, n in passed.items()]
    return found, lines


def convert(options):
    """Writes the files; returns the lines on the screen."""
    found, passed = traces.read(options.file, options.layers)
    if not found:
        raise ValueError(f"{options.file}: there are no traces in it"
                         + ("; it has " + ", ".join(
                             f"{n} {what}" for what, n in passed.items())
                            if passed else ""))
    found, lines = at_places(found, passed, options)
    outline = traces.read_outline(options.outline) if options.outline else None
    cuts = [traces.cut(t, outline) for t in found]
    stem = options.out or os.path.splitext(options.file)[0]
    files = traces.write(stem, cuts)
    for group, row in traces.summary(cuts).items():
        dip, deviation = traces.mean_dip([t for t in found if t.set == group])
        lines.append(
            f"{group}: {row['traces']} traces of {row['length [m]']:.6g} m, "
            f"dip {dip:.1f} +- {deviation:.1f} degrees, "
            f"{row['outside']} of {row['outside [m]']:.6g} m outside, "
            f"{row['cut']} cut by {row['cut off [m]']:.6g} m: "
            + files.get(group, "nothing is left"))
    lost = [(one.trace.name, x, y) for one in cuts for x, y in one.lost]
    lines += [f"  trace {name} is outside at ({x:.4g}, {y:.4g}) m"
              for name, x, y in lost[:MOST_PLACES]]
    if lost:
        lines.append(f"  all {len(lost)} places are in {stem}_cut.csv")
    return lines


def main():
    parser = Parser(__doc__)
    parser.add_argument("file", metavar="TRACES", help=".csv or .dxf")
    parser.add_argument("--outline", metavar="'X,Y; X,Y; ...'",
                        help="[m], as in section 'Rock'")
    parser.add_argument("--unit", choices=traces.UNITS,
                        help="of the coordinates, default m")
    parser.add_argument("--scale", type=positive(float), default=1.0,
                        help="of a map, a factor beside --unit, default 1")
    parser.add_argument("--layers", default=[], metavar="NAME,...",
                        type=lambda text: [w.strip() for w in text.split(",")],
                        help="of the drawing, or sets of the table, default "
                             "all")
    parser.add_argument("--shift", type=numbers, default=[0.0, 0.0],
                        metavar="X,Y", help="then [m]")
    parser.add_argument("--out", metavar="FACE",
                        help="beginning of the names of the files, default "
                             "that of TRACES without its ending")
    options = parser.parse_args()
    if len(options.shift) != 2:
        parser.error("--shift takes two numbers")
    try:
        print("\n".join(convert(options)))
    except (OSError, ValueError) as error:
        sys.exit(f"traces: {error}")


if __name__ == "__main__":
    main()
