"""Problems of rods in equilibrium on which everybody is tried: P1 to P4, P6 and P6n.

Clamped at the start, a dead force and moment at the end, in metres and newtons. Each solver is held against the
solution of what it assumes of rods.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import TYPE_CHECKING, Any

from dolfinrod.scene import Clamp, PointForce, PointMoment, Rod, Scene, Section
from verification.case import SKEW
from verification.references import cantilever_tip

if TYPE_CHECKING:
    from verification.case import Vector

__all__ = ["RODS", "RodProblem"]

# Strains that each assumption takes away.
RIGID = {"sheared": frozenset[str](), "stretched": frozenset({"shear"}), "rigid": frozenset({"shear", "extension"})}
NOTHING = (0.0, 0.0, 0.0)
QUICK = ("P1", "P3")
# P6 [m, Pa].
FIBRE_DIAMETER, FIBRE_LENGTH, FIBRE_E, FIBRE_G = 20e-6, 0.04, 34.26e9, 1.635e9
FIBRE_EI = FIBRE_E * pi * FIBRE_DIAMETER**4 / 64.0
# P4, in EI/L².
COMPRESSION = 1.5 * pi**2 / 4.0
CLOSED = "a circle gone round a whole number of times"


@dataclass(frozen=True)
class RodProblem:
    """A rod and the load at its end.

    Args:
        name: Of the problem.
        title: For people.
        tips: Where the end should be, by what is assumed of the rod: "sheared", "stretched" or "rigid" [m].
        length: Of the rod [m].
        angle: By which the stress-free rod turns from x towards y; 0: straight [rad].
        EA: Against stretch [N].
        GA: Against shear [N].
        GJ: Against twist [N m²].
        EI: Against bending [N m²].
        force: At the end [N].
        moment: At the end [N m].
        ours: What is assumed when the continuum model takes it.
        source: Of the tips.
    """

    name: str
    title: str
    tips: dict[str, Vector]
    length: float = 1.0
    angle: float = 0.0
    EA: float = 1e4
    GA: float = 1e4
    GJ: float = 1.0 / 1.3
    EI: float = 1.0
    force: Vector = NOTHING
    moment: Vector = NOTHING
    ours: tuple[str, ...] = ("sheared", "rigid")
    source: str = ""

    @property
    def planar(self) -> bool:
        """Whether the rod stays in its plane."""
        return self.force[2] == 0.0 and self.moment[:2] == (0.0, 0.0)

    @property
    def quick(self) -> bool:
        """Whether a quick report takes it."""
        return self.name in QUICK

    @property
    def told(self) -> dict[str, Any]:
        """The problem in numbers, as an adapter is told it."""
        names = ("name", "length", "angle", "EA", "GA", "GJ", "EI", "force", "moment")
        return {name: getattr(self, name) for name in names} | {"times": (1.0,)}

    def scene(self, assumes: str) -> Scene:
        """The problem for our models, in no coordinate plane.

        Args:
            assumes: A key of `tips`.
        """
        section = Section(EA=self.EA, GA=self.GA, GJ=self.GJ, EI=self.EI, rigid=RIGID[assumes])
        start, x, y = SKEW.start(self.length), SKEW.vector(1.0, 0.0), SKEW.vector(0.0, 1.0)
        if self.angle == 0.0:
            rod = Rod.straight(self.length, section, start=start, direction=x, d2=y)
        else:
            radius = self.length / self.angle
            rod = Rod.arc(radius=radius, angle=self.angle, section=section, start=start, direction=x, towards=y)
        force = [PointForce(SKEW.vector(*self.force), at="end")] if any(self.force) else []
        moment = [PointMoment(SKEW.vector(*self.moment), at="end")] if any(self.moment) else []
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[*force, *moment])


def cantilever(name: str, title: str, alpha: float, EA: float, GA: float) -> RodProblem:
    """A straight rod under a tip force across it, by the exact first integral."""
    tips = {
        "sheared": cantilever_tip(alpha, EA=EA, GA=GA),
        "stretched": cantilever_tip(alpha, EA=EA),
        "rigid": cantilever_tip(alpha),
    }
    return RodProblem(
        name,
        title,
        {assumes: (x, y, 0.0) for assumes, (x, y) in tips.items()},
        EA=EA,
        GA=GA,
        force=(0.0, alpha, 0.0),
        source="quadrature of the exact first integral, verification/references/elastica.py",
    )


def fibre(name: str, title: str, length: float, unit: float) -> RodProblem:
    """A ramie fibre of d = 20 µm and L = 40 mm under 10 EI/L², in SI or, with EI = L = 1, without units.

    Args:
        name: Of the problem.
        title: For people.
        length: Of the rod [m].
        unit: EI/L² [N].
    """
    I, A = pi * FIBRE_DIAMETER**4 / 64.0, pi * FIBRE_DIAMETER**2 / 4.0
    EI = FIBRE_E * I
    # In units of EI/L².
    EA, GA = (modulus * A * FIBRE_LENGTH**2 / EI for modulus in (FIBRE_E, 0.9 * FIBRE_G))
    slender = cantilever(name, title, 10.0, EA, GA)
    return replace(
        slender,
        tips={assumes: (length * x, length * y, 0.0) for assumes, (x, y, _) in slender.tips.items()},
        length=length,
        EA=EA * unit,
        GA=GA * unit,
        GJ=2.0 * FIBRE_G / FIBRE_E * unit * length**2,
        EI=unit * length**2,
        force=(0.0, 10.0 * unit, 0.0),
    )


COLLOCATED = "collocation of the boundary-value problem, verification/references/bvp.py; agrees with peers.md"
RODS = (
    replace(cantilever("P1", "Cantilever, tip force 10 EI/L²", 10.0, 1e4, 1e4), ours=tuple(RIGID)),
    RodProblem(
        "P2a",
        "Roll-up, tip moment 2π EI/L",
        dict.fromkeys(RIGID, NOTHING),
        moment=(0.0, 0.0, 2.0 * pi),
        ours=("sheared",),
        source=CLOSED,
    ),
    RodProblem(
        "P2b",
        "Roll-up, tip moment 4π EI/L",
        dict.fromkeys(RIGID, NOTHING),
        moment=(0.0, 0.0, 4.0 * pi),
        ours=("sheared",),
        source=CLOSED,
    ),
    RodProblem(
        "P3",
        "45° bend, tip force 600 out of its plane",
        {
            "sheared": (47.150438573629, 15.684800534039, 53.474858791825),
            "stretched": (47.152150217636, 15.685355776664, 53.471762950031),
            "rigid": (47.151294400305, 15.685078162158, 53.468598442323),
        },
        length=25.0 * pi,
        angle=0.25 * pi,
        EA=1e7,
        GA=5e6,
        GJ=1e7 / 12.0,
        EI=1e7 / 12.0,
        force=(0.0, 0.0, 600.0),
        ours=("sheared",),
        source=COLLOCATED,
    ),
    RodProblem(
        "P4",
        "Column under 1.5 times its Euler load, a thousandth of it across",
        {
            "sheared": (0.3629618703668, 0.7886585441080, 0.0),
            "stretched": (0.3632844439501, 0.7885710075368, 0.0),
            "rigid": (0.3633319805319, 0.7886581739978, 0.0),
        },
        force=(-COMPRESSION, 1e-3 * COMPRESSION, 0.0),
        source=COLLOCATED,
    ),
    fibre("P6", "Fibre, d = 20 µm, L = 40 mm, tip force 10 EI/L², in SI", FIBRE_LENGTH, FIBRE_EI / FIBRE_LENGTH**2),
    fibre("P6n", "The same fibre with EI = L = 1", 1.0, 1.0),
)
