"""J = P + C as one sparse matrix: the tangent of the elements with what rods do to one another.

Which nodes C links changes as rods move, yet seldom from one iteration to the next. So the pattern of J, and where its
entries come from, are made anew only where nodes are linked that were not before; else values alone are filled in, and
the symbolic factors of J serve again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum.direct import LIBRARY_ERROR, mumps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.pairs import Pairs

    Array = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["Joint", "JointLU"]


class Joint:
    """The matrix, and its pattern as long as that serves.

    Args:
        pairs: Of rods that touch one another.
    """

    def __init__(self, pairs: Pairs) -> None:
        self._pairs, self._known = pairs, np.zeros(0, dtype=np.int64)
        self._matrix: PETSc.Mat | None = None

    def filled(self, P: PETSc.Mat) -> PETSc.Mat:
        """J at the present state, for which P has just been assembled; the same matrix as long as the pattern serves.

        Args:
            P: Tangent of the elements, with what nodes feel of themselves, of one pattern always; all ranks together.
        """
        nodes, blocks = self._linked()
        key = nodes[:, 0] * self._pairs.everywhere.n + nodes[:, nodes.shape[1] // 2]
        J = self._matrix
        if J is None or not np.isin(key, self._known).all():
            J = self._matrix = self._arranged(P, nodes, key)
        entries = np.zeros(len(self._columns) + 1)
        entries[self._of_elements] = P.getValuesCSR()[2]
        entries[self._of_nodes] += (self._pairs.links().nodal - self._pairs.inside).ravel()
        at = self._of_links[np.searchsorted(self._known, key)]
        entries += np.bincount(at.ravel(), blocks.ravel(), len(entries))
        J.setValuesCSR(self._pointers, self._columns, entries[:-1])
        J.assemble()
        return J

    def _linked(self) -> tuple[Integers, Array]:
        """Nodes and blocks of all meetings, of all ranks on each."""
        parts = list(self._pairs.links().blocks())
        every = self._pairs.everywhere.comm.allgather(parts) if self._pairs.everywhere.comm.size > 1 else [parts]
        nodes, blocks = zip(*(part for parts in every for part in parts), strict=True)
        return np.concatenate(nodes), np.concatenate(blocks)

    def _arranged(self, P: PETSc.Mat, nodes: Integers, key: Integers) -> PETSc.Mat:
        """Make a matrix with room for the blocks of some nodes, and find where what it is made of goes."""
        self.close()
        dofs, (start, end), N = self._pairs.everywhere.dofs.astype(np.int64), P.getOwnershipRange(), P.getSize()[0]
        self._known, first = np.unique(key, return_index=True)
        n = self._pairs.links().nodal.shape[1]
        linked = dofs[nodes[first]][:, :, :n].reshape(len(first), nodes.shape[1] * n)
        own = dofs[self._pairs.everywhere.own][:, :n]
        pointers, columns, _ = P.getValuesCSR()
        rows = np.repeat(np.arange(start, end), np.diff(pointers))
        places = [rows * N + columns, *((one[:, :, None] * N + one[:, None]).ravel() for one in (own, linked))]
        mine = (places[-1] >= start * N) & (places[-1] < end * N)
        kept, at = np.unique(np.concatenate([*places[:-1], places[-1][mine]]), return_inverse=True)
        self._of_elements, self._of_nodes, of_links = np.split(at, np.cumsum([len(place) for place in places[:-1]]))
        # What is of other ranks' rows goes to one more entry that nobody reads.
        self._of_links = np.full(len(mine), len(kept))
        self._of_links[mine] = of_links
        self._of_links = self._of_links.reshape(len(linked), linked.shape[1] ** 2)
        self._pointers = np.searchsorted(kept, np.arange(start, end + 1) * N).astype(np.int32)
        self._columns = (kept % N).astype(np.int32)
        csr = self._pointers, self._columns, np.zeros(len(kept))
        return PETSc.Mat().createAIJ(P.getSizes(), csr=csr, comm=P.getComm())

    def close(self) -> None:
        """Free what PETSc holds, on all ranks together."""
        if self._matrix is not None:
            self._matrix.destroy()
            self._matrix = None


class JointLU:
    """Factors of J by MUMPS, the symbolic ones as long as the pattern serves.

    Args:
        pairs: Of rods that touch one another.

    Attributes:
        singular: Whether there are none.
    """

    singular = False

    def __init__(self, pairs: Pairs) -> None:
        self._joint = Joint(pairs)
        self._matrix: PETSc.Mat | None = None
        self._pc: PETSc.PC | None = None

    def factorize(self, P: PETSc.Mat) -> None:
        """Of the present state, as `Joint.filled`."""
        J = self._joint.filled(P)
        if self._pc is None or self._matrix is not J or self.singular:
            self._free()
            self._pc, self._matrix = mumps(PETSc.PC().create(P.getComm()), J), J
        try:
            self._pc.setUp()
            self.singular = self._pc.getFactorMatrix().getMumpsInfog(1) < 0
        except PETSc.Error as error:
            if error.ierr != LIBRARY_ERROR:
                raise
            self.singular = True

    def apply(self, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve; not a number where J is singular."""
        if self.singular or self._pc is None:
            x.set(np.nan)
            return
        self._pc.apply(b, x)

    def _free(self) -> None:
        if self._pc is not None:
            self._pc.destroy()
            self._pc = None

    def close(self) -> None:
        """Free what PETSc holds, on all ranks together."""
        self._free()
        self._joint.close()
