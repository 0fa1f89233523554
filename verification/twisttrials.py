"""Measures of twist as units of work, by name."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.ledger import Unit
from verification.twist import twiststudy
from verification.twistcases import CASES

__all__ = ["WINDING", "listing", "names", "units"]

# Chosen like a family; a single case as "winding:NAME".
WINDING = "winding"


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (WINDING, *(asked_as(case.name) for case in CASES))


def asked_as(name: str) -> str:
    """Under which a case is asked for."""
    return f"{WINDING}:{name}"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented; others are passed over."""
    chosen = [case for case in CASES if {WINDING, asked_as(case.name)} & set(asked)]
    if chosen:
        yield WINDING, "how twist is measured: winding, writhe, link"
    for case in chosen:
        yield f"  {asked_as(case.name)}", case.title


def units(asked: tuple[str, ...]) -> Iterator[Unit]:
    """What is to be done, in a quick run, too: it takes a second or two all in all.

    Args:
        asked: Out of `names()`; others are passed over.

    Yields:
        Units in the order of the report.
    """
    for case in CASES:
        if {WINDING, asked_as(case.name)} & set(asked):
            yield Unit("twist", f"{case.title}: {case.measure}", (case.name, *case.levels), partial(twiststudy, case))
