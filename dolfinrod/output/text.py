"""A scene and a result in words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from dolfinrod.scene import Dynamic, Planar, detect

if TYPE_CHECKING:
    from dolfinrod.result import Result, StepLog
    from dolfinrod.scene import Rod, Scene

__all__ = ["contents", "summary"]

# Rows of a table of steps beyond which its middle is left out.
MOST_ROWS = 20


def summary(model: str, result: Result) -> str:
    """Outcome, cost and tip of a solve, what contacts carry, steps where there are several; stability, or energies.

    Args:
        model: Who solved it.
        result: What was found.
    """
    cost, end = result.statistics, "converged at" if result.converged else "not converged beyond"
    moving = isinstance(result.scene.motion, Dynamic)
    state = f"; {_stability(result.log[-1])}" if result.log and not moving else ""
    lines = [
        f"{model}: {end} t = {result.t[-1]:.6g}{' s' * moving}; {result.formulation.kinematics}, "
        f"{cost.dofs} unknowns; {'time' if moving else 'load'} steps: {cost.load_steps}, "
        f"Newton iterations: {cost.newton_iterations}, {1e3 * cost.seconds_solve:.3g} ms{state}",
        f"  tip {_vector(result.tip, digits=10)} m",
        *_contacts(result),
        *_meetings(result),
        *(_ledger(result) if moving else ()),
        *(_steps(result.log, moving) if len(result.log) > 1 else ()),
    ]
    return "\n".join(lines)


def _contacts(result: Result) -> list[str]:
    """Length and resultant of each contact at the last stored state."""
    pairs = zip(result.scene.walls, result.contacts, strict=False)
    return [
        f"  contact {k}, {type(posed.surface).__name__.lower()}: {found.length[-1]:.6g} m in contact, "
        f"force {_vector(found.force[-1])} N"
        for k, (posed, found) in enumerate(pairs)
    ]


def _meetings(result: Result) -> list[str]:
    """Spots of each contact among rods at the last stored state, their forces and the smallest gap."""
    lines = []
    for k, meeting in enumerate(result.meetings):
        met, last = meeting.times[-1], len(meeting.times) - 1
        n, closest = meeting.n_spots(last), f", gap down to {met.gap.min():.6g} m" if len(met.gap) else ""
        pressed = f"{met.length.sum():.6g} m in contact, forces of {meeting.total(last):.6g} N in all"
        lines.append(f"  contact {k} of rods with rods: {n} spot{'s' * (n != 1)}, {pressed}{closest}")
    return lines


def _ledger(result: Result) -> list[str]:
    """How much each energy has changed and each work has done."""
    changes = ", ".join(f"{name} {values[-1] - values[0]:+.6g}" for name, values in result.energy.items())
    return [f"  energy [J]: {changes}"] if changes else []


def _steps(log: tuple[StepLog, ...], moving: bool) -> list[str]:
    """A table of steps, the middle of a long one left to `result.json`."""
    times, last = ("t [s]", "strain energy [J]") if moving else ("t", "state")
    rows = [f"  {'step':>6}{times:>12}{'iterations':>12}{'cuts':>6}  {last}"]
    rows += [
        f"  {k:6d}{row.t:12.6g}{row.iterations:12d}{row.cuts:6d}  {f'{row.energy:.6g}' if moving else _stability(row)}"
        for k, row in enumerate(log, 1)
    ]
    if len(log) <= MOST_ROWS:
        return rows
    half = MOST_ROWS // 2
    return [*rows[: half + 1], f"  {'...':>6}  {len(log) - 2 * half} more in Result.log", *rows[-half:]]


def _stability(row: StepLog) -> str:
    """What became known of the stability of an equilibrium."""
    if row.stable is None:
        return "stability not known"
    if row.stable:
        return "stable"
    n = row.unstable_directions
    return f"unstable in {n} direction{'s' * (n > 1)}" if n else "unstable"


def contents(scene: Scene) -> list[str]:
    """Rods, supports, loads, contacts, air, motion, velocities at the start and detected kinematics of a scene.

    Args:
        scene: Any scene.

    Returns:
        Lines.
    """
    found = detect(scene)
    plane = f", normal {_vector(found.normal)}" if isinstance(found, Planar) and found.normal is not None else ""
    return [
        *(line for k, rod in enumerate(scene.rods) for line in _rod(k, rod)),
        *(f"supports[{i}]: {support}" for i, support in enumerate(scene.supports)),
        *(f"loads[{i}]: {load}" for i, load in enumerate(scene.loads)),
        *(f"contacts[{i}]: {contact}" for i, contact in enumerate(scene.contacts)),
        *([f"air: {scene.air}"] if scene.air is not None else ()),
        f"motion: {scene.motion}",
        *(f"velocities[{i}]: {velocity}" for i, velocity in enumerate(scene.velocities)),
        f"kinematics: {type(found).__name__.lower()}{plane}",
    ]


def _rod(k: int, rod: Rod) -> list[str]:
    ends = " to ".join(_vector(rod.centerline(s)) for s in (0.0, rod.length))
    return [f"rods[{k}]: length {rod.length:.6g} m, from {ends} m", f"  {rod.shape}", f"  {rod.section}"]


def _vector(values: Iterable[float], *, digits: int = 6) -> str:
    return "(" + ", ".join(f"{value:.{digits}g}" for value in values) + ")"
