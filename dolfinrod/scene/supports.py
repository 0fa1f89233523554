"""What holds a rod."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.history import History, history
from dolfinrod.scene.quantity import Place, VectorLike, assign, entries, names, number, place, rod_index, vector

__all__ = ["Clamp", "Guide", "Pin", "Prescribed", "Support"]

TRANSLATIONS = ("x", "y", "z")
ROTATIONS = ("rx", "ry", "rz")
EVERY = (*TRANSLATIONS, *ROTATIONS)


@dataclass(frozen=True)
class Clamp:
    """Position and section frame held as they are stress free.

    Args:
        at: "start", "end" or arc length [m].
        rod: Number of the rod; None: every rod.
    """

    at: Place
    rod: int | None = None

    def __post_init__(self) -> None:
        assign(self, at=place(self.at, "Clamp.at"), rod=rod_index(self.rod, "Clamp.rod"))

    def held(self) -> frozenset[str]:
        """All six components."""
        return frozenset(EVERY)


@dataclass(frozen=True)
class Pin:
    """Position held, section frame free.

    Args:
        at: "start", "end" or arc length [m].
        rod: Number of the rod; None: every rod.
    """

    at: Place
    rod: int | None = None

    def __post_init__(self) -> None:
        assign(self, at=place(self.at, "Pin.at"), rod=rod_index(self.rod, "Pin.rod"))

    def held(self) -> frozenset[str]:
        """The three translations."""
        return frozenset(TRANSLATIONS)


@dataclass(frozen=True)
class Guide:
    """Held but for the named spatial components: displacement x, y, z and rotation vector rx, ry, rz.

    One free rotation is a hinge; two free rotations hold the remaining component of the rotation vector.

    Args:
        at: "start", "end" or arc length [m].
        free: What is free, out of "x", "y", "z", "rx", "ry", "rz".
        rod: Number of the rod; None: every rod.

    Raises:
        SceneError: An unknown component, or nothing held.
    """

    at: Place
    free: Iterable[str]
    rod: int | None = None

    def __post_init__(self) -> None:
        free = names(self.free, "Guide.free", EVERY)
        if len(free) == len(EVERY):
            raise SceneError("must leave something held, got all six components", field="Guide.free")
        assign(self, at=place(self.at, "Guide.at"), free=free, rod=rod_index(self.rod, "Guide.rod"))

    def held(self) -> frozenset[str]:
        """The components that are not free."""
        return frozenset(EVERY).difference(self.free)


@dataclass(frozen=True)
class Prescribed:
    """Displacement and rotation imposed, scaled by a history.

    Args:
        at: "start", "end" or arc length [m].
        displacement: Along x, y, z [m]; a component None is not prescribed, nor is any if all is None.
        rotation: Rotation vector in spatial axes, beyond 2π allowed [rad]; None: the section may rotate.
        history: How both grow; None: proportional, in a Dynamic motion too, up to its end.
        rod: Number of the rod; None: every rod.

    Raises:
        SceneError: Nothing is prescribed, or a number that is not finite.
    """

    at: Place
    displacement: Sequence[float | None] | VectorLike | None = None
    rotation: VectorLike | None = None
    history: History = None
    rod: int | None = None

    def __post_init__(self) -> None:
        u = None if self.displacement is None else _displacement(self.displacement)
        θ = None if self.rotation is None else vector(self.rotation, "Prescribed.rotation", "rad")
        if u is None and θ is None:
            raise SceneError("must have a displacement component or a rotation, got neither", field="Prescribed")
        assign(
            self,
            at=place(self.at, "Prescribed.at"),
            displacement=u,
            rotation=θ,
            history=history(self.history, "Prescribed.history"),
            rod=rod_index(self.rod, "Prescribed.rod"),
        )

    def held(self) -> frozenset[str]:
        """The prescribed components."""
        u = (None,) * 3 if self.displacement is None else self.displacement
        moved = {name for name, value in zip(TRANSLATIONS, u, strict=True) if value is not None}
        return frozenset(moved) if self.rotation is None else frozenset(moved).union(ROTATIONS)


Support = Clamp | Pin | Guide | Prescribed


def _displacement(value: object) -> tuple[float | None, ...] | None:
    """Three components, each a finite number or None; None where all are."""
    field = "Prescribed.displacement"
    components = enumerate(entries(value, field, "m", 3))
    u = tuple(None if c is None else number(c, f"{field}[{i}]", "m") for i, c in components)
    return None if u == (None,) * 3 else u
