"""How much a ribbon, or a rod, is twisted about its own axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist.polygon import checked, same

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["frame_twist", "material_twist", "twist"]


def twist(r: ArrayLike, u: ArrayLike, *, closed: bool = False) -> float:
    """Twist of a ribbon, Tw = (1/2π) ∫ t·(u × du) of the unit normal u along r with tangent t.

    On a polygon: the normal part of u on each segment, carried over each corner without twist (by the smallest turn
    from one tangent to the next), and its angle to that of the next segment. So Tw + Wr of a closed polygon is a whole
    number to round-off, however coarse it is.

    Args:
        r: Points in order, shape (n, 3) [m].
        u: From one edge of the ribbon to the other at each, of any length, nowhere along the curve, shape (n, 3).
        closed: Whether a last segment leads back to the first point, which may be listed again at the end or not.

    Returns:
        Turns, positive where the ribbon is right-handed.

    Raises:
        ValueError: The curve stands still, or u lies along it.
    """
    points, across = checked(r), checked(u, "the vectors across a ribbon")
    if len(points) != len(across):
        raise ValueError(f"a ribbon has a vector at every point, got {len(across)} at {len(points)} points")
    if closed:
        once = slice(None, -1 if same(points[-1], points[0], points) else None)
        points, across = points[once], across[once]
        points, across = (np.concatenate([a, a[:1]]) for a in (points, across))
    e = np.diff(points, axis=0)
    length = np.linalg.norm(e, axis=1)
    if length.min() == 0.0:
        raise ValueError(f"the curve stands still: points {int(length.argmin())} and the next are the same")
    t = e / length[:, None]
    u_mid = _normal(across[1:] + across[:-1], t)
    before, after = (np.arange(len(t)), np.roll(np.arange(len(t)), -1)) if closed else (slice(None, -1), slice(1, None))
    angle = _angle(_carried(u_mid[before], t[before], t[after]), u_mid[after], t[after]).sum()
    if not closed:
        # From the first point to the middle of its segment, and from that of the last to its end.
        angle += _angle(_normal(across[:1], t[:1]), u_mid[:1], t[:1]).sum()
        angle += _angle(u_mid[-1:], _normal(across[-1:], t[-1:]), t[-1:]).sum()
    return float(angle) / (2.0 * np.pi)


def _normal(u: Array, t: Array) -> Array:
    """Unit vectors along the parts of u normal to t."""
    part = u - np.einsum("ni,ni->n", u, t)[:, None] * t
    size, whole = np.linalg.norm(part, axis=1), np.linalg.norm(u, axis=1)
    if np.any(size <= 1e-12 * whole):
        raise ValueError(
            f"the vector across the ribbon lies along it near point {int(np.argmin(size - 1e-12 * whole))}"
        )
    return np.asarray(part / size[:, None])


def _carried(u: Array, t: Array, onto: Array) -> Array:
    """Vectors normal to t turned by the smallest rotation that takes t onto other tangents."""
    opposite = 1.0 + np.einsum("ni,ni->n", t, onto)
    if opposite.min(initial=2.0) <= 1e-12:
        raise ValueError(f"the curve turns back on itself at corner {int(opposite.argmin()) + 1}")
    return np.asarray(u - (np.einsum("ni,ni->n", u, onto) / opposite)[:, None] * (t + onto))


def _angle(a: Array, b: Array, t: Array) -> Array:
    """From a to b about t, both normal to it [rad]."""
    return np.asarray(np.arctan2(np.einsum("ni,ni->n", t, np.cross(a, b)), np.einsum("ni,ni->n", a, b)))


def frame_twist(frames: ArrayLike) -> float:
    """Twist of section frames, (1/2π) ∫ κ₁ ds with κ₁ from each frame to the next, exact where κ is constant.

    Args:
        frames: Columns d1 (section normal), d2, d3, shape (n, 3, 3), such as `result.rods[0].frames[-1]`.

    Returns:
        Turns about d1, that of the rod without stress included.

    Raises:
        ValueError: Two frames are half a turn or more apart.
    """
    R = np.asarray(frames, dtype=float)
    Q = np.einsum("nji,njk->nik", R[:-1], R[1:])
    axial = np.stack([Q[:, 2, 1] - Q[:, 1, 2], Q[:, 0, 2] - Q[:, 2, 0], Q[:, 1, 0] - Q[:, 0, 1]], axis=1)
    sine, cosine = 0.5 * np.linalg.norm(axial, axis=1), 0.5 * (np.trace(Q, axis1=1, axis2=2) - 1.0)
    angle = np.arctan2(sine, cosine)
    if angle.max(initial=0.0) > 0.9 * np.pi:
        raise ValueError(f"frames {int(angle.argmax())} and the next are half a turn apart: give more of them")
    # The rotation vector is angle/sine times the axial vector, 1 where nothing turns.
    factor = np.divide(angle, sine, out=np.ones_like(angle), where=sine > 1e-8)
    return float((0.5 * factor * axial[:, 0]).sum()) / (2.0 * np.pi)


def material_twist(s: ArrayLike, kappa: ArrayLike) -> float:
    """A rod's own twist strain, (1/2π) ∫ κ₁ ds by trapezoids, as of `result.rods[0]`: `s`, `kappa[-1]`.

    Args:
        s: Arc length of the nodes, ascending, shape (n,) [m].
        kappa: Twist and curvature strain, section frame, shape (n, 3) [1/m].

    Returns:
        Turns, without those of the rod without stress.
    """
    along, κ1 = np.asarray(s, dtype=float), np.asarray(kappa, dtype=float)[:, 0]
    return float(np.diff(along) @ (κ1[1:] + κ1[:-1])) / (4.0 * np.pi)
