"""Ensembles: the same scenario with other seeds or parameters, dealt out to MPI ranks by run, gone on with later."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from typing import TYPE_CHECKING
from uuid import uuid4

import numpy as np

from dolfinrod.groove.clock import Clock, Job, Progress
from dolfinrod.groove.described import described, key
from dolfinrod.groove.film import filmed
from dolfinrod.groove.limits import known
from dolfinrod.groove.measures import Measures, measure
from dolfinrod.groove.runs import Folder, Run
from dolfinrod.groove.scenario import MODELS, Scenario
from dolfinrod.interrupt import Interrupt
from dolfinrod.result import NotConverged
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm

    from numpy.typing import NDArray

    from dolfinrod.result import StepLog

__all__ = ["Ensemble", "ensemble", "world"]

# What a run may end with that the next need not: no convergence, no scene, a singular matrix, fibres that cannot be
# measured.
FAILURES = (RuntimeError, ValueError, ArithmeticError, np.linalg.LinAlgError)
# Seconds between two looks at whether the others have ended.
PATIENCE = 0.05


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
    seeds: Iterable[int] | None = range(10),
    model: str | Sequence[str] = "discrete",
    elements: int | None = None,
    comm: Intracomm | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> Ensemble:
    """Solve every scenario with every seed, each run by one rank; what the folder holds already is not done again.

    Ranks take runs one after the other as they become free, the longest first. Ctrl-C ends the run at hand, which is
    then not kept.

    Args:
        scenarios: One or more.
        folder: Where finished runs are kept. To repeat one, remove its file.
        seeds: Of the noise, instead of those of the scenarios; None: each scenario as it is.
        model: "continuum", "discrete", or both of them.
        elements: Of a fibre; None: what each scenario says.
        comm: Whose ranks share the work; all call together. None: the world.
        progress: Called before, during and after each run of this rank.

    Returns:
        All runs, on every rank. A run that failed is recorded, and the others go on.

    Raises:
        SceneError: An unknown model, no runs.
        KeyboardInterrupt: It was asked for; what had ended by then is kept.
    """
    asked = _asked(scenarios, seeds, (model,) if isinstance(model, str) else tuple(model), elements)
    comm, kept = comm or world(), Folder(folder)
    if comm.rank == 0:
        kept.sweep()
    session, clock = comm.bcast(uuid4().hex, root=0), Clock(kept, asked, comm.size, progress)
    clock.tell()
    with clock:
        _work_off(asked, kept, session, elements, clock)
        return _gathered(kept, tuple(asked), comm, clock)


def _work_off(asked: Mapping[str, Job], kept: Folder, session: str, elements: int | None, clock: Clock) -> None:
    """Whoever is free takes the next run, the longest first, so that ranks end together."""
    if any(job.model == "continuum" for job in asked.values()):
        # PETSc begins on all ranks together: one that solves nothing would keep the others waiting.
        import_module("dolfinrod.continuum")
    with Interrupt() as interrupt:
        for name, job in sorted(asked.items(), key=lambda entry: -entry[1].cost):
            if kept.read(name) is None and kept.claim(session, name):
                clock.begin(job)
                done = _solved(name, job, elements, clock.step)
                # Solvers answer Ctrl-C with what they have reached, which is no end of a run.
                interrupt.check()
                kept.write(*done)
                clock.end()


def world() -> Intracomm:
    """All ranks that were started together."""
    from mpi4py import MPI

    return MPI.COMM_WORLD


def _gathered(kept: Folder, names: tuple[str, ...], comm: Intracomm, clock: Clock) -> Ensemble:
    """All runs, once every rank has done its own."""
    others = comm.Ibarrier()
    # A barrier would keep a core busy that another rank may need.
    while not others.Test():
        time.sleep(PATIENCE)
        clock.tell()
    found = tuple(run for name in names if (run := kept.read(name)) is not None)
    comm.barrier()
    if comm.rank == 0:
        kept.sweep()
    return Ensemble(found)


def _asked(
    scenarios: Scenario | Sequence[Scenario],
    seeds: Iterable[int] | None,
    models: tuple[str, ...],
    elements: int | None,
) -> dict[str, Job]:
    """Every scenario with every seed by every model, by its key."""
    several = (scenarios,) if isinstance(scenarios, Scenario) else tuple(scenarios)
    if seeds is not None:
        numbers = tuple(seeds)
        several = tuple(replace(scenario, seed=seed) for scenario in several for seed in numbers)
    each = [Job(one, known(model, "model", MODELS)) for model in models for one in several]
    if not each:
        raise SceneError("must ask for at least one run, got none", field="seeds")
    return {key(job.scenario, job.model, elements): job for job in each}


def _solved(
    name: str, job: Job, elements: int | None, step: Callable[[StepLog, float], None]
) -> tuple[Run, dict[str, NDArray[np.float64]]]:
    """One run and its arrays."""
    begun, scenario = time.process_time(), job.scenario
    blank = Run(name, scenario.kind, scenario.seed, job.model, described(scenario), 0.0, None, 0.0)
    try:
        result = scenario.run(job.model, elements=elements, progress=step)
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
