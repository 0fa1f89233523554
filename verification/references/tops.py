"""Where rigid tops point and how they spin at given times, with provenance."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

__all__ = ["TopReference", "top_reference"]

Quantities = dict[str, float]


@dataclass(frozen=True)
class TopReference:
    """A motion that no integrator of ours has computed.

    Args:
        id: Under which it is tabulated.
        J: Inertia about the body axes through the centre of mass [kg m²].
        w: Angular velocity at the start, body axes [rad/s].
        states: Time [s] → quantity → value.
        digits_trusted: Significant digits they are good for.
        method: How they were found.
        source: Where the problem comes from.
    """

    id: str
    J: tuple[float, float, float]
    w: tuple[float, float, float]
    states: dict[float, Quantities]
    digits_trusted: int
    method: str
    source: str


@cache
def table() -> dict[str, dict[str, Any]]:
    """The tabulated motions by id: problem, parameters, quantities, provenance."""
    text = files("verification.references").joinpath("tops.json").read_text(encoding="utf-8")
    found: dict[str, dict[str, Any]] = json.loads(text)
    return found


def top_reference(name: str) -> TopReference:
    """A tabulated motion.

    Args:
        name: Its id.

    Returns:
        The reference; the inertia of the heavy top is that of its problem, about the centre of mass.
    """
    entry = table()[name]
    states: dict[float, Quantities] = {}
    for key, value in entry["quantities"].items():
        quantity, _, time = key.partition("@")
        states.setdefault(float(time), {})[quantity] = value
    parameters = entry["parameters"]
    a, b, c = parameters["J"]
    u, v, w = parameters["w0"]
    return TopReference(name, (a, b, c), (u, v, w), states, entry["digits_trusted"], entry["method"], entry["source"])
