"""The loads of a scene as terms: which nodes, which numbers, which history."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.placement import exact_zeros
from dolfinrod.continuum.terms.point import DeadForces, DeadMoments, FollowerForces, FollowerMoments
from dolfinrod.scene import FollowerForce, FollowerMoment, Gravity, LineForce, PointForce, PointMoment
from dolfinrod.scene.history import factor

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.continuum.constraints import Locate
    from dolfinrod.continuum.kinematics import Kinematics
    from dolfinrod.continuum.placement import Placement
    from dolfinrod.continuum.terms.point import PointTerm
    from dolfinrod.scene import Scene
    from dolfinrod.scene.history import History
    from dolfinrod.scene.loads import PointLoad

__all__ = ["line_loads", "point_terms"]


def line_loads(
    scene: Scene, placement: Placement, rod: NDArray[np.int64], s: NDArray[np.float64]
) -> tuple[list[History], NDArray[np.float64]]:
    """Line forces and weight at the quadrature points, in working units.

    Args:
        scene: Its loads.
        placement: Units and directions.
        rod: Rod of every cell, shape (cells,).
        s: Arc length of the quadrature points in L, shape (cells, points).

    Returns:
        History of each load, and its line load, shape (loads, cells, points, d).
    """
    per_length = placement.force / placement.length
    histories: list[History] = []
    fields = []
    for load in scene.loads:
        if isinstance(load, Gravity):
            rhoA = np.array([r.section.rhoA for r in scene.rods], dtype=float)
            f = rhoA[rod, None, None] * np.asarray(load.g) * np.ones((*s.shape, 1))
        elif isinstance(load, LineForce):
            acts = (
                np.ones_like(s) if load.rod is None else np.where(rod == load.rod, 1.0, 0.0)[:, None] * np.ones_like(s)
            )
            if load.between is not None:
                a, b = (end / placement.length for end in load.between)
                acts = acts * ((s > a) & (s < b))
            f = acts[:, :, None] * np.asarray(load.force)
        else:
            continue
        histories.append(load.history)
        fields.append(exact_zeros(f @ placement.axes) / per_length)
    return histories, np.array(fields).reshape(len(fields), *s.shape, placement.axes.shape[1])


def point_terms(
    scene: Scene, kinematics: Kinematics, placement: Placement, locate: Locate
) -> list[Callable[[float], PointTerm]]:
    """One term for each kind of point load with nodes on this rank, to be called with the pseudo-time.

    Args:
        scene: Its loads.
        kinematics: How sections turn.
        placement: Units and directions.
        locate: Dofs of the node at (rod, s) if this rank owns it, else None.
    """
    builders = []
    for kind in (PointForce, PointMoment, FollowerForce, FollowerMoment):
        rows = [
            (node, _vector(load, scene.rods[rod].frames(s), placement), load.history)
            for load in scene.loads
            if isinstance(load, kind)
            for rod, s in scene.location(load.at, load.rod)
            if (node := locate(rod, s)) is not None
        ]
        if rows:
            builders.append(_builder(kind, rows, kinematics, scene.motion.t_end))
    return builders


def _vector(load: PointLoad, R_0: NDArray[np.float64], placement: Placement) -> NDArray[np.float64]:
    """Force or moment in working directions and units; that of a follower in stress-free directions."""
    turn = np.eye(3) if isinstance(load, PointForce | PointMoment) else R_0
    if isinstance(load, PointForce | FollowerForce):
        return exact_zeros(turn @ np.asarray(load.force) @ placement.axes) / placement.force
    return exact_zeros(turn @ np.asarray(load.moment) @ placement.spin_axes) / placement.moment


def _builder(
    kind: type[PointLoad],
    rows: list[tuple[dict[str, NDArray[np.int32]], NDArray[np.float64], History]],
    kinematics: Kinematics,
    t_end: float,
) -> Callable[[float], PointTerm]:
    r = np.array([node["r"] for node, _, _ in rows])
    q = np.array([node["q"] for node, _, _ in rows])
    full = np.array([value for _, value, _ in rows])
    histories = [history for _, _, history in rows]

    def at(t: float) -> PointTerm:
        values = full * np.array([factor(history, t, t_end) for history in histories])[:, None]
        if kind is PointForce:
            return DeadForces(r, values)
        if kind is PointMoment:
            return DeadMoments(kinematics, q, values)
        if kind is FollowerForce:
            return FollowerForces(kinematics, r, q, values)
        return FollowerMoments(kinematics, q, values)

    return at
