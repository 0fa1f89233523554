"""Deformed shapes: both models over the stress-free rod, seen where most of it is seen."""

from __future__ import annotations

from itertools import product
from math import floor, log10
from typing import TYPE_CHECKING

import numpy as np

from verification.report.canvas import WIDTH, svg, text

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from verification.case import Array
    from verification.shape import Shape

__all__ = ["drawn"]

MARGIN, LOWEST, HIGHEST, FOOT = 14.0, 130.0, 262.0, 56.0
# A spread below this part of the whole is none.
FLAT = 1e-6
# Directions from which a shape in space may be seen: azimuth and elevation [degrees].
VIEWS = tuple(product((-150.0, -125.0, -55.0, -30.0), (22.0, 35.0)))
NAMES = ("x", "y", "z")
DOTS = 26


def drawn(shape: Shape, title: str) -> str:
    """The picture of a case.

    Args:
        shape: Its lines.
        title: Of the case.

    Returns:
        SVG, with the directions of the axes and a scale.
    """
    lines = [*shape.stress_free, *shape.continuum, *shape.discrete]
    if not lines:
        return svg(text(WIDTH / 2, LOWEST / 2, "nothing converged", "middle"), title, LOWEST)
    points = np.concatenate([*lines, *shape.ribs])
    if shape.reference is not None:
        points = np.vstack([points, shape.reference])
    view = projection(points)
    flat = points @ view.T
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = max(high - low)
    scale = min((WIDTH - 2 * MARGIN) / max(high[0] - low[0], 1e-3 * size), HIGHEST / max(high[1] - low[1], 1e-3 * size))
    height = max(LOWEST, scale * (high[1] - low[1]) + 2 * MARGIN)
    middle = np.array([WIDTH, height]) / 2.0

    def onto(line: Array) -> Array:
        return np.asarray(middle + (line @ view.T - (low + high) / 2.0) * (scale, -scale))

    parts = [path("free", onto(line)) for line in shape.stress_free]
    parts += [path("rib", onto(rib)) for rib in shape.ribs]
    parts += [path("deformed", onto(line)) for line in shape.continuum]
    parts += [dots(onto(line)) for line in shape.discrete]
    if shape.reference is not None:
        parts.append(cross(onto(np.array([shape.reference]))[0]))
    parts.append(axes(view, height + FOOT - 24.0))
    parts.append(measure(scale, size, height + FOOT - 14.0))
    return svg("".join(parts), f"{title}: deformed shape by both models over the stress-free one", height + FOOT)


def projection(points: Array) -> Array:
    """Directions to the right and up of the picture, shape (2, 3): a coordinate plane if all lies in one."""
    extent = np.ptp(points, axis=0)
    for normal in (2, 1, 0):
        if extent[normal] <= FLAT * extent.max():
            return np.delete(np.eye(3), normal, axis=0)
    centred = points - points.mean(axis=0)

    def shown(view: Array) -> float:
        return float(np.linalg.det(np.cov((centred @ view.T).T)))

    return max((seen_from(*np.radians(angles)) for angles in VIEWS), key=shown)


def seen_from(azimuth: float, elevation: float) -> Array:
    """Parallel projection with z upwards."""
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    toward = np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])
    return np.stack([right, np.cross(toward, right)])


def path(kind: str, points: Array) -> str:
    """A line of a class of the style sheet."""
    return f'<polyline class="{kind}" points="{pixels(points)}"/>'


def pixels(points: Iterable[Sequence[float]]) -> str:
    """Coordinates to a tenth of a pixel."""
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def dots(points: Array) -> str:
    """Nodes of the discrete model, not more than the eye can tell apart."""
    every = max(1, (len(points) - 1) // DOTS)
    return "".join(f'<circle class="node" cx="{x:.1f}" cy="{y:.1f}" r="2.6"/>' for x, y in points[::every])


def cross(at: Array) -> str:
    """Where the reference is."""
    x, y = at
    return f'<path class="reference" d="M{x - 7:.1f},{y:.1f}h14M{x:.1f},{y - 7:.1f}v14"/>'


def axes(view: Array, bottom: float) -> str:
    """Arrows along x, y and z, those that are seen."""
    parts = []
    start = np.array([30.0, bottom])
    for name, direction in zip(NAMES, view.T, strict=True):
        if np.linalg.norm(direction) < 0.1:
            continue
        end = start + 22.0 * direction * (1.0, -1.0)
        letter = start + 30.0 * direction * (1.0, -1.0) + (-3.5, 4.0)
        parts.append(f'<path class="axis" d="M{start[0]:.1f},{start[1]:.1f}L{end[0]:.1f},{end[1]:.1f}"/>')
        parts.append(text(letter[0], letter[1], name))
    return "".join(parts)


def measure(scale: float, size: float, bottom: float) -> str:
    """A bar of a round number of metres."""
    length = 10.0 ** floor(log10(size / 2.0))
    length *= next(m for m in (5.0, 2.0, 1.0) if m * length <= size / 2.0)
    right, long = WIDTH - MARGIN, scale * length
    bar = f'<path class="axis" d="M{right - long:.1f},{bottom - 4:.1f}v4h{long:.1f}v-4"/>'
    return bar + text(right - long / 2.0, bottom - 8.0, f"{length:g} m", "middle")
