"""What every solver asks before it begins."""

from __future__ import annotations

from dolfinrod.scene.balance import pushed_away
from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.mechanism import turned_away
from dolfinrod.scene.motion import Dynamic
from dolfinrod.scene.scene import Scene

__all__ = ["admit"]


def admit(scene: object, start: object, earlier: type) -> None:
    """Let in what a solver can begin with; in a Dynamic motion rods may be free, as their mass resists every push.

    Rods that may touch something may be free as well: whether that holds them, the solver finds out.

    Args:
        scene: What is to be solved.
        start: Where to begin; None: stress free.
        earlier: The record of an earlier solve, one of which `start` must be.

    Raises:
        SceneError: No scene, no such record, or a Static scene that provably has no equilibrium.
    """
    if not isinstance(scene, Scene):
        raise SceneError(f"must be a Scene, got {quoted(scene)}", field="scene")
    if start is not None and not isinstance(start, earlier):
        raise SceneError(f"must be a {earlier.__name__} or None, got {quoted(start)}", field="start")
    if isinstance(scene.motion, Dynamic):
        return
    pushed = (*pushed_away(scene), *turned_away(scene))
    if pushed:
        raise SceneError(f"must hold the rods, or loads balance: {'; '.join(pushed)}", field="supports")
