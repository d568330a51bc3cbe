# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Checks of single cases beyond the comparison of columns.

Each takes the case's entry, its folder, the output folder and the histories,
and returns {what: error}, what by the names of the case's "tolerances".
"""
import importlib.util
import json
import os
import sys

import numpy as np

from common import ROOT, Failure, read_table, run, strictly_increasing

sys.path.insert(0, os.path.join(ROOT, "python"))
from quoin import mesh_convergence, vtu  # noqa: E402


def reference_module(folder, name="make_reference"):
    """A script of a case, imported."""
    spec = importlib.util.spec_from_file_location(
        name, os.path.join(folder, name + ".py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def energies(output):
    table, _ = read_table(os.path.join(output, "energies.csv"))
    return strictly_increasing(table)


def peak_energy(table):
    names = ("kinetic", "strain", "joint", "friction", "fracture", "crushing",
             "plastic", "damping", "viscous", "contact", "external")
    return max(np.max(np.abs(table[name])) for name in names)


def residual_of(table):
    """The residual of the energy balance relative to the peak energy."""
    return float(np.max(np.abs(table["residual"])) / peak_energy(table))


def require_time_shares(output, phases):
    """summary.json says what the time went into, all of it."""
    with open(os.path.join(output, "summary.json")) as stream:
        shares = json.load(stream)["time shares"]
    missing = set(phases) - set(shares)
    if missing:
        raise Failure("'time shares' has no %s" % ", ".join(sorted(missing)))
    # Shares below 0.1 % are left out.
    if abs(sum(shares.values()) - 1) > 1e-3 * len(shares) + 5e-3:
        raise Failure("'time shares' add up to %g" % sum(shares.values()))


def energy_residual(case, folder, output, histories):
    """The residual of the energy balance relative to the peak energy."""
    return {"energy residual": residual_of(energies(output))}


def radiated_energy(case, folder, output, histories):
    """Energy of the blocks at the time "by", when all waves of a pulse have left
    the model, by that which the pulse gave away; and the residual."""
    table = energies(output)
    stays = np.interp(case["by"], table["time"],
                      table["kinetic"] + table["strain"])
    return {"energy that stays": float(stays / table["external"][-1]),
            "energy residual": residual_of(table)}


def scattered_waves(case, folder, output, histories):
    """How far velocities "near" a scatterer are from those of a model whose sides
    are farther away, by the settings "wide", relative to what the scatterer
    adds there to the motion "without" it: the largest values, and the root
    mean squares over all of these histories and the run."""
    wide = os.path.join(output, "wide")
    run(case["quoin"], os.path.join(folder, case["prm"]), wide,
        case.get("set", []) + case["wide"])
    far, _ = read_table(os.path.join(wide, "histories.csv"))
    flat, _ = read_table(os.path.join(folder, case["without"]))
    t = far["time"][far["time"] <= flat["time"][-1]]
    back, added = [], []
    for name in case["near"]:
        for axis in "xyz":
            column = "%s_%s" % (name, axis)
            wanted = np.interp(t, far["time"], far[column])
            back.append(np.interp(t, histories["time"], histories[column])
                        - wanted)
            added.append(wanted - np.interp(t, flat["time"],
                                            flat["middle_" + axis]))
    print("  the scatterer adds up to %.3g m/s, %.3g of the motion without it"
          % (np.max(np.abs(added)), np.max(np.abs(added)) / max(
              np.max(np.abs(flat["middle_" + axis])) for axis in "xyz")))
    return {"sent back, largest": float(np.max(np.abs(back))
                                        / np.max(np.abs(added))),
            "sent back, rms": float(np.linalg.norm(back)
                                    / np.linalg.norm(added)),
            **energy_residual(case, folder, output, histories)}


def cable_bond(case, folder, output, histories):
    """Of a bar half way out of its grout, in cables.pvd: how far the bond has
    slipped there, by the reference, as a share of its length. And the residual
    of the energy balance."""
    exact = reference_module(folder)
    time = case["fields at"]
    table, _ = read_table(os.path.join(folder, case["reference"]))
    length = np.interp(time, table["time"], table["slipped"])
    grid = vtu.read_at(os.path.join(output, "cables.pvd"), time)
    depth = 0.7 - exact.FREE - (grid.points[:, :2]
                                - grid.point_data["displacement"][:, :2])[:, 1]
    state = grid.point_data["bond state"]
    bonded = depth > -1e-9
    if np.any(state[~bonded] != 3) or np.any(state[bonded] == 3):
        raise Failure("'bond state' does not tell where there is grout")
    if np.any(grid.cell_data["state"]):
        raise Failure("'state' shows a bar that yields")
    slipped = bonded & (state > 0)
    force = np.abs(grid.point_data["bond force"][slipped])
    errors = energy_residual(case, folder, output, histories)
    errors["slipped field"] = max(
        abs(depth[slipped].max() - length),
        abs(depth[bonded & ~slipped].min() - length)) / exact.LENGTH
    errors["strength"] = float(np.max(np.abs(force / exact.STRENGTH - 1)))
    return errors


def cable_stiffness(case, folder, output, histories):
    """Force by slip of bars pulled out of bonds of 0.1, 1 and 10 GN/m2."""
    exact = reference_module(folder)
    return {name: abs(histories["force_" + name][-1]
                      / -histories["slip_" + name][-1]
                      / exact.stiffness(bond) - 1)
            for name, bond in (("soft", 1e8), ("medium", 1e9),
                               ("stiff", 1e10))}


def water_balance(case, folder, output, histories):
    """What flows in, out and is stored closes to 1e-10 of the flow;
    the last flows at boundaries are those of the table "flows", and with
    "constant flow" they have brought and taken all of the water."""
    table, _ = read_table(os.path.join(output, "flow.csv"))
    went = np.maximum(table["inflow"] + table["outflow"], 1e-300)
    closed = (table["inflow"] - table["outflow"] - table["stored"]
              - table["residual"]) / went
    worst = max(np.max(np.abs(table["residual"] / went)),
                np.max(np.abs(closed)))
    if not worst <= 1e-10:
        raise Failure("the water balance is off by %.1e" % worst)
    if "flows" not in case:
        return {}
    flows, _ = read_table(os.path.join(folder, case["flows"]))
    scale = max(np.max(np.abs(values)) for values in flows.values())
    errors = {"flows": max(abs(table[name][-1] - values[0]) / scale
                           for name, values in flows.items())}
    if case.get("constant flow"):
        with open(os.path.join(output, "summary.json")) as stream:
            summary = json.load(stream)
        rate = sum(max(values[0], 0) for values in flows.values())
        errors["volumes"] = max(
            abs(volume / (rate * time) - 1) for volume, time in
            ((table["inflow"][-1], table["time"][-1]),
             (summary["water outflow [m3]"], summary["time [s]"])))
    return errors


def space_joint_fields(case, folder, output, histories):
    """joints.pvd of a joint of tetrahedra in uniform stress: all points have the
    opening, slip and tractions of the reference, all faces its normal, and
    their areas add up to the resultant."""
    table, _ = read_table(os.path.join(folder, "reference.csv"))
    force = np.array([table["force_" + c][-1] for c in "xyz"])
    slip = np.array([table["slip_" + c][-1] for c in "xyz"])
    normal = np.array([-0.2, -1 / 16, 1])
    normal /= np.linalg.norm(normal)
    shear = table["shear"][-1] / table["slip"][-1] * slip
    grid = vtu.read_at(os.path.join(output, "joints.pvd"))
    if grid.cells.shape[1] != 3 or len(grid.points) != 3 * len(grid.cells):
        raise Failure("joints.pvd has no triangles of three points each")
    corners = grid.points[grid.cells]
    across = np.cross(corners[:, 1] - corners[:, 0],
                      corners[:, 2] - corners[:, 0])
    data, faces = grid.point_data, grid.cell_data
    tractions = (data["normal traction"][:, None] * normal
                 + data["shear traction"]).reshape(-1, 3, 3).mean(axis=1)
    resultant = -(faces["area"][:, None] * tractions).sum(axis=0)

    def error(values, wanted):
        return float(np.max(np.abs(values - wanted))
                     / np.max(np.abs(wanted)))

    if np.any(faces["state"]) or np.any(data["point state"]):
        raise Failure("joints.pvd has joints that are not intact")
    return {"joint fields": max(
        error(data["opening"], table["opening"][-1]),
        error(data["slip"], slip),
        error(data["normal traction"], table["normal"][-1]),
        error(data["shear traction"], shear),
        error(faces["normal"], normal),
        error(across / 2, faces["area"][:, None] * normal),
        error(resultant, force))}


def reset_results(case, folder, output, histories):
    """The run once more without 'Reset': all columns but those that it resets
    ("reset"), and energies, are the same bit by bit. And the residual of the
    energy balance."""
    whole = os.path.join(output, "whole")
    run(case["quoin"], os.path.join(folder, case["prm"]), whole,
        case.get("set", []) + ["Stages/back/Reset="])
    one, other = (read_table(os.path.join(path, "histories.csv"))[0]
                  for path in (output, whole))
    for name in one:
        if np.array_equal(one[name], other[name]) == (name in case["reset"]):
            raise Failure("'%s' %s without 'Reset'" % (
                name, "is the same" if name in case["reset"] else "differs"))
    before, after = (open(os.path.join(path, "energies.csv"), "rb").read()
                     for path in (output, whole))
    if before != after:
        raise Failure("energies differ without 'Reset'")
    return energy_residual(case, folder, output, histories)


def collapse(case, folder, output, histories):
    """The largest factor of a load pattern in summary.json by that of the case,
    the largest mean likewise, if it has them, and the residual of the energy balance. Supports must take
    the loads, and the factor be between two bounds and the work of loads below
    one, if there are some."""
    with open(os.path.join(output, "summary.json")) as stream:
        stage = json.load(stream)["stages"]["push"]
    errors = energy_residual(case, folder, output, histories)
    if "most work" in case:
        energies, _ = read_table(os.path.join(output, "energies.csv"))
        work = energies["external"][-1]
        if not 0 < work < case["most work"]:
            raise Failure("the loads did a work of %g J, not up to %g J"
                          % (work, case["most work"]))
    if "largest factor" in case:
        wanted = case["largest factor"]
        errors["largest factor"] \
            = abs(stage["largest load factor"]["factor"] - wanted) / wanted
    if "largest mean factor" in case:
        mean = stage["largest load factor"]["mean without inertia and damping"]
        errors["largest mean factor"] \
            = abs(mean / case["largest mean factor"] - 1)
    low, high = case.get("factor between", (0, float("inf")))
    factor = stage["largest load factor"]["factor"]
    if not low < factor < high:
        raise Failure("the largest factor %g is not between %g and %g"
                      % (factor, low, high))
    if "supports do not take the loads" in stage:
        raise Failure("supports do not take the loads: %s"
                      % stage["supports do not take the loads"])
    return errors


def outcomes(case, folder, output, histories):
    """Times at which the stages ended, each with the outcome of the case, in the
    order of the run; and the residual of the energy balance."""
    with open(os.path.join(output, "summary.json")) as stream:
        stages = json.load(stream)["stages"]
    if list(stages) != list(case["outcomes"]):
        raise Failure("summary.json has the stages %s in this order"
                      % ", ".join(stages))
    errors = energy_residual(case, folder, output, histories)
    for name, (outcome, time) in case["outcomes"].items():
        found = stages.get(name, {})
        if found.get("outcome") != outcome:
            raise Failure("stage %s ended as '%s', not '%s'"
                          % (name, found.get("outcome"), outcome))
        errors["time of " + name] = abs(found["time [s]"] / time - 1)
    return errors


def spreading_arch(case, folder, output, histories):
    """Thrust and crown of an arch on spreading supports, and the spread at
    which it falls; or, if the case is one that the program should warn of,
    that it did. The residual of the energy balance in any case."""
    with open(os.path.join(output, "log.txt")) as stream:
        warned = "local damping opposed" in stream.read()
    if warned != case.get("warns", False):
        raise Failure("%s warning of local damping"
                      % ("a" if warned else "no"))
    errors = energy_residual(case, folder, output, histories)
    if warned:
        return errors
    exact = reference_module(folder)
    spread = 2 * histories["spread"]
    crown = histories["crown"]
    fallen = np.argmax(crown < -exact.HEIGHT)
    collapse = np.interp(exact.HEIGHT, -crown[fallen - 1:fallen + 1],
                         spread[fallen - 1:fallen + 1])
    chosen = (spread > 0.02) & (spread < 0.44)
    spread = spread[chosen]
    errors["collapse"] = abs(collapse / exact.COLLAPSE - 1)
    errors["thrust"] = np.max(np.abs(
        np.abs(histories["thrust"][chosen]) / exact.thrust(spread) - 1))
    errors["crown / height"] = np.max(np.abs(
        crown[chosen] + exact.HEIGHT - exact.rise(spread))) / exact.HEIGHT
    return {name: float(error) for name, error in errors.items()}


def initial_energy(case, folder, output, histories):
    """The energy of the pulse f(x) that is put in at the start, half of it
    strain: rho c^2 times the integral of f'^2; and the residual."""
    table = energies(output)
    amplitude, width, height = 1e-4, 2.0, 0.4
    exact = (2500 * 3000.0**2 * height * amplitude**2 * np.sqrt(np.pi / 2)
             / width)
    return {
        "energy at the start": float(abs(table["external"][0] / exact - 1)),
        "strain at the start": float(abs(table["strain"][0] / exact - 0.5)),
        "energy residual": float(np.max(np.abs(table["residual"])) / exact)}


