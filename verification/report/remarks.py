"""Deviations put into words, one sentence a case."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from math import isfinite
from typing import TYPE_CHECKING

from verification.checks import ORDER_SLACK
from verification.report.diagrams import model_words
from verification.report.tables import scientific

if TYPE_CHECKING:
    from verification.order import Order
    from verification.workprecision import Study

__all__ = ["REASONS", "deviations", "literal_remark"]

# Why a family does not show the order of theory, where that is known.
REASONS = {
    "rollup": "the moment is constant along the rod, so planar angles are exact and the tip errs only by the "
    "Gauss rule, with order 2k + 2, which in space the interpolated quaternions keep for odd k",
}
LITERAL = (
    "Eq. 16 as printed measures the elongation along the tangent of node i, where an arc of curvature κ and length l "
    "seems shortened by κ²l²/6, so an element grows too long by that much: four times the κ²l²/24 by which a chord of "
    "length l exceeds the arc's. Both fall with l², so the order stays and the error grows"
)


def deviations(studies: Iterable[Study]) -> list[str]:
    """What is seen where an observed order is not that of theory, one clause a study.

    Args:
        studies: Of one case.

    Returns:
        Clauses.
    """
    return [clause for study in studies if (clause := deviation(study))]


def literal_remark(studies: Iterable[Study]) -> str:
    """What the printed Eq. 16 does to the discrete model, against its chord form."""
    pairs = []
    for title, group in groupby(studies, key=lambda s: s.title):
        by_model = {s.model: s for s in group}
        chord, paper = by_model.get("discrete chord"), by_model.get("discrete paper")
        if chord is not None and paper is not None and chord.records[-1].error > chord.floor:
            ratio = paper.records[-1].error / chord.records[-1].error
            pairs.append(f"{title}: order {order_words(paper.tip)}, error {ratio:.3g} times that of the chord form")
    return f"The literal Eq. 16 ({'; '.join(pairs)}). {LITERAL}." if pairs else ""


def deviation(study: Study) -> str:
    """What one study shows instead of theory; empty where it shows theory."""
    parts = [
        f"{name} {seen}"
        for name, order in (("tip", study.tip), ("centreline", study.centreline))
        if order is not None and (seen := instead(order, study.records[-1].elements, study.floor))
    ]
    return f"{model_words(study.model)}: {' and '.join(parts)}" if parts else ""


def instead(order: Order, finest: int, floor: float) -> str:
    """The deviation of one order in words; `finest` is the number of elements it could have been read off."""
    if order.observed is None:
        if not isfinite(order.worst):
            return "without order, as nothing converged"
        worst = scientific(order.worst)
        if order.worst < floor:
            return f"exact to round-off or to the reference ({worst})"
        return f"there from the second mesh on ({worst} on the first)"
    if abs(order.observed - order.theory) <= ORDER_SLACK:
        return ""
    pair = order.meshes or (finest, finest)
    coarse = (
        "" if finest in pair else f" (between {pair[0]} and {pair[1]} elements; beyond is round-off or the reference)"
    )
    return f"{order.observed:.1f} instead of {order.theory}{coarse}"


def order_words(order: Order) -> str:
    """An order, or that there is none to see."""
    return "hidden" if order.observed is None else f"{order.observed:.2f}"
