"""Whether an equilibrium is stable: by the inertia of its tangent, or by eigenvalues where loads are not conservative.

A symmetric tangent is the second variation of the energy: stable is one without negative directions. Loads that follow
the section, and dead moments in space, have none. There K v = λ M v is asked for the λ nearest to zero. A negative real
part is a direction in which the rod gives way (divergence), real at a critical point; a complex λ otherwise is an
oscillation that grows (flutter). M is the mass of the rods, where they have none a uniform one. Two equal frequencies
split into a complex pair under the slightest unsymmetric load, but any damping holds that: growth up to `DAMPED` a
radian is not called flutter.

A motion that costs no energy is no direction in which the rod gives way: a round column that has buckled may turn
about its axis, and the eigenvalue zero has whatever sign round-off gives it. Such motions are found by the energy of
the strains, and σM lifts them off zero before signs are counted, σ being half of the next eigenvalue.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import SingularTangentError
from discrete.inertia import blocks, negative_directions
from discrete.krylov import ACCURATE, REAL, leading
from discrete.mass import at_nodes, densities, masses, uniform
from discrete.motions import cost_nothing
from discrete.touching import energetic
from discrete.unknowns import N_NODE, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.assembly import Inverse
    from discrete.mass import Masses
    from discrete.mesh import Mesh
    from discrete.nodes import Tangent
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]
    Complex = NDArray[np.complex128]

__all__ = ["Judge", "Verdict", "spectrum"]

# Largest difference from symmetry that round-off and the tolerance of the iteration leave, over the largest entry.
SYMMETRIC = 1e-7
# Growth of an oscillation per radian of its phase that a hundredth of the critical damping holds.
DAMPED = 0.01
# Part of 1/λ, over the largest, that round-off may turn negative.
SLIGHT = 1e-4
# Part of 1/λ, over the largest, that is round-off of zero.
NONE = 1e-14
# Accuracy of eigenvalues of which only the sign is asked for.
ROUGH = 1e-7
# Radius of gyration, in lengths, by which motions are compared in which a bent rod gives way by turning about itself.
THICK = 0.1
# Eigenvalues sought where the tangent is not symmetric, and directions in which a rod gives way otherwise.
SOUGHT = 4


@dataclass(frozen=True, eq=False)
class Verdict:
    """What is known of the stability of a state.

    Args:
        stable: None where the tangent is singular to round-off, or does not tell.
        directions: Number of directions in which it gives way without oscillating, up to `SOUGHT` where the tangent
            is not symmetric; None where it could not be counted.
        conservative: Whether the tangent is symmetric.
    """

    stable: bool | None
    directions: int | None
    conservative: bool

    @property
    def gives_way(self) -> bool:
        """Whether a critical point lies between it and a stable state."""
        return bool(self.directions)

    @property
    def counted(self) -> int | None:
        """Number of directions in which it gives way as a user reads it: None where it flutters."""
        return None if self.stable is False and self.directions == 0 else self.directions


class Judge:
    """Stability of the equilibria of a scene.

    Args:
        scene: The problem.
        mesh: Its nodes and elements.
    """

    def __init__(self, scene: Scene, mesh: Mesh) -> None:
        sections = [rod.section for rod in scene.rods]
        heavy = all(section.rhoA is not None for section in sections)
        self._judges = energetic(scene)
        self._masses = masses(mesh, *densities(sections)) if heavy else uniform(mesh)
        self._thick = uniform(mesh, THICK)

    def verdict(self, tangent: Tangent, R: Array) -> Verdict:
        """Judge a state.

        Args:
            tangent: There.
            R: Section frames there, shape (n_nodes, 3, 3).

        Returns:
            What could be said.
        """
        if not self._judges:
            return Verdict(None, None, False)
        symmetric = blocks(tangent)
        conservative = symmetric.asymmetry <= SYMMETRIC
        try:
            negative = negative_directions(symmetric)
            if negative != 0:
                lifted = self._lifted(tangent, R)
                negative = negative if lifted is tangent else negative_directions(blocks(lifted))
                tangent = lifted
            if conservative:
                return Verdict(None if negative is None else negative == 0, negative, True)
            return self._vibrating(tangent, R, negative)
        except SingularTangentError:
            return Verdict(None, None, conservative)

    def _vibrating(self, tangent: Tangent, R: Array, negative: int | None) -> Verdict:
        """From the vibrations nearest to rest; a positive definite symmetric part rules divergence out."""
        if negative != 0:
            λ, _ = _falling(tangent, R, self._masses, SOUGHT, ROUGH)
            if len(λ):
                return Verdict(False, int(_real(λ).sum()), False)
        λ, _ = spectrum(tangent, R, self._masses, SOUGHT, accuracy=ROUGH)
        s = np.sqrt(λ[(λ.real > 0.0) & ~_real(λ)])
        return Verdict(not (np.abs(s.imag) > DAMPED * s.real).any(), 0, False)

    def _lifted(self, tangent: Tangent, R: Array) -> Tangent:
        """K + σM where there are motions that cost no energy, K where there are none."""
        unit = 1.0 / float(self._masses.m.sum())
        λ, v = spectrum(tangent, R, self._masses, SOUGHT, shift=unit, accuracy=ROUGH)
        neutral = cost_nothing(tangent, v.real)
        if not neutral.any():
            return tangent
        σ = 0.5 * float(np.abs(λ[~neutral]).min(initial=unit))
        return replace(tangent, elements=tangent.elements + σ * self._masses.elements(R, tangent))

    def pushed(self, tangent: Tangent, R: Array, rate: Array) -> float:
        """How far the path leads in the directions in which the state gives way, in lengths of the rod.

        Zero where a symmetry keeps the loads from pushing the rod off a branch that has lost its stability.

        Args:
            tangent: Of a state that gives way.
            R: Section frames there.
            rate: Where the path leads from it, spins in the axes of the tangent, shape (n_nodes · 7,).

        Returns:
            Largest component of the rate along a mode, root mean square over the rod.
        """
        M = at_nodes(self._thick.elements(R, tangent), tangent)
        _, v = _falling(tangent, R, self._thick, SOUGHT)
        modes = v.real.T.reshape(-1, *M.shape[:2])
        path = rate.reshape(M.shape[:2])
        heavy = np.einsum("nij,nj->ni", M, path)
        whole = float(np.einsum("nii->", M[:, X, X])) / 3.0
        size = np.sqrt(np.einsum("ani,nij,anj->a", modes, M, modes) * whole)
        return float(np.max(np.abs(np.einsum("ani,ni->a", modes, heavy)) / size, initial=0.0))


def _real(λ: Complex) -> NDArray[np.bool_]:
    """Which are real but for round-off."""
    return np.abs(λ.imag) <= REAL * np.abs(λ)


def spectrum(
    tangent: Tangent, R: Array, mass: Masses, n: int, *, shift: float = 0.0, accuracy: float = ACCURATE
) -> tuple[Complex, Complex]:
    """Eigenpairs of K v = λ M v nearest to −shift, by the inverse of K + shift·M.

    Args:
        tangent: K.
        R: Section frames, shape (n_nodes, 3, 3).
        mass: M.
        n: How many.
        shift: Added so that rigid motions do not make it singular; positive.
        accuracy: Of 1/(λ + shift), over the largest.

    Returns:
        Values, ascending, and vectors, shape (n_unknowns, m), spins in the axes of the tangent.

    Raises:
        SingularTangentError: K + shift·M has no inverse.
    """
    compliance = _Compliance.of(tangent, R, mass, shift)
    θ, y, largest = leading(compliance.times, compliance.free, n, np.abs, accuracy)
    kept = np.abs(θ) > NONE * largest
    λ, v = 1.0 / θ[kept] - shift, compliance.motions(y[:, kept])
    order = np.argsort(λ.real, kind="stable")
    return λ[order], v[:, order]


def _falling(tangent: Tangent, R: Array, mass: Masses, n: int, accuracy: float = ACCURATE) -> tuple[Complex, Complex]:
    """Those with a negative real part, the ones nearest to zero; arguments as for `spectrum`."""
    compliance = _Compliance.of(tangent, R, mass, 0.0)
    θ, y, largest = leading(compliance.times, compliance.free, n, lambda θ: -θ.real, accuracy, SLIGHT)
    kept = θ.real < -SLIGHT * largest
    return 1.0 / θ[kept], compliance.motions(y[:, kept])


@dataclass(frozen=True, eq=False)
class _Compliance:
    """The operator M^½ (K + shift·M)⁻¹ M^½, symmetric if K is: no other vectors are as far from spurious eigenvalues.

    Args:
        inverse: Of K + shift·M.
        root: M^½ node by node, zero where unknowns are held, shape (n_nodes, 7, 7).
        free: Where vectors may differ from zero, shape (n_unknowns,).
    """

    inverse: Inverse
    root: Array
    free: NDArray[np.bool_]

    @classmethod
    def of(cls, tangent: Tangent, R: Array, mass: Masses, shift: float) -> _Compliance:
        """Operator of K, shift and M; SingularTangentError where there is no inverse."""
        elements = mass.elements(R, tangent)
        inverse = tangent.system.inverse(tangent.elements + shift * elements)
        free = np.ones(tangent.system.n_unknowns, dtype=bool)
        free[tangent.system.held] = False
        mine = free.reshape(-1, N_NODE)
        m, Q = np.linalg.eigh(at_nodes(elements, tangent) * (mine[:, :, None] & mine[:, None]))
        return cls(inverse, (Q * np.sqrt(np.maximum(m, 0.0))[:, None]) @ np.swapaxes(Q, 1, 2), free)

    def times(self, y: Array) -> Array:
        """Products with columns."""
        return self._weighed(self.inverse.times(self._weighed(y)))

    def motions(self, y: Complex) -> Complex:
        """Motions whose eigenvectors y are."""
        both = self.inverse.times(self._weighed(np.concatenate([y.real, y.imag], axis=1)))
        m = y.shape[1]
        v = both[:, :m] + 1j * both[:, m:]
        return np.asarray(v / np.maximum(np.linalg.norm(v, axis=0), np.finfo(float).tiny))

    def _weighed(self, y: Array) -> Array:
        return np.matmul(self.root, y.reshape(*self.root.shape[:2], -1)).reshape(y.shape)
