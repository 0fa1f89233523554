"""References that `bvp` computes: kept in bvp.json once computed, computed at once where they are not there.

`python -m verification.cases` computes those of all cases anew and writes the file.
"""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from verification.references.bvp import Solution, solve
from verification.references.posed import Problem
from verification.references.reference import Reference, Vector
from verification.references.retrace import retraced

__all__ = ["Entry", "Solved", "computed", "solved"]

# Panels and Gauss points of the second solution.
FINER = (9, 16)


class Entry(TypedDict):
    """What is kept: fingerprint of the problem, position [m], and how well it is known [m]."""

    problem: str
    value: Vector
    agreement: float


@dataclass(frozen=True)
class Solved(Reference):
    """A position on a rod in equilibrium that can be computed anew.

    Args:
        problem: The rod.
        at: Arc length of the position [m].
    """

    problem: Problem
    at: float

    def centreline(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of the whole rod at arc lengths (n,), shape (n, 3) [m]."""
        return _solution(self.problem).centreline(s)


def solved(name: str, problem: Problem, at: float) -> Solved:
    """Position of a section by the boundary-value problem.

    Args:
        name: Under which it is kept.
        problem: The rod.
        at: Arc length of the section [m].

    Returns:
        The reference, from the file where that holds the very same problem.
    """
    kept = _kept().get(name)
    entry = kept if kept is not None and kept["problem"] == _fingerprint(problem, at) else computed(problem, at)
    x, y, z = entry["value"]
    return Solved(
        id=name,
        value=(x, y, z),
        method="Gauss collocation, repeated on more panels and retraced by DOP853 steps",
        source="verification/references/bvp.py: Simo–Reissner rod as a boundary-value problem",
        digits_trusted=int(-np.log10(entry["agreement"] / problem.length)),
        agreement=entry["agreement"],
        problem=problem,
        at=at,
    )


@cache
def computed(problem: Problem, at: float) -> Entry:
    """The same without the file.

    Args:
        problem: The rod.
        at: Arc length of the section [m].

    Returns:
        What the file would keep. Its agreement is the largest of the differences to a finer collocation and to the
        retraced rod, and no better than 1e-14 of the length.
    """
    solution = _solution(problem)
    panels, points = FINER
    s = np.array([at])
    value = solution.centreline(s)[0]
    refined = float(np.linalg.norm(solve(problem, panels=panels, points=points).centreline(s)[0] - value))
    x, y, z = value.tolist()
    agreement = max(refined, problem.length * max(retraced(solution), 1e-14))
    return Entry(problem=_fingerprint(problem, at), value=(x, y, z), agreement=float(f"{agreement:.1e}"))


@cache
def _solution(problem: Problem) -> Solution:
    return solve(problem)


@cache
def _kept() -> dict[str, Entry]:
    """What the file holds, by name."""
    found: dict[str, Entry] = json.loads(files("verification.references").joinpath("bvp.json").read_text("utf-8"))
    return found


def _fingerprint(problem: Problem, at: float) -> str:
    """Of all numbers to twelve digits: another machine's last digit makes no other problem."""
    text = re.sub(r"-?\d+\.\d*(e[+-]?\d+)?", lambda found: f"{float(found[0]) + 0.0:.12g}", f"{problem!r} at {at!r}")
    return hashlib.sha256(text.encode()).hexdigest()[:16]
