"""The log of a run as columns of numbers."""

from __future__ import annotations

from dataclasses import fields
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import StepLog
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from dolfinrod.checkpoint.kept import Kept

__all__ = ["columns", "rows"]

NAMES = tuple(field.name for field in fields(StepLog))
# Stands for what is not known of the stability.
UNKNOWN = -1.0


def columns(log: Sequence[StepLog]) -> dict[str, NDArray[np.float64]]:
    """One array "log/name" for each entry of the rows.

    Args:
        log: Rows.

    Returns:
        Arrays of shape (steps,).
    """
    values = {name: [getattr(row, name) for row in log] for name in NAMES}
    return {
        f"log/{name}": np.array([UNKNOWN if value is None else value for value in column], dtype=np.float64)
        for name, column in values.items()
    }


def rows(kept: Kept) -> list[StepLog]:
    """Back from the columns.

    Args:
        kept: What holds them.

    Returns:
        The log.

    Raises:
        SceneError: They are no log.
    """
    n = kept.arrays["log/t"].size if "log/t" in kept.arrays else 0
    t, iterations, cuts, residual, energy, stable, directions = (
        kept.take(f"log/{name}", (n,)).tolist() for name in NAMES
    )
    if any(later <= before for before, later in pairwise([0.0, *t, np.nextafter(kept.t, np.inf)])):
        raise SceneError(f"must hold ascending times from 0 to {kept.t} in log/t", field=kept.name)
    return [
        StepLog(
            t[k],
            int(iterations[k]),
            int(cuts[k]),
            residual[k],
            energy[k],
            None if stable[k] == UNKNOWN else bool(stable[k]),
            None if directions[k] == UNKNOWN else int(directions[k]),
        )
        for k in range(n)
    ]
