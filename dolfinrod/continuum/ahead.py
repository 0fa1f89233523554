"""The critical points that a path leads to, seen from an equilibrium on it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum.direct import LIBRARY_ERROR
from dolfinrod.continuum.linearization import continued, settle, tangent_and_rate, varies
from dolfinrod.continuum.neutral import PhaseCondition
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.spectrum import Spectrum

if TYPE_CHECKING:
    from dolfinrod.continuum.readout import Readout, State

__all__ = ["critical_ahead", "looking_on"]


@contextmanager
def looking_on(readout: Readout, state: State, t: float) -> Iterator[tuple[Problem, Spectrum]]:
    """The path continued in straight lines from an equilibrium, and the spectrum θ of K⁻¹ dK/dt: critical at t − 1/θ.

    Args:
        readout: Of the problem whose path it is; its state afterwards is the equilibrium.
        state: The equilibrium, gathered.
        t: Its pseudo-time.

    Yields:
        The continued problem and the spectrum.
    """
    here = readout.problem
    d = here.discretization
    problem = Problem(continued(here.scene, t), d, here.placement)
    readout.restore(state)
    settle(problem)
    phase = PhaseCondition(problem)
    if phase.needed:
        problem.assemble_tangent(d.matrix)
        phase.hold_null(d.matrix)
    K, dK = tangent_and_rate(problem)
    spectrum = Spectrum(dK, K)
    try:
        yield problem, spectrum
    finally:
        spectrum.close()
        for owned in (K, dK):
            owned.destroy()
        here.advance_to(t)
        readout.restore(state)


def critical_ahead(readout: Readout, state: State, t: float) -> float:
    """Pseudo-time at which the loads are critical next, seen from an equilibrium; infinite where none is seen."""
    if not varies(readout.problem.scene, t):
        return np.inf
    try:
        with looking_on(readout, state, t) as (_, spectrum):
            θ = spectrum.most_negative_first(1).values
    except PETSc.Error as error:
        # MUMPS cannot factorise the tangent: it is singular here.
        if error.ierr != LIBRARY_ERROR:
            raise
        return t
    return float(min((t - 1.0 / θ[θ.imag == 0.0]).real, default=np.inf))
