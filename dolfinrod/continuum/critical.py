"""`dolfinrod.critical`: the first critical point on a path, approached from below."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.eigenmodes import MOST_MODES, next_critical, no_critical
from dolfinrod.continuum.session import opened
from dolfinrod.continuum.stepping import StepFailed, targets
from dolfinrod.scene.quantity import count

if TYPE_CHECKING:
    from mpi4py import MPI

    from dolfinrod.continuum.session import Session
    from dolfinrod.eigen import Buckling
    from dolfinrod.scene import Planar, Scene, Spatial

__all__ = ["critical"]

# Two predictions in a row that agree so well, relative to the pseudo-time, end the search.
ACCURACY = 1e-10
# Part of the way to a predicted critical point that is gone: the first is a guess from afar.
FIRST, FURTHER = 0.5, 0.9
# Longest stride in t_end, whatever the prediction.
LONGEST = 0.25
# Strides of the search, and halvings of one of them.
MOST_STRIDES, MOST_HALVINGS = 60, 20


def critical(
    scene: Scene,
    *,
    modes: int = 3,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: MPI.Comm | None = None,
) -> Buckling:
    """First critical point from t = 0 on; see `dolfinrod.critical`.

    From an equilibrium at t the next critical point is predicted at t + μ, with an error of order μ². Each next
    equilibrium lies short of the prediction, so the last one is stable if the first was; a step that turns out to
    have gone past a critical point or to another branch, or that no equilibrium allows, is halved.
    """
    n = count(modes, "modes", MOST_MODES)
    with opened(scene, kinematics, comm, degree, elements) as session:
        session.begin(None)
        session.judge_start()
        return _search(session, n)


def _search(session: Session, n: int) -> Buckling:
    """Strides towards the prediction until it stays; none beyond the end of the path."""
    scene = session.problem.scene
    found, _ = next_critical(session, n)
    before, part = np.inf, FIRST
    for _ in range(MOST_STRIDES):
        predicted = min(found.factors, default=np.inf)
        corner = min(targets(scene, session.t), default=session.t)
        if predicted <= corner * (1.0 + ACCURACY) and abs(predicted - before) <= ACCURACY * predicted:
            return found
        if session.t >= corner:
            return no_critical(session)
        short = min(part * (predicted - session.t), LONGEST * scene.motion.t_end)
        found = _stride(session, min(session.t + short, corner), n)
        before, part = predicted, FURTHER
    raise session.failed(StepFailed(t=session.t, step=0.0, reason="the predicted critical load does not settle"))


def _stride(session: Session, t: float, n: int) -> Buckling:
    """Go on to t, or as far as no critical point lies behind; what is predicted from there."""
    start, known, stable = session.t, len(session.path.t), session.path.stable
    failure = StepFailed(t=start, step=t - start, reason="critical points follow one another too closely")
    for _ in range(MOST_HALVINGS):
        try:
            session.go_to(t)
            # Stability once lost: a critical point lies behind, or Newton's method has found another branch.
            if session.path.stable is not False or stable is False:
                found, passed = next_critical(session, n)
                if passed <= start:
                    return found
        except StepFailed as failed:
            failure = failed
        session.go_back(known, stable=stable)
        t = 0.5 * (start + t)
    raise session.failed(failure)
