"""The swinging rod, problem P5 of the peers: pinned at one end, released at rest from the horizontal, moving in space.

L = ρA = EI = 1, EA = 1e4, g = 9.81, in metres, kilograms and seconds; with GA = 1e4 and ρI = 1e-4 where it shears. A
rod is solved as each solver takes rods, and held against the solution of the same assumptions.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.case import SKEW
from verification.motions.swing import SHEARABLE, THIN, released

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic, Scene
    from verification.case import Array

__all__ = ["SECTIONS", "SWING", "Swing", "scene", "solution", "tips"]

# By what they allow: strains of a rod of Simo and Reissner; stretch but no shear; neither.
SECTIONS = {"sheared": SHEARABLE, "stretched": THIN, "rigid": replace(THIN, rigid=frozenset({"shear", "extension"}))}


@dataclass(frozen=True)
class Swing:
    """The problem in numbers, as an adapter is told it.

    Args:
        name: Under which adapters know it.
        times: At which the tip is read off, equally far apart [s].
        length: Of the rod [m].
        rhoA: Mass per length [kg/m].
        rhoI: Rotary inertia about d2 and d3, of rods that shear; twice as much about d1 [kg m].
        EA: Against stretch [N].
        GA: Against shear [N].
        GJ: Against twist, of which there is none [N m²].
        EI: Against bending [N m²].
        g: Gravity, across the rod [m/s²].
    """

    name: str = "swing"
    times: tuple[float, ...] = tuple(k / 20 for k in range(1, 21))
    length: float = 1.0
    rhoA: float = 1.0
    rhoI: float = 1e-4
    EA: float = 1e4
    GA: float = 1e4
    GJ: float = 1.0 / 1.3
    EI: float = 1.0
    g: float = 9.81


SWING = Swing()


def scene(assumes: str, motion: Dynamic) -> Scene:
    """The problem for our models, in no coordinate plane.

    Args:
        assumes: A key of `SECTIONS`.
        motion: How time is stepped.
    """
    return released(SECTIONS[assumes], motion)


def tips(result: Result) -> Array:
    """Where the tip was at the times of the problem, in the problem's axes, shape (times, 3) [m]."""
    h = result.rods[0]
    at = [int(np.argmin(np.abs(result.t - t))) for t in SWING.times]
    return np.array([SKEW.back(h.r[k, -1], SWING.length) for k in at])


def solution(assumes: str) -> Array:
    """Where the tip should be, shape (times, 3) [m].

    Args:
        assumes: A key of `SECTIONS`.

    Returns:
        By `reference`, good to 2e-5 of the length.
    """
    x_y = np.asarray(_table()[assumes]["tip"], dtype=float)
    return np.column_stack([x_y, np.zeros(len(x_y))])


@cache
def _table() -> dict[str, Any]:
    """What `python -m verification.peers.reference` wrote."""
    text = files("verification.peers").joinpath("swing.json").read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found
