"""A coil pulled and pushed by a wrench along its axis: a helix before and after, for any stiffness."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointForce, PointMoment, Rod, Scene, Section
from verification.case import Case
from verification.references import Coil, Reference

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Pose

__all__ = ["CASES", "coiled"]

# No two stiffnesses alike.
STRETCHING, BENDING = (900.0, 400.0, 300.0), (0.7, 1.0, 2.0)
# Curvature about d1, d2, d3 after loading: one turn and a half.
CURVATURE = (2.0, -1.0, 9.0)


def coiled(force: float, moment: float, *, shear: bool = True) -> Case:
    """Helical rod of unit length under the dead force and moment at its tip that leave it a helix.

    Args:
        force: Along the axis, positive pulls [EI₂/L²].
        moment: The part of the section moment along the axis [EI₂/L].
        shear: Whether the rod shears; otherwise as the discrete model poses it.

    Returns:
        The case.
    """
    stretching = STRETCHING if shear else (STRETCHING[0], np.inf, np.inf)
    coil = Coil(CURVATURE, force, moment, stretching, BENDING)
    section = Section(
        EA=STRETCHING[0], GA=STRETCHING[1:], GJ=BENDING[0], EI=BENDING[1:], rigid=set() if shear else {"shear"}
    )
    way, words = ("pulled" if force > 0.0 else "pushed"), ("Simo–Reissner" if shear else "unshearable")
    return Case(
        name=f"spring-{way}-{abs(force):g}" + ("" if shear else "-unshearable"),
        title=f"Coil {way} by {abs(force):g} EI₂/L², {words}",
        family="spring",
        scene=wrenched(coil, section),
        reference=deformed(coil, f"Coil(curvature={CURVATURE}, force={force:g}, moment={moment:g}, shear={shear})"),
        length=1.0,
        models=("continuum",) if shear else ("continuum", "discrete"),
        planar=False,
        centreline=coil.centreline,
    )


def wrenched(coil: Coil, section: Section) -> Callable[[Pose], Scene]:
    """The rod, stress free before the coil's loads came, and these at its tip."""
    pull, turn = coil.force * coil.axis, coil.rotation(1.0) @ coil.section_moment

    def scene(pose: Pose) -> Scene:
        rod = Rod.curved(
            length=1.0,
            section=section,
            curvature=tuple(coil.natural_curvature),
            start=pose.start(1.0),
            direction=pose.vector(1.0, 0.0),
            d2=pose.vector(0.0, 1.0),
        )
        return Scene(
            rods=[rod],
            supports=[Clamp(at="start")],
            loads=[PointForce(pose.vector(*pull), at="end"), PointMoment(pose.vector(*turn), at="end")],
        )

    return scene


def deformed(coil: Coil, name: str) -> Reference:
    """Where the tip of a coil is."""
    x, y, z = (float(c) for c in coil.centreline(np.ones(1))[0])
    return Reference(
        id=name,
        value=(x, y, z),
        method="closed form, from the deformed helix backwards; balance checked by differences (test)",
        source="verification/references/helix.py; Love 1927, section 270",
        digits_trusted=14,
        agreement=1e-15,
    )


CASES = tuple(coiled(f, m, shear=shear) for shear in (True, False) for f, m in ((20.0, -1.0), (-5.0, 1.0)))
