"""Natural frequencies: bending with and without shear and rotary inertia, torsion, extension, under tension."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Pin, PointForce, Rod, Scene, Section, Steady
from verification.eigencase import Eigencase, Vibration
from verification.eigencases.columns import SLIDING
from verification.references.scalar import Scalar, scalar

if TYPE_CHECKING:
    from dolfinrod.scene import Support

__all__ = ["CASES"]

# Without rotary inertia in bending; the spin of a section about the axis has some, as of a square with L/h = 10.
THIN = Section(GJ=1.0 / 1.3, EI=1.0, rhoA=1.0, rhoI=(1.0 / 600.0, 0.0, 0.0), rigid={"shear", "extension"})
STRETCHING = Section(EA=200.0, GJ=1.0 / 1.3, EI=1.0, rhoA=1.0, rhoI=(1.0 / 600.0, 0.0, 0.0), rigid={"shear"})
# Square section, L/h = 10, ν = 0.3, shear factor 5/6.
THICK = Section(
    EA=1200.0, GA=5.0 / 6.0 * 1200.0 / 2.6, GJ=1.0 / 1.3, EI=1.0, rhoA=1.0, rhoI=(1.0 / 600.0, 1.0 / 1200.0, 1.0 / 1200)
)
CLAMPED: tuple[Support, ...] = (Clamp(at="start"),)
PINNED: tuple[Support, ...] = (Pin(at="start"), SLIDING)
BOTH_MODELS = ("continuum", "discrete")


def vibration(
    name: str,
    title: str,
    section: Section,
    supports: tuple[Support, ...],
    mode: int,
    reference: Scalar,
    multiplicity: int = 2,
    tension: float = 0.0,
) -> Eigencase:
    """A rod of length 1 about its straight state, under a steady tension or none.

    Args:
        name: Of the case.
        title: For people.
        section: With mass.
        supports: That hold it.
        mode: Number of the frequency, from 0.
        reference: What it should be.
        multiplicity: Modes that share it.
        tension: T [EI/L²].

    Returns:
        The case; the discrete model poses it where the section cannot shear.
    """
    loads = [PointForce((tension, 0.0, 0.0), at="end", history=Steady())] if tension else []
    posed = Scene(rods=[Rod.straight(length=1.0, section=section)], supports=supports, loads=loads)
    return Eigencase(
        name=f"vibration-{name}",
        title=title,
        family="vibrations",
        quantity="ω, rad/s",
        scene=lambda _: posed,
        analysis=Vibration(mode),
        reference=reference,
        multiplicity=multiplicity,
        models=BOTH_MODELS if "shear" in section.rigid else ("continuum",),
        brackets=False,
    )


def squared(ends: str, n: int) -> Scalar:
    """ω = (βL)² of an Euler–Bernoulli beam, from the tabulated root."""
    return scalar(f"K1-EB-{ends}", f"betaL_{n}", power=2, why="ω = (βL)²")


def waves(c: float, n: int) -> Scalar:
    """ω of waves in a rod fixed at one end, from the tabulated one of speed 1."""
    return scalar("K3-waves-c1.0-L1.0", f"fixedfree_{n}", factor=c, why=f"wave speed {c:g}")


def pulled(T: float, n: int) -> Eigencase:
    """Frequency n of a pinned beam under tension, ω² = (nπ)⁴ + T (nπ)²; a pinned thin rod spins freely besides."""
    reference = scalar(f"K4-tension-T{T}", f"omega_{n}")
    title = f"Pinned beam under tension {T:g} EI/L², bending {n}"
    # One mode goes before: the spin about the axis, which nothing resists.
    return vibration(f"pulled-{T:g}-{n}", title, THIN, PINNED, 2 * n - 1, reference, tension=T)


def thick(ends: str, n: int, mode: int, supports: tuple[Support, ...] = CLAMPED) -> Eigencase:
    """Timoshenko's beam."""
    reference = scalar(f"K2-Timo-{ends}-s10-nu0.3", f"omega_{n}")
    return vibration(f"thick-{ends}-{n}", f"Timoshenko beam, {ends}, bending {n}", THICK, supports, mode, reference)


CASES = (
    *(
        vibration(
            f"cantilever-{n}", f"Thin cantilever, bending {n}", THIN, CLAMPED, 2 * n - 2, squared("cantilever", n)
        )
        for n in (1, 2)
    ),
    vibration(
        "propped-1",
        "Thin beam, clamped, pinned, bending 1",
        THIN,
        (*CLAMPED, SLIDING),
        0,
        squared("clamped-pinned", 1),
    ),
    vibration("free-1", "Thin free beam, bending 1", THIN, (), 6, squared("free-free", 1)),
    *(thick("cantilever", n, mode) for n, mode in ((1, 0), (2, 2), (3, 6))),
    thick("free-free", 1, 6, ()),
    vibration(
        "torsion-1", "Cantilever, torsion 1", STRETCHING, CLAMPED, 5, waves(np.sqrt(600.0 / 1.3), 1), multiplicity=1
    ),
    vibration(
        "extension-1", "Cantilever, extension 1", STRETCHING, CLAMPED, 4, waves(np.sqrt(200.0), 1), multiplicity=1
    ),
    *(pulled(T, n) for T, n in ((10.0, 1), (10.0, 2), (-5.0, 1))),
)
