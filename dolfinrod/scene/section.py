"""The section of a rod: stiffness and inertia per length in its principal axes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf, pi

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import Vector, assign, entries, names, nonnegative, positive, require, vector
from dolfinrod.scene.torsion import st_venant_constant
from dolfinrod.units import CN_PER_TEX

__all__ = ["Section"]

Pair = tuple[float, float]


@dataclass(frozen=True, init=False)
class Section:
    """Elastic law of a section, n = diag(EA, GA2, GA3)·γ and m = diag(GJ, EI2, EI3)·κ in the section frame.

    The section frame is (d1, d2, d3) with d1 normal to the section. GA2 resists shear along d2, EI2 bending about
    d2. A strain named in `rigid` is exactly zero; its stiffness is infinite, whatever was given.

    Args:
        EA: Axial stiffness [N].
        GA: Shear stiffness along d2 and d3, or one number for both, shear correction included [N].
        GJ: Torsional stiffness [N m²].
        EI: Bending stiffness about d2 and d3, or one number for both [N m²].
        rhoA: Mass per length [kg/m]; None where nothing needs it.
        rhoI: Rotary inertia per length about d1 (polar), d2 and d3 [kg m].
        rigid: Strains that are exactly zero, out of "shear" and "extension".
        radius: Radius of a circular section, where its surface matters [m].
        damping: Kelvin-Voigt retardation time τ of a moving rod, n = diag(EA, …)(γ + τ γ̇) and so for moments [s].

    Raises:
        SceneError: A stiffness that is missing, a stiffness, mass or radius that is not finite and positive, or an
            unknown strain.
    """

    EA: float
    GA: Pair
    GJ: float
    EI: Pair
    rhoA: float | None
    rhoI: Vector | None
    rigid: frozenset[str]
    radius: float | None
    damping: float

    def __init__(
        self,
        *,
        EA: float | None = None,
        GA: float | Pair | None = None,
        GJ: float | None = None,
        EI: float | Pair | None = None,
        rhoA: float | None = None,
        rhoI: Vector | None = None,
        rigid: Iterable[str] = frozenset(),
        radius: float | None = None,
        damping: float = 0.0,
    ) -> None:
        strains = names(rigid, "Section.rigid", ("shear", "extension"))
        elastic = {"EA": inf if "extension" in strains else EA, "GA": inf if "shear" in strains else GA}
        require("Section", {**elastic, "GJ": GJ, "EI": EI})
        assign(
            self,
            EA=inf if "extension" in strains else positive(EA, "Section.EA", "N"),
            GA=(inf, inf) if "shear" in strains else _pair(GA, "Section.GA", "N"),
            GJ=positive(GJ, "Section.GJ", "N m²"),
            EI=_pair(EI, "Section.EI", "N m²"),
            rhoA=None if rhoA is None else positive(rhoA, "Section.rhoA", "kg/m"),
            rhoI=None if rhoI is None else _inertia(rhoI),
            rigid=strains,
            radius=None if radius is None else positive(radius, "Section.radius", "m"),
            damping=nonnegative(damping, "Section.damping", "s"),
        )

    @classmethod
    def circle(
        cls,
        *,
        diameter: float | None = None,
        E: float | None = None,
        G: float | None = None,
        density: float | None = None,
        shear_factor: float = 0.9,
        rigid: Iterable[str] = frozenset(),
        damping: float = 0.0,
    ) -> Section:
        """Solid circle: A = πd²/4, I = πd⁴/64, J = πd⁴/32, GA = shear_factor·G·A.

        Args:
            diameter: d [m].
            E: Young's modulus along the rod [Pa].
            G: Shear modulus [Pa]; independent of E, a fibre is not isotropic.
            density: ρ [kg/m³].
            shear_factor: Timoshenko's correction; 0.9 is the usual value for a circle.
            rigid: Strains that are exactly zero.
            damping: Retardation time τ [s].

        Returns:
            The section, its `radius` known.

        Raises:
            SceneError: A number that is missing, or not finite and positive.
        """
        require("Section", {"diameter": diameter, "E": E, "G": G})
        d = positive(diameter, "Section.diameter", "m")
        A = pi * d * d / 4
        second = A * d * d / 16
        moments = (A, (second, second), 2 * second)
        return cls._solid(*moments, E, G, density, shear_factor, rigid, damping, radius=d / 2)

    @classmethod
    def rectangle(
        cls,
        *,
        width: float | None = None,
        height: float | None = None,
        E: float | None = None,
        G: float | None = None,
        density: float | None = None,
        shear_factor: float = 5 / 6,
        torsion: str = "st_venant",
        rigid: Iterable[str] = frozenset(),
        damping: float = 0.0,
    ) -> Section:
        """Solid rectangle, b = width along d2 and h = height along d3: A = bh, I2 = bh³/12, I3 = hb³/12.

        Args:
            width: b, along d2 [m].
            height: h, along d3 [m].
            E: Young's modulus along the rod [Pa].
            G: Shear modulus [Pa].
            density: ρ [kg/m³].
            shear_factor: Correction of GA; 5/6 is Reissner's value.
            torsion: "st_venant" for the warping section (exact series), "polar" for J = I2 + I3.
            rigid: Strains that are exactly zero.
            damping: Retardation time τ [s].

        Returns:
            The section.

        Raises:
            SceneError: A number that is missing, or not finite and positive, or an unknown torsion.
        """
        require("Section", {"width": width, "height": height, "E": E, "G": G})
        b, h = positive(width, "Section.width", "m"), positive(height, "Section.height", "m")
        A = b * h
        second = (A * h * h / 12, A * b * b / 12)
        if not isinstance(torsion, str) or torsion not in ("st_venant", "polar"):
            raise SceneError(f'must be "st_venant" or "polar", got {quoted(torsion)}', field="Section.torsion")
        J = sum(second) if torsion == "polar" else st_venant_constant(b, h)
        return cls._solid(A, second, J, E, G, density, shear_factor, rigid, damping)

    @classmethod
    def ramie(cls, *, rigid: Iterable[str] = frozenset(), damping: float = 0.0) -> Section:
        """The ramie fibre of Lyu, Cheng, Xu, CMES 127(2), 2021: circle of 20 µm, 1.54 g/cm³.

        E = 2224.6 cN/tex and G = 106.2 cN/tex are specific moduli; Pa = density · (cN/tex) · 1e4.

        Args:
            rigid: Strains that are exactly zero.
            damping: Retardation time τ [s].

        Returns:
            The section.
        """
        ρ = 1540.0
        E, G = 2224.6 * CN_PER_TEX * ρ, 106.2 * CN_PER_TEX * ρ
        return cls.circle(diameter=20e-6, E=E, G=G, density=ρ, rigid=rigid, damping=damping)

    @property
    def compliance_n(self) -> Vector:
        """Strain per force, (1/EA, 1/GA2, 1/GA3) [1/N]; exactly zero where rigid."""
        return 1.0 / self.EA, 1.0 / self.GA[0], 1.0 / self.GA[1]

    @property
    def compliance_m(self) -> Vector:
        """Curvature per moment, (1/GJ, 1/EI2, 1/EI3) [1/(N m²)]."""
        return 1.0 / self.GJ, 1.0 / self.EI[0], 1.0 / self.EI[1]

    @classmethod
    def _solid(
        cls,
        A: float,
        second: Pair,
        J: float,
        E: float | None,
        G: float | None,
        density: float | None,
        shear_factor: float,
        rigid: Iterable[str],
        damping: float,
        radius: float | None = None,
    ) -> Section:
        """One material all over the section, its moduli and density checked."""
        E = positive(E, "Section.E", "Pa")
        G = positive(G, "Section.G", "Pa")
        ρ = None if density is None else positive(density, "Section.density", "kg/m³")
        k = positive(shear_factor, "Section.shear_factor")
        I2, I3 = second
        return cls(
            EA=E * A,
            GA=k * G * A,
            GJ=G * J,
            EI=(E * I2, E * I3),
            rhoA=None if ρ is None else ρ * A,
            rhoI=None if ρ is None else (ρ * (I2 + I3), ρ * I2, ρ * I3),
            rigid=rigid,
            radius=radius,
            damping=damping,
        )


def _pair(value: object, field: str, unit: str) -> Pair:
    """Positive values for d2 and d3, or one for both."""
    if not isinstance(value, Iterable):
        both = positive(value, field, unit)
        return both, both
    two, three = entries(value, field, unit, 2)
    return positive(two, f"{field}[0]", unit), positive(three, f"{field}[1]", unit)


def _inertia(value: object) -> Vector:
    """Rotary inertia per length about d1, d2, d3, none of them negative."""
    for i, entry in enumerate(vector(value, "Section.rhoI", "kg m")):
        nonnegative(entry, f"Section.rhoI[{i}]", "kg m")
    return vector(value, "Section.rhoI", "kg m")
