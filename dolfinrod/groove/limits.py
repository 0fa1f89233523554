"""Numbers that must lie in a range: beyond it a unit has slipped."""

from __future__ import annotations

from dolfinrod.scene import SceneError
from dolfinrod.scene.quantity import number

__all__ = ["known", "limited", "whole"]


def limited(value: object, field: str, unit: str, least: float, most: float) -> float:
    """A finite number in a range, ends included.

    Args:
        value: Any real number.
        field: Dotted name of the field.
        unit: Its unit, for the complaint.
        least: Of what can be meant.
        most: Likewise.

    Returns:
        The value as a Python float.

    Raises:
        SceneError: Not a number, or out of the range.
    """
    x = number(value, field, unit)
    if not least <= x <= most:
        given = f"{x!r} {unit}".rstrip()
        raise SceneError(f"must lie between {least:g} and {f'{most:g} {unit}'.rstrip()}, got {given}", field=field)
    return x


def whole(value: object, field: str, least: int, most: int) -> int:
    """A whole number in a range; arguments as `limited`."""
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        raise SceneError(f"must be a whole number from {least} to {most}, got {value!r}", field=field)
    return value


def known(value: object, field: str, names: tuple[str, ...]) -> str:
    """One out of some names; arguments as `limited`."""
    if not isinstance(value, str) or value not in names:
        listed = ", ".join(f'"{name}"' for name in names)
        raise SceneError(f"must be one of {listed}, got {value!r}", field=field)
    return value
