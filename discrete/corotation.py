"""The element in its own frame: exact gradient and Hessian of its energy, whatever the rotation.

Measured from the chord both deflections vanish and the paper's [k*] (F_n = 0) leaves
U = ½ θᵀ k θ, θ = (θ_i, θ_j) the rotations of the ends relative to the element. The axial force enters as an unknown,
F_n ε − ½ F_n² l/EA with ε the elongation; turning it with the chord is the F_n/l of Eq. 15.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.frames import element_frame
from discrete.rotation import cross, log, skew, tangents
from discrete.unknowns import AXIAL, N_ELEMENT, SPIN_I, SPIN_J, X_I, X_J

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.frames import ElementFrame
    from discrete.mesh import Elements

    Array = NDArray[np.float64]

__all__ = ["ChordElement"]

_ROTATIONS = np.array([3, 4, 5, 9, 10, 11])
# Order of what moves an element in its own frame: (φ_i, δe, φ_j), the last two as they stand among the unknowns.
_I, _E, _J = slice(0, 3), slice(3, 6), slice(6, 9)
_AT_J = slice(X_J.start, SPIN_J.stop)


class ChordElement:
    """Element with its axis along the chord and transverse axes from the mean of the node triads.

    Args:
        elements: Natural lengths and stiffness of the elements.
        paper_strain: Whether Eq. 16 with Eq. 20 measures the elongation along the normal of node i, as printed;
            otherwise it is that of the chord, and forces are the exact gradient of an energy.
    """

    def __init__(self, elements: Elements, *, paper_strain: bool) -> None:
        self._k = np.ascontiguousarray(elements.k_star[:, _ROTATIONS[:, None], _ROTATIONS])
        self._l_0, self._compliance = elements.l_0, elements.compliance
        self._paper_strain = paper_strain

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
        frame = element_frame(e, E)
        θ, μ = self._bent(frame)
        Θ, _ = tangents(θ, μ)
        f = _Spin(frame, np.matmul(μ[:, :, None], Θ)[:, :, 0]).forces()
        f[:, 1, 0] = F_n
        energy = 0.5 * (self._compliance * F_n**2 + np.einsum("nai,nai->n", θ, μ))
        return self._turned(frame, f, E, F_n), energy

    def respond(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and their derivative, shape (n, 13, 13); otherwise as `measure`."""
        frame = element_frame(e, E)
        θ, μ = self._bent(frame)
        Θ, N = tangents(θ, μ)
        spin = _Spin(frame, np.matmul(μ[:, :, None], Θ)[:, :, 0])
        f = spin.forces()
        f[:, 1, 0] = F_n
        return self._turned(frame, f, E, F_n), self._tangent(frame, spin, f, Θ, N, E)

    def strains(self, e: Array, E: Array) -> tuple[Array, Array]:
        """Rotations of the ends relative to the element, shape (n, 2, 3), and elongations; arguments as `measure`."""
        frame = element_frame(e, E)
        return log(frame.turned), self._reach(frame, E) - self._l_0

    def moments(self, θ: Array) -> Array:
        """Moments k θ that go with rotations of the ends, shape (n, 2, 3)."""
        return np.matmul(self._k, θ.reshape(-1, 6, 1)).reshape(θ.shape)

    def _bent(self, frame: ElementFrame) -> tuple[Array, Array]:
        """Rotations of the ends relative to the element, and the moments that go with them, shapes (n, 2, 3)."""
        θ = log(frame.turned)
        return θ, self.moments(θ)

    def _reach(self, frame: ElementFrame, E: Array) -> Array:
        """Length that the elongation is measured from, shape (n,)."""
        if not self._paper_strain:
            return frame.length
        return frame.length * np.einsum("ni,ni->n", E[:, 0, :, 0], frame.axes[:, :, 0])

    def _turned(self, frame: ElementFrame, f: Array, E: Array, F_n: Array) -> Array:
        """Forces in global axes with the defect of Eq. 16 among them."""
        force = np.empty((len(f), N_ELEMENT))
        turned = np.matmul(f, np.swapaxes(frame.axes, 1, 2))
        force[:, SPIN_I], force[:, X_J], force[:, SPIN_J] = turned[:, 0], turned[:, 1], turned[:, 2]
        force[:, X_I] = -turned[:, 1]
        force[:, AXIAL] = self._reach(frame, E) - self._l_0 - self._compliance * F_n
        return force

    def _tangent(self, frame: ElementFrame, spin: _Spin, f: Array, Θ: Array, N: Array, E: Array) -> Array:
        """Derivative of the forces, Xᵀ C X − [f]× G − (Q/L) uᵀ with X the spin of the ends relative to the frame.

        C = Θᵀ k Θ + N Θ − ρ Γ: stiffness, change of the conjugate moments, change of the mean frame. Everything is
        gathered in one product of two stacks of rows, over (φ_i, δe, φ_j) in global axes.
        """
        n = len(f)
        T_t = np.swapaxes(frame.axes, 1, 2)
        rows, change = np.zeros((n, 10, 9)), np.zeros((n, 10, 9))
        G = spin.map()
        X = rows[:, :6]
        X[:, :3] = X[:, 3:] = -G
        X[:, :3, _I] += T_t
        X[:, 3:, _J] += T_t
        np.matmul(self._curvature(Θ, N @ Θ - spin.curving()), X, out=change[:, :6])
        turning = np.matmul(skew(f), T_t[:, None])
        rows[:, 6:9, _I], rows[:, 6:9, _E], rows[:, 6:9, _J] = turning[:, 0], turning[:, 1], turning[:, 2]
        change[:, 6:9] = G
        rows[:, 9, _E] = np.matmul(f[:, 1:2, 1:], T_t[:, 1:])[:, 0] / -frame.length[:, None]
        change[:, 9, _E] = frame.axes[:, :, 0]
        K = np.empty((n, N_ELEMENT, N_ELEMENT))
        self._expand(np.matmul(np.swapaxes(rows, 1, 2), change), K)
        self._axial_lines(K, frame, E)
        return K

    @staticmethod
    def _expand(K_9: Array, K: Array) -> None:
        """From (φ_i, δe, φ_j) to all unknowns, δe = x_j − x_i; the lines of F_n are left as they are."""
        K[:, SPIN_I, SPIN_I], K[:, SPIN_I, _AT_J] = K_9[:, _I, _I], K_9[:, _I, 3:]
        K[:, _AT_J, SPIN_I], K[:, _AT_J, _AT_J] = K_9[:, 3:, _I], K_9[:, 3:, 3:]
        K[:, :, X_I] = -K[:, :, X_J]
        K[:, X_I] = -K[:, X_J]

    def _axial_lines(self, K: Array, frame: ElementFrame, E: Array) -> None:
        """Row and column of F_n: direction of the force, change of the elongation, compliance."""
        u = frame.axes[:, :, 0]
        K[:, AXIAL] = K[:, :, AXIAL] = 0.0
        K[:, X_J, AXIAL], K[:, X_I, AXIAL] = u, -u
        normal = E[:, 0, :, 0] if self._paper_strain else u
        K[:, AXIAL, X_J], K[:, AXIAL, X_I] = normal, -normal
        if self._paper_strain:
            K[:, AXIAL, SPIN_I] = cross(normal, u * frame.length[:, None])
        K[:, AXIAL, AXIAL] = -self._compliance

    def _curvature(self, Θ: Array, geometric: Array) -> Array:
        """Θᵀ k Θ + geometric part, shape (n, 6, 6)."""
        ΘΘ = np.zeros((len(Θ), 6, 6))
        ΘΘ[:, :3, :3], ΘΘ[:, 3:, 3:] = Θ[:, 0], Θ[:, 1]
        C = np.matmul(np.swapaxes(ΘΘ, 1, 2), np.matmul(self._k, ΘΘ))
        C[:, :3, :3] += geometric[:, 0]
        C[:, 3:, 3:] += geometric[:, 1]
        return C


