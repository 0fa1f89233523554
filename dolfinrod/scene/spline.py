"""Stress-free shape along a smooth curve through points."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import VectorLike, assign, vector
from dolfinrod.scene.shape import orthonormal, rotation_about_d1, skew

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

__all__ = ["Spline"]

Array = NDArray[np.float64]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
ROUND_OFF = 1e-13
MAX_HALVINGS = 20
# The curve through so many is integrated within seconds.
MOST_POINTS = 10_000


@dataclass(frozen=True)
class Spline:
    """The twice continuously differentiable cubic through points, framed without twist.

    The cubic c(u) runs over chord length u (ends: not-a-knot; two points make a line, three a parabola). Arc length
    s = ∫|c′|du and the angle of the twist-free frame are integrated by Gauss's rule on panels short enough for
    round-off accuracy; u(s) follows by Newton's method.

    From the start u₀ of a panel to u, the smallest rotation P that carries the tangent t₀ to t twists at the rate
    −(t₀×t)·t′/(1 + t₀·t); the frame without twist is therefore R = P·R₀·Rot₁(φ), φ = ∫(t₀×t)·t′/(1 + t₀·t)du.
    No differential equation is stepped, and d1 is the tangent exactly.

    Args:
        points: At least two, each different from the one before, shape (n_p, 3) [m].
        d2: d2 at the start, of any length and not along the curve; None: z × d1, and y where d1 is along z.

    Raises:
        SceneError: Fewer than two or more than 10 000 points, one twice in a row, or a curve that turns back on
            the spot.
    """

    points: Sequence[VectorLike] | Array
    d2: VectorLike | None = None

    def __post_init__(self) -> None:
        given = self.points if isinstance(self.points, Iterable) else ()
        points = tuple(vector(p, f"Rod.points[{i}]", "m") for i, p in enumerate(given))
        if len(points) < 2:
            raise SceneError(f"must be at least two points [m], got {quoted(self.points)}", field="Rod.points")
        if len(points) > MOST_POINTS:
            raise SceneError(f"must be at most {MOST_POINTS}, got {len(points)}", field="Rod.points")
        chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
        for i in np.flatnonzero(chords <= 1e-12 * chords.sum()) + 1:
            raise SceneError(f"must lie apart from the point before, got {points[i]} m", field=f"Rod.points[{i}]")
        assign(self, points=points, d2=None if self.d2 is None else vector(self.d2, "Rod.d2"))
        self.frames(0.0)  # builds the curve, so that its faults are told here

    @property
    def length(self) -> float:
        """Arc length from the first to the last point [m]."""
        return float(self._panels[1][-1])

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Arc lengths of the interior points, where the third derivative jumps [m]."""
        u, s, _ = self._panels
        return tuple(float(x) for x in s[np.searchsorted(u, self._cubic.x[1:-1])])

    def centerline(self, s: ArrayLike) -> Array:
        """Points c(u(s)).

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            r, shape (n, 3) [m].
        """
        return np.asarray(self._cubic(self._parameter(s)[1]))

    def frames(self, s: ArrayLike) -> Array:
        """Frames without twist, carried along from the start.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            R, columns d1, d2, d3, shape (n, 3, 3).
        """
        panel, u = self._parameter(s)
        start = self._panels[0][panel]
        carried = smallest_rotation(self._tangent(start)[0], self._tangent(u)[0])
        return carried @ self._panel_frames[panel] @ rotation_about_d1(self._integrals(start, u)[1])

    def curvature(self, s: ArrayLike) -> Array:
        """Curvature κ = (0, −d1′·d3, d1′·d2); the twist is zero by construction.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            κ, shape (n, 3) [1/m].
        """
        _, tangent_u, speed = self._tangent(self._parameter(s)[1])
        along = np.einsum("...i,...ij->...j", tangent_u / speed[..., None], self.frames(s))
        return np.stack([np.zeros_like(speed), -along[..., 2], along[..., 1]], axis=-1)

    @cached_property
    def _cubic(self) -> CubicSpline:
        """c(u), u the chord length from the first point."""
        from scipy.interpolate import CubicSpline

        points = np.array(self.points)
        chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
        return CubicSpline(np.append(0.0, np.cumsum(chords)), points)

    @cached_property
    def _panels(self) -> tuple[Array, Array, Array]:
        """Parameters and arc lengths of the panels' ends, and the angle φ gained on each panel."""
        u = self._cubic.x
        for _ in range(MAX_HALVINGS):
            start, stop = u[:-1], u[1:]
            middle = (start + stop) / 2
            with np.errstate(divide="ignore", invalid="ignore"):  # a cusp gives nan, and so never agrees
                s, angle = self._integrals(start, stop)
                halves = np.add(self._integrals(start, middle), self._integrals(start, stop, since=middle))
            agree = (np.abs(halves[0] - s) <= ROUND_OFF * s) & (np.abs(halves[1] - angle) <= ROUND_OFF)
            if agree.all():
                return u, np.append(0.0, np.cumsum(s)), angle
            u = np.sort(np.append(u, middle[~agree]))
        raise SceneError("must lead along a smooth curve, got points that turn back on the spot", field="Rod.points")

    @cached_property
    def _panel_frames(self) -> Array:
        """Frames at the panels' ends, shape (n, 3, 3)."""
        u, _, angle = self._panels
        t = self._tangent(u)[0]
        d1, across = orthonormal(t[0], self.d2)
        frames = [np.stack([d1, across, np.cross(d1, across)], axis=-1)]
        for carry, spin in zip(smallest_rotation(t[:-1], t[1:]), rotation_about_d1(angle), strict=True):
            frames.append(carry @ frames[-1] @ spin)
        # Round-off of many products is taken out: d1 is the tangent again, d2 normal to it.
        d2 = np.array(frames)[..., 1]
        d2 -= np.sum(d2 * t, axis=-1, keepdims=True) * t
        d2 /= np.linalg.norm(d2, axis=-1, keepdims=True)
        return np.stack([t, d2, np.cross(t, d2)], axis=-1)

    def _parameter(self, s: ArrayLike) -> tuple[NDArray[np.intp], Array]:
        """Panel and parameter u of arc length s, by Newton's method on s(u)."""
        ends, lengths, _ = self._panels
        s = np.asarray(s, dtype=float)
        panel = np.clip(np.searchsorted(lengths, s, side="right") - 1, 0, ends.size - 2)
        ahead = s - lengths[panel]
        start = ends[panel]
        u = start + (ends[panel + 1] - start) * ahead / (lengths[panel + 1] - lengths[panel])
        # Within a panel 16 Gauss points see |c′| to round-off, so it varies little: five steps are the rule.
        for _ in range(20):
            step = (self._integrals(start, u)[0] - ahead) / self._tangent(u)[2]
            u = u - step
            if np.all(np.abs(step) <= 4 * np.finfo(float).eps * ends[-1]):
                break
        return panel, u

    def _integrals(self, start: Array, stop: Array, since: Array | None = None) -> tuple[Array, Array]:
        """Arc length ∫|c′|du and angle φ from `since` (None: `start`) to `stop`, t₀ the tangent at `start`."""
        a = start if since is None else since
        half = (stop - a) / 2
        t, t_u, speed = self._tangent(a[..., None] + half[..., None] * (1 + NODES))
        t_0 = self._tangent(start)[0][..., None, :]
        spin = np.sum(np.cross(t_0, t) * t_u, axis=-1) / (1 + np.sum(t_0 * t, axis=-1))
        return half * (speed @ WEIGHTS), half * (spin @ WEIGHTS)

    def _tangent(self, u: Array) -> tuple[Array, Array, Array]:
        """Unit tangent t, its derivative t′ = (c″ − (c″·t)t)/|c′| and the speed |c′| by u."""
        c_u, c_uu = self._cubic(u, 1), self._cubic(u, 2)
        speed = np.linalg.norm(c_u, axis=-1)
        t = c_u / speed[..., None]
        return t, (c_uu - np.sum(c_uu * t, axis=-1, keepdims=True) * t) / speed[..., None], speed


def smallest_rotation(a: Array, b: Array) -> Array:
    """Rotations about a × b that carry unit vectors a to b, 1 + skew(a×b) + skew(a×b)²/(1 + a·b).

    Args:
        a: Unit vectors, shape (n, 3).
        b: Unit vectors, none opposite to its partner in a, shape (n, 3).

    Returns:
        Matrices, shape (n, 3, 3).
    """
    v = skew(np.cross(a, b))
    return np.eye(3) + v + v @ v / (1 + np.sum(a * b, axis=-1))[..., None, None]
