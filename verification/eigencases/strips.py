"""Strips bent in their stiff plane that give way sideways (Prandtl 1899, Michell 1899)."""

from __future__ import annotations

import numpy as np

from dolfinrod.scene import Clamp, PointForce, Rod, Scene, Section
from verification.eigencase import Eigencase, Path
from verification.references.scalar import scalar

__all__ = ["CASES", "strip"]

# Taken for infinite: the critical load falls with EI2/EI3 by 1.2 EI2/EI3 of itself.
STIFF = 1e8


def strip(EI_3: float, *, elastic: bool = False) -> Eigencase:
    """Cantilever with EI2 = GJ = L = 1 under a dead tip force in its stiff plane, pre-buckling deflection included.

    Args:
        EI_3: Stiffness in the plane, 20, 100 or `STIFF` (Prandtl's problem) [EI2].
        elastic: With EA = 10⁴ and GA = 4000.

    Returns:
        The case.
    """

    def scene(P: float) -> Scene:
        stiffness = Section(GJ=1.0, EI=(1.0, EI_3), rigid={"shear", "extension"})
        if elastic:
            stiffness = Section(EA=1e4, GA=4e3, GJ=1.0, EI=(1.0, EI_3))
        rod = Rod.straight(length=1.0, section=stiffness)
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[PointForce((0.0, -P, 0.0), at="end")])

    prandtl = STIFF == EI_3
    tabulated = f"I2-EI3_{EI_3:g}-GJ1-SR" if elastic else f"lateral-EI3_{EI_3:g}"
    known = scalar("I1-prandtl", "c") if prandtl else scalar(tabulated, "P_cr")
    return Eigencase(
        name="strip-prandtl" if prandtl else f"strip-{EI_3:g}" + ("-elastic" if elastic else ""),
        title=f"Strip bent in its stiff plane, EI₃/EI₂ = {EI_3:g}" + (", EA = 10⁴, GA = 4000" if elastic else ""),
        family="strips",
        quantity="P L²/√(EI₂ GJ)",
        scene=scene,
        analysis=Path(),
        reference=known,
        multiplicity=1,
        models=("continuum",) if elastic else ("continuum", "discrete"),
        note=f"Prandtl's strip cannot bend in its plane; EI₂/EI₃ = 10^{-np.log10(STIFF):g} moves the load as much."
        if prandtl
        else "",
    )


CASES = (strip(STIFF), strip(100.0), strip(20.0), strip(20.0, elastic=True))
