"""Rigid tops as units of work, by name."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.ledger import Unit
from verification.rigid import pairs, topstudy

__all__ = ["TOPS", "listing", "names", "units"]

# Chosen like a family.
TOPS = "tops"
# Of the step lengths in a quick run.
QUICK = 2


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (TOPS,)


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title, if asked for."""
    if TOPS in asked:
        yield TOPS, "rigid bodies through the rotation integrators"


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """Every top by every integrator.

    Args:
        asked: Names; none of others' is looked at.
        quick: The two longest steps only, until 1 s.

    Yields:
        Units in the order of the report.
    """
    for top, integrator in pairs() if TOPS in asked else ():
        work = partial(topstudy, top, integrator)
        if quick:
            work = partial(work, levels=QUICK, until=1.0)
        words = f"{top.title}: {integrator.name}"
        yield Unit("rigid", words, (top.name, integrator.name, QUICK if quick else len(top.first)), work)
