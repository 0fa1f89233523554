"""What the laws are asked on: scenes that can be moved, mirrored and measured in other units, and the loads on them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Clamp,
    FollowerForce,
    FollowerMoment,
    Gravity,
    LineForce,
    PointForce,
    PointMoment,
    Rod,
    Scene,
    Section,
    Static,
)
from verification.case import SKEW

if TYPE_CHECKING:
    from dolfinrod.result import Result, RodHistory
    from verification.case import Array, Vector

    Table = tuple[tuple[float, float], ...]

__all__ = [
    "HERE",
    "MIRRORED",
    "MOVED",
    "Axes",
    "at_rest",
    "bent",
    "difference",
    "gauss_table",
    "load_about",
    "tip_force",
    "transmitted",
]


@dataclass(frozen=True, eq=False)
class Axes:
    """How a scene is posed: in which units, and moved or mirrored by x ↦ o + Q·x.

    Args:
        metre: One unit of length [m].
        newton: One unit of force [N].
        Q: Orthogonal, shape (3, 3); det Q = −1 mirrors.
        origin: o, in units of length.
    """

    metre: float = 1.0
    newton: float = 1.0
    Q: Array = field(default_factory=lambda: np.eye(3))
    origin: Vector = (0.0, 0.0, 0.0)

    @property
    def hand(self) -> float:
        """det Q, by which axial vectors change sign."""
        return float(np.rint(np.linalg.det(self.Q)))

    @property
    def sections(self) -> Array:
        """Diagonal by which components in section frames change: a mirror leaves d1 and d2 and turns d3 round."""
        return np.array([1.0, 1.0, self.hand])

    def direction(self, x: float, y: float, z: float = 0.0) -> Vector:
        """Q·x."""
        return vector(self.Q @ (x, y, z))

    def place(self, x: float, y: float, z: float = 0.0) -> Vector:
        """o + Q·x [m]."""
        return vector(self.metre * (np.asarray(self.origin) + self.Q @ (x, y, z)))

    def force(self, x: float, y: float, z: float = 0.0) -> Vector:
        """A dead force [N]."""
        return vector(self.newton * (self.Q @ (x, y, z)))

    def moment(self, x: float, y: float, z: float) -> Vector:
        """A dead moment [N m]."""
        return vector(self.newton * self.metre * self.hand * (self.Q @ (x, y, z)))

    def section(self) -> Section:
        """No two stiffnesses alike: what is confused in a formula shows. Rigid in shear, which both models pose."""
        bending = self.newton * self.metre**2
        return Section(EA=900.0 * self.newton, GJ=0.7 * bending, EI=(bending, 2.0 * bending), rigid={"shear"})

    def back(self, result: Result) -> RodHistory:
        """The first rod as it would be at `HERE`."""
        rod, turn = result.rods[0], self.sections
        bending = self.newton * self.metre
        return replace(
            rod,
            s=rod.s / self.metre,
            r=(rod.r / self.metre - np.asarray(self.origin)) @ self.Q,
            frames=self.Q.T @ rod.frames * turn,
            n=rod.n / self.newton * turn,
            m=rod.m / bending * turn * self.hand,
        )


HERE = Axes()
MOVED = Axes(Q=SKEW.rotation, origin=SKEW.origin)
NORMAL = np.array([2.0, -3.0, 6.0]) / 7.0
MIRRORED = Axes(Q=np.eye(3) - 2.0 * np.outer(NORMAL, NORMAL), origin=(0.4, 0.1, -0.3))


def bent(axes: Axes, *, flat: bool, history: Table | None = None, motion: Static | None = None) -> Scene:
    """A clamped arc of unit length under dead and turning forces and moments at its end and inside.

    Args:
        axes: In which it is posed.
        flat: Whether everything lies in the plane of the arc.
        history: Of every load.
        motion: Of the scene.

    Returns:
        The scene.
    """
    out = 0.0 if flat else 1.0
    turn = axes.sections
    force = vector(axes.newton * turn * (0.4, 0.9, -0.3 * out))
    moment = vector(axes.newton * axes.metre * axes.hand * turn * (0.3 * out, -0.2 * out, 0.4))
    loads = (
        PointForce(axes.force(1.0, -2.0, 1.5 * out), "end", history=history),
        PointForce(axes.force(-1.0, 1.0, 3.0 * out), 0.5 * axes.metre, history=history),
        PointMoment(axes.moment(0.4 * out, -0.3 * out, 0.6), 0.25 * axes.metre, history=history),
        FollowerForce(force, 0.75 * axes.metre, history=history),
        FollowerMoment(moment, "end", history=history),
    )
    return Scene([arc(axes)], [Clamp("start")], loads, motion=motion or Static())


def arc(axes: Axes) -> Rod:
    """Of radius 0.8 and unit length, along the x axis and bending towards the y axis."""
    return Rod.arc(
        0.8 * axes.metre,
        1.25,
        axes.section(),
        start=axes.place(0.0, 0.0),
        direction=axes.direction(1.0, 0.0),
        towards=axes.direction(0.0, 1.0),
    )


def at_rest(axes: Axes, *, flat: bool) -> Scene:
    """A rod with no load but zero, in five steps: the arc in its plane, a pretwisted helix in space."""
    helix = Rod.curved(1.0, axes.section(), (3.0, 1.0, 5.0), start=axes.place(0.0, 0.0), pretwist=2.0)
    zero = PointForce((0.0, 0.0, 0.0), "end")
    return Scene([arc(axes) if flat else helix], [Clamp("start")], [zero], motion=Static(steps=5))


def tip_force(axes: Axes, *, history: Table) -> Scene:
    """A straight cantilever of unit length under a dead transverse tip force of 4 EI/L²."""
    x, y = axes.direction(1.0, 0.0), axes.direction(0.0, 1.0)
    rod = Rod.straight(axes.metre, axes.section(), start=axes.place(0.0, 0.0), direction=x, d2=y)
    return Scene([rod], [Clamp("start")], [PointForce(axes.force(0.0, 4.0), "end", history=history)])


def gauss_table(points: int) -> tuple[Array, Array, Table]:
    """Load factors of Gauss's rule on [0, 1], its weights, and the history that stops at each."""
    x, w = np.polynomial.legendre.leggauss(points)
    levels = (x + 1.0) / 2.0
    return levels, w / 2.0, ((0.0, 0.0), *((float(t), float(t)) for t in levels), (1.0, 1.0))


