"""How far other people's solvers go in one load step, and in how few they solve a problem, as measured in 2026."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

__all__ = ["PEER_LOADS", "PEER_PROBLEMS", "PeerLoads", "PeerSteps", "peer_loads", "peer_steps", "robustness_measured"]

# What the problems of fewest steps are called in a table.
PEER_PROBLEMS = {
    "P1": "elastica, 10",
    "P2a": "roll-up, 2π",
    "P2b": "roll-up, 4π",
    "P3": "45° bend, 600",
    "P4": "column, 1.5 P_cr",
    "P6": "fibre, 10",
}
PEER_LOADS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)


@dataclass(frozen=True)
class PeerLoads:
    """Tip loads in one load step on 16 elements.

    Args:
        who: Solver and element.
        iterations: Newton iterations at each load P L²/EI of `PEER_LOADS`; None: failed, or another equilibrium.
    """

    who: str
    iterations: tuple[int | None, ...]

    @property
    def largest(self) -> float:
        """Largest load taken, 0 where none was."""
        taken = (load for load, n in zip(PEER_LOADS, self.iterations, strict=True) if n is not None)
        return max(taken, default=0.0)


@dataclass(frozen=True)
class PeerSteps:
    """Fewest equal load steps with which a problem was solved.

    Args:
        who: Solver and element.
        steps: Their number; None: none of those tried, up to 128.
    """

    who: str
    steps: int | None


def peer_loads() -> tuple[PeerLoads, ...]:
    """One row a peer, as published."""
    return tuple(PeerLoads(who, tuple(found)) for who, found in _table()["one_step"].items())


def peer_steps(problem: str) -> tuple[PeerSteps, ...]:
    """Peers that were tried on a problem.

    Args:
        problem: One of `PEER_PROBLEMS`; none of another name.

    Returns:
        One row a peer.
    """
    rows = _table()["fewest_steps"].items()
    return tuple(PeerSteps(who, found[problem]) for who, found in rows if problem in found)


def robustness_measured() -> str:
    """When and how they were measured."""
    return str(_table()["measured"])


@cache
def _table() -> dict[str, Any]:
    text = files("verification.references").joinpath("robustness.json").read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found
