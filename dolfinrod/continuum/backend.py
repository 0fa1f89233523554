"""The one module that knows which DOLFINx runs: elements, meshes, forms and their assembly in 0.5."""

from __future__ import annotations

import logging
from contextlib import contextmanager
from typing import TYPE_CHECKING

from mpi4py import MPI
from petsc4py import PETSc

import dolfinx.cpp as cpp
import dolfinx.fem.petsc
import dolfinx.jit
import numpy as np
import ufl
from dolfinx import fem, mesh

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

__all__ = [
    "BoundForm",
    "FormKind",
    "abstract_spaces",
    "cell_dofs",
    "function",
    "held_dofs",
    "interval_mesh",
    "space",
]

INTERVAL = ufl.Cell("interval", geometric_dimension=1)


def lagrange(degree: int, dim: int) -> ufl.FiniteElementBase:
    """Continuous P_k with `dim` components, nodes at the Gauss-Lobatto points."""
    return ufl.VectorElement("Lagrange", INTERVAL, degree, dim=dim)


def discontinuous(degree: int, dim: int) -> ufl.FiniteElementBase:
    """Discontinuous P_k with `dim` components."""
    return ufl.VectorElement("DG", INTERVAL, degree, dim=dim)


def at_quadrature(degree: int, dim: int) -> ufl.FiniteElementBase:
    """Values given at the Gauss points of a rule of `degree`, `dim` components."""
    return ufl.VectorElement("Quadrature", INTERVAL, degree=degree, quad_scheme="default", dim=dim)


def interval_mesh(comm: MPI.Comm, nodes: Sequence[NDArray[np.float64]]) -> tuple[mesh.Mesh, NDArray[np.int64]]:
    """One mesh of disjoint intervals, one a rod, each parametrised by its own arc length.

    Rank 0 hands over all cells; DOLFINx distributes them (a rank may receive none), whole rods where these are enough.

    Args:
        comm: Communicator of the mesh.
        nodes: Ascending arc lengths of the element ends of each rod.

    Returns:
        The mesh, and for every local cell (owned first, then ghosts) its number in the order of `nodes`.
    """
    counts = np.array([len(s) for s in nodes])
    first = np.concatenate([[0], np.cumsum(counts)[:-1]])
    cells = np.concatenate(
        [f + np.stack([np.arange(c - 1), np.arange(1, c)], 1) for f, c in zip(first, counts, strict=True)]
    )
    points = np.concatenate(list(nodes))[:, None]
    if comm.rank != 0:
        cells, points = cells[:0], points[:0]
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", INTERVAL, 1))
    dealt = {"partitioner": _dealt(counts - 1, comm.size)} if 1 < comm.size <= len(counts) else {}
    rods = mesh.create_mesh(comm, cells.astype(np.int64), points, domain, **dealt)
    return rods, np.asarray(rods.topology.original_cell_index, dtype=np.int64)


def _dealt(elements: NDArray[np.int64], n: int) -> Callable[..., cpp.graph.AdjacencyList_int32]:
    """What deals rods of so many elements out to n ranks, neighbours in the list together."""
    middle = (np.cumsum(elements) - 0.5 * elements) / elements.sum()
    rank = np.repeat((n * middle).astype(np.int32), elements)[:, None]
    return lambda *given: cpp.graph.AdjacencyList_int32(rank[: given[3].num_nodes])


def n_owned_cells(rods: mesh.Mesh) -> int:
    """Cells this rank owns; ghosts come after them."""
    return int(rods.topology.index_map(rods.topology.dim).size_local)


def space(rods: mesh.Mesh, element: ufl.FiniteElementBase) -> fem.FunctionSpace:
    """Function space of an element or a mixed element on the rods."""
    with _quiet_compiler():
        return fem.FunctionSpace(rods, element)


def function(space_: fem.FunctionSpace) -> fem.Function:
    """A zero function."""
    return fem.Function(space_)


def sum_over_ranks(f: fem.Function) -> None:
    """Add up what all ranks have put on a shared dof, and give each of them the sum."""
    f.x.scatter_reverse(cpp.la.ScatterMode.add)
    f.x.scatter_forward()


def cell_dofs(space_: fem.FunctionSpace, field: int | None = None) -> NDArray[np.int32]:
    """Local degrees of freedom of a vector field by cell, node and component.

    Args:
        space_: A mixed space (with `field`) or a plain vector space (without).
        field: Number of the sub-field.

    Returns:
        Indices, shape (cells, nodes a cell, components).
    """
    if field is None:
        bs = space_.dofmap.bs
        return np.asarray(_cells(space_)[:, :, None] * bs + np.arange(bs), dtype=np.int32)
    sub = space_.sub(field)
    parts = [_cells(sub.sub(j)) for j in range(sub.ufl_element().value_size())]
    return np.stack(parts, axis=-1).astype(np.int32)


def _cells(space_: fem.FunctionSpace) -> NDArray[np.int32]:
    """Local dofs (of blocks) by cell, also where this rank has no cell."""
    dofmap = space_.dofmap
    return np.asarray(dofmap.list.array.reshape(-1, dofmap.dof_layout.num_dofs))


