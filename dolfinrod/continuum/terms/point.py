"""Loads at single sections: forces and moments, dead or turning with the section.

They act on nodes, so each adds to a few rows of the residual and, where it turns, to a few entries of the tangent.
All quantities are in working units; one row a load.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.kinematics import Kinematics

__all__ = ["DeadForces", "DeadMoments", "FollowerForces", "FollowerMoments", "PointTerm"]


class PointTerm(Protocol):
    """Contract: `values` carries the histories already; rows and columns are local numbers."""

    name: str

    def residual(self, x: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Rows, and what the term puts there, one row a load."""
        ...

    def tangent(
        self, x: NDArray[np.float64]
    ) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]] | None:
        """Rows, columns and a dense block for each load; None where it is zero."""
        ...


@dataclass
class DeadForces:
    """Forces fixed in space, δW = F·δr.

    Args:
        r: Centreline dofs of the loaded nodes, shape (n, d).
        values: Forces, shape (n, d).
    """

    r: NDArray[np.int32]
    values: NDArray[np.float64]
    name = "point force"

    def residual(self, x: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Rows and −F."""
        return self.r, -self.values

    def tangent(self, x: NDArray[np.float64]) -> None:
        """A dead force has none."""
        return


@dataclass
class FollowerForces:
    """Forces fixed to the section, δW = R(p) F·δr; not conservative, so the tangent is not symmetric.

    Args:
        kinematics: Knows how a section turns.
        r: Centreline dofs, shape (n, d).
        q: Rotation dofs, shape (n, n_q).
        values: Forces in stress-free directions, shape (n, d).
    """

    kinematics: Kinematics
    r: NDArray[np.int32]
    q: NDArray[np.int32]
    values: NDArray[np.float64]
    name = "follower force"

    def residual(self, x: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Rows and −R F."""
        return self.r, -self.kinematics.rotate(x[self.q], self.values)

    def tangent(self, x: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
        """Rows, columns and −∂(R F)/∂p."""
        return self.r, self.q, -self.kinematics.rotate_gradient(x[self.q], self.values)


@dataclass
class DeadMoments:
    """Moments fixed in space, δW = M·δθ with the spin δθ = 2 Im(δp p̄) or δφ; conservative only in a plane.

    Args:
        kinematics: Knows the spin of a section.
        q: Rotation dofs, shape (n, n_q).
        values: Moments, shape (n, n_spin).
    """

    kinematics: Kinematics
    q: NDArray[np.int32]
    values: NDArray[np.float64]
    name = "point moment"

    def residual(self, x: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Rows and −(∂δθ/∂δp)ᵀ M."""
        return self.q, -np.einsum("nij,ni->nj", self._spin(x[self.q]), self.values)

    def tangent(
        self, x: NDArray[np.float64]
    ) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]] | None:
        """The spin is linear in p: column j is the residual with the j-th unit quaternion; none in a plane."""
        n, n_q = self.q.shape
        if n_q == 1:
            return None
        units = np.repeat(np.eye(n_q), n, axis=0)
        spins = self._spin(units).reshape(n_q, n, -1, n_q)
        return self.q, self.q, -np.einsum("knij,ni->njk", spins, self.values)

    def _spin(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.kinematics.spin(q)


@dataclass
class FollowerMoments(DeadMoments):
    """Moments fixed to the section, δW = M·2 Im(p̄ δp); `values` in stress-free directions."""

    name = "follower moment"

    def _spin(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.kinematics.body_spin(q)
