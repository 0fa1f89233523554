"""Table 1 of the paper: twists of the yarns that both systems spun, as printed."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["INTERMEDIATE", "LATERAL", "NOMINAL", "Yarn"]

# Twist that the spinning frame was set to [turns/m], section 3 of the paper.
NOMINAL = 680.0


@dataclass(frozen=True)
class Yarn:
    """Twist of specimens of one yarn, measured by untwisting and retwisting 500 mm each (GB/T 2543.2-2001).

    Ten specimens of one bobbin: they tell how much a bobbin varies, not how much bobbins, spindles or days do.

    Args:
        system: How its fibres entered the groove.
        twist: Of each specimen, in the order printed [turns/m].
        average: As printed [turns/m].

    Source: Lyu, Cheng & Xu, CMES 127(2), 2021, DOI 10.32604/cmes.2021.015153, Table 1.
    """

    system: str
    twist: tuple[float, ...]
    average: float


LATERAL = Yarn("lateral", (643.0, 632.0, 633.0, 648.0, 645.0, 637.0, 632.0, 640.0, 645.0, 621.0), 637.6)
INTERMEDIATE = Yarn("intermediate", (572.0, 573.0, 578.0, 587.0, 571.0, 592.0, 575.0, 593.0, 586.0, 599.0), 582.6)
