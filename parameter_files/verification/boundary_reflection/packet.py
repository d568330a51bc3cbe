#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Wave packets that meet a boundary: closed form, meshes, packets, runs.

Without arguments it writes case.geo, packet.inc and reference.csv, the energy
that dashpots reflect by the closed form. tests/cases/reflection.py runs it for
the tests, sweep.py for the table and the figure.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, *[os.pardir] * 3, "tests", "cases"))
import common  # noqa: E402

WAVELENGTH = 10.0
RHO, E, NU = 2500.0, 18.75e9, 0.25
C2 = np.sqrt(E / (2 * RHO * (1 + NU)))
C1 = C2 * np.sqrt((2 - 2 * NU) / (1 - 2 * NU))
SPEED = {"P": C1, "SV": C2}
ANGLES = (0, 15, 30, 45, 60, 75)


# -- closed form --------------------------------------------------------------

def reflected_share(kind, angle):
    """Energy that dashpots rho c1, rho c2 send back of a plane wave that comes
    in at @p angle [rad] from the normal. The medium is x < 0, the wave
    d exp(i w (s . x - t)) with the polarisation d and the slowness s; traction
    over -i w is -lambda d.s - 2 mu d_x s_x and -mu (d_x s_y + d_y s_x)."""
    mu = C2**2
    lam = C1**2 - 2 * mu
    p = np.sin(angle) / SPEED[kind]
    q = {"P": np.sqrt(complex(C1**-2 - p**2)),
         "SV": np.sqrt(complex(C2**-2 - p**2))}

    def wave(of, sign):
        s = np.array([sign * q[of], p])
        d = C1 * s if of == "P" else C2 * np.array([-p, sign * q[of]])
        # what is left of sigma n + rho c v: zero for the sum of the waves
        return np.array([
            -lam * d @ s - 2 * mu * d[0] * s[0] + C1 * d[0],
            -mu * (d[0] * s[1] + d[1] * s[0]) + C2 * d[1]])

    amplitudes = np.linalg.solve(
        np.column_stack([wave("P", -1), wave("SV", -1)]), -wave(kind, 1))
    flux = np.array([C1**2 * q["P"].real, C2**2 * q["SV"].real])
    return float(np.abs(amplitudes)**2 @ flux
                 / (SPEED[kind]**2 * q[kind].real))


def packet_share(kind, degrees, along, across):
    """Share of a packet: the mean over its plane waves by their energy.
    The potential is exp(-xi^2/2 along^2 - eta^2/2 across^2) cos(k xi), so a
    plane wave of wave numbers (a, b) in xi and eta has an energy as the square
    of exp(-(a - k)^2 along^2/2 - b^2 across^2/2) times the wave number^4."""
    k = 2 * np.pi / WAVELENGTH
    a = k + np.linspace(-4, 4, 81) / along / np.sqrt(2)
    b = np.linspace(-4, 4, 161) / across / np.sqrt(2)
    a, b = np.meshgrid(a, b, indexing="ij")
    weight = (np.exp(-(a - k)**2 * along**2 - b**2 * across**2)
              * (a**2 + b**2)**2)
    weight[a <= 0] = 0
    angle = np.abs(np.radians(degrees) + np.arctan2(b, a))
    table = np.linspace(0, np.pi / 2 - 1e-4, 1801)
    share = np.interp(angle, table,
                      [reflected_share(kind, t) for t in table])
    share[angle >= np.pi / 2] = 1  # it never meets the boundary
    return float(np.sum(weight * share) / np.sum(weight))


# -- input --------------------------------------------------------------------

def packet(kind, degrees, centre, along, across, amplitude=1e-6):
    """The lines of section 'Initial motion': the gradient or the curl of the
    potential, in [m] about @p amplitude, moving on with its speed."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    k = 2 * np.pi / WAVELENGTH
    x, y = "(x%+.9g)" % -centre[0], "(y%+.9g)" % -centre[1]
    xi = "(%s*%.9g+%s*%.9g)" % (x, c, y, s)
    eta = "(%s*%.9g-%s*%.9g)" % (y, c, x, s)
    a, b = along**-2, across**-2
    cosine = "cos(%.9g*%s)" % (k, xi)
    sine = "sin(%.9g*%s)" % (k, xi)
    envelope = "%.9g*exp(-%s^2*%.9g-%s^2*%.9g)" % (amplitude / k, xi, a / 2,
                                                   eta, b / 2)
    # derivatives of the potential, without the envelope
    first = "(-%.9g*%s*%s-%.9g*%s)" % (a, xi, cosine, k, sine)
    cross = "(-%.9g*%s*%s)" % (b, eta, cosine)
    second = "((%.9g*%s^2-%.9g)*%s+%.9g*%s*%s)" % (
        a * a, xi, a + k * k, cosine, 2 * k * a, xi, sine)
    mixed = "(%.9g*%s*(%.9g*%s*%s+%.9g*%s))" % (b, eta, a, xi, cosine, k, sine)
    if kind == "P":
        u, v = (first, cross), (second, mixed)
    else:
        u, v = (cross, "(-%s)" % first), (mixed, "(-%s)" % second)

    def turned(pair, factor):
        return ["%.9g*%s*(%.9g*%s%+.9g*%s)" % (factor, envelope, p, pair[0],
                                              q, pair[1])
                for p, q in ((c, -s), (s, c))]

    return {"Displacement": "; ".join(turned(u, 1.0)),
            "Velocity": "; ".join(turned(v, -SPEED[kind]))}


def geometry(width, height, size, together=1):
    """A rectangle from (-width, 0) to (0, height), the wall on its right. The
    number of edges of a side is a multiple of @p together."""
    edges = [together * round(length / (together * size))
             for length in (width, height)]
    return """// A rectangle of %.9g m x %.9g m.
