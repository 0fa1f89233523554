"""The list of all parameters of a groove scenario, for a terminal."""

from __future__ import annotations

from dataclasses import is_dataclass
from textwrap import wrap
from typing import Any

from dolfinrod.groove.parameters import Parameter, parameters
from dolfinrod.groove.sweep import SHORT
from dolfinrod.groove.tables import NONE, Measure
from dolfinrod.scene import Section

__all__ = ["listing"]

HEAD = ("name", "default", "unit", "range", "source")
WIDTH = 120
LEGEND = (
    "Source of a default: P the paper (Lyu, Cheng & Xu, CMES 127(2), 2021), L the literature, C computed from these,",
    "I our own assumption, to be varied. A file has these names with their units, --sweep takes either.",
)


def listing() -> str:
    """Name, default, unit, range and source of every parameter, and what it is.

    Returns:
        Lines.
    """
    several = parameters()
    table = [_row(parameter) for parameter in several]
    widths = [max(len(row[k]) for row in (HEAD, *table)) for k in range(len(HEAD))]
    lines = [_line(HEAD, widths)]
    for row, parameter in zip(table, several, strict=True):
        lines += [_line(row, widths), *(f"    {line}" for line in wrap(parameter.words, WIDTH - 4))]
    short = ", ".join(f"{name} = {full}" for name, full in SHORT.items())
    return "\n".join([*lines, "", *LEGEND, f"Short names: {short}."])


def _row(parameter: Parameter) -> tuple[str, ...]:
    return parameter.name, _told(parameter), parameter.unit, parameter.range, parameter.source


def _told(parameter: Parameter) -> str:
    """Its default, as in a file."""
    value: Any = parameter.default
    if value is None:
        return NONE
    if isinstance(value, Section):
        return "ramie"
    if is_dataclass(value):
        return type(value).__name__
    if parameter.unit and isinstance(value, float):
        return str(Measure(parameter.unit.replace("²", "**2")).write(value, parameter.name))
    return str(value).lower() if isinstance(value, bool) else str(value)


def _line(cells: tuple[str, ...], widths: list[int]) -> str:
    return "  ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True)).rstrip()
