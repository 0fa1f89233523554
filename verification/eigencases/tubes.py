"""Rods pressed on round walls: they buckle along the bottom of a tube, and roll off the crest of a cylinder."""

from __future__ import annotations

import numpy as np

from dolfinrod.scene import Contact, Cylinder, Guide, LineForce, Penalty, PointForce, Rod, Scene, Section, Static
from verification.eigencase import Eigencase, Path
from verification.references.contact import value
from verification.references.scalar import Scalar

__all__ = ["CASES"]

RADIUS = 2e-3
LAW = Penalty(1e4, 5e-4)
# Both ends held from moving aside and from spinning, free to turn and to sink; the far end free along the axis.
HELD = (Guide("start", free=("y", "ry", "rz")), Guide("end", free=("x", "y", "ry", "rz")))
LVI = ("Lvi-tube-EI1.0-w1.0-r0.01-L10.0", "Lvi-tube-EI2.0-w0.5-r0.02-L6.0")
CREST, LENGTH, PRESSED = 0.05, 1.0, 2.5
SINCE = 1.0


def weighed(t: float) -> float:
    """The weight comes first, within one unit of time."""
    return min(t, SINCE)


def later(t: float) -> float:
    """Then the load whose critical value is sought."""
    return max(0.0, t - SINCE)


def lying_in_tube(name: str, thrust: float) -> Scene:
    """A heavy rod along the bottom of a tube, so wide that its axis can move on the radius r of the references."""
    EI, w, r, length = (value(name, key) for key in ("EI", "w", "r", "L"))
    inner = r + RADIUS + LAW.g_0 - w / LAW.eps_N
    return Scene(
        rods=[Rod.straight(length, _section(EI), start=(0.0, -r, 0.0))],
        supports=HELD,
        loads=[
            LineForce((0.0, -w, 0.0), history=weighed),
            PointForce((-thrust, 0.0, 0.0), at="end", history=later),
        ],
        contacts=[Contact(Cylinder((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), inner, "inside"), LAW)],
        motion=Static(t_end=SINCE + 1.0),
    )


def on_crest(thrust: float) -> Scene:
    """A rod pressed onto the crest of a cylinder, its ends held from sliding off."""
    height = CREST + RADIUS + LAW.g_0 - PRESSED / LAW.eps_N
    return Scene(
        rods=[Rod.straight(LENGTH, _section(1.0), start=(0.0, height, 0.0))],
        supports=HELD,
        loads=[
            LineForce((0.0, -PRESSED, 0.0), history=weighed),
            PointForce((-thrust, 0.0, 0.0), at="end", history=later),
        ],
        contacts=[Contact(Cylinder((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), CREST), LAW)],
        motion=Static(t_end=SINCE + 1.0),
    )


def _section(EI: float) -> Section:
    return Section(EI=EI, GJ=EI / 1.3, radius=RADIUS, rigid={"shear", "extension"})


def tube(name: str) -> Eigencase:
    """Lvi of the references."""
    EI, r, length, thrust = (value(name, key) for key in ("EI", "r", "L", "P_pinned"))
    return Eigencase(
        name=f"tube-EI{EI:g}-r{r:g}-L{length:g}",
        title=f"Heavy rod in a tube, EI = {EI:g}, r = {r:g}, L = {length:g}: first sideways waves",
        family="tubes",
        quantity="thrust, N",
        scene=lambda P: lying_in_tube(name, P),
        analysis=Path(since=SINCE),
        reference=Scalar(
            id=f"{name}: P_pinned",
            value=thrust,
            method="closed form, EI (nπ/L)² + (w/r)(L/nπ)², least of n",
            source="Dawson & Paslay 1984 (JPT 36:1734)",
            digits_trusted=14,
        ),
        multiplicity=1,
        finer=value(name, "n_crit") / 2.0,
    )


def crest_thrust() -> float:
    """EI (π/L)² − (q/ρ)(L/π)²: aside by u the rod sinks by u²/2ρ; ρ is the radius of its axis, sunk by q/ε_N."""
    ρ = CREST + RADIUS + LAW.g_0 - PRESSED / LAW.eps_N
    return float((np.pi / LENGTH) ** 2 - PRESSED / ρ * (LENGTH / np.pi) ** 2)


CASES = (
    *(tube(name) for name in LVI),
    Eigencase(
        name="crest",
        title="Rod pressed onto the crest of a cylinder, half as hard as it could bear: when its thrust bows it off",
        family="tubes",
        quantity="thrust, N",
        scene=on_crest,
        analysis=Path(since=SINCE),
        reference=Scalar(
            id="EI (π/L)² − (q/ρ)(L/π)²",
            value=crest_thrust(),
            method="closed form, ρ = radius of the axis that has sunk by q/ε_N",
            source="own derivation, as the tube of Dawson & Paslay 1984 turned outwards",
            digits_trusted=14,
        ),
        multiplicity=1,
    ),
)
