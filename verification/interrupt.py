"""Ctrl-C that cannot get lost: what is raised within a callback of PETSc may be taken for a solve that failed."""

from __future__ import annotations

import signal
from types import FrameType, TracebackType

__all__ = ["Interrupt"]


class Interrupt:
    """While it is entered, Ctrl-C raises as ever, and is remembered."""

    def __init__(self) -> None:
        self.asked = False

    def __enter__(self) -> Interrupt:
        self._before = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        signal.signal(signal.SIGINT, self._before)

    def check(self) -> None:
        """Raise what may have been swallowed.

        Raises:
            KeyboardInterrupt: It was asked for.
        """
        if self.asked:
            raise KeyboardInterrupt

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.asked = True
        raise KeyboardInterrupt
