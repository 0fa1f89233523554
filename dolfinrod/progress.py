"""How far a solve has come, on one line of a terminal."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from dolfinrod.result import StepLog

__all__ = ["ProgressLine", "duration"]

# Seconds for which a line stands at least.
LEGIBLE = 0.1


class ProgressLine:
    """A line that tells accepted steps, load or time, iterations, and time left; nothing where no terminal is.

    The time left assumes that the rest of the way costs as much as the part behind. Steps that follow one another
    faster than an eye reads are counted but not shown.

    Args:
        stream: Where to write, such as `sys.stderr`.
        name: What is being solved.
        unit: Of the time; empty where it is the pseudo-time of a static solve.
        clock: Seconds since some fixed moment.
    """

    def __init__(
        self, stream: TextIO, *, name: str, unit: str = "", clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._stream = stream
        self._name = name
        self._unit = f" {unit}".rstrip()
        self._clock = clock
        self._start = clock()
        self._shown = -inf
        self._steps = 0
        self._iterations = 0
        if stream.isatty():
            self._show(f"{name}: setting up")

    def __call__(self, step: StepLog, t_end: float) -> None:
        """Show one more accepted step.

        Args:
            step: Its log.
            t_end: Pseudo-time or time at which the solve ends.
        """
        self._steps += 1
        self._iterations += step.iterations
        if not self._stream.isatty():
            return
        now = self._clock()
        if now - self._shown < LEGIBLE:
            return
        self._shown = now
        left = (now - self._start) * (t_end - step.t) / step.t
        self._show(
            f"{self._name}: step {self._steps}, t = {step.t:.4g} of {t_end:.4g}{self._unit} ({step.t / t_end:.0%}), "
            f"{self._iterations} iterations, about {duration(left)} left"
        )

    def clear(self) -> None:
        """Leave the line empty for what comes next."""
        if self._stream.isatty():
            self._show("")

    def _show(self, text: str) -> None:
        width = shutil.get_terminal_size().columns - 1
        self._stream.write(f"\r\033[K{text[:width]}")
        self._stream.flush()


def duration(seconds: float) -> str:
    """Seconds in the form 7 s, 1:07 min or 1:07:07 h."""
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours}:{minutes:02d}:{seconds:02d} h"
    return f"{minutes}:{seconds:02d} min" if minutes else f"{seconds} s"
