"""What an iteration does that tells it will not settle, or settles on the wrong turn of an element."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import log

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Elements

    Array = NDArray[np.float64]

__all__ = ["ALIASED", "VANISHED", "WANDERING", "Watch"]

WANDERING = "the sections turned back and forth"
ALIASED = "sections at the ends of an element turned by half a turn against each other, more than it can tell"
VANISHED = "an element was pressed to nothing"
# What a section may turn in excess of its net turn before the iteration is given up [rad]. Those that settle from a
# whole follower load of 20 EI/L² spend 5 on going back and forth, those that never settle 3/4 an iteration.
MOST_WANDERING = 8.0
# The first increment is the rate of the path: a rod that turned the other way in the end, by more than this [rad], has
# gone to another branch.
STRAYED = 1e-2
# Turn of the ends of an element against each other at which it is refused [rad]; half a turn and less are one.
MOST_TURNED = 0.95 * np.pi


class Watch:
    """Turns of all sections during one attempt.

    Args:
        elements: The elements.
        R: Section frames at the start, shape (n_nodes, 3, 3).
    """

    def __init__(self, elements: Elements, R: Array) -> None:
        self._elements = elements
        self._way, self._net = np.zeros(len(R)), np.zeros((len(R), 3))
        self._set_out: Array | None = None
        self._between = self._measured(R)
        self._bound = float(_lengths(self._between).max())

    @property
    def turned(self) -> float:
        """Largest net turn of a section so far [rad]."""
        return float(_lengths(self._net).max())

    @property
    def strayed(self) -> bool:
        """Whether the sections have turned, in all, against the way they set out, as to a mirrored branch."""
        return self._set_out is not None and self.turned > STRAYED and float(np.vdot(self._net, self._set_out)) < 0.0

    @property
    def apart(self) -> float:
        """Largest turn of the ends of an element against each other [rad]; a bound from above once seen to be small."""
        return self._bound

    @property
    def wandering(self) -> bool:
        """Whether some section has turned much farther than it got."""
        return bool((self._way - _lengths(self._net)).max() > MOST_WANDERING)

    def see(self, spin: Array, R: Array) -> None:
        """Take note of an iteration.

        The turn between the ends of an element is known up to whole turns about its axis: of these the one nearest to
        that before the iteration is taken. As long as no element can have reached half a turn nothing is measured.

        Args:
            spin: Spins of the sections in this iteration, shape (n_nodes, 3).
            R: Section frames after it.
        """
        self._way += _lengths(spin)
        self._net += spin
        if self._set_out is None:
            self._set_out = spin
        node_i = self._elements.node_i
        self._bound += float(_lengths(spin[node_i + 1] - spin[node_i]).max())
        if self._bound < MOST_TURNED:
            return
        between = self._measured(R)
        angle = _lengths(between)
        axis = between / np.maximum(angle, 1e-300)[:, None]
        turns = np.round((np.einsum("ni,ni->n", axis, self._between) - angle) / (2 * np.pi))
        self._between = between + 2 * np.pi * turns[:, None] * axis
        self._bound = float(_lengths(self._between).max())

    @property
    def aliased(self) -> bool:
        """Whether the ends of an element have turned too far against each other."""
        return self._bound >= MOST_TURNED

    def _measured(self, R: Array) -> Array:
        """Rotation vectors of the ends of the elements against each other, shape (n, 3)."""
        E = self._elements.triads(R)
        return log(np.swapaxes(E[:, 0], 1, 2) @ E[:, 1])


def _lengths(vectors: Array) -> Array:
    return np.sqrt(np.einsum("ni,ni->n", vectors, vectors))
