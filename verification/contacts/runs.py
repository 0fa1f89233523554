"""Models at work on contact cases, on ever more elements or against ever stiffer walls, and what is read off."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Planar, PointForce, Scene, Section, Spatial
from verification.contactcase import ContactRun
from verification.models import Continuum, Discrete, Model

if TYPE_CHECKING:
    from dolfinrod.result import Result, RodHistory, Touching
    from verification.case import Array

__all__ = [
    "ACROSS",
    "DISCRETE",
    "PLANE",
    "RADIUS",
    "SPACE",
    "THIN",
    "angle",
    "force",
    "marks",
    "moment",
    "on_meshes",
    "pressed",
    "rod",
    "stiffer",
    "touch",
]

RADIUS = 0.01
# EI = 1 and nothing else that bends or stretches: what the boundary-value problems are about.
THIN = Section(EI=1.0, GJ=1.0 / 1.3, radius=RADIUS, rigid={"shear", "extension"})
PLANE, SPACE, DISCRETE = Continuum(3, Planar()), Continuum(3, Spatial()), Discrete()
ACROSS = Continuum(4, Planar())


def on_meshes(
    model: Model,
    scene: Scene,
    levels: tuple[int, ...],
    *,
    limit: float | None = None,
    order: float | None = None,
    words: str = "",
    quick: bool = False,
) -> ContactRun:
    """A scene on more and more elements a rod.

    Args:
        model: That solves it.
        scene: The problem.
        levels: Numbers of elements, ascending.
        limit: Largest error allowed on the last.
        order: Least order between the last two.
        words: What else there is to say.
        quick: Whether a quick report takes it.
    """
    solve = partial(model.solve, scene)
    return ContactRun(model.family, _label(model, words), solve, levels, "elements", limit, order, quick)


def stiffer(
    model: Model,
    scene: Callable[[float], Scene],
    elements: int,
    levels: tuple[int, ...],
    *,
    limit: float | None = None,
    order: float | None = None,
    quick: bool = False,
) -> ContactRun:
    """A scene on one mesh against walls of more and more stiffness.

    Args:
        model: That solves it.
        scene: The problem at a stiffness ε_N [N/m²].
        elements: Of the rod.
        levels: Stiffnesses, ascending [N/m²].
        limit: Largest error allowed on the last.
        order: Least power of ε_N with which errors fall between the last two.
        quick: Whether a quick report takes it.
    """

    def solve(eps_N: int) -> Result:
        return model.solve(scene(float(eps_N)), elements)

    label = _label(model, f"{elements} elements")
    return ContactRun(model.family, label, solve, levels, "N/m² of ε_N", limit, order, quick)


def _label(model: Model, words: str) -> str:
    own = f"P{model.degree} {model.kinematics_name}" if model.family == "continuum" else model.name
    return ", ".join(filter(None, (own, words)))


def marks(places: Sequence[float]) -> list[PointForce]:
    """Loads of nothing at arc lengths, so that nodes lie there [m]."""
    return [PointForce((0.0, 0.0, 0.0), at=s) for s in places]


def rod(result: Result) -> RodHistory:
    """The only one."""
    return result.rods[0]


def force(result: Result, node: int) -> Array:
    """n in space at a node [N]."""
    return np.asarray(rod(result).frames[-1, node] @ rod(result).n[-1, node])


def moment(result: Result, node: int) -> Array:
    """m in space at a node [N m]."""
    return np.asarray(rod(result).frames[-1, node] @ rod(result).m[-1, node])


def angle(result: Result, node: int) -> float:
    """θ of a section in the plane xy [rad]."""
    return float(np.arctan2(rod(result).frames[-1, node, 1, 0], rod(result).frames[-1, node, 0, 0]))


def touch(result: Result, contact: int = 0) -> Touching:
    """What the only rod feels of a contact."""
    found = result.contacts[contact].rods[0]
    assert found is not None
    return found


def pressed(result: Result, contact: int = 0) -> float:
    """∫ p ds, whatever the direction of the normal [N]."""
    one = touch(result, contact)
    return float(one.share @ one.pressure[-1])
