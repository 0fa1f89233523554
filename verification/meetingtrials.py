"""Cases of rods that touch rods, as units of work."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.contact import contactstudy
from verification.ledger import Unit
from verification.meetings import CASES

__all__ = ["MEETINGS", "asked_as", "listing", "names", "units"]

# Chosen like a family; a single case as "meetings:NAME", those of a family as "meetings:FAMILY".
MEETINGS = "meetings"

Key = tuple[str | int | float, ...]


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    families = dict.fromkeys(asked_as(case.family) for case in CASES)
    return (MEETINGS, *dict.fromkeys((*families, *(asked_as(case.name) for case in CASES))))


def asked_as(name: str) -> str:
    """Under which a case or a family is asked for."""
    return f"{MEETINGS}:{name.replace(' ', '-')}"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented; others are passed over.

    Args:
        asked: Out of `names()`.

    Yields:
        One line.
    """
    chosen = [case for case in CASES if {MEETINGS, asked_as(case.family), asked_as(case.name)} & set(asked)]
    if chosen:
        yield MEETINGS, "rods on rods, by both models"
    for case in chosen:
        yield f"  {asked_as(case.name)}", case.title


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Only the runs that are marked.

    Yields:
        Units in the order of the report.
    """
    for case in CASES:
        if not {MEETINGS, asked_as(case.family), asked_as(case.name)} & set(asked):
            continue
        for run in case.runs:
            if run.quick or not quick:
                words = f"{case.title}: {run.model}, {run.label}"
                key: Key = (case.name, run.model, run.label, *run.levels)
                yield Unit("meeting", words, key, partial(contactstudy, case, run))
