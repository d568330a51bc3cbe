#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs the shipped parameter files that cases.json and brackets.json do not.

Each must come to its end, close its energy balance as theirs do, and warn of
nothing but what WARNINGS says, a text of each warning.
"""
import glob
import json
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

FILES = os.path.join(common.ROOT, "parameter_files")
WAVES = "brings frequencies of up to"
WARNINGS = {
    # the kernel alone, without joints
    "benchmarks/blocks/case.prm": ["is held by nothing"],
    "benchmarks/tetrahedra/case.prm": ["is held by nothing", WAVES],
    # it falls down
    "masonry/arch_collapse/case.prm": ["has left the box"],
    # blocks as large as the model, with which the implicit solver ends
    "rock/tunnel_face_3d/case.prm": ["of the softest block beside them"],
    "rock/tunnel_face_3d/sections.prm": ["of the softest block beside them"],
    # bars that cross small blocks
    "rock/bolted_tunnel/case.prm": ["'Active length = 0.1' finds no room"],
    # as coarse as 30 m of rock around allow, see its README
    "rock/blast/large.prm": [WAVES],
    # its top course bends, bonded to the plate
    "tutorials/small_wall/case.prm": ["the platen push pulled its boundary"],
    # a joint without friction or stiffness in shear
    "verification/line_source_joint/viscous.prm": ["'Shear stiffness = 1'"],
    # all frequencies of the mesh, which must leave and not grow
    "verification/hybrid_long_run/case.prm": [WAVES],
    "verification/hybrid_long_run/half_plane.prm": [WAVES],
}


def others():
    """Paths of the parameter files that no table of cases names."""
    listed = set()
    for table in ("cases.json", "brackets.json"):
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)),
                               table)) as stream:
            listed |= {os.path.normpath(os.path.join(
                common.VERIFICATION, case["folder"],
                case.get("prm", "case.prm"))) for case in json.load(stream)}
    found = glob.glob(os.path.join(FILES, "*", "*", "*.prm"))
    return sorted(os.path.relpath(path, FILES)
                  for path in set(found) - listed)


def run(quoin, name):
    with tempfile.TemporaryDirectory(prefix="quoin_") as output:
        seconds = common.run(quoin, os.path.join(FILES, name), output)
        failed = common.unexpected_warnings(WARNINGS.get(name, []), output)
        residual = common.energy_residual_share(output)
    print("  %s: energy residual %.1e, %.1f s" % (name, residual, seconds),
          flush=True)
    if not residual <= common.MOST_RESIDUAL:
        failed.append("energy residual %.1e > %g"
                      % (residual, common.MOST_RESIDUAL))
    if failed:
        raise Failure("%s: %s" % (name, "; ".join(failed)))


def main():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="those with this in their "
                        "path below parameter_files/")
    options = parser.parse_args()
    names = others()
    strange = sorted(set(WARNINGS) - set(names))
    if strange:
        raise Failure("warnings of files that are not run: "
                      + ", ".join(strange))
    failures = []
    for name in names:
        if options.only not in name:
            continue
        try:
            run(options.quoin, name)
        except Failure as failure:
            print("FAILED: %s" % failure, flush=True)
            failures.append(name)
    if failures:
        raise Failure("%d files: %s" % (len(failures), ", ".join(failures)))


if __name__ == "__main__":
    common.main(main)