def miller(case, folder, output, histories):
    """Coefficients from the energy fluxes over the last full period, from the
    time "from"; of a wave polarised along "way" by its components."""
    name = os.path.join(folder, case.get("coefficients", "coefficients.csv"))
    table = np.loadtxt(name, delimiter=",", skiprows=1)
    exact = table[np.argmin(np.abs(table[:, 0] - case["cohesion"]))]
    histories = strictly_increasing(histories)
    frequency = case.get("frequency", 1.0)
    speed = (10e9 / 2650.0) ** 0.5
    amplitude = 1e6 / (2650.0 * 10e9) ** 0.5
    t = case.get("from", 2.1) + np.linspace(0, 1 / frequency, 4001)[:-1]

    def velocity(place):
        if "way" not in case:
            return np.interp(t, histories["time"], histories["v_" + place])
        return sum(part * np.interp(t, histories["time"],
                                    histories["%s_%s" % (axis, place)])
                   for axis, part in zip("xyz", case["way"]))

    flux = amplitude**2 / 2
    passed = np.mean(velocity("above") ** 2) / flux
    arriving = amplitude * np.sin(2 * np.pi * frequency * (
        t - case.get("distance", 50) / speed))
    reflected = np.mean((velocity("below") - arriving) ** 2) / flux
    absorbed = max(1 - passed - reflected, 0.0)
    values = np.sqrt([passed, reflected, absorbed])
    result = {label: float(abs(value - wanted))
              for label, value, wanted in zip("TRA", values, exact[1:])}
    # A = 0 is the root of a difference: compare what is under the root
    if exact[3] < 1e-3:
        result["A"] = float(absorbed)
    return result


def slopes(case, folder, output, histories):
    """Slopes of the three parts of the load cycle by straight-line fits."""
    exact = np.loadtxt(os.path.join(folder, "slopes.csv"), delimiter=",",
                       skiprows=1)
    u, force = -histories["displacement"], -histories["force"]
    turn = int(np.argmax(u))
    peak, top = u[turn], force[turn]
    up, down = np.arange(turn + 1), np.arange(turn, len(u))
    load = up[(u[up] > 0.1 * peak) & (u[up] < 0.95 * peak)]
    unload = down[(force[down] < 0.97 * top) & (force[down] > 0.62 * top)]
    back = down[(force[down] < 0.48 * top) & (force[down] > 0.05 * top)]
    result = {}
    for label, rows, wanted in zip(("load", "unload", "back-slip"),
                                   (load, unload, back), exact):
        if len(rows) < 5:
            raise Failure("too few points on the %s branch" % label)
        slope = np.polyfit(u[rows], force[rows], 1)[0]
        print("  slope %-10s %.3f GN/m, formula %.3f GN/m"
              % (label, slope / 1e9, wanted / 1e9))
        result["slope " + label] = float(abs(slope / wanted - 1))
    return result


def free_flight(case, folder, output, histories):
    """Energy and the absence of stress beyond the centrifugal one."""
    table = energies(output)
    flight = table["time"] > 0.011
    kinetic = table["kinetic"][flight]
    t = table["time"][flight]
    # stretching by the sudden release is all that may be taken from it
    mass, gravity = 2000.0 * 1.0 * 0.5, 9.81

    def fallen(time):
        height = 2.0 * time - gravity * time**2 / 2
        return mass * gravity * height

    mechanical = kinetic + table["strain"][flight] + fallen(t)
    centrifugal = 2000.0 * np.radians(90.0) ** 2 * (0.5**2 + 0.25**2)
    stress = max(np.max(np.abs(histories[name]))
                 for name in ("sxx", "syy", "sxy"))
    return {
        "mechanical energy": float(np.ptp(mechanical) / np.max(kinetic)),
        "energy residual": residual_of(table),
        "stress / (rho w^2 r^2)": float(stress / centrifugal),
    }


