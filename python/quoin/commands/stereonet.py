# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws the planes of section 'Rock joint sets' of a run as a stereonet.

  scripts/stereonet OUTPUT_DIR                  OUTPUT_DIR/stereonet.png
  scripts/stereonet OUTPUT_DIR --out sets.pdf

Lower hemisphere, equal areas; north is up. Dots are the poles of the planes in
rock_statistics.csv, crosses and great circles the mean planes of the sets. The
legend has the number of planes, the area of joints by volume, P32, that was asked
for and that was made, the joints by length of a scanline along the mean normal, P10,
and from the planes the mean plane and the concentration of Fisher's distribution
about it.
"""

import csv
import os
import sys

import numpy as np

from quoin.commands.options import Parser


def pole(dip, direction):
    """The downward normals of planes, rows of x (east), y (north), z (up)."""
    dip, direction = np.radians(dip), np.radians(direction)
    return -np.stack([np.sin(dip) * np.sin(direction),
                      np.sin(dip) * np.cos(direction), np.cos(dip)], axis=-1)


def project(vectors):
    """Places of downward unit vectors in the unit circle, equal areas."""
    # a horizontal one stays where it is, whatever rounding made of it
    vectors = np.where(vectors[..., 2:] > 1e-9, -vectors, vectors)
    return vectors[..., :2] / np.sqrt(1 - vectors[..., 2:])


def great_circle(dip, direction):
    """Places of the lines in a plane."""
    normal = pole(dip, direction)
    down = pole(90 - dip, direction + 180)  # along the dip
    strike = np.cross(normal, down)
    turn = np.linspace(0, np.pi, 181)[:, None]
    return project(np.cos(turn) * strike + np.sin(turn) * down)


def mean_plane(poles):
    """Dip and dip direction of the mean plane, and the concentration of
    Fisher's distribution by the resultant, (n - 1)/(n - R); infinite
    without scatter."""
    total = poles.sum(axis=0)
    size = float(np.linalg.norm(total))
    down = total / size * (-1 if total[2] > 0 else 1)
    dip = float(np.degrees(np.arccos(min(1.0, -down[2]))))
    direction = float(np.degrees(np.arctan2(-down[0], -down[1]))) % 360
    n = len(poles)
    scattered = n > 1 and n - size > 1e-9 * n
    return dip, direction, (n - 1) / (n - size) if scattered else np.inf


def read_sets(folder):
    """{name: (row of the set, poles of its planes)}, on the side of the pole
    of the mean plane."""
    path = os.path.join(folder, "rock_statistics.csv")
    with open(path, newline="") as stream:
        rows = list(csv.DictReader(stream))
    if not rows or "P32 made [1/m]" not in rows[0]:
        raise ValueError(f"{path} is not of a section 'Rock box'")
    sets = {}
    for row in rows:
        if row["kind"] == "set":
            asked, poles = (
                pole(*(np.array([float(one[key]) for one in some])
                       for key in ("dip [deg]", "dip direction [deg]")))
                for some in ([row], [plane for plane in rows
                                     if plane["kind"] == "plane"
                                     and plane["name"] == row["name"]]))
            # of steep planes some dip the other way: ends of one axis
            poles[poles @ asked[0] < 0] *= -1
            sets[row["name"]] = row, poles
    return sets


def draw(sets, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(7.5, 6))
    circle = np.linspace(0, 2 * np.pi, 361)
    axes.plot(np.cos(circle), np.sin(circle), color="black", linewidth=1)
    for angle, letter in ((90, "N"), (0, "E"), (-90, "S"), (180, "W")):
        at = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        axes.plot(*np.transpose([0.97 * at, at]), color="black", linewidth=1)
        axes.text(*(1.07 * at), letter, ha="center", va="center")
    for i, (name, (row, poles)) in enumerate(sets.items()):
        asked = [float(row["dip [deg]"]), float(row["dip direction [deg]"])]
        words = f"{name}: {asked[0]:.3g}/{asked[1]:.3g}, {len(poles)} planes"
        if len(poles) > 1:
            dip, direction, concentration = mean_plane(poles)
            if np.isfinite(concentration):
                words += "\n  made %.3g/%.3g, concentration %.3g" \
                    % (dip, direction, concentration)
        words += "\n  P32 asked %.3g, made %.3g 1/m, P10 %.3g 1/m" % tuple(
            float(row[f"{what} [1/m]"])
            for what in ("P32 asked", "P32 made", "P10 made"))
        colour = f"C{i % 10}"
        axes.plot(*project(poles).T, ".", color=colour, markersize=5)
        axes.plot(*project(pole(*asked)), "+", color=colour, markersize=12,
                  markeredgewidth=2)
        axes.plot(*great_circle(*asked).T, color=colour, linewidth=1.2,
                  label=words)
    axes.set_aspect("equal")
    axes.axis("off")
    axes.legend(loc="center left", bbox_to_anchor=(1.05, 0.5), frameon=False,
                fontsize=9)
    figure.savefig(path, dpi=150, bbox_inches="tight")


def main():
    parser = Parser(__doc__)
    parser.add_argument("folder", metavar="OUTPUT_DIR")
    parser.add_argument("--out", metavar="FILE",
                        help="default: OUTPUT_DIR/stereonet.png")
    options = parser.parse_args()
    path = options.out or os.path.join(options.folder, "stereonet.png")
    try:
        draw(read_sets(options.folder), path)
    except (OSError, ValueError) as error:
        sys.exit(f"stereonet: {error}")
    print(path)


if __name__ == "__main__":
    main()
