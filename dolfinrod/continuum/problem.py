"""A scene as a system of equations: residual and tangent of its equilibrium at a pseudo-time, in working units."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum import backend
from dolfinrod.continuum.constraints import Constraints
from dolfinrod.continuum.discretization import Discretization, Values
from dolfinrod.continuum.layout import Layout
from dolfinrod.continuum.loading import line_loads, point_terms
from dolfinrod.continuum.placement import exact_zeros
from dolfinrod.continuum.rubbing import contact_terms
from dolfinrod.continuum.together import touching
from dolfinrod.scene.history import factor

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from petsc4py import PETSc

    from numpy.typing import NDArray

    from dolfinrod.continuum.placement import Placement
    from dolfinrod.continuum.terms.point import PointTerm
    from dolfinrod.scene import Scene

    Block = tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]

__all__ = ["Problem"]

# Two places of one rod closer than this fraction of the unit of length are one node.
SAME_PLACE = 1e-9
# Of a load's stiffness, relative to its largest entry.
ROUND_OFF = 1e-12


class Problem:
    """The one owner of the state while a scene is solved.

    Args:
        scene: What is posed.
        discretization: Elements, spaces and forms.
        placement: Working coordinates and units.

    Attributes:
        x: State on this rank, owned dofs first, then ghosts.
        s: Arc length of the nodes of every local cell, in L, shape (cells, k + 1).
        rod: Rod of every local cell.
        R_0: Stress-free frames at those nodes, shape (cells, k + 1, 3, 3).
        spins: Section axes at the Gauss points in components of spin, shape (cells, points, n_spin, 3).
        held_force: Residual on this rank at the dofs given to `hold`.
        walls: The surfaces that rods touch; None where the scene has none.
        pairs: The rods that touch one another; None where none may.
        contacts: Both together; None where there is nothing to touch.
        excluded: Whether a dof on this rank is held.
        terms: Names of all that acts.
        line_loads: History and full residual of each line load.
    """

    # Where in a step forces act.
    level = 1.0

    def __init__(self, scene: Scene, discretization: Discretization, placement: Placement) -> None:
        self.scene, self.discretization, self.placement = (scene, discretization, placement)
        self.kinematics = discretization.kinematics
        self.layout = Layout.of(scene, discretization, placement.length)
        self.rod, self.ends = self.layout.rod, self.layout.ends
        self.s = self.layout.along(discretization.nodes)
        self._set_values()
        self.constraints = Constraints(scene, self.kinematics, placement, self.locate)
        self._lump()
        self._beyond: NDArray[np.int32] | None = None
        self.hold(np.zeros(0, dtype=np.int32))
        self._point_terms = point_terms(scene, self.kinematics, placement, self._locate_owned)
        self.line_loads = list(zip(self._line_histories, discretization.line_loads(self._line_fields), strict=True))
        self.walls, self.pairs, self.contacts = touching(self)
        self.terms = ("Elasticity", *dict.fromkeys(type(load).__name__ for load in scene.loads), *contact_terms(scene))
        self.advance_to(0.0)

    @property
    def x(self) -> NDArray[np.float64]:
        """State on this rank."""
        return self.discretization.state

    def _set_values(self) -> None:
        d, place, scene = self.discretization, self.placement, self.scene
        at_points = self.layout.along(d.points)
        sections = [rod.section for rod in scene.rods]
        c_n = np.array([section.compliance_n for section in sections]) * place.force
        c_m = np.array([section.compliance_m for section in sections]) * place.stiffness
        R_0 = self.layout.on_rods(at_points, "frames")
        directions, self.spins = exact_zeros(place.axes.T @ R_0), exact_zeros(place.spin_axes.T @ R_0)
        r_0 = place.points(self.layout.on_rods(self.s, "centerline"))
        self._line_histories, self._line_fields = line_loads(scene, place, self.rod, at_points)
        self.values = Values(
            ends=self.ends,
            r_0=r_0,
            C_n=exact_zeros(np.einsum("cqij,cj,cqkj->cqik", directions, c_n[self.rod], directions), axis=(2, 3)),
            C_m=exact_zeros(np.einsum("cqij,cj,cqkj->cqik", self.spins, c_m[self.rod], self.spins), axis=(2, 3)),
            τ=np.array([section.damping for section in sections])[self.rod],
        )
        d.set(self.values)
        self.R_0 = self.layout.on_rods(self.s, "frames")
        self.x[:] = 0.0
        self.x[d.dofs["r"]] = r_0
        self.x[d.dofs["q"]] = self.kinematics.at_rest(1)[0]

    def locate(self, rod: int, s: float) -> dict[str, NDArray[np.int32]] | None:
        """Local dofs of the node of `rod` at arc length `s` [m], name → numbers; None if it is not on this rank."""
        ends = np.abs(self.ends - s / self.placement.length) + np.where(self.rod == rod, 0.0, np.inf)[:, None]
        if not ends.size or ends.min() > SAME_PLACE:
            return None
        cell, end = np.unravel_index(int(np.argmin(ends)), ends.shape)
        return {f: self.discretization.dofs[f][cell, end] for f in self.kinematics.fields if f not in ("N", "m")}

    def _locate_owned(self, rod: int, s: float) -> dict[str, NDArray[np.int32]] | None:
        """As `locate`, for a node this rank owns."""
        node = self.locate(rod, s)
        return node if node is not None and node["r"][0] < self.discretization.n_owned else None

    def hold(self, dofs: NDArray[np.int32]) -> None:
        """Hold these dofs where they are, on top of the supports, until the next call."""
        n_owned = self.discretization.n_owned
        self.held_force = np.zeros(0)
        if self._beyond is not None and np.array_equal(dofs, self._beyond):
            return
        self._beyond = dofs
        held = np.union1d(self.constraints.dofs, dofs).astype(np.int32)
        self.excluded = np.zeros(len(self.x), dtype=bool)
        self.excluded[held] = True
        self._mask = backend.held_dofs(self.discretization.x, held)
        self._held, self._extra = held[held < n_owned], dofs[dofs < n_owned]

    def advance_to(self, t: float) -> None:
        """Put supports and loads at pseudo-time t; the rest of the state stays."""
        self.t = t
        self.x[self.constraints.dofs] = self.constraints.values(t)
        if self.contacts is not None:
            self.contacts.begin(t)
        self._acting: list[PointTerm] = [build(t) for build in self._point_terms]

    def add_residual(self, b: NDArray[np.float64]) -> None:
        """Add this rank's residual at the current state and time to the local array b."""
        self.discretization.residual.add_vector(b)
        self.add_loads(b, self.x)
        if self.contacts is not None:
            self.contacts.add_residual(b, self.x[self.contacts.q])

    def loaded_dofs(self) -> list[NDArray[np.int32]]:
        """Dofs on which the point loads of this rank act."""
        return [term.residual(self.x)[0].ravel() for term in self._acting]

    def add_loads(self, b: NDArray[np.float64], x: NDArray[np.float64]) -> None:
        """Add what the loads at the current time put on a state."""
        for history, vector in self.line_loads:
            b += factor(history, self.t, self.scene.motion.t_end) * vector
        for term in self._acting:
            np.add.at(b, *term.residual(x))

    def balance_multipliers(self, b: NDArray[np.float64]) -> None:
        """Give each multiplier the value at which the residual b has no part along its quaternion.

        It is then a function of the state, not an unknown with a history, and Newton's tangent is that of the
        energy on the manifold of unit quaternions, wherever the limited rotations have led.
        """
        if self._lumped is None:
            return
        q, λ = self._unit
        p = self.x[q]
        along = np.einsum("ni,ni->n", p, b[q])
        b[q] -= along[:, None] * p
        self.x[λ] -= along / self._lumped
        self.discretization.x.x.scatter_forward()

    def _lump(self) -> None:
        """Weights with which the multipliers enter: their rows of the residual where (p·p − 1)/2 = 1."""
        d = self.discretization
        self._lumped = None
        if "multiplier" not in d.dofs:
            return
        self._unit = d.owned_nodes("q"), d.owned_nodes("multiplier")[:, 0]
        x = self.x.copy()
        self.x[d.dofs["q"]] = np.sqrt(3.0) * x[d.dofs["q"]]
        b = d.assembled_residual()
        self.x[:] = x
        self._lumped = b[self._unit[1]]

    @property
    def conservative(self) -> bool:
        """Whether the acting loads have a potential, so that the tangent is symmetric."""
        # All of them first: ranks work out together what rods do to each other.
        blocks = list(self._stiffnesses(on_sphere=True))
        mine = all(self._is_symmetric(*block) for block in blocks)
        return bool(self.discretization.comm.allreduce(mine, op=MPI.LAND))

    def _is_symmetric(self, rows: NDArray[np.int32], columns: NDArray[np.int32], blocks: NDArray[np.float64]) -> bool:
        """Whether such blocks are, but for round-off and for held dofs."""
        free = blocks * ~(self.excluded[rows][:, :, None] | self.excluded[columns][:, None, :])
        skew = free - np.swapaxes(free, 1, 2) if np.array_equal(rows, columns) else free
        return bool(np.abs(skew).max(initial=0.0) <= ROUND_OFF * np.abs(blocks).max(initial=0.0))

    def clear_held(self, b: NDArray[np.float64]) -> None:
        """Zero the rows of held dofs, which the state meets already; what the ones of `hold` need is kept."""
        self.held_force = b[self._extra]
        b[self._held] = 0.0

    def _stiffnesses(self, *, on_sphere: bool) -> Iterator[Block]:
        """Stiffness of the acting loads; of moments only its part along the sphere of unit quaternions, if so asked."""
        for term in self._acting:
            block = term.tangent(self.x)
            if block is None:
                continue
            rows, columns, values = block
            if on_sphere and np.array_equal(rows, columns):
                p = self.x[rows]
                along = np.eye(p.shape[1]) - p[:, :, None] * p[:, None, :]
                values = along @ values @ along
            yield rows, columns, values
        yield from self._contact_stiffnesses()

    def _contact_stiffnesses(self) -> Iterable[Block]:
        """That of what the rods touch."""
        return () if self.contacts is None else self.contacts.blocks(self.x[self.contacts.q])

    def assemble_tangent(self, A: PETSc.Mat, *, on_sphere: bool = False) -> None:
        """Tangent at the current state and time, unit rows and columns for held dofs.

        Args:
            A: Where to.
            on_sphere: Whether changes along a quaternion, which the multipliers forbid anyhow, are left out: then the
                tangent is symmetric where the loads have a potential.
        """
        A.zeroEntries()
        self.discretization.tangent.add_matrix(A, self._mask)
        for block in self._stiffnesses(on_sphere=on_sphere):
            backend.add_entries(A, *self.entries(*block))
        backend.add_entries(A, self._held, self._held, 1.0)
        A.assemble()

    def entries(self, rows: NDArray[np.int32], columns: NDArray[np.int32], blocks: NDArray[np.float64]) -> Block:
        """Entries of dense blocks, one for each row of (rows, columns), leaving out held dofs."""
        I = np.repeat(rows, columns.shape[1], axis=1).ravel()
        J = np.tile(columns, (1, rows.shape[1])).ravel()
        keep = ~(self.excluded[I] | self.excluded[J])
        return I[keep], J[keep], blocks.ravel()[keep]
