"""What is asked of the continuum model: equilibria and motions, critical loads, vibrations.

DOLFINx and PETSc are loaded when one of these functions is called, not before.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    from mpi4py.MPI import Intracomm

    from dolfinrod.eigen import Buckling, Modes
    from dolfinrod.result import Result, StepLog
    from dolfinrod.scene import Planar, Scene, Spatial

__all__ = ["buckling", "critical", "modes", "solve"]


def solve(
    scene: Scene,
    *,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: Intracomm | None = None,
    progress: Callable[[StepLog, float], None] | None = None,
    start: Result | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
) -> Result:
    """Equilibrium path or motion of a scene by the continuum model.

    Args:
        scene: The problem.
        elements: Elements of each rod, one number for all or one a rod.
        degree: Degree of centreline and rotation, 1 to 5.
        kinematics: `Planar()` or `Spatial()`; by default planar where the whole scene lies in one plane.
        comm: MPI communicator, by default the world; all its ranks call together and get the same complete result.
        progress: Called with each accepted step and the final time or pseudo-time.
        start: An earlier result on the same elements: its last state is the first guess; of the same scene, stepping
            goes on from its last pseudo-time. A motion in time goes on where a result of it ended; its steps, output
            and t_end may be others.
        checkpoint: HDF5 file that the run is kept in every minute and when it ends. Where it exists the run goes on
            from there, on any number of ranks and to a later t_end if wanted; of another scene or mesh it is refused.
            Functions of time and place count as the same where some of their values are.

    Returns:
        The states at the accepted load steps or output times.

    Raises:
        SceneError: The scene, an option, the start or the checkpoint cannot be solved or gone on from as given.
        NotConverged: A load step could not be taken; carries what had converged.
    """
    # DOLFINx takes a second to load and is not there on every machine that only writes scenes.
    from dolfinrod.continuum import solve as solve_continuum

    solving = partial(solve_continuum, scene, elements=elements, degree=degree, kinematics=kinematics, comm=comm)
    return solving(progress=progress, start=start, checkpoint=checkpoint)


def buckling(
    scene: Scene,
    *,
    modes: int = 3,
    at: Result | None = None,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: Intracomm | None = None,
) -> Buckling:
    """Critical loads seen from an equilibrium at t, (K + (t_cr − t) dK/dt) v = 0 with K the tangent along the path.

    Exact where the tangent changes linearly with the load, as in straight columns; an estimate where the rod bends
    before it buckles, better the nearer the equilibrium (`critical` goes there). Only loads and prescribed motions
    whose history varies at t grow on, each as it does there.

    Args:
        scene: The problem.
        modes: Number of modes sought; fewer are found where fewer exist.
        at: A result of the same scene on the same elements: the equilibrium at its last pseudo-time; by default
            that at t = 0, under steady loads.
        elements: Elements of each rod, one number for all or one a rod.
        degree: Degree of centreline and rotation, 1 to 5.
        kinematics: `Planar()` for modes within the plane of the scene; by default in space, whatever the scene.
        comm: MPI communicator, by default the world.

    Returns:
        Critical pseudo-times, the next one first, with multiplicities and shapes.

    Raises:
        SceneError: The scene or an option cannot be solved as given, or no load varies.
        NotConverged: No equilibrium under the steady loads.
    """
    from dolfinrod.continuum import buckling as buckling_continuum

    return buckling_continuum(
        scene, modes=modes, at=at, elements=elements, degree=degree, kinematics=kinematics, comm=comm
    )


def critical(
    scene: Scene,
    *,
    modes: int = 3,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: Intracomm | None = None,
) -> Buckling:
    """First critical point on the path from t = 0 to t_end, deformation before it included.

    Args:
        scene: The problem.
        modes: Number of modes sought there.
        elements: Elements of each rod, one number for all or one a rod.
        degree: Degree of centreline and rotation, 1 to 5.
        kinematics: `Planar()` for modes within the plane of the scene; by default in space.
        comm: MPI communicator, by default the world.

    Returns:
        The first factor is the critical pseudo-time, to about 1e-9; those of other modes are estimates from there.
        None where the whole path is free of critical points. `at` is the equilibrium just below.

    Raises:
        SceneError: The scene or an option cannot be solved as given.
        NotConverged: No equilibrium on the way.
    """
    from dolfinrod.continuum import critical as critical_continuum

    return critical_continuum(scene, modes=modes, elements=elements, degree=degree, kinematics=kinematics, comm=comm)


def modes(
    scene: Scene,
    *,
    modes: int = 6,
    at: Result | None = None,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: Intracomm | None = None,
) -> Modes:
    """Natural frequencies and shapes of small vibrations about an equilibrium, K v = ω² M v.

    Mass and rotary inertia are those of the sections, `rhoA` and `rhoI`, consistent with centreline and rotation.

    Args:
        scene: The problem.
        modes: Number of modes sought.
        at: A result of the same scene on the same elements: the equilibrium at its last pseudo-time; by default
            that at t = 0, under steady loads.
        elements: Elements of each rod, one number for all or one a rod.
        degree: Degree of centreline and rotation, 1 to 5.
        kinematics: `Planar()` for modes within the plane of the scene; by default in space, whatever the scene.
        comm: MPI communicator, by default the world.

    Returns:
        Frequencies, unstable directions first, then the lowest, with multiplicities and shapes.

    Raises:
        SceneError: The scene or an option cannot be solved as given, or a section has no density.
        NotConverged: No equilibrium under the steady loads.
    """
    from dolfinrod.continuum import modes as modes_continuum

    return modes_continuum(
        scene, modes=modes, at=at, elements=elements, degree=degree, kinematics=kinematics, comm=comm
    )
