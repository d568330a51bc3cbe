# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes polygons of blocks as a gmsh geometry with joints between them.

  scripts/polygons blocks.csv --size 0.1 --out wall.geo
  scripts/polygons blocks.json --size 0.1 --size ground=1 \\
                   --boundary base=0,0,3,0
  scripts/polygons piers.csv --elements 4 --out bridge.geo --arch \\
      span=4,rise=1,thickness=0.4,voussoirs=21,springer=0.8x0.5,cover=0.3

The file is CSV with the columns name, group, x, y, a row each vertex, or JSON,
a list of {"name": ..., "group": ..., "vertices": [[x, y], ...]}; metres.

Each polygon becomes a block, each group a physical surface, the edges that two
polygons share the physical curve 'joint', which "Joints along = joint" in
section 'Mesh' opens. A vertex on another polygon's edge is set into it;
polygons that overlap are refused. --arch adds the blocks of an arch, whose
intrados springs at y = 0 to both sides of x = 0 (quoin.geometry.arch): rise and
span of the intrados, and, if wanted, springer=WIDTHxHEIGHT, the level of a
backing, and the cover of a fill over the crown.
"""

import argparse
import os
import sys

from quoin import geometry
from quoin.commands.options import Parser, numbers, positive

LENGTHS = ("span", "rise", "thickness", "backing", "cover")


def arch_words(text):
    """The arguments of geometry.arch()."""
    words = {}
    try:
        for word in text.split(","):
            name, _, value = word.strip().partition("=")
            if name == "springer":
                width, height = value.split("x")
                words[name] = (float(width), float(height))
            elif name == "voussoirs":
                words[name] = int(value)
            elif name in LENGTHS:
                words[name] = float(value)
            else:
                raise ValueError
    except ValueError as error:
        raise argparse.ArgumentTypeError(
            f"'{word}' is none of {', '.join(LENGTHS)}, voussoirs = a number, "
            "springer = WIDTHxHEIGHT") from error
    missing = {"span", "rise", "thickness", "voussoirs"} - set(words)
    if missing:
        raise argparse.ArgumentTypeError(
            f"{', '.join(sorted(missing))} is missing")
    return words


def named(convert, form):
    """NAME=VALUE as a pair."""
    def pair(text):
        name, _, value = text.rpartition("=")
        try:
            return name, convert(value)
        except ValueError as error:
            raise argparse.ArgumentTypeError(
                f"expected {form}, not '{text}'") from error
    return pair


def line(text):
    values = tuple(numbers(text))
    if len(values) != 4:
        raise ValueError
    return values


def write(options):
    """Writes the geometry; returns its name and what is in it."""
    polygons = [polygon for path in options.files
                for polygon in geometry.read_polygons(path)]
    if options.arch:
        polygons += geometry.arch(**options.arch)
    path = options.out or (os.path.splitext(options.files[0])[0]
                           if options.files else "arch") + ".geo"
    return path, geometry.write_geo(
        path, polygons, size=dict(options.size) or None,
        elements=options.elements, boundaries=dict(options.boundary))


def main():
    parser = Parser(__doc__)
    parser.add_argument("files", metavar="POLYGONS", nargs="*",
                        help=".csv or .json")
    parser.add_argument("--arch", type=arch_words, metavar="NAME=VALUE,...")
    parser.add_argument("--size", action="append", default=[],
                        type=named(float, "[GROUP=]SIZE"),
                        metavar="[GROUP=]SIZE", help="of the cells [m]")
    parser.add_argument("--elements", type=positive(int), metavar="N",
                        help="on each edge, instead of a size")
    parser.add_argument("--boundary", action="append", default=[],
                        type=named(line, "NAME=X0,Y0,X1,Y1"),
                        metavar="NAME=X0,Y0,X1,Y1",
                        help="name of the outer edges on this line [m]")
    parser.add_argument("--out", metavar="FILE", help="default POLYGONS.geo")
    try:
        path, found = write(parser.parse_args())
    except (OSError, ValueError) as error:
        sys.exit(f"polygons: {error}")
    print(f"{path}: {found['blocks']} blocks, {found['joints']} joints of "
          f"{found['joint length [m]']:.6g} m in all, "
          f"{found['hanging vertices']} vertices set into edges of others")
    for group, area in found["areas"].items():
        print(f"  {group}: {area:.6g} m^2")


if __name__ == "__main__":
    main()