def energy_drift(case, folder, output, histories):
    """Residual of the balance and drift of the total energy."""
    table = energies(output)
    peak = peak_energy(table)
    free = table["time"] > 2.1e-3
    total = table["kinetic"] + table["strain"] + table["joint"]
    window = max(int(np.sum(free)) // 10, 1)
    first, last = total[free][:window].mean(), total[free][-window:].mean()
    steps = case["steps"]
    with open(os.path.join(output, "summary.json")) as stream:
        done = json.load(stream).get("steps", 0)
    print("  steps %d" % done)
    return {
        "energy residual": residual_of(table),
        "drift of the total": float(abs(last - first) / peak),
        "steps missing": float(max(steps - done, 0)) / steps,
    }


def lumped_masses(grid, density):
    """Masses of the nodes of tetrahedra."""
    return density / 4 * np.bincount(grid.cells.ravel(),
                                     np.repeat(volumes(grid), 4))


def momentum(grid, mass):
    """Linear and angular momentum about the origin of moving nodes."""
    velocity = grid.point_data["velocity"]
    place = grid.points + grid.point_data["displacement"]
    return mass @ velocity, mass @ np.cross(place, velocity)


def space_energy_drift(case, folder, output, histories):
    """energy_drift(), and how far the momentum at the times of the fields is from
    the first, relative to the angular one."""
    path = os.path.join(output, "blocks.pvd")
    grids = [vtu.read_at(path, time) for time, _ in vtu.read_pvd(path)]
    mass = lumped_masses(grids[0], case["density"])
    found = np.array([momentum(grid, mass) for grid in grids])
    if len(found) < 3:
        raise Failure("only %d outputs of fields" % len(found))
    return {"momentum": float(np.max(np.abs(found - found[0]))
                              / np.linalg.norm(found[0, 1])),
            **energy_drift(case, folder, output, histories)}


def space_turnover(case, folder, output, histories):
    """Corners and turn-overs of a block, by Euler's equations with the inertia of
    its lumped masses; its momentum at the end; its energy."""
    exact = reference_module(folder)
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    mass = lumped_masses(grid, exact.DENSITY)
    inertia = exact.of_masses(grid.points, mass)
    t = strictly_increasing(histories)["time"]
    turned = exact.rotations(inertia, t)
    places, error = [], 0.0
    for name, corner in zip(("corner", "other"), exact.CORNERS):
        u = np.transpose([strictly_increasing(histories)[name + "_" + axis]
                          for axis in "xyz"])
        places.append(corner + u)
        error = max(error, np.max(np.abs(places[-1] - turned @ corner)))
    found = exact.turnovers(np.mean(places, axis=0), inertia, t)
    wanted = exact.turnovers(turned[:, :, 1], inertia, t)
    print("  turns over at", found, "formula", wanted)
    if len(found) != len(wanted):
        raise Failure("%d turn-overs, not %d" % (len(found), len(wanted)))
    linear, angular = momentum(grid, mass)
    spin = np.linalg.norm(inertia @ exact.SPIN)
    return {"corners / size": float(error / exact.SIDES[0]),
            "turn-overs": float(np.max(np.abs(found / wanted - 1))),
            "momentum": float(max(
                np.linalg.norm(linear) / spin,
                np.linalg.norm(angular - inertia @ exact.SPIN) / spin)),
            **energy_drift(case, folder, output, histories)}


def at_rest(case, folder, output, histories):
    """Displacement of the top by what gravity alone would make of it, and the
    reaction, which must be the weight 2500 x 9.81 x 4 N throughout."""
    settlement = 2500 * 9.81 * 4**2 / (2 * 10e9 * 0.7 / (1.3 * 0.4))
    weight = 2500 * 9.81 * 4
    return {
        "displacement / settlement": float(
            np.max(np.abs(histories["top"])) / settlement),
        "reaction - weight": float(
            np.max(np.abs(histories["reaction"] / weight - 1)))}


def frame(histories, slope, x="corner_x", y="corner_y"):
    """Displacement down a plane that falls to the right, and off it."""
    c, s = np.cos(np.radians(slope)), np.sin(np.radians(slope))
    return (c * histories[x] - s * histories[y],
            s * histories[x] + c * histories[y])


def incline_slides(case, folder, output, histories):
    """The acceleration down the plane by a parabola through the displacement
    from well after the start on, and that it stays a parabola."""
    slope, gravity = 40.0, 10.0
    angle, friction = np.radians(slope), np.radians(case["friction"])
    wanted = gravity * (np.sin(angle) - np.cos(angle) * np.tan(friction))
    along, above = frame(histories, slope)
    t = histories["time"] - case["from"]
    if t[-1] < 1:
        raise Failure("the run ended before the block slid")
    t, along, above = t[t >= 0], along[t >= 0], above[t >= 0]
    found = np.polyfit(t, along, 2)
    print("  acceleration %.5f m/s^2, formula %.5f m/s^2"
          % (2 * found[0], wanted))
    rest = along - np.polyval(found, t)
    return {
        "acceleration": float(abs(2 * found[0] / wanted - 1)),
        "deviation from the parabola / path": float(
            np.max(np.abs(rest)) / np.ptp(along)),
        "lift off the plane [m]": float(np.ptp(above)),
        "rotation [deg]": float(np.max(np.abs(histories["rotation"]))),
        "energy residual": residual_of(energies(output)),
    }


def block_impulse(case, folder, output, histories):
    """Momentum of both blocks and spin of one of them change by the impulse of
    the force between them, with a row for each step; the energy residual."""
    t = histories["time"]
    errors = energy_residual(case, folder, output, histories)
    for what, column, inertia, force in (
            ("momentum of a", "a_v", 2000.0, -histories["on_b"]),
            ("momentum of b", "b_v", 3000.0, histories["on_b"]),
            ("spin of b", "b_spin", np.radians(3000.0 / 6),
             histories["on_b_moment"])):
        impulse = np.concatenate(
            [[0], np.cumsum(np.diff(t) * (force[1:] + force[:-1]) / 2)])
        gained = inertia * (histories[column] - histories[column][0])
        errors[what] = float(np.max(np.abs(gained - impulse))
                             / case["impulse"])
    return errors


def block_stack(case, folder, output, histories):
    """Moments about the centroids where they are: as blocks bear on each other
    where they are deformed, the weight above goes sideways with them."""
    masses, gravity = (1000.0, 1500.0, 800.0), (2.0, -10.0)
    names, heights = ("base", "middle", "top"), (0.25, 0.875, 1.45)
    centroids = [np.array([0.5 + histories[name + "_u"][-1],
                           height + histories[name + "_v"][-1]])
                 for name, height in zip(names, heights)]
    errors = {}
    for block in (0, 1):
        wanted = sum(mass * ((place - centroids[block])[0] * gravity[1]
                             - (place - centroids[block])[1] * gravity[0])
                     for mass, place in zip(masses[block + 1:],
                                            centroids[block + 1:]))
        found = histories[names[block] + "_m"][-1]
        errors["moment on %s where it is" % names[block]] = float(
            abs(found / wanted - 1))
    return errors


def block_sliding(case, folder, output, histories):
    """Friction by normal force while it slides, and that the joints became
    contacts on the way."""
    normal, tangential = histories["force_y"], histories["force_x"]
    if histories["contacts"][1] > 0 or not histories["contacts"][-1] > 0:
        raise Failure("the joints did not become contacts")
    slides = normal > 0.01 * normal.max()
    return {
        "friction / normal force": float(np.max(np.abs(
            tangential[slides] / normal[slides] + np.tan(np.radians(30.0))))),
        "energy residual": residual_of(energies(output)),
    }


def incline_stands(case, folder, output, histories):
    """Checks that the block is at rest, leaning as statics of its two corner
    springs have it."""
    slope, gravity, stiffness = np.radians(40.0), 10.0, case["stiffness"]
    width, height = 10.0, 10.0
    weight = 2000 * gravity * width * height
    lean = np.degrees(4 * weight * np.cos(slope) * height / 2 * np.tan(slope)
                      / (stiffness * width**3))
    along, _ = frame(histories, 40.0)
    t = histories["time"]
    late = t > t[-1] - 0.25 * (t[-1] - 6.0)
    elastic = weight * np.sin(slope) / (stiffness * width)
    print("  rotation %.5f deg, statics %.5f deg; %.3e m down the plane, "
          "elastic %.3e m" % (histories["rotation"][-1], -lean, along[-1],
                              elastic))
    return {
        "rotation": float(abs(histories["rotation"][-1] / -lean - 1)),
        "path down the plane / elastic one": float(along[-1] / elastic),
        "motion in the last quarter / width": float(
            np.ptp(along[late]) / width),
    }


def incline_topples(case, folder, output, histories):
    """The signs of the motion: it turns downhill all the while; its corner
    stays, or slides downhill all the while if 'slides'."""
    along, _ = frame(histories, 40.0)
    moving = histories["time"] > 6.0
    turn, along = histories["rotation"][moving], along[moving]
    table = energies(output)
    result = {
        "rotation back [deg]": float(np.max(np.diff(turn))),
        "20 deg / rotation downhill": float(20 / max(-turn[-1], 1e-9)),
        "energy residual": residual_of(table),
    }
    if case.get("slides"):
        result["0.5 m / path of the corner"] = float(
            0.5 / max(along[-1], 1e-9))
        result["path of the corner uphill [m]"] = float(
            max(0, -np.min(np.diff(along))))
    else:
        result["path of the corner / width"] = float(np.ptp(along) / 10)
    return result


def block_at_rest(case, folder, output, histories):
    """Drift and vibration of the undamped stage relative to the width. If the
    block was set vibrating: how much the envelope has moved, relative to the
    amplitude."""
    along, above = frame(histories, 20.0)
    rest = histories["time"] > 2.1
    along, above = along[rest], above[rest]
    n = len(along) // 10
    with open(os.path.join(output, "summary.json")) as stream:
        done = json.load(stream).get("steps", 0)
    missing = float(max(1e6 - done, 0)) / 1e6
    if not case.get("vibrates"):
        return {
            "drift / width": float(
                abs(along[-n:].mean() - along[:n].mean()) / 10),
            "vibration along / width": float(np.ptp(along) / 10),
            "vibration across / width": float(np.ptp(above) / 10),
            "steps missing": missing}
    amplitude = np.ptp(along[:n]) / 2
    print("  amplitude %.3e m" % amplitude)
    return {
        "shift of the upper envelope / amplitude": float(
            abs(along[-n:].max() - along[:n].max()) / amplitude),
        "shift of the lower envelope / amplitude": float(
            abs(along[-n:].min() - along[:n].min()) / amplitude),
        "1e-7 m / amplitude": float(1e-7 / amplitude),
        "energy residual": residual_of(energies(output)),
        "steps missing": missing}


def quarter(folder, ratio):
    """Row of quarters.csv: tilt ratio, tilt [deg], exact, Housner [s]."""
    table = np.loadtxt(os.path.join(folder, "quarters.csv"), delimiter=",",
                       skiprows=1)
    return table[np.argmin(np.abs(table[:, 0] - ratio))]


def first_crossing(t, values, level):
    above = np.nonzero(values >= level)[0]
    if len(above) == 0 or above[0] == 0:
        raise Failure("the block did not stand up again")
    i = above[0]
    return float(t[i - 1] + (t[i] - t[i - 1]) * (level - values[i - 1])
                 / (values[i] - values[i - 1]))


def rocking(case, folder, output, histories):
    """Time from the release to the first impact, where the tilt vanishes."""
    _, tilt, exact, housner = quarter(folder, case["ratio"])
    found = first_crossing(histories["time"], histories["rotation"], tilt)
    print("  quarter %.6f s, exact %.6f s; period %.4f s, Housner %.4f s"
          % (found, exact, 4 * found, 4 * housner))
    return {
        "quarter, exact": abs(found / exact - 1),
        "period, Housner": abs(found / housner - 1),
        "energy residual": residual_of(energies(output)),
    }


def rocking_decay(case, folder, output, histories):
    """Energy after by energy before an impact, from the largest tilts."""
    _, tilt, _, _ = quarter(folder, case["ratio"])
    slenderness = np.arctan(0.25)
    theta = np.radians(histories["rotation"] - tilt)
    # largest tilt of each half cycle; the chatter at an impact is none
    peaks, side = [], 0
    for value in theta:
        if abs(value) < 0.02 * slenderness:
            continue
        if np.sign(value) != side:
            side = np.sign(value)
            peaks.append(0.0)
        peaks[-1] = max(peaks[-1], abs(value))
    energy = np.cos(slenderness - np.array(peaks[:5])) - np.cos(slenderness)
    if len(energy) < 5:
        raise Failure("only %d half cycles" % len(energy))
    ratios = energy[1:] / energy[:-1]
    wanted = (1 - 1.5 * np.sin(slenderness)**2)**2
    print("  energy ratios %s, rigid theory %.4f"
          % (", ".join("%.4f" % r for r in ratios), wanted))
    return {
        "energy ratio": float(np.max(np.abs(ratios / wanted - 1))),
        "energy residual": residual_of(energies(output)),
    }


def bounce(case, folder, output, histories):
    """Energy relative to that of the drop, and at least ten bounces."""
    drop = 2000.0 * 10 * 0.1
    table = energies(output)
    y = histories["y"] + 0.1
    bounces = int(np.sum((y[1:] < 0) & (y[:-1] >= 0)))
    total = (table["kinetic"] + table["strain"] + table["joint"]
             - table["external"])
    flying = y > 0.01
    print("  %d bounces" % bounces)
    return {
        "energy residual / drop": float(
            np.max(np.abs(table["residual"])) / drop),
        "range of the total / drop": float(np.ptp(total) / drop),
        "contact account at the end / drop": float(
            abs(table["contact"][-1]) / drop),
        "bounces missing": float(max(0, 10 - bounces)),
        "rotation [deg]": float(np.max(np.abs(histories["rotation"]))),
        "contacts in flight": float(np.max(histories["contacts"][flying])),
    }


def bounce_energy(case, folder, output, histories):
    """The energy residual relative to the drop, and at least ten bounces."""
    result = bounce(case, folder, output, histories)
    return {name: result[name]
            for name in ("energy residual / drop", "bounces missing")}


def impacts(case, folder, output, histories):
    """Velocities after impacts at 1 m/s, the largest error of each kind."""
    histories = strictly_increasing(histories)
    after = histories["time"] > 0.06
    kinds = {"soft": "deformable", "slid": "oblique", "stic": "oblique",
             "wall_soft": "deformable"}
    errors = {"energy residual": residual_of(energies(output))}
    for column, wanted in reference_module(folder).rows():
        found = np.polyfit(histories["time"][after],
                           histories[column][after], 1)[0]
        kind = next((kinds[start] for start in kinds
                     if column.startswith(start)), "rigid")
        print("  %-16s %8.4f %8.4f" % (column, found, wanted))
        errors[kind] = max(errors.get(kind, 0.0), float(abs(found - wanted)))
    return errors


def newmark(case, folder, output, histories):
    """Slip of the block on the base against the exact history."""
    reference, _ = read_table(os.path.join(folder, case["slip"]))
    histories = strictly_increasing(histories)
    shaken = histories["time"] >= 1.0
    t = histories["time"][shaken]
    relative = {
        "x": (histories["block_x"] - histories["base_x"])[shaken],
        "y": histories["block_y"][shaken]}
    along, above = frame(relative, case["slope"], "x", "y")
    found = np.interp(reference["time"], t, along - along[0])
    peak = np.max(np.abs(reference["slip"]))
    base = np.interp(reference["time"], t, histories["base_x"][shaken])
    return {
        "slip": float(np.max(np.abs(found - reference["slip"])) / peak),
        "motion of the base": float(
            np.max(np.abs(base - reference["base_x"]))
            / np.max(np.abs(reference["base_x"]))),
        "lift off the base / height": float(np.ptp(above)),
        "energy residual": residual_of(energies(output)),
    }


def corner_passage(case, folder, output, histories):
    """Forces on either block of the table against statics, by the weight."""
    weight, left_weight, right_weight = 2500.0, 20000.0, 10000.0
    friction = np.tan(np.radians(30))
    reference, _ = read_table(os.path.join(folder, case["statics"]))
    histories = strictly_increasing(histories)
    # after the start, until the statics end
    travel = histories["slider_x"]
    keep = ((histories["time"] > 1.2) & (travel <= reference["travel"][-1]))
    travel = travel[keep]
    normal = {"left": histories["left_y"][keep] - left_weight,
              "right": histories["right_y"][keep] - right_weight}
    shear = {"left": -histories["left_x"][keep],
             "right": -histories["right_x"][keep]}
    result = {}
    for side in ("left", "right"):
        wanted = np.interp(travel, reference["travel"], reference[side])
        result["normal force " + side] = float(
            np.max(np.abs(normal[side] - wanted)) / weight)
        result["shear force " + side] = float(
            np.max(np.abs(shear[side] - friction * wanted))
            / (friction * weight))
        result["jump of the normal force " + side] = float(
            np.max(np.abs(np.diff(normal[side]))) / weight)
    result["sum of normal forces"] = float(
        np.max(np.abs(normal["left"] + normal["right"] - weight)) / weight)
    result["push"] = float(
        np.max(np.abs(histories["push"][keep] / (friction * weight) - 1)))
    return result


def toppling_modes(case, folder, output, histories):
    """Every column moves as limit equilibrium says: 0 stays, 1 topples,
    2 slides. Told apart by the motion of its upper corner and its rotation,
    relative to those of the column that moves or turns most, when the first
    corner has moved as far as "judged at" [m]: limit equilibrium tells how the
    motion begins; once columns knock against each other it is chaotic."""
    modes, _ = read_table(os.path.join(folder, "modes.csv"))
    blocks = modes["block"].astype(int)
    moved = np.array([np.hypot(histories["x%d" % i], histories["y%d" % i])
                      for i in blocks])
    far = np.flatnonzero(np.max(moved, axis=0) >= case["judged at"])
    if not far.size:
        raise Failure("no corner has moved %g m" % case["judged at"])
    moved = moved[:, far[0]]
    turned = np.abs([histories["rotation%d" % i][far[0]] for i in blocks])
    moves = moved > 0.05 * np.max(moved)
    topples = turned > 0.2 * np.max(turned)
    found = np.where(~moves, 0, np.where(topples, 1, 2))
    for i, wanted, mode in zip(blocks, modes["mode"].astype(int), found):
        if mode != wanted:
            print("  column %d: %s, expected %s: moved %.3g m, turned %.3g deg"
                  % (i, *(("stays", "topples", "slides")[m]
                          for m in (mode, wanted)),
                     moved[blocks == i][0], turned[blocks == i][0]))
    return {"columns in another mode": float(
        np.count_nonzero(found != modes["mode"]))}


def block_outlines(grid, position):
    """{block: (n, 2, 2) edges of its outline}, from the edges that belong to
    one triangle only."""
    cells = grid.cells
    edges = np.concatenate([cells[:, [0, 1]], cells[:, [1, 2]],
                            cells[:, [2, 0]]])
    owner = np.tile(grid.cell_data["block"], 3)
    _, first, count = np.unique(np.sort(edges), axis=0, return_index=True,
                                return_counts=True)
    outer = first[count == 1]
    return {block: position[edges[outer[owner[outer] == block]]]
            for block in np.unique(owner)}


def depths_in(points, edges):
    """Depths of points in a polygon: the distance to its nearest edge; 0
    outside."""
    a, b = edges[:, 0], edges[:, 1]
    x, y = points[:, None, 0], points[:, None, 1]
    crosses = (a[:, 1] > y) != (b[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (y - a[:, 1]) * (b - a)[:, 0] / (b - a)[:, 1]
    inside = np.count_nonzero(crosses & (x < at), axis=1) % 2 == 1
    if not inside.any():
        return np.zeros(len(points))
    along = b - a
    share = np.einsum("pek,ek->pe", points[:, None] - a, along)
    share = np.clip(share / np.sum(along**2, axis=1), 0, 1)
    foot = a + share[..., None] * along
    distance = np.linalg.norm(points[:, None] - foot, axis=2).min(axis=1)
    return np.where(inside, distance, 0.0)


def deepest_overlap(outlines):
    """The deepest overlap of any two blocks and their numbers. Points on the
    edges are looked for as well, for edges that cross without a corner
    inside."""
    share = np.linspace(0, 1, 10, endpoint=False)[:, None, None]
    points = {k: (e[:, 0] + share * (e[:, 1] - e[:, 0])).reshape(-1, 2)
              for k, e in outlines.items()}
    low = {k: p.min(axis=0) for k, p in points.items()}
    high = {k: p.max(axis=0) for k, p in points.items()}
    deepest = (0.0, None, None)
    blocks = sorted(outlines)
    lows, highs = (np.array([d[k] for k in blocks]) for d in (low, high))
    for a in blocks:
        near = np.all((lows < high[a]) & (highs > low[a]), axis=1)
        for b in np.array(blocks)[near]:
            if b == a:
                continue
            p = points[a]
            p = p[np.all((p > low[b]) & (p < high[b]), axis=1)]
            if len(p) > 0:
                depth = depths_in(p, outlines[b]).max()
                deepest = max(deepest, (float(depth), int(a), int(b)),
                              key=lambda record: record[0])
    return deepest


def pile(case, folder, output, histories):
    """Blocks at rest in a box: static ratio, penetration against the elastic
    one, nothing outside of the box, reaction equal to the weight."""
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    position = grid.points + grid.point_data["displacement"][:, :2]
    if not np.all(np.isfinite(position)):
        raise Failure("displacements are not finite")
    outlines = block_outlines(grid, position)
    reference = block_outlines(grid, grid.points)

    # the box: the blocks that have not moved
    u = np.linalg.norm(grid.point_data["displacement"][:, :2], axis=1)
    moved = {block: u[grid.cells[grid.cell_data["block"] == block]].max()
             for block in outlines}
    loose = [block for block in outlines if moved[block] > 1e-9]
    if len(outlines) - len(loose) != 3:
        raise Failure("%d blocks have not moved, expected the three of the "
                      "box" % (len(outlines) - len(loose)))

    nodes = np.concatenate([outlines[b].reshape(-1, 2) for b in loose])
    shortest = min(np.linalg.norm(reference[b][:, 1] - reference[b][:, 0],
                                  axis=1).min() for b in loose)
    largest = max(np.linalg.norm(np.ptp(reference[b].reshape(-1, 2), axis=0))
                  for b in loose)
    gravity = 9.81
    column = case["density"] * gravity * nodes[:, 1].max() * largest
    bound = column / (case["normal stiffness"] * shortest / 2)
    depth, a, b = deepest_overlap(outlines)
    outside = max(np.abs(nodes[:, 0]).max() - case["half width"],
                  -nodes[:, 1].min(), 0.0)

    p = grid.points[grid.cells]
    side, other = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    area = np.abs(side[:, 0] * other[:, 1] - side[:, 1] * other[:, 0]) / 2
    weight = case["density"] * gravity * area.sum()
    with open(os.path.join(output, "summary.json")) as stream:
        summary = json.load(stream)
    table = energies(output)
    print("  pile %.2f m high, deepest overlap %.2e m of blocks %s and %s, "
          "bound %.2e m, %s contacts"
          % (nodes[:, 1].max(), depth, a, b, bound,
             summary.get("contacts", "?")))
    return {
        "unbalanced ratio": float(summary["unbalanced ratio"]),
        "deepest overlap / elastic": float(depth / bound),
        "out of the box / elastic": float(outside / bound),
        "reaction - weight": float(
            abs(histories["reaction"][-1] / weight - 1)),
        "energy residual": residual_of(table),
    }


def amplitude(t, values, omega, periods=1):
    """Amplitude of a harmonic part, fitted over the last periods together with
    a straight line, which represents the slowly decaying initial transient.
    """
    keep = t > t[-1] - periods * 2 * np.pi / omega
    t = t[keep] - t[-1]
    basis = np.column_stack([np.cos(omega * t), np.sin(omega * t),
                             np.ones_like(t), t])
    fit = np.linalg.lstsq(basis, values[keep], rcond=None)[0]
    return float(np.hypot(fit[0], fit[1]))


def finite_bar_bem(case, folder, output, histories):
    """The whole run against d'Alembert: error and bounds of the last period."""
    require_time_shares(output, case.get("phases", ["matrices"]))
    bar = reference_module(folder)
    histories = strictly_increasing(histories)
    t = histories["time"]
    dt = t[1] - t[0]
    period, peak = 4 * bar.L / bar.C, 2 * bar.LOAD * bar.L / bar.E
    last = t > t[-1] - period
    error = (histories["end"] - bar.displacement(bar.L, t)) / peak
    # forces are means over the steps
    force = histories["base_force"] / (2 * bar.LOAD * bar.HEIGHT)
    exact = bar.base_force(t - dt / 2) / (2 * bar.LOAD * bar.HEIGHT)
    for p in (1, 2, 5, 10, 20):
        part = (t > (p - 1) * period) & (t <= p * period)
        if np.any(part):
            print("  period %2d: displacement max %.4f rms %.4f; base force rms "
                  "%.4f; across %.1e"
                  % (p, np.max(np.abs(error[part])),
                     np.sqrt(np.mean(error[part]**2)),
                     np.sqrt(np.mean((force - exact)[part]**2)),
                     np.max(np.abs(histories["end_across"][part])) / peak))
    first = (t > 0) & (t <= period)
    return {
        "rms error, last period": float(np.sqrt(np.mean(error[last]**2))),
        "rms error of the force, first period": float(
            np.sqrt(np.mean((force - exact)[first]**2))),
        "peak by the exact one, last period": float(
            abs(np.max(histories["end"][last]) / peak - 1)),
        "motion across / peak": float(
            np.max(np.abs(histories["end_across"])) / peak),
    }


def cavity_harmonic(case, folder, output, histories):
    """Amplitudes on the wall against the series.

    Of blocks the hoop stress is that of the wall's strain between two nodes,
    one to each side."""
    histories = strictly_increasing(histories)
    t = histories["time"]
    half = np.pi / 48
    for angle in (0, 90, 180):
        if "hoop_%d_after" % angle in histories:
            strain = (histories["hoop_%d_after" % angle]
                      - histories["hoop_%d_before" % angle]) / (2 * np.sin(half))
            # E/(1 - nu^2), no pressure on the wall
            histories["hoop_%d" % angle] = (1.6666666667e9 / (1 - 0.25**2)
                                            * strain)
    ratio, speed, incident = case["ratio"], 1000.0, 1e-3
    omega = ratio * speed
    table, _ = read_table(os.path.join(folder, "wall_%g.csv" % ratio))

    def exact(name, angle):
        return table[name][np.argmin(np.abs(table["angle"] - angle))]

    stress = 2000.0 * speed * omega * incident
    result = {}
    for angle in (0, 90, 180):
        found = amplitude(t, histories["hoop_%d" % angle], omega) / stress
        wanted = exact("hoop stress", angle)
        print("  hoop stress at %3d deg: %.4f, series %.4f"
              % (angle, found, wanted))
        result["hoop stress at %d" % angle] = abs(
            found - wanted) / exact("hoop stress", 90)
    for name, angle, part in (("front", 180, "radial"), ("back", 0, "radial"),
                              ("side", 90, "tangential")):
        found = amplitude(t, histories[name], omega) / incident
        wanted = exact(part, angle)
        print("  displacement, %-5s: %.4f, series %.4f" % (name, found, wanted))
        result["displacement, " + name] = abs(found / wanted - 1)
    return result


def rigid_strip(case, folder, output, histories):
    """Force by displacement at some frequencies, against the impedance."""
    strip = reference_module(folder)
    histories = strictly_increasing(histories)
    t = histories["time"][1:]
    dt = t[1] - t[0]
    quantity = case["quantity"]
    force = (histories[quantity + "_right"]
             + histories[quantity + "_left"])[1:]
    motion = strip.pulse(t)
    table, _ = read_table(os.path.join(folder, "impedance.csv"))
    worst = 0.0
    for i, a0 in enumerate(table["a0"]):
        omega = a0 * strip.SPEED / strip.HALF_WIDTH
        # forces are means over the steps
        mean = np.sinc(omega * dt / 2 / np.pi)
        found = (np.sum(force * np.exp(-1j * omega * (t - dt / 2))) / mean
                 / np.sum(motion * np.exp(-1j * omega * t)))
        found /= strip.SHEAR_MODULUS
        wanted = (table[case["motion"] + " real"][i]
                  + 1j * table[case["motion"] + " imaginary"][i])
        print("  a0 %.1f: %.4f%+.4fi, exact %.4f%+.4fi"
              % (a0, found.real, found.imag, wanted.real, wanted.imag))
        worst = max(worst, abs(found / wanted - 1))
    return {"impedance": float(worst)}


def canyon(case, folder, output, histories):
    """Amplitudes on the surface by that of the incident wave."""
    histories = strictly_increasing(histories)
    table, _ = read_table(os.path.join(folder, case["amplitudes"]))
    result = {}
    worst = {"x": [0.0, 0.0], "y": [0.0, 0.0]}
    for place in sorted({float(n[2:]) for n in histories if n[0] in "xy"}):
        row = np.argmin(np.abs(table["x/a"] - place))
        rim = abs(abs(place) - 1) < 0.1
        for component in "xy":
            found = amplitude(histories["time"],
                              histories["%s_%g" % (component, place)],
                              1000 * np.pi) / 1e-3
            error = found - table["|u_%s|" % component][row]
            print("  x/a %5.2f |u_%s| %.3f, table %.3f"
                  % (place, component, found, found - error))
            worst[component][rim] = max(worst[component][rim], abs(error))
    for component, (away, rim) in worst.items():
        result["|u_%s|" % component] = away
        result["|u_%s| at the rim" % component] = rim
    return result


def at_rest_after_switch(case, folder, output, histories):
    """Velocities of the second stage by that which the in-situ stress would
    cause at a free surface, 10 MPa / (rho c1), and the motion of the wall by
    that of the first stage."""
    rest = histories["time"] > histories["time"][-1] - 0.0159
    fastest = max(np.max(np.abs(histories[name][rest]))
                  for name in histories if name.endswith(("_x", "_y")))
    wall = histories["wall_u"]
    return {"velocity by stress / (rho c1)": float(
        fastest / (10e6 / (2500 * 3000))),
            "motion of the wall by what it was": float(
                np.ptp(wall[rest]) / np.max(np.abs(wall))),
            "energy residual": residual_of(energies(output))}


def rest_then_pulse(case, folder, output, histories):
    """Settlement in the first stage by the formula's; in the second one
    velocities before the pulse begins and the motion of the surface, by the
    velocity of the surface and the settlement; and velocities under the pulse
    along the "axes" by their peaks."""
    exact = reference_module(folder)
    with open(os.path.join(output, "summary.json")) as stream:
        begin = json.load(stream)["stages"]["settle"]["time [s]"]
    last = histories["time"] <= begin * (1 + 1e-9)
    settlement = -histories["top"][last][-1]
    later = histories["time"] > begin * (1 + 1e-9)
    t = histories["time"][later] - begin
    rest = t < exact.BEGINS
    fastest, errors = 0.0, {"settlement": float(
        abs(settlement / exact.SETTLEMENT - 1))}
    for name, values in histories.items():
        place, _, axis = name.partition("_")
        if not axis:
            continue
        fastest = max(fastest, np.max(np.abs(values[later][rest])))
        if axis in case["axes"]:
            wanted = exact.velocity(axis, case["heights"].get(place, 0), t)
            errors[name] = float(np.max(np.abs(values[later] - wanted))
                                 / np.max(np.abs(wanted)))
    return {**errors,
            "velocity at rest / peak": float(fastest / (2 * 0.01)),
            "motion at rest / settlement": float(
                np.ptp(histories["top"][later][rest]) / settlement),
            "energy residual": residual_of(energies(output))}


def kirsch(case, folder, output, histories):
    """Displacements all along the wall relative to the largest one, and the
    hoop stress from the strain of the wall's edges, whose radial stress is
    gone, relative to the largest one."""
    sxx, syy = case.get("stress", [-10e6, -5e6])
    young, nu = 10e9, 0.25
    mean, half = (sxx + syy) / 2, (sxx - syy) / 2
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    x, u = grid.points, grid.point_data["displacement"][:, :2]
    angle = np.arctan2(x[:, 1], x[:, 0])
    wall = np.nonzero(np.hypot(x[:, 0], x[:, 1]) < 1 + 1e-6)[0]
    wall = wall[np.argsort(angle[wall])]
    x, u, angle = x[wall], u[wall], angle[wall]
    factor = (1 + nu) / young
    radial = factor * (mean + half * np.cos(2 * angle) * (3 - 4 * nu))
    along = -factor * half * np.sin(2 * angle) * (3 - 4 * nu)
    c, s = np.cos(angle), np.sin(angle)
    exact = np.stack([radial * c - along * s, radial * s + along * c], 1)
    # nothing holds a translation
    u = u - np.mean(u - exact, axis=0)
    error = np.max(np.abs(u - exact)) / np.max(np.abs(exact))

    edge = np.roll(x, -1, axis=0) - x
    stretch = (np.sum((np.roll(u, -1, axis=0) - u) * edge, axis=1)
               / np.sum(edge**2, axis=1))
    middle = np.arctan2(*(x + 0.5 * edge).T[::-1])
    before = mean + half * np.cos(2 * middle)  # radial, in situ
    hoop = (mean - half * np.cos(2 * middle) - nu / (1 - nu) * before
            + young / (1 - nu**2) * stretch)
    wanted = 2 * mean - 4 * half * np.cos(2 * middle)
    print("  hoop stress at the crown %.3f MPa, formula %.3f MPa"
          % (hoop[np.argmax(middle > np.pi / 2)] / 1e6,
             wanted[np.argmax(middle > np.pi / 2)] / 1e6))
    return {
        "displacement of the wall": float(error),
        "hoop stress": float(
            np.max(np.abs(hoop - wanted)) / np.max(np.abs(wanted))),
        "energy residual": residual_of(energies(output))}


def cavity_blocks(case, folder, output, histories):
    """The hoop stress in the quadrangle at the wall, the mean of its two
    triangles, once the front has passed some rows of them."""
    reference, _ = read_table(os.path.join(folder, case["reference"]))
    late = reference["time"] > 1e-4
    mean = np.interp(reference["time"], histories["time"],
                     0.5 * (histories["hoop_inner"]
                            + histories["hoop_outer"]))
    error = np.abs(mean - reference["hoop"]) / np.max(reference["hoop"])
    return {"hoop stress": float(np.max(error[late]))}


def snap_back(case, folder, output, histories):
    """Every row on the branch that the displacement asks for, and the energy
    that the jump between both lets go."""
    exact = reference_module(folder)
    u = histories["displacement"]
    away = np.abs(u - exact.PEAK) > 1e-3 * exact.PEAK
    table = energies(output)
    lost = table["damping"][-1]
    print("  lost in the jump %.2f J, formula %.2f" % (lost, exact.lost()))
    return {
        "normal, all rows": float(
            np.max(np.abs(histories["normal"] - exact.traction(u))[away])
            / exact.FT),
        "opening, all rows": float(
            np.max(np.abs(histories["opening"] - exact.opening(u))[away])
            / np.max(u)),
        "energy lost in the jump": float(abs(lost / exact.lost() - 1)),
        "energy residual": residual_of(table),
    }


def snap_back_path(case, folder, output, histories):
    """Every row, on the way back too, on the curve that the joint and the
    spring have in common; the path turns back, and nothing is lost."""
    exact = reference_module(folder)
    u, opening = histories["displacement"], histories["opening"]
    normal = histories["normal"]
    crack = opening - normal / exact.KN
    flows = crack > 1e-12
    law = exact.FT * np.exp(-exact.FT * crack / exact.GI)
    clock = histories["clock"]
    table = energies(output)
    print("  goes back by %.0f %%, %d rows on the softening branch"
          % (100 * np.max(np.maximum.accumulate(clock) - clock), flows.sum()))
    return {
        "normal, all rows": float(
            np.max(np.abs(normal - law)[flows]) / exact.FT),
        "opening, all rows": float(
            np.max(np.abs(u - normal / exact.KE - opening)) / np.max(u)),
        "does not go back": float(
            np.max(np.maximum.accumulate(clock) - clock) < 0.2),
        "few rows on the branch": float(flows.sum() < 15),
        "damping": float(
            abs(table["damping"][-1]) / np.max(table["external"])),
        "energy residual": residual_of(table),
    }


def salencon(case, folder, output, histories):
    """Displacements relative to the largest one, those of the wall and at the
    edge of the plastic zone relative to themselves; its radius by the area of
    the cells that have yielded; stresses of all cells relative to the pressure.
    "factor": that of all stresses, and so of displacements, for the small
    strains of the closed form. "thickness": that of a slice in space."""
    exact = reference_module(folder)
    reference = np.genfromtxt(os.path.join(folder, case["profile"]),
                              delimiter=",", skip_header=1)
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    factor = case.get("factor", 1.0)
    x, u = grid.points[:, :2], grid.point_data["displacement"][:, :2] / factor
    r = np.hypot(x[:, 0], x[:, 1])
    radial = np.sum(x * u, axis=1) / r
    wanted = np.interp(r, reference[:, 0], reference[:, 1])
    wall = r < 1 + 1e-6
    edge = exact.plastic_radius()
    near = np.abs(r - edge) < 0.15
    ratio_wall = np.mean(radial[wall] / wanted[wall])
    ratio_edge = np.mean(radial[near] / wanted[near])

    centre = x[grid.cells].mean(axis=1)
    rc = np.hypot(centre[:, 0], centre[:, 1])
    n = centre / rc[:, None]
    s = grid.cell_data["stress"] / factor
    shear = s[:, 3 if "thickness" in case else 2]
    along = (s[:, 0] * n[:, 0]**2 + s[:, 1] * n[:, 1]**2
             + 2 * shear * n[:, 0] * n[:, 1])
    around = s[:, 0] + s[:, 1] - along
    errors = np.array([along, around]) - exact.stresses(rc)
    if "thickness" in case:
        area = volumes(grid) / case["thickness"]
    else:
        a, b, c = np.moveaxis(x[grid.cells], 1, 0)
        area = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1]
                            - (b - a)[:, 1] * (c - a)[:, 0])
    yielded = np.sum(area[grid.cell_data["yielding"] > 0])
    yielded = np.sqrt(1 + yielded / (case.get("quarters", 1) * np.pi / 4))
    print("  wall %.3f mm, plastic radius %.3f m"
          % (1e3 * np.mean(radial[wall]), yielded))
    return {
        "displacement of the wall": float(abs(ratio_wall - 1)),
        "displacement at R0": float(abs(ratio_edge - 1)),
        "displacement of a node / largest": float(
            np.max(np.abs(radial - wanted)) / np.max(np.abs(wanted))),
        "plastic radius": float(abs(yielded / edge - 1)),
        "stress / pressure, mean": float(
            np.mean(np.abs(errors)) / exact.PRESSURE),
        "energy residual": residual_of(energies(output)),
    }


def prandtl(case, folder, output, histories):
    """Pressure over cohesion in the last fifth of the settlement, the force
    of the edge node spread over half an edge more if 'edge' gives one, on a
    slice of the case's 'thickness'."""
    wanted = reference_module(folder).factors(0)[0]
    area = (2.0 + 0.5 * case.get("edge", 0.0)) * case.get("thickness", 1.0)
    settled = histories["settlement"] / histories["settlement"][-1]
    pressure = -histories["force"][settled > 0.8] / area / 1e3
    print("  pressure over cohesion %.4f to %.4f, formula %.4f"
          % (np.min(pressure), np.max(pressure), wanted))
    return {
        "pressure": float(np.max(np.abs(pressure / wanted - 1))),
        "range of the pressure": float(np.ptp(pressure) / wanted),
        "energy residual": residual_of(energies(output)),
    }


def stage_ends(case, folder, output, histories):
    """The last row of each stage, as the fields at their ends tell, relative to
    the largest value of the column in "ends"."""
    reference, _ = read_table(os.path.join(folder, case["ends"]))
    times = [time for time, _ in vtu.read_pvd(os.path.join(output,
                                                           "blocks.pvd"))]
    if len(times) != len(reference["stage"]):
        raise Failure("%d stages have ended, the reference has %d"
                      % (len(times), len(reference["stage"])))
    # At the end of a stage the explicit solver's last row is a step old, and
    # the next stage's first may have the time of the end. The implicit one's
    # is the first of its time: it lets go at that time what is out of balance
    # in the next stage.
    at = histories["time"]
    if os.path.exists(os.path.join(output, "convergence.csv")):
        rows = [np.searchsorted(at, at[at <= time * (1 + 1e-9)][-1])
                for time in times]
    else:
        rows = [np.searchsorted(at, time * (1 - 1e-9)) - 1 for time in times]
    errors = {"energy residual": residual_of(energies(output))}
    for name, exact in reference.items():
        if name != "stage":
            scale = np.max(np.abs(exact))
            errors[name] = float(
                np.max(np.abs(histories[name][rows] - exact)) / scale)
    return errors


def excavated_hole(case, folder, output, histories):
    """Displacements all along the wall, and of all nodes, at the end of each stage,
    relative to the largest; the core is gone from the fields."""
    exact = reference_module(folder)
    path = os.path.join(output, "blocks.pvd")
    stress = case.get("stress", [exact.SXX, exact.SYY])
    errors = {}
    for (time, _), share in zip(vtu.read_pvd(path),
                                case.get("shares", (0.5, 1.0))):
        grid = vtu.read_at(path, time)
        x, u = grid.points, grid.point_data["displacement"][:, :2]
        radius = np.hypot(x[:, 0], x[:, 1])
        wall = np.abs(radius - 1) < 1e-6
        angle = np.arctan2(x[:, 1], x[:, 0])
        radial, along = exact.elastic(share, angle, *stress, r=radius)
        c, s = np.cos(angle), np.sin(angle)
        wanted = np.stack([radial * c - along * s, radial * s + along * c], 1)
        error = u - wanted
        error -= np.mean(error[wall], axis=0)  # nothing holds a translation
        largest = np.max(np.abs(wanted))
        errors["wall, share %g" % share] = float(
            np.max(np.abs(error[wall])) / largest)
        errors["all nodes, share %g" % share] = float(
            np.max(np.abs(error)) / largest)
        # Nodes in the middle of edges may lie on chords of the wall.
        errors["core left, share %g" % share] = float(np.sum(radius < 0.99))
    errors["energy residual"] = residual_of(energies(output))
    return errors


def excavated_hole_yielding(case, folder, output, histories):
    """Mean displacement of the wall and the plastic radius, by the area that has
    yielded, at the end of each stage; displacements of all nodes. "factor" as in
    salencon()."""
    exact = reference_module(folder)
    path = os.path.join(output, "blocks.pvd")
    errors = {}
    for (time, _), share in zip(vtu.read_pvd(path), (0.8, 1.0)):
        grid = vtu.read_at(path, time)
        x, u = grid.points, grid.point_data["displacement"][:, :2]
        u = u / case.get("factor", 1.0)
        u = u - np.mean(u[np.hypot(x[:, 0], x[:, 1]) < 1 + 1e-6], axis=0)
        r = np.hypot(x[:, 0], x[:, 1])
        radial = np.sum(x[:, :2] * u, axis=1) / r
        wanted = exact.yielding(share, r)
        wall = r < 1 + 1e-6
        a, b, c = np.moveaxis(x[grid.cells][..., :2], 1, 0)
        area = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1]
                            - (b - a)[:, 1] * (c - a)[:, 0])
        yielded = np.sqrt(1 + np.sum(area[grid.cell_data["yielding"] > 0])
                          / np.pi)
        outer = exact.plastic_radius(share)
        print("  share %g: wall %.3f mm, formula %.3f; plastic radius %.3f m, "
              "formula %.3f" % (share, 1e3 * np.mean(radial[wall]),
                                1e3 * wanted[wall][0], yielded, outer))
        errors["wall, share %g" % share] = float(
            abs(np.mean(radial[wall]) / wanted[wall][0] - 1))
        errors["plastic radius, share %g" % share] = float(
            abs(yielded / outer - 1))
        errors["a node / largest, share %g" % share] = float(
            np.max(np.abs(radial - wanted)) / np.max(np.abs(wanted)))
    errors["energy residual"] = residual_of(energies(output))
    return errors


