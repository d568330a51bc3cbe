#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Whether the table "What goes together" of the user guide is true.

FEATURES are settings of the base cases of errors.py. Each is read by --check with
small and with large displacements, by the implicit solver and in three
dimensions by both solvers; the table says "yes" where there is no error.

  tests/errors/combinations.py --quoin build/quoin            # compare
  tests/errors/combinations.py --quoin build/quoin --print    # the table
"""
import argparse
import concurrent.futures
import os
import sys
import tempfile

import errors
from errors import HERE, prepare

GUIDE = os.path.join(HERE, "..", "..", "doc", "user_guide.md")
HEADING = "### What goes together"
COLUMNS = ["explicit, small", "explicit, large", "implicit", "3-D, explicit",
           "3-D, implicit"]
COMPOSITE = ["Law=composite", "Cohesion=1e5", "Tensile strength=1e5",
             "Tensile fracture energy=10", "Shear fracture energy=100"]
BARTON = ["Law=Barton-Bandis", "Friction angle=0", "Residual friction angle=28",
          "Largest closure=0.3e-3", "Joint roughness=10",
          "Joint wall strength=100e6", "Peak slip=1e-3"]
YIELDING = ["Law=continuously yielding", "Friction angle=50",
            "Residual friction angle=30", "Roughness=1e-3"]
WEAKENING = ["Law=slip weakening", "Friction angle=40",
             "Residual friction angle=30", "Weakening slip=1e-3"]
BEAM = ["Young's modulus=30e9", "Density=2500", "Thickness=0.05"]


def joint(words):
    return ["Joints/bed/" + word for word in words]


def load(*words):
    return ["Loads/push/" + word for word in words]


def in_section(section, words):
    return ["%s/Names=it" % section] + ["%s/it/%s" % (section, word)
                                        for word in words]


# Name and settings; of another base case, its parameter file.
FEATURES = [
    ("joints: Coulomb with dilation",
     joint(["Dilation angle=5", "Cohesion=1e5"])),
    ("joints: no tension", joint(["Law=no tension"])),
    ("joints: composite", joint(COMPOSITE)),
    ("joints: Barton-Bandis", joint(BARTON)),
    ("joints: continuously yielding", joint(YIELDING)),
    ("joints: slip weakening", joint(WEAKENING)),
    ("joints: restitution", joint(["Restitution=0.5"])),
    ("blocks: Mohr-Coulomb",
     ["Materials/stone/" + word for word in
      ("Law=Mohr-Coulomb", "Cohesion=1e6", "Friction angle=30")]),
    ("blocks: rigid",
     ["Materials/Names=stone, hard", "Materials/stone/Groups=rock",
      "Materials/hard/Groups=lid", "Materials/hard/Law=rigid",
      "Materials/hard/Density=2500"]),
    ("prescribed motion, traction", []),
    ("gravity", load("Type=gravity", "Boundary=", "Horizontal=0",
                     "Vertical=-10")),
    ("platen", load("Type=platen", "Boundary=top", "Horizontal=free",
                    "Vertical=force -1e5")),
    ("initial stress",
     ["Loads/Names=base, push, in_situ", "Loads/in_situ/Type=initial stress",
      "Loads/in_situ/Stress=-1e5, -1e5, 0"]),
    ("viscous boundary", load("Type=viscous boundary", "Horizontal=free",
                              "Vertical=free")),
    ("boundary elements beyond the blocks", "hybrid.prm"),
    ("the same with incident waves", "hybrid.prm"),
    ("given pressure in joints", load("Boundary=bed", "Horizontal=free",
                                      "Vertical=free", "Pressure=1e5")),
    ("uplift that follows cracks",
     load("Boundary=bed", "Horizontal=free", "Vertical=free",
          "Pressure=uplift", "Headwater=3", "Tailwater=1", "Heel=0, 0.5",
          "Toe=1, 0.5", "In cracks=full head")),
    ("added mass of water",
     load("Boundary=right", "Horizontal=free", "Vertical=free",
          "Pressure=water 1", "Added mass=Westergaard")
     + ["Stages/first/Damping=none"]),
    ("steady flow in joints",
     ["Water/Flow=steady"] + ["Water joints/Names=bed"]
     + in_section("Water boundaries", ["Boundary=left", "Value=1e5"])),
    ("transient flow in joints",
     ["Water/Flow=transient"] + ["Water joints/Names=bed"]
     + in_section("Water boundaries", ["Boundary=left", "Value=1e5"])),
    ("bolts and cables",
     in_section("Reinforcement",
                ["From=0.5, 0.9", "To=0.5, 0.1", "Diameter=0.02",
                 "Young's modulus=200e9", "Bond stiffness=1e8",
                 "Element length=0.05"])),
    ("beams", in_section("Beams", BEAM + ["Points=1.5, 0; 1.5, 1"])),
    ("liners", in_section("Beams", BEAM + ["Boundary=right",
                                           "Interface=bed"])),
    ("excavation", ["Stages/second/Excavate=lid", "Stages/second/Loads=base"]),
    ("properties that change",
     ["Joints/Names=bed, weak", "Joints/weak/Law=Coulomb",
      "Joints/weak/Normal stiffness=50e9", "Joints/weak/Shear stiffness=20e9",
      "Joints/weak/Friction angle=20", "Joints/weak/Curves=none",
      "Stages/second/Joint properties=bed:weak"]),
    ("factor of safety", ["Stages/second/End=factor of safety"]),
    ("load pattern with a controlled displacement",
     ["Stages/second/Loads=base", "Stages/second/Load pattern=push",
      "Stages/second/Control function=1e-3*t"]),
    ("mass scaling", ["Stages/first/Mass scaling=yes",
                      "Stages/first/Scaled time step=1e-5"]),
]

# What the base case in three dimensions has in other words.
IN_SPACE = [("stone", "rock"), ("Groups=rock", "Groups=low"),
            ("Groups=lid", "Groups=high"), ("=lid", "=high"),
            ("Boundary=bed", "Boundary=middle"),
            ("-1e5, -1e5, 0", "-1e5, -1e5, -1e5, 0, 0, 0"),
            ("Horizontal=free", "Lateral=free")]
SPACE = (["Mesh/Joints along=middle", "Joints/Names=bed",
          "Joints/bed/Curves=middle",
          "Joints/bed/Law=Coulomb", "Joints/bed/Normal stiffness=50e9",
          "Joints/bed/Shear stiffness=20e9", "Joints/bed/Friction angle=30",
          "Stages/Names=first, second", "Stages/second/Loads=base, push",
          "Stages/second/End=time", "Stages/second/Duration=1e-3"])


def settings_of(name, feature, column):
    """Parameter file and settings of the feature in a column."""
    if isinstance(feature, str):
        prm, settings = feature, []
        if not name.endswith("waves"):
            settings = ["Incident waves/Names="]
    else:
        prm, settings = "case.prm", feature
    if column == "explicit, large":
        settings = settings + ["Contact/Displacements=large",
                               "Joints/bed/New contacts between=all",
                               "Joints/bed/Curves=bed"]
    elif column == "implicit":
        settings = settings + ["Solver=implicit"]
    elif column.startswith("3-D"):
        if isinstance(feature, str):
            settings = ["Loads/push/Type=boundary elements",
                        "Loads/push/Boundary=", "Loads/push/Lateral=free"]
        for here, there in IN_SPACE:
            settings = [text.replace(here, there) for text in settings]
        prm, settings = "space.prm", SPACE + settings
        if column.endswith("implicit"):
            settings = settings + ["Solver=implicit"]
    return prm, settings


def error_of(quoin, folder, name, feature, column):
    """The error message; empty: the feature works there."""
    prm, settings = settings_of(name, feature, column)
    words = [quoin, os.path.join(folder, prm), "--check", "--quiet"]
    for setting in settings:
        words += ["--set", setting]
    status, printed = errors.run(words)
    if status not in (0, 1):
        raise RuntimeError(printed)
    return printed.strip().split("\n")[-1] if status else ""


def rows_of_guide():
    """The rows of the table, as lists of words."""
    with open(GUIDE) as stream:
        text = stream.read()
    part = text[text.index(HEADING):]
    part = part[:part.index("\n#", len(HEADING))]
    return [[word.strip() for word in line.strip("|\n").split("|")]
            for line in part.split("\n") if line.startswith("|")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quoin", required=True, help="the executable")
    parser.add_argument("--print", action="store_true",
                        help="print the table, and the reason of each no")
    parser.add_argument("--many-runs", help="the program many_runs, to save time")
    options = parser.parse_args()
    quoin = os.path.abspath(options.quoin)
    if options.many_runs:
        errors.many_runs = errors.ManyRuns(options.many_runs, quoin)
    with tempfile.TemporaryDirectory(prefix="quoin_") as folder, \
            concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        prepare(folder)
        tries = [[pool.submit(error_of, quoin, folder, name, feature, column)
                  for column in COLUMNS] for name, feature in FEATURES]
        messages = [[each.result() for each in row] for row in tries]
    rows = [["", *COLUMNS], ["---"] * (1 + len(COLUMNS))]
    rows += [[name] + ["no" if error else "yes" for error in row]
             for (name, _), row in zip(FEATURES, messages)]
    if options.print:
        for row in rows:
            print("| %s |" % " | ".join(row).strip())
        for (name, _), row in zip(FEATURES, messages):
            for column, error in zip(COLUMNS, row):
                if error:
                    print("%s, %s: %s" % (name, column, error))
        return 0
    found = rows_of_guide()
    wrong = [row[0] for row, said in zip(rows, found) if row != said]
    if wrong or len(rows) != len(found):
        print("FAILED: the table '%s' of the user guide is wrong about: %s"
              % (HEADING.strip("# "), ", ".join(wrong) or "its rows"))
        return 1
    print("passed: %d combinations" % (len(FEATURES) * len(COLUMNS)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
