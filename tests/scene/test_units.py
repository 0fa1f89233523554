"""Units: SI to the last digit, and complaints instead of guesses."""

from __future__ import annotations

from math import isfinite, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dolfinrod.units import CN_PER_TEX, TEX, UnitError, has_unit, si


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("20 um", "m", 2e-5),
        ("20 µm", "m", 2e-5),  # the sign micro
        ("20 μm", "m", 2e-5),  # the Greek letter
        ("40mm", "m", 0.04),
        (" -1 uN ", "N", -1e-6),
        ("1.54 g/cm**3", "kg/m**3", 1540.0),
        ("1.54 g/cm³", "kg/m**3", 1540.0),
        ("2224.6 cN/tex", "m**2/s**2", 22246000.0),
        ("4.84 dtex", "kg/m", 4.84e-7),
        ("34.26 GPa", "Pa", 34.26e9),
        ("0.1 N mm", "N*m", 1e-4),
        ("-2.5e-7 1/m", "1/m", -2.5e-7),
        (".5 m^-1", "1/m", 0.5),
        ("3 m⁻¹", "1/m", 3.0),
        ("3 m**(-1)", "1/m", 3.0),
        ("180 deg", "rad", pi),
        ("680 turn/m", "rad/m", 1360 * pi),
        ("1e-320 m", "m", 1e-320),
        (0.1, "m", 0.1),
        (3, "m", 3.0),
    ],
)
def test_quantities_are_converted_to_the_nearest_double(text: object, unit: str, value: float) -> None:
    assert si(text, unit) == value


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(["m", "N", "N*m**2", "kg/m**3", "1/m", "rad"]))
def test_a_double_written_with_its_unit_is_read_back_exactly(value: float, unit: str) -> None:
    assert si(f"{value!r} {unit}", unit) == value


NOT_READ = ["m", "ten mm", "1..2 m", "1 m + 2 m", "1,5 m", "(3 m", "3 m)", "[1] m", "1 m; 2", "3 m # long", "nan m"]
NOT_LENGTHS = [
    "inf m",
    "1e400 m",
    "1e999999999 m",
    "3 degC",
    "2 kg",
    "5",
    "1 mm mm",
    "1 dBm",
    "1 m/",
    "1 m/0",
    "1 m**0",
    "2 m 2 m",
    "3 dB",
    "1 m*Np",
    "1 m**a",
    "__import__('os')",
]


@pytest.mark.parametrize("text", [*NOT_READ, *NOT_LENGTHS, "", None, True, [1.0], {"m": 1}])
def test_what_is_no_length_is_refused(text: object) -> None:
    with pytest.raises(UnitError, match=r"^must be a quantity in m, got "):
        si(text, "m")


ENDLESS = [
    "9**9**9 m",
    "1 m**9**9**9",
    "1 mm**99999999/cm**99999998",
    "1 mm⁹⁹⁹⁹⁹⁹⁹/cm⁹⁹⁹⁹⁹⁹⁸",
    "1 (((((((((mm⁹)⁹)⁹)⁹)⁹)⁹)⁹)⁹)⁹)⁹",
    "1 mm**(99*99*99*99*99)",
    "1 m*1e999999999",
    "1 " + "(" * 999 + "m" + ")" * 999,
    "1" * 10**6 + " m",
]


@pytest.mark.parametrize("text", ENDLESS)
def test_what_no_computer_writes_down_is_refused_at_once(text: str) -> None:
    with pytest.raises(UnitError, match=r"^must be a quantity in m, got "):
        si(text, "m")
    assert not has_unit(text, "m")


def test_a_number_beyond_a_double_is_refused() -> None:
    with pytest.raises(UnitError, match="got a number beyond the range of a double"):
        si(10**5000, "m")


@given(st.text("0123456789eE+-*/^()°·⁻²³µ mNradBpk_.", max_size=30))
def test_whatever_is_typed_is_a_number_or_is_refused(text: str) -> None:
    try:
        length = si(f"1 {text}", "m")
    except UnitError:
        return
    assert isfinite(length)
    assert has_unit(f"1 {text}", "m")


def test_an_unknown_unit_is_named() -> None:
    with pytest.raises(UnitError, match=r"got '3 furlings': there is no unit 'furlings'"):
        si("3 furlings", "m")


def test_textile_units() -> None:
    assert si("1 tex", "kg/m") == TEX
    assert si("1 cN/tex", "m**2/s**2") == CN_PER_TEX
    assert has_unit("1 cN/tex", "N/tex")
    assert not has_unit("1 Pa", "N/tex")
    assert not has_unit(1.0, "N/tex")
