"""How many numbers of each kind hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from verification.report import trials

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.suite import Report

__all__ = ["Outcome", "outcomes"]


@dataclass(frozen=True)
class Outcome:
    """Of one kind of numbers.

    Args:
        key: Section of the page that holds them.
        good: How many hold.
        total: How many there are.
        words: What it says of them that they hold.
        mark: Class of what does not: "" where nothing is missed, "bad", or "slow" where only time is.
    """

    key: str
    good: int
    total: int
    words: str
    mark: str = ""

    @property
    def sign(self) -> str:
        """In one letter."""
        return "✗" if self.mark else "✓"


def outcomes(report: Report) -> tuple[Outcome, ...]:
    """Of every kind that something was solved for, in the order of the page."""
    errors = [c for c in report.checks if c.quantity.startswith("error")]
    orders = [c for c in report.checks if c.quantity.startswith("order")]
    digits = [c for c in report.checks if c.quantity == "digits"]
    kinds: tuple[tuple[str, Sequence[Any], str], ...] = (
        ("reach", digits, "continuum: cases to 10⁻⁸, or nearing it with the order of theory"),
        ("laws", report.laws, "laws hold: objectivity, balance, path independence, units …"),
        ("cross", report.crosschecks, "differences between the models explained by refinement"),
        ("limits", errors, "error limits on given meshes hold"),
        ("step", report.one_step, "whole loads taken in one step, within the iterations allowed"),
        ("orders", orders, "observed orders reach theory"),
        *trials.outcomes(report),
    )
    found = [_counted(key, rows, words, "bad") for key, rows, words in kinds if rows]
    for share in report.shares:
        mark = "" if share.holds else "bad"
        found.append(Outcome("hard", share.converged, share.total, "hard cases solved by the continuum model", mark))
    if report.speeds:
        found.append(_counted("speed", report.speeds, "speed figures within their limit on this machine, now", "slow"))
    return tuple(found)


def _counted(key: str, rows: Sequence[Any], words: str, mark: str) -> Outcome:
    """How many hold; those that a case explains are neither, those not judged are left out."""
    told = [row for row in rows if getattr(row, "asked", True) is False]
    rows = [row for row in rows if getattr(row, "asked", True) is not False]
    good, missed = sum(row.holds for row in rows), sum(getattr(row, "missed", not row.holds) for row in rows)
    explained = len(rows) - good - missed
    more = f", {explained} explained at their cases" if explained else ""
    more += f"; {len(told)} not judged, runs being too few" if told else ""
    return Outcome(key, good, len(rows), words + more, mark if missed else "")
