"""Hard cases in motion: finished with a ledger that closes, or refused in words; a blow-up shows in the ledger."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from dolfinrod.scene import Dynamic, ImplicitEuler, Midpoint, SceneError
from verification.patience import CRAWLS, Patience

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from dolfinrod.scene.motion import Scheme
    from verification.whereabouts import Whereabouts

    Array = NDArray[np.float64]

__all__ = ["SOLVERS", "HardMotion", "MotionRow", "books", "hard_motion"]

SOLVERS: tuple[tuple[str, Scheme], ...] = (
    ("discrete", ImplicitEuler()),
    ("continuum", ImplicitEuler()),
    ("continuum", Midpoint()),
)
STORED = ("kinetic", "strain", "potential")
WORKS = ("load work", "support work", "drag", "damping", "numerical")
# Gap of the ledger over the largest entry: what Newton's method leaves of a step, 1e-9 of the motion in it.
CLOSED = 1e-8
# Part of all energy that went in beyond which what the steps took is called a loss, and what they made a blow-up.
LOSS, GAIN = 1e-2, 0.5
# Error of half a step over that of a whole one below which the step is to blame: a quarter of smooth motions, a half
# where speeds jump.
CLOSER = 0.75
# Gain that a scheme which only dissipates may have: round-off.
ROUND_OFF = 1e-8


@dataclass(frozen=True)
class HardMotion:
    """A motion that schemes stumble over.

    Args:
        name: Short, unique.
        group: What is hard about it.
        title: For people.
        scene: The problem; its scheme is replaced.
        check: Of where it ends; None: its steps resolve nothing, the ledger alone judges.
        elements: Of the continuum model.
        degree: Of the continuum model.
        discrete: Elements of the discrete model.
        limit: Error over the length of the rod beyond which the end is another one.
    """

    name: str
    group: str
    title: str
    scene: Callable[[], Scene] = field(repr=False)
    check: Whereabouts | None = None
    elements: int = 16
    degree: int = 3
    discrete: int = 40
    limit: float = 1e-2

    @property
    def dt(self) -> float:
        """Its step [s]."""
        motion = self.scene().motion
        assert isinstance(motion, Dynamic)
        assert motion.dt is not None
        return motion.dt


@dataclass(frozen=True)
class MotionRow:
    """A hard motion by one model and scheme.

    Args:
        case: Its name.
        group: What is hard about it.
        title: For people.
        solver: Model, scheme and mesh.
        outcome: "finished"; "damped", "swings": the ledger says that the steps took, or made for a while, a part of the
            energy; "coarse": another end than a finer solve with a clean ledger, nearer in steps of half the length;
            "refused"; "crawls": stopped, its steps fail more often than they succeed; "WRONG", whether it
            reached the end or not: half of the energy that went in, or more, made by the steps (any by a scheme that
            only dissipates), a ledger that does not close, or another end with a clean ledger, in shorter steps too.
        reason: Of a refusal or of what is wrong.
        steps: Accepted.
        iterations: Newton iterations.
        cuts: Failed attempts.
        gap: Of the ledger, over its largest entry.
        lost: Energy that the steps took, at the end, over all that went in; negative where they made some.
        gained: Most that they had made at any time, over the same.
        error: Of the centreline at the end over the length; NaN where nothing is known.
        check: What it is measured against.
        ms: Of a step [ms].
    """

    case: str
    group: str
    title: str
    solver: str
    outcome: str
    reason: str
    steps: int
    iterations: int
    cuts: int
    gap: float
    lost: float
    gained: float
    error: float
    check: str
    ms: float

    @property
    def holds(self) -> bool:
        """Everything but a wrong end without a word, or no end."""
        return self.outcome not in ("WRONG", "crawls")


def hard_motion(case: HardMotion, model: str, scheme: Scheme) -> MotionRow:
    """Solve with default settings, and audit.

    Args:
        case: What moves.
        model: "continuum" or "discrete".
        scheme: Of the steps.

    Returns:
        The row, also of what was refused.
    """
    started, result, outcome, reason = time.perf_counter(), None, "", ""
    posed = case.scene()
    assert isinstance(posed.motion, Dynamic)
    patience = Patience(posed.motion)
    try:
        result = _solved(case, model, replace(posed, motion=replace(posed.motion, scheme=scheme)), patience)
    except NotConverged as failed:
        result = failed.result
        outcome, reason = ("crawls", CRAWLS) if patience.over else ("refused", failed.reason)
    except SceneError as refused:
        outcome, reason = "refused", str(refused)
    seconds = time.perf_counter() - started
    gap, lost, gained, error = (np.nan,) * 4
    if result is not None:
        gap, lost, gained = books(result.energy)
        if not outcome:
            seconds = result.statistics.seconds_solve
            error, reason = _checked(case, result)
            outcome = "damped" if lost > LOSS else "swings" if gained > LOSS else "finished"
        wrong = _wrong(scheme, gap, gained)
        if wrong:
            outcome, reason = "WRONG", f"{wrong}; {reason}" if reason else wrong
        elif error > case.limit and max(lost, gained) <= LOSS:
            outcome, reason = _off(case, model, result.scene, error)
    taken = (0, 0, 0) if result is None else _taken(result)
    check = "the ledger alone" if case.check is None else case.check.words
    ms = 1e3 * seconds / taken[0] if taken[0] else np.nan
    found = _words(case, model, scheme), outcome, reason
    return MotionRow(case.name, case.group, case.title, *found, *taken, gap, lost, gained, error, check, ms)


def _words(case: HardMotion, model: str, scheme: Scheme) -> str:
    """Model, scheme and mesh."""
    kind = "midpoint" if isinstance(scheme, Midpoint) else "implicit Euler"
    mesh = f"{case.elements} × P{case.degree}" if model == "continuum" else f"{case.discrete}"
    return f"{model}, {kind}, {mesh}"


def _taken(result: Result) -> tuple[int, int, int]:
    """Steps, Newton iterations and failed attempts."""
    return len(result.log), result.statistics.newton_iterations, sum(step.cuts for step in result.log)


def _checked(case: HardMotion, result: Result) -> tuple[float, str]:
    """Error of the end, and why there is none where the check itself did not do."""
    if case.check is None:
        return np.nan, ""
    try:
        return case.check.error(result, case), ""
    except ArithmeticError as unsound:
        return np.nan, f"{case.check.words}: no check, {unsound}"


def books(energy: dict[str, Array]) -> tuple[float, float, float]:
    """Audit of a ledger.

    Args:
        energy: As a result has it.

    Returns:
        Gap |Δstored − works|, energy that the steps took at the end, and most that they had made at any time, the first
        over the largest entry, the others over all that went in: what was there at the start and every positive work.
    """
    total = sum(energy[name] - energy[name][0] for name in STORED)
    works = sum(energy[name] - energy[name][0] for name in WORKS)
    largest = max(float(np.abs(energy[name] - energy[name][0]).max()) for name in (*STORED, *WORKS))
    largest = max(largest, float(energy["kinetic"][0] + energy["strain"][0]))
    brought = sum(float(np.maximum(np.diff(energy[name]), 0.0).sum()) for name in WORKS[:3])
    falls = np.maximum(energy["potential"][0] - energy["potential"], 0.0).max()
    supplied = float(energy["kinetic"][0] + energy["strain"][0]) + brought + float(falls)
    made = energy["numerical"] - energy["numerical"][0]
    least = float(np.finfo(float).tiny)
    gap = float(np.abs(total - works).max()) / max(largest, least)
    return gap, -float(made[-1]) / max(supplied, least), float(made.max()) / max(supplied, least)


def _wrong(scheme: Scheme, gap: float, gained: float) -> str:
    """What is wrong, or nothing."""
    if not gap <= CLOSED:
        return f"the ledger leaves a gap of {gap:.1e} of its largest entry"
    most = GAIN if isinstance(scheme, Midpoint) else ROUND_OFF
    if not gained <= most:
        return f"the steps made {gained:.2g} times the energy that went in"
    return ""


def _off(case: HardMotion, model: str, scene: Scene, error: float) -> tuple[str, str]:
    """Outcome and reason of another end with a clean ledger: long steps if a half of them is nearer, else wrong."""
    motion = scene.motion
    assert isinstance(motion, Dynamic)
    assert motion.dt is not None
    shorter = replace(motion, dt=motion.dt / 2)
    try:
        left, _ = _checked(case, _solved(case, model, replace(scene, motion=shorter), Patience(shorter)))
    except NotConverged:
        left = np.nan
    if left <= CLOSER * error:
        return "coarse", f"its steps are too long for where it ends: half of them end {left:.2g} off"
    return "WRONG", f"ends {error:.2g} off, with a clean ledger"


def _solved(case: HardMotion, model: str, scene: Scene, patience: Patience) -> Result:
    if model == "continuum":
        from dolfinrod.continuum import solve

        return solve(scene, elements=case.elements, degree=case.degree, progress=patience)
    from discrete import solve as solve_discrete

    return solve_discrete(scene, elements=case.discrete, progress=patience)
