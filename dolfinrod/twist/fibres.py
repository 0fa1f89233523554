"""Fibres along the machine direction X, as polylines from A to B, and where they are at a given X."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist.polygon import checked, corners

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]
    Indices = NDArray[np.intp]

__all__ = ["Fibres", "between"]


@dataclass(frozen=True, eq=False)
class Fibres:
    """Polylines, each run through from that of its ends that lies nearer to A, the smaller X.

    Args:
        points: Of each fibre, shape (n_k, 3) [m].
        X: The same in a table, short fibres filled up with their last points, shape (N, n) [m].
        yz: Places across, y and z, shape (2, N, n) [m].
        monotone: Which of them never turn back along X, shape (N,).
    """

    points: tuple[Array, ...]
    X: Array
    yz: Array
    monotone: NDArray[np.bool_]

    @classmethod
    def of(cls, fibres: Sequence[ArrayLike] | Array) -> Fibres:
        """Put them side by side.

        Args:
            fibres: Points of each in order, one way or the other, shapes (n_k, 3) [m].

        Raises:
            ValueError: There is none, or one of them is no curve; its index is named.
        """
        points = tuple(_from_a(checked(r, f"fibre {k}")) for k, r in enumerate(fibres))
        if not points:
            raise ValueError("there must be at least one fibre, got none")
        most = max(map(len, points))
        table = np.stack([np.concatenate([r, np.repeat(r[-1:], most - len(r), axis=0)]) for r in points])
        rises = np.array([bool(np.all(np.diff(r[:, 0]) > 0.0)) for r in points])
        return cls(points, table[:, :, 0].copy(), np.moveaxis(table[:, :, 1:], 2, 0).copy(), rises)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def start(self) -> Array:
        """X of the ends at A, shape (N,) [m]."""
        return self.X[:, 0]

    @property
    def end(self) -> Array:
        """X of the ends at B, shape (N,) [m]."""
        return self.X[:, -1]

    @property
    def common(self) -> tuple[float, float]:
        """The stretch of X that all fibres share [m].

        Raises:
            ValueError: There is none.
        """
        low, high = float(self.start.max()), float(self.end.min())
        if not low < high:
            raise ValueError(f"fibres share no stretch of X: one begins at {low} m, another ends at {high} m")
        return low, high

    def shared(self, k: int, l: int) -> float:
        """Length of the stretch of X between the ends of two fibres [m].

        Raises:
            ValueError: There is none.
        """
        low, high = max(self.start[k], self.start[l]), min(self.end[k], self.end[l])
        if not low < high:
            raise ValueError(f"fibres {k} and {l} share no stretch of X: it would go from {low} to {high} m")
        return float(high - low)

    def running_on(self, asked: str) -> None:
        """Complain where one turns back.

        Args:
            asked: What needs fibres that do not.

        Raises:
            ValueError: Fibre and place are named.
        """
        for k in np.flatnonzero(~self.monotone):
            X = self.points[k][:, 0]
            first = int(np.argmax(np.diff(X) <= 0.0))
            raise ValueError(
                f"{asked} needs fibres that run along X, but fibre {k} turns back at X = {X[first]:.6g} m "
                f"(point {first}); pair windings take such fibres, too"
            )

    def at(self, X: Array) -> Array:
        """Where fibres that never turn back are at given X, shape (2, N, len(X)) [m]."""
        return np.array([[np.interp(X, r[:, 0], r[:, i]) for r in self.points] for i in (1, 2)])

    def polygon(self, k: int) -> Array:
        """Ends of its segments, none of length zero, shape (n, 3) [m]."""
        return corners(self.points[k], closed=False)


def _from_a(r: Array) -> Array:
    """A fibre given from B to A is turned round."""
    return r if r[0, 0] <= r[-1, 0] else r[::-1]


def between(X: Array, yz: Array, fibre: Indices, at: Array, index: Indices) -> Array:
    """Points on polylines, by the segments in which they lie; their last points beyond them.

    Args:
        X: Of the nodes of all, shape (N, n) [m].
        yz: Of the nodes of all, shape (2, N, n) [m].
        fibre: Which, shape (P,).
        at: Where, shape (P, m) [m].
        index: Of the segment, shape (P, m).

    Returns:
        Shape (2, P, m) [m].
    """
    node = (fibre[:, None] * X.shape[1] + index).ravel()
    ascent = np.diff(X, append=X[:, -1:] + 1.0)
    step = np.diff(yz, append=yz[:, :, -1:])
    slope = np.divide(step, ascent, out=np.zeros_like(step), where=ascent > 0.0).reshape(2, -1)
    along = np.minimum(at.ravel() - X.ravel().take(node), ascent.ravel().take(node))
    start, rise = yz.reshape(2, -1).take(node, axis=1), slope.take(node, axis=1)
    return np.asarray((start + rise * along).reshape(2, *at.shape))
