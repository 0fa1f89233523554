"""The schema of report.json, made from the records themselves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from verification.suite import Report

__all__ = ["schema"]

# What is drawn only.
DRAWN = "shapes"
PLAIN: dict[Any, dict[str, Any]] = {
    str: {"type": "string"},
    bool: {"type": "boolean"},
    int: {"type": "integer"},
    # Numbers that JSON cannot hold are null.
    float: {"type": ["number", "null"]},
    type(None): {"type": "null"},
    Any: {},
}


def schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of the record beside a page; records are described by their docstrings."""
    known: dict[str, Any] = {}
    whole = _record(Report, known)
    whole["properties"]["holds"] = {"type": "boolean", "description": "Whether no number is beyond its limit."}
    whole["required"] = sorted(whole["properties"])
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "report.json", **whole, "$defs": known}


def _record(kind: Any, known: dict[str, Any]) -> dict[str, Any]:
    """Fields of a record."""
    hints = get_type_hints(kind, localns=_names())
    properties = {f.name: _of(hints[f.name], known) for f in fields(kind) if f.name != DRAWN}
    words = (kind.__doc__ or "").strip().splitlines()[0]
    return {
        "type": "object",
        "description": words,
        "properties": properties,
        "required": sorted(properties),
        "additionalProperties": False,
    }


def _names() -> dict[str, Any]:
    """What records name for readers of types only."""
    from verification import case, statement
    from verification.ledger import RECORDS
    from verification.references import Reference

    return {
        "Vector": case.Vector,
        "Array": case.Array,
        "Reference": Reference,
        "Statement": statement.Statement,
    } | RECORDS


def _of(hint: Any, known: dict[str, Any]) -> dict[str, Any]:
    """Schema of a type."""
    if hint in PLAIN:
        return PLAIN[hint]
    origin, inner = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        return {"anyOf": [_of(one, known) for one in inner]}
    if origin is Literal:
        return {"enum": list(inner)}
    if origin is tuple and not (len(inner) == 2 and inner[1] is Ellipsis):
        return {"type": "array", "prefixItems": [_of(one, known) for one in inner], "items": False}
    if origin in (tuple, list, Sequence):
        return {"type": "array", "items": _of(inner[0], known)}
    if origin is dict:
        return {"type": "object", "additionalProperties": _of(inner[1], known)}
    if is_dataclass(hint) and isinstance(hint, type):
        if hint.__name__ not in known:
            known[hint.__name__] = {}
            known[hint.__name__] = _record(hint, known)
        return {"$ref": f"#/$defs/{hint.__name__}"}
    raise TypeError(f"{hint} is no part of a report")
