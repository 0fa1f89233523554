"""What rods on rods should come to that takes minutes or more than a formula: kept in meetings.json.

`python -m verification.meetings` solves them anew.
"""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import Any

from verification.references.crossing import Crossing, Strand
from verification.references.crossinglines import crossed
from verification.references.crossingshot import shot
from verification.references.moving import Moving

__all__ = ["CROSSINGS", "meeting", "solved_anew"]

FIBRE = Strand(1e-2, 10.762699, 2.690683e-10, 1e-4, 0.0)
EVEN = Strand(1.0, 1e5, 1.0, 50.0, -0.1)
# Two fibres of the paper under 0.1 mN, ends level; rods whose ends are drawn past each other, like and unlike.
CROSSINGS = {
    "fibres": Crossing((FIBRE, FIBRE), 4e5, 2e-5, 1e-6),
    "even": Crossing((EVEN, EVEN), 1e8, 0.02),
    "uneven": Crossing((EVEN, Strand(1.2, 1e5, 2.0, 100.0, -0.08)), 1e8, 0.02),
}
METHOD = "collocation in pieces that end with the lenses (crossinglines.py); by shooting with SciPy's DOP853 as well"
SOURCE = "verification/references/crossing.py"


def meeting(name: str, *chosen: str) -> Moving:
    """Tabulated quantities of a crossing.

    Args:
        name: Out of `CROSSINGS`.
        chosen: Quantities, in the order in which the case reads them.

    Returns:
        The reference.
    """
    entry = _table()[name]
    return Moving(
        id=f"crossing-{name}",
        value=tuple(float(entry["quantities"][quantity]) for quantity in chosen),
        method=entry["method"],
        source=entry["source"],
        digits_trusted=entry["digits_trusted"],
    )


def solved_anew() -> dict[str, dict[str, Any]]:
    """Entries of all crossings, as the file keeps them."""
    found: dict[str, dict[str, Any]] = {}
    for name, posed in CROSSINGS.items():
        one, other = crossed(posed), shot(posed)
        same = (*one.heights, one.force)
        agreement = max(abs(a - b) / abs(a) for a, b in zip(same, other, strict=True))
        quantities = {
            **{f"lift{k}": lift for k, lift in enumerate(one.lifts)},
            **{f"height{k}": height for k, height in enumerate(one.heights)},
            **{f"lens{k}": lens for k, lens in enumerate(one.lens)},
            **{f"end{k}": end for k, end in enumerate(one.ends)},
            "distance": one.distance,
            "force": one.force,
        }
        found[name] = {
            "problem": repr(posed),
            "quantities": {key: float(f"{number:.13e}") for key, number in quantities.items()},
            "method": METHOD,
            "source": SOURCE,
            "digits_trusted": 10,
            "agreement": float(f"{agreement:.1e}"),
        }
    return found


@cache
def _table() -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = json.loads(
        files("verification.references").joinpath("meetings.json").read_text("utf-8")
    )
    return found
