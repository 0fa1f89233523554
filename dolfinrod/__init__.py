"""Rods in space: one scene, posed once as plain data, solved by the continuum model.

    import dolfinrod as dr

    rod = dr.Rod.straight(length=1.0, section=dr.Section(EA=1e4, GA=4e3, GJ=1.0, EI=1.0))
    scene = dr.Scene(rods=[rod], supports=[dr.Clamp(at="start")], loads=[dr.PointForce((0, -1, 0), at="end")])
    result = dr.solve(scene, elements=8, degree=3)

Importing this package loads neither DOLFINx nor PETSc; `solve` does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

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

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from mpi4py.MPI import Intracomm

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


def solve(
    scene: Scene,
    *,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: Intracomm | None = None,
    progress: Callable[[StepLog, float], None] | None = None,
    start: Result | None = None,
) -> Result:
    """Equilibrium path of a scene by the continuum model.

    Args:
        scene: The problem.
        elements: Elements of each rod, one number for all or one a rod.
        degree: Degree of centreline and rotation, 1 to 5.
        kinematics: `Planar()` or `Spatial()`; by default planar where the whole scene lies in one plane.
        comm: MPI communicator, by default the world; all its ranks call together and get the same complete result.
        progress: Called with each accepted step and the final pseudo-time.
        start: An earlier result on the same elements: its last state is the first guess; of the same scene, stepping
            goes on from its last pseudo-time.

    Returns:
        The states at the accepted load steps.

    Raises:
        SceneError: The scene or an option cannot be solved as given.
        NotConverged: A load step could not be taken; carries what had converged.
    """
    # DOLFINx takes a second to load and is not there on every machine that only writes scenes.
    from dolfinrod.continuum import solve as solve_continuum

    return solve_continuum(
        scene, elements=elements, degree=degree, kinematics=kinematics, comm=comm, progress=progress, start=start
    )
