"""Units of work on several cores: processes that take the next ones until none is left.

A unit that none of them finishes is left to the caller, who then sees why; so is one that must run alone.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Sequence
from contextlib import suppress
from itertools import groupby
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING

from verification.interrupt import Interrupt

if TYPE_CHECKING:
    from multiprocessing.sharedctypes import Synchronized

    from verification.ledger import Ledger, Unit

__all__ = ["at_once"]


def at_once(
    plan: Callable[[], Sequence[Unit]], ledger: Ledger, jobs: int, note: Callable[[int, Unit, bool], None]
) -> None:
    """Do units that are not yet done, several at once; the ledger has them then.

    Args:
        plan: All of them, the same in every process, to which it is sent by name.
        ledger: Where finished ones are kept.
        jobs: How many at once.
        note: Told, as each unit is finished, how many were before it, the unit, and whether it is recalled.
    """
    # Forked ones would share the MPI that this process has begun.
    context = multiprocessing.get_context("spawn")
    units, taken, workers, readers = plan(), context.Value("i", 0), [], []
    for _ in range(jobs):
        reader, writer = context.Pipe(duplex=False)
        workers.append(context.Process(target=_work, args=(plan, ledger, taken, writer)))
        workers[-1].start()
        writer.close()
        readers.append(reader)
    done = 0
    try:
        while readers:
            ready = wait(readers)
            for reader in [reader for reader in readers if reader in ready]:
                try:
                    k, recalled = reader.recv()
                except EOFError:
                    readers.remove(reader)
                    continue
                note(done, units[k], recalled)
                ledger.trust(units[k])
                done += 1
    finally:
        for worker in workers:
            worker.terminate()
            worker.join()


def _work(plan: Callable[[], Sequence[Unit]], ledger: Ledger, taken: Synchronized[int], writer: Connection) -> None:
    """Take units and keep what they find; Ctrl-C ends it."""
    with suppress(KeyboardInterrupt), Interrupt() as interrupt:
        units = plan()
        several = _in_a_row(units)
        while True:
            with taken.get_lock():
                turn = taken.value
                taken.value += 1
            if turn >= len(several):
                return
            for k in several[turn]:
                rows = ledger.recall(units[k])
                if rows is None and units[k].alone:
                    continue
                if rows is None:
                    ledger.fill(units[k], interrupt)
                writer.send((k, rows is not None))


def _in_a_row(units: Sequence[Unit]) -> list[list[int]]:
    """Places of units that are taken together: those in a row that rest on the same solution, all others singly."""
    names = [unit.rests_on or str(k) for k, unit in enumerate(units)]
    return [list(places) for _, places in groupby(range(len(units)), key=lambda k: names[k])]
