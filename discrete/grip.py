"""Equilibrium of rods against surfaces: straight away, by way of softer walls, and with renewed multipliers.

Newton's method is exact as long as the same nodes touch and stick. What increments did not foretell, above all that
other nodes do, is measured where they have become small; and where an iteration comes back to a set of nodes that it
has left before, it has begun to go round in circles.
"""

from __future__ import annotations

from dataclasses import replace
from math import ceil, isfinite, log
from typing import TYPE_CHECKING

import numpy as np

from discrete.pivots import completed
from discrete.rounds import Rounds
from discrete.unknowns import X

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from discrete.nodes import Tangent
    from discrete.state import Outcome, State
    from discrete.surroundings import Surroundings
    from discrete.touched import Touched

    Array = NDArray[np.float64]
    Find = Callable[..., Outcome]

__all__ = ["DEEP", "HALF_TURN", "MOST_RENEWALS", "ROLLED", "ROUGH", "Grip", "gripped"]

# Iterations after which walls are approached by way of softer ones: what touches then changes little by little.
DIRECT = 20
# Stiffness of the softest in EI/L⁴, against which a rod bends over a tenth of its length, and of each over the last.
SOFTEST, STIFFER = 1e5, 100.0
# Increments in L and radians at which a softer wall has told enough.
ROUGH = 0.1
# And at which multipliers may be renewed: what they change is found with the rest.
NEARLY = 1e-2
# Ways in L after which a linear step tells nothing of what it presses.
FAR = 1.0
# Trials in which it is found out what a step turning more than that presses, before anything moves.
FORESIGHTS = 2
# Renewals of multipliers after which they have failed.
MOST_RENEWALS = 50
DEEP = f"rods were deeper in a surface than its tolerance after {MOST_RENEWALS} renewals: its eps_N is too small"
# Turn in one step beyond which it is not told from the other way round [rad].
HALF_TURN = 3.0
ROLLED = "a rod that rubs on a surface turned by about half a turn in one step, more than friction can tell"
# Units in the last place of a position, of what is added up to find it.
ROUND_OFF = 8.0 * float(np.finfo(float).eps)


class Grip:
    """Surfaces during one iteration.

    Args:
        contacts: The contacts of the scene, about to take a step.
        most: Iterations allowed: `DIRECT` where softer walls come next.
        fine: Increments at which it is done.

    Attributes:
        touched: Resistance where `press` was asked for last.
        fine: As above.
    """

    touched: Touched

    def __init__(self, contacts: Surroundings, most: int, fine: float) -> None:
        self._contacts, self._rounds, self._direct = contacts, Rounds(), most == DIRECT
        self._gives_way = False
        self.fine, self._foresights = fine, FORESIGHTS if self._direct else 0

    def press(self, state: State) -> Array:
        """Forces and moments with which the next increments are found, shape (n_nodes, 7)."""
        self._force, self._reach = self._contacts.force(state.x, state.R), self._contacts.reach(state.x)
        self.touched = self._contacts.blocks()
        return self._force

    def pivoted(self, state: State, d: Array, tangent: Tangent) -> Array:
        """Increments with which surfaces press what they should where these lead, d of all nodes as for `part`.

        Args:
            state: Where they are taken.
            d: With the tangent as it is.
            tangent: That.
        """
        walls, others = self._contacts.walls, self._contacts.others
        # Rods that touch others exchange points of these, too, of which the set would know nothing.
        if walls is None or others is not None or self._gives_way or self.fine >= ROUGH:
            return d
        if np.abs(d[:, X]).max() > FAR:
            return d
        missing = completed(walls, state.x + d[:, X], tangent, self._contacts.units)
        self._gives_way = missing is None
        return d if missing is None else d + missing

    def part(self, change: float, d: Array) -> float:
        """Part of increments to be taken: half of those that lead round in a circle, no leap of rods past each other.

        Args:
            change: Their size.
            d: Of all nodes, shape (n_nodes, 7).
        """
        half = 0.5 if self._rounds.overshoots(self._contacts.sets, change) else 1.0
        way = float(np.sqrt(np.einsum("ni,ni->n", d[:, X], d[:, X]).max()))
        return min(half, self._contacts.part(way))

    @property
    def lost(self) -> bool:
        """Whether the iteration goes round in circles, or is to be given up for softer walls as it only creeps."""
        return self._rounds.circling or (self._direct and (self._rounds.creeping or self._gives_way))

    def foresees(self, x: Array, turn: float) -> bool:
        """Whether so long a step presses other nodes than it was taken with: it is taken anew with these first."""
        if turn <= ROUGH or not self._foresights or not self._contacts.foresee(x):
            return False
        self._foresights -= 1
        return True

    def surprise(self, d: Array, state: State) -> float:
        """Largest difference of the forces in a state from what increments foretold, beyond round-off of positions."""
        was_forced = self._contacts.forced
        force, foretold = self._contacts.force(state.x, state.R), self._force + self.touched.change(d)
        if was_forced or self._contacts.forced:
            return 1.0
        blurred = ROUND_OFF * self._reach * self.touched.stiffest
        return max(0.0, float(np.abs(force - foretold).max()) - blurred)


