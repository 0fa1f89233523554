"""Off an unstable equilibrium, along the direction in which stability was lost, to the side where small steps lead.

Beyond a critical load S φ = λ φ has a negative λ, with S the stiffness of the equilibrium against moments on spins: φ
is the direction in which stability was lost. Lanczos' method for S⁻¹ finds it, begun with the spins s with which the
rods set out, and bounds its error by the last entries of its vectors.

Small steps lead to the side to which an imperfection ε pushes. In the energy ½ λ(b) a² + c a⁴ − ε a, whose λ falls
along the path b from λ₀, the rods set out by (ε/λ₀, b), to that side, while the unstable state lies at a = −ε/|λ|, on
the other. Its φ leans to the path as it lies off it, so that close to the critical load s seems to go to the wrong
side of φ; the way from the unstable state back to where the rods set out does not. Where these two go to different
sides, or to one by less than the error of φ, the side is unknown. Without an imperfection neither has a part along φ,
and the rods stay on their path, as they do in small steps.

Sources: Lanczos' method and its bounds: Golub & Van Loan, Matrix Computations, 4th ed., 10.1; energy near a point of
bifurcation: Koiter, On the Stability of Elastic Equilibrium, 1945.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np
from scipy.linalg import eigh_tridiagonal

from dolfinrod.continuum.softness import Softness

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.newton import Newton

    Array = NDArray[np.float64]

__all__ = ["AWAY", "Aside", "aside"]

# Largest turns of a section by which the state is left, one after the other [rad]. The energy −½ |λ| a² + c a⁴ has its
# bottom at some a₀, and Newton's method falls into it from beyond a₀/√3, where its tangent is positive. Rods that
# buckle turn by less than half a turn, but those whose ends are brought together only by what leaves room for them.
AWAY = tuple(float(np.pi / np.sqrt(3.0)) * 0.1**k for k in range(4))
# Most vectors of Lanczos' method, each of which costs a solution with factors: low modes of S are large ones of S⁻¹.
MOST = 10
# Part of a way that goes along the direction, over all of it and over 1 rad, below which its side is round-off: the
# root of that. A perfect column stays straight.
SEEN = float(np.sqrt(np.finfo(float).eps))
# Cosine beyond which more of a way leads along a direction than across it.
ALONG = float(np.sqrt(0.5))


@dataclass(frozen=True)
class Aside:
    """An unstable equilibrium, and the direction in which it may be left.

    Args:
        newton: That has found it.
        start: This rank's unknowns there.
        change: By which they change in that direction, with a largest turn of 1 rad.
        rotations: Of this rank's nodes there, shape (n, n_q).
        increment: By which these turn, in the unknowns of an increment, shape (n, n_spin).
        spins: The same in spins, shape (n, n_spin).
    """

    newton: Newton
    start: Array
    change: Array
    rotations: Array
    increment: Array
    spins: Array

    def leave(self, turn: float) -> None:
        """Push the problem off by a largest turn of a section [rad]."""
        problem, d = self.newton.problem, self.newton.problem.discretization
        problem.x[: len(self.start)] = self.start
        problem.x[: len(self.change)] += turn * self.change
        problem.x[d.owned_nodes("q")] = problem.kinematics.turn(self.rotations, turn * self.increment)
        d.x.x.scatter_forward()

    def reached(self) -> bool:
        """Whether the problem's present state lies in that direction, more along it than across.

        One that lies elsewhere belongs to another path.
        """
        problem = self.newton.problem
        comm, kin = problem.discretization.comm, problem.kinematics
        way = _spins(kin.spin(self.rotations), problem.x[problem.discretization.owned_nodes("q")] - self.rotations)
        along = _dot(comm, way, self.spins)
        return along > ALONG * np.sqrt(_dot(comm, way, way) * _dot(comm, self.spins, self.spins))


def aside(newton: Newton, last: Array) -> Aside | None:
    """Which way the unstable equilibrium where the problem is may be left.

    Args:
        newton: That has just found it.
        last: The equilibrium on this rank that it has set out from.

    Returns:
        The way; None where not one direction, but none or several are lost, or its side is not known.
    """
    problem, d, set_out = newton.problem, newton.problem.discretization, newton.set_out
    if set_out is None:
        return None
    q, x, kin = d.owned_nodes("q"), problem.x, problem.kinematics
    at = x[q]
    change = _direction(newton, (set_out, -_spins(kin.spin(last[q]), at - last[q])))
    if change is None:
        return None
    increment = kin.increment(at, change[q])
    largest = d.comm.allreduce(float(kin.angles(increment).max(initial=0.0)), op=MPI.MAX)
    change, increment = change / largest, increment / largest
    return Aside(newton, x.copy(), change, at, increment, _spins(kin.spin(at), increment))


def _direction(newton: Newton, ways: tuple[Array, Array]) -> Array | None:
    """Change of this rank's own unknowns in which stability was lost, to the side of both ways; None if unknown."""
    comm = newton.problem.discretization.comm
    far = np.sqrt([_dot(comm, way, way) for way in ways])
    if not far.min() > SEEN:
        return None
    units, least = [way / length for way, length in zip(ways, far, strict=True)], SEEN / np.minimum(far, 1.0)
    softness, lanczos, combined = Softness(newton), Lanczos(comm, units), None
    changes: list[Array] = []
    while combined is None and len(changes) < MOST and not lanczos.complete:
        change = softness.change(lanczos.newest)
        if change is None:
            break
        changes.append(change)
        lanczos.grow(softness.spins(change))
        combined = lanczos.lost(least)
    softness.close()
    # S⁻¹ turns round what stands in a direction that was lost.
    return None if combined is None else -np.tensordot(combined, changes, axes=1)


