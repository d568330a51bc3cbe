# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Checks of masonry walls, as those of checks.py.

Forces are reactions of the lower beam: negative where the upper one is pushed
to the right. What scripts/table shows of a wall goes into the case's "wall", what
it shows of both solvers into "solvers".
"""
import os
import sys

import numpy as np

import checks
import common
from common import Failure

sys.path.insert(0, os.path.join(common.ROOT, "python"))
from quoin import solver_comparison  # noqa: E402
from quoin import vtu  # noqa: E402

def note(case, tests, peak, histories):
    place = np.argmax(-histories["horizontal"])
    case["wall"] = {
        "tests": float(tests), "peak": float(peak),
        "displacement": float(histories["displacement"][place]),
        "vertical": float(histories["vertical"][place])}


def joint_faces(output):
    """Middles of the joint faces, and opening and slip there, at the end."""
    grid = vtu.read_at(os.path.join(output, "joints.pvd"))
    middle = grid.points.reshape(-1, 2, grid.points.shape[1]).mean(axis=1)
    opening = grid.point_data["opening"].reshape(-1, 2).max(axis=1)
    slip = np.abs(grid.point_data["slip"]).reshape(-1, 2).max(axis=1)
    return middle[:, :2], opening, slip


def quasi_static(output, histories):
    """Checks what every quasi-static run must show."""
    return {
        "kinetic energy share": float(
            np.max(histories["kinetic"][histories["displacement"] != 0])),
        "energy residual": checks.residual_of(checks.energies(output))}


def wall_stiffness(case, folder, output, histories):
    """Force by displacement of the beam: that of static_reference.py, a
    separate finite element solution of the same triangles and joint springs,
    and within 10 % of 103 kN/mm."""
    stiffness = -histories["horizontal"][-1] / histories["displacement"][-1]
    exact = checks.reference_module(folder,
                                    "static_reference").stiffness(output)
    return {"static finite elements": float(abs(stiffness / exact - 1)),
            "103 kN/mm": float(abs(stiffness / 103e6 - 1))}


def elastic_wall(case, folder, output, histories):
    """The last row of the explicit run in @p output, in which all is at rest,
    against that of the implicit solver, and the stiffness of both against a
    separate finite element solution of small displacements."""
    implicit = os.path.join(output, "implicit")
    common.run(case["quoin"], os.path.join(folder, "case.prm"), implicit,
               case.get("set", []) + ["Solver=implicit"])
    other, _ = common.read_table(os.path.join(implicit, "histories.csv"))
    names = [name for name in histories
             if name not in ("time", "kinetic", "clock", "rate", "vertical")]
    result = {"explicit by implicit, " + name: float(
        abs(histories[name][-1] / other[name][-1] - 1)) for name in names}
    exact = checks.reference_module(
        os.path.join(common.MASONRY, "tue_walls"),
        "static_reference").stiffness(implicit)
    for label, table in (("explicit", histories), ("implicit", other)):
        stiffness = -table["horizontal"][-1] / table["displacement"][-1]
        result["static finite elements, " + label] = float(
            abs(stiffness / exact - 1))
    return result


def shear_wall(case, folder, output, histories):
    """A wall between beams that do not turn: peak force of the tests, a fall
    beyond it, the vertical reaction that the locked beam raises, and wide
    cracks (more than a tenth of the displacement) along the diagonal of
    compression or at the beams."""
    force = -histories["horizontal"]
    peak = np.max(force)
    result = quasi_static(output, histories)
    result["peak of the tests"] = float(abs(peak / case["peak"] - 1))
    note(case, case["peak"], peak, histories)
    result["force at the end by the peak"] = float(force[-1] / peak)
    result["preload by largest vertical reaction"] = float(
        case["preload"] / np.max(histories["vertical"]))
    middle, opening, slip = joint_faces(output)
    wide = np.maximum(opening, slip) > 0.1 * histories["displacement"][-1]
    x, y = middle[:, 0] / 0.99, middle[:, 1] / 1.0
    expected = ((np.abs(x + y - 1) < 0.35) | (y < 0.01) | (y > 0.99))
    result["wide cracks elsewhere"] = float(
        np.count_nonzero(wide & ~expected) / max(1, np.count_nonzero(wide)))
    if case.get("diagonal", True):
        inside = wide & (np.abs(x + y - 1) < 0.2) & (y > 0.1) & (y < 0.9)
        courses = len(np.unique(np.floor(middle[inside, 1] / 0.0625)))
        result["courses that the diagonal misses"] = float(12 - courses)
    return result


def courses_of_blocks(output, height, n_courses):
    """Mean horizontal displacement of each block at the end, by course from
    the lower beam (0) to the upper one, from left to right."""
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    u = grid.point_data["displacement"]
    block = grid.cell_data["block"]
    middle = grid.points[grid.cells].mean(axis=1)
    moved = u[grid.cells, 0].mean(axis=1)
    courses = [[] for _ in range(n_courses + 2)]
    for b in np.unique(block):
        cells = block == b
        x, y = middle[cells].mean(axis=0)[:2]
        course = int(np.clip(np.floor(y / height) + 1, 0, n_courses + 1))
        courses[course].append((x, moved[cells].mean()))
    return [[m for _, m in sorted(course)] for course in courses]


def dry_wall(case, folder, output, histories):
    """Peak against the mean of two specimens; how the wall fails: one course
    slides on another by most of the displacement, or stepped diagonal cracks
    open a head joint in nearly every course."""
    force = -histories["horizontal"]
    result = quasi_static(output, histories)
    note(case, case["peak"], np.max(force), histories)
    result["peak of the tests"] = float(abs(np.max(force) / case["peak"] - 1))
    courses = courses_of_blocks(output, 0.1, 9)
    u = histories["displacement"][-1]
    slip = np.max(np.abs(np.diff([np.mean(course) for course in courses]))) / u
    opened = sum(np.max(np.diff(course)) > 0.02 * u for course in courses[1:-1])
    if case["fails by"] == "sliding":
        result["slip of a bed joint, missing of 2/3"] = float(
            max(0.0, 2 / 3 - slip))
    else:
        result["slip of a bed joint"] = float(slip)
        result["courses without an open head joint"] = float(9 - opened)
    return result


def cyclic_wall(case, folder, output, histories):
    """Peaks of the envelope in both senses, and hysteresis: the work of all
    cycles by that of the largest force along the whole path."""
    force, u = -histories["horizontal"], histories["displacement"]
    result = quasi_static(output, histories)
    for name, value, sign in (("peak pushed", np.max(force), "push"),
                              ("peak pulled", -np.min(force), "pull")):
        result[name] = float(abs(value / case[sign] - 1))
    note(case, 0.5 * (case["push"] + case["pull"]),
         0.5 * (np.max(force) - np.min(force)), histories)
    work = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(u))
    path = np.sum(np.abs(np.diff(u)))
    share = work / (path * np.max(np.abs(force)))
    result["hysteresis, missing of a fifth"] = float(max(0.0, 0.2 - share))
    return result


def compare_solvers(case, folder, output, histories):
    """The case once more by the implicit solver, against the explicit run in
    @p output; the implicit one may have lost its equilibrium."""
    prm = os.path.join(folder, case["prm"])
    implicit = os.path.join(output, "implicit")
    common.run(case["quoin"], prm, implicit,
               case.get("set", []) + ["Solver=implicit"],
               accepted=(0, common.RUN_FAILED))
    return solvers_agree(case, prm, output, implicit)


def solvers_agree(case, prm, explicit, implicit):
    """Both runs by the numbers of scripts/compare: the peak of the implicit
    one against the tests ("peak" [N]) and against the explicit one, the
    largest difference of the curves up to the earlier peak by the explicit
    one, the length of joints open at the peak in one run only by that open in
    either, and the part of the explicit curve that the implicit one does not
    reach."""
    try:
        numbers = solver_comparison.Comparison(
            *solver_comparison.spec_of(prm), explicit, implicit).numbers()
    except ValueError as error:
        raise Failure(str(error)) from error
    for note in numbers["notes"]:
        print("  note: " + note)
    if numbers["joints"] is None:
        raise Failure("joints cannot be compared, see the note")
    curves, joints = numbers["curves"], numbers["joints"]["at the peak"]
    note_solvers(case, numbers)
    # as shown: [kN], [mm]
    peak = abs(numbers["implicit"]["peak [kN]"])
    shared = joints["open in both"]
    return {
        "implicit peak of the tests": float(
            abs(1e3 * peak / case["peak"] - 1)),
        "peak, implicit by explicit": abs(
            numbers["peak, implicit by explicit"] - 1),
        "curves up to the peak": curves["largest difference up to the peak"],
        "open in one run only": 0.0 if shared is None else 1.0 - shared,
        "explicit curve, missing": 1.0 - curves["share of the explicit curve"]}


def plane_run(case, folder, output):
    """The histories of the plane wall of plane.prm, beside the run in three
    dimensions in @p output."""
    plane = os.path.join(output, "plane")
    common.run(case["quoin"], os.path.join(folder, "plane.prm"), plane,
               case.get("set", []))
    return common.read_table(os.path.join(plane, "histories.csv"))[0]


def plane_wall(case, folder, output, histories):
    """The run in three dimensions in @p output against the plane wall:
    stiffness of the first row after the push has lasted the time "elastic", by
    default of its first step, and the force all along the push by the largest
    one. Both go beyond their peaks if the last force is to be "fall" of
    the peak below it; then the peaks, too."""
    reference = plane_run(case, folder, output)
    pushed = reference["time"] > case["settled"] + 1e-9
    wanted = reference["force"][pushed]
    force = np.interp(reference["time"][pushed], histories["time"],
                      histories["force"])
    peaks = [np.max(np.abs(values)) for values in (wanted, force)]
    row = np.argmax(reference["time"][pushed]
                    >= case["settled"] + case.get("elastic", 0))
    errors = {"stiffness": float(abs(force[row] / wanted[row] - 1)),
              "force": float(np.max(np.abs(force - wanted)) / peaks[0])}
    if "fall" in case:
        for values, peak in zip((wanted, force), peaks):
            if abs(values[-1]) > (1 - case["fall"]) * peak:
                raise Failure("a wall ends at %g N, its peak is %g N"
                              % (abs(values[-1]), peak))
        errors["peak"] = float(abs(peaks[1] / peaks[0] - 1))
    return errors


def plane_wall_beyond_peak(case, folder, output, histories):
    """The same beyond the peak, which must be "fall" of it above the last
    force: peaks, works of the push, and forces from the time "broken" on by
    the peak. Between them cracks run through by jumps."""
    curves = [(table["time"], -table["force"])
              for table in (plane_run(case, folder, output), histories)]
    times = np.linspace(case["settled"], curves[0][0][-1], 401)[1:]
    peaks = [np.max(force) for _, force in curves]
    wanted, found = (np.interp(times, *curve) for curve in curves)
    if wanted[-1] > (1 - case["fall"]) * peaks[0]:
        raise Failure("the plane wall ends at %g N, its peak is %g N"
                      % (wanted[-1], peaks[0]))
    broken = times >= case["broken"]
    return {"peak": float(abs(peaks[1] / peaks[0] - 1)),
            "work": float(abs(found.sum() / wanted.sum() - 1)),
            "broken": float(np.max(np.abs(found - wanted)[broken])
                            / peaks[0])}


def note_solvers(case, numbers):
    """Notes what scripts/table shows of a wall by both solvers."""
    wanted = ("peak [kN]", "at [mm]", "wall time [s]")
    for name in wanted:
        if numbers["implicit"].get(name) is None:
            raise Failure("the implicit run has no '%s': is the figure of the "
                          "case in [mm] and [kN]?" % name)
    case["solvers"] = {
        "tests [kN]": case["peak"] / 1e3,
        **{solver: {name: numbers[solver][name] for name in wanted}
           for solver in solver_comparison.SOLVERS},
        "curve difference": numbers["curves"][
            "largest difference up to the peak"],
        "open in both": numbers["joints"]["at the peak"]["open in both"]}


def slab_force(histories):
    """Reaction of the foundation [N], and whether it moves."""
    return -histories["force"], histories["displacement"] > 0


def sliding_wall(case, folder, output, histories):
    """The solid wall of the tutorial, cracked through: a course slides, and
    the force is tan(phi) N."""
    force, _ = slab_force(histories)
    result = quasi_static(output, histories)
    result["sliding force"] = float(abs(force[-1] / (0.6 * 180e3) - 1))
    result["sliding force by the peak"] = float(force[-1] / force.max())
    return result


def largest_pressure(case, folder, output, histories):
    """The residual of the energy balance; the largest force of the supports 'base'
    and 'edges' across a wall, by the area of its face, must lie between two bounds
    and be passed: the wall bears less at the end."""
    errors = checks.energy_residual(case, folder, output, histories)
    pressure = -(histories["base"] + histories["edges"]) / case["area"]
    low, high = case["pressure between"]
    if not low < np.max(pressure) < high:
        raise Failure("the supports bear at most %g Pa, not between %g and %g"
                      % (np.max(pressure), low, high))
    if not pressure[-1] < np.max(pressure):
        raise Failure("the largest pressure was not passed")
    return errors


def rocking_piers(case, folder, output, histories):
    """The wall with a window of the tutorial: the estimate that its README
    makes by hand. Piers of the length 1 m between cracks that rise at 30
    degrees from the corners of the window rock on toes at 0.85 fm."""
    force, moves = slab_force(histories)
    length, window, storey, thickness = 1.0, 1.0, 2.5, 0.2
    load, strength = 180e3, 5e6
    clear = window + length * np.tan(np.pi / 6)
    height = clear + length * (storey - clear) / (3 * clear)
    toe = load / 2 / (0.85 * strength * thickness)
    by_hand = load * (length - toe) / height
    print("  by hand %.1f kN, peak %.1f kN"
          % (by_hand / 1e3, force.max() / 1e3))
    result = quasi_static(output, histories)
    result["rocking by hand"] = float(abs(force.max() / by_hand - 1))
    vertical = histories["vertical"][moves]
    result["mean vertical reaction"] = float(
        abs(np.mean(vertical) / load - 1))
    return result


def pushed_pier(case, folder, output, histories):
    """The template's wall: it rocks as a whole between toes that are crushed at
    0.85 fm; the foundation bears the jack and all weights."""
    templates = checks.reference_module(os.path.dirname(folder), "estimates")
    by_hand = min(templates.wall())
    peak = -histories["base_shear"].min()
    print("  by hand %.1f kN, peak %.1f kN" % (by_hand / 1e3, peak / 1e3))
    moves = histories["drift"] > 1e-4
    vertical = float(np.mean(histories["base_vertical"][moves]))
    return {"rocking by hand": abs(peak / by_hand - 1),
            "mean vertical reaction": abs(vertical / 161.8e3 - 1),
            "kinetic energy share": float(np.max(histories["kinetic"][moves])),
            "energy residual": checks.residual_of(checks.energies(output))}
