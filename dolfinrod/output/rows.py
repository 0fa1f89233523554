"""Tables of text: one row a stored time and node, digits that read back to the same doubles."""

from __future__ import annotations

from io import StringIO
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["PLACE", "ROUND_OFF", "read_numbers", "read_rows", "write_numbers", "write_rows"]

# Tables keep every digit, so that what belongs together differs by round-off of the scene's own numbers at most.
ROUND_OFF = 1e-9
# What every row begins with.
PLACE = ("t", "s [m]")


def write_rows(path: Path, columns: Sequence[str], t: Array, s: Array, parts: Sequence[Array]) -> None:
    """Write what nodes have at the stored times, under a line that names the columns.

    Args:
        path: File to write.
        columns: Names of all that follows time and arc length.
        t: Stored pseudo-times or times, shape (n_t,).
        s: Arc length of the nodes, shape (n_s,) [m].
        parts: Values, each of shape (n_t, n_s, any number).
    """
    times, places = np.broadcast_arrays(t[:, None, None], s[None, :, None])
    names = (*PLACE, *columns)
    rows = np.concatenate((times, places, *parts), axis=2).reshape(len(t) * len(s), len(names))
    write_numbers(path, names, rows)


def write_numbers(path: Path, names: Sequence[str], rows: Array) -> None:
    """Write rows of numbers, shape (any, n_names), under a line that names their columns."""
    np.savetxt(path, rows, "%.17g", ",", header=",".join(names), comments="")


def read_rows(
    path: Path, columns: Sequence[str], t: Array, further: Sequence[Sequence[str]] = ()
) -> tuple[Array, Array, tuple[str, ...]]:
    """Read back what `write_rows` wrote.

    Args:
        path: File to read.
        columns: That must follow time and arc length.
        t: Pseudo-times or times that it must hold.
        further: Columns that may come after them, group by group.

    Returns:
        Arc lengths, values of shape (n_t, n_s, n_columns), and the names of their columns.

    Raises:
        SceneError: Not such a table, or not of these times.
        OSError: The file cannot be read.
    """
    names, rows = read_numbers(path, (*PLACE, *columns), further)
    if not rows.size or len(rows) % len(t):
        raise SceneError(f"must have as many rows for each of {len(t)} times, got {len(rows)} rows", field=str(path))
    table = rows.reshape(len(t), -1, rows.shape[1])
    times, s = table[:, :, 0], table[0, :, 1]
    if (times != t[:, None]).any() or (table[:, :, 1] != s).any():
        raise SceneError("must go through the same nodes at each time of result.json, got others", field=str(path))
    if len(s) < 2 or s[0] != 0.0 or (np.diff(s) <= 0.0).any():
        raise SceneError("must have nodes at ascending s from 0, got others", field=str(path))
    return s.copy(), table[:, :, len(PLACE) :], names[len(PLACE) :]


def read_numbers(
    path: Path, columns: Sequence[str], further: Sequence[Sequence[str]] = ()
) -> tuple[tuple[str, ...], Array]:
    """Read back what `write_numbers` wrote.

    Args:
        path: File to read.
        columns: All that must be there.
        further: Columns that may come after them, group by group.

    Returns:
        Names of the columns there are, and the numbers under them, one row a line; no columns where there are no rows.

    Raises:
        SceneError: Not such a table.
        OSError: The file cannot be read.
    """
    try:
        header, _, body = path.read_text(encoding="utf-8").partition("\n")
        names = (*columns, *(name for group in further if group[0] in header for name in group))
        if header != ",".join(names):
            raise SceneError(f"must begin with the line {','.join(names)}, got {header[:80]!r}", field=str(path))
        rows = np.loadtxt(StringIO(body), delimiter=",", comments=None, ndmin=2) if body.strip() else np.empty((0, 0))
    except UnicodeDecodeError as error:
        raise SceneError(f"must be text in UTF-8: {error}", field=str(path)) from None
    except ValueError as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(f"must be a table of numbers: {error}", field=str(path)) from None
    if rows.size and rows.shape[1] != len(names):
        raise SceneError(f"must have {len(names)} columns, got {rows.shape[1]}", field=str(path))
    if not np.isfinite(rows).all():
        raise SceneError("must hold finite numbers only, got others", field=str(path))
    return names, rows
