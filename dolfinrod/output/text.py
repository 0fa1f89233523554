"""A scene and a result in words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from dolfinrod.scene import Planar, detect

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Rod, Scene

__all__ = ["contents", "summary"]


def summary(model: str, result: Result) -> str:
    """Outcome, cost and tip of a solve, two lines.

    Args:
        model: Who solved it.
        result: What was found.
    """
    cost, end = result.statistics, "converged at" if result.converged else "not converged beyond"
    return (
        f"{model}: {end} t = {result.t[-1]:.6g}; {result.formulation.kinematics}, {cost.dofs} unknowns; "
        f"load steps: {cost.load_steps}, Newton iterations: {cost.newton_iterations}, "
        f"{1e3 * cost.seconds_solve:.3g} ms\n  tip {_vector(result.tip, digits=10)} m"
    )


def contents(scene: Scene) -> list[str]:
    """Rods, supports, loads, motion and detected kinematics of a scene.

    Args:
        scene: Any scene.

    Returns:
        Lines.
    """
    found = detect(scene)
    plane = f", normal {_vector(found.normal)}" if isinstance(found, Planar) and found.normal is not None else ""
    return [
        *(line for k, rod in enumerate(scene.rods) for line in _rod(k, rod)),
        *(f"supports[{i}]: {support}" for i, support in enumerate(scene.supports)),
        *(f"loads[{i}]: {load}" for i, load in enumerate(scene.loads)),
        f"motion: {scene.motion}",
        f"kinematics: {type(found).__name__.lower()}{plane}",
    ]


def _rod(k: int, rod: Rod) -> list[str]:
    ends = " to ".join(_vector(rod.centerline(s)) for s in (0.0, rod.length))
    return [f"rods[{k}]: length {rod.length:.6g} m, from {ends} m", f"  {rod.shape}", f"  {rod.section}"]


def _vector(values: Iterable[float], *, digits: int = 6) -> str:
    return "(" + ", ".join(f"{value:.{digits}g}" for value in values) + ")"
