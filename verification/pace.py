"""Milliseconds a step, and the paper's fibre in its own steps by both models."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Air, Clamp, Gravity, ImplicitEuler, Midpoint, Planar, Rod, Scene, Section, Spatial
from verification.stepper import ContinuumStepper, DiscreteStepper

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.stepper import Stepper

__all__ = ["PACES", "Pace", "PaperFibre", "Task", "pace", "paper_fibre"]

RAMIE = Section.ramie()
LENGTH = 0.04
WIND = 10.0
# The paper's: 200 elements of 0.2 mm, 1 µs a step.
ELEMENTS, STEP = 200, 1e-6
# Difference of the models' tips over the way of the tip, and of the ledger over its largest entry.
AGREE, CLOSED = 1e-2, 1e-8
REPEATS = 3


@dataclass(frozen=True)
class Task:
    """Rods to be moved on.

    Args:
        words: What is moved.
        stepper: By which model.
        rods: How many.
        aim: Milliseconds a step that the project aims at [ms].
        dt: The step [s].
    """

    words: str
    stepper: Stepper
    rods: int
    aim: float
    dt: float


PLANE = Planar((0.0, 0.0, 1.0))
# The paper's steps, and such as follow the fibre's bending but no faster wave.
STEPS = {"Δt = 1 μs": STEP, "Δt = 0.1 ms": 1e-4}
PACES = tuple(
    task
    for words, dt in STEPS.items()
    for task in (
        Task(f"one fibre, {words}", DiscreteStepper(80), 1, 1.0, dt),
        Task(f"five fibres, {words}", DiscreteStepper(80), 5, 3.0, dt),
        *(
            Task(f"one fibre, {words}", ContinuumStepper(scheme, 16, 3, kinematics), 1, 3.0, dt)
            for kinematics in (PLANE, Spatial())
            for scheme in (ImplicitEuler(), Midpoint())
        ),
    )
)


@dataclass(frozen=True)
class Pace:
    """Time a step takes.

    Args:
        words: What is moved.
        model: Name of the model and the scheme.
        mesh: In words.
        ms: Least of several runs, a step [ms].
        iterations: Newton iterations a step.
        aim: What the project aims at [ms]; no limit.
    """

    words: str
    model: str
    mesh: str
    ms: float
    iterations: float
    aim: float

    @property
    def holds(self) -> bool:
        """Within the aim; on a busy machine that says little."""
        return self.ms <= self.aim


@dataclass(frozen=True)
class PaperFibre:
    """The paper's fibre in its own steps.

    Args:
        models: Names of the models and schemes, the discrete one first.
        meshes: In words.
        steps: Taken.
        dt: Of each [s].
        way: Of the tip, by each [m].
        apart: Distance of each tip from that of the first model, over its way.
        open: Largest gap of each ledger, over its largest entry.
        ms: A step, of each [ms].
    """

    models: tuple[str, ...]
    meshes: tuple[str, ...]
    steps: int
    dt: float
    way: tuple[float, ...]
    apart: tuple[float, ...]
    open: tuple[float, ...]
    ms: tuple[float, ...]

    @property
    def holds(self) -> bool:
        """Models agree and ledgers close."""
        return max(self.apart) <= AGREE and max(self.open) <= CLOSED


def hanging(rods: int, motion: Dynamic) -> Scene:
    """Clamped fibres of the paper under their weight and in a wind across."""
    apart = 1e-3
    fibres = [Rod.straight(LENGTH, RAMIE, start=(0.0, 0.0, apart * k)) for k in range(rods)]
    return Scene(
        rods=fibres,
        supports=[Clamp(at="start")],
        loads=[Gravity((0.0, -9.81, 0.0))],
        air=Air(field=(0.0, -WIND, 0.0)),
        motion=motion,
    )


def pace(task: Task, steps: int) -> Pace:
    """Time so many steps.

    Args:
        task: What is moved.
        steps: Of each run.

    Returns:
        The least of three runs.
    """
    seconds = task.dt * steps
    runs = [
        task.stepper.solve(hanging(task.rods, task.stepper.motion(seconds, steps, seconds))) for _ in range(REPEATS)
    ]
    fastest = min(runs, key=lambda result: result.statistics.seconds_solve).statistics
    taken = fastest.load_steps
    return Pace(
        words=task.words,
        model=task.stepper.name,
        mesh=task.stepper.mesh,
        ms=1e3 * fastest.seconds_solve / taken,
        iterations=fastest.newton_iterations / taken,
        aim=task.aim,
    )


def paper_fibre(steps: int) -> PaperFibre:
    """The paper's fibre for so many of its steps, by the discrete model and by either scheme of the continuum one."""
    steppers: tuple[Stepper, ...] = (
        DiscreteStepper(ELEMENTS),
        ContinuumStepper(ImplicitEuler(), 16, 3, PLANE),
        ContinuumStepper(Midpoint(), 16, 3, PLANE),
    )
    results = [s.solve(hanging(1, s.motion(steps * STEP, steps, None))) for s in steppers]
    ways = [float(np.linalg.norm(r.rods[0].r[-1, -1] - r.rods[0].r[0, -1])) for r in results]
    apart = [float(np.linalg.norm(r.tip - results[0].tip)) / ways[0] for r in results]
    return PaperFibre(
        models=tuple(s.name for s in steppers),
        meshes=tuple(s.mesh for s in steppers),
        steps=steps,
        dt=STEP,
        way=tuple(ways),
        apart=tuple(apart),
        open=tuple(map(gap, results)),
        ms=tuple(1e3 * r.statistics.seconds_solve / steps for r in results),
    )


def gap(result: Result) -> float:
    """By how much a ledger does not close, over its largest entry."""
    e = result.energy
    stored = sum(e[name] - e[name][0] for name in ("kinetic", "strain", "potential"))
    works = sum(e[name] for name in ("load work", "support work", "drag", "damping", "numerical"))
    largest = max(float(np.abs(e[name] - e[name][0]).max()) for name in e)
    return float(np.abs(stored - works).max()) / largest
