"""The state of a motion in arrays that know no ranks, from which it goes on."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.checkpoint import goes_on
from dolfinrod.continuum import backend
from dolfinrod.continuum.met import is_ragged
from dolfinrod.continuum.motion import Motion
from dolfinrod.continuum.trajectory import Mark
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from dolfinrod.continuum.march import March
    from dolfinrod.continuum.moving import Moving
    from dolfinrod.continuum.problem import Problem
    from dolfinrod.continuum.readout import Readout, State
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["follow_on", "meet_again", "moving_state", "rates", "shapes", "shapes_of_fields", "take_up"]


def rates(problem: Moving, readout: Readout) -> State:
    """Velocities "v" and spins "omega" at the nodes by cell, on every rank, in working units."""
    d, lumped, kin = problem.discretization, problem.lumped, problem.kinematics
    spin = kin.turned_back(problem.x[lumped.q], problem.motion.π)
    spin = kin.turned_spin(problem.x[lumped.q], np.einsum("nij,nj->ni", lumped.J_inverse, spin))
    moving = backend.function(d.space)
    moving.x.array[lumped.r] = problem.motion.v
    moving.x.array[lumped.q[:, : kin.n_spin]] = spin
    moving.x.scatter_forward()
    q = d.dofs["q"][:, :, : kin.n_spin]
    return readout.gather(v=moving.x.array[d.dofs["r"]], omega=moving.x.array[q])


def moving_state(march: March) -> State:
    """The state that a march goes on from, gathered on every rank.

    Returns:
        Fields and velocities as in `Trajectory.states`; momenta "pi"; length of the next step "length" [s]; where there
        has been a step, its mean acceleration "a" and its length "h" in units of time.
    """
    problem, readout, motion = march.problem, march.readout, march.mark.motion
    d, lumped = problem.discretization, problem.lumped
    r, q = d.dofs["r"], d.dofs["q"][:, :, : problem.kinematics.n_spin]
    carrier = backend.function(d.space)
    values = carrier.x.array

    def gathered(nodes: NDArray[np.int32], own: Array, cells: NDArray[np.int32]) -> Array:
        values[nodes] = own
        carrier.x.scatter_forward()
        return readout.gather(values=values[cells])["values"]

    state = march.state()
    state |= {"pi": gathered(lumped.q[:, : q.shape[2]], motion.π, q), "length": np.array(march.mark.length)}
    if motion.a is not None:
        state |= {"a": gathered(lumped.r, motion.a, r), "h": np.array(motion.h)}
    return state


def shapes(march: March) -> tuple[dict[str, tuple[int, ...]], dict[str, tuple[int, ...]]]:
    """Shapes of what `moving_state` gives before any step, and of what is added by one."""
    first = _shapes(moving_state(march))
    return first, {"a": first["v"], "h": ()}


def _shapes(state: Mapping[str, Array]) -> dict[str, tuple[int, ...]]:
    return {name: values.shape for name, values in state.items()}


def take_up(march: March, state: Mapping[str, Array], mark: Mark) -> None:
    """Make a gathered state the one that a march goes on from.

    Args:
        march: Its trajectory is that up to there.
        state: From `moving_state` on any number of ranks.
        mark: All else of the march.
    """
    problem = march.problem
    d, lumped = problem.discretization, problem.lumped
    x = np.zeros_like(problem.x)
    for field, dofs in d.dofs.items():
        x[dofs] = state[field][d.cell]

    def own(name: str, cells: NDArray[np.int32], nodes: NDArray[np.int32]) -> Array:
        values = np.zeros_like(x)
        values[cells] = state[name][d.cell]
        return np.asarray(values[nodes])

    n_spin = problem.kinematics.n_spin
    v, π = own("v", d.dofs["r"], lumped.r), own("pi", d.dofs["q"][:, :, :n_spin], lumped.q[:, :n_spin])
    motion = Motion(v, π)
    if "a" in state:
        motion = Motion(v, π, own("a", d.dofs["r"], lumped.r), float(state["h"]))
    touched = None
    if problem.contacts is not None:
        problem.x[:] = x
        if problem.walls is not None:
            problem.walls.recall(state["touch"][d.cell])
        if problem.pairs is not None:
            problem.pairs.recall(state)
        touched = problem.contacts.memory()
    march.take_up(replace(mark, x=x, motion=motion, touched=touched))


def meet_again(problem: Problem, start: Result, t: float) -> None:
    """Take up at pseudo-time t what an earlier result remembers of the same surfaces and rods; others are met anew."""
    walls, pairs = problem.walls, problem.pairs
    if walls is not None:
        if start.scene.walls == problem.scene.walls:
            walls.recall(start.state["touch"][problem.discretization.cell], t)
        else:
            walls.place(t)
    if pairs is not None:
        if start.scene.meetings == problem.scene.meetings:
            pairs.recall(start.state, t)
        else:
            pairs.place(t)


def shapes_of_fields(state: Mapping[str, Array]) -> dict[str, tuple[int, ...]]:
    """Of all values of a state but those of contacts."""
    of_contacts = "touch", "couples"
    return {name: of for name, of in _shapes(state).items() if name not in of_contacts and not is_ragged(name)}


def follow_on(march: March, start: Result, scene: Scene) -> None:
    """Go on where a result of the same motion ended.

    Args:
        march: Newly made.
        start: The result.
        scene: What is posed.

    Raises:
        SceneError: It is of another motion or model, or on another mesh.
    """
    if start.formulation.model != "continuum" or not goes_on(start.scene, scene):
        raise SceneError(
            "must be None or a result of this very motion, which goes on from there; only steps, output and t_end may "
            "be others, and t_end not where a prescribed motion grows until then",
            field="start",
        )
    t, state, motion = float(start.t[-1]), start.state, scene.motion
    if t > motion.t_end:
        raise SceneError(f"must end before t_end = {motion.t_end} s, got {t} s", field="start")
    first, added = shapes(march)
    found, first = ({name: of for name, of in each.items() if not is_ragged(name)} for each in (_shapes(state), first))
    if found not in (first, first | added):
        raise SceneError("start must be a result on the same elements, degree and kinematics")
    unit = march.problem.placement.moment
    energy = {name: float(start.energy[name][-1]) / unit for name in march.mark.energy}
    mark = replace(march.mark, t=t, energy=energy)
    take_up(march, state, mark if march.even else replace(mark, length=float(state["length"])))
