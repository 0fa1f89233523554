"""How fast other people's solvers are, as measured for this project in November 2026."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

__all__ = ["Peer", "peers", "peers_measured"]


@dataclass(frozen=True)
class Peer:
    """The quickest solver found for an accuracy.

    Args:
        who: Solver and element.
        kinematics: "planar" or "spatial".
        error: Accuracy reached, |tip − reference|/L.
        ms: Time of a warm solve [ms].
    """

    who: str
    kinematics: str
    error: float
    ms: float


def peers(problem: str) -> tuple[Peer, ...]:
    """Published figures of a problem, "elastica" (P L²/EI = 10) or "bend" (45°, 600)."""
    return tuple(Peer(**entry) for entry in _table()[problem])


def peers_measured() -> str:
    """When and how they were measured."""
    return str(_table()["measured"])


@cache
def _table() -> dict[str, Any]:
    text = files("verification.references").joinpath("peers.json").read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found
