"""A number and its provenance: critical loads and natural frequencies."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from verification.references.reference import Reference

__all__ = ["Scalar", "column_tip", "parameter", "scalar"]


@dataclass(frozen=True)
class Scalar:
    """A critical load or a frequency that neither model has computed.

    Args:
        id: Under which it is tabulated.
        value: In the units of the case.
        method: How it was found.
        source: Where the method or the number comes from.
        digits_trusted: Significant digits it is good for.
    """

    id: str
    value: float
    method: str
    source: str
    digits_trusted: int


@cache
def _table() -> dict[str, dict[str, Any]]:
    text = files("verification.references").joinpath("spectra.json").read_text(encoding="utf-8")
    found: dict[str, dict[str, Any]] = json.loads(text)
    return found


def scalar(name: str, quantity: str, *, power: int = 1, factor: float = 1.0, why: str = "") -> Scalar:
    """A tabulated quantity, or an exact function of it.

    Args:
        name: Id of the entry.
        quantity: Out of it.
        power: To which it is raised, as ω ∝ (βL)².
        factor: By which that is multiplied, as another wave speed.
        why: What power and factor are, for the record.

    Returns:
        factor · quantity^power.
    """
    entry = _table()[name]
    return Scalar(
        id=f"{name}: {quantity}",
        value=factor * float(entry["quantities"][quantity]) ** power,
        method="; ".join(filter(None, (entry["method"], why))),
        source=entry["source"],
        digits_trusted=entry["digits_trusted"],
    )


def column_tip(name: str) -> Reference:
    """Tip of a buckled column that stood along x, its foot at the origin, with the load it bears in its parameters."""
    entry = _table()[name]
    q = entry["quantities"]
    u, w = ("u", "w") if "u" in q else ("u_cf", "w_cf")
    x, y = (q["x"], q["y"]) if "x" in q else (1.0 - q[u], q[w])
    return Reference(
        id=name,
        value=(float(x), float(y), 0.0),
        method=entry["method"],
        source=entry["source"],
        digits_trusted=entry["digits_trusted"],
        agreement=10.0 ** -entry["digits_trusted"],
    )


def parameter(name: str, key: str) -> float:
    """A parameter of a tabulated entry."""
    return float(_table()[name]["quantities" if key in _table()[name]["quantities"] else "parameters"][key])
