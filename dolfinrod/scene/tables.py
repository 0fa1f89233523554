"""Tables of a scene file: which fields one may have, and what is made of them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any

from dolfinrod.scene.errors import SceneError

if TYPE_CHECKING:
    from dolfinrod.scene.fields import Field

__all__ = ["Kind", "meant", "refuse_unknown"]

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
