"""Errors and seconds of everybody who solves a problem, measured in one run on one machine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from dolfinrod.result import NotConverged
from verification.peers.conversation import Refused

__all__ = ["AIM", "TARGET", "TARGETS", "Attempt", "Contender", "Measured", "Taker", "contest"]

# Error of the tip, over the length, at which seconds are compared, and what ours should take for it [s].
TARGET, AIM = 1e-3, 0.3
TARGETS = (TARGET, 1e-5, 1e-8)


@dataclass(frozen=True)
class Measured:
    """What one run of a solver came to.

    Args:
        error: Largest distance of the tip from the solution at the times of the problem, over the length.
        final: The same at the last time alone, where an error may pass through zero.
        solve: Of the quickest solve; of a motion, per simulated second [s].
        setup: To pose the problem [s].
        once: What is spent once a process: imports, or the making of compiled code [s].
        steps: Of the load, or in time, those of failed attempts left out; None where the solver does not say.
        version: Of the solver.
        parts: Of one of our models, what these seconds are spent on, in words, and which part of them it is.
    """

    error: float
    final: float
    solve: float
    setup: float
    once: float
    steps: int | None
    version: str
    parts: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class Attempt:
    """A solver at one setting.

    Args:
        mesh: In words.
        stepping: In words.
        found: None where it gave up.
        refused: Why it gave up; "" where it did not.
    """

    mesh: str
    stepping: str
    found: Measured | None = None
    refused: str = ""


@dataclass(frozen=True)
class Taker:
    """Who takes part.

    Args:
        name: Of the solver, and of the integrator where it has several.
        ours: Whether it is one of our models.
        implicit: Whether it solves equations in every step.
        method: How time is stepped.
        element: How the rod is divided.
        assumes: What the rod cannot do: "sheared" does all, "stretched" does not shear, "rigid" does neither.
        space: Whether it moves in space, not only in a plane.
        exact: Whether its elements are geometrically exact.
    """

    name: str
    ours: bool
    implicit: bool
    method: str
    element: str
    assumes: str
    space: bool = True
    exact: bool = False


@dataclass(frozen=True)
class Contender:
    """A solver at all its settings.

    Args:
        problem: Its name.
        taker: Who.
        attempts: In the order of the sweep; empty where it could not take part.
        absent: Why it could not; "" where it did.
        cold: Seconds of a whole process that solves it once, at the quickest setting to `TARGET`; None: not measured.
    """

    problem: str
    taker: Taker
    attempts: tuple[Attempt, ...]
    absent: str = ""
    cold: float | None = None

    def quickest(self, target: float = TARGET, *, final: bool = False) -> Attempt | None:
        """The measured attempt that is exact enough soonest, never an interpolation.

        Args:
            target: Error allowed, over the length.
            final: Whether only the last time counts.
        """
        enough = [
            (attempt.found.solve, k)
            for k, attempt in enumerate(self.attempts)
            if attempt.found is not None and (attempt.found.final if final else attempt.found.error) <= target
        ]
        return self.attempts[min(enough)[1]] if enough else None

    @property
    def nearest(self) -> float:
        """Least error of any attempt, infinite where there is none."""
        return min((a.found.error for a in self.attempts if a.found is not None), default=np.inf)


def contest(
    problem: str, taker: Taker, settings: Sequence[tuple[str, str]], measure: Callable[[int], Measured]
) -> Contender:
    """Let one solver try all its settings.

    Args:
        problem: Its name.
        taker: Who.
        settings: Mesh and stepping in words, one a setting.
        measure: Measures the setting of that number.

    Returns:
        Its attempts; one that gives up is kept with the reason.
    """
    attempts = []
    for k, (mesh, stepping) in enumerate(settings):
        try:
            attempts.append(Attempt(mesh, stepping, measure(k)))
        except Refused as refused:
            attempts.append(Attempt(mesh, stepping, refused=str(refused)))
        except NotConverged as failed:
            attempts.append(Attempt(mesh, stepping, refused=failed.reason))
    return Contender(problem, taker, tuple(attempts))