def volumes(grid):
    """Volumes of tetrahedra in the mesh."""
    a, b, c, d = np.moveaxis(grid.points[grid.cells], 1, 0)
    return np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)) / 6


def space_cube(case, folder, output, histories):
    """The frequency of a cube's vibration relative to the formula's, that with
    which the difference of kinetic and strain energy beats best fitted; and by
    how much the order in which it converges, from a mesh of edges twice as
    long, falls short of 2. And the residual of the energy balance."""
    exact = reference_module(folder)
    ratios = 1 + np.linspace(-0.02, 0.02, 4001)

    def error(table):
        beat = ((table["strain"] - table["kinetic"])
                / (table["strain"] + table["kinetic"]))
        wanted = np.cos(2 * exact.OMEGA * np.outer(ratios, table["time"]))
        return abs(ratios[np.argmin(np.sum((wanted - beat)**2, axis=1))] - 1)

    coarse = os.path.join(output, "coarse")
    run(case["quoin"], os.path.join(folder, "case.prm"), coarse,
        ["Mesh/File=coarse.geo"])
    fine = error(energies(output))
    order = float(np.log2(error(energies(coarse)) / fine))
    return {"frequency": float(fine), "2 - order": max(0.0, 2 - order),
            **energy_residual(case, folder, output, histories)}


