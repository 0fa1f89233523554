"""Bundles that their loads squeeze in a V groove: one rod at its bottom, others leaning on it along both flanks."""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Contact, Guide, LineForce, Penalty, Plane, Rod, RodContact, Scene
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, RADIUS, SPACE, THIN, on_meshes
from verification.references.bundle import Heap, Settled, Vee
from verification.references.moving import Moving

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "LAW", "LENGTH", "bundle_case", "loads_found", "rods_at", "vee"]

LAW = Penalty(1e4, 1e-3)
LENGTH = 1.0
# Nothing but round-off: what is even is so on any mesh.
EVEN = 1e-8


def rods_at(centres: Array, length: float = LENGTH) -> list[Rod]:
    """Rods along x through points (z, y) of the plane across."""
    return [Rod.straight(length, THIN, start=(0.0, float(y), float(z))) for z, y in centres]


def vee(heap: Vee) -> Scene:
    """Rods where rigid ones would lie, each under its load; they move across freely."""
    c, s = cos(heap.slope), sin(heap.slope)
    planes = [Plane((0.0, 0.0, 0.0), (0.0, c, -s)), Plane((0.0, 0.0, 0.0), (0.0, c, s))]
    return Scene(
        rods=rods_at(heap.centres),
        supports=[Guide("start", free=("y", "z", "ry", "rz"))],
        loads=[LineForce((0.0, -heap.load, 0.0))],
        contacts=[*(Contact(plane, LAW) for plane in planes), RodContact(LAW)],
    )


def loads_found(result: Result, links: tuple[tuple[int, int], ...], length: float = LENGTH) -> Array:
    """Line load of every wall on every rod, then between the rods that are neighbours."""
    walls = [one.pressure[-1] @ one.share for contact in result.contacts for one in contact.rods if one is not None]
    pairs = [np.linalg.norm(result.meetings[0].force(-1, a, b)) for a, b in links]
    return np.array([*walls, *pairs]) / length


def settled(heap: Vee) -> Settled:
    """The circles by the same law."""
    n = 1 + heap.right + heap.left
    springs = Heap(
        np.full(n, heap.radius),
        np.tile([0.0, -heap.load], (n, 1)),
        np.zeros((2, 2)),
        heap.flanks,
        LAW.eps_N,
        LAW.eps_N,
        LAW.g_0,
    )
    return springs.settled(heap.centres)


def bundle_case(name: str, title: str, family: str, heap: Vee) -> ContactCase:
    """By both models on few and on many elements."""
    rest = settled(heap)
    links = neighbours(heap)
    value = (*rest.walls.T.ravel().tolist(), *(float(rest.pairs[a, b]) for a, b in links))
    return ContactCase(
        name=name,
        title=title,
        family=family,
        reference=Moving(
            id="circles in a V by springs of the same law",
            value=value,
            method="Newton's method in their centres; tends to N = q cos β, n q sin β, closed form, as 1/ε_N",
            source="verification/references/bundle.py",
            digits_trusted=10,
        ),
        scale=max(value),
        runs=(
            on_meshes(SPACE, vee(heap), (1, 6), limit=EVEN, quick=True),
            on_meshes(DISCRETE, vee(heap), (5, 10, 20), limit=1e-3, quick=True),
        ),
        quantity="line load of the right flank on each rod, of the left one, between neighbours; N/m",
        read=partial(loads_found, links=links),
    )


def neighbours(heap: Vee) -> tuple[tuple[int, int], ...]:
    """Pairs that lean on each other, the lower first."""
    right = [0, *range(1, heap.right + 1)]
    left = [0, *range(heap.right + 1, heap.right + heap.left + 1)]
    return tuple((a, b) for chain in (right, left) for a, b in pairwise(chain))


def _vee(degrees: float, right: int, left: int) -> Vee:
    return Vee(float(np.radians(degrees)), 1.0, right, left, RADIUS)


CASES = (
    bundle_case("bundle-2-45", "Two rods in a V, flanks of 45°", "groove bundle", _vee(45.0, 1, 0)),
    bundle_case("bundle-2-15", "Two rods in a V, flanks of 15° as of the paper", "groove bundle", _vee(15.0, 1, 0)),
    bundle_case("bundle-3-45", "Three rods in a V, flanks of 45°", "groove bundle", _vee(45.0, 1, 1)),
    bundle_case("pile-v", "Five rods in a V, flanks of 30°, chains of two", "pile", _vee(30.0, 2, 2)),
)
