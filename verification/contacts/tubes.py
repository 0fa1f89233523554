"""A rod wound in a helix along the wall of a tube, without friction: thrust and line load on the wall."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from dolfinrod.scene import Contact, Cylinder, Penalty, PointForce, Prescribed, Rod, Scene, Static
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, RADIUS, SPACE, THIN, force, moment, on_meshes, touch
from verification.references.contact import touching, value
from verification.references.moving import Moving

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "TABLED", "helical"]

TABLED = "Lvib-helix-r0.05-p1.0"
WOUND, PITCH = value(TABLED, "r"), value(TABLED, "p")
# Part of a turn: so short that its thrust does not buckle it before it is wound.
TURN = 0.25
LAW = Penalty(1e5, 1e-3)


def helix(φ: float) -> tuple[Array, Array]:
    """Point and frame of the helix about x that begins at (0, r, 0), d2 and d3 carried on without twist.

    Args:
        φ: Angle around the tube [rad].

    Returns:
        Place, shape (3,) [m], and frame, shape (3, 3).
    """
    p = PITCH / (2.0 * np.pi)
    length = np.hypot(WOUND, p)
    place = np.array([p * φ, WOUND * np.cos(φ), WOUND * np.sin(φ)])
    d1 = np.array([p, -WOUND * np.sin(φ), WOUND * np.cos(φ)]) / length
    inwards = np.array([0.0, -np.cos(φ), -np.sin(φ)])
    frenet = np.stack([d1, inwards, np.cross(d1, inwards)], axis=1)
    # Frenet's frame turns about d1 by the torsion p/(r² + p²) a length, p/√(r² + p²) an angle around the tube.
    back = Rotation.from_rotvec([-φ * p / length, 0.0, 0.0]).as_matrix()
    return place, frenet @ back


def helical() -> Scene:
    """A straight rod along the wall, its ends brought to where the helix is, free to be pushed along x by the thrust.

    The wall is so far off that it pushes with the line load of the helix where the axis is at its radius.
    """
    φ = 2.0 * np.pi * TURN
    length = float(TURN * np.hypot(2.0 * np.pi * WOUND, PITCH))
    q, thrust = value(TABLED, "q"), value(TABLED, "P")
    (start, at_start), (end, at_end) = helix(0.0), helix(φ)
    frame = np.stack([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]], axis=1)
    turns = [Rotation.from_matrix(R @ frame.T).as_rotvec() for R in (at_start, at_end)]
    aside = (None, float(end[1] - WOUND), float(end[2]))
    tube = Cylinder((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), WOUND + RADIUS + LAW.g_0 - q / LAW.eps_N, "inside")
    return Scene(
        rods=[Rod.straight(length, THIN, start=tuple(start), d2=tuple(frame[:, 1]))],
        supports=[
            Prescribed("start", displacement=(0.0, 0.0, 0.0), rotation=tuple(turns[0])),
            Prescribed("end", displacement=aside, rotation=tuple(turns[1])),
        ],
        loads=[PointForce((-thrust, 0.0, 0.0), at="end")],
        contacts=[Contact(tube, LAW)],
        motion=Static(steps=4),
    )


def helical_found(result: Result) -> Array:
    """Least and largest line load, torque at the start about the axis of the tube, and x of the end."""
    p = touch(result).pressure[-1]
    r = result.rods[0].r[-1]
    torque = (moment(result, 0) + np.cross(r[0], force(result, 0)))[0]
    return np.array([p.min(), p.max(), torque, r[-1, 0]])


FOUND = touching(TABLED, "q")
SCENE = helical()

CASES = (
    ContactCase(
        name="contact-helix-in-tube",
        title="A quarter turn of a helix along the wall of a tube, thrust as without torque about the tube",
        family="normal",
        reference=Moving(
            FOUND.id,
            (FOUND.value[0], FOUND.value[0], 0.0, TURN * PITCH),
            FOUND.method,
            FOUND.source,
            FOUND.digits_trusted,
        ),
        scale=(FOUND.value[0], FOUND.value[0], value(TABLED, "P") * WOUND, TURN * PITCH),
        runs=(
            on_meshes(SPACE, SCENE, (4, 8, 16), limit=1e-6, quick=True),
            on_meshes(DISCRETE, SCENE, (20, 40, 80), order=1.5, quick=True),
        ),
        quantity="least and largest line load, torque about the tube, place of the end; N/m, N/m, N m, m",
        read=helical_found,
        note="The helix of the references has no torque about the tube at this thrust; other thrusts go with others.",
    ),
)
