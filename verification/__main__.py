"""`python -m verification`, the same as `dolfinrod verify`: solve, measure, report.

Exit codes: 0 every number is within its limit, 1 one is not, 2 bad input, 130 interrupted; time never decides.
"""

from __future__ import annotations

import os
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

# NumPy must not be loaded here: `main` settles the number of its threads first.
if TYPE_CHECKING:
    from verification.ledger import Ledger, Row, Unit
    from verification.progress import Progress
    from verification.suite import Missed

__all__ = ["DESCRIPTION", "add_options", "main", "verify"]

HOLDS, MISSED, INTERRUPTED = 0, 1, 130
# Folder of finished work within that of the report.
FINISHED = "finished"
DESCRIPTION = (
    "Solve the verification cases with both models: errors against references, against time, and against each other. "
    "What is finished is kept below DIR, and the same command goes on where it was stopped."
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Args:
        arguments: Words after `python -m verification`; None: those of the process.

    Returns:
        Exit code.
    """
    # One thread, settled before NumPy loads: the systems are small, and times have to mean something.
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    try:
        from dolfinrod import cli

        return cli.main(["verify", *(sys.argv[1:] if arguments is None else arguments)])
    except KeyboardInterrupt:
        say("interrupted before anything was solved")
        return INTERRUPTED


def add_options(parser: ArgumentParser) -> None:
    """Give a parser the options of the command."""
    parser.add_argument("names", nargs="*", metavar="CASE", help="cases or families, wildcards allowed; none: all")
    parser.add_argument("--quick", action="store_true", help="fewer meshes, degrees and repetitions")
    parser.add_argument("--out", type=Path, default=Path("report"), metavar="DIR", help="default: %(default)s")
    parser.add_argument("--fresh", action="store_true", help="do again what an earlier run has finished")
    parser.add_argument("--jobs", type=_jobs, default=1, metavar="N", help="units at once; times are best with 1")
    parser.add_argument(
        "--summary",
        nargs="?",
        type=Path,
        const=Path(__file__).parent,
        metavar="DIR",
        help="also write the verdict as RESULTS.md with its figure; DIR: that of this package unless given",
    )
    parser.add_argument("--list", action="store_true", help="names and titles, nothing is solved")


def _jobs(text: str) -> int:
    """A number of processes."""
    if not (text.isdecimal() and int(text) > 0):
        raise ArgumentTypeError(f"must be a positive whole number, got {text}")
    return int(text)


def verify(options: Namespace) -> int:
    """Solve, measure, report.

    Args:
        options: As `add_options` describes them.

    Returns:
        Exit code.

    Raises:
        SceneError: A name that stands for nothing, or several ranks.
    """
    return listed(options) if options.list else reported(options)


def listed(options: Namespace) -> int:
    """Print the cases by family."""
    from verification.cases import CASES
    from verification.peers import race
    from verification.plan import LAWS, families, selected
    from verification.statement import family_title
    from verification.trials import listing

    names = set(selected(options.names))
    for family in families():
        members = [case for case in CASES if case.family == family and {family, case.name} & names]
        if members:
            print(f"{family}: {family_title(family)}")
        for case in members:
            print(f"  {case.name:<34}{case.title}")
    if LAWS in names:
        print(f"{LAWS}: what holds whatever the numbers are")
    for name, words in (*listing(tuple(names)), *race.listing(tuple(names))):
        print(f"{name:<36}{words}" if name.startswith(" ") else f"{name}: {words}")
    return HOLDS


def reported(options: Namespace) -> int:
    """Do what is not yet done, write the page and print its path."""
    from verification.ledger import Ledger
    from verification.machine import this_machine
    from verification.plan import plan, selected
    from verification.progress import Progress
    from verification.report import summarise, write
    from verification.suite import report
    from verification.workoff import spent

    names = selected(options.names)
    machine = this_machine()
    units = plan(names, quick=options.quick)
    folder = options.out / FINISHED
    progress = Progress(sys.stderr, len(units))
    try:
        ledger = Ledger(folder, machine, fresh=options.fresh)
        rows = _rows(units, ledger, progress, options)
    except KeyboardInterrupt:
        progress.clear()
        finished = f"{progress.done} of {len(units)} finished and kept in {folder}{os.sep}"
        say(f"interrupted: {finished}; the same command goes on from there")
        return INTERRUPTED
    progress.clear()
    if progress.recalled:
        say(f"{progress.recalled} of {len(units)} results reused from {folder}{os.sep} (--fresh solves all again)")
    found = report(rows, names, machine, quick=options.quick)
    found = replace(found, jobs=options.jobs, spent=spent(units, ledger))
    page = write(found, options.out)
    if options.summary is not None:
        say(f"the verdict is in {summarise(found, options.summary, _command(options))}")
    complain(found.missed)
    print(page.resolve())
    return MISSED if found.missed else HOLDS


def _rows(units: Sequence[Unit], ledger: Ledger, progress: Progress, options: Namespace) -> dict[str, tuple[Row, ...]]:
    """Rows of all units by topic; those not yet done are done, several at once where that is asked for and may be."""
    from verification.atonce import at_once
    from verification.interrupt import Interrupt
    from verification.plan import plan, selected
    from verification.workoff import work_off

    with Interrupt() as interrupt:
        if options.jobs == 1:
            return work_off(units, ledger, progress, interrupt)
        again = partial(plan, selected(options.names), quick=options.quick)
        at_once(again, ledger, options.jobs, progress)
        interrupt.check()

        def left(_: int, unit: Unit, recalled: bool) -> None:
            if not recalled:
                progress(progress.done + 1, unit, recalled)

        return work_off(units, ledger, left, interrupt)


def _command(options: Namespace) -> str:
    """As it would be typed again."""
    flags = [name for name, on in (("--quick", options.quick), (f"--jobs {options.jobs}", options.jobs > 1)) if on]
    return " ".join(["dolfinrod verify --summary", *flags, *options.names])


def complain(missed: Iterable[Missed]) -> None:
    """One line for every number beyond its limit."""
    from verification.report.misses import sentence

    for row in missed:
        print(f"missed: {sentence(row)}", file=sys.stderr)


def say(text: str) -> None:
    """One line that is no result."""
    print(f"verification: {text}", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
