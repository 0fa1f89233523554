"""Units at the border: SI inside, textile and everyday units outside."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import lru_cache
from numbers import Real
from tokenize import TokenError
from typing import Any
from warnings import catch_warnings, simplefilter

__all__ = ["CN_PER_TEX", "TEX", "UnitError", "has_unit", "si"]

TEX = 1e-6  # kg/m: one gram per kilometre
CN_PER_TEX = 1e4  # J/kg: a modulus per density; times a density it is a pressure

# A decimal number, then a product of powers of units. Three digits of exponent: doubles need no more.
QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*([\w\s*/^()°·⁻-]*)")
MOST_CHARACTERS = 100
# What pint stumbles over shows as any of these: powers of zero, lone operators, logarithmic units.
STUMBLES = (ArithmeticError, AttributeError, LookupError, SyntaxError, TypeError, ValueError)
RAISED = re.compile("[⁻⁰¹²³⁴-⁹]+")
PLAIN = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
# N**9**9**9, m**99999999 and 1e999999999 are numbers that no computer writes down: powers of numbers and of more than
# two digits, powers that are products, and numbers with an exponent among the units.
ENDLESS = re.compile(r"\d[\s)]*(?:\*\*|\^)|(?:\*\*|\^)[\s-]*(?:\((?!-?\d\))|\d{3})|(?<!\w)\d+[eE_]")


class UnitError(ValueError):
    """Text that is no quantity, or not in the unit asked for; the message completes "field …"."""


def si(value: object, unit: str) -> float:
    """The magnitude of a quantity in an SI unit, correctly rounded.

    The number is kept as an exact fraction while units are converted, so that "20 um" is 2e-05 m to the last digit.

    Args:
        value: Text such as "20 um" or "2224.6 cN/tex", or a plain number, which is taken as SI.
        unit: The SI unit of the result, such as "m" or "N*m"; "rad" for an angle.

    Returns:
        The magnitude.

    Raises:
        UnitError: Not a quantity, an unknown unit, the wrong dimension, or beyond the range of a double.
    """
    if isinstance(value, Real) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            raise UnitError(f"must be a quantity in {unit}, got a number beyond the range of a double") from None
    magnitude = _converted(_quantity(value, unit), unit)
    if magnitude is None:
        raise _not_in(unit, value)
    return magnitude


def has_unit(value: object, unit: str) -> bool:
    """Whether a quantity given as text has the dimension of a unit; a plain number has none.

    Args:
        value: As in `si`.
        unit: Any unit, such as "N/tex".

    Returns:
        True where `si(value, unit)` would convert a text.
    """
    try:
        return isinstance(value, str) and _converted(_quantity(value, unit), unit) is not None
    except UnitError:
        return False


def _converted(quantity: Any, unit: str) -> float | None:
    """The magnitude in a unit; None where there is none, as for another dimension."""
    import pint

    try:
        return float(quantity.m_as(unit)) if quantity.is_compatible_with(unit) else None
    except (pint.PintError, *STUMBLES):
        return None


def _quantity(value: object, unit: str) -> Any:
    """The pint quantity a text names."""
    read = QUANTITY.fullmatch(value) if isinstance(value, str) and len(value) <= MOST_CHARACTERS else None
    if read is None:
        raise _not_in(unit, value)
    number, name = read.groups()
    powers = RAISED.sub(lambda raised: f"**{raised[0].translate(PLAIN)}", name)
    if ENDLESS.search(powers):
        raise _not_in(unit, value)
    import pint

    registry = _registry()
    try:
        # Micro is written with either of two letters; pint knows one.
        return registry.Quantity(Fraction(number), registry.parse_units(powers.replace("μ", "µ")))
    except pint.UndefinedUnitError:
        raise UnitError(f"must be a quantity in {unit}, got {value!r}: there is no unit {name.strip()!r}") from None
    except (pint.PintError, TokenError, *STUMBLES):
        raise _not_in(unit, value) from None


def _not_in(unit: str, value: object) -> UnitError:
    return UnitError(f"must be a quantity in {unit}, got {value!r}")


@lru_cache(maxsize=1)
def _registry() -> Any:
    """Pint, told to compute with fractions; it takes a good part of a second to load."""
    import pint

    with catch_warnings():
        # Debian's pint 0.19 opens its definitions by a function that importlib has deprecated.
        simplefilter("ignore", DeprecationWarning)
        return pint.UnitRegistry(non_int_type=Fraction)
