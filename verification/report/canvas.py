"""Diagrams as inline SVG, drawn small: colours, lines and markers are classes of the page's style sheet."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from math import ceil, floor, log10

__all__ = ["HEIGHT", "WIDTH", "Curve", "Star", "log_log", "markers", "power_of_ten", "svg", "text"]

# Of a panel, in pixels of a phone's screen: letters of 12 stay legible there.
WIDTH, HEIGHT = 360, 290
LEFT, RIGHT, TOP, BOTTOM = 46, 24, 10, 40
LETTER = 12
# A letter's width, at most, of those in most labels.
BROAD = 7.0
# Marker of each kind of curve, as a path about the origin.
MARKERS = {
    "p1": "M-3,0a3,3 0 1,0 6,0a3,3 0 1,0 -6,0",
    "p2": "M-2.7,-2.7h5.4v5.4h-5.4z",
    "p3": "M0,-3.6l3.4,6h-6.8z",
    "p4": "M0,-3.8l3.3,3.8l-3.3,3.8l-3.3,-3.8z",
    "p5": "M0,3.6l3.4,-6h-6.8z",
    "chord": "M-3.2,0a3.2,3.2 0 1,0 6.4,0a3.2,3.2 0 1,0 -6.4,0",
    "paper": "M-3,-3l6,6m0,-6l-6,6",
}
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Curve:
    """A line through measured points.

    Args:
        kind: Class of the style sheet: "p1" to "p5", "chord" or "paper".
        x: Positive.
        y: Positive.
        title: Said where the pointer rests.
        dashed: Planar kinematics.
        label: Beside the point `at`.
        at: Index of that point.
        theory: Slope dlog y/dlog x that leads to the point `at` by theory.
    """

    kind: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    title: str
    dashed: bool = False
    label: str = ""
    at: int = -1
    theory: float | None = None


@dataclass(frozen=True)
class Star:
    """A published point and the letter by which a table explains it."""

    x: float
    y: float
    letter: str
    title: str


@dataclass(frozen=True)
class Axis:
    """A logarithmic axis.

    Args:
        low: log₁₀ at its beginning.
        high: log₁₀ at its end.
        begin: Its pixel there.
        end: Its pixel there.
    """

    low: float
    high: float
    begin: float
    end: float

    def __call__(self, value: float) -> float:
        """Pixel of a value."""
        return self.begin + (log10(value) - self.low) / (self.high - self.low) * (self.end - self.begin)

    def holds(self, value: float) -> bool:
        """Whether a value lies on it."""
        return self.low - 1e-9 <= log10(value) <= self.high + 1e-9


def log_log(curves: Sequence[Curve], *, x: str, y: str, alt: str, band: float = 0.0, stars: Sequence[Star] = ()) -> str:
    """A diagram with both axes in decades.

    Args:
        curves: What is shown.
        x: Quantity and unit below it.
        y: Quantity and unit above it.
        alt: For readers who do not see it.
        band: Below which nothing can be said; shaded.
        stars: Published points.

    Returns:
        SVG.
    """
    xs = [v for c in curves for v in c.x] + [s.x for s in stars]
    ys = [v for c in curves for v in c.y] + [s.y for s in stars]
    if not xs:
        return svg(text(WIDTH / 2, HEIGHT / 2, "nothing converged", "middle"), alt)
    across = Axis(*spread(xs, 0.06, 0.5), LEFT, WIDTH - RIGHT)
    up = Axis(*spread(ys, 0.06, 2.0), HEIGHT - BOTTOM, TOP + LETTER + 4)
    parts = [shaded(up, band), *grid_x(across), *grid_y(up)]
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 6, x, "middle"))
    parts.append(text(4, TOP + 4, y))
    parts += [theory(c, across, up) for c in curves]
    parts += [line(c, across, up) for c in curves]
    parts += labels(curves, across, up)
    parts += [star(s, across(s.x), up(s.y)) for s in stars]
    return svg("".join(parts), alt)


def spread(values: Sequence[float], margin: float, least: float) -> tuple[float, float]:
    """Range of log₁₀ with a margin, at least so many decades wide."""
    low, high = log10(min(values)), log10(max(values))
    wider = max(0.0, least - (high - low)) / 2.0 + margin * max(high - low, least)
    return low - wider, high + wider


def grid_x(axis: Axis) -> Iterable[str]:
    """Ticks at 1, 2 and 5 of each decade, or at decades where there are many."""
    decades = range(floor(axis.low), ceil(axis.high) + 1)
    steps = (1, 2, 5) if axis.high - axis.low < 2.2 else (1,)
    for value in (m * 10.0**d for d in decades for m in steps):
        if axis.holds(value):
            pixel = axis(value)
            yield f'<path class="grid" d="M{pixel:.1f},{TOP + LETTER + 4}V{HEIGHT - BOTTOM}"/>'
            yield text(pixel, HEIGHT - BOTTOM + LETTER + 3, f"{value:g}", "middle")


def grid_y(axis: Axis) -> Iterable[str]:
    """Ticks at decades, seven at most."""
    every = ceil((axis.high - axis.low) / 7.0)
    for d in range(ceil(axis.low), floor(axis.high) + 1):
        if d % every == 0:
            pixel = axis(10.0**d)
            yield f'<path class="grid" d="M{LEFT},{pixel:.1f}H{WIDTH - RIGHT}"/>'
            yield text(LEFT - 5, pixel + 4, power_of_ten(d), "end")


def power_of_ten(exponent: int) -> str:
    """Such as 10⁻⁸."""
    return "1" if exponent == 0 else f"10{str(exponent).translate(SUPERSCRIPT)}"


def shaded(up: Axis, band: float) -> str:
    """What lies below `band`."""
    if band <= 0.0 or log10(band) <= up.low:
        return ""
    top = up(min(band, 10.0**up.high))
    return f'<path class="band" d="M{LEFT},{top:.1f}H{WIDTH - RIGHT}V{HEIGHT - BOTTOM}H{LEFT}z"/>'


def line(curve: Curve, across: Axis, up: Axis) -> str:
    """A curve with its markers."""
    points = " ".join(f"{across(a):.1f},{up(b):.1f}" for a, b in zip(curve.x, curve.y, strict=True))
    dashed = " dashed" if curve.dashed else ""
    return f'<polyline class="{curve.kind}{dashed}" points="{points}"><title>{escape(curve.title)}</title></polyline>'


def theory(curve: Curve, across: Axis, up: Axis) -> str:
    """The slope of theory, drawn back from the labelled point to the one before it."""
    end = curve.at % max(len(curve.x), 1)
    if curve.theory is None or end == 0:
        return ""
    (x0, x1), y1 = curve.x[end - 1 : end + 1], curve.y[end]
    y0 = y1 * (x0 / x1) ** curve.theory
    if not up.holds(y0):
        return ""
    return f'<path class="theory" d="M{across(x0):.1f},{up(y0):.1f}L{across(x1):.1f},{up(y1):.1f}"/>'


def labels(curves: Sequence[Curve], across: Axis, up: Axis) -> Iterable[str]:
    """Labels of curves, beside their points where they cover no other one nor, if there is such a place, a line."""
    taken: list[tuple[float, float, float]] = []
    drawn = [dots for c in curves for dots in _dots([(across(x), up(y)) for x, y in zip(c.x, c.y, strict=True)])]
    for c in curves:
        if not c.label:
            continue
        x, y, wide = across(c.x[c.at]), up(c.y[c.at]), BROAD * len(c.label)
        sides = [(x + 5, y - 4), (x + 5, y + LETTER), (x - 5 - wide, y - 4), (x - 5 - wide, y + LETTER)]
        inside = [(begin, base) for begin, base in sides if begin >= LEFT or begin > x]
        free = [
            (begin, base)
            for begin, base in inside
            if all(abs(base - b) > LETTER or begin > a + w or a > begin + wide for a, b, w in taken)
        ]
        clear = [
            (begin, base)
            for begin, base in free
            if not any(begin - 2 < u < begin + wide and base - LETTER < v < base + 3 for u, v in drawn)
        ]
        for begin, base in (clear + free)[:1]:
            taken.append((begin, base, wide))
            yield text(begin, base, c.label, kind=c.kind)


def _dots(points: Sequence[tuple[float, float]]) -> Iterable[tuple[float, float]]:
    """Pixels along a line, as far from one another as a letter is wide at most."""
    for (x, y), (a, b) in pairwise(points):
        n = 1 + ceil(max(abs(a - x), abs(b - y)) / BROAD)
        yield from ((x + k / n * (a - x), y + k / n * (b - y)) for k in range(n + 1))


def star(point: Star, x: float, y: float) -> str:
    """A published point."""
    title = f"<title>{escape(point.title)}</title>"
    return f'<g class="star"><path d="M{x:.1f},{y - 5:.1f}v10m-4.3,-7.5l8.6,5m0,-5l-8.6,5"/>{title}</g>' + text(
        x + 7, y + 4, point.letter
    )


def text(x: float, y: float, words: str, anchor: str = "start", kind: str = "") -> str:
    """Words on a picture."""
    place = "" if anchor == "start" else f' text-anchor="{anchor}"'
    colour = f' class="{kind}"' if kind else ""
    return f'<text x="{x:.1f}" y="{y:.1f}"{place}{colour}>{escape(words)}</text>'


def svg(content: str, alt: str, height: float = HEIGHT) -> str:
    """One <svg> element."""
    return f'<svg role="img" aria-label="{escape(alt)}" viewBox="0 0 {WIDTH} {height:.0f}">{content}</svg>'


def markers() -> str:
    """What the style sheet puts on the points of curves; once a page."""
    drawn = "".join(
        f'<marker id="m-{kind}" viewBox="-5 -5 10 10" markerWidth="10" markerHeight="10" markerUnits="userSpaceOnUse">'
        f'<path class="{kind}" d="{path}"/></marker>'
        for kind, path in MARKERS.items()
    )
    return f'<svg class="definitions" aria-hidden="true" width="0" height="0"><defs>{drawn}</defs></svg>'
