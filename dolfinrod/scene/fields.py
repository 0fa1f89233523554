"""Fields of a scene file: how each is read from TOML and written back, digit for digit."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from difflib import get_close_matches
from inspect import Parameter, signature
from typing import Any, Protocol, TypeGuard

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.history import Steady
from dolfinrod.units import UnitError, has_unit, si

__all__ = ["At", "Field", "Growth", "Kind", "Modulus", "Plain", "Quantity", "Specific", "meant", "refuse_unknown"]

# No name of a field is longer.
MOST_CHARACTERS = 100


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
class Kind:
    """A table of a scene file and what it makes.

    Args:
        make: Constructor; its parameters without default are the fields that must be there.
        fields: Name of each field and how it is read.
    """

    make: Callable[..., Any]
    fields: Mapping[str, Field]

    def read(self, table: Any, path: str, **known: Any) -> Any:
        """The record a table describes.

        Args:
            table: What TOML holds.
            path: Where it stands.
            **known: Arguments of the constructor that stand elsewhere.

        Returns:
            What `make` made.

        Raises:
            SceneError: An unknown or missing field, or a value that cannot be.
        """
        return self.made(self.values(table, path, known), path)

    def values(self, table: Any, path: str, known: Mapping[str, Any]) -> dict[str, Any]:
        """Arguments for `make`, all there and each in SI."""
        if not isinstance(table, dict):
            raise SceneError(f"must be a table, got {table!r}", field=path)
        refuse_unknown(table, self.fields, path)
        parameters = signature(self.make).parameters.values()
        for name in (p.name for p in parameters if p.default is Parameter.empty):
            if name not in table and name not in known:
                raise SceneError("is missing", field=f"{path}.{name}")
        return {**known, **{name: self.fields[name].read(value, f"{path}.{name}") for name, value in table.items()}}

    def made(self, values: Mapping[str, Any], path: str) -> Any:
        """What `make` makes of its arguments; its complaints name the path."""
        try:
            return self.make(**values)
        except SceneError as error:
            raise error.within(path) from None

    def write(self, values: Mapping[str, Any], path: str) -> dict[str, Any]:
        """The table of these values; what is None is left out."""
        told = {name: value for name, value in values.items() if value is not None}
        return {name: self.fields[name].write(value, f"{path}.{name}") for name, value in told.items()}


def refuse_unknown(table: Mapping[str, Any], known: Collection[str], path: str) -> None:
    """Every key of a table is known."""
    for name in table:
        if name not in known:
            place = f"{path}.{name}" if name else f'{path}.""'
            message = f"is unknown; known are {', '.join(known)}{meant(name, known)}"
            raise SceneError(message, field=place.lstrip("."))


def meant(word: str, known: Iterable[str]) -> str:
    """A question that names the known word closest to one that is not; empty where none is close."""
    spelt = {name.lower(): name for name in known}
    close = get_close_matches(word[:MOST_CHARACTERS].lower(), spelt, n=1)
    return f"; did you mean {spelt[close[0]]}?" if close else ""


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
