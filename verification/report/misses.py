"""What lies beyond its limit, in sentences."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

from verification.checks import Check
from verification.crosscheck import BAND, CrossCheck
from verification.laws import LawRow
from verification.onestep import OneStep
from verification.report.tables import power, scientific

__all__ = ["sentence"]


@singledispatch
def sentence(row: Any) -> str:
    """What was found, and what was asked for.

    Args:
        row: A check, cross-check, law or load step that does not hold.

    Returns:
        The sentence without full stop.
    """
    raise TypeError(f"{type(row).__name__} is no row of the report")


@sentence.register
def _(row: Check) -> str:
    if row.quantity.startswith("order"):
        return f"{row.title}: {row.model} {row.quantity} {power(row.found)} ({row.mesh}), at least {power(row.limit)}"
    words = "least error" if row.quantity == "digits" else row.quantity
    asked = f"at most {scientific(row.limit, 0)}" + (", or the order of theory" if row.quantity == "digits" else "")
    return f"{row.title}: {row.model} {words} {scientific(row.found)} ({row.mesh}), {asked}"


@sentence.register
def _(row: OneStep) -> str:
    if row.failure:
        return f"{row.title}: {row.kinematics} {row.mesh} did not converge: {row.failure}"
    taken = f"{row.steps} load step(s) and {row.iterations} iterations, error {scientific(row.error)}"
    return f"{row.title}: {row.kinematics} {row.mesh} took {taken}; asked for one step and at most {row.limit}"


@sentence.register
def _(row: CrossCheck) -> str:
    if row.failure:
        return f"{row.title}: models not compared on {row.elements} discrete elements, {row.failure}"
    band = " to ".join(f"{factor:g}" for factor in BAND)
    return (
        f"{row.title}: models differ by {scientific(row.difference)} on {row.elements} discrete elements, estimated "
        f"{scientific(row.estimate)}; expected {band} times that"
    )


@sentence.register
def _(row: LawRow) -> str:
    return f"{row.title}: {row.model} violates it by {scientific(row.found)}, at most {scientific(row.bound, 0)}"
