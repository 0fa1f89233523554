"""From states of the model to the result record: SI units, section frames, values at the nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.mesh import RIGID_EXTENSION
from discrete.restart import stored
from discrete.state import State
from discrete.touching import contact_histories, contact_terms, energetic, meeting_histories, unjudged
from discrete.unknowns import SPIN_I, SPIN_J, X_J
from dolfinrod.result import Formulation, Result, RodHistory, Statistics

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from discrete.increments import Carried
    from discrete.mesh import Mesh
    from discrete.statics import Path
    from dolfinrod.meetings import Meetings
    from dolfinrod.scene import Scene, Section

    Array = NDArray[np.float64]

__all__ = ["Snapshot", "evenly", "halved", "histories", "recorded"]


@dataclass(frozen=True, eq=False)
class Snapshot:
    """What is kept of an accepted state, in the units of the model.

    Args:
        t: Pseudo-time.
        x: Positions of the nodes, shape (n_nodes, 3).
        R: Section frames, shape (n_nodes, 3, 3).
        force: End forces of the elements, global axes, shape (n, 13).
        halves: Force on the half of each element at either end, that of inertia included, shape (n, 2, 3).
        energy: Strain energy.
        v: Velocities of the nodes, shape (n_nodes, 3); None in statics.
        ω: Angular velocities in global axes, shape (n_nodes, 3); None in statics.
        elastic: The end forces without those of damping; None where there is none.
        touching: What the nodes feel of the contacts, as `Contacts.record` gives it; None where there are none.
        met: Where rods touch one another, one record a meeting of the scene.
    """

    t: float
    x: Array
    R: Array
    force: Array
    halves: Array
    energy: float
    v: Array | None = None
    ω: Array | None = None
    elastic: Array | None = None
    touching: Array | None = None
    met: tuple[Meetings, ...] = ()


def evenly(line: Array) -> Array:
    """Halves of forces on elements, shape (n, 2, 3)."""
    return np.repeat(0.5 * line[:, None], 2, axis=1)


def halved(nodal: Array, mesh: Mesh) -> Array:
    """Halves of forces on nodes, shape (n_nodes, 3), as much to each element there as it is long, shape (n, 2, 3)."""
    node_i, half = mesh.elements.node_i, 0.5 * mesh.elements.l[:, None]
    per_length = nodal / mesh.share[:, None]
    return np.stack([half * per_length[node_i], half * per_length[node_i + 1]], axis=1)


def recorded(
    scene: Scene,
    cut: Mesh,
    path: Path[State] | Path[Carried],
    held: Sequence[str],
    seconds: tuple[float, float],
    memory: Mapping[str, Array],
    *,
    converged: bool,
) -> Result:
    """The record of a path.

    Args:
        scene: The problem.
        cut: Its mesh.
        path: What was found.
        held: Neutral motions that were held, in words.
        seconds: Spent on setting up and on solving [s].
        memory: What its contacts remember of its last state.
        converged: Whether the end was reached.

    Returns:
        Complete, in SI units.
    """
    iterated = isinstance(path.state, State)
    formulation = _formulation(scene, cut, (*_untold(scene, path), *held), with_force=iterated)
    dofs = sum(formulation.unknowns.values())
    return Result(
        scene=scene,
        t=np.array([kept.t for kept in path.kept]),
        rods=histories(cut, [rod.section for rod in scene.rods], path.kept),
        converged=converged,
        log=tuple(path.log),
        energy={"strain": np.array([kept.energy for kept in path.kept]) * cut.units.moment},
        statistics=Statistics(dofs, len(path.log), path.iterations, path.iterations, 0.0, *seconds),
        formulation=formulation,
        state=stored(path.state, cut) | dict(memory) if isinstance(path.state, State) else {},
        contacts=contact_histories(scene, cut, [kept.touching for kept in path.kept if kept.touching is not None]),
        meetings=meeting_histories([kept.met for kept in path.kept]),
    )


def _untold(scene: Scene, path: Path[State] | Path[Carried]) -> tuple[str, ...]:
    """Why the last state is called neither stable nor unstable, where it might be."""
    untold = bool(path.log) and path.log[-1].stable is None and energetic(scene)
    return ("stability not told: the tangent has no sign but for round-off, or too many elements for one",) * untold


def _formulation(scene: Scene, cut: Mesh, held: Sequence[str], *, with_force: bool) -> Formulation:
    """What entered the equations."""
    unknowns = {"x": 3 * len(cut.x), "rotation": 3 * len(cut.x)}
    if with_force:
        unknowns["F_n"] = len(cut.elements.l)
    notes = ["no shear: GA ignored, as in the paper"]
    if any("extension" in rod.section.rigid for rod in scene.rods):
        notes.append(f"rigid extension: EA = {RIGID_EXTENSION:.0e}·EI/L²")
    terms = ("Elasticity", *dict.fromkeys(type(load).__name__ for load in scene.loads), *contact_terms(scene))
    if not energetic(scene):
        notes.append(f"stability not judged: {unjudged(scene)}")
    return Formulation("discrete", "spatial", unknowns, terms, (*notes, *held))


def histories(mesh: Mesh, sections: Sequence[Section], path: Sequence[Snapshot]) -> tuple[RodHistory, ...]:
    """One history per rod.

    Args:
        mesh: Nodes and elements.
        sections: Section of each rod.
        path: Accepted states, in order.

    Returns:
        Histories in SI units.
    """
    R = np.stack([state.R for state in path])
    n, m = _resultants(mesh, R, [state.force for state in path], path)
    γ, κ = n, m
    if any(state.elastic is not None for state in path):
        γ, κ = _resultants(mesh, R, [state.force if state.elastic is None else state.elastic for state in path], path)
    r = np.stack([state.x for state in path]) * mesh.units.length + mesh.origin
    v, ω = (_velocities(values) for values in ([state.v for state in path], [state.ω for state in path]))
    rods = []
    for j, section in enumerate(sections):
        own = slice(mesh.first[j], mesh.first[j + 1])
        rods.append(
            RodHistory(
                s=mesh.s[j],
                r=r[:, own],
                frames=R[:, own],
                gamma=γ[:, own] * (section.compliance_n[0], 0.0, 0.0),
                kappa=κ[:, own] * np.array(section.compliance_m),
                n=n[:, own],
                m=m[:, own],
                v=None if v is None else v[:, own] * mesh.units.length,
                omega=None if ω is None else ω[:, own],
            )
        )
    return tuple(rods)


def _velocities(values: Sequence[Array | None]) -> Array | None:
    """Values of all states, None where there are none."""
    known = [value for value in values if value is not None]
    return np.stack(known) if known else None


def _resultants(mesh: Mesh, R: Array, forces: Sequence[Array], path: Sequence[Snapshot]) -> tuple[Array, Array]:
    """Forces and moments in the section frames, averaged over the elements at a node, shapes (n_t, n_nodes, 3).

    The force of an element is that at its middle; what acts on half of it lies between there and its ends.
    """
    node_i = mesh.elements.node_i
    force, halves = np.stack(forces), np.stack([state.halves for state in path])
    N, at_i, at_j = force[..., X_J], halves[..., 0, :], halves[..., 1, :]
    shape = (len(path), len(mesh.x), 3)
    n, m, count = np.zeros(shape), np.zeros(shape), np.zeros(len(mesh.x))
    for nodes, N_end, M_end in ((node_i, N + at_i, -force[..., SPIN_I]), (node_i + 1, N - at_j, force[..., SPIN_J])):
        n[:, nodes] += N_end
        m[:, nodes] += M_end
        count[nodes] += 1.0
    local = np.einsum("tkji,tkj->tki", R, n), np.einsum("tkji,tkj->tki", R, m)
    share = 1.0 / count[None, :, None]
    return local[0] * share * mesh.units.force, local[1] * share * mesh.units.moment
