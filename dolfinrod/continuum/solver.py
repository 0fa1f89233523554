"""`dolfinrod.solve`: a scene in, a result out."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum.dynamics import move
from dolfinrod.continuum.failure import findings
from dolfinrod.continuum.keeper import Keeper, onward
from dolfinrod.continuum.kept import path_of, resumed_path
from dolfinrod.continuum.lift import restated
from dolfinrod.continuum.neutral import PhaseCondition
from dolfinrod.continuum.newton import Newton
from dolfinrod.continuum.path import Path
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.pool import borrowed
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.readout import Readout
from dolfinrod.continuum.restart import meet_again, shapes_of_fields
from dolfinrod.continuum.rubbing import remembers, rubs
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.continuum.stability import judging
from dolfinrod.continuum.stepping import StepFailed, Walk
from dolfinrod.continuum.unknowns import unknowns
from dolfinrod.result import Formulation, NotConverged, Result, Statistics
from dolfinrod.scene import Dynamic, Planar, SceneError, Spatial
from dolfinrod.scene.advice import advice
from dolfinrod.scene.door import admit
from dolfinrod.scene.kinematics import detect, obstacle
from dolfinrod.scene.options import element_counts

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    from dolfinrod.continuum.kinematics import Kinematics
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Scene

    Progress = Callable[[StepLog, float], None]

__all__ = ["check_degree", "choose", "record", "solve"]

DEGREES = range(1, 6)


def solve(
    scene: Scene,
    *,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: MPI.Comm | None = None,
    progress: Progress | None = None,
    start: Result | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
) -> Result:
    """Equilibrium of geometrically exact rods (Simo-Reissner, Kirchhoff in the limit); see `dolfinrod.solve`."""
    comm = MPI.COMM_WORLD if comm is None else comm
    admit(scene, start, Result)
    check_degree(degree)
    chosen = choose(scene, kinematics)
    counts = element_counts(elements, len(scene.rods))
    keeper = None
    if checkpoint is not None:
        options = {"model": "continuum", "elements": counts, "degree": degree, "kinematics": chosen}
        keeper = Keeper(checkpoint, scene, options | {"judged in space": kinematics is None}, start, comm)
    if isinstance(scene.motion, Dynamic):
        result, failure = move(scene, scene.motion, chosen, comm, degree, counts, progress, start, keeper)
    else:
        in_space = kinematics is None
        result, failure = _path(scene, chosen, comm, degree, counts, progress, start, keeper, in_space=in_space)
    if failure is not None:
        raise NotConverged(result=result, t=failure.t, step=failure.step, reason=failure.reason, advice=failure.advice)
    return result


def _path(
    scene: Scene,
    kinematics: Planar | Spatial,
    comm: MPI.Comm,
    degree: int,
    counts: tuple[int, ...],
    progress: Progress | None,
    start: Result | None,
    keeper: Keeper | None,
    *,
    in_space: bool,
) -> tuple[Result, StepFailed | None]:
    """All states that could be reached, and what stopped the stepping, if anything did."""
    started = time.perf_counter()
    rods: Kinematics = PlanarRods() if isinstance(kinematics, Planar) else SpatialRods()
    with borrowed(comm, rods, degree, counts, rubbed=rubs(scene)) as (discretization, is_new):
        problem = Problem(scene, discretization, Placement.of(scene, kinematics))
        newton, phase, readout = Newton(problem), PhaseCondition(problem), Readout(problem)
        path = _begin(scene, kinematics, readout, start, keeper)
        compiling = discretization.seconds_compile if is_new else 0.0
        with judging(problem, in_space=in_space) as judge:
            ready = time.perf_counter()
            failure = _walk(Walk(newton, phase, judge, readout, path, _heard(path, keeper, progress)), keeper)
            seconds_solve = time.perf_counter() - ready - path.seconds_stability
        if failure is not None and not failure.interrupted:
            failure.advice = advice(scene, findings(readout, path, failure))
        statistics = Statistics(
            dofs=discretization.n_dofs,
            load_steps=len(path.log),
            newton_iterations=path.iterations,
            factorizations=newton.factorizations,
            seconds_compile=compiling,
            seconds_setup=ready - started - compiling,
            seconds_solve=seconds_solve,
            seconds_stability=path.seconds_stability,
        )
        notes = (*phase.notes, *_judged(scene, path, in_space=in_space or rods.dim == 3))
        return record(problem, notes, readout, path, statistics, converged=failure is None), failure


def _judged(scene: Scene, path: Path, *, in_space: bool) -> tuple[str, ...]:
    """What a user should know of how stability was judged."""
    if remembers(scene):
        return ("stability not judged: contact that rubs, or has multipliers, has a memory",)
    if scene.meetings and path.stable is None:
        return ("stability not judged: rods touch one another under loads without a potential",)
    return () if in_space else ("stability judged in the plane only",)


def _heard(path: Path, keeper: Keeper | None, progress: Progress | None) -> Progress:
    """What is called with every accepted step: the path is kept, then the user told."""

    def heard(row: StepLog, t_end: float) -> None:
        if keeper is not None:
            keeper.now_and_then(row.t, lambda: path_of(path))
        if progress is not None:
            progress(row, t_end)

    return heard


def _walk(walk: Walk, keeper: Keeper | None) -> StepFailed | None:
    """Step to the end; what stopped it, or None."""
    failure, path = None, walk.path
    try:
        walk.run()
    except StepFailed as caught:
        failure = caught
    except KeyboardInterrupt:
        # The next scene on these elements finds no tangent half put together.
        walk.newton.problem.discretization.matrix.assemble()
        # A step that was just being entered counts once its row of the log is there.
        n = len(path.log) + 1
        del path.t[n:], path.states[n:], path.energy[n:]
        failure = StepFailed(t=path.t[-1], step=0.0, reason="interrupted by the user", interrupted=True)
        failure.advice = onward(keeper)
    finally:
        walk.newton.close()
    if keeper is not None:
        keeper.write(path.t[-1], lambda: path_of(path))
    return failure


def check_degree(degree: int) -> None:
    """Raises SceneError for a degree there are no forms of."""
    if not isinstance(degree, int | np.integer) or isinstance(degree, bool) or degree not in DEGREES:
        raise SceneError(f"degree must be 1, 2, 3, 4 or 5, got {degree!r}")


def choose(scene: Scene, kinematics: Planar | Spatial | None) -> Planar | Spatial:
    """The kinematics asked for, or the least that holds the scene.

    Raises:
        SceneError: Planar is asked for, but something leads out of the plane.
    """
    if isinstance(kinematics, Spatial):
        return kinematics
    found = detect(scene)
    if kinematics is None:
        return found
    if not isinstance(kinematics, Planar):
        raise SceneError(f"kinematics must be Planar(), Spatial() or None, got {kinematics!r}")
    if kinematics.normal is None:
        if not isinstance(found, Planar):
            raise SceneError("kinematics must be Spatial(): the scene does not lie in one plane")
        return found
    plane = Planar(kinematics.normal, kinematics.origin or tuple(scene.rods[0].centerline(np.zeros(1))[0]))
    reason = obstacle(scene, plane)
    if reason is not None:
        raise SceneError(f"kinematics cannot be Planar(normal={plane.normal}): {reason}")
    return plane


def _begin(
    scene: Scene, kinematics: Planar | Spatial, readout: Readout, start: Result | None, keeper: Keeper | None
) -> Path:
    """The first state, stress free or where an earlier result ended; or the path as far as it is kept."""
    t = 0.0
    if start is not None:
        state = readout.state()
        if shapes_of_fields(state) != shapes_of_fields(start.state):
            raise SceneError("start must be a result on the same elements, degree and kinematics")
        place = readout.problem.placement
        before = Placement.of(start.scene, choose(start.scene, kinematics))
        readout.restore(start.state if place.coincides(before) else restated(start.state, before, place))
        if start.scene == scene and start.t[-1] < scene.motion.t_end:
            t = float(start.t[-1])
        meet_again(readout.problem, start, t)
    stable = True if start is None else start.log[-1].stable if start.log else None
    path = Path(t=[t], states=[readout.state()], energy=[readout.energy()], stable=stable)
    kept = None if keeper is None else keeper.read()
    if kept is not None:
        path = resumed_path(path, kept)
        readout.restore(path.states[-1])
    return path


def record(
    problem: Problem, notes: tuple[str, ...], readout: Readout, path: Path, statistics: Statistics, *, converged: bool
) -> Result:
    """What a solve leaves behind."""
    d = problem.discretization
    return Result(
        scene=problem.scene,
        t=np.array(path.t),
        rods=readout.histories(path.states),
        converged=converged,
        log=tuple(path.log),
        energy={"strain": np.array(path.energy)},
        statistics=statistics,
        formulation=Formulation("continuum", d.kinematics.name, unknowns(d, path.states[-1]), problem.terms, notes),
        state=path.states[-1],
        contacts=readout.contacts(path.states),
        meetings=readout.meetings(path.states),
    )
