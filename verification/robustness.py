"""How much load one step takes, and how few steps a problem takes, nothing tuned: ours, for a table with the peers'."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from dolfinrod.result import NotConverged
from verification.benchmarks import BENCHMARKS, Benchmark
from verification.case import SKEW, Case
from verification.cases import elastica
from verification.models import BOTH, Continuum, Discrete, Model
from verification.references.robustness import PEER_LOADS, peer_steps

__all__ = [
    "LOADS",
    "OneStepLoads",
    "Steps",
    "benchmark_rows",
    "loads_at_once",
    "models",
    "steps",
]

# Those at which the peers were tried, and on.
LOADS = (*PEER_LOADS, 1000.0, 2000.0, 5000.0, 10000.0)
# The issue's: at least this load in one step; the largest that a peer takes is 500.
LEAST = 5000.0
ELEMENTS = 16
# Relative error beyond which it is another equilibrium.
SOUGHT = 1e-2


@dataclass(frozen=True)
class OneStepLoads:
    """Dead tip loads on a cantilever, each taken at once.

    Args:
        model: Its name.
        iterations: Newton iterations at each of `LOADS`; None: more than one step, failure or another equilibrium.
        least: Load that has to be reached; None where there is no such limit.
    """

    model: str
    iterations: tuple[int | None, ...]
    least: float | None

    @property
    def largest(self) -> float:
        """Largest load up to which every one was taken, 0 where the first was not."""
        taken = 0.0
        for load, n in zip(LOADS, self.iterations, strict=True):
            if n is None:
                break
            taken = load
        return taken

    @property
    def holds(self) -> bool:
        """Whether it reaches what it should."""
        return self.least is None or self.largest >= self.least


def models() -> tuple[Model, ...]:
    """The continuum model of degrees 2 and 3, planar and spatial, and the discrete one."""
    return (*(Continuum(k, kinematics) for kinematics in BOTH for k in (2, 3)), Discrete())


def loads_at_once(model: Model) -> OneStepLoads:
    """Every load from the unloaded state in one step on 16 elements, in a skew plane.

    Args:
        model: Asked.

    Returns:
        The row.
    """
    found = tuple(_at_once(elastica.inextensible(load), model) for load in LOADS)
    return OneStepLoads(model.name, found, LEAST if model.family == "continuum" else None)


def _at_once(case: Case, model: Model) -> int | None:
    try:
        result = model.solve(case.scene(SKEW), ELEMENTS)
    except NotConverged:
        return None
    right = len(result.log) == 1 and case.error(result, SKEW) < _sought(model)
    return result.statistics.newton_iterations if right else None


def _sought(model: Model) -> float:
    """The discrete model's own error on 16 elements is a few hundredths where the whole bend lies in two of them."""
    return SOUGHT if model.family == "continuum" else 5.0 * SOUGHT


@dataclass(frozen=True)
class Steps:
    """A benchmark with default settings.

    Args:
        case: Its name.
        title: For people.
        model: Name of the model.
        mesh: Elements.
        steps: Load steps accepted.
        iterations: Newton iterations, failed attempts included.
        cuts: Failed attempts.
        error: Relative to the reference.
        most_steps: Allowed; None: no limit.
        most_iterations: Allowed; None: no limit.
        peer: Name of the problem in the peers' table; empty: none.
        failure: Why it did not converge.
    """

    case: str
    title: str
    model: str
    mesh: int
    steps: int
    iterations: int
    cuts: int
    error: float
    most_steps: int | None
    most_iterations: int | None
    peer: str
    failure: str | None

    @property
    def holds(self) -> bool:
        """Right, and within the limits."""
        if self.failure is not None or not self.error < SOUGHT:
            return False
        few = self.most_steps is None or self.steps <= self.most_steps
        return few and (self.most_iterations is None or self.iterations <= self.most_iterations)

    @property
    def missed(self) -> bool:
        """Whether a limit is broken, or it is another equilibrium; a refusal where nothing is asked for is no miss."""
        return not self.holds and not (self.failure and self.most_steps is None)

    @property
    def best_peer(self) -> int | None:
        """Fewest steps of any peer; None where none was tried or none converged."""
        return min((p.steps for p in peer_steps(self.peer) if p.steps is not None), default=None)


def steps(benchmark: Benchmark, model: Model) -> Steps:
    """Solve with default settings.

    Args:
        benchmark: With its limits, which bind the continuum model.
        model: That poses it.

    Returns:
        The row.
    """
    case, ours = benchmark.case, model.family == "continuum"
    mesh = benchmark.elements if ours else benchmark.discrete
    failure, error = None, np.nan
    try:
        result = model.solve(case.scene(SKEW), mesh)
        error = case.error(result, SKEW)
    except NotConverged as failed:
        result, failure = failed.result, failed.reason
    return Steps(
        case=case.name,
        title=case.title,
        model=model.name,
        mesh=mesh,
        steps=result.statistics.load_steps,
        iterations=result.statistics.newton_iterations,
        cuts=sum(step.cuts for step in result.log),
        error=error,
        most_steps=benchmark.most_steps if ours else None,
        most_iterations=benchmark.most_iterations if ours else None,
        peer=benchmark.peer,
        failure=failure,
    )


def benchmark_rows() -> tuple[partial[Steps], ...]:
    """What is to be done: every benchmark by every kinematics of degree 3 that holds it, and by the discrete model."""
    asked: tuple[Model, ...] = (*(Continuum(3, kinematics) for kinematics in BOTH), Discrete())
    return tuple(partial(steps, b, m) for b in BENCHMARKS for m in asked if m.applies_to(b.case))
