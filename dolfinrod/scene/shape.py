"""Stress-free shapes with closed form: straight lines, arcs and helices, by one formula."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.quantity import Vector, VectorLike, assign, positive, vector

__all__ = ["Shape", "UniformCurvature", "orthonormal", "rotation_about_d1", "skew", "unit"]

Array = NDArray[np.float64]
ROUND_OFF = 8 * np.finfo(float).eps


@runtime_checkable
class Shape(Protocol):
    """A framed curve over arc length s: r(s) and R(s) = [d1 d2 d3] with r′ = d1 and R′ = R·skew(κ)."""

    @property
    def length(self) -> float:
        """Arc length from start to end [m]."""

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Interior s at which the curve is only piecewise smooth [m]."""

    def centerline(self, s: ArrayLike) -> Array:
        """Points r(s), shape (n, 3) [m]."""

    def frames(self, s: ArrayLike) -> Array:
        """Frames R(s), columns d1, d2, d3, shape (n, 3, 3)."""

    def curvature(self, s: ArrayLike) -> Array:
        """Twist and curvature κ(s) in the frame, shape (n, 3) [1/m]."""


@dataclass(frozen=True, init=False)
class UniformCurvature:
    """A curve of constant material curvature κ: line, arc or helix.

    R(s) = R(0)·exp(s·skew(κ)) and r(s) = r(0) + ∫ R(σ) e1 dσ in closed form.

    Args:
        length: Arc length [m].
        kappa: κ = (twist, about d2, about d3) in the frame [1/m].
        start: r(0) [m].
        direction: d1(0); given of any length, stored as unit vector.
        d2: d2(0); given of any length and not along `direction`, stored normal to it. None: z × d1, and y where d1 is
            along z.

    Raises:
        SceneError: A number that is not finite, a length that is not positive, a direction that is none.
    """

    length: float
    kappa: Vector
    start: Vector
    direction: Vector
    d2: Vector

    def __init__(
        self,
        length: float,
        *,
        kappa: VectorLike = (0.0, 0.0, 0.0),
        start: VectorLike = (0.0, 0.0, 0.0),
        direction: VectorLike = (1.0, 0.0, 0.0),
        d2: VectorLike | None = None,
    ) -> None:
        d1, across = orthonormal(direction, d2)
        assign(
            self,
            length=positive(length, "Rod.length", "m"),
            kappa=vector(kappa, "Rod.curvature", "1/m"),
            start=vector(start, "Rod.start", "m"),
            direction=vector(d1, "Rod.direction"),
            d2=vector(across, "Rod.d2"),
        )

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """None: the curve is analytic."""
        return ()

    def centerline(self, s: ArrayLike) -> Array:
        """Points on the helix.

        r = r₀ + s·R₀[sinc θ e1 + (1 − sinc θ)(u·e1) u + (1 − cos θ)/θ u×e1] with θ = |κ|s, u = κ/|κ|.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            r, shape (n, 3) [m].
        """
        s = np.asarray(s, dtype=float)[..., None]
        w, u = self._axis
        half = w * s / 2
        sinc = np.sinc(2 * half / np.pi)
        # (1 − cos θ)/θ written so that nothing cancels where θ is small.
        across = np.sin(half) * np.sinc(half / np.pi)
        local = sinc * np.eye(3)[0] + (1 - sinc) * u[0] * u + across * np.array([0.0, u[2], -u[1]])
        return np.array(self.start) + s * (local @ self._frame.T)

    def frames(self, s: ArrayLike) -> Array:
        """Frames by Rodrigues' formula, exp(θ skew(u)) = cos θ 1 + sin θ skew(u) + (1 − cos θ) u uᵀ.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            R, columns d1, d2, d3, shape (n, 3, 3).
        """
        w, u = self._axis
        θ = w * np.asarray(s, dtype=float)[..., None, None]
        turned = np.cos(θ) * np.eye(3) + np.sin(θ) * skew(u) + 2 * np.sin(θ / 2) ** 2 * np.outer(u, u)
        return self._frame @ turned

    def curvature(self, s: ArrayLike) -> Array:
        """The constant κ.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            κ, shape (n, 3) [1/m].
        """
        return np.tile(np.array(self.kappa), (*np.shape(s), 1))

    @cached_property
    def _axis(self) -> tuple[float, Array]:
        """|κ| and κ/|κ|; any axis where κ vanishes."""
        κ = np.array(self.kappa)
        w = float(np.linalg.norm(κ))
        return w, κ / w if w > 0.0 else np.eye(3)[0]

    @cached_property
    def _frame(self) -> Array:
        """R(0)."""
        return np.stack([self.direction, self.d2, np.cross(self.direction, self.d2)], axis=-1)


