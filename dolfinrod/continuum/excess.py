"""Strains that resultants follow beside those of the state at which they act: the mean of a step, and rates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import backend

if TYPE_CHECKING:
    from petsc4py import PETSc

    from dolfinx import fem
    from numpy.typing import NDArray

    from dolfinrod.continuum.forms import ExcessForms

__all__ = ["Excess", "Sum"]


class Excess:
    """Forms of such strains on a mesh, and the step that they are of.

    Between the ends of a step nodes go along straight lines, and a rod that turns as a whole is shorter there: strains
    of that state would make it swell and, in long steps, burst. So the midpoint rule takes the mean of the strains at
    both ends. Sections that damp add the rates (Kelvin-Voigt).

    Args:
        forms: What is integrated.
        x: State at which forces are taken.

    Attributes:
        residual: Its virtual work.
        tangent: The derivative of that.
        ratio: τ/h of every local cell, shape (cells,).
        resultants: Of the rates in the step behind, on all local dofs, those of N and m.
    """

    def __init__(self, forms: ExcessForms, x: fem.Function) -> None:
        space = x.function_space
        self._x_0, self._sum = backend.function(space), backend.function(space)
        self._weights = backend.function(backend.space(space.mesh, forms.elements["weights"]))
        functions = {"x": x, "x_0": self._x_0, "weights": self._weights}
        values = {forms.coefficients[name]: function for name, function in functions.items()}
        self.residual = backend.BoundForm(forms.residual, [space], values)
        self.tangent = backend.BoundForm(forms.tangent, [space, space], values)
        self._weighed, self._before = self._weights.x.array, self._x_0.x.array
        self._cells = backend.cell_dofs(self._weights.function_space)[:, 0].astype(np.intp)
        self.ratio = np.zeros(len(self._cells))
        self.resultants = np.zeros_like(x.x.array)

    def scatter(self, random: np.random.Generator) -> None:
        """A state and a step that make nothing zero by chance."""
        for function in (self._x_0, self._weights):
            function.x.array[:] = random.uniform(1.0, 2.0, len(function.x.array))

    def begin(self, x_0: NDArray[np.float64], ratio: NDArray[np.float64], level: float) -> None:
        """Take the strains of a step from a state on.

        Args:
            x_0: The state before it, all local dofs.
            ratio: τ/h of every local cell.
            level: Where the forces are taken, as part of the way from that state to the one after the step.
        """
        self._before[:] = x_0
        self.ratio = ratio
        self._weigh(ratio + level, 1.0 - level - ratio, 1.0, 1.0 / level)

    def end(self) -> None:
        """Take forces at the state after the step, with the rates of the step that led there."""
        self._weigh(self.ratio, -self.ratio, 0.0, 1.0)

    def step(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """The step behind: the state before it, τ/h and resultants of the rates, copied."""
        return self._before.copy(), self.ratio.copy(), self.resultants.copy()

    def after(self, step: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]) -> None:
        """Be again at the end of such a step."""
        self._before[:], self.ratio, self.resultants[:] = step
        self.end()

    def rest(self) -> None:
        """No step, no rates."""
        self.ratio = np.zeros(len(self._cells))
        self.resultants[:] = 0.0
        self._weighed[:] = 0.0

    def _weigh(self, *weights: NDArray[np.float64] | float) -> None:
        """Weights of the strains after the step, before it and here, and how far on the step leads."""
        for component, weight in enumerate(weights):
            self._weighed[self._cells[:, component]] = weight

    def rates(self) -> NDArray[np.float64]:
        """Residual of the rates at the current state, summed over all ranks: ∫ ψ τ γ̇ ds and ∫ ψ τ κ̇ ds by N and m."""
        b = self._sum
        b.x.array[:] = 0.0
        self.residual.add_vector(b.x.array)
        backend.sum_over_ranks(b)
        return b.x.array


class Sum:
    """Forms on the same spaces, assembled as one.

    Args:
        whole: The form whose pattern has room for all.
        part: What is added to it.
    """

    def __init__(self, whole: backend.BoundForm, part: backend.BoundForm) -> None:
        self._whole, self._part = whole, part

    def matrix(self) -> PETSc.Mat:
        """An empty matrix for the sum."""
        return self._whole.matrix()

    def add_matrix(self, A: PETSc.Mat, *held: fem.DirichletBCMetaClass) -> None:
        """Add the bilinear forms to `A`, leaving out rows and columns of held dofs."""
        self._whole.add_matrix(A, *held)
        self._part.add_matrix(A, *held)

    def add_vector(self, b: NDArray[np.float64]) -> None:
        """Add the linear forms to the local array `b` (owned, then ghosts)."""
        self._whole.add_vector(b)
        self._part.add_vector(b)
