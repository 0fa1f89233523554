"""Scenarios of the groove as units of work: ensembles, both models, the mirror image, the paper as printed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from dolfinrod.groove import Scenario, variant
from dolfinrod.groove.paper import MESHES, READINGS
from dolfinrod.groove.scenario import MODELS
from verification.groovepaper import as_printed
from verification.groovescenario import DAMPED, INTERMEDIATE, LATERAL, SETTINGS, Setting, gathered, small
from verification.groovescenariobeside import brief, by_both, titled, with_image
from verification.groovescenariosteps import in_shorter_steps
from verification.ledger import Unit

__all__ = ["ACCEPTANCE", "PAPER", "SCENARIOS", "UNTOLD", "listing", "names", "units"]

# Chosen like families; an ensemble as "groove-scenarios:NAME".
SCENARIOS, PAPER = "groove-scenarios", "groove-paper"
BESIDE, IMAGE, STEPPED = f"{SCENARIOS}:models", f"{SCENARIOS}:image", f"{SCENARIOS}:steps"
# Ensembles of the whole bundle on the paper's elements to its end: hours, so only where it is asked for by name.
ACCEPTANCE = "groove-acceptance"
# Of the paper: with air its fibres fall onto the walls; without it nothing moves, of which fewer tell as much.
STEPS, STILL_STEPS, QUICK_STEPS = 400, 100, 3
# Until fibres touch one another, and a little on; states are stored as often as that takes to see [s].
UNTIL, STORED = 1e-3, 1e-5
# By both models, of which the slower takes a minute: a third of the time that fibres touch one another [s].
MET = 1.2e-3
# Of a bundle in ever shorter steps: until the first fibre has struck the core and a little on, and how often it is
# looked at [s].
STRUCK, LOOKED = 0.9e-3, 2e-5


def asked_as(one: Setting) -> str:
    """Under which an ensemble is asked for."""
    return f"{SCENARIOS}:{one.name}"


# Ensembles of which few small bundles tell nothing.
UNTOLD = tuple(asked_as(one) for one in SETTINGS if not one.tells)


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (SCENARIOS, *map(asked_as, SETTINGS), BESIDE, IMAGE, STEPPED, ACCEPTANCE, PAPER)


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented; others are passed over."""
    wanted = set(asked)
    members = {asked_as(one): one.words for one in SETTINGS}
    members |= {BESIDE: "one bundle by both models", IMAGE: "a bundle and its mirror image"}
    members[STEPPED] = "a bundle in ever shorter steps"
    chosen = {name: words for name, words in members.items() if {SCENARIOS, name} & wanted}
    if chosen:
        yield SCENARIOS, "bundles in the groove: what they should show"
    yield from ((f"  {name}", words) for name, words in chosen.items())
    if ACCEPTANCE in wanted:
        yield ACCEPTANCE, "the same with whole bundles to their ends, which takes hours"
    if PAPER in wanted:
        yield PAPER, "the paper's groove as printed, in each reading of its units"


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: A blink of two fibres each, which shows that all runs and nothing more.

    Yields:
        Units in the order of the report.
    """
    for one in SETTINGS:
        chosen = asked_as(one) in asked or (SCENARIOS in asked and one.tells)
        if chosen and (one.quick or not quick):
            yield _ensemble(one.hurried() if quick else one.small())
    yield from _alone(set(asked), quick)
    for one in SETTINGS if ACCEPTANCE in asked else ():
        yield _ensemble(one)
    for scenario in (LATERAL, INTERMEDIATE, DAMPED) if ACCEPTANCE in asked else ():
        yield _by_both(scenario)
    if PAPER in asked:
        yield from _paper(quick=quick)


def _ensemble(one: Setting) -> Unit:
    """All its runs."""
    posed = one.scenario
    key = ("ensemble", one.name, one.seeds, posed.fibres, posed.elements, posed.t_end)
    return Unit("groove scenario", f"Bundles: {one.words}", key, partial(gathered, one), in_parts=True)


def _alone(asked: set[str], quick: bool) -> Iterator[Unit]:
    """Single bundles: by both models, and beside their images."""
    for scenario in (LATERAL, INTERMEDIATE) if {SCENARIOS, BESIDE} & asked else ():
        # On the paper's elements, as the difference that is allowed is that of these.
        yield _by_both(brief(scenario) if quick else replace(small(scenario), elements=scenario.elements, t_end=MET))
    for model in MODELS if {SCENARIOS, IMAGE} & asked else ():
        posed = brief(LATERAL) if quick else _short(small(LATERAL))
        words = f"A bundle and its mirror image: {model}"
        yield Unit(
            "groove scenario", words, ("image", model, posed.fibres, posed.t_end), partial(with_image, posed, model)
        )
    if {SCENARIOS, STEPPED} & asked and not quick:
        elastic, model = replace(small(LATERAL), t_end=STRUCK, output=LOOKED), "discrete"
        for law, posed in (("a penalty", elastic), ("a damped penalty", variant(elastic, "damped"))):
            words = f"A bundle in ever shorter steps, {law}: {model}"
            key = ("steps", law, model, posed.fibres, posed.t_end)
            yield Unit("groove scenario", words, key, partial(in_shorter_steps, posed, model))


def _by_both(posed: Scenario) -> Unit:
    title = titled(posed)
    key = ("models", title, posed.fibres, posed.t_end)
    return Unit("groove scenario", f"One bundle by both models: {title}", key, partial(by_both, posed))


def _short(scenario: Scenario) -> Scenario:
    return replace(scenario, t_end=UNTIL, output=STORED)


def _paper(*, quick: bool) -> Iterator[Unit]:
    """Every reading of units and meshes, without air and with it, by both models."""
    for mesh in ("zone",) if quick else MESHES:
        for reading in READINGS:
            for flow, air, full in (("as printed", False, STILL_STEPS), ("with air", True, STEPS)):
                steps = QUICK_STEPS if quick else full
                for model in MODELS:
                    work = partial(as_printed, reading, mesh, model, steps, air=air)
                    words = f"The paper's groove: {reading}, {mesh}, {flow}, {model}"
                    yield Unit("groove scenario", words, ("paper", reading, mesh, flow, model, steps), work)
