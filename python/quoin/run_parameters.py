# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Reads used_parameters.prm, which quoin leaves in the output folder, and
where that is from a case's parameter file.

As a program: prints where quoin writes with the arguments that are given.
"""

import argparse
import os
import re
import sys


def read(output):
    """Nested dictionaries of sections, entries as text."""
    path = os.path.join(output, "used_parameters.prm")
    try:
        with open(path, encoding="utf-8") as file:
            lines = [line.strip() for line in file]
    except OSError as error:
        raise ValueError(f"{path}: {error.strerror}") from error
    sections = [{}]
    for line in lines:
        word, _, rest = line.partition(" ")
        if word == "subsection":
            sections.append(sections[-1].setdefault(rest.strip(), {}))
        elif word == "end":
            sections.pop()
        elif word == "set":
            name, _, value = rest.partition("=")
            sections[-1][name.strip()] = value.strip()
    return sections[0]


def joint_sets(output):
    """Names of the joint sets, in the order of "joint set" in joints.pvd."""
    names = read(output).get("Joints", {}).get("Names", "")
    return [name.strip() for name in names.split(",") if name.strip()]


def of_joint_sets(output, entry):
    """A number of each joint set."""
    joints = read(output).get("Joints", {})
    return [float(joints[name][entry]) for name in joint_sets(output)]


def peak_crushing(output):
    """Plastic closure at the compressive strength of each joint set [m];
    infinite where the joint does not crush."""
    joints = read(output).get("Joints", {})
    return [
        peak if joints[name]["Law"] == "composite"
        and joints[name]["Compressive strength"] != "none" else float("inf")
        for name, peak in zip(joint_sets(output),
                              of_joint_sets(output, "Peak crushing"))
    ]


def lines_of(path):
    """Lines of a parameter file and those that it includes, without
    comments."""
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = line.split("#")[0].strip()
            included = re.match(r"include\s+(.+)", line)
            if included:
                yield from lines_of(os.path.join(os.path.dirname(path),
                                                 included.group(1)))
            else:
                yield line


def files_in(folder, words):
    """The files beside a parameter file that these texts of it name, such as
    meshes, tables and records, and those that a geometry merges or includes."""
    found = []

    def add(path):
        if os.path.isfile(path) and path not in found:
            found.append(path)
            if path.endswith(".geo"):
                with open(path, encoding="utf-8", errors="replace") as file:
                    for name in re.findall(r'(?:Merge|Include)\s*"([^"]+)"',
                                           file.read()):
                        add(os.path.join(os.path.dirname(path), name))

    for text in words:
        value = text.partition("=")[2]
        for name in (value.strip(), *re.split(r"[\s;,]+", value)):
            if name:
                add(os.path.normpath(os.path.join(folder, name)))
    return found


def output_of(case, overrides=()):
    """The output directory that a parameter file, or "Name=value" that
    overrides it, names."""
    name = "output"
    for line in (*lines_of(case), *("set " + text for text in overrides)):
        found = re.match(r"set\s+Output directory\s*=\s*(.+)", line)
        name = found.group(1) if found else name
    return os.path.join(os.path.dirname(case), name)


def output_of_arguments(words):
    """The output directory of quoin with these arguments."""
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("case")
    parser.add_argument("--output")
    parser.add_argument("--set", action="append", default=[])
    options, _ = parser.parse_known_args(words)
    return options.output or output_of(options.case, options.set)


if __name__ == "__main__":
    print(output_of_arguments(sys.argv[1:]))
