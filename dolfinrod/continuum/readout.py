"""From the solver's state to arrays a user reads: gathered on every rank, in space, in SI units."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import reference
from dolfinrod.continuum.couples import Couples
from dolfinrod.continuum.lumped import node_lengths
from dolfinrod.continuum.met import meeting_histories
from dolfinrod.continuum.recovery import Sections
from dolfinrod.continuum.rubbing import rubs
from dolfinrod.continuum.touched import contact_histories
from dolfinrod.result import RodHistory

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem
    from dolfinrod.result import ContactHistory, MeetingHistory

__all__ = ["Readout"]

State = dict[str, "NDArray[np.float64]"]


class Readout:
    """Gathers states and turns them into histories.

    Where sections damp, the n and m of a history hold the viscous part, of the mean rates in the step that led to the
    state: what has acted in a step of backward Euler, a first-order estimate after one of the midpoint rule. Strains
    are those of the state.

    Args:
        problem: Owner of the state.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        d = problem.discretization
        self._order = np.argsort(d.nodes)
        self._to_nodes = reference.discontinuous_basis(d.degree - 1, d.nodes[self._order])
        self._resultants = reference.discontinuous_basis(d.degree - 1, d.points)
        self._rotations = reference.lagrange_basis(d.degree, d.points)
        self._weights = reference.quadrature_weights(2 * d.degree)
        self._sections = Sections(problem.kinematics, d.degree)
        self._mine = slice(0, d.n_owned_cells)
        # Friction acts at the surface of a rod, so that it puts moments on the centreline.
        self._couples = Couples(problem) if rubs(problem.scene) else None

    def gather(self, **values: NDArray[np.float64]) -> State:
        """Arrays by local cell, lined up by rod and element on every rank."""
        d = self.problem.discretization
        mine = {name: value[self._mine] for name, value in values.items()}
        parts = d.comm.allgather((d.cell[self._mine], mine)) if d.comm.size > 1 else [(d.cell[self._mine], mine)]
        order = np.argsort(np.concatenate([cell for cell, _ in parts]))
        return {name: np.concatenate([part[name] for _, part in parts])[order] for name in values}

    def state(self) -> State:
        """The whole state by field, each (cells, nodes, components), cells lined up, in working units."""
        d, x = self.problem.discretization, self.problem.x
        nodal = d.assembled_residual()[d.dofs["q"]]
        fields = {field: x[dofs] for field, dofs in d.dofs.items()}
        if d.excess is not None and any(rod.section.damping for rod in self.problem.scene.rods):
            fields |= {f"{f}_viscous": d.excess.resultants[d.dofs[f]] for f in ("N", "m")}
        return self.gather(nodal=nodal, **fields) | self.touched()

    def touched(self) -> State:
        """What is remembered of contacts, if there are any, and the couples of friction."""
        walls, pairs = self.problem.walls, self.problem.pairs
        touched = {} if walls is None else {"touch": walls.kept()}
        if self._couples is not None:
            touched["couples"] = self._couples.rates()
        met = {} if pairs is None else pairs.kept()
        return (self.gather(**touched) if touched else {}) | met

    def restore(self, state: State) -> None:
        """Make a gathered state the current one."""
        d = self.problem.discretization
        for field, dofs in d.dofs.items():
            self.problem.x[dofs] = state[field][d.cell]
        if self.problem.walls is not None and "touch" in state:
            self.problem.walls.recall(state["touch"][d.cell])
        if self.problem.pairs is not None:
            self.problem.pairs.recall(state)

    def energy(self) -> float:
        """Strain energy ∫ ½ n·C_n n + ½ m·C_m m ds at the current state [J]."""
        p, d, mine = self.problem, self.problem.discretization, self._mine
        N, m = (np.einsum("qa,cai->cqi", self._resultants, p.x[d.dofs[f][mine]]) for f in ("N", "m"))
        q = np.einsum("qa,cai->cqi", self._rotations, p.x[d.dofs["q"][mine]])
        n = p.kinematics.rotate_back(q.reshape(-1, q.shape[2]), N.reshape(-1, N.shape[2])).reshape(N.shape)
        density = np.einsum("cqi,cqij,cqj->cq", n, p.values.C_n[mine], n)
        density += np.einsum("cqi,cqij,cqj->cq", m, p.values.C_m[mine], m)
        total = 0.5 * float((density * np.diff(p.ends[mine], axis=1) * self._weights).sum())
        return float(d.comm.allreduce(total)) * p.placement.moment

    def histories(self, states: list[State]) -> tuple[RodHistory, ...]:
        """One history a rod from the gathered states."""
        p = self.problem
        reference = self.gather(s=p.s, R_0=p.R_0)
        used = {"r", "q", "N", "nodal", "couples", "N_viscous", "m_viscous"}.intersection(states[0])
        stacked = {f: np.stack([state[f] for state in states]) for f in used}
        s, R_0 = reference["s"][:, self._order], reference["R_0"][:, self._order]
        first = np.concatenate([[0], np.cumsum(p.discretization.elements)])
        return tuple(
            self._history(rod, slice(a, b), s[a:b], R_0[a:b], stacked) for rod, (a, b) in enumerate(pairwise(first))
        )

    def contacts(self, states: list[State]) -> tuple[ContactHistory, ...]:
        """One history a contact from the gathered states."""
        p = self.problem
        if p.walls is None:
            return ()
        lengths = node_lengths(p)[p.discretization.dofs["r"][:, self._order, :1]] * p.placement.length
        shares = self.gather(share=lengths)["share"]
        touched = np.stack([state["touch"] for state in states])[:, :, self._order]
        first = list(pairwise(np.concatenate([[0], np.cumsum(p.discretization.elements)])))
        of_rods = [_joined(shares[None, a:b])[0, :, 0] for a, b in first], [_joined(touched[:, a:b]) for a, b in first]
        return contact_histories(p.scene.walls, self.histories(states), *of_rods)

    def meetings(self, states: list[State]) -> tuple[MeetingHistory, ...]:
        """One history a contact of rods with rods."""
        return meeting_histories(states, len(self.problem.scene.meetings))

    def rates(self, states: list[State], second: float) -> tuple[tuple[NDArray[np.float64], NDArray[np.float64]], ...]:
        """Velocity [m/s] and spin [rad/s] of the nodes of each rod in space, from gathered states that hold them."""
        p, place = self.problem, self.problem.placement
        v = np.stack([state["v"] for state in states])[:, :, self._order] @ place.axes.T * (place.length / second)
        ω = np.stack([state["omega"] for state in states])[:, :, self._order] @ place.spin_axes.T / second
        first = np.concatenate([[0], np.cumsum(p.discretization.elements)])
        return tuple((_joined(v[:, a:b]), _joined(ω[:, a:b])) for a, b in pairwise(first))

    def _history(
        self, rod: int, cells: slice, s: NDArray[np.float64], R_0: NDArray[np.float64], states: State
    ) -> RodHistory:
        p, place = self.problem, self.problem.placement
        r, q = (_joined(states[f][:, cells][:, :, self._order]) for f in ("r", "q"))
        r_e, q_e, N_e, nodal = (states[f][:, cells] for f in ("r", "q", "N", "nodal"))
        couples = states["couples"][:, cells] if "couples" in states else None
        N = _averaged(np.einsum("na,tcai->tcni", self._to_nodes, N_e))
        m = _averaged(self._sections.moments(r_e, N_e, q_e[:, :, 0], nodal[:, :, 0], couples))
        frames_0 = _joined(R_0.reshape(1, *R_0.shape[:2], 9))[0].reshape(-1, 3, 3)
        turned = p.kinematics.turned_frames(q, place.spin_axes, frames_0)
        n = np.einsum("tsji,tsj->tsi", turned, N @ place.axes.T) * place.force
        m = np.einsum("tsji,tsj->tsi", turned, m @ place.spin_axes.T) * place.moment
        n_v, m_v = self._viscous(cells, turned, frames_0, states)
        section = p.scene.rods[rod].section
        return RodHistory(
            s=_joined(s[None, :, :, None])[0, :, 0] * place.length,
            r=place.to_space(r),
            frames=turned,
            gamma=(n - n_v) * np.asarray(section.compliance_n),
            kappa=(m - m_v) * np.asarray(section.compliance_m),
            n=n,
            m=m,
        )

    def _viscous(
        self, cells: slice, turned: NDArray[np.float64], frames_0: NDArray[np.float64], states: State
    ) -> tuple[NDArray[np.float64] | float, NDArray[np.float64] | float]:
        """The part of n and m in section frames that damping has, zero where none does."""
        if "N_viscous" not in states:
            return 0.0, 0.0
        place = self.problem.placement
        N, m = (
            _averaged(np.einsum("na,tcai->tcni", self._to_nodes, states[f][:, cells]))
            for f in ("N_viscous", "m_viscous")
        )
        n = np.einsum("tsji,tsj->tsi", turned, N @ place.axes.T) * place.force
        return n, np.einsum("sji,tsj->tsi", frames_0, m @ place.spin_axes.T) * place.moment


def _joined(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """(times, cells, nodes, …) of a continuous field to (times, nodes of the rod, …)."""
    inner = values[:, :, :-1]
    return np.concatenate([inner.reshape(len(values), -1, *values.shape[3:]), values[:, -1, -1:]], axis=1)


def _averaged(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same for a field that jumps between elements: the mean of both sides."""
    mean = values.copy()
    between = 0.5 * (values[:, :-1, -1] + values[:, 1:, 0])
    mean[:, :-1, -1] = mean[:, 1:, 0] = between
    return _joined(mean)
