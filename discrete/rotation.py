"""Finite rotations of many sections at once: rotation vectors, their exponentials and tangent maps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["coefficients", "cross", "eta", "exp", "log", "rate", "skew", "tangents", "turning"]

# Below this angle [rad] the coefficients are summed as series: the closed forms cancel there.
_SMALL = 0.5
# Below this square of the angle three terms are as good as all.
_TINY = 1e-3
_IDENTITY = np.eye(3)
# With the first two components repeated behind the last, every component finds its next two behind it.
_AROUND = np.array([0, 1, 2, 0, 1])
# η = Σ |B_2k| φ^(2k−2)/(2k)! with the Bernoulli numbers B_2k; its slope over φ term by term.
_ETA = (1 / 12, 1 / 720, 1 / 30240, 1 / 1209600, 1 / 47900160, 691 / 1307674368000, 1 / 74724249600)
_SLOPE = (*(2 * k * c for k, c in enumerate(_ETA[1:], 1)), 0.0)


def cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cross products a × b of rows; many times quicker than numpy.cross on short arrays.

    Args:
        a: Vectors, shape (n, 3).
        b: Vectors, shape (n, 3).

    Returns:
        Products, shape (n, 3).
    """
    a, b = a.T.take(_AROUND, axis=0), b.T.take(_AROUND, axis=0)
    product = a[1:4] * b[2:]
    product -= a[2:] * b[1:4]
    return product.T


def skew(a: NDArray[np.float64]) -> NDArray[np.float64]:
    """Matrix of the cross product, [a]× b = a × b.

    Args:
        a: Vectors, shape (..., 3).

    Returns:
        Antisymmetric matrices, shape (..., 3, 3).
    """
    matrix = np.zeros((*a.shape, 3))
    matrix[..., 2, 1] = a[..., 0]
    matrix[..., 0, 2] = a[..., 1]
    matrix[..., 1, 0] = a[..., 2]
    matrix[..., 1, 2] = -a[..., 0]
    matrix[..., 2, 0] = -a[..., 1]
    matrix[..., 0, 1] = -a[..., 2]
    return matrix


