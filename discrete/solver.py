"""`discrete.solve`: a scene in, a result out."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from discrete.dynamics import moved
from discrete.equilibrium import Equilibrium
from discrete.failure import advice
from discrete.increments import Increments
from discrete.kept import path_of, resume_path
from discrete.loads import Loads
from discrete.mesh import mesh
from discrete.neutral import PhaseCondition
from discrete.options import check, law, law_in_time
from discrete.record import recorded
from discrete.restart import restored
from discrete.stability import Judge
from discrete.state import State
from discrete.statics import INTERRUPTED, Path, StepFailed, stride
from discrete.stepping import Walk
from discrete.supports import Supports
from discrete.surroundings import surroundings_of
from dolfinrod.checkpoint import Checkpoint
from dolfinrod.result import NotConverged, Result
from dolfinrod.scene import Dynamic
from dolfinrod.scene.door import admit

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from discrete.increments import Carried
    from discrete.mesh import Mesh
    from discrete.statics import Progress
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["beginning", "solve"]


def solve(
    scene: Scene,
    *,
    elements: int | Sequence[int] = 80,
    axial: str = "chord",
    frame: str = "element",
    equilibrium: bool = True,
    rotation: str = "exponential",
    end_mass: str = "half",
    progress: Progress | None = None,
    start: Result | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
) -> Result:
    """Equilibrium or motion of thin rods by the paper's 12×12 elements.

    Args:
        scene: What is posed.
        elements: Elements of each rod, one number for all or one a rod.
        axial: Elongation in Eq. 16: "chord", of the chord; "paper", along the normal of node i (Eq. 20) as printed.
        frame: Axes of an element: "element", the chord and the mean of the node triads; "node_i", as printed.
        equilibrium: Whether to iterate to equilibrium; else one linear solve an increment (2.3.3), 100 in `Static()`,
            and `axial` makes no difference: Eq. 16 acts on increments.
        rotation: Sections in time: "exponential", R₁ = exp(Δt ω₁) R₀; "added", rotation vectors added up.
        end_mass: Mass of end nodes in time: "half" that of others; "paper", the same, a rod too heavy by 1/n.
        progress: Called with each accepted step and the final time or pseudo-time.
        start: An earlier result on the same elements: its last state is the first guess, or the shape a motion begins
            with; of the same scene, stepping goes on from its last time. Not without equilibrium iterations.
        checkpoint: File that the run is kept in and goes on from, see `dolfinrod.solve`. Not without these either.

    Returns:
        The states at the accepted load steps or output times.

    Raises:
        SceneError: The scene or an option cannot be solved as given.
        NotConverged: A load step could not be taken; carries what had converged.
    """
    admit(scene, start, Result)
    chosen = {"axial": axial, "frame": frame, "rotation": rotation, "end_mass": end_mass}
    check(chosen, scene, equilibrium=equilibrium, start=start, checkpoint=checkpoint)
    return _solved(scene, elements, chosen, equilibrium, progress, start, checkpoint)


def _solved(
    scene: Scene,
    elements: int | Sequence[int],
    chosen: dict[str, str],
    equilibrium: bool,
    progress: Progress | None,
    start: Result | None,
    checkpoint: str | os.PathLike[str] | None,
) -> Result:
    """Solve with options that are known."""
    begun, cut, file = time.perf_counter(), mesh(scene, elements), None
    if checkpoint is not None:
        counts = tuple(len(s) - 1 for s in cut.s)
        file = Checkpoint(checkpoint, scene, {"model": "discrete", "elements": counts, **chosen}, start)
    if isinstance(scene.motion, Dynamic):
        return moved(scene, cut, law_in_time(cut.elements, chosen), chosen, progress=progress, start=start, file=file)
    run = _prepare(scene, cut, chosen["axial"], chosen["frame"], equilibrium, start, file)
    return _followed(scene, run, begun, progress, file)


@dataclass(frozen=True, eq=False)
class _Run:
    """A solve that is about to begin.

    Args:
        mesh: Nodes and elements.
        path: Its first state.
        follow: Lets the path grow to the end of the pseudo-time.
        notes: What a user should know of the last state.
        memory: What its contacts remember of it.
    """

    mesh: Mesh
    path: Path[State] | Path[Carried]
    follow: Callable[[Progress | None], None]
    notes: Callable[[], tuple[str, ...]]
    memory: Callable[[], dict[str, Array]] = dict


def _prepare(
    scene: Scene,
    cut: Mesh,
    axial: str,
    frame: str,
    equilibrium: bool,
    start: Result | None,
    file: Checkpoint | None,
) -> _Run:
    """Set up equilibrium iterations, from where they are kept, or the paper's increments."""
    if equilibrium:
        phase, path = _set_up(scene, cut, axial, frame, start)
        kept = None if file is None else file.read()
        if kept is not None:
            resume_path(path, kept, phase.equilibrium)
        behind = path.log or (start.log if start is not None else ())
        earlier = behind[-1].stable if behind else True
        walk = Walk(phase, Judge(scene, cut), scene, path, path.kept[-1].t, stable=earlier)
        return _Run(cut, path, walk.follow, lambda: phase.notes, phase.equilibrium.memory)
    increments = Increments(cut, Loads(scene, cut), Supports(scene, cut), node_frame=frame == "node_i")
    carried = Path(increments.begin())
    carried.kept.append(increments.snapshot(carried.state, 0.0))
    return _Run(cut, carried, partial(stride, increments, carried, 0.0, scene), tuple)