def peak_frequency(t, values, about):
    """Frequency within 12 % of @p about at which the spectrum of a history is
    largest, in Blackman's window, without the straight line of a rigid motion."""
    u = np.blackman(len(t)) * (values - np.polyval(np.polyfit(t, values, 1), t))

    def size(frequency):
        return np.abs(np.exp(-2j * np.pi * np.outer(frequency, t)) @ u)

    wide = about * np.linspace(0.88, 1.12, 241)
    middle = wide[1 + np.argmax(size(wide)[1:-1])]
    near = middle + about * np.linspace(-1e-3, 1e-3, 201)
    return near[np.argmax(size(near))]


def space_modes(case, folder, output, histories):
    """Frequencies of the lowest modes of a parallelepiped, each of the peak in
    the history of its name, relative to those of Ritz; the largest error of what
    they tend to with the square of the size of the elements, from the mesh
    "coarse" with "ratio" times that; by how much the order of the modes that are
    1 % off there falls short of 2. And the energy residual."""
    exact = reference_module(folder)
    wanted, _ = read_table(os.path.join(folder, "frequencies.csv"))

    def errors(table):
        table = strictly_increasing(table)
        return np.array([peak_frequency(table["time"], table[name], f) / f - 1
                         for name, f in zip(exact.HISTORIES,
                                            wanted["frequency"])])

    coarse = os.path.join(output, "coarse")
    run(case["quoin"], os.path.join(folder, "case.prm"), coarse,
        [*case.get("set", []), "Mesh/File=" + case["coarse"]])
    fine = errors(histories)
    coarse = errors(read_table(os.path.join(coarse, "histories.csv"))[0])
    limit = fine + (fine - coarse) / (case["ratio"]**2 - 1)
    far = np.abs(coarse) > 0.01
    order = np.log(np.abs(coarse / fine)[far]) / np.log(case["ratio"])
    return {**dict(zip(exact.HISTORIES, np.abs(fine).tolist())),
            "extrapolated": float(np.max(np.abs(limit))),
            "2 - order": max(0.0, float(2 - np.min(order))),
            **energy_residual(case, folder, output, histories)}