Point(1) = {%.9g, 0, 0};
Point(2) = {0, 0, 0};
Point(3) = {0, %.9g, 0};
Point(4) = {%.9g, %.9g, 0};
For i In {1:4}
  Line(i) = {i, i %% 4 + 1};
EndFor
Transfinite Curve{1, 3} = %d;
Transfinite Curve{2, 4} = %d;
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface{1};
Physical Curve("wall") = {2};
Physical Curve("rest") = {1, 3, 4};
Physical Surface("rock") = {1};
""" % (width, height, -width, height, -width, height,
       edges[0] + 1, edges[1] + 1)


def extent(degrees, along, across, turned=0.0, reach=3.0):
    """Distance that the packet reaches from its centre along a direction that
    is @p turned [degrees] from the normal of the wall."""
    angle = np.radians(degrees - turned)
    return reach * np.hypot(along * np.cos(angle), across * np.sin(angle))


# -- runs ---------------------------------------------------------------------

def wide_model(kind, degrees, along, across, size):
    """Mesh, packet and duration such that all of the packet meets the wall,
    once, and nothing else before. What it sends back stays in the model."""
    ahead = extent(degrees, along, across)
    beside = extent(degrees, along, across, 90)
    rise = 2 * ahead * np.tan(np.radians(degrees))
    # what spreads on the way needs more
    spread = 1 + 0.2 * rise / (rise + 10 * across)
    height = 2 * beside + spread * rise
    settings = packet(kind, degrees, (-ahead, beside), along, across)
    length = 2 * spread * ahead / np.cos(np.radians(degrees))
    return (geometry(2.1 * ahead, height, size), settings,
            length / SPEED[kind])


def small_model(kind, degrees, along, across, size, together):
    """Mesh, packet and duration such that the packet has just room in front of
    the wall, and meets all of it: for boundary elements all around. It ends
    when plane waves 15 degrees more oblique have passed too, before what they
    sent back has left through the other side."""
    ahead = extent(degrees, along, across, reach=4)
    beside = extent(degrees, along, across, 90, reach=4)
    settings = packet(kind, degrees, (-ahead, beside), along, across)
    height = 2 * beside + 2 * ahead * np.tan(np.radians(degrees))
    cosine = np.cos(np.radians(min(degrees + 15, 82)))
    return (geometry(2 * ahead, height, size, together), settings,
            1.05 * 2 * ahead / cosine / SPEED[kind])


def run(quoin, folder, name, geo, settings, duration, more=()):
    """Runs it; returns times and the energy in the model by the first one."""
    mesh = os.path.join(folder, name + ".geo")
    with open(mesh, "w") as stream:
        stream.write(geo)
    output = os.path.join(folder, name)
    sets = ["Mesh/File=" + mesh, "Stages/passage/Duration=%.9g" % duration,
            "Histories/Interval=%.9g" % (duration / 100)]
    sets += ["Initial motion/%s=%s" % item for item in settings.items()]
    seconds = common.run(quoin, os.path.join(HERE, "case.prm"), output,
                         sets + list(more))
    table = common.strictly_increasing(
        common.read_table(os.path.join(output, "energies.csv"))[0])
    energy = table["kinetic"] + table["strain"]
    residual = np.max(np.abs(table["residual"])) / energy[0]
    if not residual < 1e-5:
        raise common.Failure("%s: energy residual %.1e of the packet's"
                             % (name, residual))
    return table["time"], energy / energy[0], seconds


FIXED = ["Loads/wall/Type=prescribed motion", "Loads/wall/Horizontal=0",
         "Loads/wall/Vertical=0"]


def boundary_elements(element_length, step_ratio=None):
    sets = ["Loads/wall/Type=boundary elements", "Loads/wall/Boundary=",
            "Boundary elements/Names=around",
            "Boundary elements/around/Shape=interface",
            "Boundary elements/around/Curves=wall, rest",
            "Boundary elements/around/Domain=outside",
            "Boundary elements/Element length=%.9g" % element_length,
            "Boundary elements/Passivity frequencies=0"]
    if step_ratio:
        sets.append("Boundary elements/Step ratio=%g" % step_ratio)
    return sets


def main():
    geo, settings, _ = wide_model("P", 30, 6.0, 10.0, 0.8)
    with open(os.path.join(HERE, "case.geo"), "w") as stream:
        stream.write(geo)
    with open(os.path.join(HERE, "packet.inc"), "w") as stream:
        stream.write("# Written by packet.py.\n")
        for item in settings.items():
            stream.write("set %s = %s\n" % item)
    rows = [[degrees] + [reflected_share(kind, np.radians(degrees))
                         for kind in ("P", "SV")] for degrees in ANGLES]
    np.savetxt(os.path.join(HERE, "reference.csv"), rows, delimiter=",",
               fmt="%.6g", comments="",
               header="angle [deg],P [-],SV [-]")


if __name__ == "__main__":
    main()
