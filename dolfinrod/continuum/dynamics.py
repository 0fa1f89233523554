"""`dolfinrod.solve` for a scene in motion: a scene in, its motion as a result out."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.chord import Chord
from dolfinrod.continuum.keeper import onward
from dolfinrod.continuum.kept import motion_of, resume_motion
from dolfinrod.continuum.march import March, begin
from dolfinrod.continuum.moving import Moving
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.pool import borrowed
from dolfinrod.continuum.readout import Readout
from dolfinrod.continuum.restart import follow_on, moving_state
from dolfinrod.continuum.rubbing import rubs
from dolfinrod.continuum.schemes import EULER, MIDPOINT
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.continuum.stepping import StepFailed
from dolfinrod.continuum.trajectory import Trajectory
from dolfinrod.continuum.unknowns import unknowns
from dolfinrod.result import Formulation, Result, Statistics
from dolfinrod.scene import ImplicitEuler, Planar, in_time
from dolfinrod.scene.advice import Findings, advice

if TYPE_CHECKING:
    from collections.abc import Callable

    from mpi4py import MPI

    from numpy.typing import NDArray

    from dolfinrod.continuum.keeper import Keeper
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
    start: Result | None = None,
    keeper: Keeper | None = None,
) -> tuple[Result, StepFailed | None]:
    """The motion as far as it could be followed, and what stopped it, if anything did.

    Raises:
        SceneError: A start of something else.
    """
    started = time.perf_counter()
    rods: Kinematics = PlanarRods() if isinstance(kinematics, Planar) else SpatialRods()
    scheme = EULER if isinstance(times.scheme, ImplicitEuler) else MIDPOINT
    stepped = scheme is MIDPOINT or any(rod.section.damping for rod in scene.rods)
    with borrowed(comm, rods, degree, counts, stepped=stepped, rubbed=rubs(scene)) as (discretization, is_new):
        problem = Moving(in_time(scene), discretization, Placement.of(scene, kinematics), scheme)
        begin(problem)
        newton = Chord(problem)
        try:
            march = March(problem, times, newton, Readout(problem), Trajectory(), progress)
            _go_on(march, scene, start, keeper)
            compiling = discretization.seconds_compile if is_new else 0.0
            ready = time.perf_counter()
            failure = _marched(scene, march, keeper)
        finally:
            newton.close()
        seconds = compiling, ready - started - compiling, march.trajectory.seconds + time.perf_counter() - ready
        return _record(scene, march, seconds, converged=failure is None), failure


def _go_on(march: March, scene: Scene, start: Result | None, keeper: Keeper | None) -> None:
    """Take up what a file or an earlier result holds, the file first."""
    kept = None if keeper is None else keeper.read()
    if kept is not None:
        resume_motion(march, kept)
    elif start is not None:
        follow_on(march, start, scene)


def _marched(scene: Scene, march: March, keeper: Keeper | None) -> StepFailed | None:
    """Go to the end; what stopped it, or None."""
    failure, begun = None, time.perf_counter() - march.trajectory.seconds

    def arrays() -> dict[str, NDArray[np.float64]]:
        return motion_of(march, time.perf_counter() - begun)

    try:
        march.run(None if keeper is None else lambda: keeper.now_and_then(march.mark.t, arrays))
    except StepFailed as caught:
        failure = caught
        failure.advice = advice(scene, Findings(t=failure.t))
    except KeyboardInterrupt:
        # The next scene on these elements finds no tangent half put together.
        march.problem.discretization.matrix.assemble()
        failure = StepFailed(t=march.mark.t, step=0.0, reason="interrupted by the user", interrupted=True)
        failure.advice = onward(keeper)
    march.settle()
    if keeper is not None:
        keeper.write(march.mark.t, arrays)
    if failure is not None:
        march.store_last()
    return failure


def _record(scene: Scene, march: March, seconds: tuple[float, float, float], *, converged: bool) -> Result:
    """What a motion leaves behind, after some time spent on compiling, setting up and solving [s]."""
    problem, trajectory, readout = march.problem, march.trajectory, march.readout
    states, d = trajectory.states, problem.discretization
    names, unit, second = march.mark.energy, problem.placement.moment, problem.lumped.second
    drag = () if scene.air is None else ("Drag",)
    damping = ("Damping",) if any(rod.section.damping for rod in scene.rods) else ()
    factorizations = trajectory.factorizations + march.newton.factorizations
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
        statistics=Statistics(d.n_dofs, len(trajectory.log), trajectory.iterations, factorizations, *seconds),
        formulation=Formulation(
            model="continuum",
            kinematics=d.kinematics.name,
            unknowns=unknowns(d, states[-1]),
            terms=(*problem.terms, "Inertia", *drag, *damping),
            notes=(problem.scheme.name,),
        ),
        state=moving_state(march),
        contacts=readout.contacts(states),
        meetings=readout.meetings(states),
    )
