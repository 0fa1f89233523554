"""How far a model is from a law: it solves what the law needs; the largest violation comes back.

Violations are relative to the length of the rod, to the largest force or moment, or to the energy. They are round-off,
except where a quadrature enters.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import PointForce, Static
from verification.lawscenes import (
    HERE,
    MOVED,
    Axes,
    at_rest,
    bent,
    difference,
    gauss_table,
    load_about,
    tip_force,
    transmitted,
)
from verification.models import BOTH, Continuum

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.case import Array
    from verification.models import Model

__all__ = [
    "energy",
    "forces",
    "in_space",
    "kinematics",
    "moments",
    "moved_by",
    "plane",
    "rest",
    "steps",
    "units",
    "unloading",
]

# Elements that put nodes under every load of the scenes.
ELEMENTS = {"continuum": 8, "discrete": 20}
UNITS = tuple((10.0**a, 10.0**b) for a in (-12, 0, 12) for b in (-12, 0, 12) if a or b)


def moved_by(axes: Axes) -> Callable[[Model], float]:
    """The answer of a moved or mirrored scene against the moved or mirrored answer."""

    def violation(model: Model) -> float:
        there, here = (solved(model, axes=a) for a in (axes, HERE))
        return difference(axes.back(there), here.rods[0])

    return violation


def steps(model: Model) -> float:
    """Eight load steps against one."""
    return difference(solved(model, motion=Static(steps=8)).rods[0], solved(model).rods[0])


def unloading(model: Model) -> float:
    """The state after loading and unloading against the one before."""
    table = ((0.0, 0.0), (0.5, 1.0), (1.0, 0.0))
    scene = bent(HERE, flat=is_planar(model), history=table, motion=Static(steps=2))
    rod = solve(model, scene).rods[0]
    off = np.abs(rod.r[-1] - rod.r[0]).max() / rod.s[-1]
    return float(max(off, np.abs(rod.frames[-1] - rod.frames[0]).max()))


def forces(model: Model) -> float:
    """Force at the clamp against the sum of all loads at the deformed shape."""
    result = solved(model)
    force, _ = load_about(result, result.rods[0].r[-1, 0])
    return relative(transmitted(result)[0] - force, force)


def moments(model: Model) -> float:
    """Moment at the clamp against the moment of all loads about it at the deformed shape."""
    result = solved(model)
    _, moment = load_about(result, result.rods[0].r[-1, 0])
    return relative(transmitted(result)[1] - moment, moment)


def kinematics(model: Model) -> float:
    """Tip found with an angle against the tip found with quaternions, on 16 elements of degree 5."""
    scene = bent(MOVED, flat=True)
    fine = [Continuum(5, k) for k in BOTH]
    assert model.family == fine[0].family
    planar, spatial = (m.solve(scene, 16).tip for m in fine)
    return float(np.linalg.norm(planar - spatial) / scene.rods[0].length)


def plane(model: Model) -> float:
    """How far a rod loaded within a skew plane leaves that plane."""
    rod = solve(model, bent(MOVED, flat=True)).rods[0]
    normal = MOVED.Q[:, 2]
    return float(np.abs((rod.r[-1] - rod.r[0, 0]) @ normal).max() / rod.s[-1])


def rest(model: Model) -> float:
    """Displacements, rotations and resultants of an unloaded curved and pretwisted rod after five steps."""
    rod = solve(model, at_rest(MOVED, flat=is_planar(model))).rods[0]
    gaps = (rod.r - rod.r[0], rod.frames - rod.frames[0], rod.n, rod.m)
    return float(max(np.abs(gap).max() for gap in gaps))


def energy(model: Model) -> float:
    """Strain energy of a tip-loaded cantilever against ∫ F·dr, by eight Gauss points over the load factor."""
    levels, weights, table = gauss_table(8)
    result = solve(model, tip_force(MOVED, history=table))
    (load,) = result.scene.loads
    assert isinstance(load, PointForce)
    path = (result.rods[0].r[:, -1] - result.rods[0].r[0, -1]) @ np.asarray(load.force)
    at = [int(np.argmin(np.abs(result.t - level))) for level in levels]
    work = path[-1] - weights @ path[at]
    return float(abs(result.energy["strain"][-1] / work - 1.0))


def units(model: Model) -> float:
    """Answers in units of length and force from 1e-12 to 1e12 against that in units of one."""
    one = solved(model).rods[0]
    flat = is_planar(model)
    return max(difference(a.back(solve(model, bent(a, flat=flat))), one) for a in (Axes(*pair) for pair in UNITS))


def solved(model: Model, *, axes: Axes = HERE, motion: Static | None = None) -> Result:
    """The bent rod of the laws, in the plane where the model is planar."""
    return solve(model, bent(axes, flat=is_planar(model), motion=motion or Static()))


def solve(model: Model, scene: Scene) -> Result:
    """On the mesh of the laws."""
    return model.solve(scene, ELEMENTS[model.family])


def relative(gap: Array, whole: Array) -> float:
    """Length of a vector against that of another."""
    return float(np.linalg.norm(gap) / np.linalg.norm(whole))


def is_planar(model: Model) -> bool:
    """Whether a model knows a plane only."""
    return model.kinematics_name == "planar"


def in_space(model: Model) -> bool:
    """Whether a model could leave a plane."""
    return not is_planar(model)
