"""Steps in time as units of work: explicit limits, stability maps, hard motions."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.explicitlimit import LENGTH, WAVES, explicit_limit
from verification.hardcases import motions
from verification.hardmotion import SOLVERS, HardMotion, hard_motion
from verification.ledger import Unit
from verification.maps import RISES, SCHEMES, cells

__all__ = ["HARD_MOTION", "MAPS", "listing", "names", "units"]

# Chosen like families; a single hard motion as "hard-motion:NAME".
MAPS, HARD_MOTION = "stability-maps", "hard-motion"
# Elements of the fibre of 40 mm: 4, 2, 1 and 0.5 mm; 0.2 mm besides for the limits.
ELEMENTS, FINEST = (10, 20, 40, 80), 200
# Meshes, rises and every so many steps of a quick run.
QUICK_ELEMENTS, QUICK_RISES, QUICK_EVERY = (20,), RISES[:1], 3
# Most steps of a hard motion in a quick run.
QUICK_STEPS = 60.0


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (MAPS, HARD_MOTION, *(hard_name(case) for case in motions.CASES))


def hard_name(case: HardMotion) -> str:
    """Under which a hard motion is asked for."""
    return f"{HARD_MOTION}:{case.name}"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented.

    Args:
        asked: Out of `names()`; others are passed over.

    Yields:
        One line.
    """
    if MAPS in asked:
        yield MAPS, "step, length of the elements and rise of the load: what converges, what fails"
    chosen = _chosen(asked)
    if chosen:
        yield HARD_MOTION, "motions that schemes stumble over"
    yield from ((f"  {hard_name(case)}", case.title) for case in chosen)


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Two limits, a map of one mesh and a third of the steps, the shortest hard motion of each group unless
            that is long.

    Yields:
        Units in the order of the report.
    """
    if MAPS in asked:
        yield from _limits(quick)
        yield from _maps(quick)
    chosen = _chosen(asked)
    if quick:
        groups = dict.fromkeys(case.group for case in chosen)
        shortest = (min((case for case in chosen if case.group == group), key=_steps) for group in groups)
        chosen = tuple(case for case in shortest if _steps(case) <= QUICK_STEPS)
    for case in chosen:
        for model, scheme in SOLVERS:
            kind = type(scheme).__name__
            work = partial(hard_motion, case, model, scheme)
            yield Unit(
                "hard motion", f"{case.title}: {model}, {kind}", (case.name, model, kind), work, rests_on=case.name
            )


def _chosen(asked: tuple[str, ...]) -> tuple[HardMotion, ...]:
    return tuple(case for case in motions.CASES if HARD_MOTION in asked or hard_name(case) in asked)


def _steps(case: HardMotion) -> float:
    """How many it is asked to take."""
    return case.scene().motion.t_end / case.dt


def _limits(quick: bool) -> Iterator[Unit]:
    """Explicit limits, in a quick run those of process.md 1.1 at its elements of 0.5 mm."""
    for n in ELEMENTS[-1:] if quick else (*ELEMENTS, FINEST):
        for wave in WAVES:
            if wave.stated or not quick:
                words = f"Explicit limit: {wave.name}, elements of {1e3 * LENGTH / n:g} mm"
                yield Unit("explicit limit", words, (wave.name, n), partial(explicit_limit, wave, n))


def _maps(quick: bool) -> Iterator[Unit]:
    """A line of a map, all steps on one mesh, is a unit."""
    for scheme in SCHEMES:
        steps = scheme.steps[1::QUICK_EVERY] if quick else scheme.steps
        for rise in QUICK_RISES if quick else RISES:
            for n in QUICK_ELEMENTS if quick else ELEMENTS:
                words = f"Stability map: {scheme.name}, {n} elements, load within {1e3 * rise:g} ms"
                yield Unit("map", words, (scheme.name, rise, n, *steps), partial(cells, scheme, n, rise, steps))
