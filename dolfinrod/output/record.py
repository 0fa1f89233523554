"""A result as plain files: one JSON for the record, one CSV a rod for the arrays."""

from __future__ import annotations

import json
import platform
from dataclasses import asdict
from importlib import metadata
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from dolfinrod.result import NotConverged, Result, RodHistory

__all__ = ["versions", "write"]

PACKAGES = (
    "dolfinrod",
    "numpy",
    "scipy",
    "fenics-dolfinx",
    "fenics-ufl",
    "fenics-ffcx",
    "fenics-basix",
    "petsc4py",
    "mpi4py",
    "pint",
)
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


def write(result: Result, folder: Path, *, failure: NotConverged | None = None) -> None:
    """Leave a result in a folder: `result.json` and `rod-0.csv`, `rod-1.csv`, …, replacing files of these names.

    Every number is written with the digits that read back to the same double.

    Args:
        result: What was found.
        folder: Made where it does not exist.
        failure: Why the end was not reached.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for k, rod in enumerate(result.rods):
        header = ",".join(COLUMNS)
        np.savetxt(folder / f"rod-{k}.csv", _table(result.t, rod), "%.17g", ",", header=header, comments="")
    text = json.dumps(_record(result, failure), indent=2, ensure_ascii=False)
    (folder / "result.json").write_text(text + "\n", encoding="utf-8")


def versions() -> dict[str, str]:
    """What computed the result: Python and the packages that are installed, each with its version."""
    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            continue
    return found


def _table(t: NDArray[np.float64], rod: RodHistory) -> NDArray[np.float64]:
    """One row a stored time and node, in the order of `COLUMNS`; directors one after the other."""
    n_t, n_s = len(t), len(rod.s)
    directors = np.swapaxes(rod.frames, -1, -2).reshape(n_t, n_s, 9)
    times, places = np.broadcast_arrays(t[:, None, None], rod.s[None, :, None])
    parts = (times, places, rod.r, directors, rod.gamma, rod.kappa, rod.n, rod.m)
    return np.concatenate(parts, axis=2).reshape(n_t * n_s, len(COLUMNS))


def _record(result: Result, failure: NotConverged | None) -> dict[str, Any]:
    """Everything of a result but the arrays along the rods."""
    record = {
        "converged": result.converged,
        "tip": result.tip.tolist(),
        "t": result.t.tolist(),
        "log": [asdict(step) for step in result.log],
        "energy": {name: values.tolist() for name, values in result.energy.items()},
        "statistics": asdict(result.statistics),
        "formulation": asdict(result.formulation),
        "versions": versions(),
    }
    if failure is not None:
        record["failure"] = {
            "t": failure.t,
            "step": failure.step,
            "reason": failure.reason,
            "advice": failure.advice,
        }
    return record
