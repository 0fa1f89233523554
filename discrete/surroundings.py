"""All that the rods of a scene touch: surfaces, and one another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.contact import Contacts
from discrete.meeting import Encounters
from discrete.touched import Booking, Touched
from discrete.turns import Turns
from dolfinrod.scene.piercing import PIERCED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.mesh import Mesh, Units
    from dolfinrod.meetings import Meetings
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Surroundings", "surroundings_of"]


class Surroundings:
    """Surfaces and other rods, either or both; methods of the same name and more words stand in `Contacts`.

    Args:
        scene: The problem.
        mesh: Its nodes.

    Attributes:
        walls: Contacts with surfaces; None: none.
        others: Contacts of rods with rods; None: none.
    """

    def __init__(self, scene: Scene, mesh: Mesh) -> None:
        self._mesh = mesh
        over = Turns()
        self.walls = Contacts(scene, mesh, over) if scene.walls else None
        self.others = Encounters(scene, mesh, over) if scene.meetings else None
        self._both: tuple[Contacts | Encounters, ...] = tuple(
            one for one in (self.walls, self.others) if one is not None
        )

    def recall(self, arrays: Mapping[str, Array], x: Array, R: Array, t: float) -> None:
        """Begin at, or go back to, a state, with what `memory` told of it among `arrays`."""
        for one in self._both:
            one.recall(arrays, x, R, t)

    def memory(self) -> dict[str, Array]:
        """What is remembered of the last state that counts, in SI units."""
        return {name: values for one in self._both for name, values in one.memory().items()}

    def record(self) -> Array | None:
        """What all points feel of surfaces where `force` was asked for last; None where there are none."""
        return None if self.walls is None else self.walls.record()

    def meetings(self) -> tuple[Meetings, ...]:
        """Where rods touch one another there, one record a meeting of the scene."""
        return () if self.others is None else self.others.record()

    @property
    def stiffness(self) -> float:
        """That of the stiffest, in EI/L⁴."""
        return max(one.stiffness for one in self._both)

    def soften(self, by: float) -> None:
        """Let all be softer by a factor, until the next step begins."""
        for one in self._both:
            one.soften(by)

    def begin(self, t: float) -> None:
        """A step from the last state that counts leads to time t."""
        for one in self._both:
            one.begin(t)

    def cling(self) -> None:
        """Begin the iteration with what touched and stuck to surfaces in the last state that counts."""
        if self.walls is not None:
            self.walls.cling()

    def glide(self) -> None:
        """Begin it with what slid on surfaces in the last state that counts sliding on."""
        if self.walls is not None:
            self.walls.glide()

    @property
    def units(self) -> Units:
        """Of the model."""
        return self._mesh.units

    @property
    def renews(self) -> bool:
        """Whether any law has multipliers."""
        return self.walls is not None and self.walls.renews

    def part(self, way: float) -> float:
        """Part of a way in units of the model that rods which touch one another may go in an iteration."""
        return 1.0 if self.others is None else self.others.part(way)

    @property
    def sets(self) -> bytes:
        """What touches, sticks and slides, surfaces and rods."""
        return self.pattern + (b"" if self.others is None else self.others.pattern)

    def foresee(self, x: Array) -> bool:
        """Whether a linear step to x changes what is pressed to surfaces."""
        return self.walls is not None and self.walls.foresee(x)

    def force(self, x: Array, R: Array) -> Array:
        """Forces and moments where the step has led, shape (n_nodes, 7)."""
        first, *more = (one.force(x, R) for one in self._both)
        return first if not more else first + more[0]

    def at(self, x: Array, R: Array, t: float | None) -> Array:
        """`force` with the walls where they are at time t; None: at that of the last `begin`."""
        if t is not None:
            self.begin(t)
        return self.force(x, R)

    def clearance(self, rod: int) -> float:
        """Distance over which a rod meets nothing that acts on it; infinite where there is nothing."""
        return min(one.clearance(rod) for one in self._both)

    def reach(self, x: Array) -> float:
        """Largest coordinate of a node, as far as round-off of its gap goes, in units of the model."""
        return float(np.abs(x).max() + np.abs(self._mesh.origin).max() / self._mesh.units.length)

    def blocks(self) -> Touched:
        """Resistance where `force` was asked for last."""
        if self.others is None:
            assert self.walls is not None
            return self.walls.blocks()
        links = self.others.links()
        nodes, blocks = links.nodal
        firm = Touched(nodes[:0], blocks[:0]) if self.walls is None else self.walls.blocks()
        every = np.union1d(nodes, firm.nodes)
        total = np.zeros((len(every), 6, 6))
        total[np.searchsorted(every, nodes)] = blocks
        total[np.searchsorted(every, firm.nodes)] += firm.blocks
        return Touched(every, total, links, firm)

    def answers(self) -> Touched:
        """The same to be asked for changes only: no blocks of single nodes are worked out for rods that touch rods."""
        assert self.others is not None
        none = np.zeros(0, dtype=np.int64), np.zeros((0, 6, 6))
        firm = None if self.walls is None else self.walls.blocks()
        return Touched(*none, self.others.links(), firm)

    @property
    def pattern(self) -> bytes:
        """Which nodes touch surfaces, and which of these stick."""
        return b"" if self.walls is None else self.walls.pattern

    @property
    def met(self) -> bool:
        """Whether any node touched a surface in the last state that counts, or rods touch one another."""
        return any(one.met for one in self._both)

    @property
    def changed(self) -> bool:
        """Whether other nodes touch than in the last state that counts, or other spots of rods do on the way."""
        return (self.walls is not None and self.walls.changed) or (self.others is not None and self.others.stirred)

    @property
    def settled(self) -> bool:
        """Whether rods touched and stuck to one another in the last answer where they did in the one before."""
        return self.others is None or not self.others.changed

    @property
    def rubbing(self) -> bool:
        """Whether anything touches that friction turns."""
        rubs = self.others is not None and self.others.rubs and self.others.met
        return rubs or (self.walls is not None and self.walls.rubbing)

    def renew(self) -> bool:
        """Renew the multipliers; whether all penetrations are within their tolerances already."""
        return self.walls is None or self.walls.renew()

    @property
    def forced(self) -> bool:
        """Whether the last answer kept anything from sliding that cannot stick."""
        return any(one.forced for one in self._both)

    @property
    def pierced(self) -> str:
        """What the step has led a rod through, in words; empty: nothing."""
        if self.walls is not None and self.walls.pierced:
            return PIERCED
        return "" if self.others is None else self.others.pierced

    def stored(self) -> float:
        """Energy in penetrations and anchors in the last state that counts, in EI/L."""
        return sum(one.stored() for one in self._both)

    def accept(self, x: Array, R: Array, t: float) -> Booking:
        """The step to this state counts."""
        booked = [one.accept(x, R, t) for one in self._both]
        each = ((b.stored, b.rubbed, b.pushed, b.damped) for b in booked)
        return Booking(*(sum(values) for values in zip(*each, strict=True)))


def surroundings_of(scene: Scene, mesh: Mesh) -> Surroundings | None:
    """What the rods of a scene may touch; None where that is nothing."""
    return Surroundings(scene, mesh) if scene.contacts else None
