"""What rods on walls should come to, with provenance: tabulated in contact.json, or by a closed form.

Entries that begin with L are of `shared/reference` (first integrals, shooting, Hetényi's beams; no finite elements).
Others are problems of `contactposed` against walls that push back in proportion, solved by `contactrod`;
`python -m verification.contacts` solves them anew.
"""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import Any

from scipy.optimize import brentq

from verification.references.contactposed import POSED, quantities
from verification.references.moving import Moving

__all__ = ["edges", "solved_anew", "touching", "value", "wound_evenly"]

METHOD = "collocation in pieces that end where contact does (contactrod.py), repeated on finer ones"
SOURCE = "verification/references/contactposed.py"


def touching(name: str, *chosen: str) -> Moving:
    """Tabulated quantities of a rod on a wall.

    Args:
        name: Id of the entry.
        chosen: Quantities out of it, in the order in which the case reads them.

    Returns:
        The reference.
    """
    entry = _table()[name]
    return Moving(
        id=name,
        value=tuple(value(name, quantity) for quantity in chosen),
        method=entry["method"],
        source=entry["source"],
        digits_trusted=entry["digits_trusted"],
    )


def value(name: str, quantity: str) -> float:
    """A single quantity or parameter of a tabulated entry."""
    entry = _table()[name]
    return float({**entry.get("parameters", {}), **entry["quantities"]}[quantity])


def edges(name: str) -> tuple[float, ...]:
    """Where contact begins or ends along a tabulated rod [m]."""
    found = _table()[name]["quantities"]
    return tuple(float(found[key]) for key in sorted(found) if key.startswith("edge"))


def wound_evenly(pull: float, EI: float, eps_N: float, radius: float, g_0: float = 0.0) -> tuple[float, float, float]:
    """Tension, line load and gap where a rod lies evenly on a cylinder, far from where it leaves it.

    With δ = g_0 − g and ρ = radius + g the tension is ε_N δ ρ, and T + EI/2ρ² − ε_N δ²/2 is what it is at the ends of
    the rod, F: no friction takes any of it.

    Args:
        pull: F [N].
        EI: Bending stiffness [N m²].
        eps_N: ε_N [N/m²].
        radius: Distance of the axis of the rod from that of the cylinder where they touch [m].
        g_0: Gap where contact begins [m].

    Returns:
        T, p and g.
    """

    def over(δ: float) -> float:
        ρ = radius + g_0 - δ
        return eps_N * δ * ρ + 0.5 * EI / ρ**2 - 0.5 * eps_N * δ**2 - pull

    δ = brentq(over, 0.0, 0.1 * radius, xtol=1e-20, rtol=1e-15)
    return eps_N * δ * (radius + g_0 - δ), eps_N * δ, g_0 - δ


def solved_anew() -> dict[str, dict[str, Any]]:
    """Entries of all problems of `contactposed`, as the file keeps them."""
    found = {}
    for name, posed in POSED.items():
        fine, coarse = (quantities(posed.solved(finer=finer)) for finer in (True, False))
        agreement = max(abs(fine[key] - coarse[key]) / max(1.0, abs(fine[key])) for key in fine)
        found[name] = {
            "problem": posed.words,
            "quantities": fine,
            "method": METHOD,
            "source": SOURCE,
            "digits_trusted": 15 if agreement < 1e-15 else int(f"{agreement:e}"[-2:]),
            "agreement": float(f"{agreement:.1e}"),
        }
    return found


@cache
def _table() -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = json.loads(
        files("verification.references").joinpath("contact.json").read_text("utf-8")
    )
    return found
