"""The element in the frame of its node i, Eq. 18–22: as printed, and completed to the gradient of an energy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.frames import deformation, direction_cosines
from discrete.rotation import cross, skew, tangents
from discrete.unknowns import AXIAL, N_ELEMENT, SPIN_I, SPIN_J, X_I, X_J

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Elements

    Array = NDArray[np.float64]

__all__ = ["EnergyNodeElement", "PaperElement"]

_E, _I, _J = slice(0, 3), slice(3, 6), slice(6, 9)
# (e, φ_i, φ_j) from the unknowns of an element: e = x_j − x_i.
_FROM_UNKNOWNS = np.zeros((9, N_ELEMENT))
_FROM_UNKNOWNS[_E, X_J] = _FROM_UNKNOWNS[_I, SPIN_I] = _FROM_UNKNOWNS[_J, SPIN_J] = np.eye(3)
_FROM_UNKNOWNS[_E, X_I] = -np.eye(3)


class _NodeElement:
    """What both elements share: deformation seen from node i, its changes, and turning into global axes.

    Args:
        elements: Natural lengths and stiffness of the elements.
    """

    def __init__(self, elements: Elements) -> None:
        self._l, self._l_0, self._compliance = elements.l, elements.l_0, elements.compliance
        # The axial force is an unknown of its own, the elongation is not to resist twice.
        self._k = elements.k_star.copy()
        self._k[:, [0, 0, 6, 6], [0, 6, 0, 6]] = 0.0

    def _energy(self, δ: Array, F_n: Array) -> Array:
        """Strain energy ½ F_n² l/EA + ½ δᵀ k δ, shape (n,)."""
        return 0.5 * (self._compliance * F_n**2 + np.einsum("ni,nij,nj->n", δ, self._k[:, 6:, 6:], δ))

    def _deformation(self, e: Array, E: Array) -> Array:
        A = direction_cosines(E)
        return deformation(e, A[:, 0], A[:, 1], self._l_0)

    def _change(self, δ: Array) -> Array:
        """Spin and stretch seen from node i per (δe, φ_i, φ_j), axes of node i, shape (n, 6, 9)."""
        X = np.zeros((len(δ), 6, 9))
        place = δ[:, :3].copy()
        place[:, 0] += self._l_0
        X[:, :3, _E] = X[:, 3:, _J] = np.eye(3)
        X[:, :3, _I] = skew(place)
        X[:, 3:, _I] = -np.eye(3)
        return X

    @staticmethod
    def _turned(T: Array, f: Array, K: Array) -> tuple[Array, Array]:
        """Forces and tangent in global axes; the frame turns with node i, which adds −[f]× φ_i."""
        n = len(T)
        K[:, :, _I] -= skew(f.reshape(n, 3, 3)).reshape(n, 9, 3)
        K = np.matmul(T[:, None, None], K.reshape(n, 3, 3, 3, 3).swapaxes(2, 3))
        K = np.matmul(K, np.swapaxes(T, 1, 2)[:, None, None]).swapaxes(2, 3).reshape(n, 9, 9)
        force = np.matmul(f.reshape(n, 3, 3), np.swapaxes(T, 1, 2)).reshape(n, 9)
        return force @ _FROM_UNKNOWNS, _FROM_UNKNOWNS.T @ K @ _FROM_UNKNOWNS


class EnergyNodeElement(_NodeElement):
    """Frame of node i, elongation of the chord: the gradient of U = F_n ε − ½ F_n² l/EA + ½ δᵀ k δ."""

    def chord(self, u: Array, E: Array, F_n: Array) -> Array:
        """Chord e of direction u whose elongation obeys Eq. 16; as in `ChordElement`."""
        return (self._l_0 + self._compliance * F_n)[:, None] * u

    def axial(self, N: Array, u: Array, E: Array) -> Array:
        """Axial force of a spatial force N = F_n u + Q, Q normal to the axis of node i; as in `ChordElement`."""
        normal = E[:, 0, :, 0]
        return np.einsum("ni,ni->n", N, normal) / np.einsum("ni,ni->n", u, normal)

    def measure(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and its strain energy; arguments and shapes as in `ChordElement.measure`."""
        return self.respond(e, E, F_n)[0], self._energy(self._deformation(e, E), F_n)

    def respond(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and their derivative; arguments and shapes as in `ChordElement.respond`."""
        δ, T = self._deformation(e, E), E[:, 0]
        q = np.matmul(self._k[:, 6:, 6:], δ[:, :, None])[:, :, 0]
        Θ, N = tangents(δ[:, 3:], q[:, 3:])
        place = δ[:, :3].copy()
        place[:, 0] += self._l_0
        m = np.matmul(q[:, None, 3:], Θ)[:, 0]
        f = np.concatenate([q[:, :3], -cross(place, q[:, :3]) - m, m], axis=1)
        C = self._k[:, 6:, 6:].copy()
        C[:, :, 3:] = C[:, :, 3:] @ Θ
        C[:, 3:] = np.swapaxes(Θ, 1, 2) @ C[:, 3:]
        C[:, 3:, 3:] += N @ Θ
        X = self._change(δ)
        K = np.swapaxes(X, 1, 2) @ (C @ X)
        K[:, _I] += skew(q[:, :3]) @ X[:, :3]
        force, tangent = self._turned(T, f, K)
        self._stretch(force, tangent, e, F_n)
        return force, tangent

    def _stretch(self, force: Array, tangent: Array, e: Array, F_n: Array) -> None:
        """Axial force along the chord: F_n n, its turning F_n (I − n nᵀ)/L and Eq. 16."""
        length = np.sqrt(np.einsum("ni,ni->n", e, e))
        along = np.zeros_like(force)
        along[:, X_J] = e / length[:, None]
        along[:, X_I] = -along[:, X_J]
        n = along[:, X_J]
        turning = (F_n / length)[:, None, None] * (np.eye(3) - n[:, :, None] * n[:, None])
        for row, column, sign in ((X_I, X_I, 1), (X_J, X_J, 1), (X_I, X_J, -1), (X_J, X_I, -1)):
            tangent[:, row, column] += sign * turning
        force += F_n[:, None] * along
        tangent[:, AXIAL] += along
        tangent[:, :, AXIAL] += along
        force[:, AXIAL] = length - self._l_0 - self._compliance * F_n
        tangent[:, AXIAL, AXIAL] = -self._compliance


class PaperElement(_NodeElement):
    """Eq. 18–22 to the letter: {F} = [t]ᵀ [k*(F_n)] {0, δ_e} in the frame of node i, F_n from Eq. 16.

    No energy stands behind it. Eq. 15 balances its moments about v and w up to δ_u times the shear force, but Eq. 17
    leaves out the torque δ_v F_w − δ_w F_v of the shear force about u: with δ = κ l²/2 a rod in space lacks a couple
    κ l F/2 per length and converges with l only, in a plane with l².
    """

    def chord(self, u: Array, E: Array, F_n: Array) -> Array:
        """Chord e of direction u whose elongation along the axis of node i obeys Eq. 16; as in `ChordElement`."""
        length = (self._l_0 + self._compliance * F_n) / np.einsum("ni,ni->n", E[:, 0, :, 0], u)
        return length[:, None] * u

    def axial(self, N: Array, u: Array, E: Array) -> Array:
        """Axial force F_uj of a spatial force N, along the axis of node i; as in `ChordElement`."""
        return np.einsum("ni,ni->n", N, E[:, 0, :, 0])

    def measure(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and its strain energy; arguments and shapes as in `ChordElement.measure`."""
        return self.respond(e, E, F_n)[0], self._energy(self._deformation(e, E), F_n)

    def respond(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and their derivative; arguments and shapes as in `ChordElement.respond`."""
        δ, T = self._deformation(e, E), E[:, 0]
        C = self._k[:, [6, 7, 8, 3, 4, 5, 9, 10, 11], 6:]
        string = F_n / self._l
        C[:, 1, 1] += string
        C[:, 2, 2] += string
        f = np.matmul(C, δ[:, :, None])[:, :, 0]
        f[:, 0] += F_n
        Θ, _ = tangents(δ[:, 3:], np.zeros_like(δ[:, 3:]))
        C[:, :, 3:] = C[:, :, 3:] @ Θ
        force, tangent = self._turned(T, f, C @ self._change(δ))
        along = np.zeros((len(δ), 3))
        along[:, 0] = 1.0
        along[:, 1:] = δ[:, 1:3] / self._l[:, None]
        along = np.matmul(T, along[:, :, None])[:, :, 0]
        tangent[:, X_J, AXIAL], tangent[:, X_I, AXIAL] = along, -along
        normal = T[:, :, 0]
        tangent[:, AXIAL, X_J], tangent[:, AXIAL, X_I] = normal, -normal
        tangent[:, AXIAL, SPIN_I] = cross(normal, e)
        force[:, AXIAL] = δ[:, 0] - self._compliance * F_n
        tangent[:, AXIAL, AXIAL] = -self._compliance
        return force, tangent
