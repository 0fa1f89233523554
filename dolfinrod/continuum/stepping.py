"""Load stepping: the whole load first, halved where no equilibrium is found, longer again after easy steps.

Beyond a critical load Newton's method finds the state that has become unstable, whatever the step, unless it ends close
to the critical load, which nobody knows. Such a state is left along the direction in which stability was lost, to the
side where small steps lead, and from there the method finds the stable one (aside.py). Where that side is not known, or
what is found does not lie there, steps become shorter.
"""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.ahead import critical_ahead
from dolfinrod.continuum.aside import AWAY, aside
from dolfinrod.continuum.neutral import equilibrium
from dolfinrod.continuum.pressed import DIRECT
from dolfinrod.continuum.stability import Verdict
from dolfinrod.continuum.stride import EASY, Scale, Stride
from dolfinrod.continuum.watch import largest_turn_between_nodes
from dolfinrod.result import StepLog
from dolfinrod.scene import Dynamic, corners
from dolfinrod.scene.piercing import PIERCED

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.continuum.neutral import PhaseCondition
    from dolfinrod.continuum.newton import Newton, Outcome
    from dolfinrod.continuum.path import Path
    from dolfinrod.continuum.readout import Readout, State
    from dolfinrod.continuum.stability import Judge
    from dolfinrod.scene import Scene

    Found = tuple[Outcome, State, Verdict]

__all__ = ["StepFailed", "Walk", "targets"]

# Halvings of the way from one target to the next after which a step is too small to be taken.
MOST_CUTS = 12
# Halvings in search of a stable way past a point where the state found is not stable any more.
MOST_DETOURS = 8
# A prescribed turn of more than this in one step [rad] would send the interpolated quaternion through zero.
LARGEST_PRESCRIBED_TURN = np.pi / 2
# Extrapolation pays where Newton's method starts in its quadratic range anyway, which these iterations show.
SMOOTH = 4
COARSE = "sections at neighbouring nodes turn by {:.2g} rad against each other, more than the elements can tell apart"
# Directions that a round rod loses at once.
PAIR = 2
# Turns between neighbouring nodes [rad] beyond which no equilibrium is accepted, or its loss is blamed on the mesh.
ALIASED, BLURRED = np.pi, np.pi / 2


class StepFailed(RuntimeError):  # noqa: N818
    """No equilibrium at the smallest step tried."""

    advice = "Look at `.result` (what converged)"

    def __init__(self, *, t: float, step: float, reason: str, coarse: bool = False, interrupted: bool = False) -> None:
        super().__init__(reason)
        self.t, self.step, self.reason, self.coarse, self.interrupted = t, step, reason, coarse, interrupted


def targets(scene: Scene, t_0: float, until: float = np.inf) -> list[float]:
    """Pseudo-times after t_0 that must be met: the asked-for steps, the kinks of histories and where to stop."""
    motion = scene.motion
    end = min(until, motion.t_end)
    steps = 1 if isinstance(motion, Dynamic) else motion.steps or 1
    even = np.arange(1, steps + 1) / steps * motion.t_end
    return sorted({float(t) for t in (*even, *corners(scene), end) if t_0 < t <= end})


