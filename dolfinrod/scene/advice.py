"""Why no equilibrium was found, and what to try, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from dolfinrod.scene.mechanism import free_motions, overheld
from dolfinrod.scene.motion import Dynamic

if TYPE_CHECKING:
    from dolfinrod.scene.scene import Scene

__all__ = ["Findings", "advice"]

# Turn between neighbouring sections from which an element is no longer near the rod [rad].
COARSE = 1.0
# Round-off of stiffnesses over that of a rod from which on Newton's method may be lost.
ROUNDED = 0.3
# What helps where contact comes and goes, or rods slip.
SOFTER = "contact that is softer (a smaller eps_N) or begins smoothly (SmoothPenalty)"
FIRMER = "a stiffer RodContact.law where rods are pressed through one another, a softer one where they are not"
MASS = "a Dynamic motion, in which mass holds what slips"


@dataclass(frozen=True)
class Findings:
    """What a solver knows when it gives up.

    Args:
        t: Pseudo-time of the last equilibrium.
        pushed: Whether the loads push a rod along a motion that nothing resists.
        aliased: Whether neighbouring sections turned by more than the elements can tell apart.
        turned: Largest turn between neighbouring sections at the last equilibrium [rad].
        critical: Pseudo-time just ahead of it at which the loads are critical, if there is one.
        lost: Pseudo-time from which on the equilibria are unstable, if they are.
        rounding: What rounds off the stiffnesses of the elements over what a rod resists its loads with.
    """

    t: float
    pushed: bool = False
    aliased: bool = False
    turned: float = 0.0
    critical: float | None = None
    lost: float | None = None
    rounding: float = 0.0


def advice(scene: Scene, found: Findings) -> str:
    """The likely cause of a failure and what to try against it.

    Args:
        scene: The scene that was not solved.
        found: What is known.

    Returns:
        Sentences without the last full stop.
    """
    if isinstance(scene.motion, Dynamic):
        return _in_time(scene, scene.motion.dt)
    free = free_motions(scene)
    if free and (found.t == 0.0 or found.pushed):
        also = f", to begin where rods touch what holds them, or {MASS}" if scene.contacts else ""
        return f"Likely a mechanism. Nothing holds the rods completely: {'; '.join(free)}. Try more supports{also}"
    if found.t == 0.0 and (held := overheld(scene)):
        return f"Likely an axial force that may be anything: {'; '.join(held)}. Try a section with its EA, not rigid"
    if mesh := _meshed(found):
        return mesh
    if found.critical is not None:
        return (
            f"Likely a critical point was passed: the loads are critical at t = {found.critical:.6g}, and beyond it "
            "no equilibrium lies near. `.result` holds what converged; try prescribed displacements instead of loads"
        )
    if found.lost is not None:
        return (
            f"Likely a critical point was passed: what converged is unstable from t = {found.lost:.6g} on, and such "
            "paths are easily lost. Look at `.result` (what converged), or try a small load across the rod, which "
            "leads to a stable branch"
        )
    steps = scene.motion.steps
    touching = f"{_touching(scene)}{MASS}, " if scene.contacts else ""
    return (
        f"The iteration did not settle. Try Static(steps={2 * steps if steps else 8}), {touching}more elements, or "
        "look at `.result` (what converged)"
    )


def _meshed(found: Findings) -> str:
    """What is wrong with the number of elements; empty: nothing that is known."""
    if found.aliased:
        return "Likely too few elements for so many turns: try more elements"
    if found.rounding > ROUNDED:
        return (
            "Likely too many elements for double precision: what it rounds off their stiffnesses 12 EI/l³ is "
            f"{found.rounding:.2g} times the stiffness of the rod. Try fewer elements, or the continuum model, which "
            "has forces as unknowns of their own"
        )
    if found.turned > COARSE:
        return (
            f"Likely too few elements for such loads: at t = {found.t:.6g} neighbouring sections have turned by "
            f"{found.turned:.2g} rad against each other. Try more elements"
        )
    return ""


def _in_time(scene: Scene, dt: float | None) -> str:
    """What to try where a motion in time steps of dt went astray."""
    finer = "a smaller Dynamic(tol=…)" if dt is None else f"Dynamic(dt={dt / 2:g})"
    looked_at = "look at `.result` (what converged) for what grows without bound"
    return f"Try {finer}, {_touching(scene)}more elements, or {looked_at}"


def _touching(scene: Scene) -> str:
    """What to try where rods touch surfaces, and where they touch one another."""
    softer = f"{SOFTER}, " if scene.walls else ""
    return softer + (f"{FIRMER}, " if scene.meetings else "")
