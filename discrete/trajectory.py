"""What is kept of a motion in time, and its record."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from discrete.mesh import RIGID_EXTENSION
from discrete.record import Snapshot, evenly, halved, histories
from discrete.touching import contact_histories, contact_terms, meeting_histories
from discrete.unknowns import X
from dolfinrod.result import Formulation, Result, Statistics, StepLog

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.euler import BackwardEuler, Taken
    from discrete.laws import Damped, Elastic
    from discrete.ledger import Ledger
    from discrete.mesh import Mesh
    from discrete.moving import Moving
    from dolfinrod.meetings import Meetings
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]
    Felt = tuple[Array | None, tuple[Meetings, ...]]
    Unstored = tuple[Moving, Taken, Felt]

__all__ = ["Entry", "Trajectory", "formulation"]


@dataclass(frozen=True, eq=False)
class Entry:
    """How far a trajectory had come at the end of a step.

    Args:
        stored: Number of states stored.
        steps: Number of steps.
        now: Ledger, in units of the model.
        last: The last step where its end is not stored, with the state before and what surfaces did; None where it is.
        memory: What surfaces remember.
    """

    stored: int
    steps: int
    now: Mapping[str, float]
    last: Unstored | Snapshot | None = None
    memory: Mapping[str, Array] = field(default_factory=dict)


class Trajectory:
    """States of a motion that are stored, and a row of the log for every step.

    Args:
        scene: The problem as it was posed.
        method: Its steps.
        laws: Of the elements.
        ledger: Of its energy, which it keeps.
        start: The first state.
        force: End forces of the elements there, shape (n, 13).

    Attributes:
        log: One row a step.
        kept: Stored states.
        books: Ledger at them [J].
        earlier: Iterations, factorisations and seconds that earlier runs took.
    """

    def __init__(
        self,
        scene: Scene,
        method: BackwardEuler,
        laws: Elastic | Damped,
        ledger: Ledger,
        start: Moving,
        force: Array,
    ) -> None:
        self._scene, self._method, self._laws, self._ledger = scene, method, laws, ledger
        self._unstored: Unstored | Snapshot | None = None
        self.log: list[StepLog] = []
        self.kept: list[Snapshot] = []
        self.books: list[dict[str, float]] = []
        self.earlier = 0, 0, 0.0
        halves, felt = evenly(method.loads.level(start.t).line), self._felt()
        if method.contacts is not None:
            halves += halved(method.contacts.force(start.x, start.R)[:, X], method.mesh)
        self._store(self._snapshot(start, force, halves, felt))

    @property
    def entry(self) -> Entry:
        """How far it has come."""
        contacts = self._method.contacts
        memory = {} if contacts is None else contacts.memory()
        return Entry(len(self.kept), len(self.log), dict(self._ledger.now), self._unstored, memory)

    @property
    def work(self) -> tuple[int, int, float]:
        """Iterations and factorisations so far, and the seconds that earlier runs took."""
        iterations, factorizations, seconds = self.earlier
        return self._method.iterations + iterations, self._method.factorizations + factorizations, seconds

    def accept(self, before: Moving, taken: Taken, cuts: int, stored: bool) -> Entry:
        """Add a step.

        Args:
            before: Where it began.
            taken: The step.
            cuts: Attempts lost before it.
            stored: Whether its end is.

        Returns:
            How far it has come.
        """
        strain, damped = self._laws.accept(taken, taken.state.t - before.t)
        contacts, state, booked = self._method.contacts, taken.state, None
        if contacts is not None:
            booked = contacts.accept(state.x, state.R, state.t)
        self._ledger.add(before, taken, strain, damped, booked)
        energy = strain * self._method.mesh.units.moment
        self.log.append(StepLog(taken.state.t, taken.iterations, cuts, taken.residual, energy))
        self._unstored = before, taken, self._felt()
        if stored:
            self.finish()
        return self.entry

    def rewind(self, entry: Entry, state: Moving) -> None:
        """Be what it was at the end of a step that led to a state."""
        del self.kept[entry.stored :], self.books[entry.stored :], self.log[entry.steps :]
        self._ledger.now, self._unstored = dict(entry.now), entry.last
        self._laws.begin(state)
        if self._method.contacts is not None:
            self._method.contacts.recall(entry.memory, state.x, state.R, state.t)

    def last(self) -> Snapshot | None:
        """The last state where it is not stored; None where it is."""
        if not isinstance(self._unstored, tuple):
            return self._unstored
        before, taken, felt = self._unstored
        state, dt = taken.state, taken.state.t - before.t
        nodal = taken.drag - self._method.inertia.force(state.v - before.v, dt)
        if taken.pressed is not None:
            nodal += taken.pressed[:, X]
        halves = evenly(taken.level.line) + halved(nodal, self._method.mesh)
        return self._snapshot(state, taken.force, halves, felt)

    def finish(self) -> None:
        """Store the last state unless it is already."""
        last = self.last()
        if last is not None:
            self._store(last)
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
        iterations, factorizations, earlier = self.work
        setup, solve = seconds
        cost = len(self.log), iterations, factorizations, 0.0, setup, earlier + solve
        statistics = Statistics(sum(shape.unknowns.values()), *cost)
        return Result(
            scene=self._scene,
            t=np.array([kept.t for kept in self.kept]),
            rods=histories(mesh, [rod.section for rod in self._scene.rods], self.kept),
            converged=converged,
            log=tuple(self.log),
            energy={name: np.array([book[name] for book in self.books]) for name in self.books[0]},
            statistics=statistics,
            formulation=shape,
            state=state,
            contacts=contact_histories(
                self._scene, mesh, [kept.touching for kept in self.kept if kept.touching is not None]
            ),
            meetings=meeting_histories([kept.met for kept in self.kept]),
        )

    def _felt(self) -> Felt:
        """What surfaces and other rods did in the last answer."""
        contacts = self._method.contacts
        return (None, ()) if contacts is None else (contacts.record(), contacts.meetings())

    def _snapshot(self, state: Moving, force: Array, halves: Array, felt: Felt) -> Snapshot:
        at, energy = (state.t, state.x, state.R), self._ledger.now["strain"]
        elastic = self._laws.elastic_force(state)
        return Snapshot(*at, force, halves, energy, state.v, state.ω, elastic, *felt)

    def _store(self, kept: Snapshot) -> None:
        unit = self._method.mesh.units.moment
        self.kept.append(kept)
        self.books.append({name: value * unit for name, value in self._ledger.now.items()})


def formulation(scene: Scene, cut: Mesh, notes: tuple[str, ...]) -> Formulation:
    """What entered the equations of motion.

    Args:
        scene: The problem.
        cut: Its mesh.
        notes: On the options chosen.
    """
    unknowns = {"x": 3 * len(cut.x), "rotation": 3 * len(cut.x), "F_n": len(cut.elements.l)}
    loads = dict.fromkeys(type(load).__name__ for load in scene.loads)
    terms = ["Elasticity", "Inertia", *loads, *contact_terms(scene)]
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
