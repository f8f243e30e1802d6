#!/usr/bin/env python3
"""A pressure pulse in the tube of tube_wave.py: writes tube_pulse.csv.

A push q(y) = q_0 exp(-(y / s)^2) of the fluid in the lumen at t = 0 moves the wall by

  w(y, t) = sum_k k q_k sin(k y) exp(im(omega_k) t) sin(re(omega_k) t) / re(omega_k),

q_k its Fourier coefficients in the length of the tube and omega_k the complex
frequencies of tube_wave.py. Needs numpy and scipy.
"""

import pathlib

import numpy as np

from tube_wave import frequency

LENGTH, WIDTH = 60.0, 4.0  # m: of the tube, s of the push
OUTER, RATIO = 1.1, 1.0
STATIONS = (8.0, 18.0)     # m from the middle of the push
N_WAVES = 16               # exp(-(k s / 2)^2) is 2e-5 then


def displacement(y, t):
    """w over q_0, to a factor that does not depend on y and t."""
    w = np.zeros_like(t)
    for n in range(1, N_WAVES + 1):
        k = 2 * np.pi * n / LENGTH
        omega = frequency(OUTER, RATIO, k)
        w += (k * np.exp(-(k * WIDTH / 2)**2) * np.sin(k * y) * np.exp(omega.imag * t)
              * np.sin(omega.real * t) / omega.real)
    return w


def main():
    t = np.arange(0, 26, 1e-3)
    lines = ["# Pulse from a push exp(-(y / 4 m)^2) in the middle of a tube of 60 m, the tube of tube_wave.py",
             "# (outer radius 1.1 m, wall of 1 kg/m^3): when the crest of the wall's displacement passes, and its",
             "# height over that at the first station; linearised Navier-Stokes equations: tube_pulse.py.",
             "# distance from the middle m, time s, height -"]
    first = None
    for y in STATIONS:
        w = displacement(y, t)
        first = first or w.max()
        lines.append(f"{y},{t[w.argmax()]:.3f},{w.max() / first:.4f}")
    path = pathlib.Path(__file__).with_suffix(".csv")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
