"""How forces and couples of points in contact change with the few vectors on which they depend: see `acting`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.vectors import Point, across, added, crossed, dotted, row, scaled, turned_by

__all__ = ["GAP", "OPPOSITE", "RUBBING", "TURNS", "WAYS", "pressing", "rubbing"]

Array = NDArray[np.float64]

# Columns: X, its components; the coordinate v opposite; the gap at the end of a step; then Θ and Ψ, theirs.
OPPOSITE, GAP, WAYS, TURNS, RUBBING = 3, 4, 5, 8, 11
# Rows of what the normal follows: itself, and dx_B/dv as `Opposite` [m].
NORMAL, ALONG = range(2)
# Rows of how points slide: displacements from the anchors as `start` and `v` of `Slip` [m], traction [N/m].
START, AWAY, TRACTION = range(3)
# Rows of `Ways`.
TURNED, BOTH, BOTH_V, W_STEP, W_V = range(5)


@compiled
def _axis(q: int) -> Point:
    """Number q; none beyond the third."""
    return 1.0 if q == 0 else 0.0, 1.0 if q == 1 else 0.0, 1.0 if q == 2 else 0.0


@compiled
def _leans(q: int, n: Point, t: Point, closer: float, level: float) -> Point:
    """Change of the normal with column q."""
    if q == GAP:
        return 0.0, 0.0, 0.0
    return scaled(-closer, across(t, n)) if q == OPPOSITE else scaled(level * closer, across(_axis(q), n))


@compiled
def pressing(at: Array, D: Array, p: Array, slope: Array, length: Array, level: float, columns: int) -> Array:
    """Changes of p n times length.

    Args:
        at: What normals follow, shape (n, 2, 3).
        D: Distances [m].
        p: Line loads [N/m].
        slope: As `Pressed` [N/m²].
        length: Likewise [m].
        level: Part of the step at which the load acts.
        columns: `WAYS` where nothing rubs, or without a moment; else `RUBBING`, those by turns zero.

    Returns:
        Shape (n, 2, 3, columns), with room for those of the couple; (n, 1, 3, columns) where friction has none.
    """
    change = np.zeros((len(p), 2 if columns == RUBBING else 1, 3, columns))
    for i in range(len(p)):
        n, t, closer = row(at[i], NORMAL), row(at[i], ALONG), 1.0 / D[i] if D[i] > 0.0 else 0.0
        for q in range(WAYS):
            f = scaled(length[i] * p[i], _leans(q, n, t, closer, level))
            if q == GAP:
                f = scaled(length[i] * slope[i], n)
            change[i, 0, 0, q], change[i, 0, 1, q], change[i, 0, 2, q] = f
    return change


@compiled
def _resisted(r: Array, u: Point, p: float) -> Point:
    """Change of a traction with that of the displacement from the anchors and of the line load."""
    return (
        r[0, 0] * u[0] + r[0, 1] * u[1] + r[0, 2] * u[2] + r[0, 3] * p,
        r[1, 0] * u[0] + r[1, 1] * u[1] + r[1, 2] * u[2] + r[1, 3] * p,
        r[2, 0] * u[0] + r[2, 1] * u[1] + r[2, 2] * u[2] + r[2, 3] * p,
    )


@compiled
def _put(change: Array, i: int, q: int, W: float, n: Point, t: Point, n_q: Point, t_q: Point) -> None:
    """Add W t_q to column q of the force, and that of W n × t to that of the couple if there is any."""
    for j in range(3):
        change[i, 0, j, q] += W * t_q[j]
    if change.shape[1] > 1:
        c = added(crossed(n, t_q), -1.0, crossed(t, n_q))
        for j in range(3):
            change[i, 1, j, q] += W * c[j]


@compiled
def _five(a: Array, i: int) -> tuple[float, float, float, float, float]:
    return a[i, 0], a[i, 1], a[i, 2], a[i, 3], a[i, 4]


@compiled
def _drawn(q: int, n: Point, n_q: Point, ways: Array, arm: float, level: float) -> Point:
    """Change of the way w with column q, places only."""
    both = scaled(arm, row(ways, BOTH_V)) if q == OPPOSITE else scaled(0.5 * level * n[q], row(ways, BOTH))
    w_q = added(crossed(n, both), -1.0, crossed(row(ways, TURNED), n_q))
    return added(w_q, -1.0, row(ways, W_V)) if q == OPPOSITE else added(w_q, 1.0, _axis(q))


@compiled
def rubbing(
    at: Array, D: Array, way: Array, by: Array, numbers: Array, resists: Array, level: float, change: Array
) -> None:
    """Changes of the traction times length, and of the couple n × t.

    Args:
        at: As for `pressing`.
        D: Likewise.
        way: `Ways.vectors`.
        by: How points slide, shape (n, 3, 3).
        numbers: slope and length as `Pressed`, arm, share and share_gap as `Slip`, shape (n, 5).
        resists: Derivatives of the traction by the displacement from the anchors and by the line load, (n, 3, 4).
        level: As for `pressing`.
        change: What that gave; the traction is added.
    """
    for i in range(len(numbers)):
        n, t, v, ways, r = row(at[i], NORMAL), row(by[i], TRACTION), row(by[i], AWAY), way[i], resists[i]
        slope, W, arm, share, share_gap = _five(numbers, i)
        half, start, closer = scaled(0.5, row(ways, BOTH)), row(by[i], START), 1.0 / D[i] if D[i] > 0.0 else 0.0
        for q in range(WAYS):
            n_q, p_q = _leans(q, n, row(at[i], ALONG), closer, level), 0.0
            if q == GAP:
                V_q, p_q = scaled(share_gap, row(ways, W_STEP)), slope
            else:
                V_q = scaled(share, _drawn(q, n, n_q, ways, arm, level))
            if q == OPPOSITE:
                V_q = added(V_q, 0.5, turned_by(half, start, row(ways, BOTH_V)))
            u_q = added(across(added(V_q, -dotted(n, v), n_q), n), -dotted(v, n_q), n)
            _put(change, i, q, W, n, t, n_q, _resisted(r, u_q, p_q))
        for q in range(WAYS, change.shape[3]):
            u_q = scaled(share, crossed(n, _axis(q - WAYS)))
            if q >= TURNS:
                u_q = across(scaled(0.5, turned_by(half, start, _axis(q - TURNS))), n)
            _put(change, i, q, W, n, t, (0.0, 0.0, 0.0), _resisted(r, u_q, 0.0))
