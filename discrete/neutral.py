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

from discrete.landing import landed
from discrete.unknowns import AXIAL, N_NODE, SPIN, X
from dolfinrod.scene.mechanism import named, null_space

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.equilibrium import Equilibrium
    from discrete.nodes import Tangent
    from discrete.state import Outcome, State
    from discrete.surroundings import Surroundings
    from discrete.touched import Touched

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
        self._needed = any(len(z) for z in self.free(equilibrium.begin(), None))

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
        contacts = self.equilibrium.contacts
        if contacts is not None and not contacts.met:
            state = landed(state, self.equilibrium.mesh, _Pushed(self, contacts, t))
        motions = self.free(state, self.touched(state, t))
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

    def touched(self, state: State, t: float) -> Touched | None:
        """Resistance of surfaces in a state at a pseudo-time."""
        contacts = self.equilibrium.contacts
        if contacts is None:
            return None
        contacts.at(state.x, state.R, t)
        return contacts.blocks()

    def release(self, state: State, tangent: Tangent, M: Array) -> None:
        """Let go of all free motions that have inertia, and hold those that have none.

        Args:
            state: An equilibrium.
            tangent: There; says in which axes spins stand.
            M: Mass matrices of the nodes in these axes, shape (n_nodes, 7, 7).
        """
        first, motions = self.equilibrium.mesh.first, self.free(state, tangent.touched)
        least = WEIGHTLESS * float(np.einsum("nii->", M[:, X, X]))
        for rod, z in enumerate(motions):
            moved = np.zeros((len(z), len(M), N_NODE))
            mine = slice(first[rod], first[rod + 1])
            moved[:, mine, np.r_[X, SPIN]] = np.einsum("mi,nij->mnj", z, _moved(state.x[mine]))
            moved = np.array([tangent.in_axes(one) for one in moved]).reshape(moved.shape)
            inertia, mix = np.linalg.eigh(np.einsum("ani,nij,bnj->ab", moved, M, moved))
            motions[rod] = mix[:, inertia <= least].T @ z
        self._hold(state, motions)

    def free(self, state: State, touched: Touched | None) -> list[Array]:
        """Rigid motions (v, ω) of each rod that neither its supports nor what it touches resists, shape (n, 6)."""
        mesh = self.equilibrium.mesh
        nodes, rows = self.equilibrium.supports.resisted(state.R)
        moved = np.einsum("nij,nj->ni", _moved(state.x[nodes]), rows)
        if touched is not None:
            answers = np.einsum("nij,nkj->nki", _moved(state.x[touched.nodes]), touched.blocks).reshape(-1, 6)
            moved = np.concatenate([moved, answers / touched.stiffest])
            nodes = np.concatenate([nodes, np.repeat(touched.nodes, 6)])
        of_rod = np.searchsorted(mesh.first, nodes, side="right") - 1
        return [null_space(moved[of_rod == rod]) for rod in range(len(mesh.s))]

    def _drop_pushed(self, state: State, t: float, motions: list[Array]) -> bool:
        """Take the motions in which the loads do work out of those held; whether there were any."""
        pushed = False
        for rod, (z, (work, scale)) in enumerate(zip(motions, self.works(state, t), strict=True)):
            force = z @ work
            if np.abs(force).max(initial=0.0) > BALANCED * scale:
                motions[rod] = null_space(force[None] / np.linalg.norm(force)) @ z
                pushed = True
        return pushed

    def works(self, state: State, t: float) -> list[tuple[Array, float]]:
        """Work of loads and surfaces on each rod in unit motions, and the largest share of either at a node in one."""
        first, works = self.equilibrium.mesh.first, []
        acting = np.delete(np.stack(self.equilibrium.acting(state, t)), AXIAL, axis=2)
        for mine in map(slice, first[:-1], first[1:]):
            work = np.einsum("nij,knj->kni", _moved(state.x[mine]), acting[:, mine])
            works.append((work.sum(axis=(0, 1)), float(np.abs(work).max(initial=0.0))))
        return works

    def _hold(self, state: State, motions: list[Array]) -> None:
        """Hold as many unknowns of one node of each rod as it has motions to hold, those that move most in them."""
        first = self.equilibrium.mesh.first
        held = [np.zeros(0, dtype=np.int64)]
        for rod, z in enumerate(motions):
            if not len(z):
                continue
            # The spins of a guide stand in axes of its own.
            mine = np.arange(first[rod], first[rod + 1])
            plain = np.setdiff1d(mine, self.equilibrium.supports.guides.nodes)
            node = plain[0] if len(plain) else mine[0]
            moved = z @ _moved(state.x[node])
            if not len(plain):
                moved = moved[:, X]
            _, order = qr(moved, mode="r", pivoting=True)
            held.append(node * N_NODE + order[: len(z)])
        self.equilibrium.hold(np.concatenate(held))


class _Pushed:
    """What pushes the rods of a scene at a pseudo-time."""

    def __init__(self, phase: PhaseCondition, contacts: Surroundings, t: float) -> None:
        self._phase, self._contacts, self._t = phase, contacts, t

    def ways(self, state: State) -> list[Array]:
        """See `Pushed`."""
        free = self._phase.free(state, self._phase.touched(state, self._t))
        ways = []
        for z, (work, scale) in zip(free, self._phase.works(state, self._t), strict=True):
            force = z @ work
            ways.append(force @ z * (np.abs(force).max(initial=0.0) > BALANCED * scale))
        return ways

    def works(self, state: State) -> list[Array]:
        """See `Pushed`."""
        self._contacts.begin(self._t)
        return [work for work, _ in self._phase.works(state, self._t)]

    def clearance(self, state: State, rod: int) -> float:
        """See `Pushed`."""
        self._contacts.at(state.x, state.R, self._t)
        return self._contacts.clearance(rod)


def _moved(x: Array) -> Array:
    """How nodes move in rigid motions: (e_i, 0), then (e_i × x, e_i); shapes (..., 3) and (..., 6, 6)."""
    moved = np.broadcast_to(np.eye(6), (*x.shape[:-1], 6, 6)).copy()
    moved[..., 3:, :3] = np.cross(np.eye(3), x[..., None, :])
    return moved
