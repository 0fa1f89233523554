"""Rigid motions that no support resists: held by a phase condition where the loads do no work in them.

A rod between two pins may turn about the line through them, z; every turned state is an equilibrium as long as the
loads do no work in z, and the tangent is singular along it. One unknown that takes part in z is then held. Where the
loads do work in z, as in a pendulum held aslant, z is released and the iteration goes on from there. In vibrations z is
one of frequency zero, unless nothing that has inertia moves in it, as in the spin of a straight rod without ρI.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import qr

from discrete.unknowns import N_NODE, SPIN, X
from dolfinrod.scene.mechanism import named, null_space

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.equilibrium import Equilibrium
    from discrete.nodes import Tangent
    from discrete.state import Outcome, State

    Array = NDArray[np.float64]

__all__ = ["PhaseCondition"]

# Work of the loads in a unit motion, over their largest share in it, up to which they are balanced.
BALANCED = 1e-9
# Inertia of a unit motion, over the mass of the rods, that is none.
WEIGHTLESS = 1e-12
UNBALANCED = "the loads push a rod along a motion that no support resists, and no equilibrium was met that way"


class PhaseCondition:
    """Free rigid motions of the rods of a scene.

    Args:
        equilibrium: Solver of the scene.

    Attributes:
        equilibrium: As above.
        notes: What was held in the last state found, in words.
    """

    def __init__(self, equilibrium: Equilibrium) -> None:
        self.equilibrium = equilibrium
        self.notes: tuple[str, ...] = ()
        self._needed = any(len(z) for z in self._free(equilibrium.begin()))

    def find(self, state: State, t: float, trust: float = np.inf) -> Outcome:
        """Equilibrium with free motions held, and from there with those released along which the loads push.

        Args:
            state: First guess.
            t: Pseudo-time.
            trust: As for `Equilibrium.find`.

        Returns:
            How the attempt ended, all iterations counted.
        """
        if not self._needed:
            return self.equilibrium.find(state, t, trust)
        motions = self._free(state)
        self._hold(state, motions)
        found = self.equilibrium.find(state, t, trust)
        while found.converged and self._drop_pushed(found.state, t, motions):
            self._hold(found.state, motions)
            again = self.equilibrium.find(found.state, t)
            reason = again.reason if again.converged else UNBALANCED
            iterations, turned = found.iterations + again.iterations, found.turned + again.turned
            found = replace(again, iterations=iterations, turned=turned, reason=reason)
        words = (words for rod, z in enumerate(motions) for words in named(rod, z))
        self.notes = tuple(f"{motion}: balanced, held by a phase condition" for motion in words)
        return found

    def release(self, state: State, tangent: Tangent, M: Array) -> None:
        """Let go of all free motions that have inertia, and hold those that have none.

        Args:
            state: An equilibrium.
            tangent: There; says in which axes spins stand.
            M: Mass matrices of the nodes in these axes, shape (n_nodes, 7, 7).
        """
        first, motions = self.equilibrium.mesh.first, self._free(state)
        least = WEIGHTLESS * float(np.einsum("nii->", M[:, X, X]))
        for rod, z in enumerate(motions):
            moved = np.zeros((len(z), len(M), N_NODE))
            mine = slice(first[rod], first[rod + 1])
            moved[:, mine, np.r_[X, SPIN]] = np.einsum("mi,nij->mnj", z, _moved(state.x[mine]))
            moved = np.array([tangent.in_axes(one) for one in moved]).reshape(moved.shape)
            inertia, mix = np.linalg.eigh(np.einsum("ani,nij,bnj->ab", moved, M, moved))
            motions[rod] = mix[:, inertia <= least].T @ z
        self._hold(state, motions)

    def _free(self, state: State) -> list[Array]:
        """Rigid motions (v, ω) of each rod that leave its supported unknowns where they are, shape (n, 6)."""
        mesh = self.equilibrium.mesh
        nodes, rows = self.equilibrium.supports.resisted(state.R)
        moved = np.einsum("nij,nj->ni", _moved(state.x[nodes]), rows)
        of_rod = np.searchsorted(mesh.first, nodes, side="right") - 1
        return [null_space(moved[of_rod == rod]) for rod in range(len(mesh.s))]

    def _drop_pushed(self, state: State, t: float, motions: list[Array]) -> bool:
        """Take the motions in which the loads do work out of those held; whether there were any."""
        first = self.equilibrium.mesh.first
        loads = self.equilibrium.loads.level(t).at(state.R)
        pushed = False
        for rod, z in enumerate(motions):
            mine = slice(first[rod], first[rod + 1])
            acting = np.concatenate([loads[mine, X], loads[mine, SPIN]], axis=1)
            work = np.einsum("nij,nj->ni", _moved(state.x[mine]), acting)
            force, scale = z @ work.sum(axis=0), np.abs(work).max(initial=0.0)
            if np.abs(force).max(initial=0.0) > BALANCED * scale:
                motions[rod] = null_space(force[None]) @ z
                pushed = True
        return pushed

    def _hold(self, state: State, motions: list[Array]) -> None:
        """Hold as many unknowns of one node of each rod as it has motions to hold, those that move most in them."""
        first = self.equilibrium.mesh.first
        held = [np.zeros(0, dtype=np.int64)]
        for rod, z in enumerate(motions):
            # The spins of a guide stand in axes of its own.
            node = np.setdiff1d(np.arange(first[rod], first[rod + 1]), self.equilibrium.supports.guides.nodes)[0]
            if len(z):
                _, order = qr(z @ _moved(state.x[node]), mode="r", pivoting=True)
                held.append(node * N_NODE + order[: len(z)])
        self.equilibrium.hold(np.concatenate(held))


def _moved(x: Array) -> Array:
    """How nodes move in rigid motions: (e_i, 0), then (e_i × x, e_i); shapes (..., 3) and (..., 6, 6)."""
    moved = np.broadcast_to(np.eye(6), (*x.shape[:-1], 6, 6)).copy()
    moved[..., 3:, :3] = np.cross(np.eye(3), x[..., None, :])
    return moved
