"""Number of directions in which an equilibrium gives way: inertia of the tangent, by folding the rods in half.

At an equilibrium under conservative loads the tangent is the second variation of the energy, symmetric in the spins.
Every second node is eliminated at once, S = D − B P⁻¹ Bᵀ, and again every second one of those left. By Sylvester's law
as extended by Haynsworth the negative eigenvalues of all pivot blocks P together are those of the tangent. F_n, an
unknown with the compliance −l/EA on the diagonal, contributes one per element, which says nothing of stability.
A pivot block is the stiffness of a node between two held ones. The cost is linear in the number of elements.

Entries fall to an eighth with each folding while what round-off has left in them adds up, so that of n elements between
supports it turns signs from about n⁴ = 1/ε on. Where rods of many elements seem to give way it is followed along: if it
is much of a pivot block, they are not told from rods that do.

Here F_n stands with the node at which its element ends: with that node free all its motions meet a resistance, and the
first node of a rod, which has none, is the last to be eliminated.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import SingularTangentError
from discrete.unknowns import AXIAL, N_NODE, SPIN, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.nodes import Tangent

    Array = NDArray[np.float64]

__all__ = ["Blocks", "blocks", "negative_directions"]

# An eigenvalue of a pivot block, its entries about one, that is smaller has no sign.
SINGULAR = 1e-15
# Round-off of a pivot block, its entries about one, that may turn signs, and nodes of a rod that never have as much.
SPOILT, FINE = 0.1, 1000
# Nodes that are not worth another folding.
FEW = 6
# Unknowns of an element at node i, and at node j with F_n behind them.
_I = slice(0, AXIAL)
_J = np.array([7, 8, 9, 10, 11, 12, AXIAL])


@dataclass(frozen=True, eq=False)
class Blocks:
    """Symmetric part of a tangent, scaled, held unknowns replaced by ones on the diagonal.

    Args:
        diagonal: Node by node, shape (n_nodes, 7, 7).
        upper: Of a node and the next, zero between rods, shape (n_nodes − 1, 7, 7).
        asymmetry: Largest difference from symmetry before it was taken out.
        first: First node of each rod, then the number of all nodes.
    """

    diagonal: Array
    upper: Array
    asymmetry: float
    first: tuple[int, ...]


def blocks(tangent: Tangent) -> Blocks:
    """Symmetric part of a tangent, node by node.

    Args:
        tangent: Of a state.

    Returns:
        Its blocks.
    """
    system = tangent.system
    n_nodes, node_i = system.n_unknowns // N_NODE, system.node_i
    scaled = tangent.elements * system.scale_elements
    D, U, lower = (np.zeros((n, N_NODE, N_NODE)) for n in (n_nodes, n_nodes - 1, n_nodes - 1))
    D[node_i, :AXIAL, :AXIAL] = scaled[:, _I, _I]
    D[node_i + 1] += scaled[:, _J[:, None], _J]
    U[node_i, :AXIAL] = scaled[:, _I][:, :, _J]
    lower[node_i, :AXIAL] = np.swapaxes(scaled[:, _J, _I], 1, 2)
    free = np.ones(system.n_unknowns, dtype=bool)
    free[system.held] = False
    free = free.reshape(n_nodes, N_NODE)
    free[:, AXIAL] = False
    free[node_i + 1, AXIAL] = True
    for block, rows, columns in ((D, free, free), (U, free[:-1], free[1:]), (lower, free[:-1], free[1:])):
        block *= rows[:, :, None] & columns[:, None]
    transposed = np.swapaxes(D, 1, 2)
    asymmetry = max(float(np.abs(D - transposed).max()), float(np.abs(U - lower).max()))
    asymmetry /= float(np.abs(D).max())
    D = 0.5 * (D + transposed)
    D[:, range(N_NODE), range(N_NODE)] += ~free
    first = np.setdiff1d(np.arange(n_nodes), node_i + 1)
    return Blocks(D, 0.5 * (U + lower), asymmetry, (*map(int, first), n_nodes))


def negative_directions(tangent: Blocks) -> int | None:
    """Independent directions in which the second variation of the energy is negative.

    Args:
        tangent: The tangent.

    Returns:
        Their number; None where the tangent is singular to round-off.

    Raises:
        SingularTangentError: There seem to be some, but elements are so short beside spans that it may be round-off.
    """
    rods = [(tangent.diagonal[a:b], tangent.upper[a : b - 1]) for a, b in pairwise(tangent.first)]
    negative = 0
    for D, U in rods:
        found, _ = _negative(D, U)
        if found is None:
            return None
        negative += found - (len(D) - 1)
    if negative and any(_negative(D, U, _rounded(D))[1] > SPOILT for D, U in rods if len(D) > FINE):
        raise SingularTangentError
    return negative


def _negative(D: Array, U: Array, rounded: Array | None = None) -> tuple[int | None, float]:
    """Negative eigenvalues of the blocks of one rod, those of F_n included, and the most round-off in any block."""
    negative, spoilt = 0, 0.0
    while len(D) > FEW:
        odd = D[1::2]
        unit = _units(np.abs(odd))
        odd = odd * unit[:, :, None] * unit[:, None]
        λ = np.linalg.eigvalsh(odd)
        if not np.abs(λ).min() > SINGULAR:
            return None, spoilt
        negative += int((λ < 0.0).sum())
        if rounded is not None:
            spoilt = max(spoilt, float((rounded[1::2] * unit[:, 0] ** 2).max()))
        # Elimination keeps more digits of small and large entries apart than eigenvectors do.
        D, U, rounded = _folded(D, U, np.linalg.inv(odd) * unit[:, :, None] * unit[:, None], rounded)
    unit = _units(np.abs(D))
    λ = np.linalg.eigvalsh(_whole(D, U, unit))
    if rounded is not None:
        spoilt = max(spoilt, float((rounded * unit[:, 0] ** 2).max()))
    return None if not np.abs(λ).min() > SINGULAR else negative + int((λ < 0.0).sum()), spoilt


def _rounded(D: Array) -> Array:
    """Round-off of the stiffness of each node against translation."""
    return np.finfo(float).eps * np.abs(D[:, X, X]).max(axis=(1, 2))


def _whole(D: Array, U: Array, unit: Array) -> Array:
    """The few blocks that are left as one matrix, in units of their own."""
    n = len(D)
    whole = np.zeros((n, N_NODE, n, N_NODE))
    k = np.arange(n)
    whole[k, :, k] = D * unit[:, :, None] * unit[:, None]
    joint = U * unit[:-1, :, None] * unit[1:, None]
    whole[k[:-1], :, k[1:]] = joint
    whole[k[1:], :, k[:-1]] = np.swapaxes(joint, 1, 2)
    return whole.reshape(n * N_NODE, -1)


def _units(size: Array) -> Array:
    """Powers of two that make the blocks of one size: lengths double with every folding, shape (n, 7)."""
    unit = np.empty(size.shape[:2])
    x = 1.0 / np.sqrt(size[:, X, X].max(axis=(1, 2)))
    coupled = size[:, AXIAL, X].max(axis=1)
    unit[:, X] = x[:, None]
    unit[:, SPIN] = 1.0 / np.sqrt(size[:, SPIN, SPIN].max(axis=(1, 2)))[:, None]
    unit[:, AXIAL] = 1.0 / np.where(coupled > 0.0, coupled * x, np.sqrt(size[:, AXIAL, AXIAL]))
    return np.exp2(np.round(np.log2(unit)))


def _folded(D: Array, U: Array, inverse: Array, rounded: Array | None) -> tuple[Array, Array, Array | None]:
    """What is left when every second node is eliminated, and the round-off in it."""
    left, right = U[::2], np.swapaxes(U[1::2], 1, 2)
    n_right = len(right)
    from_left, from_right = left @ inverse, right @ inverse[:n_right]
    even, off = D[::2].copy(), None
    even[: len(left)] -= from_left @ np.swapaxes(left, 1, 2)
    even[1 : n_right + 1] -= from_right @ np.swapaxes(right, 1, 2)
    if rounded is not None:
        off = np.hypot(rounded[::2], _rounded(D[::2]))
        for beside, along in ((slice(len(left)), from_left), (slice(1, n_right + 1), from_right)):
            off[beside] = np.hypot(off[beside], _handed_on(along) * rounded[1::2][: len(along)])
    return even, -from_left[:n_right] @ np.swapaxes(right, 1, 2), off


def _handed_on(along: Array) -> Array:
    """Part of the round-off of an eliminated node that one beside it takes on.

    It moves along by some w, and so hands on w² of it. With √8, two that it follows by half take all of it, as errors
    add that know nothing of each other.
    """
    return np.sqrt(8.0) * np.square(np.abs(along[:, X, X]).sum(axis=2).max(axis=1))