def load_about(result: Result, point: Array) -> tuple[Array, Array]:
    """Force and moment about a point of all point loads at the deformed shape of a scene with one rod."""
    rod, force, moment = result.rods[0], np.zeros(3), np.zeros(3)
    for load in result.scene.loads:
        assert not isinstance(load, LineForce | Gravity), "point loads only"
        ((_, s),) = result.scene.location(load.at, load.rod)
        node = int(np.argmin(np.abs(rod.s - s)))
        turns = isinstance(load, FollowerForce | FollowerMoment)
        R = rod.frames[-1, node] if turns else np.eye(3)
        if isinstance(load, PointForce | FollowerForce):
            F = R @ load.force
            force += F
            moment += np.cross(rod.r[-1, node] - point, F)
        else:
            moment += R @ load.moment
    return force, moment


def transmitted(result: Result) -> tuple[Array, Array]:
    """Force and moment in space that the first section of the first rod takes from the part beyond it."""
    rod = result.rods[0]
    return rod.frames[-1, 0] @ rod.n[-1, 0], rod.frames[-1, 0] @ rod.m[-1, 0]


def difference(a: RodHistory, b: RodHistory) -> float:
    """Largest difference of the last states, relative to the length and to the largest force and moment of `b`."""
    gaps = [np.abs(a.r[-1] - b.r[-1]).max() / b.s[-1], np.abs(a.frames[-1] - b.frames[-1]).max()]
    for x, y in ((a.n, b.n), (a.m, b.m)):
        gaps.append(np.abs(x[-1] - y[-1]).max() / np.abs(y[-1]).max())
    return float(max(gaps))


def vector(values: Array) -> Vector:
    """Three floats."""
    x, y, z = (float(v) for v in values)
    return x, y, z
