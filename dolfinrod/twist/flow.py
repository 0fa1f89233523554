"""Twist that leaves through the exit plane while fibres are delivered."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist.angle import swept
from dolfinrod.twist.coarse import TooCoarse
from dolfinrod.twist.fibres import Fibres

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["Outflow", "outflow"]


@dataclass(frozen=True, eq=False)
class Outflow:
    """Twist of the strand that leaves.

    Args:
        t: Stored times, shape (n_t,) [s].
        turns: Delivered since the first, the mean of all pairs, positive for Z twist, shape (n_t,).
        T: Twist that leaves between neighbouring times, shape (n_t − 1,) [turns/m].
        speed: Of delivery [m/s].
    """

    t: Array
    turns: Array
    T: Array
    speed: float

    @property
    def mean(self) -> float:
        """Twist of all that has left [turns/m]."""
        return float(self.turns[-1] / (self.speed * (self.t[-1] - self.t[0])))


def outflow(t: ArrayLike, fibres: Sequence[ArrayLike], *, X: float, speed: float) -> Outflow:
    """Twist delivered through a plane that stands still, T_out = −(1/2πv) dθ/dt, the mean over all pairs.

    θ is the angle of a pair where it goes through the plane. What has left turns no more, so that the strand keeps,
    from place to place, the angles in which it left, the latest nearest to the plane: hence the sign. A rigid helix of
    T turns per metre that moves through along X delivers T.

    Args:
        t: Stored times, ascending, shape (n_t,) [s].
        fibres: Histories of two or more fibres, such as `h.r`, shapes (n_t, n_k, 3) [m].
        X: Of the plane [m].
        speed: v of delivery along X, positive [m/s].

    Returns:
        Turns and twist over time.

    Raises:
        TooCoarse: Two turn by a right angle or more about each other from one stored time to the next.
        ValueError: A fibre does not reach the plane, or turns back.
    """
    time, histories = np.asarray(t, dtype=float), [np.asarray(r, dtype=float) for r in fibres]
    if len(histories) < 2 or not speed > 0.0 or len(time) < 2 or np.any(np.diff(time) <= 0.0):
        raise ValueError(
            f"an outflow needs two or more fibres at ascending times and a positive speed, got {len(histories)} "
            f"fibre(s), {len(time)} time(s) and {speed} m/s"
        )
    place = np.stack([_through([r[i] for r in histories], X, time[i]) for i in range(len(time))], axis=1)
    k, l = np.triu_indices(len(histories), 1)
    d = place[:, :, l] - place[:, :, k]
    angle = swept(d[:, :-1], d[:, 1:])
    if np.abs(angle).max() >= 0.5 * np.pi:
        i, p = (int(index) for index in np.unravel_index(np.abs(angle).argmax(), angle.shape))
        raise TooCoarse(
            f"fibres {k[p]} and {l[p]} turn by {np.degrees(angle[i, p]):.0f} degrees in the plane X = {X} m from "
            f"t = {time[i]:.6g} to {time[i + 1]:.6g} s, too far to tell which way: store more states"
        )
    left = -angle.mean(axis=1) / (2.0 * np.pi)
    return Outflow(time, np.concatenate([[0.0], np.cumsum(left)]), left / (speed * np.diff(time)), speed)


def _through(fibres: list[Array], X: float, t: float) -> Array:
    """Where fibres go through a plane, shape (2, N) [m]."""
    all_of = Fibres.of(fibres)
    all_of.running_on(f"an outflow at t = {t:.6g} s")
    off = (all_of.start > X) | (all_of.end < X)
    if np.any(off):
        k = int(off.argmax())
        reach = f"from X = {all_of.start[k]:.6g} to {all_of.end[k]:.6g} m"
        raise ValueError(f"fibre {k} does not reach the plane X = {X} m at t = {t:.6g} s: it goes {reach}")
    return np.asarray(all_of.at(np.array([X]))[:, :, 0])
