"""A scenario as tables of a file: each field by its type, with the unit in which its record counts."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, fields, is_dataclass
from math import degrees, isfinite, radians
from typing import Any, get_args

from dolfinrod.groove.air import LineSink
from dolfinrod.groove.parameters import members, unit_of
from dolfinrod.groove.scenario import Scenario
from dolfinrod.scene import Coulomb, Penalty, Section
from dolfinrod.scene.fields import Field, Plain, Quantity
from dolfinrod.scene.kinds import CONTACT, TOUCHED
from dolfinrod.scene.sectiontables import read_section, section_table
from dolfinrod.scene.tables import Choice, Inner, Kind
from dolfinrod.units import si

__all__ = ["NONE", "Maybe", "Measure", "scenario_tables"]

NONE = "none"
# What a scenario settles by itself.
SETTLED = ((LineSink, "bottom"),)
# Units in which numbers are read at a glance, and how many of each are the SI unit.
EVERYDAY = {
    "m": {"mm": 1e3, "um": 1e6},
    "s": {"ms": 1e3, "us": 1e6},
    "N": {"mN": 1e3, "uN": 1e6},
    "N/m": {"mN/m": 1e3},
    "rad": {"deg": degrees(1.0)},
}
# Numbers that need no power of ten, and the digits that measures have in such units, if any.
LEAST, MOST, DIGITS = 0.01, 1e6, 9


@dataclass(frozen=True)
class Measure(Quantity):
    """A quantity that is written as a person would: in the unit in which it is shortest, to the last digit."""

    def read(self, value: Any, path: str) -> Any:
        """Magnitudes in the canonical unit; degrees are those of `math.radians`."""
        angle = super().read(value, path)
        if self.unit == "rad" and isinstance(value, str) and "rad" not in value:
            return radians(si(value, "deg"))
        return angle

    def write(self, value: Any, path: str) -> Any:
        """Text that gives the same double back; what is not finite has no unit."""
        if isinstance(value, Iterable):
            return [self.write(entry, path) for entry in value]
        if not isfinite(value):
            return float(value)
        counts = {unit: value * many for unit, many in (EVERYDAY.get(self.unit, {}) | {self.unit: 1.0}).items()}
        texts = [f"{n:.{DIGITS}g} {unit}" for unit, n in counts.items() if n == 0.0 or LEAST <= abs(n) < MOST]
        exact = [text for text in texts if self.read(text, path) == value]
        return min(exact, key=len) if exact else f"{value!r} {self.unit}"


@dataclass(frozen=True)
class Maybe:
    """A field that may be none.

    Args:
        field: How it is read if it is there.
    """

    field: Field

    def read(self, value: Any, path: str) -> Any:
        """None for the word."""
        return None if value == NONE else self.field.read(value, path)

    def write(self, value: Any, path: str) -> Any:
        """The word for None."""
        return NONE if value is None else self.field.write(value, path)


@dataclass(frozen=True)
class Fibre:
    """The section of a fibre: "ramie", a shape with its material, or stiffnesses."""

    def read(self, value: Any, path: str) -> Section:
        """The section."""
        return Section.ramie() if value == "ramie" else read_section(value, path)

    def write(self, value: Any, path: str) -> Any:
        """The word, or the table of its stiffnesses."""
        return "ramie" if value == Section.ramie() else section_table(value, path)


def scenario_tables() -> Kind:
    """How a scenario is read and written.

    Returns:
        The table of a scenario, with those within it.
    """
    return _kind(Scenario)


def _kind(owner: type) -> Kind:
    """Of a record that is made without asking."""
    record = owner()
    names = (field.name for field in fields(owner) if (owner, field.name) not in SETTLED)
    return Kind(owner, {name: _field(record, name) for name in names})


def _field(record: Any, name: str) -> Field:
    """How one of its fields is read."""
    kinds = members(type(record), name)
    field = _records(kinds) if any(is_dataclass(kind) for kind in kinds) else _numbers(record, name, kinds)
    return Maybe(field) if type(None) in kinds else field


def _records(kinds: tuple[Any, ...]) -> Field:
    """A section, a law or friction as in scene files; a table; or one of several, by the names of their classes."""
    for kind, field in (
        (Section, Fibre()),
        (Penalty, TOUCHED.kinds["rods"].fields["law"]),
        (Coulomb, CONTACT.fields["friction"]),
    ):
        if kind in kinds:
            return field
    ours = [kind for kind in kinds if isinstance(kind, type) and is_dataclass(kind)]
    named = {re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__).lower(): _kind(kind) for kind in ours}
    return Choice(named) if len(named) > 1 else Inner(*named.values())


def _numbers(record: Any, name: str, kinds: tuple[Any, ...]) -> Field:
    """Quantities where floats have a unit, and what stands for itself."""
    unit = unit_of(record, name).replace("²", "**2") if float in {*kinds, *get_args(kinds[0])} else ""
    return Measure(unit) if unit else Plain()
