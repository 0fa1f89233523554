"""Scenes that many tests pose: rods anywhere in space, loads that turn with them, answers read in their own axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray

import dolfinrod as dr

Array = NDArray[np.float64]

# Whatever lies in a plane is solved in that plane and in space.
both_kinematics = pytest.mark.parametrize("kinematics", [dr.Planar(), dr.Spatial()], ids=["planar", "spatial"])

KIRCHHOFF = dr.Section(GJ=1 / 1.3, EI=1.0, rigid={"shear", "extension"})
# No two stiffnesses alike: what is confused in a formula shows.
GENERAL = dr.Section(EA=900.0, GA=(400.0, 300.0), GJ=0.7, EI=(1.0, 2.0))


def round_section(slenderness: float) -> dr.Section:
    """Circular section of a rod with L = EI = 1 and L/d = slenderness, ν = 0.3, shear factor 0.9."""
    EA = 16.0 * slenderness**2
    return dr.Section(EA=EA, GA=0.9 * EA / 2.6, GJ=1 / 1.3, EI=1.0)


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a scene is set up: x ↦ origin + Q x.

    Args:
        Q: Rotation, shape (3, 3); its columns are the scene's own axes.
        origin: Shape (3,) [m].
    """

    Q: Array
    origin: Array

    def turned(self, v: ArrayLike) -> tuple[float, ...]:
        """A force, moment or direction given in the scene's axes, in space."""
        return tuple(float(c) for c in self.Q @ np.asarray(v, dtype=float))

    def placed(self, x: ArrayLike) -> tuple[float, ...]:
        """A point given in the scene's axes, in space."""
        return tuple(float(c) for c in self.origin + self.Q @ np.asarray(x, dtype=float))

    def back(self, x: Array) -> Array:
        """Points of space in the scene's axes, shape (..., 3)."""
        return (x - self.origin) @ self.Q

    def straight(self, section: dr.Section, *, length: float = 1.0, start: ArrayLike = (0.0, 0.0, 0.0)) -> dr.Rod:
        """Rod along the scene's x axis with d2 along its y axis."""
        return dr.Rod.straight(
            length, section, start=self.placed(start), direction=self.turned((1, 0, 0)), d2=self.turned((0, 1, 0))
        )

    def arc(self, section: dr.Section, *, radius: float = 1.0, angle: float = np.pi / 4) -> dr.Rod:
        """Arc from the scene's origin along its x axis, bending towards its y axis."""
        return dr.Rod.arc(
            radius,
            angle,
            section,
            start=self.placed((0, 0, 0)),
            direction=self.turned((1, 0, 0)),
            towards=self.turned((0, 1, 0)),
        )


def rotation(quaternion: ArrayLike) -> Array:
    """Rotation matrix of a quaternion of any norm, scalar first."""
    w, x, y, z = np.asarray(quaternion, dtype=float) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


FLAT = Pose(np.eye(3), np.zeros(3))
SKEW = Pose(rotation((0.3, -0.7, 0.45, 0.5)), np.array([0.3, -0.2, 0.5]))


def poses() -> st.SearchStrategy[Pose]:
    """Every rotation, and origins up to ten metres off."""
    component, coordinate = st.floats(-1.0, 1.0), st.floats(-10.0, 10.0)
    quaternions = st.tuples(*[component] * 4).filter(lambda q: np.linalg.norm(q) > 0.1)
    origins = st.tuples(*[coordinate] * 3)
    return st.builds(lambda q, x: Pose(rotation(q), np.array(x)), quaternions, origins)


def cantilever(rod: dr.Rod, *loads: object, motion: dr.Static | None = None) -> dr.Scene:
    """A rod clamped at its start."""
    return dr.Scene([rod], [dr.Clamp("start")], loads, motion=motion or dr.Static())


def tip_loaded(section: dr.Section, force: float, pose: Pose = SKEW) -> dr.Scene:
    """The elastica: a cantilever of unit length under a dead transverse tip force."""
    return cantilever(pose.straight(section), dr.PointForce(pose.turned((0, force, 0)), "end"))


