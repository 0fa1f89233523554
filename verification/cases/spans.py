"""Rods on supports between their ends: an arc over pins, a settling support, a helix on pins, rollers and a hinge."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Guide, LineForce, Pin, PointForce, Prescribed, Rod, Scene, Section
from verification.case import UPRIGHT, Case
from verification.cases.curved import LENGTH, NAMES, helix
from verification.cases.elastica import circular, straight
from verification.references import rod_problem, solved

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from dolfinrod.result import Result
    from dolfinrod.scene import Load, Support
    from verification.case import Array, Pose

__all__ = ["ALIGNED", "CASES", "FAR", "arch", "hinged", "rollers", "settled", "threaded"]

# A half circle.
ARC = np.pi
PINS = (0.25 * ARC, 0.625 * ARC)
NOTE = (
    "Below 16 elements a span holds two or three of them and errors fall unevenly; orders settle at 2k on finer ones."
)
UNSHEARABLE = Section(EA=400.0, GJ=0.8, EI=1.0, rigid={"shear"})


def arch(load: float, rigid: Iterable[str] = ("shear", "extension")) -> Case:
    """Half circle of radius 1 over three spans, clamped, pinned twice and pinned at its end, pressed in its plane.

    Args:
        load: Factor of the line force −12 N/m along y and the point force (8, −5) N in the last span.
        rigid: Strains that are exactly zero: none, shear, or shear and extension.

    Returns:
        The case; the position of the last point force is read.
    """
    at = 0.8125 * ARC
    section = Section(EA=400.0, GA=150.0, GJ=0.8, EI=1.0, rigid=rigid)
    suffix, words = NAMES[len(section.rigid)]

    def loads(pose: Pose) -> list[Load]:
        return [
            LineForce(pose.vector(0.0, -12.0 * load)),
            PointForce(pose.vector(8.0 * load, -5.0 * load), at=at),
        ]

    def supports(_: Pose) -> list[Support]:
        return [Clamp(at="start"), *(Pin(at=s) for s in PINS), Pin(at="end")]

    title = f"Arc over three spans, load {load:g}, {words}"
    return _on_arc(f"spans-arc-{load:g}{suffix}", title, section, supports, loads, at)


def settled(sink: float) -> Case:
    """The half circle on the same supports, of which the first between its ends sinks, stretching without shear.

    Args:
        sink: How far (0.6, −1)·sink it moves [m].

    Returns:
        The case; the position of a loaded section in the middle span is read.
    """
    at = 0.4375 * ARC

    def supports(pose: Pose) -> list[Support]:
        sunk = Prescribed(at=PINS[0], displacement=pose.vector(0.6 * sink, -sink))
        return [Clamp(at="start"), sunk, Pin(at=PINS[1]), Pin(at="end")]

    def loads(pose: Pose) -> list[Load]:
        return [PointForce(pose.vector(0.0, -5.0), at=at)]

    title = f"Arc on a support that sinks by {sink:g} m"
    return _on_arc(f"spans-sinking-{sink:g}", title, UNSHEARABLE, supports, loads, at)


def threaded(load: float) -> Case:
    """The pretwisted helix on pins at its middle and its end, its section held but free to move at three quarters.

    Args:
        load: Factor of the line force (1.5, −4, 5) N/m.

    Returns:
        The case; the position of the section held in its direction is read.
    """
    at = 0.75 * LENGTH
    section = Section(EA=300.0, GJ=0.6, EI=(1.0, 2.5), rigid={"shear"})

    def scene(pose: Pose) -> Scene:
        return Scene(
            rods=[helix(section, pose)],
            supports=[
                Clamp(at="start"),
                Pin(at=0.5 * LENGTH),
                Guide(at=at, free=("x", "y", "z")),
                Pin(at="end"),
            ],
            loads=[LineForce(pose.vector(1.5 * load, -4.0 * load, 5.0 * load))],
        )

    return _read(f"spans-helix-{load:g}", f"Pretwisted helix on pins, load {load:g}", scene, LENGTH, at, planar=False)


def rollers(beta: float) -> Case:
    """Straight rod on a pin and three rollers, sagging so far under its weight that it is drawn over them.

    Args:
        beta: Weight per length [EI/L³].

    Returns:
        The case, for poses whose axes are those of space; the far end is read.
    """

    def scene(pose: Pose) -> Scene:
        along, _, across = axes(pose)
        slides = [Guide(at=s, free=(along, f"r{across}")) for s in (0.375, 0.75)]
        return Scene(
            rods=[straight(circular(50.0), pose)],
            supports=[Pin(at="start"), *slides, Guide(at="end", free=(along, f"r{across}"))],
            loads=[LineForce(pose.vector(0.0, -beta))],
        )

    title = f"Beam on a pin and rollers, wL³/EI = {beta:g}"
    return _read(f"spans-rollers-{beta:g}", title, scene, 1.0, 1.0)


def hinged(load: float) -> Case:
    """The pretwisted helix through a sleeve that turns about z at its middle, its end held by a hinge about x.

    Args:
        load: Factor of the line force (0, −4, 3) N/m and the point force (4, 0, −3) N at a quarter.

    Returns:
        The case, for poses whose axes are those of space; the middle is read.
    """
    section = Section(EA=300.0, GJ=0.6, EI=(1.0, 2.5), rigid={"shear"})
    at = 0.5 * LENGTH

    def scene(pose: Pose) -> Scene:
        x, _, z = axes(pose)
        return Scene(
            rods=[helix(section, pose)],
            supports=[
                Clamp(at="start"),
                Guide(at=at, free=(x, z, f"r{z}")),
                Guide(at="end", free=(f"r{x}",)),
            ],
            loads=[
                LineForce(pose.vector(0.0, -4.0 * load, 3.0 * load)),
                PointForce(pose.vector(4.0 * load, 0.0, -3.0 * load), at=0.25 * LENGTH),
            ],
        )

    title = f"Pretwisted helix with a sleeve and a hinge, load {load:g}"
    return _read(f"spans-hinges-{load:g}", title, scene, LENGTH, at, planar=False)


def axes(pose: Pose) -> tuple[str, ...]:
    """Names of the axes of space along which the pose's x, y and z lie.

    Raises:
        ValueError: They lie along none; a guide's components are those of space.
    """
    at = np.abs(pose.rotation)
    if not np.allclose(at.max(axis=0), 1.0, atol=1e-12):
        raise ValueError(f"guides need axes along those of space, got the rotation vector {pose.rotation_vector}")
    return tuple("xyz"[i] for i in at.argmax(axis=0))


def _on_arc(
    name: str,
    title: str,
    section: Section,
    supports: Callable[[Pose], list[Support]],
    loads: Callable[[Pose], list[Load]],
    at: float,
) -> Case:
    """Half circle of radius 1, in the plane of x and y."""

    def scene(pose: Pose) -> Scene:
        arc = Rod.arc(1.0, ARC, section, pose.start(ARC), pose.vector(0.0, 1.0), pose.vector(1.0, 0.0))
        return Scene(rods=[arc], supports=supports(pose), loads=loads(pose))

    return _read(name, title, scene, ARC, at)


def _read(
    name: str,
    title: str,
    scene: Callable[[Pose], Scene],
    length: float,
    at: float,
    *,
    planar: bool = True,
) -> Case:
    """A case of which the position of a section is read."""

    def position(result: Result) -> Array:
        return result.rods[0].at(at)[-1]

    return Case(
        name=name,
        title=title,
        family="spans",
        scene=scene,
        reference=solved(name, rod_problem(scene(UPRIGHT)), at),
        length=length,
        models=("continuum", "discrete") if "shear" in scene(UPRIGHT).rods[0].section.rigid else ("continuum",),
        planar=planar,
        quantity=position,
        quantity_name=f"position at s = {at / length:g} L",
        note=NOTE,
    )


CASES = (
    arch(2.0),
    arch(1.0, ()),
    settled(0.15),
    threaded(4.0),
)
# Posed along the axes of space only.
ALIGNED = (rollers(100.0), hinged(4.0))
# On a path along which the arc may jump to another branch; a hard case.
FAR = (settled(0.25),)
