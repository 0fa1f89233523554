"""How far an ensemble is: which runs have ended, where the one at hand is, how long the rest will take."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import TYPE_CHECKING

from dolfinrod.groove.scenario import Scenario

if TYPE_CHECKING:
    from dolfinrod.groove.runs import Folder, Run
    from dolfinrod.result import StepLog

__all__ = ["Clock", "Job", "Progress"]

# Seconds between two looks at the folder while steps follow one another quickly.
LEGIBLE = 0.1


@dataclass(frozen=True)
class Job:
    """A run to do.

    Args:
        scenario: What to solve.
        model: By which model.
    """

    scenario: Scenario
    model: str

    @property
    def cost(self) -> float:
        """What it costs beside others, without unit: unknowns times steps."""
        return self.scenario.fibres * self.scenario.elements * self.scenario.t_end / self.scenario.dt


@dataclass(frozen=True)
class Progress:
    """How far an ensemble is.

    Args:
        done: Finished runs of all ranks, failed ones and earlier ones included.
        failed: Of them.
        total: Of all.
        seconds: Since this session began [s].
        left: Until the last is finished, if the rest goes on like this [s]; None: nothing was solved in this session.
        ended: Runs of any rank that have ended since this was told last.
        doing: The run that this rank is at; None: none.
        t: Time that it has reached [s].
    """

    done: int
    failed: int
    total: int
    seconds: float
    left: float | None
    ended: tuple[Run, ...] = ()
    doing: Job | None = None
    t: float = 0.0


class Clock:
    """Tells how far all ranks are.

    Args:
        kept: Where finished runs appear.
        asked: All runs by their keys.
        ranks: That share them.
        progress: Called with what is known; None: nothing is told.
    """

    def __init__(
        self, kept: Folder, asked: Mapping[str, Job], ranks: int, progress: Callable[[Progress], None] | None
    ) -> None:
        self._kept, self._asked, self._ranks, self._progress = kept, asked, ranks, progress
        self._runs: dict[str, Run] = {}
        self._look()
        self._begun = self._told = time.monotonic()
        self._before = frozenset(self._runs)
        self._doing: Job | None = None
        self._share = 0.0

    def __enter__(self) -> None:
        """The work begins."""

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Ctrl-C may come when a run is written and nothing has been told of it."""
        if isinstance(error, KeyboardInterrupt):
            self.tell()

    def begin(self, job: Job) -> None:
        """This rank begins a run."""
        self._doing, self._share = job, 0.0
        self.tell()

    def step(self, log: StepLog, t_end: float) -> None:
        """A step of it is taken; told no faster than it can be read."""
        self._share = log.t / t_end
        if time.monotonic() - self._told >= LEGIBLE:
            self.tell()

    def end(self) -> None:
        """It is written."""
        self._doing, self._share = None, 0.0
        self.tell()

    def tell(self) -> None:
        """Call back with what the folder holds by now."""
        if self._progress is None:
            return
        ended = self._look()
        self._told = time.monotonic()
        seconds = self._told - self._begun
        failed = sum(run.failed is not None for run in self._runs.values())
        t = 0.0 if self._doing is None else self._share * self._doing.scenario.t_end
        told = (len(self._runs), failed, len(self._asked), seconds, self._left(seconds), ended, self._doing, t)
        self._progress(Progress(*told))

    def _look(self) -> tuple[Run, ...]:
        """Runs that have appeared since the last look."""
        found = {name: run for name in self._asked if name not in self._runs and (run := self._kept.read(name))}
        self._runs |= found
        return tuple(found.values())

    def _left(self, seconds: float) -> float | None:
        """Time left at the pace of this session; other ranks are taken to be as far in their runs as this one."""
        cost = {name: job.cost for name, job in self._asked.items() if name not in self._before}
        ended = sum(cost[name] for name in self._runs if name in cost)
        ranks = min(self._ranks, len(self._asked) - len(self._runs))
        begun = 0.0 if self._doing is None else ranks * self._share * self._doing.cost
        solved, all_of_it = ended + begun, sum(cost.values())
        return max(0.0, seconds * (all_of_it / solved - 1.0)) if solved > 0.0 else None
