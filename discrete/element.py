"""The paper's element: stiffness of a straight thin rod between two nodes, Eq. 12–17."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["stiffness"]


def stiffness(
    *, EA: ArrayLike, GI_p: ArrayLike, EI_v: ArrayLike, EI_w: ArrayLike, l: ArrayLike, F_n: ArrayLike = 0.0
) -> NDArray[np.float64]:
    """Stiffness [k*] of elements under an axial force, F* = k* Δ*.

    Bending in the plane u-v is Eq. 15 as printed (E I_w), the plane u-w its twin with θ_v = −dw/du (E I_v), tension
    is Eq. 16 and torsion Eq. 17. The axial force enters as F_n/l (a string): Eq. 13 puts the chord, not the deflected
    line, into the moment of F_n. End forces act on the element, positive along +u, +v, +w; F_n = −F_ui = F_uj.

    Args:
        EA: Axial stiffness E A, shape (n,) or scalar, like all others [N].
        GI_p: Torsional stiffness G I_p [N m²].
        EI_v: Bending stiffness about v [N m²].
        EI_w: Bending stiffness about w [N m²].
        l: Length of the element [m].
        F_n: Axial force, tension positive [N].

    Returns:
        Matrices, shape (n, 12, 12), rows and columns (u, v, w, θ_u, θ_v, θ_w) of node i, then of node j.
    """
    EA, GI_p, EI_v, EI_w, l, F_n = np.broadcast_arrays(*np.atleast_1d(EA, GI_p, EI_v, EI_w, l, F_n))
    k = np.zeros((len(l), 12, 12))
    for entry, pattern in (
        (EA / l, _AXIAL),
        (GI_p / l, _TORSION),
        (EI_w / l**3, _SHEAR_V),
        (EI_v / l**3, _SHEAR_W),
        (EI_w / l**2, _COUPLING_V),
        (EI_v / l**2, _COUPLING_W),
        (EI_w / l, _MOMENT_W),
        (EI_v / l, _MOMENT_V),
        (F_n / l, _STRING),
    ):
        k += entry[:, None, None] * pattern
    return k


def _pair(row_i: int, ii: float, ij: float) -> NDArray[np.float64]:
    """Equal and opposite (or equal) action of one degree of freedom at both nodes.

    Args:
        row_i: Index of the degree of freedom at node i.
        ii: Entry at (i, i) and (j, j).
        ij: Entry at (i, j) and (j, i).

    Returns:
        Pattern, shape (12, 12).
    """
    pattern = np.zeros((12, 12))
    pattern[row_i, row_i] = pattern[row_i + 6, row_i + 6] = ii
    pattern[row_i, row_i + 6] = pattern[row_i + 6, row_i] = ij
    return pattern


def _coupling(deflection: int, rotation: int, sign: float) -> NDArray[np.float64]:
    """Shear force from end rotations and, symmetrically, end moments from deflections: ±6EI/l².

    Args:
        deflection: Index of the deflection at node i.
        rotation: Index of the rotation at node i.
        sign: +1 in the plane u-v, −1 in the plane u-w.

    Returns:
        Pattern, shape (12, 12).
    """
    pattern = np.zeros((12, 12))
    for turned in (rotation, rotation + 6):
        pattern[deflection, turned] = pattern[turned, deflection] = 6.0 * sign
        pattern[deflection + 6, turned] = pattern[turned, deflection + 6] = -6.0 * sign
    return pattern


_AXIAL = _pair(0, 1.0, -1.0)
_TORSION = _pair(3, 1.0, -1.0)
_SHEAR_V, _SHEAR_W = _pair(1, 12.0, -12.0), _pair(2, 12.0, -12.0)
_MOMENT_V, _MOMENT_W = _pair(4, 4.0, 2.0), _pair(5, 4.0, 2.0)
_COUPLING_V, _COUPLING_W = _coupling(1, 5, 1.0), _coupling(2, 4, -1.0)
_STRING = _pair(1, 1.0, -1.0) + _pair(2, 1.0, -1.0)
