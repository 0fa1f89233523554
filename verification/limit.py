"""How near an iteration is to what it cannot do without: factors and solution of a band, as LAPACK alone takes them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

__all__ = ["TWICE", "Limit", "limit", "told"]

# Factors and solution of an iteration, over those of `scipy.linalg.solve_banded`.
TWICE = 2.0
# Longest run that is waited for [s].
PATIENCE = 1800.0


@dataclass(frozen=True)
class Limit:
    """An iteration of Newton's method taken apart, on the processor.

    Args:
        model: "planar", "spatial" or "discrete".
        mesh: In words.
        unknowns: Of the system.
        half: Half of its bandwidth: entries on either side of the diagonal.
        assembly: Residual and tangent of all elements [ms].
        factors: Factors and solution, with the way of the entries into the band [ms].
        petsc: PETSc's loop, norms and vectors [ms].
        python: Everything else: limits of the turns, loads, supports [ms].
        banded: `scipy.linalg.solve_banded` of the same system in the same order [ms].
        failure: Why there are none; empty: there are.
    """

    model: str
    mesh: str
    unknowns: int
    half: int
    assembly: float
    factors: float
    petsc: float
    python: float
    banded: float
    failure: str = ""

    @property
    def ms(self) -> float:
        """Of an iteration [ms]."""
        return self.assembly + self.factors + self.petsc + self.python

    @property
    def ratio(self) -> float:
        """Factors and solution over those of `solve_banded`."""
        return self.factors / self.banded

    @property
    def words(self) -> str:
        """Why there are none."""
        return f"An iteration, {self.model} {self.mesh}: {self.failure}"

    @property
    def holds(self) -> bool:
        """Whether it could be measured: time never decides."""
        return not self.failure

    @property
    def within(self) -> bool:
        """Within the limit; on a busy machine that says little."""
        return self.holds and self.ratio <= TWICE


def limit(model: str, elements: int, degree: int, repeats: int) -> Limit:
    """A cantilever under ten times EI/L² at its tip.

    Args:
        model: "planar", "spatial" or "discrete".
        elements: Of the rod.
        degree: Of the elements; the discrete model has none.
        repeats: Solves, of which the quickest counts; two at least.
    """
    mesh = str(elements) if model == "discrete" else f"{elements} × P{degree}"
    found = told("limitrun", model, elements, degree, repeats, 0)
    if "failure" in found:
        return Limit(model, mesh, 0, 0, *5 * (np.nan,), found["failure"])
    parts = ("unknowns", "half", "assembly", "factors", "petsc", "python", "banded")
    return Limit(model, mesh, *(found[name] for name in parts))


def told(program: str, *words: object) -> dict[str, Any]:
    """What a program of this package says in a process of its own as its last line; "failure" where it says none."""
    root = str(Path(__file__).parents[1])
    env = os.environ | {"PYTHONPATH": os.pathsep.join([root, os.environ.get("PYTHONPATH", "")])}
    called = [sys.executable, "-m", f"verification.{program}", *map(str, words)]
    try:
        done = subprocess.run(called, env=env, capture_output=True, text=True, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return {"failure": f"stopped after {PATIENCE:g} s"}
    if done.returncode != 0:
        return {"failure": (done.stderr.strip().splitlines() or ["no word"])[-1]}
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found
