# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Turns mapped traces of joints into files for section 'Rock joints'.

  scripts/traces map.dxf --outline "0,0; 60,0; 60,20; 25,45; 0,45"
  scripts/traces map.csv --scale 0.001 --shift=-1200,-300 --out face

CSV: a header and the columns x1, y1, x2, y2, or id, x, y of polylines, point by
point; id and set if there are any; separated by commas or semicolons (then with
decimal commas, if you like). DXF: ASCII; lines and polylines, whose layer is
their set; what else is in it is counted and passed over.

Coordinates are multiplied by --scale and then moved by --shift [m]. With
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

from quoin import traces
from quoin.commands.options import Parser, numbers, positive

MOST_PLACES = 5                      # on the screen


def convert(options):
    """Writes the files; returns the lines on the screen."""
    found, passed = traces.read(options.file)
    if not found:
        raise ValueError(f"{options.file}: there are no traces in it"
                         + ("; it has " + ", ".join(
                             f"{n} {what}" for what, n in passed.items())
                            if passed else ""))
    outline = traces.read_outline(options.outline) if options.outline else None
    cuts = [traces.cut(t._replace(points=options.scale * t.points
                                  + options.shift), outline) for t in found]
    stem = options.out or os.path.splitext(options.file)[0]
    files = traces.write(stem, cuts)
    lines = [f"{n} {what} were passed over" if "chords" not in what
             else f"{n} {what}" for what, n in passed.items()]
    for group, row in traces.summary(cuts).items():
        lines.append(
            f"{group}: {row['traces']} traces of {row['length [m]']:.6g} m, "
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
    parser.add_argument("--scale", type=positive(float), default=1.0,
                        help="of the coordinates, to metres, default 1")
    parser.add_argument("--shift", type=numbers, default=[0.0, 0.0],
                        metavar="X,Y", help="after --scale [m]")
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