def orthonormal(direction: VectorLike, d2: VectorLike | None) -> tuple[Array, Array]:
    """Unit vectors d1 along `direction` and d2 across it; already orthonormal input returns unchanged.

    Args:
        direction: Any vector but zero.
        d2: Any vector not along `direction`; None: z × d1, and y where d1 is along z.

    Returns:
        d1 and d2, shape (3,) each.

    Raises:
        SceneError: A vector that is zero or not finite, or d2 along d1.
    """
    d1 = unit(direction, "Rod.direction")
    if d2 is None:
        # Within 1e-6 of z the horizontal direction z × d1 is only round-off of the input.
        upright = np.hypot(d1[0], d1[1]) <= 1e-6
        d2 = np.array([0.0, 1.0, 0.0]) if upright else np.array([-d1[1], d1[0], 0.0])
    across = unit(d2, "Rod.d2")
    if np.linalg.norm(np.cross(d1, across)) <= 1e-6:
        raise SceneError(f"must not be along the rod, got {d2!r}", field="Rod.d2")
    for _ in range(2):  # once more, for the digits the first projection loses where d2 leans towards d1
        along = float(across @ d1)
        if abs(along) > ROUND_OFF:
            across = unit(across - along * d1, "Rod.d2")
    return d1, across


def unit(v: VectorLike, field: str) -> Array:
    """v/|v|; a vector of unit length to round-off is left alone, so that what was written is read back exactly.

    Args:
        v: Any vector but zero.
        field: Its name, for the complaint.

    Returns:
        The unit vector, shape (3,).

    Raises:
        SceneError: A vector that is zero or not finite.
    """
    x = np.array(vector(v, field)) + 0.0  # no minus zeros
    largest = float(np.abs(x).max())
    if largest == 0.0:
        raise SceneError(f"must point somewhere, got {tuple(x.tolist())}", field=field)
    if abs(float(np.linalg.norm(x)) - 1.0) <= ROUND_OFF:
        return x
    x = x / largest  # neither overflow nor underflow in the squares
    return x / np.linalg.norm(x)


def rotation_about_d1(angle: ArrayLike) -> Array:
    """Rotations about the first axis.

    Args:
        angle: Angles, shape (n,) [rad].

    Returns:
        Matrices, shape (n, 3, 3).
    """
    c, s = np.cos(angle), np.sin(angle)
    one, o = np.ones_like(c), np.zeros_like(c)
    return np.stack([np.stack([one, o, o], -1), np.stack([o, c, -s], -1), np.stack([o, s, c], -1)], -2)


def skew(v: ArrayLike) -> Array:
    """Matrices of the cross product: v × a for every a.

    Args:
        v: Vectors, shape (n, 3).

    Returns:
        Matrices, shape (n, 3, 3).
    """
    x, y, z = np.moveaxis(np.asarray(v, dtype=float), -1, 0)
    o = np.zeros_like(x)
    return np.stack([np.stack([o, -z, y], -1), np.stack([z, o, -x], -1), np.stack([-y, x, o], -1)], -2)
