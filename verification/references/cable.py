"""Cables and the rods that tend to them: the (elastic) catenary, and Chebyshev collocation for finite EI.

Half a symmetric cable is seen from its lowest point, s ∈ [0, l], x to the side, y up. Its section carries
n = (H, w s), so that an unshearable rod obeys, with N = H cos θ + w s sin θ and Q = H sin θ − w s cos θ,

    EI θ″ = (1 + N/EA) Q,  θ(0) = 0,  r′ = (1 + N/EA) (cos θ, sin θ);

θ′(l) = 0 where the end is pinned, θ(l) = 0 where it is clamped level. EI → 0 leaves Q = 0, the catenary. A layer of
the width δ = √(EI/N) remains at the end: a pinned end bends it by an angle of order δ, which moves the rod by
order δ², as the bending stiffness of the rest does; a clamped end bends it by an angle of order 1, which moves the
rod by order δ.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.optimize import brentq

__all__ = ["Cable", "catenary", "catenary_tension"]

Array = NDArray[np.float64]

# Chebyshev coefficients of θ″: their nodes crowd at the end, where the layer is, and resolve it down to
# EI/(w L³) = 1e-6 where the end is pinned, 1e-4 where it is clamped.
TERMS = 96
MAX_ITERATIONS = 60
# Largest turn of a section in one iteration [rad].
LARGEST_TURN = 1.0


def catenary(tension: float, length: float, *, EA: float = np.inf) -> tuple[float, float]:
    """End of half an (elastic) catenary of weight 1 per length, seen from its lowest point.

    x = H asinh(l/H) + H l/EA,  y = √(H² + l²) − H + l²/(2 EA).

    Args:
        tension: Horizontal H [w].
        length: Unstretched length l of the half.
        EA: Axial stiffness [w]; infinite: inextensible.

    Returns:
        x and y.
    """
    H = tension
    x = H * np.arcsinh(length / H) + H * length / EA
    y = np.hypot(H, length) - H + 0.5 * length**2 / EA
    return float(x), float(y)


def catenary_tension(half_span: float, length: float, *, EA: float = np.inf) -> float:
    """Horizontal tension at which half a catenary of weight 1 per length spans so far.

    Args:
        half_span: x of its end.
        length: Unstretched length of the half.
        EA: Axial stiffness [w]; infinite: inextensible.

    Returns:
        H [w].
    """
    return float(
        brentq(lambda H: catenary(H, length, EA=EA)[0] - half_span, 1e-3 * length, 1e3 * length, xtol=1e-15, rtol=1e-15)
    )


@dataclass(frozen=True)
class Cable:
    """Half a sagging rod of weight 1 per length, from its lowest point to its end.

    Args:
        length: Of the half, l.
        EI: Bending stiffness [w].
        EA: Axial stiffness [w]; infinite: inextensible.
        clamped: Whether the end is held level; otherwise it is pinned.
        terms: Chebyshev coefficients.
    """

    length: float
    EI: float
    EA: float = np.inf
    clamped: bool = False
    terms: int = TERMS

    def under(self, tension: float, s: Array) -> Array:
        """Centreline under a horizontal tension.

        Args:
            tension: H [w].
            s: Arc lengths from the lowest point, shape (n,).

        Returns:
            x and y, shape (n, 2).
        """
        θ, H = self._solve(tension, None)
        return self._line(θ, H, s)

    def across(self, half_span: float, s: Array) -> Array:
        """Centreline with its end at a given x; arguments and return as for `under`."""
        θ, H = self._solve(catenary_tension(half_span, self.length, EA=self.EA), half_span)
        return self._line(θ, H, s)

    def _solve(self, tension: float, half_span: float | None) -> tuple[Array, float]:
        """θ at the nodes and H, from a level rod: its tension makes the first linear system well posed."""
        q, H = self._equilibrium(np.zeros(self.terms), tension, None)
        if half_span is not None:
            q, H = self._equilibrium(q, H, half_span)
        return self._scheme.to_angle @ q, H

    def _equilibrium(self, q: Array, H: float, half_span: float | None) -> tuple[Array, float]:
        """θ″ at the nodes and H by Newton's method; H is free where a span is asked for."""
        to_angle, w, V = self._scheme.to_angle, self._scheme.weights, self._scheme.nodes
        for _ in range(MAX_ITERATIONS):
            θ = to_angle @ q
            sin, cos = np.sin(θ), np.cos(θ)
            N, Q = H * cos + V * sin, H * sin - V * cos
            λ = 1.0 + N / self.EA
            matrix = np.zeros((self.terms + 1, self.terms + 1))
            matrix[:-1, :-1] = self.EI * np.eye(self.terms) - (λ * N - Q**2 / self.EA)[:, None] * to_angle
            matrix[:-1, -1] = -(λ * sin + cos * Q / self.EA)
            matrix[-1, -1], missing = 1.0, 0.0
            if half_span is not None:
                matrix[-1, :-1] = -(w * (λ * sin + cos * Q / self.EA)) @ to_angle
                matrix[-1, -1], missing = w @ cos**2 / self.EA, w @ (λ * cos) - half_span
            step = np.linalg.solve(matrix, np.append(self.EI * q - λ * Q, missing))
            # The first step from a level rod overshoots where the tension is small.
            turn = np.abs(to_angle @ step[:-1]).max()
            step *= min(1.0, LARGEST_TURN / turn) if turn else 1.0
            q, H = q - step[:-1], H - float(step[-1])
            if max(turn, abs(step[-1])) < 1e-13:
                return q, H
        raise ArithmeticError(f"no equilibrium of {self} in {MAX_ITERATIONS} iterations")

    def _line(self, θ: Array, H: float, s: Array) -> Array:
        """Points at arc lengths, from θ at the nodes."""
        λ = 1.0 + (H * np.cos(θ) + self._scheme.nodes * np.sin(θ)) / self.EA
        slopes = np.stack([λ * np.cos(θ), λ * np.sin(θ)], axis=1)
        series = integral(np.linalg.solve(self._scheme.values, slopes), self.length, start=0.0)
        return np.asarray(chebyshev.chebval(2.0 * s / self.length - 1.0, series).T)

    @property
    def _scheme(self) -> Scheme:
        return scheme(self.length, self.terms, self.clamped)


