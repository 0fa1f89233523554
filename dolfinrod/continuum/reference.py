"""The reference interval [0, 1]: nodes, bases and quadrature rules, from Basix."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import basix
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "discontinuous_basis",
    "discontinuous_nodes",
    "lagrange_basis",
    "lagrange_nodes",
    "lagrange_slopes",
    "node_rule",
    "node_weights",
    "quadrature_points",
    "quadrature_weights",
]

CELL = basix.CellType.interval


def node_rule(degree: int) -> dict[str, Any]:
    """Metadata of the Gauss-Lobatto rule on the nodes of P_k, written out.

    FFCx 0.5 tells rules apart by three digits of a hash, which are the same for the five-point Gauss-Lobatto and the
    four-point Gauss rule; the points listed from the far end have another.
    """
    points, weights = basix.make_quadrature(basix.QuadratureType.gll, CELL, 2 * degree - 1)
    return {
        "quadrature_rule": "custom",
        "quadrature_degree": 2 * degree - 1,
        "quadrature_points": [[float(x)] for x in points[::-1, 0]],
        "quadrature_weights": [float(w) for w in weights[::-1]],
    }


def node_weights(degree: int) -> NDArray[np.float64]:
    """Weights of that rule in the order of `lagrange_nodes`; they sum to 1."""
    points, weights = basix.make_quadrature(basix.QuadratureType.gll, CELL, 2 * degree - 1)
    nearest = np.abs(lagrange_nodes(degree)[:, None] - points[None, :, 0]).argmin(axis=1)
    return np.asarray(weights)[nearest]


def lagrange_nodes(degree: int) -> NDArray[np.float64]:
    """Position of the P_k nodes on [0, 1] in DOLFINx's order: both ends, then the interior."""
    return np.asarray(_lagrange(degree).points[:, 0])


def discontinuous_basis(degree: int, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of the discontinuous P_k basis at `points` of [0, 1], shape (points, k + 1)."""
    return np.asarray(_discontinuous(degree).tabulate(0, points[:, None])[0, :, :, 0])


def discontinuous_nodes(degree: int) -> NDArray[np.float64]:
    """Position of the nodes of that basis on [0, 1]."""
    return np.asarray(_discontinuous(degree).points[:, 0])


def quadrature_points(degree: int) -> NDArray[np.float64]:
    """Gauss points on [0, 1] of the rule used for forms and coefficients of `degree`."""
    points, _ = basix.make_quadrature(CELL, degree)
    return np.asarray(points[:, 0])


def quadrature_weights(degree: int) -> NDArray[np.float64]:
    """Weights of that rule; they sum to 1."""
    _, weights = basix.make_quadrature(CELL, degree)
    return np.asarray(weights)


def lagrange_slopes(degree: int, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Derivatives of the P_k basis at `points` of [0, 1], shape (points, k + 1)."""
    return np.asarray(_lagrange(degree).tabulate(1, points[:, None])[1, :, :, 0])


def lagrange_basis(degree: int, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of the P_k basis at `points` of [0, 1], shape (points, k + 1)."""
    return np.asarray(_lagrange(degree).tabulate(0, points[:, None])[0, :, :, 0])


@cache
def _lagrange(degree: int) -> Any:
    """P_k with Gauss-Lobatto nodes; Basix takes longer to make an element than to tabulate it."""
    return basix.create_element(basix.ElementFamily.P, CELL, degree, basix.LagrangeVariant.gll_warped)


@cache
def _discontinuous(degree: int) -> Any:
    """The same with jumps between elements."""
    variant = basix.LagrangeVariant.gll_warped if degree > 0 else basix.LagrangeVariant.unset
    return basix.create_element(basix.ElementFamily.P, CELL, degree, variant, True)
