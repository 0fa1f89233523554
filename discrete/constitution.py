"""What an element law answers for, whichever it is: statics and motions ask it alike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Element"]


class Element(Protocol):
    """Law of an element; see `corotation.ChordElement` for arguments and shapes."""

    def chord(self, u: Array, E: Array, F_n: Array) -> Array:
        """Chord of a direction whose elongation obeys Eq. 16."""
        ...

    def axial(self, N: Array, u: Array, E: Array) -> Array:
        """Axial force of a spatial force."""
        ...

    def measure(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces and strain energy."""
        ...

    def respond(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces and their derivative."""
        ...
