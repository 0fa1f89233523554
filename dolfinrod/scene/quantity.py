"""Numbers, vectors and places as a user gives them: checked, then plain Python floats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from math import hypot, inf, isfinite, nan
from numbers import Integral, Real
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError, quoted

__all__ = [
    "Place",
    "Vector",
    "VectorLike",
    "assign",
    "count",
    "direction",
    "entries",
    "listed",
    "names",
    "nonnegative",
    "number",
    "place",
    "positive",
    "require",
    "rod_index",
    "vector",
]

Vector = tuple[float, float, float]
VectorLike = Sequence[float] | NDArray[np.float64]
Place = Literal["start", "end"] | float
# Round-off of the length of a vector that was divided by its length: five roundings.
UNIT = 5 * float(np.finfo(float).eps)


def assign(record: object, **values: object) -> None:
    """Set checked values on a frozen record while it is being made."""
    for name, value in values.items():
        object.__setattr__(record, name, value)


def spoken(value: object, unit: str) -> str:
    """A value with its unit, as it is quoted in a complaint."""
    numeric = isinstance(value, Real) and not isinstance(value, bool)
    return f"{quoted(value)} {unit}".rstrip() if numeric else quoted(value)


def number(value: object, field: str, unit: str = "") -> float:
    """A finite number.

    Args:
        value: Any real number.
        field: Dotted name of the field.
        unit: Its unit, for the complaint.

    Returns:
        The value as a Python float.

    Raises:
        SceneError: Not a number, infinite or nan.
    """
    try:
        x = float(value) if isinstance(value, Real) and not isinstance(value, bool) else nan
    except OverflowError:
        x = inf
    if not isfinite(x):
        raise SceneError(f"must be a finite number{f' [{unit}]' * bool(unit)}, got {spoken(value, unit)}", field=field)
    return x


def positive(value: object, field: str, unit: str = "") -> float:
    """A finite number above zero; arguments as `number`."""
    x = number(value, field, unit)
    if x <= 0.0:
        raise SceneError(f"must be positive, got {spoken(x, unit)}", field=field)
    return x


def nonnegative(value: object, field: str, unit: str = "") -> float:
    """A finite number not below zero; arguments as `number`."""
    x = number(value, field, unit)
    if x < 0.0:
        raise SceneError(f"must not be negative, got {spoken(x, unit)}", field=field)
    return x


def vector(value: object, field: str, unit: str = "") -> Vector:
    """Three finite components; arguments as `number`.

    Returns:
        The components as Python floats.

    Raises:
        SceneError: Not three numbers, or one of them infinite or nan.
    """
    components = entries(value, field, unit, 3)
    x, y, z = (number(c, f"{field}[{i}]", unit) for i, c in enumerate(components))
    return x, y, z


def direction(value: object, field: str) -> Vector:
    """A vector that is not zero, made one of length 1; arguments as `number`."""
    x, y, z = vector(value, field)
    v = np.array((x, y, z))
    size = float(np.abs(v).max())
    if size == 0.0:
        raise SceneError(f"must not be zero, got {value}", field=field)
    # What this function has returned before keeps its digits.
    if abs(hypot(x, y, z) - 1.0) > UNIT:
        x, y, z = (float(c) for c in v / size / np.linalg.norm(v / size))
    return x, y, z


def entries(value: object, field: str, unit: str, n: int) -> tuple[object, ...]:
    """The `n` entries of a sequence, not yet checked one by one."""
    found = listed(value)
    if len(found) != n:
        raise SceneError(f"must have {n} entries{f' [{unit}]' * bool(unit)}, got {quoted(value)}", field=field)
    return found


def listed(value: Any) -> tuple[object, ...]:
    """The entries of what has an order; none of a text, a set, a table or a single value."""
    try:
        return () if isinstance(value, (str, bytes, Set, Mapping)) else tuple(value)
    except TypeError:
        return ()


def count(value: object, field: str, most: int) -> int:
    """A whole number of at least one.

    Args:
        value: Any whole number.
        field: Dotted name of the field.
        most: Beyond it the number can only be a slip of the pen.

    Returns:
        The value as a Python int.

    Raises:
        SceneError: Not a whole number, or too small or large.
    """
    if not isinstance(value, Integral) or isinstance(value, bool) or value < 1:
        raise SceneError(f"must be a whole number of at least 1, got {quoted(value)}", field=field)
    n = int(value)
    if n > most:
        raise SceneError(f"must be at most {most}, got {quoted(n)}", field=field)
    return n


def require(owner: str, values: Mapping[str, object]) -> None:
    """Nothing that must be given is left out.

    Args:
        owner: What the values are for, such as "Section".
        values: Each by its name; None: left out.

    Raises:
        SceneError: Some are missing, all of them named.
    """
    first, *others = [name for name, value in values.items() if value is None] or [""]
    if first:
        also = f", and so {'is' if len(others) == 1 else 'are'} {' and '.join(others)}" if others else ""
        raise SceneError(f"is missing{also}", field=f"{owner}.{first}")


def rod_index(value: object, field: str) -> int | None:
    """Number of a rod of the scene, counted from 0, or None for every rod."""
    if value is None:
        return None
    if not isinstance(value, Integral) or isinstance(value, bool) or value < 0:
        raise SceneError(
            f"must be the number of a rod (0, 1, …) or None for every rod, got {quoted(value)}", field=field
        )
    return int(value)


def place(value: object, field: str) -> Place:
    """A point on a rod: "start", "end" or arc length from the start [m]."""
    if isinstance(value, str):
        if value == "start":
            return "start"
        if value == "end":
            return "end"
        raise SceneError(f'must be "start", "end" or an arc length [m], got {quoted(value)}', field=field)
    return nonnegative(value, field, "m")


def names(value: object, field: str, known: Sequence[str]) -> frozenset[str]:
    """A set of names out of those known."""
    given = value if isinstance(value, (Set, list, tuple)) else listed(value) or (value,)
    if any(not isinstance(name, str) or name not in known for name in given):
        raise SceneError(f"must be a set of names out of {', '.join(known)}, got {quoted(value)}", field=field)
    return frozenset(str(name) for name in given)
