"""What an iteration and a process cost, as units of work."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.cold import PROCESSES, cold
from verification.growth import grown
from verification.ledger import Unit
from verification.limit import limit

__all__ = ["COLD", "GROWTH", "LIMIT", "listing", "names", "units"]

# Chosen like families.
LIMIT, GROWTH, COLD = "limit", "growth", "cold"
TITLES = {
    LIMIT: "where the time of an iteration goes, and what LAPACK alone would take",
    GROWTH: "what an iteration costs on finer and finer meshes",
    COLD: "whole processes from nothing",
}
# Model, elements, degree; a quick run takes the first of each model.
MESHES = (
    ("planar", 8, 3),
    ("planar", 128, 3),
    ("spatial", 8, 3),
    ("spatial", 128, 3),
    ("discrete", 32, 1),
    ("discrete", 320, 1),
)
REPEATS, QUICK_REPEATS = 20, 3
# Models and degrees, and elements.
GROWN = (("planar", 2), ("discrete", 1))
FINER, QUICK_FINER = (10, 100, 1000, 10_000, 100_000), (100, 1000, 4000)
STARTS, QUICK_STARTS = 5, 1


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return tuple(TITLES)


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for; others are passed over."""
    yield from ((name, title) for name, title in TITLES.items() if name in asked)


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Coarse meshes, few repeats, one process, nothing compiled.

    Yields:
        Units in the order of the report.
    """
    first = {mesh[0]: mesh for mesh in reversed(MESHES)}
    repeats = QUICK_REPEATS if quick else REPEATS
    for mesh in MESHES if LIMIT in asked else ():
        if not quick or first[mesh[0]] == mesh:
            yield Unit("cost", f"An iteration: {mesh}", (LIMIT, *mesh, repeats), partial(limit, *mesh, repeats))
    finer = QUICK_FINER if quick else FINER
    for model, degree in GROWN if GROWTH in asked else ():
        work = partial(grown, model, degree, finer)
        yield Unit("cost", f"Finer meshes: {model}", (GROWTH, model, degree, *finer), work)
    starts = QUICK_STARTS if quick else STARTS
    for k, (words, _, runs) in enumerate(PROCESSES) if COLD in asked else ():
        if quick and not runs:
            continue
        process = partial(cold, k, starts, compiling=not quick)
        yield Unit("cost", f"A process: {words}", (COLD, words, starts), process)
