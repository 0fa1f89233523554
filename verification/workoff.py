"""Units of work one after the other, and what they took."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from verification.interrupt import Interrupt
    from verification.ledger import Ledger, Row, Unit

__all__ = ["Spent", "spent", "work_off"]


@dataclass(frozen=True)
class Spent:
    """What the suite took for one kind of work.

    Args:
        topic: Of the units.
        units: How many.
        seconds: All of them, one after the other, by the clock [s].
        longest: The longest of them, in words.
        most: What that took [s].
    """

    topic: str
    units: int
    seconds: float
    longest: str
    most: float


def work_off(
    units: Sequence[Unit],
    ledger: Ledger,
    note: Callable[[int, Unit, bool], None] = lambda *_: None,
    interrupt: Interrupt | None = None,
) -> dict[str, tuple[Row, ...]]:
    """Do what is not yet done.

    Args:
        units: All of them.
        ledger: Where finished ones are kept.
        note: Told, before each unit, how many went before it, the unit, and whether it is recalled.
        interrupt: Asked after each unit, so that none is kept that was disturbed.

    Returns:
        Rows by topic.
    """
    found: dict[str, tuple[Row, ...]] = {}
    for k, unit in enumerate(units):
        rows = ledger.recall(unit)
        note(k, unit, rows is not None)
        if rows is None:
            rows = ledger.fill(unit, interrupt)
        found[unit.topic] = (*found.get(unit.topic, ()), *rows)
    return found


def spent(units: Sequence[Unit], ledger: Ledger) -> tuple[Spent, ...]:
    """What units that are done took by topic, the longest first."""
    topics: dict[str, list[tuple[float, str]]] = {}
    for unit in units:
        topics.setdefault(unit.topic, []).append((ledger.seconds(unit), unit.words))
    found = [
        Spent(topic, len(took), sum(s for s, _ in took), max(took)[1], max(took)[0]) for topic, took in topics.items()
    ]
    return tuple(sorted(found, key=lambda row: -row.seconds))
