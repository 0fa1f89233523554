"""Bundles of fibres as units of work."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.bundles import FEW, MOST, Bundle, measured, on_ranks
from verification.ledger import Unit
from verification.scaling import ensembles, scaled

__all__ = ["BUNDLES", "LONG", "listing", "names", "units"]

# Chosen like a family; one model as "bundles:MODEL", the ranks as "bundles:ranks" and "bundles:scaling".
BUNDLES, RANKS, SCALING = "bundles", "bundles:ranks", "bundles:scaling"
# The same with as many steps as cost asks for: hours, so only where it is asked for by name.
LONG = "bundles-long"
# The paper's elements, and cubic ones with three quarters as many nodes, whose errors are far smaller.
MODELS = (Bundle("discrete", 80), Bundle("continuum", 20, 3))
FIBRES, QUICK_FIBRES = (2, FEW, 10, 20, MOST), (2, FEW)
STEPS, QUICK_STEPS, LONG_STEPS = 20, 20, 200
# Of the ensemble: bundles, and steps of each.
RUNS, RUN_STEPS = 10, 400


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (BUNDLES, *(asked_as(who) for who in MODELS), RANKS, SCALING, LONG)


def asked_as(who: Bundle) -> str:
    """Under which a model is asked for."""
    return f"{BUNDLES}:{who.model}"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented; others are passed over."""
    if set(names()) & set(asked):
        yield BUNDLES, "what bundles of more and more fibres cost"
    for who in MODELS:
        if {BUNDLES, asked_as(who)} & set(asked):
            yield f"  {asked_as(who)}", f"{FIBRES[0]} to {MOST} fibres by the {who.model} model"
    for name, words in ((RANKS, "the same bundle on one rank and on two"), (SCALING, "how much quicker ranks are")):
        if {BUNDLES, name} & set(asked):
            yield f"  {name}", words
    if LONG in asked:
        yield LONG, f"the same with {LONG_STEPS} steps each, which takes hours"


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Few fibres for few steps, on one rank.

    Yields:
        Units in the order of the report.
    """
    wanted = set(asked)
    for who in MODELS:
        if {BUNDLES, asked_as(who)} & wanted:
            yield _growth(who, QUICK_FIBRES if quick else FIBRES, QUICK_STEPS if quick else STEPS)
        if LONG in wanted:
            yield _growth(who, FIBRES, LONG_STEPS)
    if not quick and {BUNDLES, RANKS} & wanted:
        work = partial(on_ranks, MODELS[-1], FEW, STEPS)
        yield Unit("bundle", f"Bundle of {FEW} on two ranks", (MODELS[-1].mesh, FEW, STEPS), work, alone=True)
    if not quick and {BUNDLES, RANKS, SCALING} & wanted:
        # Of many fibres where they end is compared in the same solves.
        yield _scaling(STEPS)
    if not quick and {BUNDLES, SCALING} & wanted:
        words, runs = f"Ensemble of {RUNS} on two ranks", partial(ensembles, RUNS, RUN_STEPS)
        yield Unit("bundle", words, ("ensembles", RUNS, RUN_STEPS), runs, alone=True)
    if LONG in wanted:
        yield _scaling(LONG_STEPS)


def _growth(who: Bundle, fibres: tuple[int, ...], steps: int) -> Unit:
    key: tuple[str | int, ...] = (who.model, who.mesh, steps, *fibres)
    return Unit("bundle", f"Bundles: {who.model}, {steps} steps", key, partial(measured, who, fibres, steps))


def _scaling(steps: int) -> Unit:
    words = f"Scaling of a bundle of {MOST}, {steps} steps"
    return Unit("bundle", words, ("scaling", MOST, steps), partial(scaled, MODELS[-1], MOST, steps), alone=True)
