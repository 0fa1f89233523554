"""Dead loads that push a rod along a translation which nothing resists: no shape of the rod is in equilibrium."""

from __future__ import annotations

from collections.abc import Iterator
from math import fsum, hypot
from typing import TYPE_CHECKING

from dolfinrod.scene.history import factor, kinks
from dolfinrod.scene.loads import FollowerForce, Gravity, LineForce, PointForce
from dolfinrod.scene.quantity import Vector
from dolfinrod.scene.supports import TRANSLATIONS

if TYPE_CHECKING:
    from dolfinrod.scene.loads import Load
    from dolfinrod.scene.scene import Scene

__all__ = ["pushed_away"]

# Forces that sum up to less than this fraction of their magnitudes are balanced: text and sums leave round-off.
BALANCED = 1e-9


def pushed_away(scene: Scene) -> tuple[str, ...]:
    """Free translations of single resting rods that the loads do work on in whatever shape.

    With δr = e all along a rod, δW = e·ΣF must vanish. ΣF, the sum of the dead forces, knows no shape. Follower forces
    R·F turn with the rod but keep their magnitudes, so that they balance no more than the sum of these. Turns are left
    to the solver: a rod may swing to where the moments vanish. So are rods that may touch something: it may hold them.

    Args:
        scene: Any scene.

    Returns:
        One sentence a rod: what is free and the force along it, where that is first out of balance among the times at
        which tables have a row and the end.
    """
    loose = [k for k in range(len(scene.rods)) if not scene.may_touch(k)]
    motions = {k: free for k in loose if any(free := _free_axes(scene, k))}
    if not motions:
        return ()
    t_end = scene.motion.t_end
    rows = {t for load in scene.loads for t in kinks(load.history) if 0.0 < t < t_end}
    found: dict[int, str] = {}
    for t in (*sorted(rows), t_end):
        dead, following = _forces(scene, t)
        for k in motions.keys() - found.keys():
            push = _unbalanced(dead.get(k, []), following.get(k, []), motions[k])
            if push:
                found[k] = f"rods[{k}] is free to move {push}" + (f" at t = {t:g}" if t < t_end else "")
    return tuple(found[k] for k in sorted(found))


def _free_axes(scene: Scene, k: int) -> tuple[bool, bool, bool]:
    """Which of x, y, z no support of rod k holds anywhere."""
    held = frozenset[str]().union(*(support.held() for support in scene.supports if support.rod in (None, k)))
    x, y, z = (axis not in held for axis in TRANSLATIONS)
    return x, y, z


def _forces(scene: Scene, t: float) -> tuple[dict[int, list[Vector]], dict[int, list[float]]]:
    """Dead forces and the magnitudes of follower forces on each rod [N]."""
    dead: dict[int, list[Vector]] = {}
    following: dict[int, list[float]] = {}
    for load in scene.loads:
        f = factor(load.history, t, scene.motion.t_end)
        for k, F in _resultants(scene, load):
            dead.setdefault(k, []).append((f * F[0], f * F[1], f * F[2]))
        if isinstance(load, FollowerForce):
            for k, _ in scene.location(load.at, load.rod):
                following.setdefault(k, []).append(abs(f) * hypot(*load.force))
    return dead, following


def _resultants(scene: Scene, load: Load) -> Iterator[tuple[int, Vector]]:
    """Rods that a dead force acts on, and the force on each at full load [N]; none where a load is not one."""
    every = range(len(scene.rods))
    if isinstance(load, Gravity):
        for k in every:
            weight = (scene.rods[k].section.rhoA or 0.0) * scene.rods[k].length
            yield k, (weight * load.g[0], weight * load.g[1], weight * load.g[2])
    elif isinstance(load, LineForce):
        for k in every if load.rod is None else (load.rod,):
            a, b = load.between or (0.0, scene.rods[k].length)
            yield k, ((b - a) * load.force[0], (b - a) * load.force[1], (b - a) * load.force[2])
    elif isinstance(load, PointForce):
        for k, _ in scene.location(load.at, load.rod):
            yield k, (load.force[0], load.force[1], load.force[2])


def _unbalanced(dead: list[Vector], following: list[float], free: tuple[bool, bool, bool]) -> str:
    """Which way, in words, if forces cannot vanish along the free axes; empty if they can."""
    x, y, z = (fsum(F[i] for F in dead) if free[i] else 0.0 for i in range(3))
    net, turning = hypot(x, y, z), fsum(following)
    scale = turning + fsum(hypot(*F) for F in dead)
    if net - turning > BALANCED * scale:
        along = ", ".join(f"{c / net:.6g}" for c in (x, y, z))
        return f"along ({along}), and its loads push it there with {net - turning:.6g} N"
    # Where all axes are free, no turn hides a part of a follower force either.
    largest = max(following, default=0.0)
    if all(free) and 2 * largest - turning - net > BALANCED * scale:
        return f"everywhere, and nothing balances its follower force of {largest:.6g} N"
    return ""
