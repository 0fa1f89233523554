"""Bundles for ParaView: fibres at every frame, the groove and the core."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove.film import Film
from dolfinrod.groove.page.show import Show
from dolfinrod.output.vtk import write_collection

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Cells = NDArray[np.int64]

__all__ = ["write_paraview"]

# Sides of the core.
SIDES = 48


def write_paraview(show: Show, folder: Path) -> None:
    """Write `KIND.pvd` of each kind: its fibres, `KIND-0000.vtu`, …, `KIND-groove.vtu` and `KIND-core.vtu`.

    The core has a file a frame, `KIND-core-0000.vtu`, …, where it rolls.

    Point data of fibres: arc length `s` [m], `tension` [N], `walls`, the line load of groove and core [N/m], `radius`
    [m]. Cell data: `fibre`, numbered from 1 on. All in SI units.

    Args:
        show: What the report shows.
        folder: Made where it does not exist; files of an earlier report in it are taken away.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for former in (*folder.glob("*.vtu"), *folder.glob("*.pvd")):
        former.unlink()
    for kind, (_, film) in show.shown.items():
        groove = f"{kind}-groove.vtu"
        _quads(folder / groove, *_pulled(film, film.outline))
        cores = _cores(folder, kind, film)
        names = [f"{kind}-{f:04d}.vtu" for f in range(len(film.times))]
        for f, name in enumerate(names):
            _fibres(folder / name, film, f)
        shown = [[name, groove, *core] for name, core in zip(names, cores, strict=True)]
        write_collection(folder / f"{kind}.pvd", film.times, shown)


def _cores(folder: Path, kind: str, film: Film) -> list[list[str]]:
    """Files of the core at each frame, one for all where it rests."""
    if not len(film.core):
        return [[] for _ in film.times]
    rests = bool((film.core == film.core[0]).all())
    names = [f"{kind}-core.vtu" if rests else f"{kind}-core-{f:04d}.vtu" for f in range(len(film.times))]
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES + 1)
    for f, name in enumerate(names[:1] if rests else names):
        y, z, radius = film.core[f]
        _quads(folder / name, *_pulled(film, (z, y) + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)))
    return [[name] for name in names]


def _fibres(path: Path, film: Film, f: int) -> None:
    """Fibres at one frame as lines."""
    # It takes a fifth of a second to load.
    import meshio

    n, nodes = film.paths.shape[1:3]
    first = (nodes * np.arange(n)[:, None] + np.arange(nodes - 1)).ravel()
    data = {
        "s": np.tile(film.s, n),
        "tension": film.pull[f].ravel(),
        "walls": film.pressed[f].ravel(),
        "radius": np.full(n * nodes, film.radius[0]),
    }
    cells = [("line", np.stack([first, first + 1], axis=1))]
    fibre = [np.repeat(np.arange(1, n + 1), nodes - 1)]
    points = film.paths[f].reshape(-1, 3)
    meshio.write(path, meshio.Mesh(points, cells, point_data=data, cell_data={"fibre": fibre}))


def _pulled(film: Film, line: Array) -> tuple[Array, Cells]:
    """A line of z and y pulled along all X that fibres come by, and its quadrilaterals."""
    X = film.paths[..., 0].min(), film.paths[..., 0].max()
    points = np.concatenate([np.column_stack((np.full(len(line), x), line[:, 1], line[:, 0])) for x in X])
    i, n = np.arange(len(line) - 1), len(line)
    return points, np.stack([i, i + 1, i + 1 + n, i + n], axis=1)


def _quads(path: Path, points: Array, cells: Cells) -> None:
    import meshio

    meshio.write(path, meshio.Mesh(points, [("quad", cells)]))
