"""The one module that knows which DOLFINx runs: elements, meshes, forms and their assembly in 0.5."""

from __future__ import annotations

import logging
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from mpi4py import MPI  # noqa: F401 (DOLFINx asks for mpi4py first)

import basix
import dolfinx.cpp as cpp
import dolfinx.fem.petsc
import dolfinx.jit
import numpy as np
import ufl
from dolfinx import fem, mesh

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray
    from petsc4py import PETSc

__all__ = [
    "BoundForm",
    "FormKind",
    "abstract_spaces",
    "cell_dofs",
    "cell_ends",
    "discontinuous_basis",
    "function",
    "held_dofs",
    "interval_mesh",
    "lagrange_basis",
    "lagrange_nodes",
    "node_rule",
    "quadrature_points",
    "quadrature_weights",
    "space",
]

INTERVAL = ufl.Cell("interval", geometric_dimension=1)
CELL = basix.CellType.interval


def lagrange(degree: int, dim: int) -> ufl.FiniteElementBase:
    """Continuous P_k with `dim` components, nodes at the Gauss-Lobatto points."""
    return ufl.VectorElement("Lagrange", INTERVAL, degree, dim=dim)


def discontinuous(degree: int, dim: int) -> ufl.FiniteElementBase:
    """Discontinuous P_k with `dim` components."""
    return ufl.VectorElement("DG", INTERVAL, degree, dim=dim)


def at_quadrature(degree: int, dim: int) -> ufl.FiniteElementBase:
    """Values given at the Gauss points of a rule of `degree`, `dim` components."""
    return ufl.VectorElement("Quadrature", INTERVAL, degree=degree, quad_scheme="default", dim=dim)


def node_rule(degree: int) -> dict[str, Any]:
    """Metadata of the Gauss-Lobatto rule on the nodes of P_k, written out.

    FFCx 0.5 tells rules apart by three digits of a hash, which are the same for the five-point Gauss-Lobatto and the
    four-point Gauss rule; the points listed from the far end have another.
    """
    points, weights = basix.make_quadrature(basix.QuadratureType.gll, CELL, 2 * degree - 1)
    return {
        "quadrature_rule": "custom",
        "quadrature_degree": 2 * degree - 1,
        "quadrature_points": [[float(x)] for x in points[::-1, 0]],
        "quadrature_weights": [float(w) for w in weights[::-1]],
    }


def interval_mesh(comm: MPI.Comm, nodes: Sequence[NDArray[np.float64]]) -> tuple[mesh.Mesh, NDArray[np.int64]]:
    """One mesh of disjoint intervals, one a rod, each parametrised by its own arc length.

    Rank 0 hands over all cells; DOLFINx distributes them (a rank may receive none).

    Args:
        comm: Communicator of the mesh.
        nodes: Ascending arc lengths of the element ends of each rod.

    Returns:
        The mesh, and for every local cell (owned first, then ghosts) its number in the order of `nodes`.
    """
    counts = np.array([len(s) for s in nodes])
    first = np.concatenate([[0], np.cumsum(counts)[:-1]])
    cells = np.concatenate([f + np.stack([np.arange(c - 1), np.arange(1, c)], 1) for f, c in zip(first, counts)])
    points = np.concatenate(list(nodes))[:, None]
    if comm.rank != 0:
        cells, points = cells[:0], points[:0]
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", INTERVAL, 1))
    rods = mesh.create_mesh(comm, cells.astype(np.int64), points, domain)
    return rods, np.asarray(rods.topology.original_cell_index, dtype=np.int64)


def cell_ends(rods: mesh.Mesh) -> NDArray[np.float64]:
    """Arc length of both ends of every local cell, shape (cells, 2)."""
    links = rods.geometry.dofmap.array.reshape(-1, 2)
    return np.asarray(rods.geometry.x[links, 0])


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


def sum_to_owners(f: fem.Function) -> None:
    """Add what other ranks have put on a shared dof to its owner's value."""
    f.x.scatter_reverse(cpp.la.ScatterMode.add)


def cell_dofs(space_: fem.FunctionSpace, field: int | None = None) -> NDArray[np.int32]:
    """Local degrees of freedom of a vector field by cell, node and component.

    Args:
        space_: A mixed space (with `field`) or a plain vector space (without).
        field: Number of the sub-field.

    Returns:
        Indices, shape (cells, nodes a cell, components).
    """
    if field is None:
        cells = space_.dofmap.list.array.reshape(n_cells(space_.mesh), -1)
        bs = space_.dofmap.bs
        return np.asarray(cells[:, :, None] * bs + np.arange(bs, dtype=np.int32), dtype=np.int32)
    sub = space_.sub(field)
    n = sub.ufl_element().value_size()
    parts = [sub.sub(j).dofmap.list.array.reshape(n_cells(space_.mesh), -1) for j in range(n)]
    return np.stack(parts, axis=-1).astype(np.int32)


def n_cells(rods: mesh.Mesh) -> int:
    """Local cells, ghosts included."""
    index_map = rods.topology.index_map(rods.topology.dim)
    return int(index_map.size_local + index_map.num_ghosts)


def held_dofs(x: fem.Function, dofs: NDArray[np.int32]) -> fem.DirichletBCMetaClass:
    """Marks local dofs whose rows and columns an assembly leaves out."""
    return fem.dirichletbc(x, np.sort(dofs))


def lagrange_nodes(degree: int) -> NDArray[np.float64]:
    """Position of the P_k nodes on [0, 1] in DOLFINx's order: both ends, then the interior."""
    element = basix.create_element(basix.ElementFamily.P, CELL, degree, basix.LagrangeVariant.gll_warped)
    return np.asarray(element.points[:, 0])


def discontinuous_basis(degree: int, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of the discontinuous P_k basis at `points` of [0, 1], shape (points, k + 1)."""
    variant = basix.LagrangeVariant.gll_warped if degree > 0 else basix.LagrangeVariant.unset
    element = basix.create_element(basix.ElementFamily.P, CELL, degree, variant, True)
    return np.asarray(element.tabulate(0, points[:, None])[0, :, :, 0])


def quadrature_points(degree: int) -> NDArray[np.float64]:
    """Gauss points on [0, 1] of the rule used for forms and coefficients of `degree`."""
    points, _ = basix.make_quadrature(CELL, degree)
    return np.asarray(points[:, 0])


def quadrature_weights(degree: int) -> NDArray[np.float64]:
    """Weights of that rule; they sum to 1."""
    _, weights = basix.make_quadrature(CELL, degree)
    return np.asarray(weights)


def lagrange_basis(degree: int, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of the P_k basis at `points` of [0, 1], shape (points, k + 1)."""
    element = basix.create_element(basix.ElementFamily.P, CELL, degree, basix.LagrangeVariant.gll_warped)
    return np.asarray(element.tabulate(0, points[:, None])[0, :, :, 0])


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
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", INTERVAL, 1))
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


def library_versions() -> dict[str, Any]:
    """Versions of what solves: DOLFINx and PETSc."""
    from petsc4py import PETSc as petsc

    return {"dolfinx": dolfinx.__version__, "petsc": ".".join(map(str, petsc.Sys.getVersion()))}
