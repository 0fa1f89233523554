"""How far a verification has come, on one line of a terminal."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from verification.ledger import Unit

__all__ = ["Progress"]


class Progress:
    """A line rewritten before every unit: what, k of n, time left; nothing where no terminal is.

    The time left assumes that what is to be done costs as much a unit as what was done; recalled units cost nothing.

    Args:
        stream: Where to write, such as `sys.stderr`.
        total: Number of units.
        clock: Seconds since some fixed moment.
    """

    def __init__(self, stream: TextIO, total: int, *, clock: Callable[[], float] = time.monotonic) -> None:
        self.done = self.recalled = 0
        self._stream = stream
        self._total = total
        self._clock = clock
        self._start = clock()

    def __call__(self, done: int, unit: Unit, recalled: bool) -> None:
        """Show what is begun.

        Args:
            done: Units before it.
            unit: What it is.
            recalled: Whether an earlier run had finished it.
        """
        solved = done - self.recalled
        left = ""
        if solved:
            seconds = (self._clock() - self._start) / solved * (self._total - done)
            left = f", about {words(seconds)} left"
        self.done = done
        self.recalled += recalled
        self._show(f"{done + 1} of {self._total}{left}: {unit.words}")

    def clear(self) -> None:
        """Leave the line empty for what comes next."""
        self._show("")

    def _show(self, text: str) -> None:
        if self._stream.isatty():
            width = shutil.get_terminal_size().columns - 1
            self._stream.write(f"\r\033[K{text[:width]}")
            self._stream.flush()


def words(seconds: float) -> str:
    """Such as 40 s or 3 min."""
    return f"{seconds:.0f} s" if seconds < 100.0 else f"{seconds / 60.0:.0f} min"
