"""Errors against resolution and against time, one panel a case."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.references import peers
from verification.report.canvas import Curve, Star, log_log
from verification.report.tables import power, scientific

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from verification.workprecision import Record, Study

__all__ = ["LETTERS", "against_resolution", "against_time", "kind", "model_words", "published"]

# What lies below is round-off and drawn at the edge.
LOWEST = 1e-16
LETTERS = "abcdefghijklmnopqrstuvwxyz"


def against_resolution(studies: Sequence[Study], title: str) -> str:
    """Tip errors over the number of elements; at each curve its observed order.

    Args:
        studies: Of one case.
        title: Of the case.

    Returns:
        SVG.
    """
    curves = [curve for study in studies if (curve := over_elements(study, "planar" in modes(studies)))]
    return log_log(
        curves,
        x="elements of a rod",
        y="relative error",
        alt=f"{title}: relative error over the number of elements",
        band=max((s.floor for s in studies), default=0.0),
    )


def modes(studies: Iterable[Study]) -> set[str]:
    """Kinematics that occur."""
    return {s.model.rpartition(" ")[2] for s in studies if s.family == "continuum"}


def over_elements(study: Study, labelled_planar: bool) -> Curve | None:
    """A study over its meshes; of planar and spatial curves, which mostly coincide, one is labelled."""
    found = [r for r in study.records if r.failure is None]
    if not found:
        return None
    planar = study.model.endswith("planar")
    order = study.tip
    pair = order.meshes if order.observed is not None else None
    at = next((i for i, r in enumerate(found) if pair and r.elements == pair[1]), -1)
    labelled = pair is not None and (study.family == "discrete" or planar == labelled_planar)
    return Curve(
        kind(study),
        tuple(float(r.elements) for r in found),
        tuple(max(r.error, LOWEST) for r in found),
        f"{study.model}: order {power(order.observed)}, by theory {order.theory}",
        planar,
        f"{order.observed:.1f}" if labelled else "",
        at,
        -float(order.theory) if labelled else None,
    )


def against_time(studies: Sequence[Study], title: str, problem: str = "") -> str:
    """Tip errors over the milliseconds of the load stepping.

    Args:
        studies: Of one case.
        title: Of the case.
        problem: Under which other people's solvers were published; empty: none are shown.

    Returns:
        SVG.
    """
    stars = published(problem) if problem else ()
    return log_log(
        [curve for study in studies if (curve := over_time(study))],
        x="load stepping, warm, one thread [ms]",
        y="relative error",
        alt=f"{title}: relative error over milliseconds",
        band=max((s.floor for s in studies), default=0.0),
        stars=stars,
    )


def over_time(study: Study) -> Curve | None:
    """A study over its timed runs."""
    timed = [(r.timing.solve_min, r) for r in study.records if r.timing is not None and r.failure is None]
    if not timed:
        return None
    xs, ys = tuple(t for t, _ in timed), tuple(max(r.error, LOWEST) for _, r in timed)
    return Curve(
        kind(study), xs, ys, f"{study.model}: {', '.join(point(r) for _, r in timed)}", "planar" in study.model
    )


def point(record: Record) -> str:
    """Such as "8: 2.1e−7"."""
    return f"{record.elements}: {scientific(record.error)}"


def published(problem: str) -> tuple[Star, ...]:
    """Other people's solvers, lettered."""
    entries = enumerate(peers(problem))
    return tuple(Star(p.ms, p.error, LETTERS[k], f"{LETTERS[k]}: {p.who}, {p.kinematics}") for k, p in entries)


def kind(study: Study) -> str:
    """Class of a study's curve."""
    if study.family == "discrete":
        return "paper" if study.model.endswith("paper") else "chord"
    return f"p{study.degree}"


def model_words(model: str) -> str:
    """A model as a reader knows it."""
    return model.replace("discrete paper", "discrete, Eq. 16 as printed").replace("discrete chord", "discrete")
