"""Points of some cross-sections of grooves, lips at y = 0, lands beside them."""

from __future__ import annotations

from math import acos, pi, sin, tan

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.quantity import number, positive
from dolfinrod.scene.surfaces.polyline import ROUND_OFF, Points

__all__ = ["flanked", "rounded"]


def flanked(beta_left: float, beta_right: float, half_width: float, depth: float | None) -> Points:
    """A trough with sloping flanks and a flat bottom that ends at z = 0, or none; arguments as `Groove.v`."""
    β_left, β_right = _slope(beta_left, "Groove.beta_left"), _slope(beta_right, "Groove.beta_right")
    width = positive(half_width, "Groove.half_width", "m")
    deepest = width * tan(β_left) if β_left < 0.5 * pi else None
    if depth is None and deepest is None:
        raise SceneError("is missing: a left flank that stands upright meets no bottom", field="Groove.depth")
    h = deepest if depth is None else positive(depth, "Groove.depth", "m")
    assert h is not None
    left, right = (0.0 if β == 0.5 * pi else h / tan(β) for β in (β_left, β_right))
    foot = -width + left
    if depth is None or abs(foot) <= ROUND_OFF * width:
        bottom: Points = ((0.0, -h),)
    elif foot < 0.0:
        bottom = ((foot, -h), (0.0, -h))
    else:
        raise SceneError(f"must be at most {deepest:.6g} m, where the flanks meet, got {h!r} m", field="Groove.depth")
    return ((-4.0 * width, 0.0), (-width, 0.0), *bottom, (right, 0.0), (right + 3.0 * width, 0.0))


def rounded(radius: float, depth: float | None) -> tuple[Points, float]:
    """A trough with a round bottom, and the fillet that rounds it; arguments as `Groove.round`.

    Both corners of a trapezium about an arc, rounded by its radius, take up the whole bottom and so meet.
    """
    R = positive(radius, "Groove.radius", "m")
    h = R if depth is None else positive(depth, "Groove.depth", "m")
    θ = acos(max(0.0, 1.0 - h / R))
    lip, foot = R * sin(θ), R * tan(0.5 * θ)
    return ((-4.0 * lip, 0.0), (-lip, 0.0), (-foot, -h), (foot, -h), (lip, 0.0), (4.0 * lip, 0.0)), R


def _slope(value: float, field: str) -> float:
    """Angle of a flank to the surface, up to a right one."""
    β = number(value, field, "rad")
    if not 0.0 < β <= 0.5 * pi:
        raise SceneError(f"must be above 0 and at most π/2 rad, got {β!r} rad", field=field)
    return β
