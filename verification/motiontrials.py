"""Motions as units of work: errors against step and time, frequencies, what is kept, what a step costs."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.drift import STEPPERS, driftstudy
from verification.frequency import frequencystudy
from verification.ledger import Unit
from verification.motion import motionstudy
from verification.motions import CASES, VIBRATIONS
from verification.pace import PACES, pace, paper_fibre

__all__ = ["DRIFT", "MOTION", "PACE", "listing", "names", "units"]

# Chosen like families; everything here is part of the first.
MOTION, DRIFT, PACE = "motion", "motion-momenta", "motion-pace"
# Seconds of the free flight and its numbers of steps, in full and in a quick run.
FLIGHT, STEPS = 10.0, (2_500, 10_000)
QUICK_FLIGHT, QUICK_STEPS = 1.0, (250, 1_000)
# Numbers of steps taken by schemes that lose energy: the first shows it.
LOSING = 1
FIBRE_STEPS = 300
PACED, QUICK_PACED = 50, 5

Key = tuple[str | int | float, ...]


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (MOTION, DRIFT, PACE, *_titles())


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented; others are passed over.

    Args:
        asked: Out of `names()`.

    Yields:
        One line.
    """
    if set(asked) & set(names()):
        yield MOTION, "motions in time, by both models and all schemes"
    for name, title in _titles().items():
        if {MOTION, name} & set(asked):
            yield f"  {name}", title
    for name, words in ((DRIFT, "what a free flying rod keeps"), (PACE, "milliseconds a step, the paper's fibre")):
        if {MOTION, name} & set(asked):
            yield f"  {name}", words


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Only the cases that are marked, fewer steps in flight.

    Yields:
        Units in the order of the report.
    """
    chosen = set(asked)
    for case in CASES:
        for run in case.runs if {MOTION, case.name} & chosen else ():
            if run.quick or not quick:
                key: Key = (case.name, run.stepper.name, run.stepper.mesh, *run.steps)
                words = f"{case.title}: {run.stepper.name}, {run.stepper.mesh}"
                yield Unit("motion", words, key, partial(motionstudy, case, run))
    for vibration in VIBRATIONS:
        for model in vibration.models if {MOTION, vibration.name} & chosen else ():
            if model.quick or not quick:
                key = (vibration.name, model.steppers[0].name, *model.meshes)
                words = f"{vibration.title}: {model.steppers[0].name}"
                yield Unit("frequency", words, key, partial(frequencystudy, vibration, model))
    if {MOTION, DRIFT} & chosen:
        yield from _flights(quick)
    if {MOTION, PACE} & chosen:
        yield from _costs(quick)


def _titles() -> dict[str, str]:
    """Of every case, by its name."""
    return {case.name: case.title for case in CASES} | {case.name: case.title for case in VIBRATIONS}


def _flights(quick: bool) -> Iterator[Unit]:
    """The free rod by every model and scheme, in one to three lengths of step."""
    seconds, steps = (QUICK_FLIGHT, QUICK_STEPS) if quick else (FLIGHT, STEPS)
    for stepper in STEPPERS:
        taken = steps if stepper.order == 2 else steps[:LOSING]
        key: Key = (stepper.name, stepper.mesh, seconds, *taken)
        yield Unit("drift", f"Free flight: {stepper.name}", key, partial(driftstudy, stepper, seconds, taken))


def _costs(quick: bool) -> Iterator[Unit]:
    """The paper's fibre, in a full run, and milliseconds a step."""
    if not quick:
        yield Unit("paper fibre", "The paper's fibre, 1 µs a step", (FIBRE_STEPS,), partial(paper_fibre, FIBRE_STEPS))
    steps = QUICK_PACED if quick else PACED
    for task in PACES:
        key: Key = (task.words, task.stepper.name, task.stepper.mesh, steps)
        words = f"Milliseconds a step: {task.words}, {task.stepper.name}, {task.stepper.mesh}"
        yield Unit("pace", words, key, partial(pace, task, steps))
