#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Extreme but legal models: each against a closed form.

One triangle; ten thousand joints at a vertex; stiffnesses that differ by
1e12; sizes from a micrometre to a thousand kilometres; coordinates of a map,
far from the origin; neither friction nor cohesion.
"""
import math
import os
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402


class Mesh:
    """Triangles and named boundary lines as a file of gmsh (2.2)."""

    def __init__(self):
        self.nodes, self.elements, self.names = [], [], []

    def node(self, x, y):
        self.nodes.append((x, y))
        return len(self.nodes)

    def tag(self, dimension, name):
        if (dimension, name) not in self.names:
            self.names.append((dimension, name))
        return self.names.index((dimension, name)) + 1

    def triangle(self, group, *nodes):
        self.elements.append((2, self.tag(2, group), nodes))

    def line(self, name, *nodes):
        self.elements.append((1, self.tag(1, name), nodes))

    def column(self, groups, x=0., y=0., width=1., height=1.):
        """One square of two triangles on the other, each of a group, that
        share their nodes; the lines 'bottom' and 'top'."""
        rows = [[self.node(x + i * width, y + j * height) for i in (0, 1)]
                for j in range(len(groups) + 1)]
        for group, (a, b), (d, c) in zip(groups, rows, rows[1:]):
            self.triangle(group, a, b, c)
            self.triangle(group, a, c, d)
        self.line("bottom", *rows[0])
        self.line("top", *rows[-1])

    def write(self, path):
        with open(path, "w") as out:
            out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
            out.write("$PhysicalNames\n%d\n" % len(self.names))
            for i, (dimension, name) in enumerate(self.names):
                out.write('%d %d "%s"\n' % (dimension, i + 1, name))
            out.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(self.nodes))
            for i, (x, y) in enumerate(self.nodes):
                out.write("%d %.17g %.17g 0\n" % (i + 1, x, y))
            out.write("$EndNodes\n$Elements\n%d\n" % len(self.elements))
            for i, (kind, tag, nodes) in enumerate(self.elements):
                out.write("%d %d 2 %d %d %s\n" % (i + 1, kind, tag, tag,
                                                  " ".join(map(str, nodes))))
            out.write("$EndElements\n")


def text_of(entries, depth=0):
    lines = []
    for name, value in entries.items():
        if isinstance(value, dict):
            lines += ["  " * depth + "subsection " + name]
            lines += text_of(value, depth + 1)
            lines += ["  " * depth + "end"]
        else:
            lines.append("  " * depth + "set %s = %s" % (name, value))
    return lines


def elastic(density=2500., young=20e9, poisson=0., groups=None):
    entries = {"Density": density, "Young's modulus": young,
               "Poisson's ratio": poisson}
    if groups:
        entries["Groups"] = groups
    return entries


def joint(kn=50e9, ks=20e9, **more):
    entries = {"Law": "Coulomb", "Normal stiffness": kn,
               "Shear stiffness": ks}
    entries.update((name.replace("_", " "), value)
                   for name, value in more.items())
    return entries


def gravity(horizontal, vertical):
    return {"Type": "gravity", "Horizontal": horizontal, "Vertical": vertical}


def named(**entries):
    return dict({"Names": ", ".join(entries)}, **entries)


def solve(options, mesh, entries):
    """Last row of the histories of a run of these entries."""
    with tempfile.TemporaryDirectory() as folder:
        mesh.write(os.path.join(folder, "mesh.msh"))
        entries = dict({"Plane assumption": "plane stress"}, **entries)
        entries.setdefault("Mesh", {})["File"] = "mesh.msh"
        entries["Histories"]["Interval"] = entries.pop("Interval", 0)
        prm = os.path.join(folder, "case.prm")
        with open(prm, "w") as out:
            out.write("\n".join(text_of(entries)) + "\n")
        output = os.path.join(folder, "output")
        common.run(options.quoin, prm, output)
        table, _ = common.read_table(os.path.join(output, "histories.csv"))
        return {name: values[-1] for name, values in table.items()}


errors = []  # by their tolerances


def expect(what, found, expected, tolerance):
    error = abs(found - expected) / abs(expected)
    errors.append(error / tolerance)
    print("%-60s %13.6e %13.6e %8.1e" % (what, found, expected, error))
    if not error <= tolerance:
        raise Failure("%s: %.9g, but %.9g was expected" % (what, found,
                                                           expected))


def one_triangle(options):
    """Falls: -g t^2 / 2."""
    for displacements in "small", "large":
        mesh = Mesh()
        mesh.triangle("stone", mesh.node(0, 0), mesh.node(1, 0),
                      mesh.node(0, 1))
        row = solve(options, mesh, {
            "Materials": named(stone=elastic()),
            "Contact": {"Displacements": displacements},
            "Joints": named(touch=joint(Curves="none",
                                        New_contacts_between="all"))
            if displacements == "large" else {},
            "Loads": named(weight=gravity(0, -10)),
            "Stages": named(fall={"Loads": "weight", "End": "time",
                                  "Duration": 0.1, "Damping": "none"}),
            "Histories": named(u={"Quantity": "displacement y",
                                  "Point": "1, 0"})})
        expect("one triangle falls, %s displacements" % displacements,
               row["u"], -5 * row["time"]**2, 1e-9)


def slices(n, displacements, pressure=1e6):
    """Blocks like slices of a cake, under a pressure that they bear already:
    they stay at rest, and the joints transfer the pressure."""
    mesh = Mesh()
    tip = mesh.node(0, 0)
    rim = [mesh.node(math.cos(2 * math.pi * i / n),
                     math.sin(2 * math.pi * i / n)) for i in range(n)]
    for i in range(n):
        outer = rim[i], rim[(i + 1) % n]
        mesh.triangle("slice%d" % (i % 2), tip, *outer)
        mesh.line("rim", *outer)
    touch = "all" if displacements == "large" else ""
    return mesh, {
        "Materials": named(slice=elastic(groups="slice0, slice1")),
        "Mesh": {"Joints between": "slice0:slice1"},
        "Contact": {"Displacements": displacements},
        "Joints": named(cut=joint(Curves="unnamed", Friction_angle=30,
                                  New_contacts_between=touch)),
        "Loads": named(before={"Type": "initial stress",
                               "Stress": "%g, %g, 0" % (-pressure,
                                                        -pressure)},
                       push={"Type": "traction", "Boundary": "rim",
                             "Pressure": pressure}),
        "Stages": named(rest={"Loads": "push", "End": "time",
                              "Duration": 5e-7, "Damping": "none"}),
        "Histories": named(s={"Quantity": "joint normal traction",
                              "Point": "0.5, 0"})}


def joints_at_a_vertex(options):
    """Each transfers the pressure; too many are refused where any two may
    touch."""
    for n, displacements in (10000, "small"), (1000, "large"):
        row = solve(options, *slices(n, displacements))
        expect("%d joints at a vertex, %s displacements" % (n, displacements),
               row["s"], -1e6, 1e-9)
    try:
        solve(options, *slices(10000, "large"))
    except Failure as failure:
        if "too many for the contact search" not in str(failure):
            raise
    else:
        raise Failure("10 000 joints at a vertex, large displacements: there "
                      "is no memory for so many pairs, but it ran")


def pressed(young, kn, solver="implicit", x=0., y=0., size=1., stress=1e4,
            ks=None, **more):
    """Two blocks with a joint between under a pressure."""
    mesh = Mesh()
    mesh.column(["lower", "upper"], x, y, size, size)
    materials = named(lower=elastic(young=young[0]),
                      upper=elastic(young=young[1]))
    return mesh, dict({
        "Solver": solver,
        "Mesh": {"Joints between": "all"},
        "Materials": materials,
        "Joints": named(bed=joint(kn, ks or kn, Curves="unnamed")),
        "Loads": named(base={"Type": "prescribed motion",
                             "Boundary": "bottom", "Horizontal": 0,
                             "Vertical": 0},
                       push={"Type": "traction", "Boundary": "top",
                             "Pressure": stress}),
        "Stages": named(press={"Loads": "base, push",
                               "End": "static ratio",
                               "Damping": "local"}),
        "Histories": named(u={"Quantity": "displacement y",
                              "Point": "%.17g, %.17g" % (x, y + 2 * size)})},
        **more)


def shortening(young, kn, size, stress):
    return -stress * (size / young[0] + size / young[1] + 1 / kn)


def contrast(options):
    """Stiffnesses that differ by 1e12: sum of the compliances.

    Joints that are stiffer than both blocks by 1e10: beyond that the closure
    of a joint, 1e-10 of what its sides move, is lost in their rounding. A
    block that moves as a whole on a soft joint strains by the rounding of its
    displacements, whose stress by the joint's is that rounding times E / kn.
    """
    for young, kn in (((1e-2, 1e10), 1e10), ((1e10, 1e10), 1e-2),
                      ((1e-1, 1e-1), 1e9), ((1e10, 1e-2), 1e4)):
        stress = 1e-3 * min(*young, kn)
        mesh, entries = pressed(young, kn, stress=stress)
        row = solve(options, mesh, entries)
        expect("E = %.0e, %.0e Pa, kn = %.0e Pa/m" % (*young, kn),
               row["u"], shortening(young, kn, 1, stress),
               max(1e-6, sys.float_info.epsilon * max(young) / kn))


def sizes(options):
    """Sizes from a micrometre to a thousand kilometres, and the coordinates of
    a map."""
    for solver in "implicit", "explicit":
        for size, x, y in ((1e-6, 0, 0), (1e6, 0, 0), (1, 456789., 5412345.),
                           (0.1, -3e6, 2e6)):
            young, kn = (20e9, 20e9), 20e9 / size
            mesh, entries = pressed(young, kn, solver, x, y, size)
            row = solve(options, mesh, entries)
            expect("%s, size %g m, at %g, %g" % (solver, size, x, y),
                   row["u"], shortening(young, kn, size, 1e4),
                   1e-6 if solver == "implicit" else 1e-5)


def slippery(options):
    """Neither friction nor cohesion: a block on a plane that tilts gravity
    slides by g_x t^2 / 2."""
    for displacements in "small", "large":
        mesh, entries = pressed((20e9, 20e9), 20e9)
        entries["Contact"] = {"Displacements": displacements}
        if displacements == "large":
            entries["Joints"]["bed"]["New contacts between"] = "all"
        entries["Solver"] = "explicit"
        entries["Loads"] = named(
            base={"Type": "prescribed motion", "Boundary": "bottom",
                  "Horizontal": 0, "Vertical": 0},
            weight=gravity(1, -10))
        entries["Stages"] = named(slide={
            "Loads": "base, weight", "End": "time", "Duration": 0.2,
            "Damping": "none"})
        entries["Histories"]["u"]["Quantity"] = "displacement x"
        entries["Interval"] = 1e-3
        row = solve(options, mesh, entries)
        expect("neither friction nor cohesion, %s displacements"
               % displacements, row["u"], 0.5 * row["time"]**2, 1e-3)


def main(options):
    start = time.monotonic()
    if not options.only:
        results = common.begin(options, "extremes")
    for case in CASES:
        if not options.only or options.only in case.__name__:
            case(options)
    if not options.only:
        common.write_result(
            results, "extremes",
            title="one triangle, 10 000 joints at a vertex, stiffnesses that "
            "differ by 1e12, micrometres to 1000 km", reference="closed forms",
            error=max(errors) * 1e-3, tolerance=1e-3,
            seconds=round(time.monotonic() - start, 2), passed=True)


CASES = [one_triangle, joints_at_a_vertex, contrast, sizes, slippery]

if __name__ == "__main__":
    parser = common.arguments(__doc__)
    parser.add_argument("--only", help="those whose name has this in it")
    chosen = parser.parse_args()
    common.main(lambda: main(chosen))
