"""The scenario of the paper as printed, in each reading of what it leaves open."""

from __future__ import annotations

from dolfinrod.groove.bundle import Bundle
from dolfinrod.groove.core import FixedCore
from dolfinrod.groove.limits import known
from dolfinrod.groove.scenario import Scenario
from dolfinrod.scene import CreepingCoulomb, Penalty

__all__ = ["MESHES", "READINGS", "as_printed"]

# c = 2e4 and ε₀ = 7.5e-5 are printed without units: [N/m²] and [m].
READINGS = {
    "SI": Penalty(2e4, 7.5e-5),
    "mm_mN": Penalty(2e7, 7.5e-8),
    "mm_N": Penalty(2e10, 7.5e-8),
}
# 200 elements of 0.5 mm are 100 mm, but the zone is 40 mm: fibre length before A [m].
MESHES = {"long": 0.06, "zone": 0.0}
# Friction against the speed of a node has no direction at rest; below this speed it fades [m/s]. Our assumption.
FADES = 1e-3
# Distance of neighbours, a diameter and a quarter [m]: farther apart the edge fibre would begin in the lip.
BESIDE = 25e-6
ELEMENTS = 200
MU = 0.64


def as_printed(reading: str, mesh: str, kind: str) -> Scenario:
    """What sections 2.3.1 to 2.3.3 of the paper print, with nothing added that they do not name.

    One coefficient of friction, against the velocity of the centreline in space and without a moment; fibres that touch
    walls and the central cylinder, not one another; no noise; no air, since no equation has any. The middle fibre
    begins at (0, 0, −1) mm; the others, which the paper does not place, lie beside it, close enough for none to begin
    in a wall. Without air nothing but tension acts on them: they stay where they are.

    Args:
        reading: Units of c and ε₀: "SI"; "mm_mN", mm and mN; "mm_N", mm and N.
        mesh: "long", 200 elements of 0.5 mm, 60 mm of them before A; "zone", 200 of 0.2 mm.
        kind: Of groove.

    Returns:
        The scenario; `dataclasses.replace` adds air to it.

    Raises:
        SceneError: Other names.
    """
    law = READINGS[known(reading, "reading", tuple(READINGS))]
    friction = CreepingCoulomb(MU, FADES)
    return Scenario(
        kind=kind,
        bundle=Bundle(pitch=BESIDE, height=0.0, noise=0.0, tail=MESHES[known(mesh, "mesh", tuple(MESHES))]),
        core=FixedCore(),
        air=None,
        law=law,
        wall_friction=friction,
        fibre_friction=friction,
        fibres_touch=False,
        elements=ELEMENTS,
    )
