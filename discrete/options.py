"""What `discrete.solve` leaves a choice in, and the law of the elements that is chosen."""

from __future__ import annotations

from typing import TYPE_CHECKING

from discrete.corotation import ChordElement
from discrete.nodeframe import EnergyNodeElement, PaperElement
from dolfinrod.scene import Dynamic, SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from discrete.constitution import Element
    from discrete.mesh import Elements
    from dolfinrod.scene import Scene

__all__ = ["check", "law", "law_in_time"]

# The two ways that each option knows, the usual one first.
OPTIONS = {
    "axial": ("chord", "paper"),
    "frame": ("element", "node_i"),
    "rotation": ("exponential", "added"),
    "end_mass": ("half", "paper"),
}


def check(chosen: Mapping[str, str], scene: Scene, *, equilibrium: bool, start: object, checkpoint: object) -> None:
    """Options that the model knows.

    Args:
        chosen: Way of each option.
        scene: The problem.
        equilibrium: Whether to iterate to equilibrium.
        start: An earlier result, or None.
        checkpoint: A file, or None.

    Raises:
        SceneError: One that it does not know.
    """
    for name, (usual, other) in OPTIONS.items():
        if chosen[name] not in (usual, other):
            raise SceneError(f'{name} must be "{usual}" or "{other}", got {chosen[name]!r}')
    if equilibrium:
        return
    if isinstance(scene.motion, Dynamic):
        raise SceneError("equilibrium must be True in a Dynamic motion: its steps are fully implicit")
    if scene.contacts:
        raise SceneError(
            "equilibrium must be True where rods touch surfaces: nothing is iterated, not even who touches"
        )
    for name, value in (("start", start), ("checkpoint", checkpoint)):
        if value is not None:
            raise SceneError(f"{name} must be None where equilibrium is False: end forces carried along are not kept")


def law(elements: Elements, axial: str, frame: str) -> Element:
    """Law of the elements in equilibrium."""
    if frame == "element":
        return ChordElement(elements, paper_strain=axial == "paper")
    return PaperElement(elements) if axial == "paper" else EnergyNodeElement(elements)


def law_in_time(elements: Elements, chosen: Mapping[str, str]) -> Element:
    """The same law, faster where there is a faster way to work it out."""
    if chosen["frame"] == "element":
        return ChordElement(elements, paper_strain=chosen["axial"] == "paper")
    return law(elements, chosen["axial"], chosen["frame"])
