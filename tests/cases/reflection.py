#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Energy that boundaries send back of wave packets, at several angles.

Dashpots against the closed form, averaged over the packet; boundary elements
against nothing at all.
"""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

sys.path.insert(0, os.path.join(common.VERIFICATION, "boundary_reflection"))
import packet  # noqa: E402

DASHPOTS = [("P", 0), ("P", 45), ("SV", 30), ("SV", 45)]
ALONG, ACROSS, SIZE = 6.0, 10.0, 0.8
TOLERANCE = 0.006  # 20 % off in an impedance are more
# what of it is left with eight elements to a wave length
ELEMENTS = [("P", 0, 2e-4), ("SV", 30, 5e-4)]


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    options = parser.parse_args()
    results = common.begin(options, "boundary_reflection")
    worst, total, failed = 0.0, 0.0, []
    with tempfile.TemporaryDirectory() as folder:
        for kind, angle in DASHPOTS:
            model = packet.wide_model(kind, angle, ALONG, ACROSS, SIZE)
            name = "%s_%g" % (kind, angle)
            _, energy, seconds = packet.run(options.quoin, folder, name,
                                            *model)
            exact = packet.packet_share(kind, angle, ALONG, ACROSS)
            error = abs(energy[-1] - exact)
            print("dashpots %-2s %2g: %.4f, closed form of the packet %.4f, "
                  "%.1f s" % (kind, angle, energy[-1], exact, seconds))
            worst, total = max(worst, error), total + seconds
            if error > TOLERANCE:
                failed.append("dashpots, %s: %.4f" % (name, energy[-1]))
        for kind, angle, bound in ELEMENTS:
            length = packet.WAVELENGTH / 8
            model = packet.small_model(kind, angle, 5.5, 5.5, length / 3, 3)
            name = "elements_%s_%g" % (kind, angle)
            _, energy, seconds = packet.run(options.quoin, folder, name, *model,
                                            packet.boundary_elements(length))
            print("boundary elements %-2s %2g: %.1e, at most %.0e, %.1f s"
                  % (kind, angle, energy[-1], bound, seconds))
            total += seconds
            if energy[-1] > bound:
                failed.append("boundary elements, %s: %.1e"
                              % (name, energy[-1]))
    common.write_result(
        results, "boundary_reflection",
        title="energy reflected by dashpots and boundary elements",
        reference="plane waves at dashpots, closed form",
        error=worst, tolerance=TOLERANCE, seconds=round(total, 2),
        passed=not failed)
    if failed:
        raise Failure("; ".join(failed))
    print("passed: boundary_reflection: error %.2e, tolerance %.1e"
          % (worst, TOLERANCE))


if __name__ == "__main__":
    common.main(body)
