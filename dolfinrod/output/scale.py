"""Units with the prefix that makes numbers short: micrometres for fibres, metres for bridges."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, log10

__all__ = ["Scale", "scale"]

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}


@dataclass(frozen=True)
class Scale:
    """A unit to draw in.

    Args:
        unit: Its name with the prefix, such as "mm".
        factor: What a value in SI is multiplied with.
    """

    unit: str
    factor: float


def scale(largest: float, unit: str) -> Scale:
    """The prefix with which the largest value lies between 0.1 and 100.

    Args:
        largest: Largest magnitude to draw, in SI.
        unit: SI unit: m, N, N m or J. Lengths are not given in kilometres.

    Returns:
        The unit to draw in; the plain one where all is zero.
    """
    most = 0 if unit == "m" else max(PREFIXES)
    exponent = 3 * floor((log10(largest) + 1.0 + 1e-9) / 3) if largest > 0.0 else 0
    exponent = min(max(exponent, min(PREFIXES)), most)
    return Scale(PREFIXES[exponent] + unit, 10.0**-exponent)