def space_modes_mesh(case, folder, output, histories):
    """Histories of a free block that begins with a velocity, relative to their
    peaks by the modes of its mesh, in which "together" tetrahedra share their
    change of volume; and the energy residual."""
    exact = reference_module(folder)
    mesh = reference_module(folder, "mesh_modes")
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    with open(os.path.join(output, "summary.json")) as stream:
        dt = json.load(stream)["time step [s]"]
    histories = strictly_increasing(histories)
    found = mesh.displacements(
        *mesh.matrices(grid.points, grid.cells, exact.E, exact.NU, exact.RHO,
                       case["together"]),
        exact.velocity(*grid.points.T),
        [mesh.weights(grid.points, grid.cells, place)
         for places in exact.HISTORIES.values() for place in places[1:]],
        np.rint(histories["time"] / dt), dt)
    errors, k = {}, 0
    for name, (axis, *places) in exact.HISTORIES.items():
        wanted = found[:, k, axis]
        if len(places) == 2:
            wanted = found[:, k + 1, axis] - wanted
        k += len(places)
        errors[name] = float(np.max(np.abs(histories[name] - wanted))
                             / np.max(np.abs(wanted)))
    return {**errors, **energy_residual(case, folder, output, histories)}


def space_reflection(case, folder, output, histories):
    """Complex amplitudes of the P, SV and SH waves that a wall reflects, fitted
    to the displacements at the wall and inside: the largest difference from the
    closed form, and that of what they tend to with the square of the size of the
    elements, from a mesh twice as coarse. And the energy residual."""
    exact = reference_module(folder)
    comes, *back = exact.reflection(*case["wave"])

    def amplitudes(table):
        table = strictly_increasing(table)
        wanted, waves = [], []
        for name, place in exact.PLACES.items():
            moved = np.transpose([table[name + "_" + axis] for axis in "xyz"])
            wave, *others = (exact.displacements((1.0, *wave[1:]), place,
                                                 table["time"])
                             for wave in (comes, *back))
            wanted.append(moved / exact.SIZE - wave.real)
            waves.append(np.reshape([(c * wave).real for c in (1, 1j)
                                     for wave in others], (6, -1)))
        found = np.linalg.lstsq(np.hstack(waves).T, np.ravel(wanted),
                                rcond=None)[0]
        return found[:3] + 1j * found[3:]

    coarse = os.path.join(output, "coarse")
    run(case["quoin"], os.path.join(folder, case["prm"]), coarse,
        ["Mesh/File=coarse.geo"])
    coarse = amplitudes(read_table(os.path.join(coarse, "histories.csv"))[0])
    fine = amplitudes(histories)
    wanted = [wave[0] for wave in back]
    return {"amplitudes": float(np.max(np.abs(fine - wanted))),
            "extrapolated": float(np.max(np.abs(
                fine + (fine - coarse) / 3 - wanted))),
            **energy_residual(case, folder, output, histories)}


def polarised_slip(case, folder, output, histories):
    """Slip and velocities across the polarisation of a wave, relative to those
    along it; and the residual of the energy balance."""
    angle = np.radians(case["angle"])
    across = 0.0
    for name in ("slip_%s", "v%s_below", "v%s_above"):
        x, y = (histories[name % axis] for axis in "xy")
        along = np.max(np.abs(np.cos(angle) * x + np.sin(angle) * y))
        across = max(across, float(np.max(np.abs(
            np.cos(angle) * y - np.sin(angle) * x)) / along))
    return {"across": across,
            **energy_residual(case, folder, output, histories)}


