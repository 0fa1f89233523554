"""One bundle in ever shorter steps: until when paths are those of the equations, and what the step decides later."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, log2, pi, sqrt

import numpy as np

from dolfinrod.groove import Scenario
from dolfinrod.scene import Contact, Dynamic, ImplicitEuler, Plane, Rod, Scene, Velocity
from verification.stepper import ContinuumStepper, DiscreteStepper

__all__ = ["FIRST_ORDER", "NUDGE", "PARTS", "GrooveSteps", "in_shorter_steps"]

# By which all fibres are raised at the start [m]: a thousandth of the noise that tells one bundle from the next.
NUDGE = 1e-9
# The order of implicit Euler is one; less than this is none.
FIRST_ORDER = 0.9
# Whole steps, half ones, and a quarter.
PARTS = (1, 2, 4)
# A fibre that strikes a wall: its speed [m/s], its length [m], and for how many times of contact it is followed.
STRIKES, PIECE, FOLLOWED = 3.0, 1e-3, 4.0


@dataclass(frozen=True)
class GrooveSteps:
    """Paths of one bundle in steps of three lengths, and beside those of the same bundle raised a little.

    Args:
        title: What it is.
        model: That solved all.
        steps: Whole, half, and a quarter [s].
        t: Stored times but the first [s].
        halved: Largest distance of a node in whole steps from itself in half ones [m].
        quartered: The same of half ones from a quarter [m].
        nudged: Of the bundle from the raised one, less the way by which it was raised, in whole steps [m].
        noise: That tells one bundle from the next [m].
        rebound: Speed with which a fibre leaves a wall over that with which it came, in each length of step.
        damping: Of contact, over the critical one of a fibre.
    """

    title: str
    model: str
    steps: tuple[float, ...]
    t: tuple[float, ...]
    halved: tuple[float, ...]
    quartered: tuple[float, ...]
    nudged: tuple[float, ...]
    noise: float
    rebound: tuple[float, ...]
    damping: float = 0.0

    @property
    def trusted(self) -> int:
        """The last stored time up to which the two shorter steps differ by less than the noise."""
        beyond = np.flatnonzero(np.array(self.quartered) > self.noise)
        return int(beyond[0]) - 1 if len(beyond) else len(self.t) - 1

    @property
    def order(self) -> float:
        """Observed at that time: log₂ of the first difference over the second; none where they never were so near."""
        if self.trusted < 0:
            return 0.0
        first, second = self.halved[self.trusted], self.quartered[self.trusted]
        return log2(first / second) if second > 0.0 else inf

    @property
    def holds(self) -> bool:
        """They near one path with the order of the scheme until they differ by as much as bundles do."""
        return self.order >= FIRST_ORDER

    @property
    def words(self) -> str:
        """For a list of misses."""
        return f"{self.title}, {self.model}: paths near one another with order {self.order:.2f}, {FIRST_ORDER:g} asked"


def in_shorter_steps(scenario: Scenario, model: str) -> GrooveSteps:
    """Solve a bundle in steps of three lengths, and once more raised a little.

    Args:
        scenario: The bundle, with its longest step.
        model: By which model.

    Returns:
        How far the paths are apart over time, and how a fibre rebounds.
    """
    raised = replace(scenario, bundle=replace(scenario.bundle, height=scenario.bundle.height + NUDGE))
    posed = [replace(scenario, dt=scenario.dt / part, rest=None) for part in PARTS]
    found = [each.run(model) for each in (*posed, replace(raised, rest=None))]
    paths = np.array([[rod.r for rod in result.rods[: scenario.fibres]] for result in found])
    paths[-1, ..., 1] -= NUDGE
    halved, quartered, nudged = (
        tuple(float(d) for d in np.linalg.norm(paths[a] - paths[b], axis=-1).max(axis=(0, 2))[1:])
        for a, b in ((0, 1), (1, 2), (0, 3))
    )
    ratio = _damping(scenario)
    return GrooveSteps(
        title=f"{scenario.fibres} fibres, {scenario.kind}"
        + (f", damping ratio of contact {ratio:.2g}" if ratio else ""),
        model=model,
        steps=tuple(each.dt for each in posed),
        t=tuple(float(at) for at in found[0].t[1:]),
        halved=halved,
        quartered=quartered,
        nudged=nudged,
        noise=scenario.bundle.noise,
        rebound=tuple(rebound(each, model) for each in posed),
        damping=ratio,
    )


def _damping(scenario: Scenario) -> float:
    """½ τ √(ε_N/ρA)."""
    law, ρA = scenario.law, scenario.bundle.section.rhoA
    assert ρA is not None
    return 0.5 * law.damping * sqrt(law.eps_N / ρA)


def rebound(scenario: Scenario, model: str) -> float:
    """Speed with which a straight fibre leaves a wall broadside on, over that with which it came.

    Args:
        scenario: Whose fibre, wall and step.
        model: By which model.

    Returns:
        One where nothing is lost.
    """
    section, law, dt = scenario.bundle.section, scenario.law, scenario.dt
    assert section.rhoA is not None
    lasts = pi * sqrt(section.rhoA / law.eps_N)
    rod = Rod.straight(PIECE, section, start=(0.0, scenario.bundle.radius + law.g_0, 0.0))
    scene = Scene(
        rods=[rod],
        contacts=[Contact(Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)), law)],
        velocities=[Velocity((0.0, -STRIKES, 0.0))],
        motion=Dynamic(max(FOLLOWED * lasts, 8.0 * dt), dt),
    )
    stepper = DiscreteStepper(2) if model == "discrete" else ContinuumStepper(ImplicitEuler(), 1)
    speed = stepper.solve(scene).rods[0].v
    assert speed is not None
    return float(speed[-1, :, 1].mean()) / STRIKES
