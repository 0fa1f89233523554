"""The swinging rod solved by none of those who take part: global polynomials or splines in s, DOP853 steps in t.

    python -m verification.peers.reference          writes swing.json, some ten minutes

Each section has its own coordinates in the plane of the fall, so that nothing is constrained: r and the angle θ of a
rod that shears, in polynomials; r alone in splines of degree six, whose slope is the angle, of one that stretches; θ
alone, r = ∫(cos θ, sin θ) ds, of one that does neither. Energies by Gauss quadrature; the weight is there at once, so
that waves run and the error falls with a power of the degree. `agreement` is the largest difference of two degrees.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp
from scipy.interpolate import BSpline

from verification.peers.swing import SWING

if TYPE_CHECKING:
    from verification.case import Array

__all__ = ["PATHS", "rigid", "sheared", "stretched"]

# Of the steps in time, relative to a length of 1, and the degree of splines.
TOLERANCE, ORDER = 1e-9, 6
# Finer and coarser degree, or number of spline pieces, of what is tabulated.
DEGREES = {"sheared": (20, 16), "stretched": (16, 12), "rigid": (16, 12)}

Slope = Callable[[float, "Array"], "Array"]


def sheared(degree: int) -> Array:
    """Tip of the rod with EA, GA, EI, ρA and ρI.

    Args:
        degree: Of x, y and θ.

    Returns:
        Shape (times, 2) [m].
    """
    s, w = gauss(degree + 8)
    P, D = polynomials(s, degree)
    at_0, at_1 = (polynomials(np.array([end]), degree)[0][0] for end in (0.0, 1.0))
    # r vanishes at the pin: no constant, and each polynomial less its value there.
    B, B_s, B_1 = (P - at_0)[:, 1:], D[:, 1:], (at_1 - at_0)[1:]
    M = np.linalg.inv(SWING.rhoA * B.T @ (w[:, None] * B))
    J = np.linalg.inv(SWING.rhoI * P.T @ (w[:, None] * P))
    n, weight = degree, SWING.rhoA * SWING.g * (B.T @ w)

    def slope(_: float, q: Array) -> Array:
        x_s, y_s, θ = B_s @ q[:n], B_s @ q[n : 2 * n], q[2 * n : 3 * n + 1]
        c, s_ = np.cos(P @ θ), np.sin(P @ θ)
        ε, γ = x_s * c + y_s * s_ - 1.0, y_s * c - x_s * s_
        N, Q = SWING.EA * ε, SWING.GA * γ
        by_θ = P.T @ (w * (N * γ - Q * (ε + 1.0))) + D.T @ (w * SWING.EI * (D @ θ))
        F_x, F_y = B_s.T @ (w * (N * c - Q * s_)), B_s.T @ (w * (N * s_ + Q * c))
        return np.concatenate([q[3 * n + 1 :], -M @ F_x, -M @ (F_y + weight), -J @ by_θ])

    start = np.zeros(6 * n + 2)
    start[:n] = np.linalg.lstsq(B, s, rcond=None)[0]
    q = moved(slope, start)
    return np.stack([B_1 @ q[:n], B_1 @ q[n : 2 * n]], axis=1)


def stretched(pieces: int) -> Array:
    """Tip of the rod with EA, EI and ρA, that cannot shear.

    Args:
        pieces: Of the splines.

    Returns:
        Shape (times, 2) [m].
    """
    knots = np.concatenate([np.zeros(ORDER), np.linspace(0.0, 1.0, pieces + 1), np.ones(ORDER)])
    n = pieces + ORDER - 1
    x, w_ = gauss(ORDER + 2)
    s, w = ((np.arange(pieces)[:, None] + x) / pieces).ravel(), np.tile(w_ / pieces, pieces)
    splines = [BSpline(knots, one, ORDER) for one in np.eye(n + 1)[1:]]
    B, B_s, B_ss = (np.stack([(f.derivative(k) if k else f)(s) for f in splines], axis=1) for k in range(3))
    M = np.linalg.inv(SWING.rhoA * B.T @ (w[:, None] * B))
    weight = SWING.rhoA * SWING.g * (B.T @ w)

    def slope(_: float, q: Array) -> Array:
        a, b, c, d = B_s @ q[:n], B_s @ q[n : 2 * n], B_ss @ q[:n], B_ss @ q[n : 2 * n]
        square = a * a + b * b
        κ, N = (a * d - b * c) / square, SWING.EA * (1.0 - 1.0 / np.sqrt(square))
        m = SWING.EI * κ / square
        F_x = B_s.T @ (w * (N * a + m * (d - 2.0 * κ * a))) - B_ss.T @ (w * m * b)
        F_y = B_s.T @ (w * (N * b - m * (c + 2.0 * κ * b))) + B_ss.T @ (w * m * a)
        return np.concatenate([q[2 * n :], -M @ F_x, -M @ (F_y + weight)])

    start = np.zeros(4 * n)
    start[:n] = np.linalg.lstsq(B, s, rcond=None)[0]
    q = moved(slope, start)
    return np.stack([q[n - 1], q[2 * n - 1]], axis=1)


def rigid(degree: int) -> Array:
    """Tip of the rod with EI and ρA, that neither stretches nor shears.

    Args:
        degree: Of θ.

    Returns:
        Shape (times, 2) [m].
    """
    s, w = gauss(degree + 16)
    P, D = polynomials(s, degree)
    n = degree + 1
    # Integrals from the pin to each point, of what is given at the points.
    whole = legendre.legvander(2.0 * s - 1.0, len(s) - 1)
    from_0 = np.stack([legendre.legval(2.0 * s - 1.0, legendre.legint(e, lbnd=-1.0)) for e in np.eye(len(s))], axis=1)
    S = 0.5 * from_0 @ np.linalg.inv(whole)
    K = SWING.EI * D.T @ (w[:, None] * D)

    def slope(_: float, q: Array) -> Array:
        θ, ω = P @ q[:n], P @ q[n:]
        c, s_ = np.cos(θ), np.sin(θ)
        X, Y = S @ (-s_[:, None] * P), S @ (c[:, None] * P)
        M = SWING.rhoA * (X.T @ (w[:, None] * X) + Y.T @ (w[:, None] * Y))
        a_x, a_y = S @ (-c * ω * ω), S @ (-s_ * ω * ω) + SWING.g
        F = -SWING.rhoA * (X.T @ (w * a_x) + Y.T @ (w * a_y)) - K @ q[:n]
        return np.concatenate([q[n:], np.linalg.solve(M, F)])

    θ = P @ moved(slope, np.zeros(2 * n))[:n]
    return np.stack([w @ np.cos(θ), w @ np.sin(θ)], axis=1)


PATHS = {"sheared": sheared, "stretched": stretched, "rigid": rigid}


def moved(slope: Slope, start: Array) -> Array:
    """States at the times of the problem, shape (unknowns, times)."""
    span = (0.0, SWING.times[-1])
    found = solve_ivp(slope, span, start, "DOP853", SWING.times, rtol=TOLERANCE, atol=1e-12)
    return np.asarray(found.y)


def gauss(n: int) -> tuple[Array, Array]:
    """Points and weights on [0, 1]."""
    x, w = legendre.leggauss(n)
    return 0.5 * (x + 1.0), 0.5 * w


def polynomials(s: Array, degree: int) -> tuple[Array, Array]:
    """Legendre polynomials on [0, 1] and their derivatives, shape (len(s), degree + 1)."""
    x = 2.0 * s - 1.0
    slopes = [2.0 * legendre.legval(x, legendre.legder(e)) for e in np.eye(degree + 1)]
    return legendre.legvander(x, degree), np.stack(slopes, axis=1)


def main() -> None:
    """Solve and write the table."""
    found = {}
    for name, (fine, coarse) in DEGREES.items():
        tip, other = PATHS[name](fine), PATHS[name](coarse)
        apart = float(np.linalg.norm(tip - other, axis=1).max())
        found[name] = {"degree": fine, "agreement": apart, "tip": tip.round(9).tolist()}
    Path(__file__).with_name("swing.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
