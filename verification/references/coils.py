"""Curves that coil, and what their twist, writhe and linking numbers should be, with provenance: coils.json.

Its entries are of `shared/reference`, cases M: closed forms of helices and ropes, Gauss integrals of closed curves by
the trapezoidal rule on smooth curves with extrapolation, never by polygons.
"""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.references.moving import Moving

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = [
    "EIGHT",
    "RIBBON",
    "TORUS",
    "TREFOIL",
    "WAVE",
    "coil",
    "eight",
    "helix",
    "rigid_bundle",
    "round_about",
    "torus",
    "trefoil",
    "wave",
]

# Parameters of the closed curves, as in the entries' names.
TORUS = ((1.0, 0.3, 2, 3), (1.0, 0.25, 1, 5))
WAVE, EIGHT, TREFOIL = (0.4, 2), (0.3,), (1.0,)
RIBBON = (1.0, 0.3, 1, 4)
# As many fibres as the paper's yarn has, of its diameter [m].
FIBRES, DIAMETER = 57, 20e-6


def coil(name: str, quantity: str) -> Moving:
    """A tabulated quantity.

    Args:
        name: Id of the entry.
        quantity: Out of it.

    Returns:
        The reference.
    """
    entry = _table()[name]
    return Moving(
        id=f"{name}, {quantity}",
        value=(float(entry["quantities"][quantity]),),
        method=entry["method"],
        source=entry["source"],
        digits_trusted=entry["digits_trusted"],
    )


@cache
def _table() -> dict[str, dict[str, Any]]:
    text = files("verification.references").joinpath("coils.json").read_text(encoding="utf-8")
    found: dict[str, dict[str, Any]] = json.loads(text)
    return found


def helix(t: Array, r: float, pitch: float, phase: float = 0.0) -> Array:
    """Right-handed about +X, t in turns, shape (n, 3)."""
    φ = 2.0 * np.pi * t + phase
    return np.stack([pitch * t, r * np.cos(φ), r * np.sin(φ)], axis=1)


def torus(t: Array, R: float, a: float, p: int, q: int) -> Array:
    """On a torus, p times round it and q times through it, t from 0 to 1, shape (n, 3)."""
    φ, ψ = 2.0 * np.pi * p * t, 2.0 * np.pi * q * t
    return np.stack([(R + a * np.cos(ψ)) * np.cos(φ), (R + a * np.cos(ψ)) * np.sin(φ), a * np.sin(ψ)], axis=1)


def wave(t: Array, b: float, m: int) -> Array:
    """A circle that swings m times out of its plane, t from 0 to 1, shape (n, 3)."""
    φ = 2.0 * np.pi * t
    return np.stack([np.cos(φ), np.sin(φ), b * np.sin(m * φ)], axis=1)


def eight(t: Array, b: float) -> Array:
    """An eight of which one strand passes over the other, t from 0 to 1, shape (n, 3)."""
    φ = 2.0 * np.pi * t
    return np.stack([np.sin(φ), 0.5 * np.sin(2.0 * φ), b * np.cos(φ)], axis=1)


def trefoil(t: Array, c: float) -> Array:
    """A left-handed knot, t from 0 to 1, shape (n, 3)."""
    φ = 2.0 * np.pi * t
    return np.stack(
        [np.sin(φ) + 2.0 * np.sin(2.0 * φ), np.cos(φ) - 2.0 * np.cos(2.0 * φ), -c * np.sin(3.0 * φ)], axis=1
    )


def round_about(n: int) -> Array:
    """Points of a closed curve, t from 0 to 1 without its end."""
    return np.arange(n) / n


def packed(n: int) -> Array:
    """Places of the n fibres nearest to the middle in a hexagonal packing, shape (n, 2) [m]."""
    i, j = (index.ravel() for index in np.meshgrid(np.arange(-6, 7), np.arange(-6, 7)))
    places = DIAMETER * np.stack([i + 0.5 * j, np.sqrt(0.75) * j], axis=1)
    return places[np.lexsort((np.arctan2(places[:, 1], places[:, 0]), (1e9 * np.hypot(*places.T)).round()))[:n]]


def rigid_bundle(angle: Array, X: Array, n: int = FIBRES) -> list[Array]:
    """Fibres whose sections have turned about X by an angle each.

    Args:
        angle: Of each section, shape (n_X,) [rad].
        X: Of each, shape (n_X,) [m].
        n: How many fibres.

    Returns:
        Points of each, shape (n_X, 3) [m].
    """
    c, s = np.cos(angle), np.sin(angle)
    return [np.stack([X, y * c - z * s, y * s + z * c], axis=1) for y, z in packed(n)]