class Lanczos:
    """Orthonormal spins in which a symmetric operator on them is tridiagonal.

    Args:
        comm: Ranks that share the sections.
        ways: Unit vectors of which parts are asked for, shape (n, n_spin) each; begins with the first.

    Attributes:
        complete: Whether the operator leads nowhere else.
    """

    def __init__(self, comm: MPI.Comm, ways: list[Array]) -> None:
        self._comm, self._ways, self._basis = comm, ways, [ways[0]]
        self.complete = False
        self._diagonal: list[float] = []
        self._beside: list[float] = []
        self._along: list[list[float]] = []

    @property
    def newest(self) -> Array:
        """The vector that the operator is applied to next."""
        return self._basis[-1]

    def grow(self, image: Array) -> None:
        """Take in the image of the newest vector."""
        self._along.append([_dot(self._comm, way, self.newest) for way in self._ways])
        self._diagonal.append(_dot(self._comm, image, self.newest))
        whole = np.sqrt(_dot(self._comm, image, image))
        for known in 2 * self._basis:
            image = image - _dot(self._comm, image, known) * known
        self._beside.append(np.sqrt(_dot(self._comm, image, image)))
        self.complete = bool(self._beside[-1] <= np.finfo(float).eps * whole)
        if not self.complete:
            self._basis.append(image / self._beside[-1])

    def lost(self, least: Array) -> Array | None:
        """Parts of the vectors in the operator's negative direction, to the side of all ways.

        Args:
            least: Part of each way in that direction below which its side is not known, shape (ways,).

        Returns:
            The parts; None if not one direction is negative, or if not all ways are known to go to one side of it.
        """
        θ, y = eigh_tridiagonal(self._diagonal, self._beside[:-1])
        if (θ < 0.0).sum() != 1:
            return None
        error = self._beside[-1] * abs(y[-1, 0]) / -θ[0]
        parts = y[:, 0] @ np.array(self._along)
        side = np.sign(parts[0])
        return side * y[:, 0] if (side * parts > np.maximum(error, least)).all() else None


def _spins(spin: Array, change: Array) -> Array:
    """Spins of a change of rotations, shape (n, n_spin)."""
    return np.matmul(spin, change[:, :, None])[:, :, 0]


def _dot(comm: MPI.Comm, a: Array, b: Array) -> float:
    """Over all ranks."""
    return float(comm.allreduce(float(np.vdot(a, b))))
