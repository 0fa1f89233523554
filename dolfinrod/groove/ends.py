"""What holds the fibres at A and B: a nip, tension, or nothing where a staple fibre ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin

from dolfinrod.groove.bundle import Bundle
from dolfinrod.groove.limits import known, limited, whole
from dolfinrod.scene import (
    Clamp,
    Guide,
    PointForce,
    Prescribed,
    SceneError,
    Steady,
    Velocity,
)
from dolfinrod.scene.loads import Load
from dolfinrod.scene.quantity import Place, assign, listed
from dolfinrod.scene.supports import Support

__all__ = ["Ends"]

MOST_FIBRES = 200
TURNS = frozenset({"rx", "ry", "rz"})
# Of the x that the nip at B holds where nothing pulls the other way.
SIDEWAYS = TURNS | {"y", "z"}


@dataclass(frozen=True)
class Ends:
    """Nips at A, where fibres enter, and B, where they leave.

    At A a nip holds position and section, so that fibres neither turn nor twist there. At B they are drawn along X by a
    tension and may do all else: as long as neither end lets go or gives way, what winds one way must wind back the
    other way elsewhere, and no net twist leaves (false twist).

    Args:
        tension: Of a fibre at B, 0 to 0.1 N; 0.1 mN [I]: above 1 to 2 mN nothing gathers over a millimetre [C].
        exit: Of all fibres at B: "free" to move along y and z, or "held" there, which keeps the net winding as it is.
        speed: Of the fibres along X, and of the roller with them, 0 to 10 m/s: 0 while they gather [P: v = 0]; that of
            the machine is 0.1716 [C from P: 7000 r/min at 680 T/m].
        leading: Numbers of fibres whose leading end has not reached B yet: it is free, nothing draws it.
        trailing: Numbers of fibres whose trailing end has left A: it is free, and the nip at B holds the other along X,
            or draws it along at that speed.

    Raises:
        SceneError: A number out of its range, a fibre that is both.
    """

    tension: float = 1e-4
    exit: str = "free"
    speed: float = 0.0
    leading: Sequence[int] = ()
    trailing: Sequence[int] = ()

    def __post_init__(self) -> None:
        assign(
            self,
            tension=limited(self.tension, "Ends.tension", "N", 0.0, 0.1),
            exit=known(self.exit, "Ends.exit", ("free", "held")),
            speed=limited(self.speed, "Ends.speed", "m/s", 0.0, 10.0),
            **{name: _numbers(getattr(self, name), f"Ends.{name}") for name in ("leading", "trailing")},
        )
        if both := set(self.leading) & set(self.trailing):
            raise SceneError(f"must not name fibres that trail, got {sorted(both)}", field="Ends.leading")

    def check(self, fibres: int) -> None:
        """The fibres that are named exist.

        Raises:
            SceneError: They do not.
        """
        for name in ("leading", "trailing"):
            if beyond := [k for k in getattr(self, name) if k > fibres]:
                raise SceneError(f"must be numbers from 1 to {fibres}, got {beyond}", field=f"Ends.{name}")

    def supports(self, fibres: int, bundle: Bundle, t_end: float) -> tuple[Support, ...]:
        """What holds the fibres.

        Args:
            fibres: How many.
            bundle: These.
            t_end: Where the time ends [s].

        Returns:
            Supports, fibre by fibre.
        """
        found: list[Support] = []
        for rod in range(fibres):
            places: tuple[Place, ...] = ("start", bundle.tail) if bundle.tail else ("start",)
            found += [] if rod + 1 in self.trailing else [self._nip(at, rod, t_end) for at in places]
            found += self._out(rod, t_end)
        return tuple(found)

    def loads(self, fibres: int, angle: float = 0.0) -> tuple[Load, ...]:
        """The tension at B, full from the start, along the groove, which has gone around a roller by an angle [rad]."""
        drawn = [k for k in range(fibres) if k + 1 not in (*self.leading, *self.trailing)] if self.tension else []
        pull = (self.tension * cos(angle), -self.tension * sin(angle), 0.0)
        return tuple(PointForce(pull, at="end", rod=k, history=Steady()) for k in drawn)

    def velocities(self) -> tuple[Velocity, ...]:
        """How the fibres move at the start."""
        return (Velocity((self.speed, 0.0, 0.0)),) if self.speed else ()

    def _nip(self, at: Place, rod: int, t_end: float) -> Support:
        if not self.speed:
            return Clamp(at, rod)
        return Prescribed(at, (self.speed * t_end, 0.0, 0.0), (0.0, 0.0, 0.0), rod=rod)

    def _out(self, rod: int, t_end: float) -> list[Support]:
        free = set(TURNS if self.exit == "held" else SIDEWAYS)
        if rod + 1 in self.leading:
            return []
        if rod + 1 in self.trailing and not self.speed:
            return [Guide("end", free, rod)]
        drawn = (self.speed * t_end, None, None)
        found: list[Support] = [Prescribed("end", drawn, rod=rod)] if rod + 1 in self.trailing else []
        return [Guide("end", free | {"x"}, rod), *found] if self.exit == "held" else found


def _numbers(value: object, field: str) -> tuple[int, ...]:
    """Numbers of fibres, ascending, each once."""
    given = listed(value)
    if value not in ((), []) and not given:
        raise SceneError(f"must be numbers of fibres (1, 2, …), got {value!r}", field=field)
    return tuple(sorted({whole(k, f"{field}[{i}]", 1, MOST_FIBRES) for i, k in enumerate(given)}))
