"""The race as units of work: everybody on the swinging rod, in one run."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.ledger import Unit
from verification.peers.environment import installed
from verification.peers.others import OTHERS, others_measured
from verification.peers.ours import OURS, ours_measured
from verification.peers.swing import SWING

__all__ = ["PEERS", "listing", "units"]

# Chosen like a family.
PEERS = "peers"
ABSENT = "absent"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title, where asked for."""
    if PEERS in asked:
        yield PEERS, "other people's solvers and our models on a swinging rod (./run peers installs them)"


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Names; others than `PEERS` are passed over.
        quick: One setting of each.

    Yields:
        One unit a solver; what was absent is asked again once it is there.
    """
    if PEERS not in asked:
        return
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