def beginning(scene: Scene, elements: int | Sequence[int], start: Result | None) -> tuple[PhaseCondition, Path[State]]:
    """The solver of a scene with the default element, and a path that begins where an earlier result ended.

    Args:
        scene: The problem.
        elements: Elements of each rod.
        start: The earlier result; None: stress free.

    Returns:
        Solver with its free motions, and the path.

    Raises:
        SceneError: Elements that cannot be.
    """
    return _set_up(scene, mesh(scene, elements), "chord", "element", start)


def _set_up(
    scene: Scene, cut: Mesh, axial: str, frame: str, start: Result | None
) -> tuple[PhaseCondition, Path[State]]:
    """Solver with equilibrium iterations, and its first state."""
    parts = Loads(scene, cut), Supports(scene, cut), surroundings_of(scene, cut)
    method = Equilibrium(cut, law(cut.elements, axial, frame), *parts)
    return PhaseCondition(method), _begin(method, scene, start)


def _followed(scene: Scene, run: _Run, begun: float, progress: Progress | None, file: Checkpoint | None) -> Result:
    """Follow the loads and record what came out of what was begun at a time of the clock.

    Raises:
        NotConverged: A load step could not be taken.
    """
    started, failure, path = time.perf_counter(), None, run.path

    def stepped(row: StepLog, t_end: float) -> None:
        if file is not None:
            file.now_and_then(row.t, lambda: path_of(path, run.memory()))
        if progress is not None:
            progress(row, t_end)

    try:
        run.follow(stepped)
    except StepFailed as caught:
        failure = caught
    except KeyboardInterrupt:
        failure = StepFailed(t=path.kept[-1].t, step=0.0, reason=INTERRUPTED)
    if file is not None:
        file.write(path.kept[-1].t, lambda: path_of(path, run.memory()))
    seconds = (started - begun, time.perf_counter() - started)
    result = recorded(scene, run.mesh, path, run.notes(), seconds, run.memory(), converged=failure is None)
    if failure is not None:
        words = advice(scene, run.mesh, failure, path.log, file)
        raise NotConverged(
            result=result, t=failure.t, step=failure.step, reason=failure.reason, advice=words
        ) from failure
    return result


def _begin(method: Equilibrium, scene: Scene, start: Result | None) -> Path[State]:
    """The first state, stress free or where an earlier result ended."""
    state, t = method.begin(), 0.0
    if start is not None:
        state = restored(start.state, state, method.mesh)
        for section in method.supports.turns:
            state.R[section.node] = section.frame(state.factors)
        if start.scene == scene and start.t[-1] < scene.motion.t_end:
            t = float(start.t[-1])
    met = start is not None and start.scene.walls == scene.walls
    method.place(state, t, start.state if start is not None and met else {})
    path = Path(state)
    path.kept.append(method.snapshot(state, t))
    return path
