"""How long a motion is watched: one whose steps fail more often than they succeed is stopped."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Dynamic

__all__ = ["CRAWLS", "Patience"]

CRAWLS = "stopped: more attempts have failed than steps were asked for"
# Failed attempts that a short motion may have, too.
LEAST = 20


class Patience:
    """To be called with every step, as `progress` of either solver.

    Args:
        motion: With steps of a given length.

    Attributes:
        over: Whether the motion was stopped.
    """

    def __init__(self, motion: Dynamic) -> None:
        assert motion.dt is not None
        self._most = max(LEAST, motion.t_end / motion.dt)
        self._failed = 0
        self.over = False

    def __call__(self, row: StepLog, t_end: float) -> None:
        """Count the failed attempts.

        Raises:
            KeyboardInterrupt: There were too many; the solver answers with what it has reached.
        """
        self._failed += row.cuts
        if self._failed > self._most:
            self.over = True
            raise KeyboardInterrupt
