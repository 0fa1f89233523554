"""One rank against two as units of work, by name."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.ledger import Unit
from verification.ranks import compared
from verification.rankscenes import KINDS

__all__ = ["RANKS", "listing", "names", "units"]

# Chosen like a family; a single kind as "ranks:KIND".
RANKS = "ranks"
# In a quick run: statics by LU, a motion, and rods that touch.
QUICK = ("bend", "midpoint", "crossing-motion")


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (RANKS, *(asked_as(kind.name) for kind in KINDS))


def asked_as(name: str) -> str:
    """Under which a kind is asked for."""
    return f"{RANKS}:{name}"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented; others are passed over."""
    chosen = [kind for kind in KINDS if {RANKS, asked_as(kind.name)} & set(asked)]
    if chosen:
        yield RANKS, "every kind of scene on one rank and on two"
    for kind in chosen:
        yield f"  {asked_as(kind.name)}", kind.title


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Only a few of the kinds.

    Yields:
        Units in the order of the report.
    """
    for kind in KINDS:
        chosen = {RANKS, asked_as(kind.name)} & set(asked)
        if chosen and (kind.name in QUICK or not quick):
            work = partial(compared, kind.name, kind.title)
            yield Unit("ranks", f"One rank and two: {kind.title}", (kind.name,), work)
