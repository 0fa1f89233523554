"""Deformed centrelines by both models over the stress-free one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from verification.case import UPRIGHT
from verification.models import Continuum, Discrete, natural

if TYPE_CHECKING:
    from dolfinrod.result import RodHistory
    from verification.case import Array, Case, Vector
    from verification.models import Model

__all__ = ["MESHES", "Shape", "shapes"]

# Elements a turn: quartic ones whose nodes draw a smooth line, chords that the eye can tell apart.
MESHES = {"continuum": 10, "discrete": 40}
# A quantity within this distance of a node is the place of that node [length of the case].
ON_THE_ROD = 1e-9
# Strokes of a rod that is not bent in its plane, their number and length [length of the case].
RIBS, RIB = 20, 0.05


@dataclass(frozen=True)
class Shape:
    """What is drawn of a case: one line a rod.

    Args:
        case: Its name.
        stress_free: Centrelines before anything acts, shapes (n, 3) [m].
        continuum: The continuum model's, empty where it did not converge [m].
        discrete: The discrete model's, empty where it does not pose the problem or did not converge [m].
        ribs: Short strokes along d2 of the continuum's sections, which show twist; none in plane problems [m].
        reference: Where the reference puts the quantity, if the quantity is a place on the rod [m].
    """

    case: str
    stress_free: tuple[Array, ...]
    continuum: tuple[Array, ...]
    discrete: tuple[Array, ...]
    ribs: tuple[Array, ...]
    reference: Vector | None


def shapes(case: Case) -> Shape:
    """Solve a case for its picture.

    Args:
        case: Any.

    Returns:
        Its lines.
    """
    lines: dict[str, tuple[Array, ...]] = {"continuum": (), "discrete": ()}
    stress_free: tuple[Array, ...] = ()
    ribs: tuple[Array, ...] = ()
    reference = None
    models: tuple[Model, ...] = (Continuum(4, natural(case)), Discrete())
    for model in models:
        if not model.applies_to(case):
            continue
        try:
            result = model.solve(case.scene(UPRIGHT), MESHES[model.family] * case.turns)
        except NotConverged:
            continue
        lines[model.family] = tuple(rod.r[-1] for rod in result.rods)
        if model.family == "continuum" and not case.planar:
            ribs = tuple(rib for rod in result.rods for rib in strokes(rod, RIB * case.length))
        stress_free = stress_free or tuple(rod.r[0] for rod in result.rods)
        nodes = np.concatenate(lines[model.family])
        off = np.linalg.norm(nodes - case.quantity(result), axis=1).min()
        if off <= ON_THE_ROD * case.length:
            reference = case.reference.value
    return Shape(case.name, stress_free, lines["continuum"], lines["discrete"], ribs, reference)


def strokes(rod: RodHistory, length: float) -> tuple[Array, ...]:
    """Strokes along d2 from some nodes of the deformed rod, shape (2, 3) each [m]."""
    every = max(1, (len(rod.s) - 1) // RIBS)
    return tuple(
        np.stack([r, r + length * R[:, 1]]) for r, R in zip(rod.r[-1, ::every], rod.frames[-1, ::every], strict=True)
    )
