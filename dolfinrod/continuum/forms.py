"""The weak form of rods of one kind: written and compiled once for a kinematics and a degree."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from mpi4py import MPI

import ufl

from dolfinrod.continuum import backend, reference
from dolfinrod.continuum.terms.elastic import stored_energy, symmetric
from dolfinrod.continuum.terms.excess import excess_strains, excess_work
from dolfinrod.continuum.terms.gauge import node_condition

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.continuum.kinematics import Kinematics

F = TypeVar("F")

__all__ = ["ExcessForms", "Forms", "excess_forms_of", "forms_of"]


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


class ExcessForms:
    """Residual and tangent of strains beside those of the state at which forces act, added to those of the rods.

    Forces act at x, the 1/a-th part of the way from x₀, before a step of length h, to x₁ = a x + (1 − a) x₀, after it.

    Args:
        comm: All its ranks call together.
        kinematics: Spatial or planar.
        degree: Degree of centreline and rotation.

    Attributes:
        elements: Name of each coefficient → its element: x, x₀, the weights of the strains at x₁, x₀ and x, and a.
        coefficients: Name → its symbol in the forms.
    """

    def __init__(self, comm: MPI.Comm, kinematics: Kinematics, degree: int) -> None:
        fields = ufl.MixedElement(kinematics.elements(degree))
        self.elements = {"x": fields, "x_0": fields, "weights": backend.discontinuous(0, 4)}
        spaces = backend.abstract_spaces(*self.elements.values())
        x, x_0, weights, held = (ufl.Coefficient(V, count=i) for i, V in enumerate((*spaces, spaces[0])))
        self.coefficients = dict(zip(self.elements, (x, x_0, weights), strict=True))
        a, here, before = weights[3], ufl.split(held), ufl.split(x_0)
        after = tuple(a * u + (1 - a) * u_0 for u, u_0 in zip(here, before, strict=True))
        ends = kinematics.configuration(after), kinematics.configuration(before)
        strains = excess_strains(*ends, kinematics.configuration(here), (weights[0], weights[1], weights[2]))
        ds = ufl.dx(domain=spaces[0].ufl_domain(), metadata={"quadrature_degree": 2 * degree})
        work = excess_work(kinematics.configuration(ufl.split(x)), *strains) * ds
        residual = ufl.replace(ufl.derivative(work, x, ufl.TestFunction(spaces[0])), {held: x})
        self.residual = backend.FormKind(comm, residual)
        self.tangent = backend.FormKind(comm, ufl.derivative(residual, x, ufl.TrialFunction(spaces[0])))


_KNOWN: dict[tuple[str, int], Forms] = {}
_KNOWN_EXCESS: dict[tuple[str, int], ExcessForms] = {}


def forms_of(comm: MPI.Comm, kinematics: Kinematics, degree: int) -> Forms:
    """The forms of this kind, made at the first call in a process; collective."""
    return _known(_KNOWN, Forms, comm, kinematics, degree)


def excess_forms_of(comm: MPI.Comm, kinematics: Kinematics, degree: int) -> ExcessForms:
    """Those of strains beside, likewise."""
    return _known(_KNOWN_EXCESS, ExcessForms, comm, kinematics, degree)


def _known(
    known: dict[tuple[str, int], F],
    make: Callable[[MPI.Comm, Kinematics, int], F],
    comm: MPI.Comm,
    kinematics: Kinematics,
    degree: int,
) -> F:
    key = (kinematics.name, degree)
    # A rank may have met this kind alone, on another communicator: compile together if any rank still has to.
    if comm.allreduce(key not in known, op=MPI.LOR):
        known[key] = make(comm, kinematics, degree)
    return known[key]
