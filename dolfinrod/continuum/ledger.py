"""Where the energy of a motion goes: what it is stored in, and the works that bring and take it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import backend
from dolfinrod.continuum.strain import Strain

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from dolfinrod.continuum.moving import Moving

    Array = NDArray[np.float64]

__all__ = ["Ledger"]


class Ledger:
    """Energies and works of a problem in motion, in EI/L, in the sense of `Result.energy`.

    Each work is that of its own forces over the step, and the numerical one the difference between the energies gained
    and the works of inertia and elasticity in the scheme: that the sum closes tells that the step was balanced.

    Args:
        problem: Owner of the state.
    """

    def __init__(self, problem: Moving) -> None:
        self._problem, self._strain = problem, Strain(problem)
        space = problem.discretization.space
        self._parts = [backend.function(space) for _ in range(4)]
        self.rows: list[dict[str, float]] = []
        self._now = {"kinetic": self._kinetic(), "strain": self._strain_energy(), "potential": problem.potential()}
        self._works = dict.fromkeys(("load work", "support work", "drag", "damping", "numerical"), 0.0)

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
        inertia, elastic, loads, drag = self._forces()
        held = problem.constraints.dofs
        held = held[held < problem.discretization.n_owned]
        total = inertia + elastic + loads + drag
        pushed = float(total[held] @ change[held])
        resisted = [float(part @ change) for part in (inertia, elastic, loads, drag)]
        sums = problem.discretization.comm.allreduce(np.array([*resisted, pushed]))
        self._now = {"kinetic": self._kinetic(), "strain": self._strain_energy(), "potential": problem.potential()}
        gained = {name: self._now[name] - before[name] for name in before}
        self._works["load work"] += gained["potential"] - sums[2]
        self._works["drag"] -= sums[3]
        self._works["support work"] += sums[4]
        self._works["numerical"] += gained["kinetic"] + gained["strain"] - sums[0] - sums[1]

    def _forces(self) -> list[Array]:
        """Residuals of inertia, elasticity, loads and air at this rank's own dofs, along the sphere of the balance."""
        problem, n = self._problem, self._problem.discretization.n_owned
        arrays = [part.x.array for part in self._parts]
        for b in arrays:
            b[:] = 0.0
        problem.add_apart(*arrays)
        for part in self._parts:
            backend.sum_over_ranks(part)
        q, p = problem.lumped.q, problem.side()
        if p.shape[1] == 4:
            for b in arrays:
                b[q] -= np.einsum("ni,ni->n", p, b[q])[:, None] * p
        return [b[:n] for b in arrays]

    def _kinetic(self) -> float:
        problem, lumped = self._problem, self._problem.lumped
        body = problem.kinematics.turned_back(problem.x[lumped.q], problem.motion.π)
        energy = 0.5 * float(lumped.m @ np.einsum("ni,ni->n", problem.motion.v, problem.motion.v))
        energy += 0.5 * float(np.einsum("ni,nij,nj->", body, lumped.J_inverse, body))
        return float(problem.discretization.comm.allreduce(energy))

    def _strain_energy(self) -> float:
        return self._strain.settle()
