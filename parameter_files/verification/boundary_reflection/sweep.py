#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""All angles, both kinds, all boundaries: results.csv and the figure.

  sweep.py --quoin build/quoin [--only dashpots] [--angles 0,30]
  sweep.py --plot doc/figures/boundary_reflection.png
"""
import argparse
import csv
import os
import sys
import tempfile

import numpy as np

import packet

TABLE = os.path.join(packet.HERE, "results.csv")
FIELDS = ("boundary", "kind", "angle", "reflected", "closed form", "packet",
          "seconds")


def read_rows():
    if not os.path.exists(TABLE):
        return []
    with open(TABLE) as stream:
        return list(csv.DictReader(stream))


def write_row(row):
    """Replaces the row of the same boundary, kind and angle."""
    rows = [old for old in read_rows()
            if any(str(old[name]) != str(row[name]) for name in FIELDS[:3])]
    rows.append(row)
    rows.sort(key=lambda r: (r["boundary"], r["kind"], float(r["angle"])))
    with open(TABLE, "w") as stream:
        writer = csv.DictWriter(stream, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def across_of(angle):
    """Packets that graze the wall must be wide, so as to be narrow in angle."""
    return 20.0 if angle > 50 else 15.0


def measure(quoin, boundary, kind, angle, folder):
    name = "%s_%s_%g" % (boundary.replace(" ", "_"), kind, angle)
    if boundary == "boundary elements":
        # 800 elements at 75 degrees, else up to 525
        along = across = 5.0 if angle > 70 else 5.5
        length = 10 / 20 if angle > 70 else 10 / 16
        model = packet.small_model(kind, angle, along, across, length / 2, 2)
        more = packet.boundary_elements(length)
    else:
        along, across = 6.0, across_of(angle)
        model = packet.wide_model(kind, angle, along, across,
                                  10 / 20 if angle > 70 else 10 / 24)
        more = packet.FIXED if boundary == "fixed" else []
    _, energy, seconds = packet.run(quoin, folder, name, *model, more)
    closed = packet.reflected_share(kind, np.radians(angle))
    averaged = packet.packet_share(kind, angle, along, across)
    if boundary != "dashpots":
        closed = averaged = 1.0 if boundary == "fixed" else 0.0
    write_row({"boundary": boundary, "kind": kind, "angle": angle,
               "reflected": "%.3e" % energy[-1], "closed form": "%.4f" % closed,
               "packet": "%.4f" % averaged, "seconds": "%.0f" % seconds})
    print("%-18s %-2s %2g: %.2e, packet %.4f, %.0f s"
          % (boundary, kind, angle, energy[-1], averaged, seconds), flush=True)


def plot(path):
    sys.path.insert(0, os.path.join(packet.HERE, *[os.pardir] * 3, "python"))
    from quoin.figures import figure_style  # noqa: F401
    import matplotlib.pyplot as plt

    rows = read_rows()
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.6), sharey=True)
    angles = np.linspace(0.5, 88, 400)
    marks = {"dashpots": ("o", "C0"), "boundary elements": ("s", "C3"),
             "fixed": ("^", "0.4")}
    for axis, kind in zip(axes, ("P", "SV")):
        axis.semilogy(angles, [packet.reflected_share(kind, np.radians(a))
                               for a in angles], "C0-", lw=1,
                      label="dashpots, closed form, plane wave")
        for boundary, (mark, colour) in marks.items():
            of = [r for r in rows
                  if r["boundary"] == boundary and r["kind"] == kind]
            if of:
                axis.semilogy([float(r["angle"]) for r in of],
                              [float(r["reflected"]) for r in of], mark,
                              color=colour, label=boundary + ", measured")
        axis.semilogy(packet.ANGLES,
                      [packet.packet_share(kind, a, 6.0, across_of(a))
                       for a in packet.ANGLES], "_", ms=14, color="C0",
                      label="dashpots, closed form, mean over the packet")
        axis.set_title("%s wave, Poisson's ratio 1/4" % kind)
        axis.set_xlabel("angle of incidence [deg]")
        axis.set_xlim(-2, 80)
        axis.set_xticks(packet.ANGLES)
        axis.set_ylim(1e-7, 2)
    axes[0].set_ylabel("reflected energy / incident energy")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.tight_layout(rect=(0, 0.1, 1, 1))
    figure.legend(handles, labels, fontsize=8, ncol=3, loc="lower center")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin")
    parser.add_argument("--only", help="boundaries, comma-separated",
                        default="dashpots,fixed,boundary elements")
    parser.add_argument("--kinds", default="P,SV")
    parser.add_argument("--angles", default=",".join(map(str, packet.ANGLES)))
    parser.add_argument("--plot", help="file of the figure")
    options = parser.parse_args()
    if options.quoin:
        with tempfile.TemporaryDirectory() as folder:
            for boundary in options.only.split(","):
                for kind in options.kinds.split(","):
                    for angle in map(float, options.angles.split(",")):
                        measure(options.quoin, boundary, kind, angle, folder)
    if options.plot:
        plot(options.plot)


if __name__ == "__main__":
    main()
