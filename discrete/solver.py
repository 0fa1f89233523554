"""`discrete.solve`: a scene in, a result out."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from discrete.corotation import ChordElement
from discrete.dynamics import moved
from discrete.endforces import QuickElement
from discrete.equilibrium import Equilibrium
from discrete.failure import advice
from discrete.increments import Increments
from discrete.loads import Loads
from discrete.mesh import mesh
from discrete.neutral import PhaseCondition
from discrete.nodeframe import EnergyNodeElement, PaperElement
from discrete.record import recorded
from discrete.restart import restored
from discrete.stability import Judge
from discrete.state import State
from discrete.statics import INTERRUPTED, Path, StepFailed, stride
from discrete.stepping import Walk
from discrete.supports import Supports
from dolfinrod.result import NotConverged, Result
from dolfinrod.scene import Dynamic, SceneError
from dolfinrod.scene.door import admit

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from discrete.equilibrium import Element
    from discrete.increments import Carried
    from discrete.mesh import Elements, Mesh
    from discrete.statics import Progress
    from dolfinrod.scene import Scene

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

    Returns:
        The states at the accepted load steps or output times.

    Raises:
        SceneError: The scene or an option cannot be solved as given.
        NotConverged: A load step could not be taken; carries what had converged.
    """
    admit(scene, start, Result)
    _check(axial, frame, equilibrium, start)
    if isinstance(scene.motion, Dynamic):
        return _moved(scene, elements, (axial, frame, rotation, end_mass), equilibrium, progress, start)
    begun = time.perf_counter()
    return _followed(scene, _prepare(scene, mesh(scene, elements), axial, frame, equilibrium, start), begun, progress)


@dataclass(frozen=True, eq=False)
class _Run:
    """A solve that is about to begin.

    Args:
        mesh: Nodes and elements.
        path: Its first state.
        follow: Lets the path grow to the end of the pseudo-time.
        notes: What a user should know of the last state.
    """

    mesh: Mesh
    path: Path[State] | Path[Carried]
    follow: Callable[[Progress | None], None]
    notes: Callable[[], tuple[str, ...]]


def _prepare(scene: Scene, cut: Mesh, axial: str, frame: str, equilibrium: bool, start: Result | None) -> _Run:
    """Set up equilibrium iterations or the paper's increments."""
    if equilibrium:
        phase, path = _set_up(scene, cut, axial, frame, start)
        earlier = start.log[-1].stable if start is not None and start.log else True
        walk = Walk(phase, Judge(scene, cut), scene, path, path.kept[-1].t, stable=earlier)
        return _Run(cut, path, walk.follow, lambda: phase.notes)
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
    method = Equilibrium(cut, _law(cut.elements, axial, frame), Loads(scene, cut), Supports(scene, cut))
    return PhaseCondition(method), _begin(method, scene, start)


def _followed(scene: Scene, run: _Run, begun: float, progress: Progress | None) -> Result:
    """Follow the loads and record what came out of what was begun at a time of the clock.

    Raises:
        NotConverged: A load step could not be taken.
    """
    started = time.perf_counter()
    failure = None
    try:
        run.follow(progress)
    except StepFailed as caught:
        failure = caught
    except KeyboardInterrupt:
        failure = StepFailed(t=run.path.kept[-1].t, step=0.0, reason=INTERRUPTED)
    seconds = (started - begun, time.perf_counter() - started)
    result = recorded(scene, run.mesh, run.path, run.notes(), seconds, converged=failure is None)
    if failure is not None:
        raise NotConverged(
            result=result,
            t=failure.t,
            step=failure.step,
            reason=failure.reason,
            advice=advice(scene, failure, run.path.log),
        ) from failure
    return result


def _check(axial: str, frame: str, equilibrium: bool, start: Result | None) -> None:
    """Options that the model knows.

    Raises:
        SceneError: One that it does not know.
    """
    if axial not in ("chord", "paper"):
        raise SceneError(f'axial must be "chord" or "paper", got {axial!r}')
    if frame not in ("element", "node_i"):
        raise SceneError(f'frame must be "element" or "node_i", got {frame!r}')
    if start is not None and not equilibrium:
        raise SceneError("start must be None where equilibrium is False: the end forces carried along are not kept")


def _moved(
    scene: Scene,
    elements: int | Sequence[int],
    options: tuple[str, str, str, str],
    equilibrium: bool,
    progress: Progress | None,
    start: Result | None,
) -> Result:
    """Motion in time; `axial`, `frame`, `rotation`, `end_mass` and the rest as for `solve`.

    Raises:
        SceneError: An option that is not known there.
    """
    chosen = dict(zip(("axial", "frame", "rotation", "end_mass"), options, strict=True))
    for name, known in (("rotation", ("exponential", "added")), ("end_mass", ("half", "paper"))):
        if chosen[name] not in known:
            raise SceneError(f'{name} must be "{known[0]}" or "{known[1]}", got {chosen[name]!r}')
    if not equilibrium:
        raise SceneError("equilibrium must be True in a Dynamic motion: its steps are fully implicit")
    cut = mesh(scene, elements)
    law = _law(cut.elements, chosen["axial"], chosen["frame"])
    if chosen["frame"] == "element":
        law = QuickElement(cut.elements, paper_strain=chosen["axial"] == "paper")
    return moved(scene, cut, law, chosen, progress=progress, start=start)


def _law(elements: Elements, axial: str, frame: str) -> Element:
    """Law of the elements."""
    if frame == "element":
        return ChordElement(elements, paper_strain=axial == "paper")
    return PaperElement(elements) if axial == "paper" else EnergyNodeElement(elements)


def _begin(method: Equilibrium, scene: Scene, start: Result | None) -> Path[State]:
    """The first state, stress free or where an earlier result ended."""
    state, t = method.begin(), 0.0
    if start is not None:
        state = restored(start.state, state, method.mesh)
        for section in method.supports.turns:
            state.R[section.node] = section.frame(state.factors)
        if start.scene == scene and start.t[-1] < scene.motion.t_end:
            t = float(start.t[-1])
    path = Path(state)
    path.kept.append(method.snapshot(state, t))
    return path
