"""Sections: stiffness of known shapes, rigid strains, and what cannot be."""

from __future__ import annotations

from math import inf, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dolfinrod.scene import SceneError, Section

lengths = st.floats(1e-6, 1e3)
moduli = st.floats(1e3, 1e12)


def section(**changes: object) -> Section:
    """A section of unit stiffness, some of it changed."""
    return Section(**{"EA": 1.0, "GA": 1.0, "GJ": 1.0, "EI": 1.0, **changes})


@given(d=lengths, E=moduli, G=moduli, ρ=st.floats(1.0, 1e5))
def test_circle(d: float, E: float, G: float, ρ: float) -> None:
    circle = Section.circle(diameter=d, E=E, G=G, density=ρ)
    A, r = pi * (d / 2) ** 2, d / 2
    assert pytest.approx(E * A) == circle.EA
    assert circle.GA == pytest.approx((0.9 * G * A,) * 2)
    assert circle.EI == pytest.approx((E * A * r**2 / 4,) * 2)
    assert pytest.approx(G * A * r**2 / 2) == circle.GJ
    assert circle.rhoA == pytest.approx(ρ * A)
    assert circle.rhoI == pytest.approx((ρ * A * r**2 / 2, ρ * A * r**2 / 4, ρ * A * r**2 / 4))
    assert circle.radius == r


@given(b=lengths, h=lengths, E=moduli, G=moduli)
def test_rectangle_bends_stiffly_about_the_axis_it_is_wide_along(b: float, h: float, E: float, G: float) -> None:
    rectangle = Section.rectangle(width=b, height=h, E=E, G=G, density=1.0)
    assert rectangle.EI == pytest.approx((E * b * h**3 / 12, E * h * b**3 / 12))
    assert rectangle.GA == pytest.approx((5 / 6 * G * b * h,) * 2)
    assert rectangle.rhoI == pytest.approx((b * h * (b**2 + h**2) / 12, b * h**3 / 12, h * b**3 / 12))


# Timoshenko & Goodier, Theory of Elasticity, table of art. 109: J = k·a·b³.
@pytest.mark.parametrize(("ratio", "k"), [(1.0, 0.1406), (1.5, 0.1958), (2.0, 0.229), (3.0, 0.263), (10.0, 0.312)])
def test_st_venant_torsion_of_rectangles(ratio: float, k: float) -> None:
    upright = Section.rectangle(width=1.0, height=ratio, E=1.0, G=1.0)
    flat = Section.rectangle(width=ratio, height=1.0, E=1.0, G=1.0)
    assert upright.GJ == flat.GJ == pytest.approx(k * ratio, rel=2e-3)


def test_st_venant_torsion_of_a_square_to_the_last_digits() -> None:
    # J/b⁴ = 1/3 − (64/π⁵) Σ tanh(nπ/2)/n⁵, summed with 50 digits.
    assert Section.rectangle(width=1.0, height=1.0, E=1.0, G=1.0).GJ == pytest.approx(0.14057701495515553, rel=1e-14)


def test_polar_torsion_is_the_sum_of_both_second_moments() -> None:
    rectangle = Section.rectangle(width=2.0, height=1.0, E=1.0, G=3.0, torsion="polar")
    assert pytest.approx(3.0 * sum(rectangle.EI)) == rectangle.GJ


def test_ramie_has_the_numbers_of_the_paper() -> None:
    # design/process.md, 1.1.
    ramie = Section.ramie()
    assert pytest.approx(10.7627, rel=1e-5) == ramie.EA
    assert ramie.EI == pytest.approx((2.690683e-10,) * 2, rel=1e-6)
    assert pytest.approx(2.569006e-11, rel=1e-6) == ramie.GJ
    assert ramie.GA == pytest.approx((0.4624,) * 2, rel=1e-4)
    assert ramie.rhoA == pytest.approx(4.83805e-7, rel=1e-5)
    assert ramie.radius == 1e-5


@pytest.mark.parametrize("ignored", [None, inf, 5.0, (1.0, 2.0)])
def test_rigid_strains_have_exactly_no_compliance_and_their_stiffness_is_ignored(ignored: object) -> None:
    rigid = section(EA=3.0 if isinstance(ignored, tuple) else ignored, GA=ignored, rigid={"shear", "extension"})
    assert rigid.compliance_n == (0.0, 0.0, 0.0)
    assert rigid == section(EA=None, GA=None, rigid={"shear", "extension"})


def test_compliance_is_the_inverse_of_stiffness() -> None:
    elastic = section(EA=2.0, GA=(4.0, 8.0), GJ=16.0, EI=(32.0, 64.0))
    assert elastic.compliance_n == (1 / 2, 1 / 4, 1 / 8)
    assert elastic.compliance_m == (1 / 16, 1 / 32, 1 / 64)


def test_one_number_serves_both_axes_and_equal_sections_are_equal() -> None:
    assert section(EI=2.0, GA=[3, 3]) == section(EI=(2, 2), GA=3.0)
    assert hash(section(EI=2.0)) == hash(section(EI=(2.0, 2.0)))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"EI": -1.0}, r"Section\.EI must be positive, got -1\.0 N m²"),
        ({"EI": (1.0, 0.0)}, r"Section\.EI\[1\] must be positive, got 0\.0 N m²"),
        ({"EI": (1.0, 1.0, 1.0)}, r"Section\.EI must have 2 entries \[N m²\], got \(1\.0, 1\.0, 1\.0\)"),
        ({"GJ": nan}, r"Section\.GJ must be a finite number \[N m²\], got nan N m²"),
        ({"EA": None}, r"^Section\.EA is missing$"),
        ({"EA": inf}, r"Section\.EA must be a finite number \[N\], got inf N"),
        ({"EA": 10**400}, r"Section\.EA must be a finite number"),
        ({"EA": True}, r"Section\.EA must be a finite number \[N\], got True"),
        ({"GA": "stiff"}, r"Section\.GA must have 2 entries \[N\], got 'stiff'"),
        ({"rhoA": -2.0}, r"Section\.rhoA must be positive, got -2\.0 kg/m"),
        ({"rhoI": (1.0, -1.0, 0.0)}, r"Section\.rhoI\[1\] must not be negative, got -1\.0 kg m"),
        ({"radius": 0.0}, r"Section\.radius must be positive, got 0\.0 m"),
        ({"rigid": {"bending"}}, r"Section\.rigid must be a set of names out of shear, extension, got {'bending'}"),
        ({"rigid": [["shear"]]}, r"Section\.rigid must be a set of names"),
    ],
)
def test_what_cannot_be_is_refused_in_words(changes: dict[str, object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        section(**changes)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"width": 0.0}, r"Section\.width must be positive, got 0\.0 m"),
        ({"height": nan}, r"Section\.height must be a finite number \[m\], got nan m"),
        ({"E": -1.0}, r"Section\.E must be positive, got -1\.0 Pa"),
        ({"density": 0.0}, r"Section\.density must be positive, got 0\.0 kg/m³"),
        ({"shear_factor": 0.0}, r"Section\.shear_factor must be positive, got 0\.0$"),
        ({"torsion": "thin"}, r"Section\.torsion must be \"st_venant\" or \"polar\", got 'thin'"),
    ],
)
def test_a_rectangle_that_cannot_be_is_refused_in_words(changes: dict[str, object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        Section.rectangle(**{"width": 1.0, "height": 1.0, "E": 1.0, "G": 1.0, **changes})
