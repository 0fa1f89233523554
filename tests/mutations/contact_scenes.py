"""Scenes of contact for the laws: a rod lies on a floor, is pushed, carried, lifted, dropped, bent over a drum."""

from __future__ import annotations

import dolfinrod as dr
from dolfinrod.scene.friction import Friction
from dolfinrod.scene.normallaw import NormalLaw
from tests.scenes import FLAT, SKEW, Pose

RADIUS = 0.01
# Of length and EI one.
ROUND = dr.Section(EA=4e3, GA=1.5e3, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(1e-4, 5e-5, 5e-5), radius=RADIUS)
# Line load that presses down, stiffness of the floor, where that begins to act.
Q, EPS, G_0 = 3.0, 2e4, 1e-3
PENALTY = dr.Penalty(EPS, G_0)
# Friction, and stiffness of its anchors, unlike that of the floor.
MU, EPS_T = 0.4, 1e4
ROUGH = dr.Coulomb(MU, EPS_T)
# Height at which the floor bears half of Q.
LOW = RADIUS + G_0 - 0.5 * Q / EPS
# Radius of a drum, turn of a wall, step of motions.
DRUM, TURN = 0.5, 0.01
STEP = 2e-3
EULER, MIDPOINT = dr.ImplicitEuler(), dr.Midpoint()


def floor(
    pose: Pose, law: NormalLaw = PENALTY, friction: Friction | None = None, wall: dr.WallMotion | None = None
) -> dr.Contact:
    """The half space y < 0."""
    return dr.Contact(dr.Plane(pose.placed((0, 0, 0)), pose.turned((0, 1, 0)), wall), law, friction)


def lying(pose: Pose, contact: dr.Contact, *loads: dr.Load, height: float = LOW, **parts: object) -> dr.Scene:
    """A rod on the floor, pressed down by the line load Q from the beginning."""
    pressed = dr.LineForce(pose.turned((0, -Q, 0)), history=dr.Steady())
    return dr.Scene([pose.straight(ROUND, start=(0, height, 0))], loads=[pressed, *loads], contacts=[contact], **parts)


def pushed(motion: dr.Static | dr.Dynamic) -> dr.Scene:
    """Pushed along a rough floor, on which it cannot roll, by 0.9 of what friction can take."""
    steady = dr.Steady() if isinstance(motion, dr.Dynamic) else None
    push = dr.LineForce((0.9 * MU * Q, 0, 0), history=steady)
    upright = dr.Guide("start", free={"x", "y", "z", "rz"})
    return lying(FLAT, floor(FLAT, friction=ROUGH), push, supports=[upright], motion=motion)


def drawn() -> dr.Scene:
    """Held at its start, but free to turn and to rise there, on a rough floor that is drawn forth and back."""
    wall = dr.WallMotion((0.02, 0, 0), history=[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)])
    held = dr.Guide("start", free={"y", "rz"})
    return lying(FLAT, floor(FLAT, friction=ROUGH, wall=wall), supports=[held], motion=dr.Static(t_end=2.0))


def carried() -> dr.Scene:
    """Pushed along a rough floor by forces that turn with it, and then turned with the floor."""
    first, then = ((0.0, 0.0), (1.0, 1.0)), ((1.0, 0.0), (2.0, 1.0), (3.0, 2.0))
    turn = SKEW.turned((0, 0, TURN))
    wall = dr.WallMotion(rotation=turn, history=then, about=SKEW.placed((0, 0, 0)))
    ends = [dr.FollowerForce((0.05, -1.5, 0), at, history=first) for at in ("start", "end")]
    return dr.Scene(
        [SKEW.straight(ROUND, start=(0, LOW, 0))],
        [dr.Prescribed("start", rotation=turn, history=then)],
        ends,
        [floor(SKEW, friction=ROUGH, wall=wall)],
        motion=dr.Static(t_end=3.0),
    )


def lifted(*contacts: dr.Contact) -> dr.Scene:
    """A cantilever pressed down onto what is there and lifted from it."""
    rod = FLAT.straight(ROUND, start=(0, 0.03, 0))
    pull = dr.PointForce((0, -1.5, 0), "end", history=[(0.0, 0.0), (1.0, 1.0), (2.0, -0.02)])
    return dr.Scene([rod], [dr.Clamp("start")], [pull], contacts, motion=dr.Static(t_end=2.0))


def bent(eps: float) -> dr.Scene:
    """Clamped on top of a drum, the rest pulled down onto it, then a little more."""
    pull = dr.PointForce((0, -10.0, 0), "end", history=[(0.0, 0.0), (1.0, 1.0), (2.0, 1.2)])
    drum = dr.Cylinder((0, -DRUM - RADIUS, 0), (0, 0, 1), DRUM)
    touching = dr.Contact(drum, dr.Penalty(eps))
    return dr.Scene([FLAT.straight(ROUND)], [dr.Clamp("start")], [pull], [touching], motion=dr.Static(t_end=2.0))


# Way down to the floor, way into it, way along it.
DOWN, IN, ALONG = 0.019, 0.001, 0.02
# Anchors soft enough to hold.
SOFT = 1e3


def landing() -> dr.Scene:
    """Let down obliquely onto a very rough floor, in one step."""
    stiff = dr.Section(EA=4e6, GA=1.5e6, GJ=800.0, EI=1e3, radius=RADIUS)
    rod = FLAT.straight(stiff, start=(0, RADIUS + DOWN, 0))
    way = (ALONG, -DOWN - IN, 0)
    held = [dr.Prescribed(at, displacement=way, rotation=(0, 0, 0)) for at in ("start", "end")]
    return dr.Scene([rod], held, contacts=[floor(FLAT, dr.Penalty(1e3), dr.Coulomb(5.0, SOFT))])


def dropped(scheme: dr.ImplicitEuler | dr.Midpoint) -> dr.Scene:
    """Thrown flat onto a floor, from which it bounces."""
    rod = SKEW.straight(ROUND, start=(0, RADIUS + G_0 + 0.005, 0))
    thrown = dr.Velocity(v=SKEW.turned((0, -1.0, 0)))
    motion = dr.Dynamic(0.03, STEP, scheme=scheme)
    return dr.Scene([rod], contacts=[floor(SKEW)], motion=motion, velocities=[thrown])


BELT, BELT_MU = 0.03, 0.5


def on_a_belt() -> dr.Scene:
    """At rest on a floor that moves."""
    belt = floor(FLAT, dr.Penalty(1e6), dr.Coulomb(BELT_MU), dr.WallMotion(velocity=(BELT, 0, 0)))
    upright = dr.Guide("start", free={"x", "y", "z", "rz"})
    motion = dr.Dynamic(0.04, STEP, scheme=EULER)
    return lying(FLAT, belt, height=RADIUS - Q / 1e6, supports=[upright], motion=motion)
