"""Rods that touch one another and themselves, for all meetings of a scene together.

Where they touch and what they do to each other there is the scene's, `dolfinrod.scene.meeting`, in SI units and on
curves through the nodes; here it is made forces, moments and stiffness of nodes in units of the model.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.links import Links
from discrete.mass import densities
from discrete.touched import Booking
from discrete.unknowns import N_NODE, SPIN, X
from dolfinrod.scene import Dynamic
from dolfinrod.scene.meeting import PASSED, Meeting, Strands

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.turns import Turns
    from dolfinrod.meetings import Meetings
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Encounters"]

# Of the least radius, that rods which touch go in an iteration.
STRIDE = 0.5


class Encounters:
    """All meetings of a scene, and what they remember of the last state that counts.

    Args:
        scene: The problem.
        mesh: Its nodes.
        over: Turns of sections over a step.

    Attributes:
        rubs: Whether any knows friction.
        stirred: Whether other spots touched, or stuck, from one answer to the next since the last state that counts.
    """

    def __init__(self, scene: Scene, mesh: Mesh, over: Turns) -> None:
        self._mesh, self._units, self._over = mesh, mesh.units, over
        radius = np.array([np.nan if rod.section.radius is None else rod.section.radius for rod in scene.rods])
        strands, inert = Strands.smooth(mesh.s, radius), isinstance(scene.motion, Dynamic)
        density = densities([rod.section for rod in scene.rods])[0] if inert else None
        self._meetings = [Meeting(contact, strands, inert=inert, density=density) for contact in scene.meetings]
        self._among, self._radius = [contact.among(len(scene.rods)) for contact in scene.meetings], radius
        self._halo = max(0.0, *(contact.law.g_0 for contact in scene.meetings)) / mesh.units.length
        self._stiffest = max(contact.law.eps_N for contact in scene.meetings)
        self.rubs = any(meeting.turns for meeting in self._meetings)
        self.stirred = False
        self._seen: tuple[Array, Array] | None = None
        self._links: Links | None = None
        self._met: tuple[Meetings, ...] | None = None
        self._force = np.zeros((len(mesh.x), N_NODE))
        self._turn = np.zeros((len(mesh.x), 3))

    def recall(self, arrays: Mapping[str, Array], x: Array, R: Array, t: float) -> None:
        """Begin at, or go back to, a state, with what `memory` told of it among `arrays`; nothing where it did not."""
        place = self._in_space(x)
        for k, meeting in enumerate(self._meetings):
            meeting.place(place, t)
            own = {name: arrays.get(f"meeting{k}_{name}") for name in meeting.memory()}
            known = {name: values for name, values in own.items() if values is not None}
            if len(known) == len(own):
                meeting.recall(known, place, t)
        self._R_0, self.stirred = R, False
        self.begin(t)
        self.force(x, R)

    def memory(self) -> dict[str, Array]:
        """What is remembered of the last state that counts, in SI units, by the number of the meeting and a name."""
        meetings = enumerate(self._meetings)
        return {f"meeting{k}_{name}": one for k, meeting in meetings for name, one in meeting.memory().items()}

    def record(self) -> tuple[Meetings, ...]:
        """Where rods touch where `force` was asked for last, one record a meeting, SI units."""
        if self._met is None:
            self._met = tuple(meeting.met() for meeting in self._meetings)
        return self._met

    @property
    def stiffness(self) -> float:
        """That of the stiffest, in EI/L⁴."""
        return float(self._stiffest * self._units.length**4 / self._units.stiffness)

    def soften(self, by: float) -> None:
        """Let all rods be softer by a factor where they touch, until the next step begins."""
        self._seen = None
        for meeting in self._meetings:
            meeting.soften(by)

    def begin(self, t: float) -> None:
        """A step from the last state that counts leads to time t."""
        for meeting in self._meetings:
            meeting.begin(t)
        self._goal, self._seen = t, None

    def force(self, x: Array, R: Array) -> Array:
        """Forces and moments where the step has led; arguments and shape as for `Contacts.force`."""
        if self._answered(x, R):
            return self._force.copy()
        place, total = self._in_space(x), np.zeros_like(self._force)
        if self.rubs:
            self._turn = self._over.over(R, self._R_0)
        for meeting in self._meetings:
            felt = meeting.respond(place, self._turn)
            total[:, X] += felt.force
            total[:, SPIN] += felt.moment
        total[:, X] /= self._units.force
        total[:, SPIN] /= self._units.moment
        self.stirred = self.stirred or self.changed
        self._seen, self._force, self._links, self._met = (x, R), total, None, None
        return total.copy()

    def clearance(self, rod: int) -> float:
        """Distance over which a rod meets no other, or half of a radius where they are close; in units of the model.

        That is where `force` was asked for last, from nodes and half of the elements between them.
        """
        others = [among for among in self._among if rod in among and len(among) > 1]
        if not others or self._seen is None:
            return np.inf
        from scipy.spatial import cKDTree

        first, x = self._mesh.first, self._seen[0]
        mine, half = slice(first[rod], first[rod + 1]), 0.5 * float(self._mesh.elements.l.max())
        theirs = np.concatenate(
            [x[first[k] : first[k + 1]] for k in sorted({k for one in others for k in one} - {rod})]
        )
        nearest = float(cKDTree(theirs).query(x[mine])[0].min())
        radius = self._radius / self._units.length
        return max(nearest - 2.0 * half - 2.0 * float(np.nanmax(radius)) - self._halo, 0.5 * float(np.nanmin(radius)))

    def links(self) -> Links:
        """Resistance where `force` was asked for last."""
        if self._links is None:
            Θ = self._over.following(self._turn) if self.rubs else None
            couplings = [meeting.gradient() for meeting in self._meetings]
            self._links = Links([one for one in couplings if len(one.nodes)], self._units, Θ)
        return self._links

    def part(self, way: float) -> float:
        """Part of a way that rods may go in an iteration once they touch: where contact has just begun, it is a leap.

        Half of the least radius leaves normals what they are; a diameter leads past the rod that was touched. The next
        iteration after a leap leaves out that normals turn: forces far from balance, which turn with them, would push
        the rods anywhere.
        """
        stride = STRIDE * float(np.nanmin(self._radius)) / self._units.length if self.met else np.inf
        for meeting in self._meetings:
            meeting.steady = way > stride
        return min(1.0, stride / way) if way > 0.0 else 1.0

    @property
    def pattern(self) -> bytes:
        """What touched, stuck and slid in the last answer."""
        return b"".join(meeting.pattern for meeting in self._meetings)

    @property
    def changed(self) -> bool:
        """Whether the last answer was with other spots that touch, or stick, than the one before."""
        return any(meeting.changed for meeting in self._meetings)

    @property
    def forced(self) -> bool:
        """Whether the last answer kept any spot from sliding that cannot stick."""
        return any(meeting.forced for meeting in self._meetings)

    @property
    def met(self) -> bool:
        """Whether any rods pushed each other where `force` was asked for last."""
        return bool(self._force.any())

    @property
    def pierced(self) -> str:
        """What the step has led a rod through, half-way into, or past so far that contact wins energy; empty: nothing.

        Where centrelines meet normals point anywhere, and balance there is none that holds.
        """
        for meeting in self._meetings:
            if words := meeting.pierces() or (PASSED if meeting.leapt(meeting.won()) else ""):
                return words
        return ""

    def stored(self) -> float:
        """Energy in penetrations and anchors in the last state that counts, in EI/L."""
        return sum(meeting.stored() for meeting in self._meetings) / self._units.moment

    def accept(self, x: Array, R: Array, t: float) -> Booking:
        """The step to this state counts."""
        if t != self._goal or not self._answered(x, R):
            self.begin(t)
        self.force(x, R)
        booked = np.array([meeting.accept() for meeting in self._meetings]).sum(axis=0) / self._units.moment
        self._R_0, self.stirred = R, False
        return Booking(float(booked[0]), float(booked[1]), damped=float(booked[2]))

    def _answered(self, x: Array, R: Array) -> bool:
        """Whether `force` was asked for last there."""
        return self._seen is not None and np.array_equal(self._seen[0], x) and np.array_equal(self._seen[1], R)

    def _in_space(self, x: Array) -> Array:
        return x * self._units.length + self._mesh.origin
