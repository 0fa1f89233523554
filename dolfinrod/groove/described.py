"""A scenario as plain data: what tells runs apart, and what a reader of their files finds."""

from __future__ import annotations

import hashlib
import json
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dolfinrod.groove.scenario import Scenario

__all__ = ["described", "key"]

# Letters of a hash by which runs are named: two of a million runs share one with a chance of 1e-8.
LETTERS = 16


def described(value: Any) -> Any:
    """A record as tables, lists and numbers that JSON holds digit for digit; each table names its kind.

    Args:
        value: A scenario or part of one.

    Returns:
        Plain data.
    """
    if is_dataclass(value):
        table = {field.name: described(getattr(value, field.name)) for field in fields(value)}
        return {"is": type(value).__name__, **table}
    if isinstance(value, frozenset):
        return sorted(value)
    if isinstance(value, tuple | list):
        return [described(entry) for entry in value]
    return str(value) if isinstance(value, float) and not isfinite(value) else value


def key(scenario: Scenario, model: str, elements: int | None) -> str:
    """Name of a run: the same for the same scenario, model and mesh, another for any other.

    Args:
        scenario: What is solved.
        model: By which model.
        elements: Of a fibre; None: what the scenario says.

    Returns:
        Hexadecimal digits of a hash.
    """
    text = json.dumps([described(scenario), model, elements], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:LETTERS]
