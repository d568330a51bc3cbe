#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""References for the flow in joints: see README.md."""
import math
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
MU = 1e-3


def write(name, head, rows):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write(head + "\n")
        for row in rows:
            stream.write(",".join("%.12g" % value for value in row) + "\n")


def network(weight=1e4, is_dug=False):
    """Heads of the crossings by Kirchhoff's laws; nodes (x, y). The crossings
    are the corners of the block in the middle: once that is excavated water
    comes out there without pressure."""
    aperture = {"h1": 1e-4, "h2": 2e-4, "v1": 1.5e-4, "v2": 3e-4}
    lines = {"h1": [(x, 1) for x in range(4)], "h2": [(x, 2) for x in range(4)],
             "v1": [(1, y) for y in range(4)], "v2": [(2, y) for y in range(4)]}
    head = {(0, 1): 20.0, (0, 2): 20.0, (3, 1): 5.0, (3, 2): 5.0,
            (1, 3): 3.0}  # a spring: pressure 0 at the height 3
    source = {(2, 2): -1e-5}
    if is_dug:
        head.update({(x, y): float(y) for x in (1, 2) for y in (1, 2)})
        source = {}
    nodes = sorted({node for line in lines.values() for node in line})
    number = {node: i for i, node in enumerate(nodes)}
    matrix, right = np.zeros((len(nodes),) * 2), np.zeros(len(nodes))
    conductance = {}
    for name, line in lines.items():
        conductance[name] = weight * aperture[name]**3 / (12 * MU)
        for a, b in zip(line, line[1:]):
            if is_dug and a in [(1, 1), (1, 2), (2, 1)] and b in [
                    (1, 2), (2, 1), (2, 2)]:
                continue  # a face of the block
            i, j = number[a], number[b]
            matrix[[i, j, i, j], [i, j, j, i]] += (
                conductance[name] * np.array([1, 1, -1, -1]))
    laplace = matrix.copy()
    for node, value in source.items():
        right[number[node]] = value
    for node, value in head.items():
        matrix[number[node]] = 0
        matrix[number[node], number[node]] = 1
        right[number[node]] = value
    heads = np.linalg.solve(matrix, right)
    inflow = laplace @ heads
    at = {node: heads[i] for node, i in number.items()}
    pressure = {node: weight * (h - node[1]) for node, h in at.items()}
    if is_dug:
        conductance["h1"] = conductance["v2"] = 0.0
    flow = {"lake": inflow[number[0, 1]] + inflow[number[0, 2]],
            "river": inflow[number[3, 1]] + inflow[number[3, 2]],
            "spring": inflow[number[1, 3]],
            "pump": inflow[number[2, 2]] if is_dug else -1e-5}
    q_h1 = conductance["h1"] * (at[1, 1] - at[2, 1])
    v_v2 = conductance["v2"] * (at[2, 1] - at[2, 2]) / aperture["v2"]
    return pressure, flow, [q_h1, v_v2] + water(
        {node: source.get(node, inflow[i]) for node, i in number.items()})


def water(inflow):
    """Into the joints on the left, out of them on the right, into those of the
    upper line from outside, all that comes in and goes out."""
    return [sum(q for (x, y), q in inflow.items() if x == 0),
            -sum(q for (x, y), q in inflow.items() if x == 3),
            sum(q for (x, y), q in inflow.items() if y == 2),
            sum(q for q in inflow.values() if q > 0),
            -sum(q for q in inflow.values() if q < 0)]


def diffusion(x, t, p0=1e5, length=2.0, aperture=1e-4, bulk=2e9):
    """Pressure in a joint that is closed at x = length, without pressure at
    first and with p0 at x = 0 from t = 0 on."""
    c = bulk * aperture**2 / (12 * MU)
    p = p0
    for n in range(400):
        k = (2 * n + 1) * math.pi / (2 * length)
        p -= (4 * p0 / ((2 * n + 1) * math.pi) * math.sin(k * x)
              * math.exp(-c * k * k * t))
    return p


def consolidation(times, press=2e5, kn=1e10, a0=1e-4, length=2.0):
    """Opening w of a joint below a rigid slab, from which incompressible water
    flows at both ends: the mean pressure is 12 mu L^2 / (12 a^3) times the
    rate of closing, and press + kn w bears the rest. Runge and Kutta."""
    def rate(w):
        return -(press + kn * w) * (a0 + w)**3 / (MU * length**2)
    rows, w, t, steps = [], 0.0, 0.0, 200
    for end in times:
        h = (end - t) / steps
        for _ in range(steps):
            k1 = rate(w)
            k2 = rate(w + 0.5 * h * k1)
            k3 = rate(w + 0.5 * h * k2)
            k4 = rate(w + h * k3)
            w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        t = end
        # parabola: 3/2 of the mean in the middle
        rows.append((t, w, 1.5 * (press + kn * w)))
    return rows


def placed_block(time, k=1e10):
    """Aperture, flow and traction of a joint that is closed by 0.1 mm in the
    second from 1 s on, and in the next one slips by 1 mm at a constant opening,
    both from where its block was placed."""
    closing = 1e-4 * min(time - 1, 1)
    aperture = 3e-4 - closing
    friction, dilation = (math.tan(math.radians(angle)) for angle in (30, 10))
    # k (u - p) = friction k (closing + dilation p)
    u = 1e-3 * max(0, time - 2)
    plastic = max(0, u - friction * closing) / (1 + friction * dilation)
    return [aperture, aperture**3 / (12 * MU) * 9810.0,
            -k * (closing + dilation * plastic)]


