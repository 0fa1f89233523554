"""`python -m verification`: solve, measure, report.

Exit codes: 0 every error, order and iteration count is within its limit, 1 one is not; time never decides.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the verification and write the report.

    Args:
        arguments: Of the command line; None: the process's own.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(prog="python -m verification", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer meshes and repetitions")
    parser.add_argument("--out", type=Path, default=Path("report"), metavar="DIR", help="default: %(default)s")
    options = parser.parse_args(arguments)
    # One thread, settled before NumPy loads: the systems are small, and times have to mean something.
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    from verification.report import write
    from verification.suite import run

    report = run(quick=options.quick, note=note)
    page = write(report, options.out)
    note("")
    for row in report.missed:
        print(f"missed: {row}", file=sys.stderr)
    print(page.resolve())
    return 1 if report.missed else 0


def note(text: str) -> None:
    """One line of a terminal, rewritten; nothing where no terminal is."""
    if sys.stderr.isatty():
        width = shutil.get_terminal_size().columns - 1
        print(f"\r\033[K{text[:width]}", end="", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
