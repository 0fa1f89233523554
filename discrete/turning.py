"""How chords turn while their ends move, and how far anything may turn at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import cross

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["LARGEST_TURN", "chord_spin"]

# Largest turn of a section or chord in one iteration [rad].
LARGEST_TURN = 1.5


def chord_spin(u: Array, change: Array, spin: Array, e: Array) -> Array:
    """Spin of a chord: as its ends move across it, u×δe/L, and along it as the sections turn on the mean.

    The second part leaves u as it is when small; without it a large increment would turn chords and sections about
    different axes and tear them apart.
    """
    length = np.sqrt(np.einsum("ni,ni->n", e, e))
    return cross(u, change) / length[:, None] + np.einsum("ni,ni->n", u, spin)[:, None] * u
