"""Traction of points that rub on a wall at rest, and how it changes with where they are and how they turn.

All vectors are in the axes of the wall, one row a point.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.sliding import lever_slopes, mapped, slip_slopes, traction_slopes

__all__ = [
    "Pressed",
    "Rubbing",
    "Step",
    "cross",
    "rubbed",
    "rubbing_slopes",
    "skew",
    "slip_gradients",
    "traction_gradient",
]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Pressed:
    """Points in contact.

    Args:
        p: Line load, shape (n,) [N/m].
        p_X: ∂p/∂X, shape (n, 3).
        n: Normals, shape (n, 3).
        n_X: ∂n/∂X, shape (n, 3, 3).
        radius: Lever arm of the traction: that of the rods, or none, shape (n,) [m].
        expected: Line load under which the normals turn, p but for an iterate, shape (n,) [N/m].
    """

    p: Array
    p_X: Array
    n: Array
    n_X: Array
    radius: Array
    expected: Array

    def gradient(self) -> Array:
        """∂(p n)/∂X, shape (n, 3, 3)."""
        return self.n[:, :, None] * self.p_X[:, None, :] + self.expected[:, None, None] * self.n_X


@dataclass(frozen=True, eq=False)
class Rubbing:
    """What rubs.

    Args:
        traction: Shape (n, 3) [N/m].
        anchored: Displacement from the anchors, shape (n, 3) [m].
        slipped: Way of the anchors in the step under pressure, shape (n,) [m].
        u: Displacement from where the anchors were, shape (n, 3) [m].
        slides: Whether the anchors moved, shape (n,).
        forced: Whether any was kept from it, or made to, which no equilibrium does.
    """

    traction: Array
    anchored: Array
    slipped: Array
    u: Array
    slides: NDArray[np.bool_]
    forced: bool


@dataclass(frozen=True, eq=False)
class Step:
    """Where a step has led.

    Args:
        X: All points, shape (n, 3) [m].
        turned: Turn of their sections against the wall, shape (n, 3) [rad].
        gap: Shape (n,) [m].
        normal: Of the wall at all points, shape (n, 3).
        on: Numbers of those that touch, shape (m,).
        pressed: These.
        share: Part of the step over which they did, shape (m,).
        w: Way of the rods' surface past the wall in the step, shape (m, 3) [m].
        v: Displacement from their anchors, shape (m, 3) [m].
        rubbing: None where nothing sticks.
    """

    X: Array
    turned: Array
    gap: Array
    normal: Array
    on: NDArray[np.intp]
    pressed: Pressed
    share: Array
    w: Array
    v: Array
    rubbing: Rubbing | None


def rubbed(pressed: Pressed, v: Array, μ: float, ε_T: float, clings: Flags, glides: Flags, slid: Array) -> Rubbing:
    """Return mapping: the anchors follow where they would pull harder than μ p.

    In an iteration a point that slid one way does not slide back before it was seen what it does if it sticks: between
    the two ways the slope of sliding, which is none, tells Newton's method nothing. The pressure of an iterate may be
    below zero; friction follows it there, so that its slope is true.

    Args:
        pressed: The points.
        v: Displacement of the rods' surface from the anchors, its part along the normal included, shape (n, 3).
        μ: Coefficient of friction.
        ε_T: Stiffness of the anchors [N/m²].
        clings: Points whose anchors stay however hard they pull, shape (n,).
        glides: Points whose anchors follow however little they pull, shape (n,).
        slid: u in the last answer of those that slid, zero for others, shape (n, 3) [m].

    Returns:
        Tractions and where the anchors are.
    """
    return Rubbing(*mapped(pressed.p, pressed.n, v, μ, ε_T, clings, glides, slid))


def traction_gradient(pressed: Pressed, rubbing: Rubbing, u_q: Array, μ: float, ε_T: float) -> Array:
    """∂t/∂q where q moves u and the pressure, shape (n, 3, m).

    Args:
        pressed: The points; p_X is ∂p/∂q here, shape (n, m).
        rubbing: What rubs.
        u_q: ∂u/∂q, shape (n, 3, m).
        μ: Coefficient of friction.
        ε_T: Stiffness of the anchors.

    Returns:
        The derivative.
    """
    return np.asarray(traction_slopes(pressed.p, pressed.p_X, rubbing.u, rubbing.slides, u_q, μ, ε_T))


def slip_gradients(step: Step, start: Array, g_0: float) -> tuple[Array, Array]:
    """Derivatives of the displacement u from the anchors.

    u = P v, v = u₀ + share (X − X₀ − r Ψ × n), P = 1 − n⊗n.

    Args:
        step: Where it is.
        start: Gaps where the step began, shape (m,).
        g_0: Gap at which contact begins.

    Returns:
        ∂u/∂X and ∂u/∂Ψ, shapes (m, 3, 3).
    """
    p, on = step.pressed, step.on
    along = (step.share, step.w, step.v, step.gap[on], start, g_0)
    u_X, u_turn = slip_slopes(step.turned[on], p.n, p.n_X, p.radius, p.p_X, *along)
    return u_X, u_turn


def rubbing_slopes(step: Step, start: Array, g_0: float, μ: float, ε_T: float) -> tuple[Array, Array, Array, Array]:
    """Derivatives of tractions and of their moments; arguments as for `slip_gradients` and `traction_gradient`.

    Returns:
        ∂t/∂X, ∂t/∂Ψ, ∂m/∂X and ∂m/∂Ψ, shapes (m, 3, 3).
    """
    assert step.rubbing is not None
    pressed, (u_x, u_turn) = step.pressed, slip_gradients(step, start, g_0)
    still = replace(pressed, p_X=np.zeros_like(pressed.p_X))
    t_x = traction_gradient(pressed, step.rubbing, u_x, μ, ε_T)
    t_turn = traction_gradient(still, step.rubbing, u_turn, μ, ε_T)
    lever = pressed.radius, step.rubbing.traction
    m_x = lever_slopes(pressed.n, pressed.n_X, *lever, t_x)
    return t_x, t_turn, m_x, lever_slopes(pressed.n, np.zeros_like(m_x), *lever, t_turn)


def cross(a: Array, b: Array) -> Array:
    """a × b, shape (n, 3); NumPy's own takes ten times as long on the few hundred points of a rod."""
    c = np.empty_like(a)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        c[:, i] = a[:, j] * b[:, k] - a[:, k] * b[:, j]
    return c


def skew(a: Array) -> Array:
    """Matrices of a × ·, shape (n, 3, 3)."""
    matrices = np.zeros((*a.shape, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        matrices[:, i, j], matrices[:, j, i] = -a[:, k], a[:, k]
    return matrices
