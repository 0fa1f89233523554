"""The report of a folder of runs."""

from __future__ import annotations

import os
from pathlib import Path

from dolfinrod.groove.runs import Folder
from dolfinrod.scene import SceneError

__all__ = ["report"]


def report(folder: str | os.PathLike[str]) -> Path:
    """Write what the finished runs of a folder show: `index.html`, `three.html`, tables and files for ParaView.

    The page holds its pictures and needs nothing else; it leads to `three.html`, the bundles in three dimensions with
    a slider for time, which works offline too. `data/` has every number that is drawn as CSV and JSON, with units,
    `paraview/` the bundle of each kind as `KIND.pvd`. Everything is made from what the runs have stored.

    Args:
        folder: Where `groove.ensemble` kept its runs.

    Returns:
        Path of the page.

    Raises:
        SceneError: No such folder, or no run in it that has an end.
    """
    path = Path(folder)
    kept = Folder(path) if path.is_dir() else None
    runs = kept.runs() if kept is not None else ()
    if kept is None or not any(run.failed is None for run in runs):
        raise SceneError(_nothing(path, len(runs)), field="folder")
    # Pictures take a second to load, which no other command should wait for.
    from dolfinrod.groove.page.paraview import write_paraview
    from dolfinrod.groove.page.show import Show
    from dolfinrod.groove.page.tables import write_tables
    from dolfinrod.groove.page.three import write_three
    from dolfinrod.groove.page.web import write_page

    show = Show.of(kept, runs)
    write_tables(show, path / "data")
    write_paraview(show, path / "paraview")
    write_three(show, path / "three.html")
    return write_page(show, path / "index.html")


def _nothing(path: Path, failed: int) -> str:
    """Why there is nothing to report, and what to do."""
    if not path.is_dir():
        return f"must be a folder of runs, got {path}, which does not exist"
    if failed:
        return f"must hold a run that has an end, got {failed} in {path} that all failed: their .json files say why"
    return f"must hold finished runs, got none in {path}: run `dolfinrod groove` or `groove.ensemble` first"
