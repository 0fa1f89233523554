"""Tables of a scene file: which fields one may have, and what is made of them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any

from dolfinrod.scene.errors import SceneError

if TYPE_CHECKING:
    from dolfinrod.scene.fields import Field

__all__ = ["Choice", "Inner", "Kind", "meant", "refuse_unknown", "table_of"]

# No name of a field is longer.
MOST_CHARACTERS = 100


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
        refuse_unknown(table_of(table, path), self.fields, path)
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

    def told(self, record: object, path: str) -> dict[str, Any]:
        """The table of a record that has these fields."""
        return self.write({name: getattr(record, name) for name in self.fields}, path)


@dataclass(frozen=True)
class Inner:
    """A field that is a table itself.

    Args:
        kind: What it makes.
    """

    kind: Kind

    def read(self, value: Any, path: str) -> Any:
        """The record it describes."""
        return self.kind.read(value, path)

    def write(self, value: Any, path: str) -> dict[str, Any]:
        """The table of the record."""
        return self.kind.told(value, path)


@dataclass(frozen=True)
class Choice:
    """A table that names one of several kinds and holds its table; or a word for a record that is known.

    Args:
        kinds: Each by its name.
        words: What each makes.
    """

    kinds: Mapping[str, Kind]
    words: Mapping[str, Callable[[], Any]] = field(default_factory=dict)

    def read(self, value: Any, path: str) -> Any:
        """The record that is described."""
        if isinstance(value, str) and self.words:
            if value not in self.words:
                one_of = " or ".join(f'"{word}"' for word in self.words)
                must = f"must be {one_of}, or a table that names one of {', '.join(self.kinds)}"
                raise SceneError(f"{must}, got {value!r}{meant(value, self.words)}", field=path)
            return self.words[value]()
        kind, inner, path = self.chosen(value, path)
        return kind.read(inner, path)

    def write(self, value: Any, path: str) -> dict[str, Any]:
        """The table that names the kind of a record and holds its table."""
        ((name, kind),) = ((name, kind) for name, kind in self.kinds.items() if kind.make is type(value))
        return {name: kind.told(value, f"{path}.{name}")}

    def chosen(self, value: Any, path: str) -> tuple[Kind, Any, str]:
        """The one kind that is named, what its table holds, and the path of that."""
        table = table_of(value, path)
        refuse_unknown(table, self.kinds, path)
        if len(table) != 1:
            got = ", ".join(table) or "none"
            raise SceneError(f"must be one of {', '.join(self.kinds)}, got {got}", field=path)
        ((name, inner),) = table.items()
        return self.kinds[name], inner, f"{path}.{name}"


def table_of(value: Any, path: str) -> dict[str, Any]:
    """A table of TOML."""
    if not isinstance(value, dict):
        raise SceneError(f"must be a table, got {value!r}", field=path)
    return value


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
