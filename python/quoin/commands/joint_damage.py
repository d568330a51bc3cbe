# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Draws how much of the joints has failed, as the run goes on.

  scripts/joint_damage OUTPUT_DIR
  scripts/joint_damage OUTPUT_DIR --against displacement --sets mortar
  scripts/joint_damage OUTPUT_DIR --length --curves open,damaged --out dmg.pdf
  scripts/joint_damage OUTPUT_DIR --since excavate

Of the fields in joints.pvd it takes the length of the joints that are

  failed    not intact: softening has begun, or open, slipping or slipped
  slipping  now
  open      now, or in tension while it softens
  damaged   having lost more than half of their strength (composite law)
  crushed   closed beyond the compressive strength (composite law)

as a share of the joints that are there at that moment, or with --length in metres,
against time or, with --against, a column of histories.csv. What is excavated or not
placed yet has none. --sets takes some of the names in section 'Joints', by default
all. The numbers go to a csv file of the picture's name. In three dimensions areas
take the place of lengths.

--since TIME or STAGE counts what came after that time or since that stage began:
joints that opened or, by their inelastic slip, slipped since then, more than a hundredth
of the one that moved most; strength lost and crushing since then.
"""

import csv
import os
import sys

import matplotlib.pyplot as plt
import numpy as np

from quoin import damage_table, figures, vtu  # noqa: F401  (the look)
from quoin.colours import ORANGE, RED, VIOLET
from quoin.commands.options import Parser, add_since
from quoin.csv_table import Table, scale_for, unit_of
from quoin.stages import begin, since_text, time_of

LOOK = {"failed": ("0.55", "-"), "slipping": (ORANGE, "-"), "open": (RED, "-"),
        "damaged": ("black", "--"), "crushed": (VIOLET, "-.")}


def abscissa(output, times, column):
    """Name with unit, as in the table, and values at these times."""
    if column is None:
        return "time [s]", times
    table = Table(os.path.join(output, "histories.csv"))
    return (table.full_name(column),
            np.interp(times, table.column(0), table.column(column)))


def share(part, of):
    """In per cent, nan where there is nothing."""
    there = of > 0.0
    return np.where(there, 100.0 * part / np.where(there, of, 1.0), np.nan)


def is_in_space(output):
    """Whether the joints of a run are those of three dimensions."""
    path = os.path.join(output, "joints.pvd")
    grids = filter(None, map(damage_table.grid_of, vtu.read_pvd(path)))
    return damage_table.is_in_space(next(grids))


def write_csv(path, x_name, x, columns, unit):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([x_name] + [f"{name} [{unit}]" for name in columns])
        for row in zip(x, *columns.values()):
            writer.writerow([f"{value:.10g}" for value in row])


def draw(options):
    """Writes picture and table and returns their names."""
    times, length, columns = damage_table.read(
        options.output, options.sets,
        time_of(options.output, options.since, begin))
    softens = "damaged" in columns
    for name in options.curves:
        if name not in columns:
            raise ValueError(f"--curves knows {', '.join(columns)} in this "
                             f"run, not '{name}'")
    if options.curves:
        columns = {name: columns[name] for name in options.curves}
    x_name, x = abscissa(options.output, times, options.against)
    factor, unit = scale_for(unit_of(x_name), np.abs(x).max())
    in_space = is_in_space(options.output)
    size, unit_of_size = ("area", "m²") if in_space else ("length", "m")
    if not options.length:
        columns = {name: share(y, length) for name, y in columns.items()}

    figure, axes = plt.subplots(figsize=(6.0, 4.0), constrained_layout=True)
    for name, y in columns.items():
        colour, style = LOOK[name]
        label = damage_table.CONDITIONS[name]
        if name == "failed" and options.since is not None:
            label = "opening or inelastic slip"
        elif name == "failed" and not softens:
            label = "failed"
        axes.plot(factor * x, y, style, color=colour, label=label)
    axes.set_xlabel(f"{x_name.split(' [')[0]} [{unit}]")
    what = " + ".join(options.sets) + " joints" if options.sets else "joints"
    first, last = f"{length.min():.3g}", f"{length.max():.3g}"
    sizes = last if first == last else f"{first} to {last}"
    axes.set_ylabel(f"{size} of {what} [{unit_of_size}]" if options.length
                    else f"share of {what} [% of {sizes} {unit_of_size}]")
    axes.set_ylim(bottom=0.0)
    if options.since is None:
        axes.set_xlim(left=min(0.0, factor * x.min()))
    words = [options.title] if options.title else []
    if options.since is not None:
        words.append(since_text(options.since))
    axes.set_title(", ".join(words))
    axes.legend(fontsize=8.5)
    path = options.out or os.path.join(options.output, "joint_damage.png")
    figure.savefig(path)
    table = os.path.splitext(path)[0] + ".csv"
    write_csv(table, x_name, x, columns,
              ("m^2" if in_space else "m") if options.length else "%")
    return path, table


def main():
    def words(text):
        return [word.strip() for word in text.split(",")]

    parser = Parser(__doc__)
    parser.add_argument("output", metavar="OUTPUT_DIR")
    parser.add_argument("--against", metavar="COLUMN",
                        help="of histories.csv, default time")
    parser.add_argument("--sets", type=words, default=[], metavar="NAME,...",
                        help="of joints, default all")
    parser.add_argument("--curves", type=words, default=[],
                        metavar="NAME,...", help="some of the five above")
    parser.add_argument("--length", action="store_true",
                        help="[m], in three dimensions [m^2], not a share")
    add_since(parser, "count", "opening, inelastic slip, damage")
    parser.add_argument("--title")
    parser.add_argument("--out", metavar="FILE",
                        help="default OUTPUT_DIR/joint_damage.png")
    try:
        print(*draw(parser.parse_args()), sep="\n")
    except (OSError, ValueError) as error:
        sys.exit(f"joint_damage: {error}")


if __name__ == "__main__":
    main()
