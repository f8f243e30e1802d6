#!/usr/bin/env python3
"""Standing waves of a tethered elastic tube in viscous fluid: writes tube_wave.csv.

Linearised Navier-Stokes equations, without the assumption of long waves, in the
lumen (r < a) and in the annulus (b < r < c, free slip at c), proportional to
exp(i k y - i omega t). With kappa^2 = k^2 - i omega / nu

  v_y = i k phi + psi,  v_r = phi' - (i k / kappa^2) psi',  p = i omega rho phi,

phi of I0(k r) and K0(k r), psi of I0(kappa r) and K0(kappa r). The wall moves
along r alone and keeps its volume: displacement w / r. Its neo-Hookean energy
for small strains (shear modulus G) gives

  rho_s ln(b/a) w_tt + 2 G (1/a^2 - 1/b^2) w - G ln(b/a) w_yy
    = sigma_rr(b) - sigma_rr(a),

sigma_rr = -p + 2 mu dv_r/dr of the fluid. omega is the root near the inviscid one.
Needs numpy and scipy.
"""

import pathlib

import numpy as np
from scipy.optimize import root
from scipy.special import iv, kv

A, C = 1.0, 5.0           # m: inner radius of the wall, of the cylinder around
LENGTH = 20.0             # m
DENSITY, G = 1.0, 6.0     # kg/m^3, Pa
NU = 2.5e-3               # m^2/s


def columns(r, k, kappa, omega, rho, mu):
    """v_y, v_r, dv_y/dr, sigma_rr for unit I0(k r), K0(k r), I0(kappa r), K0(kappa r)."""
    result = []
    for q, viscous in ((k, False), (kappa, True)):
        for value, slope, sign in ((iv(0, q * r), iv(1, q * r), 1), (kv(0, q * r), kv(1, q * r), -1)):
            first = sign * q * slope
            second = q * q * (value - sign * slope / (q * r))
            factor = -1j * k / kappa**2 if viscous else 1
            along = 1 if viscous else 1j * k
            pressure = 0 if viscous else 1j * omega * rho * value
            result.append((along * value, factor * first, along * first,
                           -pressure + 2 * mu * factor * second))
    return np.array(result).T


def residual(omega, outer, ratio, k):
    """What is left of the equation of the wall for w = 1."""
    kappa = np.sqrt(k * k - 1j * omega / NU)
    mu = DENSITY * NU
    log = np.log(outer / A)
    inner_wall = columns(A, k, kappa, omega, DENSITY, mu)[:, [0, 2]]
    lumen = np.linalg.solve(inner_wall[:2], [0, -1j * omega / A])
    wall, far = (columns(r, k, kappa, omega, DENSITY, mu) for r in (outer, C))
    matrix = np.array([wall[0], wall[1], far[1], far[2]])
    scale = np.abs(matrix).max(axis=0)
    annulus = np.linalg.solve(matrix / scale, [0, -1j * omega / outer, 0, 0]) / scale
    return (-omega**2 * ratio * DENSITY * log + 2 * G * (1 / A**2 - 1 / outer**2)
            + k**2 * G * log + inner_wall[3] @ lumen - wall[3] @ annulus)


def frequency(outer, ratio, k=2 * np.pi / LENGTH):
    inviscid = k * np.sqrt(G / DENSITY * (1 - (A / outer)**2) / (1 + A**2 / (C**2 - outer**2)))

    def equations(x):
        value = residual(x[0] + 1j * x[1], outer, ratio, k)
        return [value.real, value.imag]

    solution = root(equations, [0.93 * inviscid, -0.05 * inviscid], tol=1e-13)
    if not solution.success:
        raise RuntimeError(solution.message)
    return complex(*solution.x)


def main():
    lines = [
        "# Standing wave (length 20 m) of a tethered neo-Hookean tube, inner radius 1 m, shear modulus 6 Pa, in fluid",
        "# of 1 kg/m^3 and nu = 2.5e-3 m^2/s inside it and around it up to a free-slip cylinder of 5 m.",
        "# Complex frequency, motion ~ exp(-i omega t), of the linearised Navier-Stokes equations: tube_wave.py.",
        "# outer radius m, density of the wall kg/m^3, re omega 1/s, im omega 1/s"]
    for outer, ratio in ((1.1, 1.0), (1.1, 0.1), (1.05, 1.0), (1.05, 0.1)):
        omega = frequency(outer, ratio)
        lines.append(f"{outer},{ratio},{omega.real:.9f},{omega.imag:.9f}")
    path = pathlib.Path(__file__).with_suffix(".csv")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