class _Spin:
    """Spin ω_T of the element frame as the nodes move, in element axes.

    Under a change δe of the chord and spins φ_a of the nodes, all in element axes: ω₂ = −δe₃/L, ω₃ = δe₂/L and, since
    v and w follow the mean of the triads Λ_a = Tᵀ E_a,
    ω₁ = (σ₂ ω₂ + σ₃ ω₃ + Σ g_a·φ_a)/c, g_a = (Λ₂₂ + Λ₃₃, −Λ₁₂, −Λ₁₃)_a, (c, −σ₂, −σ₃) = Σ g_a.

    Args:
        frame: The element frame.
        m: Moments at the ends conjugate to the spin, shape (n, 2, 3).
    """

    def __init__(self, frame: ElementFrame, m: Array) -> None:
        self._frame, self._m = frame, m
        Λ = frame.turned
        g = np.empty_like(m)
        g[:, :, 0] = Λ[:, :, 1, 1] + Λ[:, :, 2, 2]
        g[:, :, 1:] = -Λ[:, :, 0, 1:]
        total = g[:, 0] + g[:, 1]
        self._γ = g / total[:, None, :1]
        self._σ = -total[:, 1:] / total[:, :1]
        self._ρ = (m[:, 0, 0] + m[:, 1, 0]) / total[:, 0]
        self._g = g

    def forces(self) -> Array:
        """Moment at i, shear force of the chord, moment at j, in element axes, shape (n, 3, 3).

        Virtual work of the moments is Σ m_a·(φ_a − ω_T).
        """
        m, total = self._m, self._m[:, 0] + self._m[:, 1]
        bending = total[:, 1:] + total[:, :1] * self._σ
        f = np.empty((len(m), 3, 3))
        f[:, ::2] = m - self._ρ[:, None, None] * self._g
        f[:, 1, 0] = 0.0
        f[:, 1, 1] = -bending[:, 1] / self._frame.length
        f[:, 1, 2] = bending[:, 0] / self._frame.length
        return f

    def map(self) -> Array:
        """Spin of the frame per (φ_i, δe, φ_j) in global axes, shape (n, 3, 9)."""
        T = self._frame.axes
        G = np.zeros((len(T), 3, 9))
        chord = G[:, :, _E]
        chord[:, 1] = T[:, :, 2] / -self._frame.length[:, None]
        chord[:, 2] = T[:, :, 1] / self._frame.length[:, None]
        chord[:, 0] = self._σ[:, :1] * chord[:, 1] + self._σ[:, 1:] * chord[:, 2]
        mean = np.matmul(self._γ, np.swapaxes(T, 1, 2))
        G[:, 0, _I], G[:, 0, _J] = mean[:, 0], mean[:, 1]
        return G

    def curving(self) -> Array:
        """ρ Γ with Γ_a = ∂g_a/∂(relative spin) and ρ = Σm₁/c, shape (n, 2, 3, 3)."""
        Λ = self._frame.turned
        Γ = np.empty_like(Λ)
        Γ[..., 0, 0] = Λ[..., 1, 2] - Λ[..., 2, 1]
        Γ[..., 0, 1] = -Λ[..., 0, 2]
        Γ[..., 0, 2] = Λ[..., 0, 1]
        Γ[..., 1:, 0] = 0.0
        Γ[..., 1:, 1] = -Λ[..., 2, 1:]
        Γ[..., 1:, 2] = Λ[..., 1, 1:]
        return self._ρ[:, None, None, None] * Γ
