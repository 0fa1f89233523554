"""A rod's history as a table of text: directors one after the other, velocities last where there are any."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.output.rows import read_rows, write_rows
from dolfinrod.result import RodHistory

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["read_table", "write_table"]

COLUMNS = (
    *(f"{axis} [m]" for axis in "xyz"),
    *(f"d{i}{axis}" for i in (1, 2, 3) for axis in "xyz"),
    *(f"gamma{i}" for i in (1, 2, 3)),
    *(f"kappa{i} [1/m]" for i in (1, 2, 3)),
    *(f"n{i} [N]" for i in (1, 2, 3)),
    *(f"m{i} [N m]" for i in (1, 2, 3)),
)
# What only a rod that moves has.
MOVING = {"v": tuple(f"v{axis} [m/s]" for axis in "xyz"), "omega": tuple(f"omega{axis} [rad/s]" for axis in "xyz")}


def write_table(path: Path, t: Array, rod: RodHistory) -> None:
    """Write one rod's history.

    Args:
        path: File to write.
        t: Stored pseudo-times or times, shape (n_t,).
        rod: Its arrays.
    """
    directors = np.swapaxes(rod.frames, -1, -2).reshape(len(t), len(rod.s), 9)
    moving = {name: values for name in MOVING if (values := getattr(rod, name)) is not None}
    parts = (rod.r, directors, rod.gamma, rod.kappa, rod.n, rod.m, *moving.values())
    write_rows(path, (*COLUMNS, *(column for name in moving for column in MOVING[name])), t, rod.s, parts)


def read_table(path: Path, t: Array) -> RodHistory:
    """Read back what `write_table` wrote.

    Args:
        path: File to read.
        t: Pseudo-times or times that it must hold.

    Returns:
        The same arrays.

    Raises:
        SceneError: Not such a table, or not of these times.
        OSError: The file cannot be read.
    """
    s, values, columns = read_rows(path, COLUMNS, t, tuple(MOVING.values()))
    r, directors, *vectors = np.split(values, [3, *range(12, len(columns), 3)], axis=2)
    frames = np.swapaxes(directors.reshape(*directors.shape[:2], 3, 3), -1, -2)
    r, frames, *vectors = (np.ascontiguousarray(a) for a in (r, frames, *vectors))
    moving = [name for name, own in MOVING.items() if own[0] in columns]
    return RodHistory(s, r, frames, *vectors[:4], **dict(zip(moving, vectors[4:], strict=True)))
