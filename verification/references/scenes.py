"""A rod of a scene as a boundary-value problem: what the scene lists, read once more and by neither model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Clamp,
    FollowerForce,
    FollowerMoment,
    Gravity,
    Guide,
    LineForce,
    Pin,
    PointForce,
    PointMoment,
)
from dolfinrod.scene.shape import UniformCurvature
from verification.references.posed import AXES, Curvature, Held, LineLoad, PointLoad, Problem

if TYPE_CHECKING:
    from dolfinrod.scene import Rod, Scene, Support

    PointLoads = PointForce | PointMoment | FollowerForce | FollowerMoment
    Triple = tuple[float, float, float]

__all__ = ["rod_problem"]

TRANSLATIONS, ROTATIONS = ("x", "y", "z"), ("rx", "ry", "rz")
# Under which name each point load enters.
ENTERS = {
    PointForce: "force",
    PointMoment: "moment",
    FollowerForce: "follower_force",
    FollowerMoment: "follower_moment",
}


def rod_problem(scene: Scene, rod: int = 0) -> Problem:
    """One rod of a scene; rods do not touch, so that each stands alone.

    Args:
        scene: With full loads; of histories nothing is read.
        rod: Its number.

    Returns:
        The problem, positions counted from the start of the rod.

    Raises:
        ValueError: A shape of varying curvature or a prescribed rotation, which are not posed here.
    """
    body = scene.rods[rod]
    if not isinstance(body.shape, UniformCurvature):
        raise ValueError(f"a rod of uniform curvature is wanted, got {body.shape!r}")
    supports = [(part, s) for part in scene.supports for k, s in scene.location(part.at, part.rod) if k == rod]
    pointed = [load for load in scene.loads if not isinstance(load, (LineForce, Gravity))]
    loads = [(load, s) for load in pointed for k, s in scene.location(load.at, load.rod) if k == rod]
    spread = [_weight(load, body) for load in scene.loads if isinstance(load, Gravity)]
    spread += [_line(load, body) for load in scene.loads if isinstance(load, LineForce) and load.rod in (None, rod)]
    return Problem(
        length=body.length,
        compliance_n=body.section.compliance_n,
        compliance_m=body.section.compliance_m,
        supports=tuple(_held(part, s) for part, s in supports),
        loads=tuple(PointLoad(s, **{ENTERS[type(load)]: _vector(load)}) for load, s in loads),
        lines=tuple(spread),
        curvature=Curvature(body.shape.kappa, body.pretwist),
        d1=body.shape.direction,
        d2=body.shape.d2,
    )


def _held(part: Support, s: float) -> Held:
    if isinstance(part, Clamp):
        return Held(s, about=AXES)
    if isinstance(part, Pin):
        return Held(s)
    if isinstance(part, Guide):
        return Held(s, along=_axes(TRANSLATIONS, part.held()), about=_axes(ROTATIONS, part.held()))
    if part.rotation is not None and np.any(part.rotation):
        raise ValueError(f"a prescribed rotation is not posed here, got {part!r}")
    x, y, z = (u or 0.0 for u in part.displacement or (0.0, 0.0, 0.0))
    return Held(s, _axes(TRANSLATIONS, part.held()), _axes(ROTATIONS, part.held()), moved=(x, y, z))


def _axes(names: tuple[str, ...], held: frozenset[str]) -> tuple[Triple, ...]:
    return tuple(axis for axis, name in zip(AXES, names, strict=True) if name in held)


def _vector(load: PointLoads) -> Triple:
    """Force or moment of a load at a section."""
    x, y, z = load.moment if isinstance(load, (PointMoment, FollowerMoment)) else load.force
    return float(x), float(y), float(z)


def _weight(load: Gravity, body: Rod) -> LineLoad:
    """A scene with gravity has a mass on every rod."""
    x, y, z = (float((body.section.rhoA or 0.0) * a) for a in load.g)
    return LineLoad((x, y, z), 0.0, body.length)


def _line(load: LineForce, body: Rod) -> LineLoad:
    x, y, z = (float(f) for f in load.force)
    a, b = load.between or (0.0, body.length)
    return LineLoad((x, y, z), a, b)
