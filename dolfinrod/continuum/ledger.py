"""Where the energy of a motion goes: what it is stored in, and the works that bring and take it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum.lumped import summed
from dolfinrod.continuum.strain import Strain
from dolfinrod.scene import Gravity, LineForce, Steady

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from dolfinrod.continuum.moving import Moving

    Array = NDArray[np.float64]

__all__ = ["Ledger"]

# What a motion stores its energy in.
STORED = ("kinetic", "strain", "potential")


class Ledger:
    """Energies and works of a problem in motion, in EI/L, in the sense of `Result.energy`.

    Each work is that of its own forces over the step, and the numerical one the difference between the energies gained
    and the works of inertia and elasticity in the scheme: that the sum closes tells that the step was balanced.

    Args:
        problem: Owner of the state.
    """

    def __init__(self, problem: Moving) -> None:
        self._problem, self._strain = problem, Strain(problem)
        self.rows: list[dict[str, float]] = []
        held = problem.constraints.dofs
        self._held = held[held < problem.discretization.n_owned].astype(np.intp)
        lines = [load for load in problem.scene.loads if isinstance(load, Gravity | LineForce)]
        self._weights = [
            summed(problem, vector)[: problem.discretization.n_owned]
            for load, (history, vector) in zip(lines, problem.line_loads, strict=True)
            if isinstance(load, Gravity) and isinstance(history, Steady)
        ]
        self._stored = STORED if problem.contacts is None else (*STORED, "contact")
        self._now = dict(zip(self._stored, self._summed(self._energies()), strict=True))
        rubbing = () if problem.contacts is None else ("friction", "wall work")
        self._works = dict.fromkeys(("load work", "support work", "drag", "damping", *rubbing, "numerical"), 0.0)

    def store(self) -> None:
        """Keep what it is now."""
        self.rows.append(self.now())

    def now(self) -> dict[str, float]:
        """What it is now."""
        return self._now | self._works

    def rewind(self, now: Mapping[str, float], stored: int) -> None:
        """Be what `now` said earlier, with the first rows that were stored."""
        self._now, self._works = ({name: now[name] for name in part} for part in (self._now, self._works))
        del self.rows[stored:]

    def strain(self) -> float:
        """Strain energy after the last step."""
        return self._now["strain"]

    def step(self) -> None:
        """Book a step that has just ended."""
        problem, before = self._problem, self._now
        change = problem.change()
        parts = self._forces()
        resisted = parts @ change
        pushed = parts[:, self._held].sum(axis=0) @ change[self._held]
        rubbed = [0.0, 0.0, 0.0] if problem.contacts is None else problem.contacts.accept()
        sums = self._summed([*self._energies(), *resisted, pushed, self._strain.dissipated, *rubbed])
        self._now = dict(zip(self._stored, sums, strict=False))
        gained = {name: self._now[name] - before[name] for name in before}
        booked = sums[len(self._stored) :]
        inertia, elastic, loads, drag, contact, support, dissipated, rubbed_off, walls, damped = booked
        self._works["load work"] += gained["potential"] - loads
        self._works["drag"] -= drag
        self._works["support work"] += support
        self._works["damping"] -= dissipated + damped
        self._works["numerical"] += gained["kinetic"] + gained["strain"] - inertia - elastic + dissipated
        if problem.contacts is not None:
            self._works["friction"] -= rubbed_off
            self._works["wall work"] += walls
            self._works["numerical"] += gained["contact"] - contact + rubbed_off + damped - walls

    def _forces(self) -> Array:
        """Residuals of the step's parts at this rank's own dofs, along the sphere of the balance, shape (5, n)."""
        problem = self._problem
        q, p, n = problem.lumped.q, problem.side(), problem.discretization.n_owned
        forces = problem.parts[:, :n].copy()
        if p.shape[1] == 4:
            along = forces[:, q]
            forces[:, q] = along - np.einsum("kni,ni->kn", along, p)[:, :, None] * p
        return forces

    def _summed(self, mine: list[float]) -> list[float]:
        """Each number, added up over all ranks."""
        sums = np.array(mine)
        self._problem.discretization.comm.Allreduce(MPI.IN_PLACE, sums)
        return list(sums.tolist())

    def _energies(self) -> list[float]:
        """What this rank stores, in the order of `STORED`."""
        problem, lumped = self._problem, self._problem.lumped
        body = problem.kinematics.turned_back(problem.x[lumped.q], problem.motion.π)
        kinetic = 0.5 * float(lumped.m @ np.einsum("ni,ni->n", problem.motion.v, problem.motion.v))
        kinetic += 0.5 * float(np.vdot(body, np.einsum("nij,nj->ni", lumped.J_inverse, body)))
        touched = [] if problem.contacts is None else [problem.contacts.stored()]
        return [kinetic, self._strain.settle(), self._potential(), *touched]

    def _potential(self) -> float:
        """This rank's part of the potential energy of the weights that always act in full, zero at the origin."""
        return sum(float(vector @ self._problem.x[: len(vector)]) for vector in self._weights)
