"""How finely and in which kinematics to solve, as asked in a call or in the table `solve` of a scene file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import count
from dolfinrod.scene.tables import refuse_unknown

__all__ = ["element_counts", "options"]

KNOWN = ("elements", "degree", "kinematics")
KINEMATICS = ("planar", "spatial")
MOST_ELEMENTS = 1_000_000
MOST_DEGREE = 5


def options(table: Mapping[str, Any], n_rods: int) -> dict[str, Any]:
    """Options that a solver will take.

    Args:
        table: What the file says.
        n_rods: Number of rods, each of which may have its own number of elements.

    Returns:
        The same.

    Raises:
        SceneError: An unknown option, or a value that cannot be.
    """
    refuse_unknown(table, KNOWN, "solve")
    if "elements" in table:
        element_counts(table["elements"], n_rods, "solve.elements")
    if "degree" in table:
        count(table["degree"], "solve.degree", MOST_DEGREE)
    if "kinematics" in table and table["kinematics"] not in KINEMATICS:
        one_of = " or ".join(KINEMATICS)
        raise SceneError(f"must be {one_of}, got {quoted(table['kinematics'])}", field="solve.kinematics")
    return dict(table)


def element_counts(elements: object, n_rods: int, field: str = "elements") -> tuple[int, ...]:
    """One number of elements a rod.

    Args:
        elements: One number for all rods, or one for each.
        n_rods: Number of rods.
        field: Its name, for the complaint.

    Returns:
        Numbers, shape (n_rods,).

    Raises:
        SceneError: Not a positive whole number for every rod, or more than a million.
    """
    if not isinstance(elements, list | tuple):
        return (count(elements, field, MOST_ELEMENTS),) * n_rods
    if len(elements) != n_rods:
        each = f"must be one number or one for each of the {n_rods} rods, got {quoted(elements)}"
        raise SceneError(each, field=field)
    return tuple(count(n, f"{field}[{k}]", MOST_ELEMENTS) for k, n in enumerate(elements))
