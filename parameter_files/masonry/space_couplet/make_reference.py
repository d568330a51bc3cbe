#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A joint with the composite law in tension, in shear off the axes and on its cap.

Each traction is a function of what has softened or hardened it, w, k or k3, and so is
the displacement, which grows with it: closed curves, with quadrature for shear on the
cap.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
AREA = 0.8
KN, KS, FT, GI, C, GII, TAN = (82e9, 36e9, 0.25e6, 18.0, 0.35e6, 125.0,
                               np.tan(np.radians(36.8698976)))
FM, GC, KP, CSS = 10.5e6, 5000.0, 0.09e-3, 9.0
ALONG = np.radians(30)
KM = 75 / 67 * GC / FM + KP  # where the cap has softened to fm/2


def inverse(curve, wanted, last):
    """Where the growing @p curve from 0 to @p last is @p wanted, by bisection."""
    low, high = np.zeros_like(wanted), np.full_like(wanted, last)
    for _ in range(100):
        middle = 0.5 * (low + high)
        short = curve(middle) < wanted
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    return 0.5 * (low + high)


def cap(k):
    """Limit of the pressure at the plastic displacement k on the cap."""
    rising = FM / 3 + (FM - FM / 3) * np.sqrt(
        np.clip(2 * k / KP - (k / KP)**2, 0, None))
    falling = FM - FM / 2 * ((k - KP) / (KM - KP))**2
    left = FM / 2 - FM / 7
    residual = FM / 7 + left * np.exp(-FM / (KM - KP) * (k - KM) / left)
    return np.where(k < KP, rising, np.where(k < KM, falling, residual))


def write(name, **columns):
    units = {"opening": "m", "crushing": "m", "slip_x": "m", "slip_y": "m",
             "damage": "-", "normal": "Pa", "shear": "Pa", "time": "s"}
    np.savetxt(os.path.join(HERE, name), np.transpose(list(columns.values())),
               delimiter=",", fmt="%.10g", comments="", header=",".join(
                   "%s [%s]" % (key, units.get(key, "N")) for key in columns))


t = np.arange(0, 0.4, 2e-3)
rise = (1 - np.cos(np.pi * t / 0.4)) / 2


def softened(total, stiffness, strength, energy, constant):
    """Traction at the displacement @p total, and the share that is lost."""
    def traction(plastic):
        return strength * np.exp(-strength * plastic / energy) + constant
    plastic = inverse(lambda p: p + traction(p) / stiffness, total,
                      np.max(total))
    elastic = stiffness * total <= strength + constant
    return (np.where(elastic, stiffness * total, traction(plastic)),
            np.where(elastic, 0, 1 - np.exp(-strength * plastic / energy)))


opening = 0.4e-3 * rise
sigma, damage = softened(opening, KN, FT, GI, 0.0)
write("reference_tension.csv", time=t, opening=opening, normal=sigma,
      damage=damage, force_z=-sigma * AREA)

PRESSURE = 0.5e6
slip = 2e-3 * rise
tau, damage = softened(slip, KS, C, GII, PRESSURE * TAN)
write("reference_shear.csv", time=t + 0.1, slip_x=slip * np.cos(ALONG),
      slip_y=slip * np.sin(ALONG), shear=tau, damage=damage,
      force_x=-tau * AREA * np.cos(ALONG), force_y=-tau * AREA * np.sin(ALONG),
      force_z=np.full_like(t, PRESSURE * AREA))

# Slip on a quarter of a circle. With the traction T(k) n, n at the angle a, the rate of
# slip v is T a'/ks across n and k' + T'/ks along it.
RADIUS = 1e-3


def place(angle):
    return RADIUS * np.array([np.sin(angle), 1 - np.cos(angle)])


def strength(k):
    return C * np.exp(-C * k / GII) + PRESSURE * TAN


def rates(angle, turned_and_lost):
    """Of a and k, by the angle on the circle."""
    a, k = turned_and_lost
    rate = RADIUS * np.array([np.cos(angle), np.sin(angle)])
    along = rate @ [np.cos(a), np.sin(a)]
    across = rate @ [-np.sin(a), np.cos(a)]
    slope = -C / GII * (strength(k) - PRESSURE * TAN)
    return np.array([KS * across / strength(k), along / (1 + slope / KS)])


# A chord of the circle is 2 R sin(angle/2) at half the angle.
first = 2 * np.arcsin(strength(0) / KS / (2 * RADIUS))
angles = np.linspace(first, np.pi / 2, 20001)
states = [np.array([first / 2, 0.0])]
step = angles[1] - angles[0]
for angle in angles[:-1]:  # Runge & Kutta
    here = states[-1]
    r1 = rates(angle, here)
    r2 = rates(angle + step / 2, here + step / 2 * r1)
    r3 = rates(angle + step / 2, here + step / 2 * r2)
    r4 = rates(angle + step, here + step * r3)
    states.append(here + step / 6 * (r1 + 2 * r2 + 2 * r3 + r4))
angle = np.pi / 2 * rise
a, k = (np.interp(angle, angles, column) for column in np.transpose(states))
slip = place(angle)
elastic = angle <= first
traction = np.where(elastic, KS * slip,
                    strength(k) * np.array([np.cos(a), np.sin(a)]))
write("reference_turning.csv", time=t + 0.1, slip_x=slip[0], slip_y=slip[1],
      shear=np.hypot(*traction),
      damage=np.where(elastic, 0, 1 - np.exp(-C * k / GII)),
      force_x=-traction[0] * AREA, force_y=-traction[1] * AREA,
      force_z=np.full_like(t, PRESSURE * AREA))

# All plastic closure is crushing.
closure = 1e-3 * rise
crushing = inverse(lambda k: k + cap(k) / KN, closure, 1e-3)
elastic = KN * closure <= FM / 3
pressure = np.where(elastic, KN * closure, cap(crushing))
write("reference_compression.csv", time=t, opening=-closure, normal=-pressure,
      crushing=np.where(elastic, 0, crushing), force_z=pressure * AREA)

# Shear under a pressure: sigma^2 + Css tau^2 = cap(k)^2, and flow along
# (2 sigma, 2 Css tau) that is as long as k.
PRESSURE = 3e6  # below fm/3
# k = KP s^2 / 2, as the cap rises with the root of k at first
s = np.linspace(0, 1, 200001)
k = KP * s**2 / 2
tau = np.sqrt(np.maximum(cap(k)**2 - PRESSURE**2, 0) / CSS)
length = np.sqrt(PRESSURE**2 + (CSS * tau)**2)


def integral(rate):
    """Of rate over k."""
    steps = np.diff(k) * 0.5 * (rate[1:] + rate[:-1])
    return np.concatenate([[0], np.cumsum(steps)])


plastic_slip = integral(CSS * tau / length)
plastic_closure = integral(PRESSURE / length)
slip = 0.09e-3 * rise
whole = plastic_slip + tau / KS
elastic = slip <= whole[0]
inside = np.interp(slip, whole, np.arange(len(s)))


def at(values):
    return np.interp(inside, np.arange(len(s)), values)


shear = np.where(elastic, KS * slip, at(tau))
assert np.max(shear) < C + PRESSURE * TAN and np.max(slip) < whole[-1]
write("reference_crushing.csv", time=t + 0.1, slip_x=slip * np.cos(ALONG),
      slip_y=slip * np.sin(ALONG),
      opening=-PRESSURE / KN - at(plastic_closure), shear=shear,
      crushing=at(k), force_x=-shear * AREA * np.cos(ALONG),
      force_y=-shear * AREA * np.sin(ALONG),
      force_z=np.full_like(t, PRESSURE * AREA))
