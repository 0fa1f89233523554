"""Rods in space: one scene, posed once as plain data, solved by the continuum model.

    import dolfinrod as dr

    rod = dr.Rod.straight(length=1.0, section=dr.Section(EA=1e4, GA=4e3, GJ=1.0, EI=1.0))
    scene = dr.Scene(rods=[rod], supports=[dr.Clamp(at="start")], loads=[dr.PointForce((0, -1, 0), at="end")])
    result = dr.solve(scene, elements=8, degree=3)

Importing this package loads neither DOLFINx nor PETSc; `solve` does.
"""

from __future__ import annotations

from typing import Any

from dolfinrod.result import Formulation, NotConverged, Result, RodHistory, Statistics, StepLog
from dolfinrod.scene import (
    Clamp,
    FollowerForce,
    FollowerMoment,
    Gravity,
    Guide,
    LineForce,
    Pin,
    Planar,
    PointForce,
    PointMoment,
    Prescribed,
    Rod,
    Scene,
    SceneError,
    Section,
    Spatial,
    Static,
    Steady,
)

__all__ = [
    "Clamp",
    "FollowerForce",
    "FollowerMoment",
    "Formulation",
    "Gravity",
    "Guide",
    "LineForce",
    "NotConverged",
    "Pin",
    "Planar",
    "PointForce",
    "PointMoment",
    "Prescribed",
    "Result",
    "Rod",
    "RodHistory",
    "Scene",
    "SceneError",
    "Section",
    "Spatial",
    "Static",
    "Statistics",
    "Steady",
    "StepLog",
    "solve",
]


def solve(scene: Scene, **options: Any) -> Result:
    """Equilibrium path of a scene by the continuum model.

    Args:
        scene: The problem.
        **options: `elements`, `degree`, `kinematics` and the others of `dolfinrod.continuum.solve`.

    Returns:
        The states at the accepted load steps, complete on every MPI rank.

    Raises:
        SceneError: The scene cannot be solved as posed.
        NotConverged: A load step could not be taken.
    """
    # DOLFINx takes a second to load and is not there on every machine that only writes scenes.
    from dolfinrod.continuum import solve as solve_continuum

    return solve_continuum(scene, **options)
