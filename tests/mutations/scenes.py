"""Scenes for the laws: small enough to be solved once a fault."""

from __future__ import annotations

import numpy as np

import dolfinrod as dr
from tests.scenes import FLAT, GENERAL, KIRCHHOFF, SKEW, Array, Pose
from tests.scenes import cantilever as clamped

__all__ = ["GENERAL", "Pose", "clamped"]

# Direction of the force, and the bending and shear stiffness that answer to it.
BOTH_PLANES = ((1, 2.0, 40.0), (2, 1.0, 30.0))
PULLED_FORCE, PULLED_TENSION = 1e-3, 20.0
DENSE = dr.Section(EA=900.0, GA=(400.0, 300.0), GJ=0.7, EI=(1.0, 2.0), rhoA=0.5)
DENSER = dr.Section(EA=900.0, GA=(400.0, 300.0), GJ=0.7, EI=(1.0, 2.0), rhoA=1.5)
CURVED = SKEW.arc(GENERAL, angle=1.2)
TWISTED = dr.Rod.curved(
    1.0, GENERAL, (0.4, 0.5, 1.0), SKEW.placed((0, 0, 0)), SKEW.turned((1, 0, 0)), SKEW.turned((0, 1, 0)), 0.9
)


def loaded_in_every_way(pose: Pose, motion: dr.Static | None = None) -> dr.Scene:
    """A curved, pretwisted rod under point loads of every kind; nodes lie at quarters."""
    rod = dr.Rod.curved(
        1.0, GENERAL, (0.4, 0.5, 1.0), pose.placed((0, 0, 0)), pose.turned((1, 0, 0)), pose.turned((0, 1, 0)), 0.9
    )
    return clamped(
        rod,
        dr.PointForce(pose.turned((0.5, 1.0, -1.0)), "end"),
        dr.PointMoment(pose.turned((0.2, -0.3, 0.4)), 0.5),
        dr.FollowerForce((0.0, 0.7, -0.4), 0.75),
        dr.FollowerMoment((0.3, 0.0, 0.5), "end"),
        motion=motion,
    )


def loaded_in_a_plane(pose: Pose) -> dr.Scene:
    """An arc under point loads of every kind in its plane."""
    return clamped(
        pose.arc(GENERAL, angle=1.2),
        dr.PointForce(pose.turned((0.5, -1.0, 0.0)), "end"),
        dr.PointMoment(pose.turned((0.0, 0.0, 0.4)), 0.6),
        dr.FollowerForce((0.3, 0.7, 0.0), 0.9),
    )


def pulled_aside() -> dr.Scene:
    """A cantilever under tension from the beginning, and a small force across."""
    loads = (
        dr.PointForce(SKEW.turned((PULLED_TENSION, 0, 0)), "end", history=dr.Steady()),
        dr.PointForce(SKEW.turned((0, PULLED_FORCE, 0)), "end"),
    )
    return clamped(SKEW.straight(KIRCHHOFF), *loads)


def heavy(load: str) -> dr.Scene:
    """Two rods of different weight and length beside each other, or the same line load on both."""
    rods = [SKEW.straight(DENSE), SKEW.straight(DENSER, length=0.5, start=(0, 2.0, 0))]
    down = SKEW.turned((0, -1, 0))
    return dr.Scene(rods, [dr.Clamp("start")], [dr.Gravity(down) if load == "gravity" else dr.LineForce(down)])


def moved_and_loaded(factor: float, steps: int) -> dr.Scene:
    """A cantilever, its end moved, under a point load and a line load."""
    loads = (
        dr.PointForce(SKEW.turned((0, 3.0 * factor, 0)), 0.5),
        dr.LineForce(SKEW.turned((0, -2.0 * factor, 0))),
    )
    end = dr.Prescribed("end", displacement=SKEW.turned((0.01 * factor, 0.1 * factor, 0)))
    rod = SKEW.straight(GENERAL)
    return dr.Scene([rod], [dr.Clamp("start"), end], loads, motion=dr.Static(steps=steps))


def composed(*rotations: Array) -> dr.Scene:
    """A rod whose only support is turned by one rotation after the other."""
    supports = [dr.Prescribed("start", displacement=(0, 0, 0), rotation=tuple(v)) for v in rotations]
    return dr.Scene([FLAT.straight(GENERAL)], supports)


def turned_about(vector: Array) -> Array:
    """Rotation matrix of a rotation vector, by Rodrigues' formula."""
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
