"""Trials as units of work: critical values and what lies beside them, hard cases, whole loads, fewest steps."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from importlib import import_module

from verification import (
    bundletrials,
    contactwork,
    eigencases,
    groovescenariotrials,
    growthtrials,
    hardcases,
    motiontrials,
    ranktrials,
    stepping,
    toptrials,
    twisttrials,
)
from verification.contacttrials import CONTACT, MEETINGS
from verification.eigencase import Eigencase
from verification.hard import hard, pairs
from verification.hardcase import HardCase, Refined
from verification.ledger import Unit
from verification.robustness import benchmark_rows, loads_at_once, models
from verification.stability import bracket, eigenstudy
from verification.stability import pairs as eigenpairs

__all__ = ["APART", "FEWEST", "HARD", "LARGEST", "listing", "names", "units"]

# Chosen like families; a single hard case as "hard:NAME".
HARD, LARGEST, FEWEST = "hard", "largest-load", "fewest-steps"
# Take hours, or tell little by themselves: done where they are asked for, never because everything is.
APART = (bundletrials.LONG, groovescenariotrials.ACCEPTANCE, *groovescenariotrials.UNTOLD)


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (
        *families(),
        HARD,
        LARGEST,
        FEWEST,
        *(case.name for case in eigencases.CASES),
        *(hard_name(case) for case in hardcases.CASES),
        *stepping.names(),
        *motiontrials.names(),
        *bundletrials.names(),
        *ranktrials.names(),
        *growthtrials.names(),
        *toptrials.names(),
        *CONTACT.names(),
        *contactwork.names(),
        *twisttrials.names(),
        *MEETINGS.names(),
        *groovescenariotrials.names(),
    )


def families() -> tuple[str, ...]:
    """Families of critical loads and frequencies."""
    return tuple(dict.fromkeys(case.family for case in eigencases.CASES))


def hard_name(case: HardCase) -> str:
    """Under which a hard case is asked for: many share their name with the case that is hard."""
    return f"{HARD}:{case.name}"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, headings among them, members indented.

    Args:
        asked: Out of `names()`; others are passed over.

    Yields:
        One line.
    """
    for family in families():
        members = [case for case in eigencases.CASES if case.family == family and chosen(case, asked)]
        if members:
            text = import_module(f"verification.eigencases.{family}").__doc__ or family
            yield family, text.strip().splitlines()[0].rstrip(".")
        yield from ((f"  {case.name}", case.title) for case in members)
    difficult = [case for case in hardcases.CASES if {HARD, hard_name(case)} & set(asked)]
    if difficult:
        yield HARD, "what solvers stumble over"
    yield from ((f"  {hard_name(case)}", case.title) for case in difficult)
    for name, words in ((LARGEST, "largest load in one step"), (FEWEST, "fewest load steps")):
        if name in asked:
            yield name, words
    yield from stepping.listing(asked)
    yield from motiontrials.listing(asked)
    yield from bundletrials.listing(asked)
    yield from ranktrials.listing(asked)
    yield from growthtrials.listing(asked)
    yield from toptrials.listing(asked)
    yield from CONTACT.listing(asked)
    yield from contactwork.listing(asked)
    yield from twisttrials.listing(asked)
    yield from MEETINGS.listing(asked)
    yield from groovescenariotrials.listing(asked)


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Only one case of each family on two meshes, one hard case of each group, the steps of what the peers
            were tried on.

    Yields:
        Units in the order of the report.
    """
    yield from _critical(asked, quick)
    yield from _hard(asked, quick)
    for model in models() if LARGEST in asked else ():
        words = f"Largest load in one step: {model.name}"
        yield Unit("largest", words, (LARGEST, model.name), partial(loads_at_once, model))
    for work in benchmark_rows() if FEWEST in asked else ():
        benchmark, model = work.args
        if benchmark.peer or not quick:
            words = f"Fewest steps: {benchmark.case.title}, {model.name}"
            yield Unit("fewest", words, (benchmark.case.name, model.name), work)
    yield from stepping.units(asked, quick=quick)
    yield from motiontrials.units(asked, quick=quick)
    yield from bundletrials.units(asked, quick=quick)
    yield from ranktrials.units(asked, quick=quick)
    yield from growthtrials.units(asked, quick=quick)
    yield from toptrials.units(asked, quick=quick)
    yield from CONTACT.units(asked, quick=quick)
    yield from contactwork.units(asked, quick=quick)
    yield from twisttrials.units(asked)
    yield from MEETINGS.units(asked, quick=quick)
    yield from groovescenariotrials.units(asked, quick=quick)


def _critical(asked: tuple[str, ...], quick: bool) -> Iterator[Unit]:
    """Critical loads with their brackets, and frequencies."""
    members = [case for case in eigencases.CASES if chosen(case, asked)]
    if quick:
        members = list({case.family: case for case in reversed(members)}.values())[::-1]
    kept = {case.name for case in members}
    for case, model in eigenpairs():
        if case.name not in kept:
            continue
        # In a quick run without the finest mesh.
        cells = tuple(round(case.finer * n) for n in (model.meshes[:-1] if quick else model.meshes))
        words = f"{case.title}: {model.name}"
        yield Unit("critical", words, (case.name, model.name, *cells), partial(eigenstudy, case, model, cells))
        if case.brackets:
            beside = f"{case.title}: below and above, {model.name}"
            yield Unit("bracket", beside, (case.name, model.name), partial(bracket, case, model))


def chosen(case: Eigencase, asked: tuple[str, ...]) -> bool:
    """By its own name or by its family's."""
    return case.name in asked or case.family in asked


def _hard(asked: tuple[str, ...], quick: bool) -> Iterator[Unit]:
    """Hard cases by every model that poses them."""
    members = [case for case in hardcases.CASES if HARD in asked or hard_name(case) in asked]
    if quick:
        groups = {case.group for case in members}
        # The first whose check is no solve of its own, or else the first.
        members = [min((case for case in members if case.group == group), key=_costly) for group in groups]
    kept = {case.name for case in members}
    for case, family in pairs():
        if case.name in kept:
            work = partial(hard, case, family)
            yield Unit("hard", f"{case.title}: {family}", (case.name, family), work, rests_on=case.name)


def _costly(case: HardCase) -> bool:
    """Whether the check is a solve of its own."""
    return isinstance(case.check, Refined)
