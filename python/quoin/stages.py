# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""When the stages of a run began and ended."""

import json
import os

from quoin import run_parameters


def ends(output):
    """{name: time [s]} of the stages that have ended, from summary.json."""
    path = os.path.join(output, "summary.json")
    try:
        with open(path, encoding="utf-8") as file:
            stages = json.load(file).get("stages", {})
    except OSError as error:
        raise ValueError(f"{path}: {error.strerror}; stages are known by name "
                         "once one has ended") from error
    return {name: stage["time [s]"] for name, stage in stages.items()}


def end(output, name):
    """When a stage ended [s]."""
    known = ends(output)
    if name not in known:
        raise ValueError(f"'{name}' is neither a time [s] nor a stage that has "
                         "ended; " + (f"these are {', '.join(known)}"
                                      if known else "none has"))
    return known[name]


def begin(output, name):
    """When a stage began [s]: with the end of the one before."""
    words = run_parameters.read(output).get("Stages", {}).get("Names", "")
    names = [word.strip() for word in words.split(",") if word.strip()]
    if name not in names:
        raise ValueError(f"'{name}' is neither a time [s] nor a stage; "
                         + (f"these are {', '.join(names)}" if names else
                            "the run has none"))
    place = names.index(name)
    return end(output, names[place - 1]) if place > 0 else 0.0


def time_or_name(word):
    """Value of an option: a time [s], or the name of a stage as it is."""
    try:
        return float(word)
    except ValueError:
        return word.strip()


def times_or_names(text):
    return [time_or_name(word) for word in text.split(",")]


def stage_and_time(text):
    """Stage and time since its begin: ("push", 0.01) for "push+0.01", 0.01 s
    after push began, and ("push", None) for "push"."""
    name, _, passed = text.rpartition("+")
    try:
        return (name.strip(), float(passed)) if name else (text, None)
    except ValueError:
        return text, None


def time_of(output, moment, at):
    """A time [s] as it is; of "STAGE+TIME" that time after the stage began; of
    the name of a stage alone that which is asked for, @p at: begin or end."""
    if not isinstance(moment, str):
        return moment
    name, passed = stage_and_time(moment)
    return at(output, name) if passed is None else begin(output, name) + passed


def since_text(moment):
    """Text of a caption on --since."""
    if not isinstance(moment, str):
        return f"since t = {moment:.4g} s"
    name, passed = stage_and_time(moment)
    return ("since " + ("" if passed is None else f"{passed:g} s after ")
            + f"{name} began")
