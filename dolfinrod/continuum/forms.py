"""The weak form of rods of one kind: written and compiled once for a kinematics and a degree."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import ufl

from dolfinrod.continuum import backend, reference
from dolfinrod.continuum.terms.elastic import stored_energy, symmetric
from dolfinrod.continuum.terms.gauge import node_condition

if TYPE_CHECKING:
    from dolfinrod.continuum.kinematics import Kinematics

__all__ = ["Forms", "forms_of"]


class Forms:
    """Residual, tangent and line load of rods of one kind.

    Every number of a scene is a coefficient, so the code depends on nothing but the formula.

    Args:
        comm: All its ranks call together.
        kinematics: Spatial or planar.
        degree: Degree of centreline and rotation.

    Attributes:
        elements: Name of each coefficient → its element.
        coefficients: Name → its symbol in the forms.
    """

    def __init__(self, comm: MPI.Comm, kinematics: Kinematics, degree: int) -> None:
        k, d, n = degree, kinematics.dim, kinematics.n_spin
        self.elements = {
            "x": ufl.MixedElement(kinematics.elements(k)),
            "r_0": backend.lagrange(k, d),
            "C_n": backend.at_quadrature(2 * k, d * (d + 1) // 2),
            "C_m": backend.at_quadrature(2 * k, n * (n + 1) // 2),
            "f": backend.at_quadrature(2 * k, d),
        }
        spaces = backend.abstract_spaces(*self.elements.values())
        # Numbered here and now: FFCx 0.5 writes a running number of two digits into C that does not compile.
        self.coefficients = {
            name: ufl.Coefficient(V, count=i) for i, (name, V) in enumerate(zip(self.elements, spaces, strict=True))
        }
        x, r_0, C_n, C_m, f = self.coefficients.values()
        δx, Δx = ufl.TestFunction(spaces[0]), ufl.TrialFunction(spaces[0])
        dx = ufl.dx(domain=spaces[0].ufl_domain())
        ds = dx(metadata={"quadrature_degree": 2 * k})
        q = kinematics.configuration(ufl.split(x))
        energy = stored_energy(q, symmetric(C_n), symmetric(C_m), r_0) * ds
        if q.gauge is not None:
            energy += node_condition(q.gauge, dx(metadata=reference.node_rule(k)))
        residual = ufl.derivative(energy, x, δx)
        self.residual = backend.FormKind(comm, residual)
        self.tangent = backend.FormKind(comm, ufl.derivative(residual, x, Δx))
        self.line_load = backend.FormKind(comm, -ufl.inner(f, ufl.split(δx)[0]) * ds)


_KNOWN: dict[tuple[str, int], Forms] = {}


def forms_of(comm: MPI.Comm, kinematics: Kinematics, degree: int) -> Forms:
    """The forms of this kind, made at the first call in a process; collective."""
    key = (kinematics.name, degree)
    # A rank may have met this kind alone, on another communicator: compile together if any rank still has to.
    if comm.allreduce(key not in _KNOWN, op=MPI.LOR):
        _KNOWN[key] = Forms(comm, kinematics, degree)
    return _KNOWN[key]
