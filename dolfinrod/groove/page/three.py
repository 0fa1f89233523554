"""The bundles in three dimensions with a slider for time: one HTML file that works offline."""

from __future__ import annotations

import json
from html import escape
from importlib.resources import files
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_hex

from dolfinrod.groove.page.panels import fibre_colours
from dolfinrod.groove.page.show import Show
from dolfinrod.groove.page.views import CORE, WALL, window

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.groove.film import Film

    Array = NDArray[np.float64]

__all__ = ["write_three"]

MM = 1e3
# Coordinates are kept in tenths of a micrometre, a hundredth of a fibre's radius.
GRAIN = 1e-7
# Numbers in the file beyond which frames are left out, and nodes beyond which fibres are lines instead of tubes.
MOST_NUMBERS, MOST_NODES = 1_500_000, 6_000
SIDES, CORE_SIDES = 8, 36
# Of the box around a bundle: how long, and how wide.
LENGTH, ACROSS = 2.6, 1.3
EYE = {"x": -1.9, "y": 2.9, "z": 2.2}


def write_three(show: Show, path: Path) -> None:
    """Write the page.

    Args:
        show: What the report shows.
        path: File to write.
    """
    import plotly.graph_objects as go
    from plotly.offline import get_plotlyjs

    own = files("dolfinrod.groove.page")
    figure = go.Figure()
    bundles = []
    for number, (kind, (run, film)) in enumerate(show.shown.items()):
        scene = "scene" if number == 0 else f"scene{number + 1}"
        figure.update_layout({scene: _scene(film)})
        traces = _traces(film, scene, go)
        bundles.append(
            {
                "scene": scene,
                "name": f"{kind.replace('_', ' ').capitalize()}, seed {run.seed}",
                "first": len(figure.data),
            }
            | _data(film)
        )
        figure.add_traces(traces)
    figure.update_layout(margin={"l": 0, "r": 0, "t": 0, "b": 0}, showlegend=False, paper_bgcolor="#fdfdfc")
    page = own.joinpath("three.html").read_text(encoding="utf-8")
    filled = {
        "KIND": escape(show.base.words),
        "DATA": json.dumps(bundles, separators=(",", ":")).replace("</", "<\\/"),
        "FIGURE": figure.to_json().replace("</", "<\\/"),
        "PLOTLY": get_plotlyjs(),
        "SCRIPT": own.joinpath("three.js").read_text(encoding="utf-8"),
    }
    part = path.with_suffix(".html.part")
    for name, text in filled.items():
        page = page.replace(f"<!--{name}-->", text, 1)
    part.write_text(page, encoding="utf-8")
    part.replace(path)


def _scene(film: Film) -> dict[str, Any]:
    """Axes of a bundle: X squeezed, Y and Z alike, Y upwards, the fibres' own handedness kept."""
    (left, right), (bottom, top) = MM * window(film)
    X = MM * film.paths[..., 0].min(), MM * film.paths[..., 0].max()
    plain = {"backgroundcolor": "#f6f6f4", "gridcolor": "#dcdcd8", "showspikes": False, "nticks": 6}
    return {
        "xaxis": {"title": "X [mm]", "range": X, **plain},
        "yaxis": {"title": "Y [mm]", "range": (bottom, top), **plain},
        "zaxis": {"title": "Z [mm]", "range": (left, right), **plain},
        "aspectmode": "manual",
        "aspectratio": {"x": LENGTH, "y": ACROSS * (top - bottom) / (right - left), "z": ACROSS},
        "camera": {"up": {"x": 0, "y": 1, "z": 0}, "eye": EYE},
    }


def _traces(film: Film, scene: str, go: Any) -> list[Any]:
    """The groove, the core where there is one, and the fibres, whose places a script fills in."""
    X = MM * np.array([film.paths[..., 0].min(), film.paths[..., 0].max()])
    left, right = window(film)[0]
    z = np.unique(np.clip(film.outline[:, 0], left, right))
    y = np.interp(z, film.outline[:, 0], film.outline[:, 1])
    plain = {"scene": scene, "hoverinfo": "name", "flatshading": False}
    n = len(z)
    i = np.arange(n - 1)
    corners = np.concatenate([np.stack([i, i + 1, i + n + 1], 1), np.stack([i, i + n + 1, i + n], 1)])
    traces = [
        go.Mesh3d(
            x=np.repeat(X, n), y=MM * np.tile(y, 2), z=MM * np.tile(z, 2), color=WALL, opacity=0.4, name="groove",
            **_corners(corners), **plain,
        )
    ]  # fmt: skip
    if len(film.core):
        traces.append(go.Mesh3d(color=CORE, name="core", **_corners(_tube(2, CORE_SIDES)), **plain))
    for k, colour in enumerate(fibre_colours(film.paths.shape[1])):
        name, shade = f"fibre {k + 1}", to_hex(colour)
        if _thick(film):
            corners = _tube(film.paths.shape[2], SIDES)
            traces.append(go.Mesh3d(color=shade, name=name, **_corners(corners), **plain))
        else:
            line = {"color": shade, "width": 3}
            traces.append(go.Scatter3d(mode="lines", line=line, name=name, scene=scene, hoverinfo="name"))
    return traces


def _thick(film: Film) -> bool:
    """Whether fibres are tubes."""
    return film.paths.shape[1] * film.paths.shape[2] <= MOST_NODES


def _tube(nodes: int, sides: int) -> NDArray[np.int64]:
    """Triangles of a tube, whose points go around at one node after the other, shape (n, 3)."""
    at, side = (index.ravel() for index in np.meshgrid(np.arange(nodes - 1), np.arange(sides), indexing="ij"))
    a, b = at * sides + side, at * sides + (side + 1) % sides
    return np.concatenate([np.stack([a, b, b + sides], 1), np.stack([a, b + sides, a + sides], 1)])


def _corners(triangles: NDArray[np.int64]) -> dict[str, Any]:
    return dict(zip("ijk", triangles.T, strict=True))


def _data(film: Film) -> dict[str, Any]:
    """Frames of a bundle for the script: whole numbers of the grain."""
    step = max(1, ceil(film.paths.size / MOST_NUMBERS))
    chosen = np.unique(np.r_[np.arange(0, len(film.times), step), len(film.times) - 1])
    paths = np.round(film.paths[chosen] / GRAIN).astype(int)
    X = film.paths[..., 0].min(), film.paths[..., 0].max()
    return {
        "t": film.times[chosen].tolist(),
        "fibres": paths.shape[1],
        "nodes": paths.shape[2],
        "paths": paths.reshape(len(chosen), -1).tolist(),
        "core": (MM * film.core[chosen]).tolist() if len(film.core) else [],
        "X": [MM * x for x in X],
        "radius": MM * float(film.radius[0]),
        "sides": SIDES if _thick(film) else 0,
        "coreSides": CORE_SIDES,
        "grain": MM * GRAIN,
    }