@dataclass(frozen=True, eq=False)
class Scheme:
    """Matrices of a collocation, the same for all stiffnesses.

    Args:
        nodes: Arc lengths at which the balance is asked for, shape (n,).
        values: Polynomials there, one a column, shape (n, n).
        to_angle: From θ″ to θ at the nodes, with the conditions at both ends, shape (n, n).
        weights: Of the integral over s, shape (n,).
    """

    nodes: Array
    values: Array
    to_angle: Array
    weights: Array


@cache
def scheme(length: float, terms: int, clamped: bool) -> Scheme:
    """The collocation of one length, number of terms and end."""
    x = chebyshev.chebpts1(terms)
    values = chebyshev.chebvander(x, terms - 1)
    once = integral(np.eye(terms), length, start=length)
    twice = integral(once, length, start=0.0)
    θ = chebyshev.chebvander(x, terms + 1) @ twice
    if clamped:
        θ -= np.outer(0.5 * (1.0 + x), twice.sum(axis=0))
    inverse = np.linalg.inv(values)
    whole = integral(np.eye(terms), length, start=0.0).sum(axis=0)
    return Scheme(0.5 * length * (1.0 + x), values, θ @ inverse, whole @ inverse)


def integral(series: Array, length: float, *, start: float) -> Array:
    """Series, one a column, of the integrals over s ∈ [0, length] from `start`."""
    scale = 0.5 * length
    return np.asarray(chebyshev.chebint(series, lbnd=start / scale - 1.0, scl=scale, axis=0))
