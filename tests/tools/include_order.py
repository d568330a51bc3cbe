#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Modules include only from their left:

base < mesh, layout, materials, joints, elastodynamics
     < joint_laws, operators, rock, tdbem < law_lanes
     < block_elements, joint_elements, output, signals
     < blocks, contact, loads, water
     < motions
     < absorbing, farfield, stages, reinforcement, structures < model
     < loading < dynamics < implicit, results < parameters < advice < problems
     < block_problem, boundary_problem < application

Modules between the same two signs do not know each other.
"""
import os
import re
import sys

TIERS = [["base"],
         ["mesh", "layout", "materials", "joints", "elastodynamics"],
         ["joint_laws", "operators", "rock", "tdbem"], ["law_lanes"],
         ["block_elements", "contact_geometry", "joint_elements", "output", "signals"],
         ["blocks", "contact", "loads", "water"], ["motions"], ["absorbing", "farfield", "stages", "reinforcement", "structures"], ["model"], ["loading"], ["dynamics"], ["implicit", "results"], ["parameters"],
         ["advice"], ["problems"], ["block_problem", "boundary_problem"], ["application"]]
RANK = {name: rank for rank, tier in enumerate(TIERS) for name in tier}
# boundary elements stand alone: a boundary polyline, nothing of the blocks
NARROWER = {"elastodynamics": {"base"}, "tdbem": {"base", "elastodynamics"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]quoin/([^/">]+)/([^">]+)[">]')
LOCAL = re.compile(r'^\s*#\s*include\s*"([^"]+)"')


def module_of(path, root):
    parts = os.path.relpath(path, root).split(os.sep)
    if parts[0] == "include":
        parts = parts[2:]  # include/quoin/<module>/...
    else:
        parts = parts[1:]  # source/<module>/...
    # source/main.cc is the application
    return parts[0] if len(parts) > 1 else "application"


def complaints(path, root):
    module = module_of(path, root)
    name = os.path.relpath(path, root)
    if module not in RANK:
        yield "%s: module '%s' is not in the list of modules" % (name, module)
        return
    with open(path, encoding="utf-8") as stream:
        for number, line in enumerate(stream, 1):
            where = "%s:%d" % (name, number)
            match = INCLUDE.match(line)
            if match:
                other = match.group(1)
                if other not in RANK:
                    yield "%s: includes unknown module '%s'" % (where, other)
                elif other != module and (
                        RANK[other] >= RANK[module]
                        or other not in NARROWER.get(module, RANK)):
                    yield "%s: '%s' may not include '%s'" % (
                        where, module, other)
            elif LOCAL.match(line) and "/" in LOCAL.match(line).group(1):
                yield "%s: include as <quoin/module/file.h>" % where


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(
        os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    found, files = [], 0
    for top in ("include", "source"):
        for folder, _, names in sorted(os.walk(os.path.join(root, top))):
            for name in sorted(names):
                if name.endswith((".h", ".cc")):
                    files += 1
                    found += complaints(os.path.join(folder, name), root)
    if files == 0:
        found.append("no source files under %s" % root)
    for line in found:
        print(line)
    print("%d files, %d wrong includes" % (files, len(found)))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
