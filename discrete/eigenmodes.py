"""`discrete.buckling`, `discrete.critical`, `discrete.modes`: what an equilibrium is about to do, how it vibrates."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from discrete.ahead import critical_ahead
from discrete.digits import demand_digits, lost
from discrete.krylov import REAL, clusters
from discrete.mass import densities, masses
from discrete.onward import varies
from discrete.session import Session
from discrete.shapes import shapes
from discrete.stability import spectrum
from discrete.statics import StepFailed, targets
from dolfinrod.eigen import Buckling, Modes
from dolfinrod.scene import SceneError
from dolfinrod.scene.quantity import count

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

__all__ = ["buckling", "critical", "modes"]

MOST_MODES = 100
# Part of the way to a predicted critical point that is gone: the first is a guess from afar.
FIRST, FURTHER = 0.5, 0.9
# Part of a stride by which a prediction that goes on with the rod recedes.
RECEDED = 0.5
# Longest stride of the search in t_end, and two predictions in a row that agree so well end it.
LONGEST, ACCURACY = 0.25, 1e-10
# Nearer than this part of it, squared the error of a prediction, a critical point is not approached.
NEAR = 1e-5
MOST_STRIDES, MOST_HALVINGS = 60, 20
# ω² below this part of the shift that keeps rigid motions from making the tangent singular is round-off.
RIGID = 1e-6


def buckling(scene: Scene, *, modes: int = 3, at: Result | None = None, elements: int | Sequence[int] = 80) -> Buckling:
    """Critical loads seen from an equilibrium at t, (K + (t_cr − t) dK/dt) v = 0 with K the tangent along the path.

    Exact where the tangent changes linearly with the load, as in straight columns; an estimate where the rod bends
    before it buckles, better the nearer the equilibrium (`critical` goes there).

    Args:
        scene: The problem.
        modes: Number of modes sought; fewer are found where fewer exist.
        at: A result of the same scene: the equilibrium at its last pseudo-time, on its elements; by default that at
            t = 0, under steady loads.
        elements: Elements of each rod, one number for all or one a rod.

    Returns:
        Critical pseudo-times, the next one first, with multiplicities and shapes.

    Raises:
        SceneError: The scene or an option cannot be solved as given, no load varies, or so many elements leave fewer
            than three digits.
        NotConverged: No equilibrium under the steady loads.
    """
    n = count(modes, "modes", MOST_MODES)
    session = Session(scene, elements, at)
    if not varies(session.scene, session.t):
        raise SceneError(f"nothing varies with the pseudo-time from t = {session.t:g} on: no load becomes critical")
    return next_critical(session, n)


def critical(scene: Scene, *, modes: int = 3, elements: int | Sequence[int] = 80) -> Buckling:
    """First critical point on the path from t = 0 to t_end, deformation before it included.

    From an equilibrium at t the next critical point is predicted at t + μ, with an error of order μ². Each next
    equilibrium lies short of the prediction, or boldly beyond it where predictions have receded as fast as the rod went
    on; a step that no equilibrium allows, or that went past a critical point, is halved.

    Args:
        scene: The problem.
        modes: Number of modes sought there.
        elements: Elements of each rod, one number for all or one a rod.

    Returns:
        The first factor is the critical pseudo-time, to about 1e-9; those of other modes are estimates from there.
        None where the whole path is free of critical points. `at` is the equilibrium just below.

    Raises:
        SceneError: The scene or an option cannot be solved as given, or so many elements leave fewer than three digits.
        NotConverged: No equilibrium on the way.
    """
    n = count(modes, "modes", MOST_MODES)
    session = Session(scene, elements, None)
    before, gone, part, bold, found = np.inf, 0.0, FIRST, 1.0, next_critical(session, n)
    for _ in range(MOST_STRIDES):
        predicted = min(found.factors, default=np.inf)
        corner = min(targets(scene, session.t, 1), default=session.t)
        settled = abs(predicted - before) <= ACCURACY * predicted or predicted - session.t <= NEAR * predicted
        if settled and predicted <= corner * (1.0 + ACCURACY):
            return found
        if session.t >= corner:
            return _none(found)
        bold = 2.0 * bold if predicted - before > RECEDED * gone else 1.0
        short = min(part * bold * (predicted - session.t), LONGEST * scene.motion.t_end)
        start = session.t
        found = _stride(session, min(start + short, corner), n, predicted)
        before, gone, part = predicted, session.t - start, FURTHER
    raise session.failed(StepFailed(t=session.t, step=0.0, reason="the predicted critical load does not settle"))


def modes(scene: Scene, *, modes: int = 6, at: Result | None = None, elements: int | Sequence[int] = 80) -> Modes:
    """Natural frequencies and shapes of small vibrations about an equilibrium, K v = ω² M v.

    Masses are those of the paper's nodes, see `discrete.mass`; order 2 in the length of the elements, from below.

    Args:
        scene: The problem.
        modes: Number of modes sought.
        at: A result of the same scene: the equilibrium at its last pseudo-time, on its elements; by default that at
            t = 0, under steady loads.
        elements: Elements of each rod, one number for all or one a rod.

    Returns:
        Frequencies nearest to zero, unstable directions first, with multiplicities and shapes.

    Raises:
        SceneError: The scene or an option cannot be solved as given, a section has no density, or so many elements
            leave fewer than three digits.
        NotConverged: No equilibrium under the steady loads.
    """
    n = count(modes, "modes", MOST_MODES)
    ρA, ρI = densities([rod.section for rod in scene.rods])
    session = Session(scene, elements, at)
    mesh = session.equilibrium.mesh
    mass = masses(mesh, ρA, ρI)
    # Neutral motions are vibrations of zero frequency here: no phase condition where they have inertia.
    session.release(mass)
    shift = 1.0 / float(mass.m.sum())
    λ, v = spectrum(session.tangent, session.state.R, mass, n, shift=shift)
    λ = np.where(np.abs(λ) <= RIGID * shift, 0.0, λ)
    moving = λ != 0.0
    demand_digits(lost(session.tangent, v[:, moving].real), len(mesh.elements.l), "squares of frequencies")
    λ = np.where(np.abs(λ.imag) <= REAL * np.abs(λ), λ.real + 0j, λ)
    order = np.lexsort([λ.real, (λ.imag == 0.0) & (λ.real >= 0.0)])
    λ, v = λ[order], v[:, order]
    return Modes(np.sqrt(λ), clusters(λ), shapes(mesh, session.tangent, v.real), session.result())


def next_critical(session: Session, n: int) -> Buckling:
    """The next n critical points seen from an equilibrium, (K + μ dK/dt) v = 0 with least μ > 0."""
    tangent, t, mesh = session.tangent, session.t, session.equilibrium.mesh
    found = critical_ahead(session.equilibrium, session.scene, session.state, t, tangent, n)
    real = np.abs(found.way.imag) <= REAL * np.abs(found.way)
    ahead = found.way[real].real
    factors = t + ahead
    demand_digits(found.lost[real] * ahead / factors, len(mesh.elements.l), "critical loads")
    rods = shapes(mesh, tangent, found.motion[:, real].real)
    return Buckling(factors, clusters(factors), rods, session.result(), t + found.way[~real])


def _none(found: Buckling) -> Buckling:
    """The record of no critical point."""
    rods = tuple(replace(rod, displacement=rod.displacement[:0], spin=rod.spin[:0]) for rod in found.rods)
    return replace(found, factors=found.factors[:0], multiplicity=found.multiplicity[:0], rods=rods)


def _stride(session: Session, t: float, n: int, predicted: float) -> Buckling:
    """Go on to t, or as far as no critical point lies behind; what is predicted from there."""
    start = session.t
    failure = StepFailed(t=start, step=t - start, reason="critical points follow one another too closely")
    for _ in range(MOST_HALVINGS):
        outcome = session.reach(t)
        if outcome is not None and session.leads_on(outcome, bold=t > predicted):
            session.accept(outcome, t)
            return next_critical(session, n)
        t = 0.5 * (start + t)
    raise session.failed(failure)
