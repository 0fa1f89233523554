"""Scenarios as TOML files: every parameter as in Python, with its unit, and what it means beside it.

    kind = "lateral"
    fibres = 5
    t_end = "6 ms"

    [ends]
    tension = "0.1 mN"

    [core.fixed_core]
    radius = "80 um"

    [wall_friction.coulomb]
    mu = 0.64

What is left out has its default; "none" is no core, no air, no friction, or what a description says of None. Plain
numbers are SI. A law or a friction is written as in a scene file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from textwrap import wrap
from typing import Any

from dolfinrod.groove.parameters import meanings
from dolfinrod.groove.scenario import Scenario
from dolfinrod.groove.tables import Maybe, Measure, scenario_tables
from dolfinrod.scene import SceneError, source
from dolfinrod.scene.fields import Field, Quantity
from dolfinrod.scene.tables import Choice, Inner, Kind
from dolfinrod.scene.toml import parsed

__all__ = ["dumps", "load", "loads"]

HEAD = """\
# A groove scenario, for `dolfinrod groove FILE.toml`. Kind: {kind}; fibres: {fibres}.
# Where a value comes from: [P] the paper (Lyu, Cheng & Xu, CMES 127(2), 2021), [L] the literature, [C] computed from
# these, [I] our own assumption. What is left out has its default; "none" is None.
"""
WIDTH = 120


def load(path: str | Path) -> Scenario:
    """A scenario from a file.

    Args:
        path: Of a TOML file.

    Returns:
        The scenario.

    Raises:
        SceneError: Not TOML, or a field that is unknown or cannot be.
        OSError: The file cannot be read.
    """
    return loads(source.text(path))


def loads(text: str) -> Scenario:
    """A scenario from the text of a file; as `load`."""
    try:
        scenario: Scenario = scenario_tables().read(parsed(text), "")
        return scenario
    except RecursionError:
        raise SceneError("a scenario must not nest lists and tables so deeply") from None
    except SceneError as error:
        raise SceneError(error.message, field=error.field.lstrip(".")) from None


def dumps(scenario: Scenario) -> str:
    """The text of a file from which `loads` makes an equal scenario, with the meaning of every parameter.

    Args:
        scenario: Any.

    Returns:
        TOML; a part that is not there unless it is given, such as another section of the groove, is a comment.
    """
    head = HEAD.format(fibres=scenario.fibres, kind=scenario.kind)
    return "\n".join([head.rstrip(), *_lines(scenario_tables(), scenario, ""), ""])


def _lines(kind: Kind, record: Any, path: str) -> Iterator[str]:
    """The table of a record: what has no table of its own comes first."""
    words = meanings(type(record))
    tables: list[tuple[str, Field, Any, str]] = []
    for name, field in kind.fields.items():
        value, default = getattr(record, name), type(record).__dataclass_fields__[name].default
        if value is default is None and isinstance(field, Maybe) and isinstance(field.field, Inner):
            usual = record.section if name == "groove" else field.field.kind.make()
            tables.append((name, field, usual, "# "))
        elif value is None and not isinstance(field, Maybe):
            yield from ("", *_comment(f"{name}, left out: {words.get(name, '')}"))
        elif (written := _written(field, value)) is None or isinstance(written, dict):
            tables.append((name, field, value, ""))
        else:
            yield from ("", *_comment(words.get(name, "")), *_assigned(name, written))
    for name, field, value, mark in tables:
        yield from ("", *_comment(words.get(name, "")))
        lines = _table(field, value, path + name)
        yield from (line if line.startswith("#") or not line else mark + line for line in lines)


def _table(field: Field, value: Any, path: str) -> Iterator[str]:
    """A table with its head."""
    field = field.field if isinstance(field, Maybe) else field
    if isinstance(field, Choice):
        ((name, field),) = ((name, Inner(kind)) for name, kind in field.kinds.items() if kind.make is type(value))
        path = f"{path}.{name}"
    yield f"[{path}]"
    if isinstance(field, Inner):
        yield from _lines(field.kind, value, f"{path}.")
    else:
        yield from (line for name, told in field.write(value, path).items() for line in _assigned(name, told))


def _written(field: Field, value: Any) -> Any:
    """What TOML holds; None for a table, which is written line by line."""
    inner = field.field if isinstance(field, Maybe) else field
    if isinstance(inner, Inner | Choice) and value is not None:
        return None
    # A law of a scene file, whose fields know no everyday units.
    return Measure(inner.unit).write(value, "") if type(inner) is Quantity and value else field.write(value, "")


def _assigned(name: str, value: Any) -> list[str]:
    """The line that gives a field a value, lists within it."""
    import tomli_w

    text = re.sub(r"\[\n +", "[", tomli_w.dumps({name: value}).strip())
    return [re.sub(r",\n +", ", ", text.replace(",\n]", "]"))]


def _comment(words: str) -> list[str]:
    return [f"# {line}" for line in wrap(words, WIDTH - 2)]
