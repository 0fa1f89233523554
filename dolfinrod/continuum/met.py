"""Where rods touch rods, and what they remember of it, in the arrays of a state: of any length, one row a spot."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import MeetingHistory, Meetings

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from mpi4py import MPI

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["is_ragged", "kept", "meeting_histories", "remembered"]

# Of all names in a state that are kept here.
PREFIX = "meet_"
# Columns of a record, with the number of components.
COLUMNS = {
    "rod_a": 1,
    "s_a": 1,
    "rod_b": 1,
    "s_b": 1,
    "point": 3,
    "gap": 1,
    "length": 1,
    "force": 3,
    "normal": 3,
    "traction": 3,
    "state": 1,
}
KINDS = {"rod_a": np.int64, "rod_b": np.int64, "state": np.int8}


def is_ragged(name: str) -> bool:
    """Whether the values of a state under a name are of as many rows as rods touch at spots."""
    return name.startswith(PREFIX)


def kept(
    comm: MPI.Comm, t: float, memories: Sequence[Mapping[str, Array]], spots: Sequence[Meetings]
) -> dict[str, Array]:
    """What all ranks remember at a time, and where rods touch.

    Args:
        comm: Of the ranks.
        t: Time or pseudo-time.
        memories: Of this rank, one a contact of rods.
        spots: Of this rank, likewise.

    Returns:
        Name → rows, the same on all ranks.
    """
    arrays = {f"{PREFIX}t": np.array([t])}
    for k, (memory, met) in enumerate(zip(memories, spots, strict=True)):
        table = _everyone(comm, _packed(met))
        arrays[f"{PREFIX}{k}"] = table[np.lexsort(table[:, 3::-1].T)]
        arrays |= {f"{PREFIX}{k}_{name}": _everyone(comm, rows) for name, rows in memory.items()}
    return arrays


def remembered(state: Mapping[str, Array], n: int) -> tuple[float, list[dict[str, Array]]] | None:
    """The time of what n contacts of rods remember in a state, and what each does; None where it is not there."""
    if f"{PREFIX}{n - 1}" not in state:
        return None
    starts = [f"{PREFIX}{k}_" for k in range(n)]
    memories = [{name.removeprefix(s): rows for name, rows in state.items() if name.startswith(s)} for s in starts]
    return float(state[f"{PREFIX}t"][0]), memories


def meeting_histories(states: Sequence[Mapping[str, Array]], n: int) -> tuple[MeetingHistory, ...]:
    """One history for each of n contacts of rods, from gathered states."""
    return tuple(MeetingHistory(tuple(_unpacked(state[f"{PREFIX}{k}"]) for state in states)) for k in range(n))


def _everyone(comm: MPI.Comm, rows: Array) -> Array:
    """Rows of all ranks."""
    return rows if comm.size == 1 else np.concatenate(comm.allgather(rows))


def _packed(met: Meetings) -> Array:
    """A row a spot."""
    values = (np.asarray(getattr(met, name), dtype=float) for name in COLUMNS)
    return np.concatenate([v.reshape(-1, width) for v, width in zip(values, COLUMNS.values(), strict=True)], axis=1)


def _unpacked(table: Array) -> Meetings:
    """The record that such rows hold."""
    parts = np.split(table, np.cumsum(list(COLUMNS.values()))[:-1], axis=1)
    named = {name: p if COLUMNS[name] > 1 else p[:, 0] for name, p in zip(COLUMNS, parts, strict=True)}
    return Meetings(**{name: values.astype(KINDS.get(name, np.float64)) for name, values in named.items()})
