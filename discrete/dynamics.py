"""Motion in time of the paper's rods, Eq. 26 and 2.3.2."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from discrete.damping import Damping
from discrete.drag import Drag
from discrete.euler import BackwardEuler
from discrete.failure import advice
from discrete.kept import motion_of, resume_motion
from discrete.laws import Damped, Elastic
from discrete.ledger import WORKS, WORKS_THERE, Ledger
from discrete.loads import Loads
from discrete.marching import March
from discrete.mass import node_masses
from discrete.momentum import Inertia
from discrete.moving import initial
from discrete.restart import moving_on, stored_motion
from discrete.statics import INTERRUPTED, StepFailed
from discrete.supports import Supports
from discrete.surroundings import surroundings_of
from discrete.trajectory import Trajectory, formulation
from dolfinrod.result import NotConverged
from dolfinrod.scene import Dynamic, ImplicitEuler, SceneError, in_time

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from discrete.constitution import Element
    from discrete.euler import Taken
    from discrete.mesh import Mesh
    from discrete.moving import Moving
    from discrete.statics import Progress
    from dolfinrod.checkpoint import Checkpoint
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["moved"]

PLAIN = {"axial": "chord", "frame": "element", "rotation": "exponential", "end_mass": "half"}


def moved(
    scene: Scene,
    cut: Mesh,
    law: Element,
    chosen: Mapping[str, str],
    *,
    progress: Progress | None = None,
    start: Result | None = None,
    file: Checkpoint | None = None,
) -> Result:
    """Motion of a scene.

    Args:
        scene: What is posed, its motion in time.
        cut: Its mesh.
        law: Of the elements.
        chosen: Options of `discrete.solve` by name.
        progress: Called with each step and the final time.
        start: An earlier result to go on from.
        file: What the motion is kept in.

    Returns:
        The states at the output times.

    Raises:
        SceneError: The scene or an option cannot be solved as given.
        NotConverged: A step could not be taken, or the user interrupted; carries what was reached.
    """
    _check(scene, chosen)
    begun, timed = time.perf_counter(), in_time(scene)
    method, laws = _method(timed, cut, law, chosen)
    state, works = _begin(timed, scene, method, start)
    force, strain = laws.begin(state)
    trajectory = Trajectory(scene, method, laws, Ledger(timed, method, state, strain, works), state, force)

    def take(now: Moving, t: float) -> Taken:
        return method.take(now, t, laws.over(t - now.t))

    march = March(timed, state, trajectory.entry, take, trajectory.accept, cut.units.length)
    return _followed(scene, march, trajectory, (cut, chosen), begun, progress, file)


def _method(scene: Scene, cut: Mesh, law: Element, chosen: Mapping[str, str]) -> tuple[BackwardEuler, Elastic | Damped]:
    """Steps of a scene, and the laws of its elements."""
    sections = [rod.section for rod in scene.rods]
    inertia = Inertia(*node_masses(cut, sections, whole_ends=chosen["end_mass"] == "paper"))
    drag = None if scene.air is None else Drag(scene.air, cut, sections)
    added = chosen["rotation"] == "added"
    contacts = surroundings_of(scene, cut)
    method = BackwardEuler(cut, Loads(scene, cut), Supports(scene, cut), inertia, drag, contacts, added=added)
    if not any(section.damping for section in sections):
        return method, Elastic(cut, law)
    return method, Damped(cut, Damping(cut.elements, sections, paper_strain=chosen["axial"] == "paper"))


def _followed(
    scene: Scene,
    march: March,
    trajectory: Trajectory,
    shape: tuple[Mesh, Mapping[str, str]],
    begun: float,
    progress: Progress | None,
    file: Checkpoint | None,
) -> Result:
    """March and record what came out.

    Raises:
        SceneError: The file is of something else.
        NotConverged: The end was not reached.
    """
    kept = None if file is None else file.read()
    if kept is not None:
        resume_motion(march, trajectory, kept)
    started = time.perf_counter()
    failure = _marched(scene, march, trajectory, progress, file)
    trajectory.finish()
    cut, chosen = shape
    notes = tuple(f'{name}="{value}"' for name, value in chosen.items() if value != PLAIN[name])
    seconds = (started - begun, time.perf_counter() - started)
    found, state = formulation(scene, cut, notes), stored_motion(march.mark.state, march.mark.step, cut)
    state |= dict(march.mark.entry.memory)
    result = trajectory.result(found, state, seconds, converged=failure is None)
    if failure is None:
        return result
    words = _advice(scene, cut, failure, file)
    raise NotConverged(result=result, t=failure.t, step=failure.step, reason=failure.reason, advice=words) from failure


def _marched(
    scene: Scene, march: March, trajectory: Trajectory, progress: Progress | None, file: Checkpoint | None
) -> StepFailed | None:
    """March to the end; what stopped it, or None."""
    started, failure = time.perf_counter(), None

    def arrays() -> dict[str, Array]:
        return motion_of(march, trajectory, time.perf_counter() - started)

    def stepped() -> None:
        if file is not None:
            file.now_and_then(march.mark.state.t, arrays)
        if progress is not None:
            progress(trajectory.log[-1], scene.motion.t_end)

    try:
        march.follow(stepped)
    except StepFailed as caught:
        failure = caught
    except KeyboardInterrupt:
        failure = StepFailed(t=march.mark.state.t, step=march.mark.step, reason=INTERRUPTED)
    trajectory.rewind(march.mark.entry, march.mark.state)
    if file is not None:
        file.write(march.mark.state.t, arrays)
    return failure


def _begin(timed: Scene, scene: Scene, method: BackwardEuler, start: Result | None) -> tuple[Moving, dict[str, float]]:
    """The first state and the works done before it: from rest, from the shape of a result, or where one ended."""
    state = initial(timed, method.mesh, method.supports)
    if start is None:
        _touch(method, state, {})
        return state, {}
    goes_on = start.scene == scene and float(start.t[-1]) < scene.motion.t_end
    state = moving_on(start.state, state, method.mesh, float(start.t[-1]) if goes_on else None)
    _touch(method, state, start.state if goes_on else {})
    if not goes_on:
        return state, {}
    unit, known = method.mesh.units.moment, (*WORKS, *WORKS_THERE)
    return state, {name: float(start.energy[name][-1]) / unit for name in known if name in start.energy}


def _touch(method: BackwardEuler, state: Moving, arrays: Mapping[str, Array]) -> None:
    """Surfaces begin there, with what `arrays` tell that they remember."""
    if method.contacts is not None:
        method.contacts.recall(arrays, state.x, state.R, state.t)


def _check(scene: Scene, chosen: Mapping[str, str]) -> None:
    """What the discrete model knows of motions in time.

    Raises:
        SceneError: Something that it does not know.
    """
    assert isinstance(scene.motion, Dynamic)
    if not isinstance(scene.motion.scheme, ImplicitEuler):
        kind = type(scene.motion.scheme).__name__
        raise SceneError(
            f"must be ImplicitEuler(), discrete knows ImplicitEuler only, got {kind}()", field="motion.scheme"
        )
    if chosen["frame"] != "element":
        for k, rod in enumerate(scene.rods):
            if rod.section.damping:
                damped = f'must be 0 s where frame is "node_i", got {rod.section.damping} s'
                raise SceneError(damped, field=f"rods[{k}].section.damping")


def _advice(scene: Scene, cut: Mesh, failure: StepFailed, file: Checkpoint | None) -> str:
    """What to try against a failure."""
    if failure.reason == INTERRUPTED:
        return advice(scene, cut, failure, (), file)
    motion = scene.motion
    assert isinstance(motion, Dynamic)
    if motion.dt is not None:
        return f"Try Dynamic(dt={motion.dt / 10:.3g}), more elements, or look at `.result` (what was reached)"
    return "Try a smaller Dynamic.tol, more elements, or look at `.result` (what was reached)"
