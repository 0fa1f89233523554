"""The nodes of a rank that one surface may touch."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from dolfinrod.scene import Touch
    from dolfinrod.scene.reply import Reply

__all__ = ["Side"]


class Side:
    """One contact of the scene and the nodes of this rank that may touch it.

    Args:
        touch: Their points.
        nodes: Numbers among the rank's own nodes.
        share: Length of rod for which each stands [m].

    Attributes:
        reply: What the surface did to them last.
    """

    reply: Reply

    def __init__(self, touch: Touch, nodes: NDArray[np.intp], share: NDArray[np.float64]) -> None:
        self.touch, self.nodes, self.share = touch, nodes, share[:, None]