def direction_of_slip(case, folder, output, histories):
    """Angle [rad] between the slip of the last two thirds of the run and the
    direction that the reference has in the "state" of the case."""
    t = histories["time"]
    path = np.transpose([histories["slip_" + axis] for axis in "xyz"])
    moved = path[-1] - path[np.searchsorted(t, t[-1] / 3)]
    wanted = reference_module(folder).slip(*case["state"])
    return {"direction of slip": float(np.arctan2(
                np.linalg.norm(np.cross(moved, wanted)), moved @ wanted)),
            **energy_residual(case, folder, output, histories)}


def space_sphere(case, folder, output, histories):
    """Displacements of the wall of a spherical cavity at the end of each stage,
    relative to the formula's with the case's "poisson"; the core is gone from
    the fields."""
    exact = reference_module(folder)
    exact.NU = case.get("poisson", exact.NU)
    path = os.path.join(output, "blocks.pvd")
    errors = {}
    for (time, _), share in zip(vtu.read_pvd(path), (0.5, 1.0)):
        grid = vtu.read_at(path, time)
        x, u = grid.points, grid.point_data["displacement"]
        r = np.linalg.norm(x, axis=1)
        wall = np.abs(r - 1) < 1e-6
        wanted = exact.elastic(1.0, share) * x[wall]
        errors["wall, share %g" % share] = float(
            np.max(np.linalg.norm(u[wall] - wanted, axis=1))
            / abs(exact.elastic(1.0, share)))
        # the middles of the wall's edges lie a little inside of it
        errors["core left, share %g" % share] = float(np.sum(r < 0.9))
    errors["energy residual"] = residual_of(energies(output))
    return errors


def hollow_volume(grid, wall):
    """Volume between the origin and the faces of tetrahedra all of whose nodes
    are on the wall."""
    faces = np.sort(grid.cells[:, [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]]
                    .reshape(-1, 3), axis=1)
    faces, count = np.unique(faces[wall[faces].all(axis=1)], axis=0,
                             return_counts=True)
    a, b, c = np.moveaxis(grid.points[faces[count == 1]], 1, 0)
    return np.sum(np.abs(np.einsum("ij,ij->i", np.cross(a, b), c))) / 6


def radial_and_hoop_stress(grid):
    """Distances of the centres of tetrahedra from the origin, and the stresses
    along the radius and, the mean of all directions, across it."""
    centre = grid.points[grid.cells].mean(axis=1)
    r = np.linalg.norm(centre, axis=1)
    n = centre / r[:, None]
    s = grid.cell_data["stress"]
    along = (s[:, 0] * n[:, 0]**2 + s[:, 1] * n[:, 1]**2 + s[:, 2] * n[:, 2]**2
             + 2 * (s[:, 3] * n[:, 0] * n[:, 1] + s[:, 4] * n[:, 0] * n[:, 2]
                    + s[:, 5] * n[:, 1] * n[:, 2]))
    return r, np.array([along, 0.5 * (np.sum(s[:, :3], axis=1) - along)])


def space_sphere_yielding(case, folder, output, histories):
    """Mean displacement of the wall and the radius of the plastic zone, by the
    volume that has yielded; displacements of all nodes, and stresses of cells
    relative to the pressure."""
    exact = reference_module(folder).Yielding()
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    x, u = grid.points, grid.point_data["displacement"]
    r = np.linalg.norm(x, axis=1)
    radial = np.sum(x * u, axis=1) / r
    wanted = exact.displacement(r)
    wall = r < 1 + 1e-6
    volume = volumes(grid)
    yielded = np.sum(volume[grid.cell_data["yielding"] > 0])
    radius = (24 / (4 * np.pi) * (yielded + hollow_volume(grid, wall)))**(1 / 3)
    rc, found = radial_and_hoop_stress(grid)
    error = np.sqrt(np.average((found - exact.stresses(rc))**2, axis=1,
                               weights=volume * (rc < 2.5)))
    print("  wall %.4f mm, formula %.4f; plastic radius %.3f m, formula %.3f"
          % (1e3 * np.mean(radial[wall]), 1e3 * np.mean(wanted[wall]), radius,
             exact.radius))
    return {
        "displacement of the wall": float(
            abs(np.mean(radial[wall]) / np.mean(wanted[wall]) - 1)),
        "plastic radius": float(abs(radius / exact.radius - 1)),
        "displacement of a node / largest": float(
            np.max(np.abs(radial - wanted)) / np.max(np.abs(wanted))),
        "stress / pressure, rms": float(np.max(error) / exact.p0),
        "energy residual": residual_of(energies(output))}


def space_sphere_step(case, folder, output, histories):
    """Displacements of all nodes up to 2 m at the times of the fields, relative
    to the largest of the wall; its peak and the time of it, of a parabola
    through the rows about it; the radial stress and the hoop stress at the
    wall, relative to the pressure; and the residual of the energy balance. What
    stresses of cells differ by is extrapolated to the wall by a straight line
    over r."""
    exact = reference_module(folder)
    peak, at = exact.peak()
    peaks = []
    for name in ("wall_x", "wall_z"):
        t, u = histories["time"] / at - 1, histories[name] / peak
        near = np.abs(t) < 0.15
        c, b, a = np.polynomial.polynomial.polyfit(t[near], u[near], 2)
        peaks.append((abs(c - b * b / (4 * a) - 1), abs(b / (2 * a))))
    path = os.path.join(output, "blocks.pvd")
    largest, scale = 0.0, np.max(np.abs(histories["wall_x"]))
    stress = np.zeros(2)
    for time, _ in vtu.read_pvd(path):
        grid = vtu.read_at(path, time)
        x, u = grid.points, grid.point_data["displacement"]
        r = np.linalg.norm(x, axis=1)
        near = r < 2 + 1e-6
        wanted = (exact.displacement(r, time) / r)[:, None] * x
        largest = max(largest, np.max(np.linalg.norm((u - wanted)[near],
                                                     axis=1)))
        if time == 0:
            continue
        r, found = radial_and_hoop_stress(grid)
        weight = np.sqrt(volumes(grid)) * (r < 1.3)
        line = np.linalg.lstsq(
            weight[:, None] * np.column_stack([np.ones_like(r), r - 1]),
            weight[:, None] * (found - exact.stresses(r, time)).T, rcond=None)
        stress = np.maximum(stress, np.abs(line[0][0]) / exact.PRESSURE)
    return {"peak of the wall": float(np.max(peaks, axis=0)[0]),
            "time of the peak": float(np.max(peaks, axis=0)[1]),
            "all nodes up to 2 m": float(largest / scale),
            "radial stress at the wall": float(stress[0]),
            "hoop stress at the wall": float(stress[1]),
            "energy residual": residual_of(energies(output))}


def space_fill(case, folder, output, histories):
    """Displacements of the top of both lifts, the traction between them and the
    opening of their joint since the upper one was placed at the end of each
    stage, relative to the largest of the stage. "in situ": the lower one bears
    its weight from the start."""
    exact = reference_module(folder)
    with open(os.path.join(output, "summary.json")) as stream:
        summary = json.load(stream)
    # Rows have the time at which steps begin; in equilibrium the next stage,
    # too, has rows at the end of a stage.
    margin = 1e-9 if summary["solver"] == "implicit" else -1e-9
    errors = {}
    for (stage, end), wanted in zip(summary["stages"].items(), exact.stages()):
        before = histories["time"] <= end["time [s]"] * (1 + margin)
        last = histories["time"][before][-1]
        row = np.flatnonzero(histories["time"] == last)[0]
        found = [histories[name][row]
                 for name in ("low", "high", "traction", "opening")]
        scale = max(abs(wanted[0]), abs(wanted[1]))
        if case.get("in situ") and stage == "settle":
            wanted = (0.0, 0.0, 0.0, 0.0)
        errors["displacements, " + stage] = float(
            np.max(np.abs(np.subtract(found[:2], wanted[:2]))) / scale)
        errors["traction, " + stage] = float(
            abs(found[2] - wanted[2]) / abs(exact.stages()[-1][2]))
        errors["opening, " + stage] = float(
            abs(found[3] - wanted[3]) / abs(exact.stages()[-1][3]))
    errors["energy residual"] = residual_of(energies(output))
    return errors


def space_tunnel(case, folder, output, histories):
    """Displacements of the wall of a tunnel, relative to the largest; the hoop
    stress from the strain of the wall's edges at an end, whose radial stress is
    gone, all along the wall, at its side and at its crown; and the stresses of
    the cells up to 1.5 m by root mean square; all relative to the largest. All
    of it up to the place "up to" along the tunnel; then also the factor of the
    change of the stress along it, -4 nu d cos 2t/r^2, in these cells."""
    exact = reference_module(folder)
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    x, u = grid.points, grid.point_data["displacement"]
    length = case.get("up to", np.inf)
    wall = ((np.abs(np.hypot(x[:, 0], x[:, 2]) - 1) < 1e-6)
            & (x[:, 1] < length + 1e-6))
    wanted = exact.wall(np.arctan2(x[wall, 2], x[wall, 0]))
    errors = {"wall": float(np.max(np.abs(u[wall][:, ::2] - wanted))
                            / np.max(np.abs(wanted))),
              "core left": float(np.sum(np.hypot(x[:, 0], x[:, 2])
                                        < 1 - 1e-6))}

    rim = np.flatnonzero(wall & (x[:, 1] < 1e-6))
    rim = rim[np.argsort(np.arctan2(x[rim, 2], x[rim, 0]))]
    edge = np.diff(x[rim], axis=0)
    stretch = np.sum(np.diff(u[rim], axis=0) * edge, axis=1) / np.sum(
        edge**2, axis=1)
    middle = 0.5 * (x[rim[1:]] + x[rim[:-1]])
    angle = np.arctan2(middle[:, 2], middle[:, 0])
    mean, half = (exact.SXX + exact.SZZ) / 2, (exact.SXX - exact.SZZ) / 2
    before = mean + half * np.cos(2 * angle)    # radial
    hoop = (2 * mean - before - exact.NU / (1 - exact.NU) * before
            + exact.YOUNG / (1 - exact.NU**2) * stretch)
    wanted = exact.stresses(np.ones(len(angle)), angle)[1]
    largest = np.max(np.abs(wanted))
    print("  hoop stress at the side %.3f MPa, formula %.3f; at the crown %.3f "
          "MPa, formula %.3f" % (hoop[0] / 1e6, wanted[0] / 1e6,
                                 hoop[-1] / 1e6, wanted[-1] / 1e6))
    errors["hoop stress"] = float(np.max(np.abs(hoop - wanted)) / largest)
    errors["hoop stress at the side"] = float(abs(hoop[0] / wanted[0] - 1))
    errors["hoop stress at the crown"] = float(abs(hoop[-1] / wanted[-1] - 1))

    centre = x[grid.cells].mean(axis=1)
    r = np.hypot(centre[:, 0], centre[:, 2])
    c, s = centre[:, 0] / r, centre[:, 2] / r
    xx, yy, zz, _, xz, _ = grid.cell_data["stress"].T
    found = np.stack([xx * c**2 + zz * s**2 + 2 * xz * c * s,
                      xx * s**2 + zz * c**2 - 2 * xz * c * s,
                      (zz - xx) * c * s + xz * (c**2 - s**2), yy])
    difference = found - exact.stresses(r, np.arctan2(centre[:, 2],
                                                      centre[:, 0]))
    weights = volumes(grid) * (r < 1.5) * (centre[:, 1] < length)
    rms = np.sqrt(np.average(difference**2, axis=1, weights=weights))
    if "up to" in case:
        # -4 nu d cos 2t/r^2 by least squares, its factor by the formula's
        shape = np.cos(2 * np.arctan2(centre[:, 2], centre[:, 0])) / r**2
        factor = (np.sum(weights * shape * (yy - exact.SYY))
                  / np.sum(weights * shape**2))
        errors["change along the tunnel"] = float(
            abs(factor / (-4 * exact.NU * half) - 1))
    for name, error in zip(("radial", "hoop", "shear", "axial"), rms):
        errors["%s stress of cells, rms" % name] = float(error / largest)
    errors["energy residual"] = residual_of(energies(output))
    return errors


