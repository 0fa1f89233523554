"""Cantilevers loaded between their ends: forces and moments at sections, dead and following, and part of a length.

Resultants jump or kink there, and both meshes put a node under each such place.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.scene import Clamp, FollowerForce, FollowerMoment, LineForce, PointForce, PointMoment, Scene, Section
from verification.case import UPRIGHT, Case
from verification.cases.curved import LENGTH, helix
from verification.cases.elastica import RIGID, circular, straight
from verification.references import rod_problem, solved

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.scene import Load
    from verification.case import Pose

__all__ = ["CASES", "following", "partly", "pushed", "twisted"]


def pushed(load: float, at: tuple[float, float] = (0.375, 0.75)) -> Case:
    """Point force up and point moment back between the ends, in a plane.

    Args:
        load: Factor of the force 10 EI/L² and the moment −4 EI/L.
        at: Where the force acts, and where the moment [L].

    Returns:
        The case.
    """

    def loads(pose: Pose) -> list[Load]:
        return [
            PointForce(pose.vector(0.0, 10.0 * load), at=at[0]),
            PointMoment(pose.vector(0.0, 0.0, -4.0 * load), at=at[1]),
        ]

    title = f"Force at {at[0]:g} L, moment at {at[1]:g} L, load {load:g}"
    return _cantilever(f"inside-point-{load:g}-{at[0]:g}-{at[1]:g}", title, RIGID, loads)


def partly(beta: float) -> Case:
    """Line force across the rod between a quarter and five eighths of it, in a plane, the rod shearing and stretching.

    Args:
        beta: Force per length [EI/L³].

    Returns:
        The case.
    """

    def loads(pose: Pose) -> list[Load]:
        return [LineForce(pose.vector(0.0, -beta), between=(0.25, 0.625))]

    title = f"Line force on part of the length, fL³/EI = {beta:g}, circle, L/d = 10"
    return _cantilever(f"inside-line-{beta:g}", title, circular(10.0), loads)


def following(load: float) -> Case:
    """Follower force at 5/8 L against a dead force at the tip, in a plane.

    Args:
        load: Factor of the follower force −12 EI/L² along d2 and the dead force 6 EI/L² along y.

    Returns:
        The case.
    """

    def loads(pose: Pose) -> list[Load]:
        return [
            FollowerForce((0.0, -12.0 * load, 0.0), at=0.625),
            PointForce(pose.vector(0.0, 6.0 * load), at="end"),
        ]

    title = f"Follower force at 5/8 L, dead force at the tip, load {load:g}"
    return _cantilever(f"inside-follower-{load:g}", title, RIGID, loads)


def twisted(load: float) -> Case:
    """Follower moment at L/4 of the pretwisted helix and a dead force at its tip, unshearable.

    Args:
        load: Factor of the follower moment (0.8, −0.5, 1) N m and the dead force (0.3, 0.9, −0.6) N.

    Returns:
        The case.
    """
    section = Section(EA=300.0, GJ=0.6, EI=(1.0, 2.5), rigid={"shear"})
    name = f"inside-spatial-{load:g}"

    def scene(pose: Pose) -> Scene:
        force = (0.3 * load, 0.9 * load, -0.6 * load)
        return Scene(
            rods=[helix(section, pose)],
            supports=[Clamp(at="start")],
            loads=[
                FollowerMoment((0.8 * load, -0.5 * load, load), at=0.25 * LENGTH),
                PointForce(pose.vector(*force), at="end"),
            ],
        )

    return Case(
        name=name,
        title=f"Pretwisted helix, follower moment at L/4, load {load:g}",
        family="inside",
        scene=scene,
        reference=solved(name, rod_problem(scene(UPRIGHT)), LENGTH),
        length=LENGTH,
        planar=False,
    )


def _cantilever(name: str, title: str, section: Section, loads: Callable[[Pose], list[Load]]) -> Case:
    """Unit rod along x, clamped at its start, loaded in the plane of x and y."""

    def scene(pose: Pose) -> Scene:
        return Scene(rods=[straight(section, pose)], supports=[Clamp(at="start")], loads=loads(pose))

    return Case(
        name=name,
        title=title,
        family="inside",
        scene=scene,
        reference=solved(name, rod_problem(scene(UPRIGHT)), 1.0),
        length=1.0,
        models=("continuum", "discrete") if "shear" in section.rigid else ("continuum",),
    )


CASES = (pushed(1.0), partly(20.0), following(1.0), twisted(1.0))
