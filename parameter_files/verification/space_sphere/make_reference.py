#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Spherical cavity of 1 m in rock under hydrostatic stress -P0, small strains.

Elastic: Lame's hollow sphere of 1 m and 4 m. Perfectly plastic Mohr-Coulomb
rock: N sr - st = q with the hoop stresses st on an edge of the pyramid, so that
d sr/dr = 2 (st - sr)/r is integrable, and plastic flow er + 2 N_psi et = 0; the
radial displacement then solves du/dr + 2 N_psi u/r = er + 2 N_psi et of the
elastic strains (Yu & Houlsby 1991).
"""
import numpy as np

OUTER = 3.0
NU = 0.25


def number(degrees):
    s = np.sin(np.radians(degrees))
    return (1 + s) / (1 - s)


def elastic(r, share, pressure=10e6, young=10e9):
    """Radial displacement after the given share of the wall's support is gone,
    the outer pressure constant."""
    factor = -share * pressure / (OUTER**3 - 1) / young
    return factor * ((1 - 2 * NU) * r + (1 + NU) / 2 * OUTER**3 / r**2)


class Yielding:
    young = 100e9

    def __init__(self, pressure=25e6, cohesion=4e6, friction=20.0,
                 dilation=5.0):
        self.p0 = pressure
        self.n, self.n_psi = number(friction), number(dilation)
        n = self.n
        q = 2 * cohesion * np.sqrt(n)
        self.rest = q / (n - 1)
        self.power = 2 * (n - 1)
        # sr + p0 at the edge of the plastic zone
        self.rise = (q + (n - 1) * pressure) / (n + 0.5)
        self.radius = ((self.rest + pressure - self.rise) / self.rest
                       )**(1 / self.power)

    def stresses(self, r):
        """Radial and hoop stress."""
        r = np.asarray(r, dtype=float)
        plastic = self.rest * (1 - r**self.power)
        b = self.rise * (self.radius / r)**3
        inside = r < self.radius
        radial = np.where(inside, plastic, -self.p0 + b)
        hoop = np.where(inside, self.n * plastic - self.rest * (self.n - 1),
                        -self.p0 - b / 2)
        return radial, hoop

    def displacement(self, r):
        """Radial displacement [m]."""
        r = np.asarray(r, dtype=float)
        edge, m = self.radius, 2 * self.n_psi
        shear = self.young / (2 * (1 + NU))
        outside = -self.rise * edge**3 / (4 * shear * r**2)
        # (r^m u)' = r^m (er + m et) with er + m et = a + b r^power
        def strain(sr, st):
            return (sr - 2 * NU * st
                    + m * ((1 - NU) * st - NU * sr)) / self.young
        a = strain(self.rest + self.p0,
                   self.n * self.rest - self.rest * (self.n - 1) + self.p0)
        b = strain(-self.rest, -self.n * self.rest)
        def integral(x):
            return (a * x**(m + 1) / (m + 1)
                    + b * x**(m + 1 + self.power) / (m + 1 + self.power))
        at_edge = -self.rise * edge / (4 * shear)
        inside = (edge**m * at_edge + integral(r) - integral(edge)) / r**m
        return np.where(r < edge, inside, outside)


if __name__ == "__main__":
    rock = Yielding()
    print("radial stress at %g m %.6g Pa less than P0, plastic radius %.4f m, "
          "wall %.5g m" % (OUTER, rock.stresses(OUTER)[0] + rock.p0,
                           rock.radius, rock.displacement(1.0)))
    # against integration of the equations of equilibrium and flow
    r = np.linspace(1, rock.radius, 200001)
    sr, st = rock.stresses(r)
    assert np.allclose(np.gradient(sr, r)[1:-1],
                       2 * (st - sr)[1:-1] / r[1:-1], rtol=1e-4)
    u = rock.displacement(r)
    er = ((sr + rock.p0) - 2 * NU * (st + rock.p0)) / rock.young
    et = ((1 - NU) * (st + rock.p0) - NU * (sr + rock.p0)) / rock.young
    flow = (np.gradient(u, r) - er) + 2 * rock.n_psi * (u / r - et)
    assert np.max(np.abs(flow[1:-1])) < 1e-6 * np.max(np.abs(u))
