"""A reference value and its provenance."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from verification.references.elastica import cantilever_tip

__all__ = ["Reference", "Vector", "cantilever", "tabulated"]

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Reference:
    """A tip position that neither model has computed.

    Args:
        id: Under which it is tabulated, or what computes it.
        value: x, y, z in the axes of the problem [m].
        method: How it was found.
        source: Where the method or the number comes from.
        digits_trusted: Significant digits it is good for.
        agreement: Difference of two independent computations of it [m].
    """

    id: str
    value: Vector
    method: str
    source: str
    digits_trusted: int
    agreement: float


@cache
def table() -> dict[str, dict[str, Any]]:
    """The tabulated references by id: problem, parameters, quantities, provenance."""
    text = files("verification.references").joinpath("tabulated.json").read_text(encoding="utf-8")
    found: dict[str, dict[str, Any]] = json.loads(text)
    return found


def tabulated(name: str, *, at: float | None = None, shift: Vector = (0.0, 0.0, 0.0), why: str = "") -> Reference:
    """Tip of a tabulated solution, moved by an exact shift.

    Args:
        name: Its id.
        at: Load factor, of a solution tabulated along its path.
        shift: Added to it [m].
        why: What the shift is, for the record.

    Returns:
        The reference.
    """
    entry = table()[name]
    return Reference(
        id=name if at is None else f"{name}@{at}",
        value=added(_tip(entry["quantities"], at), shift),
        method="; ".join(filter(None, (entry["method"], why))),
        source=entry["source"],
        digits_trusted=entry["digits_trusted"],
        agreement=entry["agreement"],
    )


def _tip(quantities: dict[str, float], at: float | None) -> Vector:
    """The tip among tabulated quantities: x, y and z, or displacements of a rod that lay on x ∈ [0, 1]."""
    q = quantities
    if at is not None:
        return q[f"x@{at}"], q[f"y@{at}"], q[f"uz@{at}"]
    return (1.0 - q["u"], q["w"], 0.0) if "u" in q else (q["x"], q["y"], q.get("z", 0.0))


def cantilever(alpha: float, *, EA: float, GA: float) -> Reference:
    """Tip of the planar Simo–Reissner cantilever by quadrature, for parameters that are not tabulated.

    Args:
        alpha: Load P L²/EI.
        EA: Axial stiffness [EI/L²]; infinite where inextensible.
        GA: Shear stiffness [EI/L²]; infinite where unshearable.

    Returns:
        The reference.
    """
    x, y = cantilever_tip(alpha, EA=EA, GA=GA)
    return Reference(
        id=f"cantilever_tip(alpha={alpha:g}, EA={EA:.6g}, GA={GA:.6g})",
        value=(x, y, 0.0),
        method="Gauss quadrature of the exact first integral; agrees with the tabulated A1 and A2 to 5e-14 (test)",
        source="verification/references/elastica.py, from Reissner 1972",
        digits_trusted=12,
        agreement=5e-14,
    )


def added(a: Iterable[float], b: Iterable[float]) -> Vector:
    """Sum of two vectors."""
    x, y, z = (p + q for p, q in zip(a, b, strict=True))
    return x, y, z
