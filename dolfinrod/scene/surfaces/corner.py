"""Corners that are too sharp for the rods that may lie in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.surfaces.faces import reentrant
from dolfinrod.scene.surfaces.groove import Groove

if TYPE_CHECKING:
    from dolfinrod.scene.surfaces.surface import Surface

__all__ = ["refuse_sharp"]


def refuse_sharp(surface: Surface, radius: float, g_0: float, path: str) -> None:
    """No rod touches both flanks of a corner as one surface, which has one normal at a time.

    Args:
        surface: What is touched.
        radius: Of the rod [m].
        g_0: Gap at which contact begins [m].
        path: Where the surface stands, such as `contacts[0].surface`.

    Raises:
        SceneError: A groove whose re-entrant corners are not wider than the rod and its gap.
    """
    if not isinstance(surface, Groove) or surface.fillet > radius + g_0 or not reentrant(np.asarray(surface.profile)):
        return
    gap = f" at a gap of {g_0!r} m" if g_0 > 0.0 else ""
    message = (
        f"must be above {radius + g_0:.6g} m, since a rod of radius {radius!r} m{gap} touches both flanks of a sharper"
        f" corner, got {surface.fillet!r} m: give Groove(fillet=…), or one Contact for each of its faces()"
    )
    raise SceneError(message, field=f"{path}.fillet")
