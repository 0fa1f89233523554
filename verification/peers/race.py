"""The race as units of work: everybody on rods in equilibrium, swinging, and on rough surfaces, in one run."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.ledger import Unit
from verification.peers.environment import installed
from verification.peers.onestep import ONCE, ONCE_OURS, others_at_once, ours_at_once
from verification.peers.others import OTHERS, others_measured
from verification.peers.ours import OURS, ours_measured
from verification.peers.rodothers import rod_others_measured, together
from verification.peers.rodours import ROD_OURS, rod_ours_measured
from verification.peers.rods import RODS
from verification.peers.rough import ROUGH
from verification.peers.roughothers import ROUGH_OTHERS, rough_others_measured
from verification.peers.roughours import ROUGH_OURS, rough_ours_measured
from verification.peers.swing import SWING

__all__ = ["PEERS", "listing", "units"]

# Chosen like a family.
PEERS = "peers"
ABSENT = "absent"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title, where asked for."""
    if PEERS in asked:
        yield PEERS, "other people's solvers and our models on the same rods (./run peers installs them)"


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Names; others than `PEERS` are passed over.
        quick: Fewer problems, settings and repetitions.

    Yields:
        One unit a solver and problem; what was absent is asked again once it is there.
    """
    if PEERS in asked:
        yield from _rods(quick)
        yield from _once()
        yield from _swing(quick)
        yield from _rough(quick)


def _rods(quick: bool) -> Iterator[Unit]:
    """Rods in equilibrium."""
    environment = installed()
    stamp = ABSENT if environment is None else environment.stamp
    extent = "quick" if quick else "full"
    for problem in RODS:
        if quick and not problem.quick:
            continue
        for own in ROD_OURS:
            if own.poses(problem):
                words = f"{problem.name}: {own.taker.name}, {own.taker.assumes}"
                parameters = (problem.name, own.taker.name, own.taker.assumes, extent)
                yield Unit("peer", words, parameters, partial(rod_ours_measured, own, problem, quick=quick))
        # Those that come to rest take seconds, and compile for a minute before.
        for others in (others for others in together() if not (quick and others[0].relaxes)):
            words = f"{problem.name}: {others[0].package}"
            parameters = (problem.name, others[0].package, stamp, extent)
            yield Unit(
                "peer", words, parameters, partial(rod_others_measured, others, problem, environment, quick=quick)
            )


def _once() -> Iterator[Unit]:
    """Whole loads at once."""
    environment = installed()
    stamp = ABSENT if environment is None else environment.stamp
    for taker, model in ONCE_OURS:
        words = f"Tip loads in one step: {taker.name}, {taker.assumes}"
        yield Unit("peer", words, (ONCE, taker.name, taker.assumes), partial(ours_at_once, taker, model))
    for others in (others for others in together() if not others[0].relaxes):
        words = f"Tip loads in one step: {others[0].package}"
        yield Unit("peer", words, (ONCE, others[0].package, stamp), partial(others_at_once, others, environment))


def _swing(quick: bool) -> Iterator[Unit]:
    """The swinging rod."""
    environment = installed()
    stamp = ABSENT if environment is None else environment.stamp
    extent = "quick" if quick else "full"
    for own in OURS:
        words = f"Swinging rod: {own.taker.name}, {own.taker.assumes}"
        parameters = (SWING.name, own.taker.name, own.taker.assumes, extent)
        yield Unit("peer", words, parameters, partial(ours_measured, own, quick=quick))
    for other in OTHERS:
        words = f"Swinging rod: {other.taker.name}"
        parameters = (SWING.name, other.taker.name, stamp, extent)
        yield Unit("peer", words, parameters, partial(others_measured, other, environment, quick=quick))


def _rough(quick: bool) -> Iterator[Unit]:
    """Rods on rough surfaces."""
    environment = installed()
    stamp = ABSENT if environment is None else environment.stamp
    extent = "quick" if quick else "full"
    for own in ROUGH_OURS:
        words = f"{own.problem.name}: {own.taker.name}"
        yield Unit(
            "peer", words, (own.problem.name, own.taker.name, extent), partial(rough_ours_measured, own, quick=quick)
        )
    for problem in ROUGH:
        for other in ROUGH_OTHERS:
            words = f"{problem.name}: {other.taker.name}"
            parameters = (problem.name, other.taker.name, stamp, extent)
            yield Unit(
                "peer", words, parameters, partial(rough_others_measured, other, problem, environment, quick=quick)
            )
