"""Rods that meet: what acts on their nodes, and what they remember from step to step.

Both models of this project ask here, each for its own centrelines.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dolfinrod.meetings import Meetings
from dolfinrod.scene.friction import anchoring
from dolfinrod.scene.meeting.acting import derivatives, forces
from dolfinrod.scene.meeting.anchors import Anchors, keys, matched
from dolfinrod.scene.meeting.coupling import Coupling, Felt, dealt, paired
from dolfinrod.scene.meeting.curves import Spans, dot
from dolfinrod.scene.meeting.leaping import PART, kinetic, work
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.meeting.passing import PASSED, PLACED, SQUEEZED, passes, squeezed
from dolfinrod.scene.meeting.pressed import Pressed, load
from dolfinrod.scene.meeting.record import record
from dolfinrod.scene.meeting.slipping import Slip, slide
from dolfinrod.scene.meeting.spots import both, marks, points
from dolfinrod.scene.meeting.strands import Strands
from dolfinrod.scene.reply import SLIDES, STICKS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from dolfinrod.scene.rodcontact import RodContact

__all__ = ["Meeting"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]


class Meeting:
    """Rods that may touch one another and themselves.

    Each of two rods has points that look for the other, and each counts for half: so forces do not depend on which of
    them is named first.

    Args:
        contact: Which rods, and their laws.
        strands: Their centrelines.
        level: Where in a step forces act: 1 at its end, ½ in the middle.
        inert: Whether the rods have inertia: then what slid one way in an answer halts before it slides back.
        mine: Cells whose points are looked at here, shape (n_cells,); None: all.
        density: Mass per length of each rod in a motion [kg/m]; None: what a step wins is not asked for.

    Attributes:
        turns: Whether the rods feel each other's turns.
        changed: Whether other points touched, stuck or slid in the last answer than in the one before.
        forced: Whether any was kept from sliding back in it, which no equilibrium does.
        stale: Whether pairs of cells that may touch were looked for anew in it.
        steady: Whether derivatives leave out that normals turn, until the next `begin`.
    """

    def __init__(
        self,
        contact: RodContact,
        strands: Strands,
        level: float = 1.0,
        *,
        inert: bool = False,
        mine: Flags | None = None,
        density: Array | None = None,
    ) -> None:
        self.contact, self._level, self._inert, self._density = contact, level, inert, density
        self._spans = spans = Spans(strands)
        touching = np.isin(spans.rod, contact.among(len(strands.radius)))
        self._mine = touching if mine is None else touching & np.asarray(mine)[spans.cell]
        self._near = Neighbours(spans, contact.law.g_0, touching, self._mine)
        self.turns = contact.friction is not None and contact.friction.at == "surface"
        self._stiffness = anchoring(contact.friction, contact.law)
        self.changed = self.forced = self.stale = False
        self._marks_0: Array | None = None
        self._stored: float | None = None

    @property
    def pattern(self) -> bytes:
        """What touched, stuck and slid in the last answer."""
        return self._state.tobytes()

    @property
    def near(self) -> bool:
        """Whether any of them may touch until `stale`."""
        return len(self._near.a) > 0

    @property
    def pairs(self) -> Integers:
        """Pairs of cells that may touch until `stale`, shape (n, 2)."""
        cells = np.stack([self._spans.cell[self._near.a], self._spans.cell[self._near.b]], axis=1)
        return np.unique(cells, axis=0)

    def place(self, x: Array, t: float) -> None:
        """The rods are at x, shape (n_nodes, 3) [m]; nothing is remembered."""
        self._x_0, self._anchors = x.copy(), Anchors.none()
        self._course_0, self._stored = self._spans.course(x), None
        self._renew(x)
        self._state, self._t_0 = np.zeros((2, 0), dtype=np.intp), t
        self.begin(t)

    def _renew(self, *places: Array) -> None:
        self._near.renew(*places)
        self._renewed, self._marks_0 = True, None

    def _began(self) -> Array:
        """Intervals of contact at the start of the step."""
        if self._marks_0 is None:
            self._marks_0 = marks(self._course_0, self._near, self.contact.law)
        return self._marks_0

    def begin(self, t: float) -> None:
        """A step from where the rods were last accepted leads to time t."""
        self._law, self._ε_T, self._t, self.steady = self.contact.law, self._stiffness, t, False
        self._slid = np.zeros(0, dtype=np.intp), np.zeros((0, 3))

    def soften(self, by: float) -> None:
        """Let the law be softer by a factor until the next `begin`: on the way to what is pressed."""
        self._law, self._ε_T = self.contact.law.softened(by), self._stiffness / by

    def respond(self, x: Array, turn: Array) -> Felt:
        """What acts where the step has led.

        Args:
            x: Nodes at its end, shape (n_nodes, 3) [m].
            turn: Rotation vectors of the sections at the nodes over the step, in space, shape (n_nodes, 3) [rad].

        Returns:
            Forces and moments on all nodes, of the points looked at here.
        """
        self._x, self._n = x.copy(), len(x)
        self._pressed = pressed = self._led(x)
        self._key = keys(self._spans, pressed)
        self._slip = slip = self._slide(pressed, turn if self.turns else np.zeros_like(x))
        state = np.full(len(pressed.p), SLIDES) if slip is None else np.where(slip.rubbing.slides, SLIDES, STICKS)
        self.forced = slip is not None and slip.rubbing.forced
        found = np.stack([self._key, state])
        self.changed, self._state = self.forced or not np.array_equal(found, self._state), found
        lever = np.zeros((len(pressed.p), 0)) if slip is None or not self.turns else slip.ways.lever
        return Felt(*dealt(pressed.facing.nodes, pressed.facing.h, lever, *forces(pressed, slip), self._n))

    def _led(self, x: Array) -> Pressed:
        """Points under load."""
        near, mean = self._near, self._level < 1.0
        if not (near.holds(x) and (not mean or near.holds(self._x_0))):
            self._renew(*([self._x_0, x] if mean else [x]))
        self.stale, self._renewed = self._renewed, False
        self._course = course = self._spans.course(x)
        self._marks = found = marks(course, near, self.contact.law)
        rate = 1.0 / (self._t - self._t_0) if self._inert and self._t > self._t_0 else 0.0
        alone = not mean and self.contact.friction is None and self.contact.law.damping == 0.0
        courses = (course,) if alone else (course, self._course_0)
        spots = points(both(found, self._began()) if mean else found)
        return load(near, spots, self._law, courses, mean=mean, rate=rate)

    def _slide(self, pressed: Pressed, turn: Array) -> Slip | None:
        """How it slides, if anything rubs; what slid one way in the last answer is kept in mind."""
        friction = self.contact.friction
        if friction is None:
            return None
        at, known = matched(self._key, self._slid[0])
        slid = np.zeros((len(at), 3))
        slid[known] = self._slid[1][at[known]]
        anchors, moved = self._anchors.of(self._spans, pressed), self._x - self._x_0
        slip = slide(pressed, moved, turn, anchors, slid, friction, self._ε_T, self._law.g_0)
        slides = slip.rubbing.slides & self._inert
        self._slid = self._key[slides], slip.rubbing.u[slides]
        return slip

    def gradient(self) -> Coupling:
        """Derivatives of the last answer, the intervals of contact kept."""
        pressed, cell = self._pressed, self._spans.cell
        pressed = replace(pressed, p=np.zeros_like(pressed.p)) if self.steady else pressed
        first, pair = paired((cell[-1] + 1) * cell[pressed.a] + cell[pressed.b])
        limits = (0.0, 0.0) if self.contact.friction is None else (self.contact.friction.mu, self._ε_T)
        changes = derivatives(pressed, self._slip, limits, turns=self.turns)
        return Coupling(pressed.facing.nodes[first], pair, self._n, changes, self.turns)

    def pierces(self) -> str:
        """In words, how a rod has gone half-way into another in the step, or through it; empty: none has."""
        if squeezed(self._pressed):
            return PLACED if squeezed(self._pressed_0()) else SQUEEZED
        ways = self._course_0, self._course
        return PASSED if passes(*ways, *self._near.swept(*ways)) else ""

    def won(self) -> Array:
        """What contact has won in a step of backward Euler [J], and how many points leapt, of those looked at here."""
        if self._density is None or self._level < 1.0:
            return np.zeros(2)
        done, leaps = work(self._pressed, self._x - self._x_0)
        return np.array([self._in(self._pressed) - self._pressed_in() + done if leaps else 0.0, leaps])

    def leapt(self, won: Array) -> bool:
        """Whether rods leapt past each other in the step and won too much, `won` added up over all who look."""
        if self._density is None or not won[1] or won[0] <= 0.0:
            return False
        return bool(won[0] > PART * kinetic(self._course_0, self._course, self._density, self._t - self._t_0))

    def accept(self) -> tuple[float, float, float]:
        """The step counts; what is stored at its end, and what friction and damping took in it [J]."""
        rubbed, slip, pressed = self._anchors.energy(self._stiffness), self._slip, self._pressed
        self._x_0, self._course_0, self._marks_0, self._t_0 = self._x, self._course, self._marks, self._t
        # Points of a mean load are others than those of the load itself, with which a memory starts again.
        self._anchors, self._stored = Anchors.none(), self._in(pressed) if self._level == 1.0 else None
        if slip is not None:
            self._anchors = Anchors.left(self._spans, pressed, slip.rubbing.anchored)
            rubbed -= float(pressed.length @ dot(slip.traction, slip.ways.w))
        rubbed -= self._anchors.energy(self._stiffness)
        return self.stored(), rubbed, float(pressed.length @ pressed.damped)

    def _in(self, pressed: Pressed) -> float:
        """Energy in penetrations [J]."""
        return float(pressed.length @ self.contact.law.energy(pressed.gap, np.zeros(len(pressed.gap))))

    def stored(self) -> float:
        """Energy in penetrations and anchors at the start of the step [J]."""
        return self._pressed_in() + self._anchors.energy(self._stiffness)

    def _pressed_in(self) -> float:
        """The same in penetrations alone."""
        if self._stored is None:
            self._stored = self._in(self._pressed_0())
        return self._stored

    def _pressed_0(self) -> Pressed:
        """Points under load where the step began."""
        return load(self._near, points(self._began()), self.contact.law, (self._course_0,))

    def memory(self) -> dict[str, Array]:
        """All that is remembered, one row a point: what `recall` takes."""
        return self._anchors.memory()

    def recall(self, memory: Mapping[str, Array], x: Array, t: float) -> None:
        """Go back, or on, to what was remembered at time t with nodes at x; what is not looked at here is left out."""
        self.place(x, t)
        self._anchors = Anchors.remembered(self._spans, memory, self._mine)

    def met(self) -> Meetings:
        """The spots of the last answer."""
        pressed, none = self._pressed, np.zeros((len(self._pressed.p), 3))
        where = (1.0 - self._level) * self._x_0 + self._level * self._x
        traction = none if self._slip is None else self._slip.traction
        return record(self._spans, pressed, where, traction, self._state[1].astype(np.int8))
