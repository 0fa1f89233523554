"""Moments along a rod by the method of sections: as accurate as its ends, where the moment field is one order short.

What the elements put on the first node is minus the moment there; from it the balance M′ = −r′ × N leads along the
rod, and what they put on a node further on is the jump that a point moment or a support leaves. Nodal forces and
moments of an element formulation converge with twice the degree, the moment field itself only with the degree.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import reference

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.kinematics import Kinematics

__all__ = ["Sections"]


class Sections:
    """The method of sections for elements of one degree.

    Args:
        kinematics: Dimension.
        degree: Degree k of the centreline; forces have k − 1.
    """

    def __init__(self, kinematics: Kinematics, degree: int) -> None:
        self._kin = kinematics
        self._means, self._integrals, self._shares = _tables(degree)

    def moments(
        self,
        r: NDArray[np.float64],
        N: NDArray[np.float64],
        q: NDArray[np.float64],
        nodal: NDArray[np.float64],
        couples: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """Moment in space at the nodes of the elements of one rod, in ascending order within each.

        Args:
            r: Centreline, shape (times, cells, k + 1, d).
            N: Forces, shape (times, cells, k, d).
            q: Rotation at the first node of each element, shape (times, cells, n_q).
            nodal: Residual of the elements there, shape (times, cells, n_q).
            couples: Moments per ξ that turning sections put on the elements, shape (times, cells, k + 1, n_spin); None:
                none turn.

        Returns:
            Moments, shape (times, cells, k + 1, n_spin).
        """
        couple = _cross(r[:, :, :, None], N[:, :, None])
        carried = np.einsum("iab,tcabs->tcis", self._integrals, couple)
        spin = self._kin.spin(q.reshape(-1, q.shape[2])).reshape(*q.shape[:2], -1, q.shape[2])
        put = np.einsum("tcij,tcj->tci", spin, nodal) / np.einsum("tcij,tcij->tci", spin, spin)
        if couples is not None:
            carried = carried + np.einsum("ia,tcas->tcis", self._means, couples)
            # The first nodes of the elements carry parts of them too, their own and that of the element before.
            put = put - self._shares[0] * couples[:, :, 0]
            put[:, 1:] -= self._shares[1] * couples[:, :-1, 1]
        before = np.cumsum(carried[:, :, -1], axis=1) - carried[:, :, -1]
        return -(np.cumsum(put, axis=1) + before)[:, :, None] - carried


@cache
def _tables(degree: int) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """∫ φ_a and ∫ φ_a′ ψ_b from the start of the element to each of its nodes, and their Gauss-Lobatto weights."""
    ξ = np.sort(reference.lagrange_nodes(degree))
    x, w = reference.quadrature_points(2 * degree), reference.quadrature_weights(2 * degree)
    points = np.outer(ξ, x).ravel()
    slopes = reference.lagrange_slopes(degree, points).reshape(len(ξ), len(x), -1)
    values = reference.discontinuous_basis(degree - 1, points).reshape(len(ξ), len(x), -1)
    basis = reference.lagrange_basis(degree, points).reshape(len(ξ), len(x), -1)
    means = np.einsum("i,q,iqa->ia", ξ, w, basis)
    return means, np.einsum("i,q,iqa,iqb->iab", ξ, w, slopes, values), reference.node_weights(degree)


def _cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """a × b in space, its one component in a plane."""
    if a.shape[-1] == 3:
        return np.cross(a, b)
    return (a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])[..., None]
