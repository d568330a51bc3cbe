# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The options that scripts share."""

import argparse
import re

from quoin.stages import time_or_name


class Parser(argparse.ArgumentParser):
    """With the text of the script as its help, and "-1e3" or "-9,0,9,8" as
    values, not as options, which argparse knows of "-1" alone."""

    def __init__(self, text, **others):
        super().__init__(description=text, **others,
                         formatter_class=argparse.RawDescriptionHelpFormatter)
        self._negative_number_matcher = re.compile(r"-\.?\d")


def numbers(text):
    return [float(word) for word in text.split(",")]


def view(text):
    values = numbers(text)
    if len(values) != 4 or values[0] >= values[2] or values[1] >= values[3]:
        raise argparse.ArgumentTypeError(
            "expected XMIN,YMIN,XMAX,YMAX in [m]")
    return values


class Cut:
    """A plane across an axis, and the side of it that stays."""

    def __init__(self, text):
        match = re.fullmatch(r"\s*([xyz])\s*([<>])\s*(\S+)\s*", text)
        try:
            self.value = float(match.group(3)) if match else None
        except ValueError:
            self.value = None
        if self.value is None:
            raise argparse.ArgumentTypeError(
                "expected what stays, such as 'x<0.5' [m]")
        self.axis = "xyz".index(match.group(1))
        self.sign = 1.0 if match.group(2) == "<" else -1.0
        self.text = f"{match.group(1)} = {self.value:g} m"


def camera(text):
    values = numbers(text)
    if len(values) != 2:
        raise argparse.ArgumentTypeError(
            "expected AZIMUTH,ELEVATION in degrees")
    return values


def positive(kind):
    def convert(text):
        value = kind(text)
        if value <= 0:
            raise argparse.ArgumentTypeError(f"{text} is not positive")
        return value
    return convert


def add_since(parser, verb, what):
    parser.add_argument("--since", type=time_or_name, metavar="TIME",
                        help=f"{verb} what came after this time [s], or since "
                             f"the stage of this name began, alone: {what}")


def add_picture_options(parser, joints="state"):
    """Adds the options of pictures; @p joints: the default of --joints."""
    parser.add_argument("--scale", type=float,
                        help="of displacements, default automatic")
    parser.add_argument("--view", type=view, metavar="XMIN,YMIN,XMAX,YMAX",
                        help="what is shown [m], default all")
    parser.add_argument("--colour", default="material",
                        choices=("material", "block", "velocity", "stress",
                                 "displacement"),
                        help="of the blocks, default material; block: a tint "
                             "that stays with each block; stress: the minor "
                             "principal one; velocity, displacement: their "
                             "magnitude")
    parser.add_argument("--joints", default=joints,
                        choices=("state", "mode", "damage", "slip", "water"),
                        help=f"what their colours are, default {joints}")
    parser.add_argument("--widest", type=positive(float), metavar="OPENING",
                        help="of --joints mode and slip: opening or slip that "
                             "is drawn widest [m], default automatic")
    parser.add_argument("--beams", default="line",
                        choices=("line", "axial force", "moment"),
                        help="what is drawn across beams and liners, default "
                             "nothing")
    add_since(parser, "draw", "displacements, slips, openings, states")
    parser.add_argument("--blocks-only", action="store_true",
                        help="neither joints nor contacts")
    parser.add_argument("--principal", action="store_true",
                        help="crosses of the principal stresses")
    parser.add_argument("--crosses", type=positive(int), metavar="N",
                        help="of --principal, along the longer side, default "
                             "32, or 20 of several moments")
    parser.add_argument("--mesh", action="store_true",
                        help="show the edges of the cells")
