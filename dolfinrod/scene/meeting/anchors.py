"""Where friction holds points in contact, remembered from step to step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Spans, dot
from dolfinrod.scene.meeting.pressed import Pressed
from dolfinrod.scene.meeting.spots import GAUSS, MOST_POINTS

__all__ = ["Anchors", "keys", "matched"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]

# Points of a spot between two marks.
PLACES = len(GAUSS[0])


def keys(spans: Spans, pressed: Pressed) -> Integers:
    """A number for each point by its span, the rod opposite and its place in the spot, shape (n,)."""
    return np.asarray((pressed.a * len(spans.radius) + spans.rod[pressed.b]) * MOST_POINTS + pressed.index)


def matched(keys: Integers, known: Integers) -> tuple[Integers, Flags]:
    """Where keys are among known ones, the first of equals, and whether they are, each of shape (n,)."""
    if not len(known):
        return np.zeros(len(keys), dtype=np.intp), np.zeros(len(keys), dtype=bool)
    order = np.argsort(known, kind="stable")
    at = order[np.minimum(np.searchsorted(known, keys, sorter=order), len(known) - 1)]
    return at, known[at] == keys


@dataclass(frozen=True, eq=False)
class Anchors:
    """Displacements from anchors, one row a point that was in contact.

    They belong to the spot of contact, not to the material: a spot that moves along takes them with it.

    Args:
        key: As `keys` gives them, shape (n,).
        pair: Number of the pair of rods.
        s_a: Arc length on the one rod [m].
        s_b: On the other [m].
        length: For which the point stands [m].
        u: Displacement, shape (n, 3) [m].
    """

    key: Array
    pair: Array
    s_a: Array
    s_b: Array
    length: Array
    u: Array

    @classmethod
    def none(cls) -> Anchors:
        """No point."""
        none = np.zeros(0)
        return cls(none, none, none, none, none, np.zeros((0, 3)))

    @classmethod
    def left(cls, spans: Spans, pressed: Pressed, u: Array) -> Anchors:
        """What a step leaves behind."""
        pair = spans.rod[pressed.a] * len(spans.radius) + spans.rod[pressed.b]
        s_a, s_b = spans.along(pressed.a, pressed.u), spans.along(pressed.b, pressed.v)
        return cls(keys(spans, pressed).astype(float), pair.astype(float), s_a, s_b, pressed.length, u)

    @classmethod
    def remembered(cls, spans: Spans, memory: Mapping[str, Array], mine: Flags) -> Anchors:
        """Those of spans that are looked at here, shape (n_spans,)."""
        key = memory["key"].astype(np.intp)
        here = mine[key // (MOST_POINTS * len(spans.radius))]
        return cls(*(memory[field.name][here] for field in fields(cls)))

    def memory(self) -> dict[str, Array]:
        """One row a point."""
        return {field.name: getattr(self, field.name).copy() for field in fields(self)}

    def energy(self, ε_T: float) -> float:
        """Stored in them [J]."""
        return float(0.5 * ε_T * self.length @ dot(self.u, self.u))

    def of(self, spans: Spans, pressed: Pressed) -> Array:
        """What points inherit, shape (n, 3) [m].

        From the same place of the same spot, or of that nearest of the same pair of rods if it is no further than a
        span: so a spot hands over to the next span what it leaves there. Where a point stands for more length than
        before, the rest is fresh: no energy comes from nowhere.

        Args:
            spans: The rods.
            pressed: Points in contact.

        Returns:
            Displacements from their anchors.
        """
        u = np.zeros((len(pressed.a), 3))
        if not len(self.key):
            return u
        known = self.key.astype(np.intp)
        at, found = matched(keys(spans, pressed), known)
        lost = np.flatnonzero(~found)
        if len(lost):
            near, found[lost] = self._nearest(spans, pressed, lost)
            alike, there = matched(known[near] // PLACES * PLACES + pressed.index[lost] % PLACES, known)
            at[lost] = np.where(there, alike, near)
        at, kept = at[found], np.flatnonzero(found)
        u[kept] = self.u[at] * self._shares(keys(spans, pressed)[kept], pressed.length[kept], at)[:, None]
        return u

    def _shares(self, key: Integers, length: Array, at: Integers) -> Array:
        """What points keep of the anchors that they inherit, shape (n,).

        A spot may lie on both halves of a span, and go from one to the other: what counts is the length of both.
        """
        _, spot = np.unique(np.concatenate([key, self.key.astype(np.intp)]) // MOST_POINTS, return_inverse=True)
        now, before, n = spot[: len(key)], spot[len(key) :], int(spot.max()) + 1
        long, was = np.bincount(now, length, n), np.bincount(before, self.length, n)
        share = np.minimum(1.0, was[before[at]] / long[now])
        # Where halves are displaced differently, what the larger of them would win is taken from both.
        held, square = before[at] == now, dot(self.u, self.u)
        won = np.bincount(now[held], (length * share**2 * square[at])[held], n)
        had = np.bincount(before, self.length * square, n)
        grown = np.sqrt(np.divide(had, won, out=np.ones(n), where=won > had))
        return np.asarray(np.where(held, share * grown[now], share))

    def _nearest(self, spans: Spans, pressed: Pressed, lost: Integers) -> tuple[Integers, Flags]:
        a, b = pressed.a[lost], pressed.b[lost]
        s_a, s_b = spans.along(a, pressed.u[lost]), spans.along(b, pressed.v[lost])
        pair = spans.rod[a] * len(spans.radius) + spans.rod[b]
        apart = 2.0 * (spans.s + spans.length).max()
        order = np.argsort(self.pair * apart + self.s_a)
        places = (self.pair * apart + self.s_a)[order]
        after = np.clip(np.searchsorted(places, pair * apart + s_a), 1, max(len(places) - 1, 1))
        beside = order[np.minimum(np.stack([after - 1, after]), len(places) - 1)]
        far = np.where(self.pair[beside] == pair, np.abs(self.s_a[beside] - s_a), np.inf)
        nearer = far.argmin(axis=0)
        at, far = beside[nearer, np.arange(len(lost))], far.min(axis=0)
        return at, (far <= spans.length[a]) & (np.abs(self.s_b[at] - s_b) <= spans.length[b])