def rolled_up(section: dr.Section, turns: float, pose: Pose = SKEW) -> dr.Scene:
    """A cantilever of unit length under the end moment that bends it into so many circles."""
    moment = 2 * np.pi * turns * section.EI[1]
    return cantilever(pose.straight(section), dr.PointMoment(pose.turned((0, 0, moment)), "end"))


def followed(section: dr.Section, force: float, pose: Pose = SKEW) -> dr.Scene:
    """A cantilever of unit length under a transverse tip force fixed to its section."""
    return cantilever(pose.straight(section), dr.FollowerForce((0, force, 0), "end"))


def bend(force: float, *, GA: float = 5e6, pose: Pose = SKEW) -> dr.Scene:
    """The 45° bend of Bathe & Bolourchi: R = 100, unit square, E = 1e7, ν = 0, J = 1/6, dead force out of its plane."""
    section = dr.Section(EA=1e7, GA=GA, GJ=1e7 / 12, EI=1e7 / 12)
    return cantilever(pose.arc(section, radius=100.0), dr.PointForce(pose.turned((0, 0, force)), "end"))


def largest(a: ArrayLike) -> float:
    """Largest magnitude."""
    return float(np.abs(a).max())


def differences(a: dr.Result, b: dr.Result) -> dict[str, float]:
    """Largest differences between the last states of two results, in units of L, EI/L² and EI/L or of what acts."""
    L, EI = max(h.s[-1] for h in b.rods), max(max(rod.section.EI) for rod in b.scene.rods)
    scale = {"r": L, "frames": 1.0, "n": EI / L**2, "m": EI / L}
    scale |= {name: max(scale[name], *(largest(getattr(h, name)[-1]) for h in b.rods)) for name in ("n", "m")}
    found = dict.fromkeys(scale, 0.0)
    for one, other in zip(a.rods, b.rods, strict=True):
        for name in found:
            gap = largest(getattr(one, name)[-1] - getattr(other, name)[-1]) / scale[name]
            found[name] = max(found[name], gap)
    return found


def force_in_space(rod: dr.RodHistory, node: int) -> Array:
    """Force that the section at a node transmits from the part beyond it, in space."""
    return rod.frames[-1, node] @ rod.n[-1, node]


def orders(n: Sequence[int], errors: Sequence[float]) -> Array:
    """Observed orders between successive meshes of n elements."""
    return -np.diff(np.log(errors)) / np.diff(np.log(n))


def interpolated(s: Array, values: Array, degree: int, at: Array) -> Array:
    """A continuous piecewise polynomial given at its nodes, evaluated at arc lengths.

    Args:
        s: All nodes, `degree` a cell and the last one, shape (n_s,).
        values: Shape (n_s, d).
        degree: Of the polynomials.
        at: Shape (n,).

    Returns:
        Shape (n, d).
    """
    cell = np.clip(np.searchsorted(s[::degree], at, side="right") - 1, 0, (len(s) - 1) // degree - 1)
    nodes = cell[:, None] * degree + np.arange(degree + 1)
    x = s[nodes]
    basis = np.ones_like(x)
    for i in range(degree + 1):
        for j in range(degree + 1):
            if i != j:
                basis[:, i] *= (at - x[:, j]) / (x[:, i] - x[:, j])
    return np.einsum("ni,nid->nd", basis, values[nodes])


# "A complete scene file" of the design, word for word.
COMPLETE = """
[section.ramie.circle]
diameter = "20 um"
E = "2224.6 cN/tex"        # specific modulus: multiplied by the density
G = "106.2 cN/tex"
density = "1.54 g/cm**3"

[[rods]]
straight = { length = "40 mm", start = ["0 mm", "0 mm", "0 mm"], direction = [1, 0, 0] }
section = "ramie"

[[supports]]
clamp = { at = "start" }

[[loads]]
point_force = { at = "end", force = ["0 N", "-1 uN", "0 N"] }

[motion.static]

[solve]
elements = 16
degree = 3
"""
