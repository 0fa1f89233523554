"""Eigenvectors as a user reads them: displacement and rotation along the rods, in space, to one scale."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np

from dolfinrod.eigen import RodShapes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem
    from dolfinrod.continuum.readout import Readout

    Array = NDArray[np.float64]

__all__ = ["shapes"]

# Displacement over length and spin below which a mode is one of rotation alone.
NO_DISPLACEMENT = 1e-6


def shapes(problem: Problem, readout: Readout, vectors: Array) -> tuple[RodShapes, ...]:
    """Shapes of modes, one record a rod.

    Args:
        problem: At the state the modes belong to.
        readout: Of the same discretization.
        vectors: Eigenvectors as columns, all components, shape (N, n).
    """
    d, place, kin = problem.discretization, problem.placement, problem.kinematics
    moves, turns = [np.zeros((len(problem.s), d.degree + 1, 3, 0))], [np.zeros((len(problem.s), d.degree + 1, 3, 0))]
    spin = kin.spin(problem.x[d.dofs["q"]].reshape(-1, d.dofs["q"].shape[2]))
    spin = spin.reshape(*d.dofs["q"].shape[:2], kin.n_spin, -1)
    for v in _local(problem, vectors):
        moves.append((place.length * v[d.dofs["r"]] @ place.axes.T)[..., None])
        turns.append((np.einsum("cnsi,cni->cns", spin, v[d.dofs["q"]]) @ place.spin_axes.T)[..., None])
    order = np.argsort(d.nodes)
    fields = {"s": problem.s * place.length, "u": np.concatenate(moves, -1), "theta": np.concatenate(turns, -1)}
    lined_up = {name: values[:, order] for name, values in readout.gather(**fields).items()}
    lined_up |= _scaled(lined_up["u"], lined_up["theta"], place.length)
    first = np.concatenate([[0], np.cumsum(d.elements)])
    return tuple(RodShapes(*(_joined(lined_up[name][a:b]) for name in ("s", "u", "theta"))) for a, b in pairwise(first))


def _local(problem: Problem, vectors: Array) -> list[Array]:
    """Each eigenvector at the local dofs."""
    X = problem.discretization.x.vector.duplicate()
    start, end = X.getOwnershipRange()
    found = []
    for v in vectors.T:
        X.array[:] = v[start:end]
        X.ghostUpdate(PETSc.InsertMode.INSERT, PETSc.ScatterMode.FORWARD)
        with X.localForm() as local:
            found.append(local.array_r.copy())
    X.destroy()
    return found


def _scaled(u: Array, theta: Array, length: float) -> dict[str, Array]:
    """Modes, in the last axis, with a largest displacement of 1, or a largest spin where they have none."""
    largest_u, largest_θ = (np.sqrt((a * a).sum(axis=2)).max(axis=(0, 1), initial=0.0) for a in (u, theta))
    turns_only = largest_u < NO_DISPLACEMENT * length * largest_θ
    size = np.where(turns_only, largest_θ, largest_u)
    main = np.concatenate(np.concatenate(np.where(turns_only, theta, u)))
    # The sign of the first component that is nearly the largest, so that round-off does not choose.
    marked = np.abs(main) > 0.9 * np.abs(main).max(axis=0, initial=0.0)
    scale = np.sign(np.take_along_axis(main, marked.argmax(axis=0)[None], axis=0)[0]) / size
    return {"u": np.where(turns_only, 0.0, u) * scale, "theta": theta * scale}


def _joined(values: Array) -> Array:
    """(cells, nodes, …, modes) of a continuous field to (modes, nodes of the rod, …), or (cells, nodes) to (nodes,)."""
    line = np.concatenate([*values[:, :-1], values[-1:, -1]])
    return line if line.ndim == 1 else np.moveaxis(line, -1, 0)
