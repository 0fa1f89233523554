"""`discrete.solve`: a scene in, a result out."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from discrete.corotation import ChordElement
from discrete.equilibrium import Equilibrium, State
from discrete.increments import Increments
from discrete.loads import Loads
from discrete.mesh import RIGID_EXTENSION, mesh
from discrete.neutral import PhaseCondition
from discrete.nodeframe import EnergyNodeElement, PaperElement
from discrete.record import histories
from discrete.restart import restored, stored
from discrete.statics import Path, StepFailed, stride, walk
from discrete.supports import Supports
from dolfinrod.result import Formulation, NotConverged, Result, Statistics
from dolfinrod.scene import SceneError
from dolfinrod.scene.door import admit
from dolfinrod.scene.mechanism import advice

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from discrete.equilibrium import Element
    from discrete.increments import Carried
    from discrete.mesh import Elements, Mesh
    from discrete.statics import Progress
    from dolfinrod.scene import Scene

__all__ = ["solve"]


def solve(
    scene: Scene,
    *,
    elements: int | Sequence[int] = 80,
    axial: str = "chord",
    frame: str = "element",
    equilibrium: bool = True,
    progress: Progress | None = None,
    start: Result | None = None,
) -> Result:
    """Equilibrium of thin rods by the paper's 12×12 elements.

    Args:
        scene: What is posed.
        elements: Elements of each rod, one number for all or one a rod.
        axial: Elongation in Eq. 16: "chord", of the chord; "paper", along the normal of node i (Eq. 20) as printed.
        frame: Axes of an element: "element", along the chord, transverse axes from the mean of the node triads;
            "node_i", those of its first node as printed.
        equilibrium: Whether to iterate to equilibrium; otherwise one linear solve a load increment (2.3.3), with
            `Static(steps=None)` read as 100 increments. Then `axial` makes no difference: Eq. 16 acts on increments.
        progress: Called with each accepted step and the final pseudo-time.
        start: An earlier result on the same elements: its last state is the first guess; of the same scene, stepping
            goes on from its last pseudo-time. Not without equilibrium iterations.

    Returns:
        The states at the accepted load steps.

    Raises:
        SceneError: The scene or an option cannot be solved as given.
        NotConverged: A load step could not be taken; carries what had converged.
    """
    admit(scene, start, Result)
    _check(axial, frame, equilibrium, start)
    started = time.perf_counter()
    run = _prepare(scene, mesh(scene, elements), axial, frame, equilibrium, start)
    return _followed(scene, run, time.perf_counter() - started, progress)


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
    loads, supports = Loads(scene, cut), Supports(scene, cut)
    if equilibrium:
        method = Equilibrium(cut, _law(cut.elements, axial, frame), loads, supports)
        phase = PhaseCondition(method)
        path, t = _begin(method, scene, start)
        return _Run(cut, path, partial(walk, method, phase, path, t, scene), lambda: phase.notes)
    increments = Increments(cut, loads, supports, node_frame=frame == "node_i")
    carried = Path(increments.begin())
    carried.kept.append(increments.snapshot(carried.state, 0.0))
    return _Run(cut, carried, partial(stride, increments, carried, 0.0, scene), tuple)


def _followed(scene: Scene, run: _Run, seconds_setup: float, progress: Progress | None) -> Result:
    """Follow the loads and record what came out.

    Raises:
        NotConverged: A load step could not be taken.
    """
    started = time.perf_counter()
    failure = None
    try:
        run.follow(progress)
    except StepFailed as caught:
        failure = caught
    seconds = (seconds_setup, time.perf_counter() - started)
    result = _result(scene, run, seconds, converged=failure is None)
    if failure is not None:
        raise NotConverged(
            result=result, t=failure.t, step=failure.step, reason=failure.reason, advice=advice(scene)
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


def _law(elements: Elements, axial: str, frame: str) -> Element:
    """Law of the elements."""
    if frame == "element":
        return ChordElement(elements, paper_strain=axial == "paper")
    return PaperElement(elements) if axial == "paper" else EnergyNodeElement(elements)


def _begin(method: Equilibrium, scene: Scene, start: Result | None) -> tuple[Path[State], float]:
    """The first state, stress free or where an earlier result ended, and its pseudo-time."""
    state, t = method.begin(), 0.0
    if start is not None:
        state = restored(start.state, state, method.mesh)
        for section in method.supports.turns:
            state.R[section.node] = section.frame(state.factors)
        if start.scene == scene and start.t[-1] < scene.motion.t_end:
            t = float(start.t[-1])
    path = Path(state)
    path.kept.append(method.snapshot(state, t))
    return path, t


def _result(scene: Scene, run: _Run, seconds: tuple[float, float], *, converged: bool) -> Result:
    cut, path = run.mesh, run.path
    n_nodes, n_elements = len(cut.x), len(cut.elements.l)
    unknowns = {"x": 3 * n_nodes, "rotation": 3 * n_nodes}
    if isinstance(path.state, State):
        unknowns["F_n"] = n_elements
    notes = ["no shear: GA ignored, as in the paper"]
    if any("extension" in rod.section.rigid for rod in scene.rods):
        notes.append(f"rigid extension: EA = {RIGID_EXTENSION:.0e}·EI/L²")
    notes += run.notes()
    return Result(
        scene=scene,
        t=np.array([kept.t for kept in path.kept]),
        rods=histories(cut, [rod.section for rod in scene.rods], path.kept),
        converged=converged,
        log=tuple(path.log),
        energy={"strain": np.array([kept.energy for kept in path.kept]) * cut.units.moment},
        statistics=Statistics(
            dofs=sum(unknowns.values()),
            load_steps=len(path.log),
            newton_iterations=path.iterations,
            factorizations=path.iterations,
            seconds_setup=seconds[0],
            seconds_solve=seconds[1],
        ),
        formulation=Formulation(
            "discrete",
            "spatial",
            unknowns,
            ("Elasticity", *dict.fromkeys(type(load).__name__ for load in scene.loads)),
            tuple(notes),
        ),
        state=stored(path.state, cut) if isinstance(path.state, State) else {},
    )
