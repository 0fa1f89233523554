"""Where rods touched one another, and what they remember of it, in the arrays of a checkpoint, and back.

There are as many spots at a time as there happen to be: those of all times stand one after the other.
"""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.meetings import Meetings
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from dolfinrod.checkpoint import Kept

    Array = NDArray[np.float64]
    Arrays = dict[str, Array]

__all__ = ["met_of", "recalled", "resume_met"]

WHOLE = {"rod_a": np.int64, "rod_b": np.int64, "state": np.int8}
VECTORS = ("point", "force", "normal", "traction")


def met_of(group: str, path: Sequence[tuple[Meetings, ...]]) -> Arrays:
    """Spots of all meetings at all times of a group as arrays of the file."""
    arrays = {}
    for k, times in enumerate(zip(*path, strict=True)):
        arrays[f"{group}/met{k}_count"] = np.array([float(len(met.s_a)) for met in times])
        for field in fields(Meetings):
            arrays[f"{group}/met{k}_{field.name}"] = np.concatenate([getattr(met, field.name) for met in times])
    return arrays


def resume_met(kept: Kept, group: str, n: int, meetings: int) -> list[tuple[Meetings, ...]]:
    """Spots back from such arrays.

    Args:
        kept: What the file holds.
        group: As for `met_of`.
        n: Number of times.
        meetings: Number of meetings of the scene.

    Raises:
        SceneError: They are not there, or do not fit.
    """
    histories = [_history(kept, f"{group}/met{k}", n) for k in range(meetings)]
    return [tuple(history[i] for history in histories) for i in range(n)]


def _history(kept: Kept, name: str, n: int) -> list[Meetings]:
    """Spots of one meeting."""
    counts = kept.take(f"{name}_count", (n,))
    if (counts < 0.0).any() or (counts != np.floor(counts)).any():
        raise SceneError(f"must hold numbers of things in {name}_count", field=kept.name)
    total, ends = int(counts.sum()), np.cumsum(counts.astype(np.int64))[:-1]
    parts = {}
    for field in fields(Meetings):
        shape = (total, 3) if field.name in VECTORS else (total,)
        values = kept.take(f"{name}_{field.name}", shape).astype(WHOLE.get(field.name, np.float64))
        parts[field.name] = np.split(values, ends)
    return [Meetings(**{field: values[i] for field, values in parts.items()}) for i in range(n)]


def recalled(kept: Kept, like: Mapping[str, Array]) -> Arrays:
    """What contacts remember, back from the file: as much as there was of what rods do of one another.

    Args:
        kept: What the file holds.
        like: What they remember at the start, by name.

    Raises:
        SceneError: It is not there, or does not fit.
    """
    memory = {}
    for name, values in like.items():
        found, shape = kept.arrays.get(f"contact/{name}"), values.shape
        if name.startswith("meeting") and found is not None and found.ndim == len(shape):
            shape = (len(found), *shape[1:])
        memory[name] = kept.take(f"contact/{name}", shape)
    return memory
