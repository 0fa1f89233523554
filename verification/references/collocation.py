"""Gauss collocation of the rod's balance between joints, and Newton's method for all panels at once.

A panel is a stretch of rod without jumps; its state y = (r, p, n, m) holds position, unit quaternion (scalar first),
force and moment in space. At the Gauss points of a panel of length h, y = y_a + h A·y′ with the integrals A of
Lagrange's polynomials; its end y_b = y_a + h b·y′ is as accurate as Gauss quadrature, of order twice the number of
points, and |p|, being quadratic, stays what it is. Joints lie between panels and at both ends: there loads, reactions
and what is held are balanced. Jacobians are complex-step derivatives, exact to round-off.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

__all__ = ["SIZE", "Boundary", "Gauss", "Panels", "State", "corrected", "product", "rotated", "slope"]

Array = NDArray[np.float64]

# r, p, n, m.
SIZE = 13
E1 = np.array([1.0, 0.0, 0.0])
TINY = 1e-30


class Gauss:
    """Gauss points on [0, 1], integrals over them, and the polynomial through them.

    Args:
        n: Number of points.
    """

    def __init__(self, n: int) -> None:
        x, w = legendre.leggauss(n)
        self.points, self.weights = 0.5 * (1.0 + x), 0.5 * w
        # Legendre coefficients of a function from its values at the points.
        self._series = np.linalg.inv(legendre.legvander(x, n - 1))
        self.integrals = self.integral_to(self.points)

    def integral_to(self, x: Array) -> Array:
        """Weights, shape (len(x), n), of the integrals from 0 to each x."""
        twice = legendre.legint(np.eye(len(self.points)), lbnd=-1.0, axis=0)
        return np.asarray(0.5 * legendre.legvander(2.0 * x - 1.0, len(self.points)) @ twice @ self._series)


@dataclass(frozen=True, eq=False)
class Panels:
    """Stretches of rod, one after the other.

    Args:
        start: Arc length at which each begins, shape (n,).
        length: h, shape (n,).
        kappa: Stress-free curvature at the Gauss points, shape (n, n_points, 3).
        force: Dead force per arc length, shape (n, 1, 3).
        compliance_n: Strain per force in the section, shape (3,).
        compliance_m: Curvature per moment in the section, shape (3,).
    """

    start: Array
    length: Array
    kappa: Array
    force: Array
    compliance_n: Array
    compliance_m: Array


@dataclass(frozen=True, eq=False)
class State:
    """An iterate.

    Args:
        first: y at the start of each panel, shape (n, 13).
        stages: y at the Gauss points, shape (n, n_points, 13).
        reactions: Of the joints, one after the other.
    """

    first: Array
    stages: Array
    reactions: Array


class Boundary(Protocol):
    """What must hold at a joint.

    Attributes:
        n_reactions: Number of its reactions.
    """

    @property
    def n_reactions(self) -> int: ...  # noqa: D102 (above)

    def residual(self, joined: Array, load: float) -> Array:
        """Zero where the joint is in order; analytic in `joined` = (y before, y after, reactions), shape (..., n)."""


def slope(y: Array, kappa: Array, force: Array, panels: Panels) -> Array:
    """y′ of the Simo–Reissner rod, shape (..., 13).

    r′ = R (e1 + C_n Rᵀ n), p′ = ½ p∘(0, κ₀ + C_m Rᵀ m), n′ = −f, m′ = −r′ × n.

    Args:
        y: State, shape (..., 13).
        kappa: Stress-free curvature there, shape (..., 3).
        force: Force per arc length there, shape (..., 3).
        panels: With the compliances.
    """
    p, n, m = y[..., 3:7], y[..., 7:10], y[..., 10:]
    back = p * (1.0, -1.0, -1.0, -1.0)
    r_s = rotated(p, E1 + panels.compliance_n * rotated(back, n))
    K = kappa + panels.compliance_m * rotated(back, m)
    p_s = 0.5 * product(p, np.concatenate([0.0 * K[..., :1], K], axis=-1))
    n_s = np.broadcast_to(-force, n.shape)
    return np.concatenate([r_s, p_s, n_s, -np.cross(r_s, n)], axis=-1)


def rotated(p: Array, v: Array) -> Array:
    """p∘v∘p*, shape (..., 3)."""
    w, u = p[..., :1], p[..., 1:]
    along = (u * v).sum(axis=-1, keepdims=True)
    return np.asarray((w * w - (u * u).sum(axis=-1, keepdims=True)) * v + 2.0 * (along * u + w * np.cross(u, v)))


def product(p: Array, q: Array) -> Array:
    """Quaternion product p∘q, shape (..., 4)."""
    a, u, b, v = p[..., :1], p[..., 1:], q[..., :1], q[..., 1:]
    return np.concatenate([a * b - (u * v).sum(axis=-1, keepdims=True), a * v + b * u + np.cross(u, v)], axis=-1)


def corrected(
    state: State, panels: Panels, joints: Sequence[Boundary], gauss: Gauss, load: float
) -> tuple[State, float]:
    """One Newton step.

    Panels are solved for their stages in terms of their starts first; what is left are the joints.

    Args:
        state: From which.
        panels: Between the joints.
        joints: One more than panels.
        gauss: Points of the panels.
        load: Factor of all loads.

    Returns:
        The next iterate and the largest change of any of its numbers.
    """
    last, by_first, own, stages_by_first = _condensed(state, panels, gauss, load)
    tangent, residual = _joined(state, last, by_first, joints, load)
    step = np.linalg.solve(tangent, -residual)
    n = len(panels.length)
    δ_first, δ_reactions = step[: SIZE * n].reshape(n, SIZE), step[SIZE * n :]
    δ_stages = own + np.einsum("pqab,pb->pqa", stages_by_first, δ_first)
    change = max(np.abs(step).max(), np.abs(δ_stages).max())
    moved = State(state.first + δ_first, state.stages + δ_stages, state.reactions + δ_reactions)
    return moved, float(change)


def _joined(state: State, last: Array, by_first: Array, joints: Sequence[Boundary], load: float) -> tuple[Array, Array]:
    """Residual of all joints and its derivative by the starts of the panels and the reactions."""
    n = len(state.first)
    counts = np.cumsum([0, *(joint.n_reactions for joint in joints)])
    rows, values = [], []
    for j, joint in enumerate(joints):
        before = last[j - 1] if j > 0 else np.zeros(SIZE)
        after = state.first[j] if j < n else np.zeros(SIZE)
        ρ = slice(counts[j], counts[j + 1])
        joined = np.concatenate([before, after, state.reactions[ρ]])
        value, by = _linearised(partial(joint.residual, load=load), joined)
        row = np.zeros((len(value), SIZE * n + counts[-1]))
        if j > 0:
            row[:, SIZE * (j - 1) : SIZE * j] = by[:, :SIZE] @ by_first[j - 1]
        if j < n:
            row[:, SIZE * j : SIZE * (j + 1)] = by[:, SIZE : 2 * SIZE]
        row[:, SIZE * n + ρ.start : SIZE * n + ρ.stop] = by[:, 2 * SIZE :]
        rows.append(row)
        values.append(value)
    return np.concatenate(rows), np.concatenate(values)


def _condensed(state: State, panels: Panels, gauss: Gauss, load: float) -> tuple[Array, Array, Array, Array]:
    """End of each panel and its derivative by the start; change of the stages, at a fixed start and by the start."""
    n, q = state.stages.shape[:2]
    h = panels.length[:, None, None]
    F, dF = _linearised(lambda y: slope(y, panels.kappa, load * panels.force, panels), state.stages)
    integrals = h * gauss.integrals
    tangent = np.eye(SIZE * q) - np.einsum("pij,pjab->piajb", integrals, dF).reshape(n, SIZE * q, SIZE * q)
    off = state.first[:, None] + integrals @ F - state.stages
    sides = np.concatenate(
        [off.reshape(n, SIZE * q, 1), np.broadcast_to(np.tile(np.eye(SIZE), (q, 1)), (n, SIZE * q, SIZE))], axis=2
    )
    solved = np.linalg.solve(tangent, sides).reshape(n, q, SIZE, SIZE + 1)
    own, by_first = solved[..., 0], solved[..., 1:]
    weighted = (h * gauss.weights[:, None])[..., None] * dF
    last = state.first + np.einsum("pqi,pqa->pa", h * gauss.weights[:, None], F)
    last = last + np.einsum("pqab,pqb->pa", weighted, own)
    return last, np.eye(SIZE) + np.einsum("pqab,pqbc->pac", weighted, by_first), own, by_first


def _linearised(f: Callable[[Array], Array], x: Array) -> tuple[Array, Array]:
    """f(x), shape (..., m), and its derivative, shape (..., m, n), for x of shape (..., n)."""
    n = x.shape[-1]
    steps = 1j * TINY * np.eye(n).reshape(n, *(1,) * (x.ndim - 1), n)
    moved = f(x + steps)
    return moved[0].real, np.moveaxis(moved.imag, 0, -1) / TINY
