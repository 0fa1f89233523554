"""Quaternions of section rotation, scalar first: as UFL expressions for forms, as NumPy arrays for nodes.

R(p) = [(w² − v·v) I + 2 v⊗v + 2 w v×] / |p|² with p = (w, v), homogeneous of degree zero, so a quaternion
interpolated between unit nodes needs no normalisation (Harsch & Eugster 2023, arXiv 2307.04554).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import ufl

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from ufl.core.expr import Expr

__all__ = [
    "cross",
    "crossed",
    "curvature",
    "divided",
    "exponential",
    "left",
    "logarithm",
    "multiply",
    "right",
    "rotate",
    "rotate_gradient",
    "rotation",
    "spin_to_rate",
]


# Half angles below which two terms of a series are exact to round-off [rad].
SMALL = 1e-2

# Row by row, the entry of Im(δp p̄) or Im(p̄ δp) as a matrix on δp is this component of p with this sign.
PLACES = np.eye(4)[[[1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]]]
LEFT, RIGHT = (
    np.ascontiguousarray((np.array(signs)[:, :, None] * PLACES).reshape(12, 4).T)
    for signs in (
        [[-1, 1, -1, 1], [-1, 1, 1, -1], [-1, -1, 1, 1]],
        [[-1, 1, 1, -1], [-1, -1, 1, 1], [-1, 1, -1, 1]],
    )
)
DIVIDED = np.concatenate([np.eye(4), RIGHT], axis=1)


def rotation(p: Expr) -> Expr:
    """Rotation matrix R(p) of a quaternion of any norm, UFL, shape (3, 3)."""
    w, x, y, z = (p[i] for i in range(4))
    Q = ufl.as_matrix(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )
    return Q / ufl.inner(p, p)


def curvature(p: Expr, p_s: Expr) -> Expr:
    """Curvature of the rotation field R(p(s)) in the rotated frame, 2 Im(p̄ p′)/|p|², UFL, shape (3,)."""
    w, v = p[0], ufl.as_vector([p[1], p[2], p[3]])
    w_s, v_s = p_s[0], ufl.as_vector([p_s[1], p_s[2], p_s[3]])
    return 2 * (w * v_s - w_s * v - ufl.cross(v, v_s)) / ufl.inner(p, p)


def cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """a × b of vectors in the last axis; on the few hundred nodes of a rod NumPy's own takes ten times as long."""
    c = np.empty(np.broadcast(a, b).shape)
    a_1, a_2, a_3 = a[..., 0], a[..., 1], a[..., 2]
    b_1, b_2, b_3 = b[..., 0], b[..., 1], b[..., 2]
    np.subtract(a_2 * b_3, a_3 * b_2, out=c[..., 0])
    np.subtract(a_3 * b_1, a_1 * b_3, out=c[..., 1])
    np.subtract(a_1 * b_2, a_2 * b_1, out=c[..., 2])
    return c


def crossed(a: NDArray[np.float64], columns: NDArray[np.float64]) -> NDArray[np.float64]:
    """a × each column, shapes (n, 3), (n, 3, k) → (n, 3, k)."""
    return np.swapaxes(cross(a[:, None, :], np.swapaxes(columns, 1, 2)), 1, 2)


def left(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """Im(δp p̄) as a matrix acting on δp: half the spatial spin, shape (n, 3, 4) for p of shape (n, 4)."""
    return (p @ LEFT).reshape(-1, 3, 4)


def right(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """Im(p̄ δp) as a matrix acting on δp: half the spin in the rotated frame, shape (n, 3, 4)."""
    return (p @ RIGHT).reshape(-1, 3, 4)


def divided(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """The turn from p on, p̄ q, as a matrix acting on q: the cosine of half of it, then `right`, shape (n, 4, 4)."""
    return (p @ DIVIDED).reshape(-1, 4, 4)


def multiply(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Product a b: first turn by b, then by a; shapes (..., 4)."""
    scalar = a[..., :1] * b[..., :1] - np.sum(a[..., 1:] * b[..., 1:], axis=-1, keepdims=True)
    vector = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + cross(a[..., 1:], b[..., 1:])
    return np.concatenate([scalar, vector], axis=-1)


def exponential(theta: NDArray[np.float64]) -> NDArray[np.float64]:
    """Quaternion (cos ½|θ|, sin ½|θ| θ/|θ|) of a rotation vector of any length, shapes (..., 3) → (..., 4)."""
    half = 0.5 * np.sqrt(np.sum(theta * theta, axis=-1, keepdims=True))
    return np.concatenate([np.cos(half), 0.5 * np.sinc(half / np.pi) * theta], axis=-1)


def logarithm(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rotation vector of unit quaternions, |θ| ≤ π, shape (n, 4) → (n, 3)."""
    p = np.where(p[:, :1] < 0.0, -p, p)
    sine = np.sqrt(np.einsum("ni,ni->n", p[:, 1:], p[:, 1:]))
    half = np.arctan2(sine, p[:, 0])
    ratio = np.divide(2.0 * half, sine, out=np.full_like(sine, 2.0), where=sine > 0.0)
    return np.asarray(ratio[:, None] * p[:, 1:])


def spin_to_rate(theta: NDArray[np.float64]) -> NDArray[np.float64]:
    """How a rotation vector changes with the spin of what it turned, δθ = T⁻¹ δω, shape (n, 3) → (n, 3, 3).

    T⁻¹ = 1 − ½ θ× + c (θ×)², c = (1 − ½ φ cot ½φ)/φ², φ = |θ|.
    """
    φ_2 = np.einsum("ni,ni->n", theta, theta)
    half = 0.5 * np.sqrt(φ_2)
    small = half < SMALL
    safe = np.where(small, 1.0, half)
    c = np.where(small, 1.0 / 12.0 + φ_2 / 720.0, (1.0 - safe / np.tan(safe)) / (4.0 * safe**2))
    across = crossed(theta, np.broadcast_to(np.eye(3), (len(theta), 3, 3)))
    return np.asarray(np.eye(3) - 0.5 * across + c[:, None, None] * (across @ across))


def rotate(p: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
    """R(p) v for unit quaternions, shapes (n, 4), (n, 3) → (n, 3)."""
    t = 2.0 * cross(p[..., 1:], v)
    return v + p[..., :1] * t + cross(p[..., 1:], t)


def rotate_gradient(p: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Derivative of R(p) v along the unit sphere, ∂(R v)/∂p δp = 2 Im(δp p̄) × R v, shape (n, 3, 4)."""
    spins = 2.0 * np.swapaxes(left(p), 1, 2)
    return np.swapaxes(cross(spins, rotate(p, v)[:, None, :]), 1, 2)
