"""The element in its own frame: exact gradient and Hessian of its energy, whatever the rotation.

Measured from the chord both deflections vanish and the paper's [k*] (F_n = 0) leaves
U = ½ θᵀ k θ, θ = (θ_i, θ_j) the rotations of the ends relative to the element. The axial force enters as an unknown,
F_n ε − ½ F_n² l/EA with ε the elongation; turning it with the chord is the F_n/l of Eq. 15.
"""

from __future__ import annotations

from copy import copy
from typing import TYPE_CHECKING

import numpy as np

from discrete.endforces import conjugate, deformed, in_element, in_space
from discrete.endtangents import end_tangents
from discrete.rows import BLOCK, cross, dot, of_vectors
from discrete.unknowns import AXIAL, N_ELEMENT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Elements

    Array = NDArray[np.float64]

__all__ = ["ChordElement"]

# Rotations in [k*] component by component, and for each both ends.
_ROTATIONS = np.array([3, 9, 4, 10, 5, 11])


class ChordElement:
    """Element with its axis along the chord and transverse axes from the mean of the node triads.

    Args:
        elements: Natural lengths and stiffness of the elements.
        paper_strain: Whether Eq. 16 with Eq. 20 measures the elongation along the normal of node i, as printed;
            otherwise it is that of the chord, and forces are the exact gradient of an energy.
    """

    def __init__(self, elements: Elements, *, paper_strain: bool) -> None:
        self._k = np.ascontiguousarray(elements.k_star.transpose(1, 2, 0)[_ROTATIONS[:, None], _ROTATIONS])
        self._l_0, self._compliance = elements.l_0, elements.compliance
        self._paper_strain = paper_strain
        # Moments taken off those of the stiffness, shape (3, 2, n).
        self._behind: Array | float = 0.0

    def chord(self, u: Array, E: Array, F_n: Array) -> Array:
        """Chord e of direction u whose elongation obeys Eq. 16.

        Args:
            u: Directions, shape (n, 3).
            E: Triads attached to the ends, shape (n, 2, 3, 3).
            F_n: Axial forces, shape (n,).

        Returns:
            e, shape (n, 3).
        """
        length = self._l_0 + self._compliance * F_n
        if self._paper_strain:
            length = length / np.einsum("ni,ni->n", E[:, 0, :, 0], u)
        return length[:, None] * u

    def axial(self, N: Array, u: Array, E: Array) -> Array:
        """Axial force of a spatial force N, F_n = N·u; arguments and shapes as for `chord`."""
        return np.einsum("ni,ni->n", N, u)

    def measure(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and its strain energy.

        Args:
            e: Chords, shape (n, 3).
            E: Triads attached to the ends, parallel to the element in the reference, shape (n, 2, 3, 3).
            F_n: Axial forces, shape (n,).

        Returns:
            Forces and moments at both ends in global axes, in between the defect of Eq. 16, ε − F_n l/EA, shape
            (n, 13); ½ F_n² l/EA + ½ θᵀ k θ, shape (n,).
        """
        e, E = of_vectors(e), _by_rows(E)
        d = deformed(e, E)
        μ = self._moments(d.θ) - self._behind
        force = in_space(d, in_element(d, conjugate(d, μ), F_n))
        stretch = self._compliance * F_n
        force[AXIAL] = self._reach(d.length, e, E) - self._l_0 - stretch
        stretch *= F_n
        stretch += np.einsum("ian,ian->n", μ, d.θ)
        stretch *= 0.5
        return force.T, stretch

    def respond(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and their derivative, shape (n, 13, 13); otherwise as `measure`."""
        n = len(F_n)
        if n <= BLOCK:
            return self._respond(e, E, F_n)
        force, tangent = np.empty((n, N_ELEMENT)), np.empty((n, N_ELEMENT, N_ELEMENT))
        for first in range(0, n, BLOCK):
            few = slice(first, first + BLOCK)
            force[few], tangent[few] = self._few(few)._respond(e[few], E[few], F_n[few])
        return force, tangent

    def _few(self, few: slice) -> ChordElement:
        """Some of the elements."""
        other = copy(self)
        other._k, other._compliance, other._l_0 = self._k[..., few], self._compliance[few], self._l_0[few]
        other._behind = self._behind[..., few] if isinstance(self._behind, np.ndarray) else self._behind
        return other

    def _respond(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """The same of so few elements that what comes in between stays in the processor's memory."""
        e, E = of_vectors(e), _by_rows(E)
        d = deformed(e, E)
        μ = self._moments(d.θ) - self._behind
        m = conjugate(d, μ)
        f = in_element(d, m, F_n)
        force = in_space(d, f)
        force[AXIAL] = self._reach(d.length, e, E) - self._l_0 - self._compliance * F_n
        return force.T, end_tangents(d, μ, m, f, self._k, (*self._reaching(d.axes[:, 0], e, E), self._compliance))

    def strains(self, e: Array, E: Array) -> tuple[Array, Array]:
        """Rotations of the ends relative to the element, shape (n, 2, 3), and elongations; arguments as `measure`."""
        e, E = of_vectors(e), _by_rows(E)
        d = deformed(e, E)
        return d.θ.transpose(2, 1, 0), self._reach(d.length, e, E) - self._l_0

    def moments(self, θ: Array) -> Array:
        """Moments k θ that go with rotations of the ends, shape (n, 2, 3)."""
        return self._moments(np.ascontiguousarray(θ.transpose(2, 1, 0))).transpose(2, 1, 0)

    def changed(self, stiffness: Array, l_0: Array, behind: Array) -> ChordElement:
        """The element with another law.

        Args:
            stiffness: What all its stiffness is multiplied by, shape (n,).
            l_0: Natural lengths of the chords, shape (n,).
            behind: Moments taken off those of the stiffness, shape (n, 2, 3).
        """
        other = copy(self)
        other._k, other._compliance, other._l_0 = self._k * stiffness, self._compliance / stiffness, l_0
        other._behind = behind.transpose(2, 1, 0)
        return other

    def _moments(self, θ: Array) -> Array:
        """The same by rows, shape (3, 2, n)."""
        return np.einsum("abn,bn->an", self._k, θ.reshape(6, -1)).reshape(θ.shape)

    def _reach(self, length: Array, e: Array, E: Array) -> Array:
        """Length that the elongation is measured from, shape (n,)."""
        return dot(E[:, 0, 0], e) if self._paper_strain else length

    def _reaching(self, u: Array, e: Array, E: Array) -> tuple[Array, Array]:
        """Its derivatives by the chord and by the spin of node i, shapes (3, n)."""
        if not self._paper_strain:
            return u, np.zeros_like(u)
        normal = E[:, 0, 0]
        return normal, cross(normal, e)


def _by_rows(E: Array) -> Array:
    """Triads of shape (n, 2, 3, 3) → (3, 3, 2, n); the same memory where it is by rows already."""
    return np.ascontiguousarray(E.transpose(2, 3, 1, 0))