def exp(theta: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rotation about an axis by an angle of any size (Rodrigues).

    exp θ = I + (sin φ/φ) [θ]× + (1 − cos φ)/φ² [θ]×², φ = |θ|.

    Args:
        theta: Rotation vectors, shape (..., 3) [rad].

    Returns:
        Rotation matrices, shape (..., 3, 3).
    """
    square = np.einsum("...i,...i->...", theta, theta)
    half = 0.5 * np.sqrt(square)
    # sin x/x → 1 as x → 0: the tiny number only keeps 0/0 out.
    sinc_half = (np.sin(half) + 1e-300) / (half + 1e-300)
    quadratic = 0.5 * sinc_half**2
    matrix = skew((sinc_half * np.cos(half))[..., None] * theta)
    matrix += (quadratic[..., None] * theta)[..., :, None] * theta[..., None, :]
    matrix += (1.0 - quadratic * square)[..., None, None] * _IDENTITY
    return matrix


def log(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rotation vector of a rotation by less than half a turn.

    θ = (φ/sin φ) a with a the axial vector of the antisymmetric part, φ = atan2(|a|, (tr − 1)/2).

    Args:
        rotation: Rotation matrices, shape (..., 3, 3).

    Returns:
        Rotation vectors with |θ| < π, shape (..., 3) [rad].
    """
    axial = np.empty(rotation.shape[:-1])
    axial[..., 0] = rotation[..., 2, 1] - rotation[..., 1, 2]
    axial[..., 1] = rotation[..., 0, 2] - rotation[..., 2, 0]
    axial[..., 2] = rotation[..., 1, 0] - rotation[..., 0, 1]
    axial *= 0.5
    sine = np.sqrt(np.einsum("...i,...i->...", axial, axial))
    cosine = 0.5 * (np.einsum("...ii->...", rotation) - 1.0)
    # φ/sin φ → 1 as φ → 0: the tiny number only keeps 0/0 out.
    axial *= ((np.arctan2(sine, cosine) + 1e-300) / (sine + 1e-300))[..., None]
    return axial


def coefficients(square: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Coefficient η(φ) = (1 − (φ/2) cot(φ/2))/φ² of the tangent map, and η′(φ)/φ.

    Args:
        square: Squared angles φ² below (2π)² [rad²].

    Returns:
        Both coefficients, of the same shape.
    """
    largest = square.max(initial=0.0)
    terms = 3 if largest < _TINY else len(_ETA)
    eta, slope = _summed(_ETA[:terms], square), _summed(_SLOPE[:terms], square)
    large = square > _SMALL**2
    if largest > _SMALL**2:
        s = np.where(large, square, 1.0)
        angle = np.sqrt(s)
        sine = np.sin(0.5 * angle)
        eta = np.where(large, (1.0 - 0.5 * angle * np.cos(0.5 * angle) / sine) / s, eta)
        closed = (angle * (angle + np.sin(angle)) - 8.0 * sine**2) / (4.0 * s**2 * sine**2)
        slope = np.where(large, closed, slope)
    return eta, slope


def _summed(terms: tuple[float, ...], square: NDArray[np.float64]) -> NDArray[np.float64]:
    """Σ a_k φ^2k."""
    value = terms[-1] * square
    for a in terms[-2:0:-1]:
        value += a
        value *= square
    value += terms[0]
    return value


def eta(square: NDArray[np.float64]) -> NDArray[np.float64]:
    """Coefficient η of `tangents` alone, of squared angles below (2π)²."""
    largest = square.max(initial=0.0)
    value = _summed(_ETA[:3] if largest < _TINY else _ETA, square)
    if largest > _SMALL**2:
        half = 0.5 * np.sqrt(np.maximum(square, _SMALL**2))
        value = np.where(square > _SMALL**2, 0.25 * (1.0 - half * np.cos(half) / np.sin(half)) / half**2, value)
    return value


def rate(theta: NDArray[np.float64], spin: NDArray[np.float64]) -> NDArray[np.float64]:
    """Change of rotation vectors with spins, Θ(θ) φ = φ − ½ θ×φ + η (θ (θ·φ) − θ² φ).

    Args:
        theta: Rotation vectors, |θ| < 2π, shape (n, 3) [rad].
        spin: Spins φ, shape (n, 3).

    Returns:
        Shape (n, 3).
    """
    along = np.einsum("ni,ni->n", theta, spin)[:, None]
    square = np.einsum("ni,ni->n", theta, theta)[:, None]
    change = theta * along
    change -= square * spin
    change *= eta(square)
    change -= cross(0.5 * theta, spin)
    change += spin
    return change


def turning(theta: NDArray[np.float64]) -> NDArray[np.float64]:
    """Change of rotation vectors with spins, the matrices Θ of `tangents` alone.

    Args:
        theta: Rotation vectors, |θ| < 2π, shape (n, 3) [rad].

    Returns:
        Shape (n, 3, 3).
    """
    square = np.einsum("ni,ni->n", theta, theta)[:, None]
    η = eta(square)
    tangent = (η * theta)[:, :, None] * theta[:, None, :]
    tangent -= skew(0.5 * theta)
    tangent += (1.0 - η * square)[:, :, None] * _IDENTITY
    return tangent


def tangents(
    theta: NDArray[np.float64], moment: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Change of a rotation vector with the spin, and of the moment conjugate to the spin with the rotation vector.

    δθ = Θ(θ) φ where δ(exp θ) = [φ]× exp θ; the moment conjugate to φ is Θᵀμ. With (η, η′) of `coefficients`
    Θ = I − ½ [θ]× + η [θ]×², [θ]×² = θ θᵀ − φ² I,
    ∂(Θᵀμ)/∂θ = −½ [μ]× + η ((θ·μ) I + θ μᵀ − 2 μ θᵀ) + (η′/φ) (θ×(θ×μ)) θᵀ.

    Args:
        theta: Rotation vectors, |θ| < 2π, shape (..., 3) [rad].
        moment: Moments μ conjugate to θ, shape (..., 3).

    Returns:
        Θ and ∂(Θᵀμ)/∂θ, shapes (..., 3, 3).
    """
    along = np.einsum("...i,...i->...", theta, moment)[..., None]
    square = np.einsum("...i,...i->...", theta, theta)[..., None]
    eta, slope = coefficients(square)
    scaled = eta * theta
    tangent = scaled[..., :, None] * theta[..., None, :]
    tangent -= skew(0.5 * theta)
    tangent += (1.0 - eta * square)[..., None] * _IDENTITY
    swing = slope * (along * theta - square * moment) - 2.0 * eta * moment
    stiffness = swing[..., :, None] * theta[..., None, :]
    stiffness += scaled[..., :, None] * moment[..., None, :]
    stiffness -= skew(0.5 * moment)
    stiffness += (eta * along)[..., None] * _IDENTITY
    return tangent, stiffness
