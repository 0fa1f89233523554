"""Ctrl-C that cannot get lost: a solver may take it for a solve that failed, or answer with what it has reached."""

from __future__ import annotations

import signal
import threading
from types import FrameType, TracebackType

__all__ = ["Interrupt"]


class Interrupt:
    """While it is entered, Ctrl-C raises as ever, and is remembered; only the main thread hears of it."""

    def __init__(self) -> None:
        self.asked = False

    def __enter__(self) -> Interrupt:
        self._hears = threading.current_thread() is threading.main_thread()
        if self._hears:
            self._before = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self._hears:
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
