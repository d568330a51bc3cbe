#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs all benchmarks one after the other and prints one table of what a step,
a triangle, a point of a joint and a pair of contacts cost; see README.md.

  measure.py [--quoin build/quoin] [--repeat 3] [--only joints]
             [--against ANOTHER_QUOIN] [--whole]

With --against the runs of both programs alternate, and the last column is how
many times as fast a step of the first one is. With --whole it runs walls,
arches, slopes and piles from beginning to end instead, and the wall of the
joints on two processes; the last column compares their times.
"""
import argparse
import json
import os
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
WALLS = "../masonry/tue_walls/"

# Overrides of joints/case.prm: a wall without tensile strength and cohesion,
# which initial stress keeps closed; its upper platen slides; laws.
CLOSED = ["Loads/Names=floor, press, squeeze",
          "Loads/squeeze/Type=initial stress",
          "Loads/squeeze/Stress=-2e6, -2e6, 0",
          "Joints/mortar/Tensile strength=0", "Joints/mortar/Cohesion=0"]
SLIDES = ["Loads/press/Horizontal=velocity 2 * min(1, t / 0.0005)"]
WEAKENING = CLOSED + ["Joints/mortar/Law=slip weakening",
                      "Joints/mortar/Weakening slip=1e-3",
                      "Joints/mortar/Residual friction angle=3"]
BARTON_BANDIS = CLOSED + ["Joints/mortar/Law=Barton-Bandis",
                          "Joints/mortar/Largest closure=0.2e-3",
                          "Joints/mortar/Largest normal stiffness=200e9",
                          "Joints/mortar/Joint wall strength=20e6"]
YIELDING = CLOSED + ["Joints/mortar/Law=continuously yielding",
                     "Joints/mortar/Normal exponent=0.5",
                     "Joints/mortar/Shear exponent=0.4",
                     "Joints/mortar/Highest stress=1e7"]

# (name, parameter file, overrides); "space" is in the names of those in three
# dimensions that have joints.
BENCHMARKS = [
    ("blocks", "blocks/case.prm", []),
    ("blocks, 2 million", "blocks/case.prm",
     ["Mesh/File=blocks_2m.geo", "Mesh/Refinements=2",
      "Stages/shake/Duration=0.0015"]),
    ("joints, composite, sticking", "joints/case.prm", []),
    ("joints, Coulomb, sticking", "joints/case.prm",
     ["Joints/mortar/Law=Coulomb"]),
    ("joints, Coulomb, slipping", "joints/case.prm",
     ["Joints/mortar/Law=Coulomb", "Joints/mortar/Cohesion=0",
      "Joints/mortar/Tensile strength=0", "Joints/mortar/Friction angle=5",
      "Loads/press/Horizontal=velocity 2 * min(1, t / 0.0005)"]),
    ("joints, slip weakening, sticking", "joints/case.prm", WEAKENING),
    ("joints, slip weakening, slipping", "joints/case.prm",
     WEAKENING + SLIDES + ["Joints/mortar/Friction angle=5"]),
    ("joints, Barton-Bandis, sticking", "joints/case.prm",
     BARTON_BANDIS + ["Joints/mortar/Residual friction angle=28",
                      "Joints/mortar/Joint roughness=10",
                      "Joints/mortar/Peak slip=1e-3"]),
    ("joints, Barton-Bandis, slipping", "joints/case.prm",
     BARTON_BANDIS + SLIDES + ["Joints/mortar/Residual friction angle=5",
                               "Joints/mortar/Joint roughness=5",
                               "Joints/mortar/Peak slip=2e-5"]),
    ("joints, continuously yielding, pressed", "joints/case.prm",
     YIELDING + ["Joints/mortar/Friction angle=50",
                 "Joints/mortar/Residual friction angle=30",
                 "Joints/mortar/Roughness=1e-3"]),
    ("joints, continuously yielding, slipping", "joints/case.prm",
     YIELDING + SLIDES + ["Joints/mortar/Friction angle=10",
                          "Joints/mortar/Residual friction angle=5",
                          "Joints/mortar/Roughness=1e-4"]),
    ("tetrahedra", "tetrahedra/case.prm", ["Stages/shake/Duration=5e-3"]),
    ("tetrahedra, 640 000", "tetrahedra/case.prm",
     ["Mesh/File=cube_fine.geo", "Stages/shake/Duration=1e-3"]),
    ("tetrahedra, mixed", "tetrahedra/case.prm",
     ["Mesh/Tetrahedra=mixed", "Stages/shake/Duration=1e-3"]),
    ("space joints, composite, sticking", "space_joints/case.prm", []),
    ("space joints, Coulomb, sticking", "space_joints/case.prm",
     ["Joints/mortar/Law=Coulomb"]),
    ("wall J4D to 1 mm", WALLS + "j4d.prm", ["Stages/push/Duration=0.05"]),
    ("contacts of rigid blocks", "contacts/case.prm", []),
    ("contacts of deformable blocks", "../verification/pile/case.prm", []),
]


# (name, parameter file, overrides, number of processes) of whole runs.
WHOLE = [
    ("wall J4D to 4.5 mm", WALLS + "j4d.prm", [], 1),
    ("wall J2G", WALLS + "j2g.prm", [], 1),
    ("wall J6D", WALLS + "j6d.prm", [], 1),
    ("wall J7D", WALLS + "j7d.prm", [], 1),
    ("wall J4D, implicit", WALLS + "j4d.prm", ["Solver=implicit"], 1),
    ("dry wall SW.30", "../masonry/dry_walls/sw30.prm", [], 1),
    ("dry wall SW.100", "../masonry/dry_walls/sw100.prm", [], 1),
    ("arch_collapse", "../masonry/arch_collapse/case.prm", [], 1),
    ("pile", "../verification/pile/case.prm", [], 1),
    ("slope_safety", "../rock/slope_safety/case.prm", [], 1),
    ("wall of joints", "joints/case.prm", [], 1),
    ("wall of joints, two processes", "joints/case.prm", [], 2),
]


def run(quoin, file, overrides, n_processes=1):
    """The summary of one run."""
    with tempfile.TemporaryDirectory(prefix="quoin_") as output:
        command = ["mpirun", "-np", str(n_processes)] * (n_processes > 1)
        command += [quoin, os.path.join(HERE, file), "--quiet", "--output",
                   output, "--set", "Output/Measure bandwidth=yes"]
        for override in overrides:
            command += ["--set", override]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(output, "summary.json")) as stream:
            return json.load(stream)


def seconds_a_step(summary):
    return summary["wall time [s]"] / summary["steps"]


def fastest(quoins, file, overrides, repeat):
    """The summaries of the fastest runs of each program."""
    best = [None] * len(quoins)
    for _ in range(repeat):
        for i, quoin in enumerate(quoins):
            summary = run(quoin, file, overrides)
            if (best[i] is None
                    or seconds_a_step(summary) < seconds_a_step(best[i])):
                best[i] = summary
    return best


def whole_runs(quoins, only, repeat):
    """Prints the times of whole runs."""
    names = ["run", "steps", "time [s]"]
    names += ["time before [s]", "times as fast"] * (len(quoins) > 1)
    print("| " + " | ".join(names) + " |\n" + "|" + "---|" * len(names))
    for name, file, overrides, n_processes in WHOLE:
        if only not in name:
            continue
        seconds = [float("inf")] * len(quoins)
        for _ in range(repeat):
            for i, quoin in enumerate(quoins):
                summary = run(quoin, file, overrides, n_processes)
                seconds[i] = min(seconds[i], summary["wall time [s]"])
                steps = summary["steps"] if i == 0 else steps
        cells = [name, str(steps), f"{seconds[0]:.3g}"]
        if len(quoins) > 1:
            cells += [f"{seconds[1]:.3g}", f"{seconds[1] / seconds[0]:.2f}"]
        print("| " + " | ".join(cells) + " |", flush=True)


def row(name, best):
    """A line of the table."""
    first = best[0]
    step = seconds_a_step(first)
    shares = first.get("time shares", {})
    n_points = (3 if "space" in name else 2) * first.get("joint faces", 0)
    joint = (1e9 * shares.get("joints", 0) * step / n_points
             if n_points else 0)
    contacts = first.get("contact updates per second", 0) / 1e6
    cells = [name, str(first["cells"]), str(n_points), str(first["steps"]),
             f"{1e6 * step:.4g}",
             f"{first['element updates per second'] / 1e6:.3g}"
             if first["cells"] else "",
             f"{joint:.2g}" if joint else "",
             f"{contacts:.3g}" if contacts else "",
             f"{100 * first['share of memory bandwidth']:.0f} %"
             if "share of memory bandwidth" in first else ""]
    if len(best) > 1:
        cells.append(f"{seconds_a_step(best[1]) / step:.2f}")
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quoin", default=os.path.join(ROOT, "build",
                                                        "quoin"))
    parser.add_argument("--against")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--only", default="")
    parser.add_argument("--whole", action="store_true")
    options = parser.parse_args()
    quoins = [options.quoin] + ([options.against] if options.against else [])
    if options.whole:
        whole_runs(quoins, options.only, options.repeat)
        return
    names = ["benchmark", "cells", "joint points", "steps", "step [us]",
             "million cells a second", "joint point [ns]",
             "million contact updates a second", "of the memory bandwidth"]
    names += ["times as fast"] if options.against else []
    print("| " + " | ".join(names) + " |\n" + "|" + "---|" * len(names))
    for name, file, overrides in BENCHMARKS:
        if options.only in name:
            print(row(name, fastest(quoins, file, overrides, options.repeat)),
                  flush=True)


if __name__ == "__main__":
    main()
