"""Rods in motion by the method of lines: a Gauss–Lobatto spectral element in s, DOP853 steps in t.

All stand along x at rest, their start held at the origin, and are moved by a uniform force per length and a force at
the end, both smooth in time: the error falls exponentially with the degree. The forces are gradients of the energy by
quadrature in the nodes, so that between two moments without load nothing is gained or lost but by the steps.

`Thin` knows the centreline alone, with stretch ε = |r′| − 1, bending |t′| and t = r′/|r′|: a round section without
rotary inertia, which nothing twists. `Thick` is the rod of Simo and Reissner, r and unit quaternions p at the nodes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

__all__ = ["Forces", "Thick", "Thin", "lobatto"]

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
# Force per length and force at the end at a time, each of shape (3,).
Forces = Callable[[float], tuple[Array, Array]]

E1 = np.array([1.0, 0.0, 0.0])
CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


@dataclass(frozen=True)
class Thin:
    """Rod of unit length and mass that cannot shear, with EI = 1, its start held, free to turn.

    Args:
        EA: Against stretch [EI/L²].
    """

    EA: float

    def tip(self, forces: Forces, t: float, *, degree: int = 14, tol: float = 1e-11) -> Array:
        """End of the rod.

        Args:
            forces: That act.
            t: When [s].
            degree: Of the polynomials in s.
            tol: Of the steps, relative and absolute.

        Returns:
            Shape (3,) [m].
        """
        s, w, D = lobatto(degree)
        weights = w[:, None]

        def slope(time: float, y: Array) -> Array:
            r, v = y.reshape(2, -1, 3)
            r_s = D @ r
            stretch = np.sqrt(np.einsum("ij,ij->i", r_s, r_s))[:, None]
            t_ = r_s / stretch
            bending = D.T @ (weights * (D @ t_))
            across = bending - t_ * np.einsum("ij,ij->i", bending, t_)[:, None]
            F = -D.T @ (weights * self.EA * (stretch - 1.0) * t_ + across / stretch)
            along, end = forces(time)
            F[-1] += end
            a = F / weights + along
            a[0] = 0.0
            return np.concatenate([v.ravel(), a.ravel()])

        r = np.stack([s, 0.0 * s, 0.0 * s], axis=1).ravel()
        y = solve_ivp(slope, (0.0, t), np.concatenate([r, 0.0 * r]), "DOP853", (t,), rtol=tol, atol=tol).y[:, -1]
        return np.asarray(y.reshape(2, -1, 3)[0, -1])


@dataclass(frozen=True)
class Thick:
    """Rod of unit length and mass.

    Args:
        C_n: EA, GA2, GA3.
        C_m: GJ, EI2, EI3.
        J: ρI about d1, d2, d3.
        clamped: Whether its start is held from turning, too.
    """

    C_n: Vector
    C_m: Vector
    J: Vector
    clamped: bool = False

    def tip(self, forces: Forces, t: float, *, degree: int = 14, tol: float = 1e-10) -> Array:
        """End of the rod; as `Thin.tip`."""
        s, w, D = lobatto(degree)
        n = degree + 1
        C_n, C_m, J = (np.asarray(c) for c in (self.C_n, self.C_m, self.J))
        weights = w[:, None]

        def slope(time: float, y: Array) -> Array:
            r, v, ω = y[: 9 * n].reshape(3, n, 3)
            p = y[9 * n :].reshape(n, 4)
            p = p / np.linalg.norm(p, axis=1)[:, None]
            R = _matrices(p)
            b = np.einsum("nji,nj->ni", R, D @ r)
            N = C_n * (b - E1)
            F = -D.T @ (weights * np.einsum("nij,nj->ni", R, N))
            p_s = D @ p
            m = _pure(weights * C_m * 2.0 * _product(p * CONJUGATE, p_s)[:, 1:])
            by_p = 2.0 * (D.T @ _product(p, m) - _product(p_s, m))
            M = weights * np.cross(b, N) - 0.5 * _product(p * CONJUGATE, by_p)[:, 1:]
            along, end = forces(time)
            F[-1] += end
            a, α = F / weights + along, (M / weights - np.cross(ω, J * ω)) / J
            a[0] = 0.0
            if self.clamped:
                α[0] = 0.0
            return np.concatenate([v.ravel(), a.ravel(), α.ravel(), 0.5 * _product(p, _pure(ω)).ravel()])

        start = np.zeros(13 * n)
        start[: 3 * n : 3], start[9 * n :: 4] = s, 1.0
        y = solve_ivp(slope, (0.0, t), start, "DOP853", (t,), rtol=tol, atol=tol).y[:, -1]
        return np.asarray(y[3 * n - 3 : 3 * n])


def lobatto(degree: int) -> tuple[Array, Array, Array]:
    """Nodes and weights of Gauss–Lobatto quadrature on [0, 1], and the derivative of polynomials given there.

    Args:
        degree: Of the polynomials.

    Returns:
        Shapes (n,), (n,) and (n, n), n = degree + 1.
    """
    c = np.zeros(degree + 1)
    c[degree] = 1.0
    x = np.concatenate([[-1.0], np.sort(legendre.legroots(legendre.legder(c)).real), [1.0]])
    P = legendre.legval(x, c)
    gap = x[:, None] - x + np.eye(degree + 1)
    D = P[:, None] / (P * gap)
    np.fill_diagonal(D, 0.0)
    np.fill_diagonal(D, -D.sum(axis=1))
    return 0.5 * (x + 1.0), 1.0 / (degree * (degree + 1) * P**2), 2.0 * D


def _product(a: Array, b: Array) -> Array:
    """Of quaternions, shape (n, 4)."""
    scalar = a[:, 0] * b[:, 0] - np.einsum("ij,ij->i", a[:, 1:], b[:, 1:])
    return np.column_stack([scalar, a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])])


def _pure(v: Array) -> Array:
    """Vectors as quaternions."""
    return np.column_stack([np.zeros(len(v)), v])


def _matrices(p: Array) -> Array:
    """Rotations of unit quaternions, shape (n, 3, 3)."""
    w, x, y, z = p.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.asarray(rows).transpose(2, 0, 1)