def held_dofs(x: fem.Function, dofs: NDArray[np.int32]) -> fem.DirichletBCMetaClass:
    """Marks local dofs whose rows and columns an assembly leaves out."""
    return fem.dirichletbc(x, np.sort(dofs))


@contextmanager
def _quiet_compiler() -> Iterator[None]:
    """Keeps the C compiler's command lines off the user's terminal."""
    before = logging.root.manager.disable
    logging.disable(logging.INFO)
    try:
        yield
    finally:
        logging.disable(before)


class FormKind:
    """A form as text and machine code, free of any mesh: compiled once, used for every mesh and every value.

    It is written on abstract spaces, so its signature, by which DOLFINx finds what it compiled in an earlier run,
    depends on the formula alone.

    Args:
        comm: All its ranks must call together.
        form: UFL form on `abstract_space`s.
    """

    def __init__(self, comm: MPI.Comm, form: ufl.Form) -> None:
        with _quiet_compiler():
            self.code, self._module, _ = dolfinx.jit.ffcx_jit(
                comm, form, form_compiler_params={"scalar_type": "double"}, jit_params={"timeout": 60}
            )
        originals = form.coefficients()
        positions = [self.code.original_coefficient_position[i] for i in range(self.code.num_coefficients)]
        self.coefficients = [originals[i] for i in positions]

    @property
    def address(self) -> int:
        """Where the machine code lies."""
        ffi = self._module.ffi
        return int(ffi.cast("uintptr_t", ffi.addressof(self.code)))


def abstract_spaces(*elements: ufl.FiniteElementBase) -> list[ufl.FunctionSpace]:
    """UFL spaces on one interval mesh that is nothing but its geometry's element."""
    # FFCx 0.5 sets this variant while it compiles: left open, a form found on disk would change the next signature.
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", INTERVAL, 1, variant="equispaced"))
    return [ufl.FunctionSpace(domain, element) for element in elements]


class BoundForm:
    """A form kind on a mesh, with functions for its coefficients.

    Args:
        kind: What is integrated.
        spaces: Test, and trial, space.
        functions: Function for each abstract coefficient.
    """

    def __init__(
        self,
        kind: FormKind,
        spaces: Sequence[fem.FunctionSpace],
        functions: dict[ufl.Coefficient, fem.Function],
    ) -> None:
        self._kind = kind
        self._functions = [functions[c] for c in kind.coefficients]
        self._form = cpp.fem.Form_float64(
            kind.address,
            [space_._cpp_object for space_ in spaces],
            [f._cpp_object for f in self._functions],
            [],
            {cpp.fem.IntegralType.cell: None},
            spaces[0]._cpp_object.mesh,
        )
        self._constants = cpp.fem.pack_constants(self._form)

    def matrix(self) -> PETSc.Mat:
        """An empty matrix with the pattern of this bilinear form."""
        return dolfinx.fem.petsc.create_matrix(self._form)

    def add_matrix(self, A: PETSc.Mat, *held: fem.DirichletBCMetaClass) -> None:
        """Add the bilinear form to `A`, leaving out rows and columns of held dofs."""
        coefficients = cpp.fem.pack_coefficients(self._form)
        cpp.fem.petsc.assemble_matrix(A, self._form, self._constants, coefficients, list(held))

    def add_vector(self, b: NDArray[np.float64]) -> None:
        """Add the linear form to the local array `b` (owned, then ghosts)."""
        cpp.fem.assemble_vector(b, self._form, self._constants, cpp.fem.pack_coefficients(self._form))


def add_entries(
    A: PETSc.Mat, rows: NDArray[np.integer], columns: NDArray[np.integer], values: NDArray[np.float64] | float
) -> None:
    """Add single entries, given in local numbers, to a matrix."""
    if len(rows):
        pointers = np.arange(len(rows) + 1, dtype=np.int32)
        filled = np.broadcast_to(np.asarray(values, dtype=float), rows.shape)
        I, J = rows.astype(np.int32, copy=False), columns.astype(np.int32, copy=False)
        A.setValuesLocalIJV(pointers, J, filled, addv=PETSc.InsertMode.ADD_VALUES, rowmap=I)


def without_zeros(A: PETSc.Mat) -> PETSc.Mat:
    """A matrix that has room for the entries of `A` which are not zero, and passes over zeros added elsewhere."""
    pointers, columns, values = A.getValuesCSR()
    kept = values != 0.0
    pointers = np.concatenate([[0], np.cumsum(kept)])[pointers].astype(np.int32)
    sparse = PETSc.Mat().createAIJ(A.getSizes(), csr=(pointers, columns[kept], values[kept]), comm=A.getComm())
    sparse.setLGMap(*A.getLGMap())
    sparse.setOption(PETSc.Mat.Option.IGNORE_ZERO_ENTRIES, True)
    return sparse


def order_by_neighbours(A: PETSc.Mat) -> NDArray[np.int32]:
    """Unknowns of a matrix on one rank in the order of reverse Cuthill and McKee."""
    return np.asarray(A.getOrdering(PETSc.Mat.OrderingType.RCM)[0].getIndices())
