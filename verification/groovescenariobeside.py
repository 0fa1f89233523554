"""One bundle by both models, and by one model beside its mirror image."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove import Scenario, course, variant
from dolfinrod.groove.scenario import MODELS

if TYPE_CHECKING:
    from dolfinrod.groove import Course
    from dolfinrod.result import Result

__all__ = ["AGREES", "MIRRORED", "GrooveImage", "GrooveModels", "by_both", "titled", "with_image"]

# Difference of the models' widths before fibres touch one another, of the width at first: the discrete model's second
# order on 80 elements is a part in a thousand of the way. And that of a mirror image, of the length.
AGREES, MIRRORED = 1e-2, 1e-8


@dataclass(frozen=True)
class GrooveModels:
    """Both models on the same bundle over time.

    Args:
        title: What it is.
        t: Stored times [s].
        width: By the continuum and by the discrete model [m].
        wound: Mean winding of pairs, either way [turns].
        walls: Normal force of walls and core [N].
        fibres: Normal force of fibres on one another [N].
        seconds: On the processor [s].
        steps: Taken.
        met: First stored time at which fibres touch one another by either; the last where they never do [s].
        apart: Largest difference of widths until then, of the width at first.
    """

    title: str
    t: tuple[float, ...]
    width: tuple[tuple[float, ...], ...]
    wound: tuple[tuple[float, ...], ...]
    walls: tuple[tuple[float, ...], ...]
    fibres: tuple[tuple[float, ...], ...]
    seconds: tuple[float, ...]
    steps: tuple[int, ...]
    met: float
    apart: float

    @property
    def holds(self) -> bool:
        """They agree as long as nothing is chaotic."""
        return self.apart <= AGREES

    @property
    def words(self) -> str:
        """How far they are apart."""
        return f"{self.title}: widths differ by {self.apart:.1e} before fibres touch, at most {AGREES:g}"


@dataclass(frozen=True)
class GrooveImage:
    """A bundle and its mirror image, built and solved.

    Args:
        title: What it is.
        model: That solved both.
        apart: Largest distance of one's nodes from the image of the other's until fibres touch, of the length.
        met: First stored time at which fibres touch one another; the last where they never do [s].
        moved: How far nodes had moved by then [m].
    """

    title: str
    model: str
    apart: float
    met: float
    moved: float

    @property
    def holds(self) -> bool:
        """They are each other's image to round-off, as the solver's tolerance lets them."""
        return self.apart <= MIRRORED

    @property
    def words(self) -> str:
        """How far they are apart."""
        return f"{self.title}, {self.model}: {self.apart:.1e} of the length off its image, at most {MIRRORED:g}"


def by_both(scenario: Scenario) -> GrooveModels:
    """Solve by both models.

    Args:
        scenario: The bundle.

    Returns:
        Their courses side by side.
    """
    found = [_timed(scenario, model) for model in MODELS]
    courses = [course(result, scenario) for result, _ in found]
    i = min(_met(over) for over in courses)
    # They need not come to rest at the same time.
    n = min(len(over.t) for over in courses)
    width = np.stack([over.width[:n] for over in courses])
    return GrooveModels(
        title=titled(scenario),
        t=_listed(courses[0].t[:n]),
        **{
            name: tuple(_listed(getattr(over, name)[:n]) for over in courses)
            for name in ("width", "wound", "walls", "fibres")
        },
        seconds=tuple(seconds for _, seconds in found),
        steps=tuple(len(result.log) for result, _ in found),
        met=float(courses[0].t[i]),
        apart=float(np.abs(np.diff(width[:, : i + 1], axis=0)).max() / width[0, 0]),
    )


def titled(scenario: Scenario) -> str:
    """What tells one bundle from others."""
    damped = ", contact damped" if scenario.law.damping > 0.0 else ""
    return f"{scenario.fibres} fibres, {scenario.kind}{damped}, {scenario.elements} elements"


def with_image(scenario: Scenario, model: str) -> GrooveImage:
    """Solve a bundle and its mirror image.

    Args:
        scenario: The bundle.
        model: By which model.

    Returns:
        How far they are apart until fibres touch.
    """
    result, image = (_timed(each, model)[0] for each in (scenario, variant(scenario, "mirrored")))
    i = _met(course(result, scenario))
    flip = np.array([1.0, 1.0, -1.0])
    pairs = zip(result.rods, image.rods, strict=True)
    apart = max(float(np.abs(a.r[: i + 1] * flip - b.r[: i + 1]).max()) for a, b in pairs)
    return GrooveImage(
        title=f"{scenario.fibres} fibres, {scenario.kind}",
        model=model,
        apart=apart / scenario.bundle.length,
        met=float(result.t[i]),
        moved=max(float(np.abs(rod.r[i] - rod.r[0]).max()) for rod in result.rods),
    )


def brief(scenario: Scenario) -> Scenario:
    """For a quick run: two fibres for a blink."""
    return replace(scenario, fibres=2, elements=12, t_end=2e-5, output=1e-5)


def _timed(scenario: Scenario, model: str) -> tuple[Result, float]:
    begun = time.process_time()
    return scenario.run(model), time.process_time() - begun


def _met(over: Course) -> int:
    """The last stored time before fibres touch one another."""
    touching = np.flatnonzero(over.fibres > 0.0)
    return int(touching[0]) - 1 if len(touching) and touching[0] else len(over.t) - 1


def _listed(values: np.ndarray) -> tuple[float, ...]:
    return tuple(float(v) for v in values)
