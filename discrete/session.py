"""An equilibrium to be looked at: reached from an earlier result or from the stress-free state, and gone on from."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from discrete.branches import Branches
from discrete.failure import advice
from discrete.mass import at_nodes
from discrete.record import recorded
from discrete.solver import beginning
from discrete.stability import Judge
from discrete.statics import StepFailed
from discrete.touching import energetic
from dolfinrod.result import NotConverged, Result, StepLog
from dolfinrod.scene import SceneError, in_time
from dolfinrod.scene.door import admit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from discrete.mass import Masses
    from discrete.nodes import Tangent
    from discrete.stability import Verdict
    from discrete.state import Outcome, State
    from dolfinrod.scene import Scene

__all__ = ["Session"]


class Session:
    """One equilibrium of a scene at a time.

    Args:
        scene: The problem.
        elements: Elements of each rod.
        at: A result of the scene, to begin at its last state and on its elements; None: t = 0.

    Attributes:
        t: Its pseudo-time.
        state: The equilibrium.
        tangent: There.

    Raises:
        SceneError: The scene, the elements or the result are not what they should be.
        NotConverged: No equilibrium there.
    """

    state: State
    tangent: Tangent
    t: float

    def __init__(self, scene: Scene, elements: int | Sequence[int], at: Result | None) -> None:
        admit(scene, at, Result)
        self._started = time.perf_counter()
        if at is not None:
            if at.scene != scene:
                raise SceneError("at must be a result of this scene, got one of another")
            elements = [len(rod.s) - 1 for rod in at.rods]
        if scene.meetings:
            raise SceneError("must not be of rods with rods here: these are not judged together", field="contacts")
        if not energetic(scene):
            needed = "must not rub nor have multipliers here: such contact has a memory, and no tangent tells what is"
            raise SceneError(f"{needed} critical", field="contacts")
        self.scene = scene = in_time(scene)
        self._phase, self._path = beginning(scene, elements, at)
        self.equilibrium = self._phase.equilibrium
        self._judge = Judge(scene, self.equilibrium.mesh)
        self._branches = Branches(self.equilibrium, self._judge, scene)
        self.t = 0.0 if at is None else float(at.t[-1])
        self.state = self._path.state
        outcome = self.reach(self.t)
        if outcome is None:
            raise self.failed(StepFailed(t=self.t, step=0.0, reason="no equilibrium under the steady loads"))
        self._path.kept.clear()
        self.accept(outcome, self.t)

    def reach(self, t: float) -> Outcome | None:
        """Equilibrium at a pseudo-time from the current one, None where there is none."""
        outcome = self._phase.find(self.state, t)
        self._path.iterations += outcome.iterations
        return outcome if outcome.converged else None

    def judged(self, outcome: Outcome) -> Verdict:
        """Its stability."""
        return self._judge.verdict(outcome.tangent, outcome.state.R)

    def leads_on(self, outcome: Outcome, *, bold: bool) -> bool:
        """Whether no critical point lies between here and there, nor, after a bold stride, the way to a stable branch.

        Args:
            outcome: An equilibrium.
            bold: Whether it lies beyond where a critical point was expected.
        """
        if self.judged(outcome).gives_way:
            return False
        return not (bold and self._branches.strayed(self.state, self.t, outcome.state))

    def accept(self, outcome: Outcome, t: float) -> None:
        """Go to an equilibrium."""
        self.equilibrium.accept(outcome.state, t)
        kept = self.equilibrium.snapshot(outcome.state, t)
        energy = kept.energy * self.equilibrium.mesh.units.moment
        verdict = self.judged(outcome)
        row = StepLog(t, outcome.iterations, 0, outcome.residual, energy, verdict.stable, verdict.counted)
        self._path.state = self.state = outcome.state
        self._path.accept(kept, row, None, self.scene.motion.t_end)
        self.t, self.tangent = t, self.equilibrium.tangent(outcome.state, self.equilibrium.loads.level(t), t)

    def release(self, mass: Masses) -> None:
        """Let neutral motions go in which something with inertia moves."""
        M = at_nodes(mass.elements(self.state.R, self.tangent), self.tangent)
        self._phase.release(self.state, self.tangent, M)
        self.tangent = self.equilibrium.tangent(self.state, self.equilibrium.loads.level(self.t), self.t)

    def result(self, *, converged: bool = True) -> Result:
        """The record of the way to it."""
        seconds = (0.0, time.perf_counter() - self._started)
        about = self._phase.notes, seconds, self.equilibrium.memory()
        return recorded(self.scene, self.equilibrium.mesh, self._path, *about, converged=converged)

    def failed(self, failure: StepFailed) -> NotConverged:
        """The failure as a user sees it."""
        return NotConverged(
            result=self.result(converged=False),
            t=failure.t,
            step=failure.step,
            reason=failure.reason,
            advice=advice(self.scene, self.equilibrium.mesh, failure, self._path.log),
        )
