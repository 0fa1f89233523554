"""Rods cut into elements: mesh, spaces, compiled forms and numbering; made once for a topology, used for any values."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import backend, reference
from dolfinrod.continuum.banded import Band
from dolfinrod.continuum.excess import Excess, Sum
from dolfinrod.continuum.forms import excess_forms_of, forms_of

if TYPE_CHECKING:
    from mpi4py import MPI
    from petsc4py import PETSc

    from dolfinx import fem
    from numpy.typing import NDArray

    from dolfinrod.continuum.forms import ExcessForms
    from dolfinrod.continuum.kinematics import Kinematics

__all__ = ["Discretization", "Values"]


@dataclass(frozen=True)
class Values:
    """Everything of a scene that enters the forms as numbers, by local cell, in units of L, EI/L² and EI/L.

    Args:
        ends: Arc length of the element ends, shape (cells, 2).
        r_0: Stress-free centreline at the nodes, shape (cells, k + 1, d).
        C_n: Compliance of stretch and shear at the Gauss points, shape (cells, points, d, d).
        C_m: Compliance of twist and bending there, shape (cells, points, n_spin, n_spin).
        τ: Retardation time of each cell [s], shape (cells,).
    """

    ends: NDArray[np.float64]
    r_0: NDArray[np.float64]
    C_n: NDArray[np.float64]
    C_m: NDArray[np.float64]
    τ: NDArray[np.float64]


class Discretization:
    """Spaces, forms and numbering of rods with given numbers of elements.

    Args:
        comm: Communicator.
        kinematics: Spatial or planar.
        degree: Degree k of centreline and rotation; resultants have k − 1.
        elements: Number of elements of each rod.
        stepped: Whether resultants follow other strains than those of the state at which they act.
        rubbed: Whether moments at nodes follow where these are.

    Attributes:
        points: Gauss points on [0, 1].
        dofs: Local numbers of each field, name → (cells, nodes, components).
        state: Values of all unknowns on this rank, owned ones first, then ghosts: the memory of `x`.
        elastic: Residual of the rods alone.
        residual: Residual of the forms.
        tangent: Its derivative.
        excess: What other strains add to both; None where there are none.
        matrix: Tangent, with the pattern of the elements.
        band: Its layout as a band; None on several ranks.
        cell: For each local cell, its number when all rods are lined up.
        n_owned_cells: Cells this rank owns.
        seconds_compile: Time for making or loading forms [s].
    """

    def __init__(
        self,
        comm: MPI.Comm,
        kinematics: Kinematics,
        degree: int,
        elements: tuple[int, ...],
        *,
        stepped: bool = False,
        rubbed: bool = False,
    ) -> None:
        self.comm, self.kinematics, self.degree, self.elements = comm, kinematics, degree, elements
        nodes = [np.linspace(0.0, 1.0, n + 1) for n in elements]
        started = time.perf_counter()
        self.forms = forms_of(comm, kinematics, degree)
        excess = excess_forms_of(comm, kinematics, degree) if stepped else None
        self.seconds_compile = time.perf_counter() - started
        self.mesh, self.cell = backend.interval_mesh(comm, nodes)
        self.n_owned_cells = backend.n_owned_cells(self.mesh)
        self.nodes = reference.lagrange_nodes(degree)
        self.points = reference.quadrature_points(2 * degree)
        self._make_spaces()
        self._bind_forms(excess)
        index_map = self.space.dofmap.index_map
        self.n_owned, self.n_dofs = int(index_map.size_local), int(index_map.size_global)
        self.dofs = {f: backend.cell_dofs(self.space, i) for i, f in enumerate(self.kinematics.fields)}
        self._owned = {f: self._distinct(dofs) for f, dofs in self.dofs.items()}
        spanned = self._spanned_matrix(rubbed=rubbed)
        self.matrix = backend.without_zeros(spanned)
        self.band = Band(self.matrix, backend.order_by_neighbours(spanned)) if comm.size == 1 else None

    def _spanned_matrix(self, *, rubbed: bool) -> PETSc.Mat:
        """A tangent that is zero only where every tangent is, with all entries that the elements span.

        It is assembled at a random state with random coefficients; to it come the diagonal, for held dofs, and the
        part by which a force at a node, or its moment where it rubs, moves and turns with it.
        """
        random = np.random.default_rng(seed=0)
        for function in (self.x, self.r_0, self.C_n, self.C_m):
            function.x.array[:] = random.uniform(1.0, 2.0, len(function.x.array))
        if self.excess is not None:
            self.excess.scatter(random)
        spanned = self.tangent.matrix()
        self.tangent.add_matrix(spanned)
        every = np.arange(len(self.state), dtype=np.int32)
        r, q = (self.dofs[f].reshape(-1, self.dofs[f].shape[2]) for f in ("r", "q"))
        both = np.concatenate([r, q], axis=1)
        from_ = both if rubbed else r
        rows, columns = np.repeat(from_, both.shape[1], axis=1).ravel(), np.tile(both, (1, from_.shape[1])).ravel()
        backend.add_entries(spanned, np.concatenate([every, rows]), np.concatenate([every, columns]), 1.0)
        spanned.assemble()
        return spanned

    def _make_spaces(self) -> None:
        elements = self.forms.elements
        self.space = backend.space(self.mesh, elements["x"])
        self.x = backend.function(self.space)
        self.state = self.x.x.array
        self._assembled = backend.function(self.space)
        self.r_0, self.C_n, self.C_m, self.f = (
            backend.function(backend.space(self.mesh, elements[name])) for name in ("r_0", "C_n", "C_m", "f")
        )
        given = (self.r_0, self.C_n, self.C_m, self.f)
        self._at = {function: backend.cell_dofs(function.function_space) for function in given}

    def _bind_forms(self, excess: ExcessForms | None) -> None:
        functions = {"x": self.x, "r_0": self.r_0, "C_n": self.C_n, "C_m": self.C_m, "f": self.f}
        values = {self.forms.coefficients[name]: function for name, function in functions.items()}
        self.elastic = backend.BoundForm(self.forms.residual, [self.space], values)
        tangent = backend.BoundForm(self.forms.tangent, [self.space, self.space], values)
        self.excess = None if excess is None else Excess(excess, self.x)
        self.residual: backend.BoundForm | Sum = self.elastic
        self.tangent: backend.BoundForm | Sum = tangent
        if self.excess is not None:
            self.residual = Sum(self.elastic, self.excess.residual)
            self.tangent = Sum(tangent, self.excess.tangent)
        self.line_load = backend.BoundForm(self.forms.line_load, [self.space], values)

    def owned_nodes(self, field: str) -> NDArray[np.intp]:
        """Dofs of the distinct nodes of a field that this rank owns, shape (nodes, components)."""
        return self._owned[field]

    def _distinct(self, dofs: NDArray[np.int32]) -> NDArray[np.intp]:
        nodes = dofs.reshape(-1, dofs.shape[2])
        nodes = nodes[np.unique(nodes[:, 0], return_index=True)[1]]
        # NumPy turns other numbers into these each time that they pick entries, which takes longer than the picking.
        return nodes[nodes[:, 0] < self.n_owned].astype(np.intp)

    def set(self, values: Values) -> None:
        """Give the forms their numbers; nothing is compiled or allocated."""
        geometry = self.mesh.geometry
        geometry.x[geometry.dofmap.array.reshape(-1, 2), 0] = values.ends
        self._fill(self.r_0, values.r_0)
        for function, C in ((self.C_n, values.C_n), (self.C_m, values.C_m)):
            i, j = np.triu_indices(C.shape[-1])
            self._fill(function, C[..., i, j])
        self._τ = values.τ
        if self.excess is not None:
            self.excess.rest()

    def begin_step(self, x_0: NDArray[np.float64], dt: float, level: float) -> None:
        """Take the strains of a step of dt [s] from x₀ on; arguments as for `Excess.begin`."""
        if self.excess is not None:
            self.excess.begin(x_0, self._τ / dt, level)

    def _fill(self, function: fem.Function, values: NDArray[np.float64]) -> None:
        """Give a coefficient its values at the points of its elements, shape (cells, points, components)."""
        function.x.array[self._at[function]] = values

    def assembled_residual(self) -> NDArray[np.float64]:
        """Residual of the forms at the current state, summed over all ranks, on all local dofs."""
        return self._summed(self.residual)

    def elastic_residual(self) -> NDArray[np.float64]:
        """That of the rods alone."""
        return self._summed(self.elastic)

    def _summed(self, form: backend.BoundForm | Sum) -> NDArray[np.float64]:
        b = self._assembled
        b.x.array[:] = 0.0
        form.add_vector(b.x.array)
        backend.sum_over_ranks(b)
        return b.x.array

    def line_loads(self, f: NDArray[np.float64]) -> list[NDArray[np.float64]]:
        """Local residual vectors −∫ f·δr ds of dead line loads, one for each field in `f`."""
        vectors = []
        for field in f:
            self._fill(self.f, field)
            b = np.zeros_like(self.state)
            self.line_load.add_vector(b)
            vectors.append(b)
        return vectors
