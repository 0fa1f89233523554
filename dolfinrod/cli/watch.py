"""How far an ensemble has come: one line on a terminal, or a line a finished run where none is."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING, TextIO

from dolfinrod.progress import duration

if TYPE_CHECKING:
    from dolfinrod.groove import Progress, Run

__all__ = ["Watch"]


class Watch:
    """Tells the run at hand, its time and the time left; runs that fail, wherever it writes.

    Args:
        stream: Where to write, such as `sys.stderr`.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._done = self._total = self._counted = 0
        self._begun = False

    @property
    def told(self) -> str:
        """How many runs are finished, in words."""
        return f"{self._done} of {self._total} runs finished"

    def __call__(self, now: Progress) -> None:
        """Show how far it is."""
        self._done, self._total = now.done, now.total
        if not self._begun:
            self._begin(now)
        for run in now.ended:
            self._counted += 1
            if run.failed is not None or not self._stream.isatty():
                self._line(f"run {self._counted} of {now.total}: {_name(run.kind, run.seed, run.model)}: {_end(run)}")
        if self._stream.isatty() and now.doing is not None:
            self._show(_at_hand(now))

    def clear(self) -> None:
        """Leave the line empty for what comes next."""
        if self._stream.isatty():
            self._show("")

    def _begin(self, now: Progress) -> None:
        """Say what an earlier command has done."""
        self._begun, self._counted = True, now.done
        if now.done:
            self._line(f"{now.done} of {now.total} runs were finished before")

    def _line(self, text: str) -> None:
        self.clear()
        self._stream.write(f"{text}\n")
        self._stream.flush()

    def _show(self, text: str) -> None:
        width = shutil.get_terminal_size().columns - 1
        self._stream.write(f"\r\033[K{text[:width]}")
        self._stream.flush()


def _at_hand(now: Progress) -> str:
    """The run that is being solved here."""
    assert now.doing is not None
    scenario = now.doing.scenario
    left = "" if now.left is None else f", about {duration(now.left)} left"
    name = _name(scenario.kind, scenario.seed, now.doing.model)
    return f"run {now.done + 1} of {now.total}{left}: {name}, t = {1e3 * now.t:.3f} of {1e3 * scenario.t_end:.4g} ms"


def _end(run: Run) -> str:
    """How a run ended."""
    took = f"in {duration(run.seconds)} of processor time"
    if run.failed is not None:
        return f"failed at t = {1e3 * run.t:.4g} ms {took}: {' '.join(run.failed.split())}"
    twist = "" if run.T_crossed is None else f", {run.T_crossed:+.1f} turns/m by crossings"
    return f"finished {took}, {run.wound} wound pairs{twist}"


def _name(kind: str, seed: int, model: str) -> str:
    return f"{kind}, seed {seed}, {model}"
