"""The whole problem: rods, what holds them, what acts on them, how they move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from operator import itemgetter

from dolfinrod.scene.air import Air
from dolfinrod.scene.contact import Contact
from dolfinrod.scene.contacts import check_contacts
from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.loads import FollowerForce, FollowerMoment, Gravity, LineForce, Load, PointForce, PointMoment
from dolfinrod.scene.motion import Dynamic, Motion, Static
from dolfinrod.scene.quantity import Place, assign
from dolfinrod.scene.rod import Rod
from dolfinrod.scene.rodcontact import RodContact
from dolfinrod.scene.supports import Clamp, Guide, Pin, Prescribed, Support
from dolfinrod.scene.velocity import Velocity

__all__ = ["MOST_PARTS", "Scene"]

SUPPORTS = (Clamp, Pin, Guide, Prescribed)
POINT_LOADS = (PointForce, PointMoment, FollowerForce, FollowerMoment)
# Beyond these a scene can only be a slip of the pen, and checking it would take more than seconds.
MOST_PARTS = 10_000
MOST_PLACES = 1_000_000
# Arc lengths closer than this fraction of a rod are one place: text and sums leave round-off.
SAME_PLACE = 1e-9


@dataclass(frozen=True)
class Scene:
    """Everything that poses the mechanical problem; what is not listed does not act.

    Args:
        rods: At least one.
        supports: What holds them.
        loads: What acts on them.
        contacts: What they touch: surfaces, and one another.
        air: What flows past the rods; None: nothing.
        motion: How the scene moves on.
        velocities: How the rods move at the start of a Dynamic motion.

    Raises:
        SceneError: Parts that do not fit together, such as a load beyond the end of its rod.
    """

    rods: Sequence[Rod]
    supports: Sequence[Support] = ()
    loads: Sequence[Load] = ()
    contacts: Sequence[Contact | RodContact] = ()
    air: Air | None = None
    motion: Motion = field(default_factory=Static)
    velocities: Sequence[Velocity] = ()

    def __post_init__(self) -> None:
        for name in ("rods", "supports", "loads", "contacts", "velocities"):
            value = getattr(self, name)
            if not isinstance(value, (tuple, list)):
                raise SceneError(f"must be a tuple, got {quoted(value)}", field=name)
            if len(value) > MOST_PARTS:
                raise SceneError(f"must be at most {MOST_PARTS}, got {len(value)}", field=name)
            assign(self, **{name: tuple(value)})
        self._check_kinds()
        self._check_number_of_places()
        for name, parts in (("supports", self.supports), ("loads", self.loads)):
            for i, part in enumerate(parts):
                self._check_places(part, f"{name}[{i}]")
        self._check_density()
        self._check_motion()
        check_contacts(self)
        self._check_supports()

    @property
    def walls(self) -> tuple[Contact, ...]:
        """Contacts with surfaces, in the order of `contacts`; with them goes `Result.contacts`."""
        return tuple(contact for contact in self.contacts if isinstance(contact, Contact))

    @property
    def meetings(self) -> tuple[RodContact, ...]:
        """Contacts of rods with rods, in the order of `contacts`; with them goes `Result.meetings`."""
        return tuple(contact for contact in self.contacts if isinstance(contact, RodContact))

    def location(self, at: Place, rod: int | None) -> list[tuple[int, float]]:
        """Where a support or load sits.

        Args:
            at: "start", "end" or arc length [m].
            rod: Number of the rod; None: every rod.

        Returns:
            Pairs (number of the rod, arc length).
        """
        numbers = range(len(self.rods)) if rod is None else (rod,)
        known = {"start": lambda _: 0.0, "end": lambda k: self.rods[k].length}
        return [(k, known[at](k) if isinstance(at, str) else float(at)) for k in numbers]

    def marks(self, rod: int) -> tuple[float, ...]:
        """Arc lengths of a rod where a node must lie: supports, point loads and the ends of line loads.

        Args:
            rod: Number of the rod.

        Returns:
            Ascending arc lengths, those of one place listed once [m].
        """
        length = self.rods[rod].length
        pointed = [part for part in (*self.supports, *self.loads) if isinstance(part, (*SUPPORTS, *POINT_LOADS))]
        found = [s for part in pointed for k, s in self.location(part.at, part.rod) if k == rod]
        lines = [load for load in self.loads if isinstance(load, LineForce) and load.rod in (None, rod)]
        found += [s for line in lines for s in line.between or (0.0, length)]
        marks: list[float] = []
        for s in sorted(found):
            s = 0.0 if s <= SAME_PLACE * length else length if s >= length * (1 - SAME_PLACE) else s
            if not marks or s - marks[-1] > SAME_PLACE * length:
                marks.append(s)
        return tuple(marks)

    def may_touch(self, rod: int) -> bool:
        """Whether there is anything for a rod to touch, itself not counted: that cannot hold it."""
        others = (contact.among(len(self.rods)) for contact in self.meetings)
        return any(wall.rod in (None, rod) for wall in self.walls) or any(
            rod in among and len(among) > 1 for among in others
        )

    def _check_kinds(self) -> None:
        """Every entry is of the kind its place asks for."""
        kinds = {
            "rods": (Rod,),
            "supports": SUPPORTS,
            "loads": (*POINT_LOADS, LineForce, Gravity),
            "contacts": (Contact, RodContact),
            "velocities": (Velocity,),
        }
        for name, allowed in kinds.items():
            for i, part in enumerate(getattr(self, name)):
                if not isinstance(part, allowed):
                    known = ", ".join(kind.__name__ for kind in allowed)
                    raise SceneError(f"must be one of {known}, got {quoted(part)}", field=f"{name}[{i}]")
        if not self.rods:
            raise SceneError("must hold at least one rod, got none", field="rods")
        if not (self.air is None or isinstance(self.air, Air)):
            raise SceneError(f"must be Air or None, got {quoted(self.air)}", field="air")
        if not isinstance(self.motion, Static | Dynamic):
            raise SceneError(f"must be Static or Dynamic, got {quoted(self.motion)}", field="motion")

    def _check_places(self, part: Support | Load, path: str) -> None:
        """The rod exists and the place lies on it."""
        if isinstance(part, Gravity):
            return
        if part.rod is not None and part.rod >= len(self.rods):
            raise SceneError(f"must be below {len(self.rods)}, the number of rods, got {part.rod}", field=f"{path}.rod")
        if isinstance(part, LineForce):
            ends = [] if part.between is None else [("between[1]", part.between[1])]
        else:
            ends = [] if isinstance(part.at, str) else [("at", part.at)]
        for name, at in ends:
            for k, s in self.location(at, part.rod):
                length = self.rods[k].length
                if s > length * (1 + SAME_PLACE):
                    beyond = f"must lie on rod {k}, between 0 and {length} m, got {s} m"
                    raise SceneError(beyond, field=f"{path}.{name}")

    def _check_number_of_places(self) -> None:
        """Parts on every rod do not multiply beyond reason."""
        parts = [part for part in (*self.supports, *self.loads) if not isinstance(part, Gravity)]
        n = sum(len(self.rods) if part.rod is None else 1 for part in parts)
        if n > MOST_PLACES:
            raise SceneError(f"supports and loads must be at no more than {MOST_PLACES} places of all rods, got {n}")

    def _check_density(self) -> None:
        """Gravity finds a mass on every rod."""
        weights = [i for i, load in enumerate(self.loads) if isinstance(load, Gravity)]
        for k, rod in enumerate(self.rods):
            if weights and rod.section.rhoA is None:
                needed = f"must be given [kg/m], since loads[{weights[0]}] is Gravity, got None"
                raise SceneError(needed, field=f"rods[{k}].section.rhoA")

    def _check_motion(self) -> None:
        """What moves has a mass, what air drags a diameter, and what starts moving belongs to a motion in time."""
        moving = isinstance(self.motion, Dynamic)
        for i, velocity in enumerate(self.velocities):
            if not moving:
                raise SceneError("must be left out, since motion is Static", field=f"velocities[{i}]")
            if velocity.rod is not None and velocity.rod >= len(self.rods):
                below = f"must be below {len(self.rods)}, the number of rods, got {velocity.rod}"
                raise SceneError(below, field=f"velocities[{i}].rod")
        if self.air is not None and not moving:
            raise SceneError("must be left out, since motion is Static: air drags rods that are Dynamic", field="air")
        for k, rod in enumerate(self.rods):
            if moving and rod.section.rhoA is None:
                needed = "must be given [kg/m], since motion is Dynamic, got None"
                raise SceneError(needed, field=f"rods[{k}].section.rhoA")
            if self.air is not None and rod.section.radius is None:
                needed = "must be given [m], since air drags the rod, got None"
                raise SceneError(needed, field=f"rods[{k}].section.radius")

    def _check_supports(self) -> None:
        """No component is held twice at one place; prescribed motions compose."""
        at = sorted((k, s, i) for i, part in enumerate(self.supports) for k, s in self.location(part.at, part.rod))
        for k, on_rod in groupby(at, key=itemgetter(0)):
            close = SAME_PLACE * self.rods[k].length
            anchor, together = 0.0, list[tuple[int, float]]()
            for _, s, i in on_rod:
                if s - anchor > close:
                    self._check_together(together, k)
                    anchor, together = s, []
                together.append((i, s))
            self._check_together(together, k)

    def _check_together(self, together: list[tuple[int, float]], k: int) -> None:
        """Supports at one place, given by their numbers and arc lengths, share no component."""
        firm: dict[str, int] = {}
        every: dict[str, int] = {}
        for j, s in sorted(together):
            support = self.supports[j]
            prescribed = isinstance(support, Prescribed)
            earlier = firm if prescribed else every
            twice = sorted(support.held() & earlier.keys())
            if twice:
                i = earlier[twice[0]]
                held = f"must not hold {', '.join(twice)} again at s = {s} m of rod {k}: supports[{i}] does already"
                raise SceneError(held, field=f"supports[{j}]")
            every |= dict.fromkeys(support.held(), j)
            if not prescribed:
                firm |= dict.fromkeys(support.held(), j)