def undrained(press=2e5, kn=1e10, a0=1e-4, bulk=2e8):
    """Opening w and pressure of a closed joint full of water below a slab:
    a0 = (a0 + w) (1 + p / bulk), press = p - kn w."""
    low, high = -0.5 * a0, 0.0
    for _ in range(200):
        w = 0.5 * (low + high)
        p = press + kn * w
        if (a0 + w) * (1 + p / bulk) > a0:
            high = w
        else:
            low = w
    return w, press + kn * w


def cracked_dam(height=50.0, width=40.0, concrete=24e3, water=1e4, kn=1e9,
                place=28.0):
    """Length of the crack below a rigid dam, with the head of the reservoir in
    it and an uplift that falls to zero from its tip to the toe; the effective
    stress rises from zero at the tip to the toe. Opening at the heel, effective
    traction at the toe, crack, pressure at a place in the closed part."""
    weight, head = 0.5 * concrete * height * width, water * height
    low, high = 0.0, width
    for _ in range(200):
        crack = 0.5 * (low + high)
        rest = width - crack
        effective = weight - head * (crack + 0.5 * rest)
        moment = (weight * 2 * width / 3 - 0.5 * water * height**3 / 3
                  - head * crack * (width - crack / 2)
                  - 0.5 * head * rest * 2 * rest / 3)  # about the toe
        if moment < effective * rest / 3:
            low = crack
        else:
            high = crack
    stress = 2 * effective / rest
    return (stress / kn * crack / rest, -stress, crack,
            head * (width - place) / rest)


def embankment(above=8.4, below=2.0, weight=1e4, aperture=2e-4):
    """Discharge of joints at y = 1 ... 9 m over 5 m: horizontal flow is that of
    differences of pressure, whose sum over the height falls linearly from one
    side to the other, wherever the free surface lies (Dupuit, Charny)."""
    pressures = weight * sum(max(0, above - y) - max(0, below - y)
                             for y in range(1, 10))
    return aperture**3 / (12 * MU) * pressures / 5


def front(t, p0=1e5, aperture=1e-4):
    """Where the front of water in a dry joint is (Washburn)."""
    return math.sqrt(2 * aperture**2 / (12 * MU) * p0 * t)


def main():
    pressure, flow, rest = network()
    head = ("time [s],p11 [Pa],p21 [Pa],p12 [Pa],p22 [Pa],bottom [Pa],"
            "q_h1 [m^3/s],q_v2 [m/s],lake [m^3/s],river [m^3/s],h2 [m^3/s],"
            "in [m^3/s],out [m^3/s]")
    write("network.csv", head,
          [[1.0, pressure[1, 1], pressure[2, 1], pressure[1, 2],
            pressure[2, 2], pressure[1, 0]] + rest])
    names = ("lake", "river", "spring", "pump")
    write("network_flow.csv", ",".join(n + " [m^3/s]" for n in names),
          [[flow[n] for n in names]])
    pressure, flow, rest = network(is_dug=True)
    write("excavation.csv", head,
          [[2.0, 0.0, 0.0, 0.0, 0.0, pressure[1, 0], 0.0, 0.0] + rest[2:]])
    write("excavation_flow.csv", ",".join(n + " [m^3/s]" for n in names),
          [[flow[n] for n in names]])
    q = embankment()
    write("free_surface.csv",
          "time [s],in [m^3/s],out [m^3/s],foot [-],top [-]",
          [(1.0, q, q, 1.0, 0.0)])
    times = [0.2 * k for k in range(30, 101)]
    write("front.csv", "time [s],quarter [Pa]",
          [(t, 1e5 * (1 - 0.5 / front(t))) for t in times])
    write("wide_front.csv", "time [s],quarter [Pa]",
          [(1e-4 * t, 1e5 * (1 - 0.5 / front(1e-4 * t, aperture=1e-2)))
           for t in times])
    # under its weight alone it falls at one velocity
    q = 1e-4**3 / (12 * MU) * 9810.0
    write("drain.csv", "time [s],outflow [m^3/s]",
          [(0.6 * k, q) for k in range(1, 101)])
    write("placed.csv", "time [s],aperture [m],flow [m^3/s],normal [Pa]",
          [[t] + placed_block(t) for t in (1.5, 2.0, 2.5, 3.0)])
    # full pressure at rest; the cubic law over 2 m once the wall is free
    q = 2e-4**3 / (12 * MU) * 1e4 * 10 / 2
    write("drift.csv", "time [s],drift [m^3/s],lake [m^3/s],middle [Pa]",
          [(0.5, 0.0, 0.0, 1e5), (1.5, q, q, 5e4), (2.0, q, q, 5e4)])
    times = [1.2e-5 * k for k in range(20, 201)]
    write("diffusion.csv", "time [s],quarter [Pa],middle [Pa],end [Pa]",
          [[t] + [diffusion(x, t) for x in (0.5, 1.0, 2.0)] for t in times])
    write("consolidation.csv", "time [s],opening [m],middle [Pa]",
          consolidation([0.01 * k for k in range(1, 201)]))
    write("dam.csv", "time [s],heel [m],toe [Pa],crack [m],pressure [Pa]",
          [(1.0,) + cracked_dam()])
    # p - kn w bears the load of 0.2 MPa
    write("steady.csv", "time [s],opening [m],middle [Pa]",
          [(1.0, (1e5 - 2e5) / 1e10, 1e5)])
    write("undrained.csv", "time [s],opening [m],middle [Pa]",
          [(1.0,) + undrained()])


if __name__ == "__main__":
    main()
