"""Parameters of a scenario as a list: name, default, unit, range, source and meaning of each.

Nothing is told twice: meaning and source are those of the docstrings, unit and range those that the records name when
they refuse a value.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from inspect import getdoc
from math import nan
from types import UnionType
from typing import Any, get_args, get_type_hints

from dolfinrod.groove.scenario import Scenario
from dolfinrod.scene import SceneError, Section

__all__ = ["Parameter", "meanings", "members", "parameters", "unit_of"]

PACKAGE = "dolfinrod.groove"
# What the paper does not give and nobody else has measured.
ASSUMED = "I"
# What no field takes that has a range.
IMPOSSIBLE = (-1e300, 1e300)
# Forms of a rule, and how a list has it.
RANGES = (
    (r"lie between (\S+) and (\S+)(?: .+)?", r"\1 to \2"),
    (r"be a whole number from (\S+) to (\S+)", r"\1 to \2"),
    (r"be one of (.+)", r"\1"),
    (r"be positive", "above 0"),
    (r"not be negative", "from 0 on"),
    (r"be (.+)", r"\1"),
)
# Marks of a source, such as [P, Fig. 7] or [I; L: drums show some], and units, such as [N/m²].
MARKS = re.compile(r"\[([PLCI]\b[^]]*)\]")
UNIT = re.compile(r"\[(?![PLCI]\b)([^]\s]+)\]")


@dataclass(frozen=True)
class Parameter:
    """One parameter.

    Args:
        name: As `varied` takes it: "seed", "ends.tension".
        owner: Class of the record that holds it.
        default: Its value.
        unit: Of numbers; empty where they have none.
        range: What it may be; empty where any number may stand.
        source: Where the default comes from: P the paper, L the literature, C computed from these, I our assumption.
        words: What it is.
    """

    name: str
    owner: type
    default: Any
    unit: str
    range: str
    source: str
    words: str


def parameters(scenario: Scenario | None = None) -> tuple[Parameter, ...]:
    """All parameters.

    Args:
        scenario: Whose values are told as defaults; None: those of the class.

    Returns:
        In the order of the record; of a part that may be one of several, such as the core, those of each.
    """
    return tuple(_listed(Scenario() if scenario is None else scenario, "", ASSUMED))


def meanings(owner: type) -> dict[str, str]:
    """What the docstring of a record says of each of its fields.

    Args:
        owner: A dataclass.

    Returns:
        Text by name, in one line each; fields that are not described are left out.
    """
    found = re.search(r"^Args:\n(.*?)(?=^\S|\Z)", getdoc(owner) or "", re.DOTALL | re.MULTILINE)
    entries = re.split(r"^ {4}(\w+): ", found.group(1) if found else "", flags=re.MULTILINE)[1:]
    return {name: " ".join(text.split()) for name, text in zip(entries[::2], entries[1::2], strict=True)}


def members(owner: type, name: str) -> tuple[Any, ...]:
    """Types that a field of a record may have."""
    hint = get_type_hints(owner)[name]
    return get_args(hint) if isinstance(hint, UnionType) else (hint,)


def unit_of(record: Any, name: str) -> str:
    """Unit of a field that holds numbers; empty where it has none.

    Args:
        record: That holds it.
        name: Of the field.

    Returns:
        Such as "m" or "N/m²".
    """
    said = re.search(r"\[(.+)\]", _rule(record, name, nan)) or UNIT.search(meanings(type(record)).get(name, ""))
    return said.group(1) if said else ""


def _listed(record: Any, path: str, source: str) -> Iterator[Parameter]:
    """Parameters of a record, and of those within it; without marks of their own they are from the source of it."""
    owner = type(record)
    words = meanings(owner)
    for name in (field.name for field in fields(owner)):
        kinds = [kind for kind in members(owner, name) if is_dataclass(kind) and kind is not Section]
        value, marked = getattr(record, name), _source(words.get(name, ""))
        yield Parameter(
            name=path + name,
            owner=owner,
            default=value,
            unit=unit_of(record, name),
            range=_range(record, name, kinds),
            source=marked or source,
            words=words.get(name, ""),
        )
        for inner in _parts(record, name, value, kinds):
            ours = type(inner).__module__.startswith(PACKAGE)
            yield from _listed(inner, f"{path}{name}.", ASSUMED if ours else marked or source)


def _parts(record: Any, name: str, value: Any, kinds: list[Any]) -> list[Any]:
    """Records that may stand in a field: the one that does, and those that are made without asking."""
    if name == "groove" and value is None:
        value = record.section
    present = [value] if is_dataclass(value) and not isinstance(value, Section) else []
    # Laws have no defaults: they are known by the one that stands there.
    return present + [kind() for kind in kinds if type(value) is not kind and kind.__module__.startswith(PACKAGE)]


def _source(words: str) -> str:
    """The marks in a description, each once."""
    letters = [letter for mark in MARKS.findall(words) for letter in re.findall(r"\b[PLCI]\b", mark)]
    return ", ".join(dict.fromkeys(letters))


def _range(record: Any, name: str, kinds: list[Any]) -> str:
    """What a field may be, in the words in which anything else is refused."""
    if kinds:
        none = ["none"] if type(None) in members(type(record), name) else []
        return ", ".join([kind.__name__ for kind in kinds] + none)
    if bool in members(type(record), name):
        return "true, false"
    rules = (_rule(record, name, value) for value in IMPOSSIBLE)
    said = next((rule for rule in rules if rule), "")
    return next((re.sub(form, told, said) for form, told in RANGES if re.fullmatch(form, said)), said)


def _rule(record: Any, name: str, value: object) -> str:
    """What is said of a value that is refused; empty where it is taken."""
    try:
        replace(record, **{name: value})
    except SceneError as error:
        return error.message.removeprefix("must ").partition(", got")[0]
    return ""
