"""A rod's history as a table of text: one row a stored time and node, digits that read back to the same doubles."""

from __future__ import annotations

from io import StringIO
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import RodHistory
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["read_table", "write_table"]

COLUMNS = (
    "t",
    "s [m]",
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
    """Write one rod's history; directors one after the other, velocities last where there are any.

    Args:
        path: File to write.
        t: Stored pseudo-times or times, shape (n_t,).
        rod: Its arrays.
    """
    n_t, n_s = len(t), len(rod.s)
    directors = np.swapaxes(rod.frames, -1, -2).reshape(n_t, n_s, 9)
    times, places = np.broadcast_arrays(t[:, None, None], rod.s[None, :, None])
    moving = {name: values for name in MOVING if (values := getattr(rod, name)) is not None}
    columns = _columns(tuple(moving))
    parts = (times, places, rod.r, directors, rod.gamma, rod.kappa, rod.n, rod.m, *moving.values())
    rows = np.concatenate(parts, axis=2).reshape(n_t * n_s, len(columns))
    np.savetxt(path, rows, "%.17g", ",", header=",".join(columns), comments="")


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
    moving, rows = _rows(path)
    if not rows.size or len(rows) % len(t):
        raise SceneError(f"must have as many rows for each of {len(t)} times, got {len(rows)} rows", field=str(path))
    table = rows.reshape(len(t), -1, rows.shape[1])
    times, s = table[:, :, 0], table[0, :, 1]
    if (times != t[:, None]).any() or (table[:, :, 1] != s).any():
        raise SceneError("must go through the same nodes at each time of result.json, got others", field=str(path))
    if len(s) < 2 or s[0] != 0.0 or (np.diff(s) <= 0.0).any():
        raise SceneError("must have nodes at ascending s from 0, got others", field=str(path))
    r, directors, *vectors = np.split(table[:, :, 2:], [3, *range(12, rows.shape[1] - 2, 3)], axis=2)
    frames = np.swapaxes(directors.reshape(*directors.shape[:2], 3, 3), -1, -2)
    r, frames, *vectors = (np.ascontiguousarray(a) for a in (r, frames, *vectors))
    return RodHistory(s.copy(), r, frames, *vectors[:4], **dict(zip(moving, vectors[4:], strict=True)))


def _columns(moving: tuple[str, ...]) -> tuple[str, ...]:
    """Names of all columns of a rod that has these velocities."""
    return (*COLUMNS, *(column for name in moving for column in MOVING[name]))


def _rows(path: Path) -> tuple[tuple[str, ...], Array]:
    """Which velocities there are, and the numbers under the header, one row a line."""
    try:
        header, _, body = path.read_text(encoding="utf-8").partition("\n")
        moving = tuple(name for name, columns in MOVING.items() if columns[0] in header)
        expected = _columns(moving)
        if header != ",".join(expected):
            raise SceneError(f"must begin with the line {','.join(expected)}, got {header[:80]!r}", field=str(path))
        rows = np.loadtxt(StringIO(body), delimiter=",", comments=None, ndmin=2) if body.strip() else np.empty((0, 0))
    except UnicodeDecodeError as error:
        raise SceneError(f"must be text in UTF-8: {error}", field=str(path)) from None
    except ValueError as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(f"must be a table of numbers: {error}", field=str(path)) from None
    if rows.size and rows.shape[1] != len(expected):
        raise SceneError(f"must have {len(expected)} columns, got {rows.shape[1]}", field=str(path))
    if not np.isfinite(rows).all():
        raise SceneError("must hold finite numbers only, got others", field=str(path))
    return moving, rows
