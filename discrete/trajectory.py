"""What is kept of a motion in time, and its record."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.mesh import RIGID_EXTENSION
from discrete.record import Snapshot, evenly, histories
from dolfinrod.result import Formulation, Result, Statistics, StepLog

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.euler import BackwardEuler, Taken
    from discrete.laws import Damped, Elastic
    from discrete.ledger import Ledger
    from discrete.mesh import Mesh
    from discrete.moving import Moving
    from discrete.statics import Progress
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Trajectory", "formulation"]


class Trajectory:
    """States of a motion that are stored, and a row of the log for every step.

    Args:
        scene: The problem as it was posed.
        method: Its steps.
        laws: Of the elements.
        ledger: Of its energy, which it keeps.
        start: The first state.
        force: End forces of the elements there, shape (n, 13).
        progress: Called with every step and the final time.
    """

    def __init__(
        self,
        scene: Scene,
        method: BackwardEuler,
        laws: Elastic | Damped,
        ledger: Ledger,
        start: Moving,
        force: Array,
        progress: Progress | None,
    ) -> None:
        self._scene, self._method, self._laws, self._ledger = scene, method, laws, ledger
        self._progress, self._unstored = progress, None
        self.log: list[StepLog] = []
        line = evenly(method.loads.level(start.t).line)
        self._kept: list[Snapshot] = []
        self._books: list[dict[str, float]] = []
        self._store(start, force, line)
        self._share = _shares(method.mesh)

    _unstored: tuple[Moving, Taken] | None

    def accept(self, before: Moving, taken: Taken, cuts: int, stored: bool) -> None:
        """Add a step.

        Args:
            before: Where it began.
            taken: The step.
            cuts: Attempts lost before it.
            stored: Whether its end is.
        """
        strain, damped = self._laws.accept(taken, taken.state.t - before.t)
        self._ledger.add(before, taken, strain, damped)
        energy = strain * self._method.mesh.units.moment
        row = StepLog(taken.state.t, taken.iterations, cuts, taken.residual, energy)
        self.log.append(row)
        self._unstored = before, taken
        if stored:
            self.finish()
        if self._progress is not None:
            self._progress(row, self._scene.motion.t_end)

    def finish(self) -> None:
        """Store the last state unless it is already."""
        if self._unstored is None:
            return
        before, taken = self._unstored
        state, dt = taken.state, taken.state.t - before.t
        nodal = taken.drag - self._method.inertia.force(state.v - before.v, dt)
        node_i = self._method.mesh.elements.node_i
        halves = evenly(taken.level.line)
        halves[:, 0] += self._share[:, :1] * nodal[node_i]
        halves[:, 1] += self._share[:, 1:] * nodal[node_i + 1]
        self._store(state, taken.force, halves)
        self._unstored = None

    def result(
        self, shape: Formulation, state: dict[str, Array], seconds: tuple[float, float], *, converged: bool
    ) -> Result:
        """The record of all that is stored.

        Args:
            shape: What entered the equations.
            state: What a later solve can go on from.
            seconds: Spent on setting up and on stepping [s].
            converged: Whether the end was reached.
        """
        mesh = self._method.mesh
        work = self._method.iterations, self._method.factorizations
        statistics = Statistics(sum(shape.unknowns.values()), len(self.log), *work, 0.0, *seconds)
        return Result(
            scene=self._scene,
            t=np.array([kept.t for kept in self._kept]),
            rods=histories(mesh, [rod.section for rod in self._scene.rods], self._kept),
            converged=converged,
            log=tuple(self.log),
            energy={name: np.array([book[name] for book in self._books]) for name in self._books[0]},
            statistics=statistics,
            formulation=shape,
            state=state,
        )

    def _store(self, state: Moving, force: Array, halves: Array) -> None:
        unit = self._method.mesh.units.moment
        book = {name: value * unit for name, value in self._ledger.now.items()}
        elastic = self._laws.elastic_force(state)
        kept = Snapshot(state.t, state.x, state.R, force, halves, book["strain"] / unit, state.v, state.ω, elastic)
        self._kept.append(kept)
        self._books.append(book)


def formulation(scene: Scene, cut: Mesh, notes: tuple[str, ...]) -> Formulation:
    """What entered the equations of motion.

    Args:
        scene: The problem.
        cut: Its mesh.
        notes: On the options chosen.
    """
    unknowns = {"x": 3 * len(cut.x), "rotation": 3 * len(cut.x), "F_n": len(cut.elements.l)}
    terms = ["Elasticity", "Inertia", *dict.fromkeys(type(load).__name__ for load in scene.loads)]
    if scene.air is not None:
        terms.append("Drag")
    if any(rod.section.damping for rod in scene.rods):
        terms.append("Damping")
    known = ["no shear: GA ignored, as in the paper"]
    if any("extension" in rod.section.rigid for rod in scene.rods):
        known.append(f"rigid extension: EA = {RIGID_EXTENSION:.0e}·EI/L²")
    if any(rod.section.rhoI is None or rod.section.rhoI[0] == 0.0 for rod in scene.rods):
        known.append("no inertia about the axis given: a thousandth of that of a node across it stands in")
    return Formulation("discrete", "spatial", unknowns, tuple(terms), (*known, *notes))


def _shares(mesh: Mesh) -> Array:
    """Part of what acts at a node that falls on each element there, at either end, shape (n, 2)."""
    node_i, l = mesh.elements.node_i, mesh.elements.l
    total = np.zeros(len(mesh.x))
    total[node_i] = l
    total[node_i + 1] += l
    return l[:, None] / np.stack([total[node_i], total[node_i + 1]], axis=1)
