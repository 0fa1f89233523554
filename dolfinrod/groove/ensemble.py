"""Ensembles: the same scenario with other seeds or parameters, dealt out to MPI ranks by run, gone on with later."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING
from uuid import uuid4

import numpy as np

from dolfinrod.groove.described import described, key
from dolfinrod.groove.film import filmed
from dolfinrod.groove.limits import known
from dolfinrod.groove.measures import Measures, measure
from dolfinrod.groove.runs import Folder, Run
from dolfinrod.groove.scenario import MODELS, Scenario
from dolfinrod.result import NotConverged
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm

    from numpy.typing import NDArray

__all__ = ["Ensemble", "Progress", "ensemble"]

# What a run may end with that the next need not: no convergence, no scene, a singular matrix, fibres that cannot be
# measured.
FAILURES = (RuntimeError, ValueError, ArithmeticError, np.linalg.LinAlgError)


@dataclass(frozen=True)
class Progress:
    """How far an ensemble is.

    Args:
        done: Finished runs of all ranks, failed ones and earlier ones included.
        failed: Of them.
        total: Of all.
        seconds: Since this session began [s].
        left: Until the last is finished, if the rest goes on like this [s]; None: no run of this session has ended.
    """

    done: int
    failed: int
    total: int
    seconds: float
    left: float | None


@dataclass(frozen=True)
class Ensemble:
    """Finished runs.

    Args:
        runs: In the order in which they were asked for, failed ones included.
    """

    runs: tuple[Run, ...]

    @property
    def finished(self) -> tuple[Run, ...]:
        """Those that have an end."""
        return tuple(run for run in self.runs if run.failed is None)

    @property
    def failed(self) -> tuple[Run, ...]:
        """Those that have none; each says why."""
        return tuple(run for run in self.runs if run.failed is not None)

    def values(self, name: str, kind: str | None = None) -> tuple[float, ...]:
        """A number of each finished run, of one kind of groove or all; runs that have none are left out.

        Args:
            name: Of a field of `Run`, such as "T_pair", "T_crossed", "wound" or "edge_crosses".
            kind: Of groove; None: all.

        Returns:
            Values.
        """
        found = [getattr(run, name) for run in self.finished if kind in (None, run.kind)]
        return tuple(float(value) for value in found if value is not None)


def ensemble(
    scenarios: Scenario | Sequence[Scenario],
    *,
    folder: str | os.PathLike[str],
    seeds: Iterable[int] = range(10),
    model: str = "discrete",
    elements: int | None = None,
    comm: Intracomm | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> Ensemble:
    """Solve every scenario with every seed, each run by one rank; what the folder holds already is not done again.

    Args:
        scenarios: One or more; their own seeds are replaced.
        folder: Where finished runs are kept. To repeat one, remove its file.
        seeds: Of the noise.
        model: "continuum" or "discrete".
        elements: Of a fibre; None: what each scenario says.
        comm: Whose ranks share the work; all call together. None: the world.
        progress: Called after each run of this rank, and once before the first.

    Returns:
        All runs, on every rank. A run that failed is recorded, and the others go on.

    Raises:
        SceneError: An unknown model, no runs.
    """
    asked = _asked(scenarios, tuple(seeds), model, elements)
    comm, kept = comm or _world(), Folder(folder)
    if comm.rank == 0:
        kept.sweep()
    session, clock = comm.bcast(uuid4().hex, root=0), _Clock(kept, tuple(asked), progress)
    clock.tell()
    # Whoever is free takes the next: runs of different bundles last differently.
    for name, scenario in asked.items():
        if kept.read(name) is None and kept.claim(session, name):
            kept.write(*_solved(name, scenario, model, elements))
            clock.tell()
    return _gathered(kept, tuple(asked), comm)


def _world() -> Intracomm:
    """All ranks that were started together."""
    from mpi4py import MPI

    return MPI.COMM_WORLD


def _gathered(kept: Folder, names: tuple[str, ...], comm: Intracomm) -> Ensemble:
    """All runs, once every rank has done its own."""
    comm.barrier()
    found = tuple(run for name in names if (run := kept.read(name)) is not None)
    comm.barrier()
    if comm.rank == 0:
        kept.sweep()
    return Ensemble(found)


class _Clock:
    """Tells how far all ranks are."""

    def __init__(self, kept: Folder, names: tuple[str, ...], progress: Callable[[Progress], None] | None) -> None:
        self._kept, self._names, self._progress = kept, names, progress
        self._begun, self._before = time.monotonic(), sum(kept.read(name) is not None for name in names)

    def tell(self) -> None:
        """Call back with what the folder holds by now."""
        if self._progress is None:
            return
        found = [run for name in self._names if (run := self._kept.read(name)) is not None]
        seconds, new = time.monotonic() - self._begun, len(found) - self._before
        left = seconds / new * (len(self._names) - len(found)) if new > 0 else None
        failed = sum(run.failed is not None for run in found)
        self._progress(Progress(len(found), failed, len(self._names), seconds, left))


def _asked(
    scenarios: Scenario | Sequence[Scenario], seeds: tuple[int, ...], model: str, elements: int | None
) -> dict[str, Scenario]:
    """Every scenario with every seed, by its key."""
    known(model, "model", MODELS)
    several = (scenarios,) if isinstance(scenarios, Scenario) else tuple(scenarios)
    each = [replace(scenario, seed=seed) for scenario in several for seed in seeds]
    if not each:
        raise SceneError("must ask for at least one run, got none", field="seeds")
    return {key(one, model, elements): one for one in each}


def _solved(
    name: str, scenario: Scenario, model: str, elements: int | None
) -> tuple[Run, dict[str, NDArray[np.float64]]]:
    """One run and its arrays."""
    begun = time.process_time()
    blank = Run(name, scenario.kind, scenario.seed, model, described(scenario), 0.0, None, 0.0)
    try:
        result = scenario.run(model, elements=elements)
        arrays, measures = filmed(result, scenario), measure(result, scenario)
    except FAILURES as error:
        reached = error.t if isinstance(error, NotConverged) else 0.0
        told = f"{type(error).__name__}: {error}"
        return replace(blank, failed=told, t=reached, seconds=time.process_time() - begun), {}
    return _told(blank, scenario, measures, time.process_time() - begun), arrays


def _told(blank: Run, scenario: Scenario, measures: Measures, seconds: float) -> Run:
    """A run with what was measured."""
    return replace(
        blank,
        seconds=seconds,
        t=measures.t,
        T_pair=measures.T_pair,
        T_crossed=measures.T_crossed if np.isfinite(measures.T_crossed) else None,
        wound=measures.wound,
        winding=tuple(tuple(row) for row in measures.winding.tolist()),
        edge_crosses=measures.crosses(scenario.fibres, scenario.fibres - 1),
        crossings=len(measures.crossings),
        width=0.0 if measures.along is None else float(measures.along.width.mean()),
    )
