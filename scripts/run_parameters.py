# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Reads used_parameters.prm, which quoin leaves in the output folder."""

import os


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
    """Of each joint set, the plastic closing at the compressive strength
    [m]; infinite where the joint does not crush."""
    joints = read(output).get("Joints", {})
    return [
        peak if joints[name]["Law"] == "composite"
        and joints[name]["Compressive strength"] != "none" else float("inf")
        for name, peak in zip(joint_sets(output),
                              of_joint_sets(output, "Peak crushing"))
    ]