def same_by_other_stages(case, folder, output, histories):
    """How far the last row of the columns of "scale" is from that of a run with
    the settings "other", relative to the scale."""
    other = os.path.join(output, "other")
    run(case["quoin"], os.path.join(folder, case["prm"]), other,
        case.get("set", []) + case["other"])
    table, _ = read_table(os.path.join(other, "histories.csv"))
    return {"by other stages": float(max(
        abs(histories[name][-1] - table[name][-1]) / scale
        for name, scale in case["scale"].items()))}


def space_rest(case, folder, output, histories):
    """Stresses of all cells and tractions of the joints under the initial
    stress and gravity, relative to the largest stress, and the motion relative
    to the settlement by the weight."""
    exact = reference_module(folder)
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    wanted = exact.stress(grid.points[grid.cells].mean(axis=1))
    scale = np.max(np.abs(wanted))
    joints = vtu.read_at(os.path.join(output, "joints.pvd"))
    n = np.repeat(joints.cell_data["normal"], 3, axis=0)
    xx, yy, zz, xy, xz, yz = np.moveaxis(exact.stress(joints.points), 1, 0)
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    traction = np.einsum("ijk,kj->ki", tensor, n)
    found = (joints.point_data["normal traction"][:, None] * n
             + joints.point_data["shear traction"])
    # of a traction that is linear along a face, by the forces of its points
    mean = traction.reshape(-1, 3, 3)
    mean = (mean + np.sum(mean, axis=1)[:, None]) / 4
    return {
        "stresses": float(np.max(np.abs(grid.cell_data["stress"] - wanted))
                          / scale),
        "tractions of joints": float(
            np.max(np.abs(found.reshape(-1, 3, 3) - mean)) / scale),
        "displacement / settlement": float(
            np.max(np.abs(grid.point_data["displacement"]))
            / exact.settlement())}


def in_situ_rest(case, folder, output, histories):
    """Motion of the ground relative to the settlement by its own weight, and
    stresses of the cells and tractions of the joints relative to the largest."""
    exact = reference_module(folder)
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    u = grid.point_data["displacement"]
    y = grid.points[grid.cells][..., 1].mean(axis=1)
    errors = grid.cell_data["stress"] - exact.stresses(y)
    joints = vtu.read_at(os.path.join(output, "joints.pvd"))
    normal = joints.point_data["normal traction"]
    wanted = exact.normal_tractions(joints.points[:, 1])
    # each point is on a joint of one of three directions
    nearest = np.min(np.abs(wanted - normal[:, None]), axis=1)
    largest = np.max(np.abs(exact.stresses(y)))
    return {
        "motion / settlement": float(np.max(np.abs(u)) / exact.settlement()),
        "stress": float(np.max(np.abs(errors)) / largest),
        # linear triangles have them for the forces of the nodes
        "joint traction": float(np.max(nearest) / largest)}


def wedge_forces(case, folder, output, histories):
    """Normal forces on both planes of a wedge, relative to the closed form, and
    the shear forces relative to the weight: with the angle "sliding" friction along
    the line of intersection in each row after the load has risen, without it in the
    last row, at rest, both with the normal forces the weight."""
    exact = reference_module(folder)
    wanted = exact.on_both(np.array([0, 0, -exact.weight]))[1:]
    rows = (histories["time"] > 0.15 if "sliding" in case
            else slice(-1, None))
    forces = [np.stack([histories[plane + axis][rows] for axis in "xyz"], 1)
              for plane in "ab"]
    errors, shears = {}, []
    for plane, force, n, on in zip("ab", forces, (exact.a, exact.b), wanted):
        across = force @ n
        errors["normal force on " + plane] = float(
            np.max(np.abs(across / on - 1)))
        shears.append(force - across[:, None] * n)
        print("  on %s %.5f to %.5f of the weight, formula %.5f" % (
            plane, np.min(across) / exact.weight,
            np.max(across) / exact.weight, on / exact.weight))
    if "sliding" in case:
        mu = np.tan(np.radians(case["sliding"]))
        wrong = [shear + mu * on * exact.line
                 for shear, on in zip(shears, wanted)]
        errors["shear forces"] = float(
            np.max(np.linalg.norm(wrong, axis=2)) / exact.weight)
    else:
        wrong = sum(forces) - exact.weight * np.array([0, 0, 1.0])
        errors["weight"] = float(np.max(np.abs(wrong)) / exact.weight)
    return {**errors, **energy_residual(case, folder, output, histories)}


def factor_of_safety(case, folder, output, histories):
    """The middle of the bracket, no wider than 0.01, against a column of a
    table; where factors are "undecided", the stable one, and that the column is
    in the bracket."""
    with open(os.path.join(output, "summary.json")) as stream:
        found = json.load(stream)["factor of safety"]["safety"]
    table, _ = read_table(os.path.join(
        folder, case.get("table", "reference.csv")))
    wanted = table[case["factor"]][0]
    stable = found.get("stable at")
    failing = found.get("failing at")
    if stable is None or failing is None:
        raise Failure("no bracket was found: %s" % found)
    print("  stable at %.4f, failing at %.4f, reference %.4f, %d trials"
          % (stable, failing, wanted, found["trials"]))
    if not os.path.exists(os.path.join(output, "mechanism", "blocks.pvd")):
        raise Failure("the failing state was not written")
    if case.get("undecided"):
        if not stable <= wanted <= failing:
            raise Failure("the reference is outside of the bracket")
        return {"stable factor": float(abs(stable / wanted - 1))}
    if not 0 < failing - stable <= 0.01 + 1e-12:
        raise Failure("the bracket is %g wide" % (failing - stable))
    return {"factor of safety": float(
        abs(0.5 * (stable + failing) / wanted - 1))}


def middle_factor(output):
    with open(os.path.join(output, "summary.json")) as stream:
        found = json.load(stream)["factor of safety"]["safety"]
    return 0.5 * (found["stable at"] + found["failing at"])


def limit_of_factor_of_safety(case, folder, output, histories):
    """Limit of the factor as edges are halved, from this run and one with
    Mesh/Refinements = 1, against a column of a table."""
    fine = os.path.join(output, "fine")
    run(case["quoin"], os.path.join(folder, case["prm"]), fine,
        case["set"] + ["Mesh/Refinements=1"])
    factors = [middle_factor(output), middle_factor(fine)]
    limit, _ = mesh_convergence.limit(factors)
    wanted = read_table(os.path.join(folder, "reference.csv"))[0][
        case["factor"]][0]
    print("  factors %.4f and %.4f tend to %.4f, reference %.4f"
          % (*factors, limit, wanted))
    return {"factor of safety": float(abs(limit / wanted - 1))}


def same_factor_of_safety(case, folder, output, histories):
    """factor_of_safety(), and how far its middle moves in each run of "others",
    further settings by name: those that strength does not depend on."""
    result = factor_of_safety(case, folder, output, histories)
    for name, sets in case["others"].items():
        other = os.path.join(output, "other", name.replace(" ", "_"))
        run(case["quoin"], os.path.join(folder, case["prm"]), other,
            case.get("set", []) + sets)
        print("  %s: %.4f" % (name, middle_factor(other)))
        result[name] = float(abs(middle_factor(other) / middle_factor(output) - 1))
    return result


def creep(case, folder, output, histories):
    """Displacement in the stage after the one that reached equilibrium,
    divided by its settlement."""
    histories = strictly_increasing(histories)
    rest = histories["time"] > histories["time"][-1] - 1.0
    settled = max(np.max(np.abs(histories[name]))
                  for name in case["moves"])
    moved = max(np.ptp(histories[name][rest]) for name in case["moves"])
    # of the second half of the stage, by a straight line
    late = histories["time"] > histories["time"][-1] - 0.5
    drift = max(abs(np.polyfit(histories["time"][late],
                               histories[name][late], 1)[0]) * 0.5
                for name in case["moves"])
    print("  settled %.3e m, moved %.1e m, drift in half a second %.1e m"
          % (settled, moved, drift))
    return {"motion at rest": float(moved / settled),
            "drift": float(drift / settled)}


def tunnel_closure(histories, until):
    """Vertical and horizontal closure of the tutorial's tunnel [m] in the last
    row before the time @p until [s]."""
    row = np.nonzero(histories["time"] <= until)[0][-1]
    return (histories["invert_y"][row] - histories["crown_y"][row],
            histories["left_x"][row] - histories["right_x"][row])


def kirsch_closure(young):
    """Closure of the tutorial's tunnel in rock without joints, Kirsch 1898
    [m]."""
    radius, nu, vertical, horizontal = 2.5, 0.25, 5.2e6, 3.64e6
    mean, half = (vertical + horizontal) / 2, (vertical - horizontal) / 2
    factor = 2 * radius * (1 + nu) / young
    return (factor * (mean + (3 - 4 * nu) * half),
            factor * (mean - (3 - 4 * nu) * half))


def tunnel_without_joints(case, folder, output, histories):
    """The tutorial's tunnel with joints that are as good as none, the closure
    against that of Kirsch."""
    found = tunnel_closure(histories, histories["time"][-1])
    return {"%s closure" % name: float(abs(u / exact - 1))
            for name, u, exact in zip(("vertical", "horizontal"), found,
                                      kirsch_closure(20e9))}


def tunnel_in_blast(case, folder, output, histories):
    """The tutorial's tunnel: closure before the blast between that of rock
    without joints and 1.6 times that of rock as soft as it is with them
    (joints slip, and a wedge comes loose); the wave as it comes in, 0.5 m/s;
    the walls move between once and twice as fast; no energy from nothing."""
    histories = strictly_increasing(histories)
    start = histories["time"][-1] - case["blast"]
    result = {}
    for name, u, stiff, soft in zip(
            ("vertical", "horizontal"), tunnel_closure(histories, start),
            kirsch_closure(20e9), kirsch_closure(13e9)):
        print("  %s closure %.2f mm, Kirsch %.2f and %.2f mm"
              % (name, 1e3 * u, 1e3 * stiff, 1e3 * soft))
        result["%s closure, stiff rock by found" % name] = float(stiff / u)
        result["%s closure by that of soft rock" % name] = float(u / soft)
    angle = np.radians(60)
    later = histories["time"] > start

    def fastest(place):
        v = (histories[place + "_vx"] * np.sin(angle)
             + histories[place + "_vy"] * np.cos(angle))
        return float(np.max(v[later])) / 0.5

    result["wave that comes in"] = abs(fastest("edge") - 1)
    result["facing wall, from 1.5"] = abs(fastest("left") - 1.5)
    result["far wall, from 1.25"] = abs(fastest("right") - 1.25)
    result["energy residual"] = residual_of(energies(output))
    return result
