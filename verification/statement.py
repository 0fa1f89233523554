"""A case in words: what is posed, what is read off, and what it should be."""

from __future__ import annotations

from dataclasses import dataclass, fields
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from dolfinrod.scene import Dynamic
from verification.case import UPRIGHT

if TYPE_CHECKING:
    from collections.abc import Iterable

    from dolfinrod.scene import Rod, Scene
    from verification.case import Case
    from verification.references import Reference

__all__ = ["Statement", "family_title", "statement"]


# What is smaller than this part of the largest component is round-off.
ZERO = 1e-14


@dataclass(frozen=True)
class Statement:
    """What a reader needs to pose a case himself.

    Args:
        name: Of the case.
        title: Of the case.
        family: Of the case.
        posed: Rods, supports and loads, one line each.
        quantity: What is read off.
        length: By which errors are divided [m].
        models: That pose it.
        reference: What the quantity should be.
        note: Where a model deviates from theory.
    """

    name: str
    title: str
    family: str
    posed: tuple[str, ...]
    quantity: str
    length: float
    models: tuple[str, ...]
    reference: Reference
    note: str


def statement(case: Case) -> Statement:
    """Put a case into words.

    Args:
        case: Any.

    Returns:
        The words.
    """
    return Statement(
        name=case.name,
        title=case.title,
        family=case.family,
        posed=tuple(lines(case.scene(UPRIGHT))),
        quantity=case.quantity_name,
        length=case.length,
        models=case.models,
        reference=case.reference,
        note=case.note,
    )


def family_title(family: str) -> str:
    """First line of the family's file in `verification.cases`, without its full stop; its name where there is none."""
    try:
        text = import_module(f"verification.cases.{family}").__doc__ or family
    except ModuleNotFoundError:
        text = family
    return text.strip().splitlines()[0].rstrip(".")


def lines(scene: Scene) -> Iterable[str]:
    """What a scene lists."""
    for rod in scene.rods:
        yield f"Rod from {words(rod.centerline(0.0))} to {words(rod.centerline(rod.length))} m, {shape(rod)}"
        yield record(rod.section)
    yield from map(record, (*scene.supports, *scene.loads))
    if isinstance(scene.motion, Dynamic) or scene.motion.steps is not None:
        yield record(scene.motion)


def shape(rod: Rod) -> str:
    """Length, curvature at the start, and whether it changes."""
    start, end = (rod.curvature(s) for s in (0.0, rod.length))
    if not np.any(start) and not np.any(end):
        return f"straight, {rod.length:.6g} m long"
    return f"{rod.length:.6g} m long, κ₀ = {words(start)} /m at its start, {words(end)} /m at its end"


def record(part: Any) -> str:
    """Such as "PointForce(force = (0, 10, 0), at = end)"; what is not given is left out."""
    given = ((f.name, getattr(part, f.name)) for f in fields(part))
    shown = (f"{name} = {words(value)}" for name, value in given if value is not None and value != frozenset())
    return f"{type(part).__name__}({', '.join(shown)})"


def words(value: Any) -> str:
    """A value for people: six digits, long tables by their length, functions by their kind."""
    if isinstance(value, np.ndarray):
        value = np.where(np.abs(value) < ZERO * np.abs(value).max(initial=0.0), 0.0, value)
    if isinstance(value, float | np.floating):
        return f"{value:.6g}".replace("inf", "∞").replace("-", "−")
    if isinstance(value, tuple | list | np.ndarray):
        return f"({', '.join(map(words, value))})" if len(value) <= 6 else f"({len(value)} entries)"
    if isinstance(value, frozenset | set):
        return ", ".join(sorted(map(str, value)))
    return "a function" if callable(value) else str(value)
