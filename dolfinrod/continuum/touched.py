"""Gathered states to histories of what rods have touched."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import ContactHistory, Touching

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from dolfinrod.result import RodHistory
    from dolfinrod.scene import Contact
    from dolfinrod.scene.reply import Reply

    Array = NDArray[np.float64]

__all__ = ["COLUMNS", "contact_histories", "packed", "unpacked"]

# What a node remembers of each contact, and what it feels there, with the number of components.
MEMORY = {"x": 3, "anchored": 3, "multiplier": 1, "slip": 1, "state": 1}
FELT = {"gap": 1, "pressure": 1, "normal": 3, "traction": 3}
COLUMNS = {"t": 1, **MEMORY, **FELT}
SHOWN = ("gap", "pressure", "normal", "traction", "slip", "state")


def packed(t: float, memory: Mapping[str, Array], reply: Reply) -> Array:
    """What nodes remember at a time and feel there, shape (n, n_columns)."""
    values = [np.full(len(reply.gap), t), *memory.values(), *(getattr(reply, name) for name in FELT)]
    widths = COLUMNS.values()
    return np.concatenate([v.reshape(len(v), width) for v, width in zip(values, widths, strict=True)], axis=1)


def unpacked(table: Array) -> dict[str, Array]:
    """What they remember, out of that."""
    parts = np.split(table, np.cumsum(list(COLUMNS.values()))[:-1], axis=1)
    named = dict(zip(COLUMNS, parts, strict=True))
    return {name: named[name] if width > 1 else named[name][:, 0] for name, width in MEMORY.items()}


def contact_histories(
    contacts: Sequence[Contact], rods: Sequence[RodHistory], shares: Sequence[Array], touched: Sequence[Array]
) -> tuple[ContactHistory, ...]:
    """One history a contact.

    Args:
        contacts: Of the scene.
        rods: Histories of its rods.
        shares: Length for which each node of each rod stands, shape (n_s,) [m].
        touched: What these nodes remember and feel, shape (n_t, n_s, contacts · n_columns).

    Returns:
        In the order of the contacts.
    """
    n = sum(COLUMNS.values())
    ends = dict(zip(COLUMNS, pairwise(np.cumsum([0, *COLUMNS.values()])), strict=True))

    def of(k: int, rod: int) -> Touching:
        table = touched[rod][:, :, k * n : (k + 1) * n]
        felt = {name: table[:, :, slice(*ends[name])] for name in SHOWN}
        values = {name: part if COLUMNS[name] > 1 else part[:, :, 0] for name, part in felt.items()}
        return Touching(
            s=rods[rod].s,
            share=shares[rod],
            gap=values["gap"],
            pressure=values["pressure"],
            normal=values["normal"],
            traction=values["traction"],
            slip=values["slip"],
            state=values["state"].astype(np.int8),
        )

    return tuple(
        ContactHistory(tuple(of(k, rod) if contact.rod in (None, rod) else None for rod in range(len(rods))))
        for k, contact in enumerate(contacts)
    )
