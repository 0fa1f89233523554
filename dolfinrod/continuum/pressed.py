"""Equilibrium of rods against walls: straight away, by way of softer walls, and with renewed multipliers.

Where rods that move meet rods, shorter steps lead there sooner than softer contact does: mass holds what is pressed.
"""

from __future__ import annotations

from dataclasses import replace
from math import ceil, log
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from dolfinrod.continuum.newton import Outcome
    from dolfinrod.continuum.pairs import Pairs
    from dolfinrod.continuum.together import Touching

    Find = Callable[[int, float], Outcome]
    Lost = Callable[[], bool]

__all__ = ["DIRECT", "ROUGH", "Attempts"]

# Iterations after which a wall is approached by way of softer ones: what is pressed then changes little by little.
DIRECT = 20
# Iterations after which a step of such rods is lost, and such steps, one after the other, before it is softened.
BRIEF, SHORTER = 8, 2
# Stiffness of the softest in EI/L⁴, against which a rod bends over a tenth of its length, and of each over the last.
SOFTEST, STIFFER = 1e5, 100.0
# Increments, relative to the unknowns, at which a softer wall has told enough.
ROUGH = 0.1
# And at which multipliers may be renewed: what they change is found with the rest.
NEARLY = 1e-2
# Renewals of multipliers after which a step is given up.
MOST_RENEWALS = 50
PENETRATES = "penetrations stayed above the tolerance of an augmented Lagrangian: its eps_N is too small for these rods"


class Attempts:
    """How equilibrium against walls is sought.

    Args:
        pairs: Of rods that may meet as they move; None: there are none, or nothing moves.
    """

    def __init__(self, pairs: Pairs | None) -> None:
        self._pairs, self._lost = pairs, 0

    def made(self, x: NDArray[np.float64], contacts: Touching, find: Find, most: int, fine: float) -> Outcome:
        """Equilibrium with multipliers in line with it; arguments as for `pressed`."""
        pairs = self._pairs
        lost = None if pairs is None or self._lost >= SHORTER else lambda: pairs.near
        found = renewed(contacts, lambda fine: pressed(x, contacts, find, most, fine, lost), fine)
        self._lost = 0 if found.converged else self._lost + 1
        return found


def pressed(
    x: NDArray[np.float64], contacts: Touching, find: Find, most: int, fine: float, lost: Lost | None = None
) -> Outcome:
    """Equilibrium with multipliers as they are.

    Args:
        x: State on this rank.
        contacts: What the rods touch.
        find: Newton's method from the state on: most iterations, and increments at which it is done.
        most: Iterations allowed in the last stage.
        fine: Increments at which that is done.
        lost: Whether to leave it at few iterations that have not led there; None: never.

    Returns:
        How it ended, all iterations counted.
    """
    start = x.copy()
    stages = max(0, ceil(log(max(contacts.stiffness / SOFTEST, 1.0), STIFFER)))
    direct = DIRECT if stages else most
    found = find(direct, fine) if lost is None else _in_two(find, direct, fine, lost)
    if found.converged or not stages or (lost is not None and lost()):
        return found
    spent = found.iterations
    x[:] = start
    for k in range(stages, 0, -1):
        contacts.soften(STIFFER**k)
        before = x.copy()
        found = find(most, ROUGH)
        spent += found.iterations
        if not found.converged:
            x[:] = before
    contacts.soften(1.0)
    found = find(most, fine)
    return replace(found, iterations=spent + found.iterations)


def _in_two(find: Find, most: int, fine: float, lost: Lost) -> Outcome:
    """Newton's method, asked after `BRIEF` iterations whether it is to go on."""
    found = find(BRIEF, fine)
    if found.converged or found.iterations < BRIEF or lost():
        return found
    more = find(most - BRIEF, fine)
    return replace(more, iterations=found.iterations + more.iterations)


def renewed(contacts: Touching, find: Callable[[float], Outcome], fine: float) -> Outcome:
    """Equilibrium with multipliers in line with it.

    Args:
        contacts: What the rods touch.
        find: Equilibrium from the state on, multipliers as they are, up to increments of a size.
        fine: Increments at which it is done.

    Returns:
        How it ended, all iterations counted.
    """
    if not contacts.renews:
        return find(fine)
    found = find(NEARLY)
    for _ in range(MOST_RENEWALS):
        if not found.converged:
            return found
        done = contacts.renew()
        again = find(fine if done else NEARLY)
        found = replace(again, iterations=found.iterations + again.iterations, strayed=found.strayed)
        if done and contacts.renew():
            return found
    return replace(found, converged=False, reason=PENETRATES)