class Walk:
    """Goes from the last state of a path to the end of the pseudo-time.

    Args:
        newton: Solver of the problem.
        phase: Its free motions.
        judge: Tells stable states from others; None: nobody asks.
        readout: Gathers states.
        path: Grows by every accepted state.
        progress: Called with every accepted step and the final pseudo-time.
    """

    def __init__(
        self,
        newton: Newton,
        phase: PhaseCondition,
        judge: Judge | None,
        readout: Readout,
        path: Path,
        progress: Callable[[StepLog, float], None] | None,
    ) -> None:
        self.newton, self._phase, self._judge, self._readout = (newton, phase, judge, readout)
        self.path, self._progress = path, progress
        # Points that come to touch take iterations, however short the step.
        self._easy = EASY if newton.problem.contacts is None else DIRECT
        self._stride = Stride(easy=self._easy)
        scene = newton.problem.scene
        self._corners = set(corners(scene))

    def run(self, until: float = np.inf) -> None:
        """Meet every target up to a pseudo-time.

        Raises:
            StepFailed: No equilibrium was found even at the smallest step.
        """
        scene = self.newton.problem.scene
        for target in targets(scene, self.path.t[-1], until):
            scale = Scale(self.path.t[-1], target - self.path.t[-1])
            while self.path.t[-1] < target:
                self._step(target, scale)

    def _step(self, target: float, scale: Scale) -> None:
        """Try one step towards the target, and accept it or make the next one shorter."""
        path, problem, t = self.path, self.newton.problem, self.path.t[-1]
        tried = self._stride.next(target - t)
        while problem.constraints.largest_turn(t, t + tried) > LARGEST_PRESCRIBED_TURN * (1 + 1e-12):
            tried /= 2
        t_next = target if tried >= target - t else t + tried
        outcome, state, verdict = self._attempt(t_next, tried, closely=t_next == target)
        path.iterations += outcome.iterations
        if state is not None and verdict is not None:
            outcome, state, verdict = self._beside(t_next, (outcome, state, verdict))
            # The way to a stable state may only be too steep for so long a step, or lead to where the path does not.
            lost = outcome.strayed or (verdict.avoidable and path.stable is not False)
            if lost and self._foresees(scale, tried):
                return
            if not lost or tried <= scale.at(t) / 2**MOST_DETOURS:
                self._accept(t_next, outcome, state, verdict)
                self._stride.succeed(tried, outcome.iterations)
                if lost:
                    self._stride = Stride(easy=self._easy)
                return
        self._readout.restore(path.states[-1])
        self._stride.fail(tried)
        if self._stride.length <= scale.at(t) / 2 ** (MOST_CUTS + 1):
            turn = largest_turn_between_nodes(problem)
            coarse = turn > BLURRED
            reason = COARSE.format(turn) if coarse else outcome.reason
            raise StepFailed(t=t, step=tried, reason=reason, coarse=coarse)

    def _foresees(self, scale: Scale, tried: float) -> bool:
        """Whether the first critical point ahead is nearer than a step over it: no longer one is tried next."""
        problem, t = self.newton.problem, self.path.t[-1]
        if scale.looked or t > scale.start or problem.contacts is not None:
            return False
        scale.looked = True
        critical = critical_ahead(self._readout, self.path.states[-1], t)
        if not critical < t + tried or not scale.near(t, critical):
            return False
        self._readout.restore(self.path.states[-1])
        self._stride.fail(2.0 * scale.way)
        return True

    def _attempt(self, t: float, step: float, *, closely: bool) -> tuple[Outcome, State | None, Verdict | None]:
        """Equilibrium at t; the state and what it is worth, if one was found that the elements can show."""
        path, problem = self.path, self.newton.problem
        smooth = len(path.log) > 1 and path.log[-1].iterations <= SMOOTH and path.t[-1] not in self._corners
        last = None
        if smooth and step <= (path.t[-1] - path.t[-2]) * (1 + 1e-9):
            last = problem.x.copy()
            self._readout.restore(self._extrapolated(step / (path.t[-1] - path.t[-2])))
        problem.advance_to(t)
        if problem.contacts is not None and path.log and not self._stride.cuts and path.t[-1] not in self._corners:
            problem.contacts.glide()
        outcome = equilibrium(self.newton, self._phase, last)
        if not outcome.converged:
            return outcome, None, None
        through = PIERCED if problem.walls is not None and problem.walls.pierced else ""
        if through := through or ("" if problem.pairs is None else problem.pairs.pierced):
            return replace(outcome, converged=False, reason=through), None, None
        turn = largest_turn_between_nodes(problem)
        if turn > ALIASED:
            return replace(outcome, converged=False, reason=COARSE.format(turn)), None, None
        state = self._readout.state()
        return outcome, state, self._judged(state, t, closely=closely)

    def _judged(self, state: State, t: float, *, closely: bool) -> Verdict:
        """Whether the problem's present state is stable, with the time it takes to find out."""
        if self._judge is None:
            return Verdict(None)
        started = time.perf_counter()
        verdict = self._judge.verdict(state, t, closely=closely)
        self.path.seconds_stability += time.perf_counter() - started
        return verdict

    def _beside(self, t: float, found: Found) -> Found:
        """What was found at t; or, where the way to it has lost stability, the stable state to which small steps lead.

        Where more than a pair of directions is lost other critical points lie between, and shorter steps tell more.
        """
        (outcome, state, verdict), problem, path = found, self.newton.problem, self.path
        lost = verdict.avoidable and path.stable is not False and (verdict.directions or 0) <= PAIR
        if not lost or self._phase.needed or problem.contacts is not None:
            return found
        self._readout.restore(path.states[-1])
        last = problem.x.copy()
        self._readout.restore(state)
        way = aside(self.newton, last)
        if way is None:
            return found
        for turn in AWAY:
            way.leave(turn)
            again = equilibrium(self.newton, self._phase, last)
            path.iterations += again.iterations
            reached = again.converged and not again.strayed and way.reached()
            if reached and largest_turn_between_nodes(problem) <= ALIASED:
                beside = self._readout.state()
                judged = self._judged(beside, t, closely=False)
                if judged.stable:
                    return replace(again, iterations=outcome.iterations + again.iterations), beside, judged
        self._readout.restore(state)
        return found

    def _extrapolated(self, factor: float) -> State:
        """The last state, and what led to it once more, times a factor."""
        before, last = self.path.states[-2:]
        kin = self.newton.problem.kinematics
        beyond = {f: last[f] + factor * (last[f] - before[f]) for f in kin.fields if f != "q"}
        return beyond | {"q": kin.extrapolated(before["q"], last["q"], factor)}

    def _accept(self, t: float, outcome: Outcome, state: State, verdict: Verdict) -> None:
        path, contacts = self.path, self.newton.problem.contacts
        if contacts is not None:
            contacts.accept()
            state |= self._readout.touched()
        path.t.append(t)
        path.states.append(state)
        path.energy.append(self._readout.energy())
        path.stable = verdict.stable
        row = StepLog(
            t,
            outcome.iterations,
            self._stride.cuts,
            outcome.residual,
            path.energy[-1],
            verdict.stable,
            verdict.directions,
        )
        path.log.append(row)
        if self._progress is not None:
            self._progress(row, self.newton.problem.scene.motion.t_end)
