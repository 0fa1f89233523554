"""Bundles of fibres as units of work."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.bundles import FEW, MOST, Bundle, measured, on_ranks
from verification.ledger import Unit

__all__ = ["BUNDLES", "listing", "names", "units"]

# Chosen like a family; one model as "bundles:MODEL", the ranks as "bundles:ranks".
BUNDLES, RANKS = "bundles", "bundles:ranks"
# The paper's elements, and cubic ones with three quarters as many nodes, whose errors are far smaller.
MODELS = (Bundle("discrete", 80), Bundle("continuum", 20, 3))
FIBRES, QUICK_FIBRES = (2, FEW, 10, 20, MOST), (2, FEW)
STEPS, QUICK_STEPS, RANK_STEPS = 200, 20, 20


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (BUNDLES, *(asked_as(who) for who in MODELS), RANKS)


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
    if {BUNDLES, RANKS} & set(asked):
        yield f"  {RANKS}", "the same bundle on one rank and on two"


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: Few fibres for few steps, on one rank.

    Yields:
        Units in the order of the report.
    """
    fibres, steps = (QUICK_FIBRES, QUICK_STEPS) if quick else (FIBRES, STEPS)
    for who in MODELS:
        if {BUNDLES, asked_as(who)} & set(asked):
            key = (who.model, who.mesh, steps, *fibres)
            yield Unit("bundle", f"Bundles: {who.model}", key, partial(measured, who, fibres, steps))
    if quick or not {BUNDLES, RANKS} & set(asked):
        return
    who = MODELS[-1]
    for n in (FEW, MOST):
        key = (who.mesh, n, RANK_STEPS)
        yield Unit("bundle", f"Bundle of {n} on two ranks", key, partial(on_ranks, who, n, RANK_STEPS))
