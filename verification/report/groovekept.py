"""Bundles in the groove in Markdown: what should be and what is, and the ensembles that tell."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.groovescenario import SEEDS, GrooveEnsemble
from verification.groovescenarioclaims import GrooveClaim
from verification.report.groovescenario import TITLE, ranged

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.groovescenarioclaims import Gathered

__all__ = ["bundles_kept"]

CLAIMS = ("what should be", "what is", "")
ENSEMBLES = (
    "bundles",
    "runs that ended",
    "twist by crossings [turns/m]",
    "pairs wound by 0.4 turns or more",
    "5 crosses 4 in so many runs",
)


def bundles_kept(found: Sequence[Gathered]) -> list[str]:
    """Paragraphs; none where no ensemble is as large as a statement on means asks for. Intervals are those of 95 %."""
    claims = [one for one in found if isinstance(one, GrooveClaim)]
    ensembles = [one for one in found if isinstance(one, GrooveEnsemble)]
    if not any(len(one.crossed) >= SEEDS for one in ensembles):
        return []
    parts = [f"## {TITLE}"]
    parts += [_table(CLAIMS, [(one.title, one.found, _sign(one)) for one in claims])] if claims else []
    return [*parts, _table(ENSEMBLES, [_ensemble(one) for one in ensembles])]


def _sign(one: GrooveClaim) -> str:
    return ("✓" if one.holds else "✗") if one.asked else "not judged"


def _ensemble(one: GrooveEnsemble) -> tuple[str, ...]:
    ended = f"{len(one.most)} of {one.seeds}"
    return one.title, ended, ranged(one.crossed, 1), ranged(one.wound, 1), f"{sum(one.edge):.0f}"


def _table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