def gripped(
    contacts: Surroundings, state: State, t: float, trust: float, find: Find, most: int, fine: float
) -> Outcome:
    """Equilibrium against surfaces.

    Args:
        contacts: The contacts of the scene.
        state: First guess.
        t: Pseudo-time.
        trust: As for `Equilibrium.find`; finite where the guess goes on as the last step went.
        find: Newton's method from a state on: most iterations, increments at which it is done, and trust.
        most: Iterations allowed.
        fine: Increments at which it is done.

    Returns:
        How it ended, all iterations counted.
    """
    contacts.begin(t)
    contacts.cling()
    if isfinite(trust):
        contacts.glide()
    found = (_renewed if contacts.renews else _pressed)(contacts, state, trust, find, most, fine)
    pierced = contacts.pierced if found.converged else ""
    if pierced:
        return replace(found, converged=False, reason=pierced)
    if found.converged and found.turned > HALF_TURN and contacts.rubbing:
        return replace(found, converged=False, reason=ROLLED)
    return replace(found, strayed=found.strayed and not contacts.changed)


def _renewed(contacts: Surroundings, state: State, trust: float, find: Find, most: int, fine: float) -> Outcome:
    """Equilibrium with multipliers in line with it: these are renewed where increments have become small."""
    found = _pressed(contacts, state, trust, find, most, NEARLY)
    for _ in range(MOST_RENEWALS):
        if not found.converged:
            return found
        done = contacts.renew()
        found = _after(found, find(found.state, most, fine if done else NEARLY))
        if done and found.converged and contacts.renew():
            return found
    return replace(found, converged=False, reason=DEEP)


def _pressed(contacts: Surroundings, state: State, trust: float, find: Find, most: int, fine: float) -> Outcome:
    """Equilibrium with multipliers as they are."""
    stages = max(0, ceil(log(max(contacts.stiffness / SOFTEST, 1.0), STIFFER)))
    found = find(state, DIRECT if stages else most, fine, trust)
    # What friction turns has a path: a shorter step along it takes fewer iterations than softer walls do.
    if found.converged or not stages or isfinite(trust) or (contacts.met and contacts.rubbing):
        return found
    for k in range(stages, 0, -1):
        contacts.soften(STIFFER**k)
        softer = find(state, most, ROUGH)
        found = _after(found, softer)
        if softer.converged:
            state = softer.state
    contacts.soften(1.0)
    return _after(found, find(state, most, fine))


def _after(before: Outcome, found: Outcome) -> Outcome:
    """What was found, with what was spent before."""
    iterations, turned = before.iterations + found.iterations, before.turned + found.turned
    return replace(found, iterations=iterations, turned=turned, strayed=before.strayed or found.strayed)
