"""`dolfinrod.solve` for a scene in motion: a scene in, its motion as a result out."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.chord import Chord
from dolfinrod.continuum.march import March, Trajectory, begin
from dolfinrod.continuum.moving import Moving
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.pool import borrowed
from dolfinrod.continuum.readout import Readout
from dolfinrod.continuum.schemes import EULER, MIDPOINT
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.continuum.stepping import StepFailed
from dolfinrod.result import Formulation, Result, Statistics
from dolfinrod.scene import ImplicitEuler, Planar, in_time

if TYPE_CHECKING:
    from collections.abc import Callable

    from mpi4py import MPI

    from dolfinrod.continuum.kinematics import Kinematics
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Dynamic, Scene, Spatial

    Progress = Callable[[StepLog, float], None]

__all__ = ["move"]


def move(
    scene: Scene,
    times: Dynamic,
    kinematics: Planar | Spatial,
    comm: MPI.Comm,
    degree: int,
    counts: tuple[int, ...],
    progress: Progress | None,
) -> tuple[Result, StepFailed | None]:
    """The motion as far as it could be followed, and what stopped it, if anything did."""
    started = time.perf_counter()
    rods: Kinematics = PlanarRods() if isinstance(kinematics, Planar) else SpatialRods()
    scheme = EULER if isinstance(times.scheme, ImplicitEuler) else MIDPOINT
    stepped = scheme is MIDPOINT or any(rod.section.damping for rod in scene.rods)
    with borrowed(comm, rods, degree, counts, stepped=stepped) as (discretization, is_new):
        problem = Moving(in_time(scene), discretization, Placement.of(scene, kinematics), scheme)
        begin(problem)
        newton, readout, trajectory = Chord(problem), Readout(problem), Trajectory()
        march = March(problem, times, newton, readout, trajectory, progress)
        compiling = discretization.seconds_compile if is_new else 0.0
        ready = time.perf_counter()
        failure = _marched(march)
        statistics = Statistics(
            dofs=discretization.n_dofs,
            load_steps=len(trajectory.log),
            newton_iterations=trajectory.iterations,
            factorizations=newton.factorizations,
            seconds_compile=compiling,
            seconds_setup=ready - started - compiling,
            seconds_solve=time.perf_counter() - ready,
        )
        return _record(scene, march, readout, statistics, converged=failure is None), failure


def _marched(march: March) -> StepFailed | None:
    """Go to the end; what stopped it, or None."""
    try:
        march.run()
    except StepFailed as failure:
        return failure
    except KeyboardInterrupt:
        t = march.trajectory.log[-1].t if march.trajectory.log else 0.0
        return StepFailed(t=t, step=0.0, reason="interrupted by the user", interrupted=True)
    finally:
        march.newton.close()
    return None


def _record(scene: Scene, march: March, readout: Readout, statistics: Statistics, *, converged: bool) -> Result:
    """What a motion leaves behind."""
    problem, trajectory = march.problem, march.trajectory
    states = trajectory.states
    d = problem.discretization
    unknowns = {field: int(np.prod(states[0][field].shape)) for field in d.kinematics.fields}
    for field in set(unknowns) - {"N", "m"}:
        cells, nodes, components = states[0][field].shape
        unknowns[field] = (cells * (nodes - 1) + len(d.elements)) * components
    damping = ("Damping",) if any(rod.section.damping for rod in scene.rods) else ()
    drag = () if scene.air is None else ("Drag",)
    names, unit, second = march.ledger.rows[0], problem.placement.moment, problem.lumped.second
    return Result(
        scene=scene,
        t=np.array(trajectory.t),
        rods=tuple(
            replace(history, v=v, omega=omega)
            for history, (v, omega) in zip(readout.histories(states), readout.rates(states, second), strict=True)
        ),
        converged=converged,
        log=tuple(trajectory.log),
        energy={name: unit * np.array([row[name] for row in march.ledger.rows]) for name in names},
        statistics=statistics,
        formulation=Formulation(
            model="continuum",
            kinematics=d.kinematics.name,
            unknowns=unknowns,
            terms=(*problem.terms, "Inertia", *drag, *damping),
            notes=(problem.scheme.name,),
        ),
        state=states[-1],
    )
