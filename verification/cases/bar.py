"""Rods that stay straight: pulled, laden along themselves, twisted by several turns, all of it at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, FollowerMoment, LineForce, PointForce, PointMoment, Scene, Section
from verification.case import Case
from verification.cases.elastica import straight
from verification.references import Reference

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from dolfinrod.result import Result
    from dolfinrod.scene import Load
    from verification.case import Array, Pose

__all__ = ["CASES", "laden", "pulled", "twisted"]

# No two stiffnesses alike; EI is large enough for the straight rod to be stable under every torque here.
SECTION = Section(EA=40.0, GA=(15.0, 10.0), GJ=0.5, EI=(30.0, 50.0))
EXACT = "Both models meet stretch at the nodes of any mesh: what is seen is round-off."
UNIFORM = "discrete: uniform twist is exact on any mesh; continuum: uniform twist converges with 2k + 2 instead of 2k."


def pulled(force: float) -> Case:
    """Dead force along the rod, x = s (1 + F/EA).

    Args:
        force: F; negative: pushed.

    Returns:
        The case.
    """
    return posed(f"pulled-{force:g}", f"Bar under {force / SECTION.EA:g} EA along itself", force=force)


def laden(weight: float) -> Case:
    """Dead force per reference length along the rod, x = s + w (L s − s²/2)/EA.

    Args:
        weight: w.

    Returns:
        The case.
    """
    return posed(f"laden-{weight:g}", f"Bar under the weight {weight / SECTION.EA:g} EA/L along itself", weight=weight)


def twisted(turns: float, *, force: float = 0.0, weight: float = 0.0, follower: bool = False) -> Case:
    """Torque that turns the tip section by M L/GJ, whatever the forces along the rod.

    Args:
        turns: M L/(2π GJ).
        force: Along the rod, at its tip.
        weight: Along the rod, per reference length.
        follower: Whether the torque is fixed to the section; here it makes no difference.

    Returns:
        The case.
    """
    how = "follower" if follower else "stretched" if force or weight else "dead"
    words = {"follower": "follower torque", "dead": "dead torque", "stretched": "dead torque, and stretched"}[how]
    return posed(
        f"twisted-{turns:g}-{how}",
        f"Bar twisted by {turns:g} turns, {words}",
        force=force,
        weight=weight,
        turns=turns,
        moment=FollowerMoment if follower else PointMoment,
    )


def posed(
    name: str,
    title: str,
    *,
    force: float = 0.0,
    weight: float = 0.0,
    turns: float = 0.0,
    moment: type[PointMoment | FollowerMoment] = PointMoment,
) -> Case:
    """Unit rod along x, clamped at its start, with those loads that are not zero.

    Args:
        name: Of the case.
        title: Of the case.
        force: Along the rod, at its tip.
        weight: Along the rod, per reference length.
        turns: Of the tip section.
        moment: That twists it.

    Returns:
        The case; of a twisted rod its quantity is a point of the tip section beside the axis.
    """
    line = stretched(force, weight)
    return Case(
        name=f"bar-{name}",
        title=title,
        family="bar",
        scene=loaded(force, weight, turns, moment),
        reference=closed(name, float(line(np.ones(1))[0, 0]), turns),
        length=1.0,
        planar=not turns,
        turns=max(1, round(turns)),
        quantity=beside if turns else end,
        quantity_name="point of the tip section one length off the axis along d2" if turns else "tip position",
        centreline=line,
        note=UNIFORM if turns else EXACT,
    )


def loaded(
    force: float, weight: float, turns: float, moment: type[PointMoment | FollowerMoment]
) -> Callable[[Pose], Scene]:
    """The clamped rod under them."""

    def scene(pose: Pose) -> Scene:
        return Scene(
            rods=[straight(SECTION, pose)],
            supports=[Clamp(at="start")],
            loads=list(loads(pose, force, weight, turns, moment)),
        )

    return scene


def loads(
    pose: Pose, force: float, weight: float, turns: float, moment: type[PointMoment | FollowerMoment]
) -> Iterator[Load]:
    """Those that are not zero."""
    if force:
        yield PointForce(pose.vector(force, 0.0), at="end")
    if weight:
        yield LineForce(pose.vector(weight, 0.0))
    if turns:
        torque = (2.0 * np.pi * turns * SECTION.GJ, 0.0)
        yield moment((*torque, 0.0) if moment is FollowerMoment else pose.vector(*torque), at="end")


def stretched(force: float, weight: float) -> Callable[[Array], Array]:
    """Centreline x = s + (F s + w (L s − s²/2))/EA."""

    def line(s: Array) -> Array:
        x = s + (force * s + weight * (s - 0.5 * s**2)) / SECTION.EA
        return np.column_stack([x, np.zeros((len(s), 2))])

    return line


def closed(name: str, x: float, turns: float) -> Reference:
    """Where the tip, or the point beside it along d2, goes."""
    beside = (float(np.cos(2.0 * np.pi * turns)), float(np.sin(2.0 * np.pi * turns))) if turns else (0.0, 0.0)
    return Reference(
        id=f"bar({name})",
        value=(x, *beside),
        method="closed form: N/EA integrated along the rod; the angle M L/GJ",
        source="Hooke's law along a straight rod; verification/cases/bar.py",
        digits_trusted=15,
        agreement=0.0,
    )


def end(result: Result) -> Array:
    """Tip of the first rod."""
    return result.tip


def beside(result: Result) -> Array:
    """r + d2 at the tip of the first rod, which has unit length."""
    return np.asarray(result.tip + result.rods[0].frames[-1, -1, :, 1])


CASES = (
    pulled(20.0),
    laden(30.0),
    twisted(3.0),
    twisted(2.65, follower=True),
    twisted(2.65, force=20.0, weight=30.0),
)
