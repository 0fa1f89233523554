"""Contact with rigid surfaces at the nodes, Eq. 27 and 28: force per length times half of the elements at a node.

What a surface does to a point is the scene's, `dolfinrod.scene.Touch`, in SI units; here it is made forces, moments and
stiffness of nodes in units of the model, for all contacts of a scene together.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.pair import Pair
from discrete.touched import Booking, Touched
from discrete.unknowns import N_NODE, SPIN, X
from dolfinrod.scene import AugmentedLagrangian, Touch

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.turns import Turns
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Contacts"]


class Contacts:
    """All contacts of a scene, and what they remember of the last state that counts.

    Args:
        scene: The problem.
        mesh: Its nodes.
        over: Turns of sections over a step.

    Attributes:
        renews: Whether any law has multipliers.
        pairs: One a contact, with the nodes that it concerns.
    """

    def __init__(self, scene: Scene, mesh: Mesh, over: Turns) -> None:
        self._mesh, self._units, self._over = mesh, mesh.units, over
        share = mesh.share * mesh.units.length
        radius = np.repeat([rod.section.radius or 0.0 for rod in scene.rods], np.diff(mesh.first))
        self.pairs: list[Pair] = []
        self._seen: tuple[Array, Array] | None = None
        self._touched: Touched | None = None
        self._force: Array
        for contact in scene.walls:
            a, b = (0, len(mesh.s)) if contact.rod is None else (contact.rod, contact.rod + 1)
            mine = slice(int(mesh.first[a]), int(mesh.first[b]))
            touch = Touch(contact, radius[mine], scene.motion)
            self.pairs.append(Pair(contact, mine, share[mine], touch))
        self.renews = any(isinstance(contact.law, AugmentedLagrangian) for contact in scene.walls)
        self._rubs = any(pair.rubs for pair in self.pairs)

    def recall(self, arrays: Mapping[str, Array], x: Array, R: Array, t: float) -> None:
        """Begin at, or go back to, a state, with what `memory` told of it among `arrays`; nothing where it did not."""
        for k, pair in enumerate(self.pairs):
            pair.touch.place(self.in_space(x)[pair.mine], t)
            own = {name: f"contact{k}_{name}" for name in pair.touch.memory()}
            if all(key in arrays for key in own.values()):
                pair.touch.recall({name: arrays[key] for name, key in own.items()}, t)
        self._R_0 = R
        self.begin(t)
        self.force(x, R)
        self._pattern = self.pattern

    def memory(self) -> dict[str, Array]:
        """What is remembered of the last state that counts, in SI units, by the number of the contact and a name."""
        pairs = enumerate(self.pairs)
        return {f"contact{k}_{name}": one for k, pair in pairs for name, one in pair.touch.memory().items()}

    def record(self) -> Array:
        """What all points of all contacts feel where `force` was asked for last, one after the other.

        Returns:
            Gap, pressure, normal, traction, slip so far and state of each, SI units, shape (n_points, 10).
        """
        tables = [np.empty((len(pair.share), 10)) for pair in self.pairs]
        for pair, rows in zip(self.pairs, tables, strict=True):
            reply = pair.reply
            rows[:, 0], rows[:, 1], rows[:, 8], rows[:, 9] = reply.gap, reply.pressure, pair.touch.slip, reply.state
            rows[:, 2:5], rows[:, 5:8] = reply.normal, reply.traction
        return np.concatenate(tables)

    def _answered(self, x: Array, R: Array) -> bool:
        """Whether `force` was asked for last there: an iteration that stays does not count as one that goes on."""
        return self._seen is not None and np.array_equal(self._seen[0], x) and np.array_equal(self._seen[1], R)

    @property
    def stiffness(self) -> float:
        """That of the stiffest surface, in EI/L⁴."""
        stiffest = max(pair.contact.law.eps_N for pair in self.pairs)
        return float(stiffest * self._units.length**4 / self._units.stiffness)

    def soften(self, by: float) -> None:
        """Let all surfaces be softer by a factor, until the next step begins."""
        self._seen = None
        for pair in self.pairs:
            pair.touch.soften(by)

    def begin(self, t: float) -> None:
        """A step from the last state that counts leads to time t."""
        for pair in self.pairs:
            pair.touch.begin(t)
        self._goal, self._seen = t, None

    def cling(self) -> None:
        """Begin the iteration with what touched and stuck in the last state that counts."""
        for pair in self.pairs:
            pair.touch.cling()

    def glide(self) -> None:
        """Begin it with what slid in the last state that counts sliding on."""
        for pair in self.pairs:
            pair.touch.glide()

    def foresee(self, x: Array) -> bool:
        """Whether a linear step to x changes what is pressed; the next answer is with that."""
        each = [pair.touch.foresee(self.in_space(x)[pair.mine]) for pair in self.pairs]
        if not any(each):
            return False
        self._seen = None
        for pair in self.pairs:
            pair.touch.adopt()
        return True

    def force(self, x: Array, R: Array) -> Array:
        """Forces and moments where the step has led.

        Args:
            x: Positions, shape (n_nodes, 3).
            R: Section frames, shape (n_nodes, 3, 3).

        Returns:
            The place of F_n empty, shape (n_nodes, 7).
        """
        if self._answered(x, R):
            return self._force.copy()
        total, place = np.zeros((len(x), N_NODE)), self.in_space(x)
        self._turns = self._over.over(R, self._R_0) if self._rubs else np.zeros_like(place)
        for pair in self.pairs:
            reply = pair.respond(place, self._turns)
            on = np.flatnonzero(reply.state)
            nodes, share = on + pair.mine.start, pair.share[on, None]
            total[nodes, X] += share / self._units.force * reply.force[on]
            if pair.rubs:
                total[nodes, SPIN] += share / self._units.moment * reply.moment[on]
        self._seen, self._force, self._touched = (x, R), total, None
        return total.copy()

    def at(self, x: Array, R: Array, t: float | None) -> Array:
        """`force` with the walls where they are at time t; None: at that of the last `begin`."""
        if t is not None:
            self.begin(t)
        return self.force(x, R)

    def clearance(self, rod: int) -> float:
        """Least distance of a rod from where a surface acts on it, in units of the model; infinite without one.

        That is where `force` was asked for last.
        """
        first, clear = self._mesh.first, np.inf
        for pair in self.pairs:
            a, b = (max(0, int(node) - pair.mine.start) for node in first[rod : rod + 2])
            clear = min(clear, float((pair.reply.gap - pair.contact.law.g_0)[a:b].min(initial=np.inf)))
        return clear / self._units.length

    def reach(self, x: Array) -> float:
        """Largest coordinate of a node, as far as round-off of its gap goes, in units of the model."""
        return float(np.abs(x).max() + np.abs(self._mesh.origin).max() / self._units.length)

    def blocks(self) -> Touched:
        """Resistance where `force` was asked for last."""
        if self._touched is None:
            n = len(self._mesh.x)
            total, touched = np.zeros((n, 6, 6)), np.zeros(n, dtype=bool)
            Θ = self._over.following(self._turns) if self._rubs else None
            for pair in self.pairs:
                touched[pair.resist(total, Θ, self._units)] = True
            nodes = np.flatnonzero(touched)
            self._touched = Touched(nodes, total[nodes])
        return self._touched

    @property
    def pattern(self) -> bytes:
        """Which nodes touch, and which of these stick."""
        return b"".join(pair.reply.state.tobytes() for pair in self.pairs)

    @property
    def met(self) -> bool:
        """Whether any node touched in the last state that counts."""
        return any(self._pattern)

    @property
    def changed(self) -> bool:
        """Whether that is another one than in the last state that counts."""
        return self.pattern != self._pattern

    @property
    def rubbing(self) -> bool:
        """Whether any node touches that friction turns."""
        return any(pair.rubs and bool(pair.reply.state.any()) for pair in self.pairs)

    def renew(self) -> bool:
        """Renew the multipliers; whether all penetrations are within their tolerances already."""
        done = [pair.touch.renew() for pair in self.pairs]
        self._seen = self._seen if all(done) else None
        return all(done)

    @property
    def forced(self) -> bool:
        """Whether the last answer kept any node from sliding that cannot stick."""
        return any(pair.touch.forced for pair in self.pairs)

    @property
    def pierced(self) -> bool:
        """Whether the step has led a rod into or through a wall."""
        return any(pair.touch.pierces() for pair in self.pairs)

    def stored(self) -> float:
        """Energy in penetrations and anchors in the last state that counts, in EI/L."""
        return sum(float(pair.share @ pair.touch.stored()) for pair in self.pairs) / self._units.moment

    def accept(self, x: Array, R: Array, t: float) -> Booking:
        """The step to this state counts."""
        if t != self._goal or not self._answered(x, R):
            self.begin(t)
        self.force(x, R)
        sums = np.zeros(4)
        for pair in self.pairs:
            booked = pair.touch.accept()
            sums += [float(pair.share @ part) for part in (booked.stored, booked.rubbed, booked.pushed, booked.damped)]
        self._R_0, self._pattern = R, self.pattern
        return Booking(*(sums / self._units.moment).tolist())

    def in_space(self, x: Array) -> Array:
        """Positions in SI units, shape (n_nodes, 3)."""
        return x * self._units.length + self._mesh.origin
