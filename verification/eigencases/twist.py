"""Rods that buckle because they are twisted: between pins and between clamps, compressed or pulled, and as a ring."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Guide, Pin, PointForce, PointMoment, Prescribed, Rod, Scene, Section, Static
from verification.eigencase import Eigencase, Path
from verification.eigencases.columns import KIRCHHOFF
from verification.references.scalar import scalar

if TYPE_CHECKING:
    from dolfinrod.scene import Load

__all__ = ["CASES", "ring", "twisted"]

FIRST, THEN = ((0.0, 0.0), (1.0, 1.0)), ((1.0, 0.0), (2.0, 1.0))
COMPRESSIONS = (0, 5, -20)
AROUND = 2.0 * np.pi


def twisted(P: int, *, clamped: bool) -> Eigencase:
    """Compressed by P EI/L² until t = 1, then twisted by a moment about the axis until t = 2.

    Args:
        P: 0, 5 or −20 (tension).
        clamped: Between clamps of which one slides and turns about the axis; otherwise between position pins, the
            moment dead at both ends (Greenhill 1883).

    Returns:
        The case.
    """

    def scene(M: float) -> Scene:
        free = {"x", "rx"} if clamped else {"x", "rx", "ry", "rz"}
        loads: list[Load] = [PointForce((-P, 0.0, 0.0), at="end", history=FIRST)] if P else []
        loads.append(PointMoment((M, 0.0, 0.0), at="end", history=THEN))
        if not clamped:
            loads.append(PointMoment((-M, 0.0, 0.0), at="start", history=THEN))
        return Scene(
            rods=[Rod.straight(length=1.0, section=KIRCHHOFF)],
            supports=[Clamp(at="start") if clamped else Pin(at="start"), Guide(at="end", free=free)],
            loads=loads,
            motion=Static(t_end=2.0),
        )

    ends = "clamped" if clamped else "pinned"
    return Eigencase(
        name=f"twist-{ends}-{P}",
        title=f"Twist of a rod, {ends}, compressed by {P} EI/L²",
        family="twist",
        quantity="M L/EI",
        scene=scene,
        analysis=Path(since=1.0),
        reference=scalar(f"G12-P{P}", f"M_{ends}"),
        multiplicity=2,
        # Dead moments about an axis that the ends leave have no potential: an even number of lost directions, as of
        # a round section, leaves the sign of the determinant as it was.
        brackets=clamped,
    )


def ring(GJ: float) -> Eigencase:
    """Michell's ring of radius 1, bent from a straight rod until t = 1, its ends then twisted against each other.

    The end follows the circle all the way, x(t) + i y(t) = L ∫₀¹ exp(2πi t u) du, so that no force acts. A section
    opposite to the seam is held in the plane: a round ring turns freely about the tangent of its seam while its
    sections turn against it.

    Args:
        GJ: 1 or 0.75 [EI].

    Returns:
        The case.
    """
    return Eigencase(
        name=f"ring-{GJ:g}",
        title=f"Michell's ring, GJ = {GJ:g} EI",
        family="twist",
        quantity="total twist, rad",
        scene=partial(closed, GJ),
        analysis=Path(since=1.0),
        reference=scalar(f"G3-ring-GJ{GJ}", "Tw_cr_total_rad"),
        multiplicity=2,
        models=("continuum", "discrete"),
        finer=1.5,
    )


def closed(GJ: float, twist: float) -> Scene:
    """The scene of `ring` for a given twist of its ends [rad]."""
    # Stretch is no part of the critical twist; without it, the straight rod between clamps is indeterminate.
    rod = Rod.straight(length=AROUND, section=Section(EA=1e6, GJ=GJ, EI=1.0, rigid={"shear"}))
    return Scene(
        rods=[rod],
        supports=[
            Prescribed(at="start", displacement=(0.0, 0.0, 0.0), rotation=(twist, 0.0, 0.0), history=THEN),
            Prescribed(at="end", rotation=(0.0, 0.0, AROUND), history=FIRST),
            Prescribed(at="end", displacement=(AROUND, None, None), history=closing_along),
            Prescribed(at="end", displacement=(None, AROUND, None), history=closing_across),
            Prescribed(at="end", displacement=(None, None, 0.0)),
            Prescribed(at=0.5 * AROUND, displacement=(None, None, 0.0)),
        ],
        motion=Static(t_end=2.0),
    )


def closing_along(t: float) -> float:
    """How far the end has come along x, in lengths: sin α/α − 1 with α = 2πt, −1 once the ring is closed."""
    return float(np.sinc(2.0 * min(t, 1.0)) - 1.0)


def closing_across(t: float) -> float:
    """The same along y: (1 − cos α)/α."""
    return float(np.pi * min(t, 1.0) * np.sinc(min(t, 1.0)) ** 2)


CASES = (*(twisted(P, clamped=c) for P in COMPRESSIONS for c in (False, True)), ring(1.0), ring(0.75))
