"""Fields of a scene file: how each is read from TOML and written back, digit for digit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Protocol, TypeGuard

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.history import Steady
from dolfinrod.scene.motion import ImplicitEuler, Midpoint
from dolfinrod.scene.tables import meant
from dolfinrod.units import UnitError, has_unit, si

__all__ = ["SPEED", "At", "Field", "Flow", "Growth", "Modulus", "Plain", "Quantity", "Scheme", "Specific"]

SCHEMES: dict[str, type[ImplicitEuler | Midpoint]] = {"implicit_euler": ImplicitEuler, "midpoint": Midpoint}


class Field(Protocol):
    """One value of a table."""

    def read(self, value: Any, path: str) -> Any:
        """What the constructor takes, from what TOML holds at `path`."""

    def write(self, value: Any, path: str) -> Any:
        """What TOML holds, from what the record holds."""


@dataclass(frozen=True)
class Plain:
    """Numbers without unit, words, and lists of them, as they stand; the constructor judges them."""

    def read(self, value: Any, path: str) -> Any:
        """The value itself."""
        return value

    def write(self, value: Any, path: str) -> Any:
        """The value, sets sorted into lists."""
        if isinstance(value, frozenset):
            return sorted(value)
        return list(value) if isinstance(value, tuple) else value


@dataclass(frozen=True)
class Quantity:
    """A number with a unit, or a list of any depth of them; plain numbers are SI.

    Args:
        unit: Canonical SI unit.
        word: What stands for an entry that is None, if entries may be.
    """

    unit: str
    word: str | None = None

    def read(self, value: Any, path: str) -> Any:
        """Magnitudes in the canonical unit."""
        if isinstance(value, list):
            return tuple(self.read(entry, f"{path}[{i}]") for i, entry in enumerate(value))
        if self.word is not None and value == self.word:
            return None
        if _is_number(value):
            return value
        with _readable(path):
            return si(value, self.unit)

    def write(self, value: Any, path: str) -> Any:
        """Text with the shortest digits that give the same double back."""
        if isinstance(value, Iterable):
            return [self.write(entry, path) for entry in value]
        return self.word if value is None else f"{value!r} {self.unit}"


@dataclass(frozen=True)
class Specific:
    """A modulus per density [m²/s²], still to be multiplied with the density."""

    value: float


@dataclass(frozen=True)
class Modulus:
    """A modulus [Pa], or a modulus per density as textile tables give it [N/tex]."""

    def read(self, value: Any, path: str) -> float | Specific:
        """Pascals, or `Specific` where the unit says so."""
        if _is_number(value):
            return value
        with _readable(path):
            if has_unit(value, "N/tex"):
                return Specific(si(value, "m**2/s**2"))
            return si(value, "Pa")

    def write(self, value: Any, path: str) -> str:
        """Pascals."""
        return Quantity("Pa").write(value, path)


METRE = Quantity("m")


@dataclass(frozen=True)
class At:
    """A place on a rod: "start", "end" or an arc length."""

    def read(self, value: Any, path: str) -> Any:
        """The word, or metres."""
        if value in ("start", "end"):
            return value
        try:
            return METRE.read(value, path)
        except SceneError:
            raise SceneError(f'must be "start", "end" or a length, got {value!r}', field=path) from None

    def write(self, value: Any, path: str) -> str:
        """The word, or metres."""
        return value if isinstance(value, str) else Quantity("m").write(value, path)


@dataclass(frozen=True)
class Growth:
    """A history: "steady" or rows [t, factor]."""

    def read(self, value: Any, path: str) -> Any:
        """`Steady()` or the rows."""
        if value == "steady":
            return Steady()
        if not isinstance(value, list):
            raise SceneError(f'must be "steady" or rows [t, factor], got {value!r}', field=path)
        return value

    def write(self, value: Any, path: str) -> Any:
        """The word or the rows."""
        if callable(value):
            raise SceneError(f"must be a table to be written to a file, got the function {value!r}", field=path)
        return "steady" if isinstance(value, Steady) else [list(row) for row in value]


@dataclass(frozen=True)
class Scheme:
    """How time is stepped: "implicit_euler" or "midpoint"."""

    def read(self, value: Any, path: str) -> ImplicitEuler | Midpoint:
        """The scheme of that name."""
        if not isinstance(value, str) or value not in SCHEMES:
            close = meant(value, SCHEMES) if isinstance(value, str) else ""
            one_of = " or ".join(f'"{name}"' for name in SCHEMES)
            raise SceneError(f"must be {one_of}, got {value!r}{close}", field=path)
        return SCHEMES[value]()

    def write(self, value: Any, path: str) -> str:
        """Its name."""
        (name,) = (name for name, kind in SCHEMES.items() if type(value) is kind)
        return name


SPEED = Quantity("m/s")


@dataclass(frozen=True)
class Flow:
    """A velocity that is the same everywhere; one that is a function of place cannot stand in a file."""

    def read(self, value: Any, path: str) -> Any:
        """Its components in metres per second."""
        return SPEED.read(value, path)

    def write(self, value: Any, path: str) -> Any:
        """Its components."""
        if callable(value):
            raise SceneError(f"must be a vector to be written to a file, got the function {value!r}", field=path)
        return SPEED.write(value, path)


def _is_number(value: Any) -> TypeGuard[float]:
    """Whether TOML holds a plain number: SI already, and the constructor judges its size."""
    return isinstance(value, int | float) and not isinstance(value, bool)


@contextmanager
def _readable(path: str) -> Iterator[None]:
    """What a text says is a quantity; complaints name the path."""
    try:
        yield
    except UnitError as error:
        raise SceneError(str(error), field=path) from None
