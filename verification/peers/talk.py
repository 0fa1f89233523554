"""One problem in, one answer out: what runs in the interpreter of other people's solvers, never in that of the project.

    .venv-peers/bin/python -m verification.peers.talk < question.json > answer.json

Question: `module` (of an adapter), `package` (as installed), `problem` (name, numbers), `settings`, `repeats`. Answer:
`version`, `tip` (times, 3) [m], and `seconds`: import, set-up, first solve, quickest solve. Where the solver gives up,
`refused` with the reason instead. Only the standard library is needed here.
"""

from __future__ import annotations

import json
import os
import sys
import time
from importlib import import_module
from importlib.metadata import version
from types import TracebackType
from typing import Any, TextIO

__all__ = ["answer", "main"]

# Repeats of a solve end after so many seconds.
BUDGET = 2.0


def main() -> None:
    """Read the question from standard input, write the answer to standard output."""
    # What a solver prints must not mix with the answer: from here on standard output is standard error.
    channel = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)

    def refuse(kind: type[BaseException], value: BaseException, _: TracebackType | None) -> None:
        """An exception that nobody caught is a reason."""
        said = " ".join(str(value).split())
        tell(channel, {"refused": f"{kind.__name__}: {said}" if said else kind.__name__})

    sys.excepthook = refuse
    tell(channel, answer(json.load(sys.stdin)))


def tell(channel: TextIO, found: dict[str, Any]) -> None:
    """Write the answer now: some solvers end the process in their own way."""
    json.dump(found, channel)
    channel.flush()


def answer(question: dict[str, Any]) -> dict[str, Any]:
    """Pose the problem anew for every repeat; build and solve are timed apart.

    Args:
        question: As the module says.

    Returns:
        The answer.

    Raises:
        ImportError: The solver is not installed.
        LookupError: The adapter poses no problem of that name.
    """
    started = time.perf_counter()
    adapter = import_module(question["module"])
    imported = time.perf_counter() - started
    problem, settings = question["problem"], question["settings"]
    if problem["name"] not in adapter.POSED:
        raise LookupError(f"the adapter of {question['package']} does not pose {problem['name']}")
    build = adapter.POSED[problem["name"]]
    setups: list[float] = []
    solves: list[float] = []
    tip: list[list[float]] = []
    until = time.perf_counter() + BUDGET
    while len(solves) < question["repeats"] and (len(solves) < 2 or time.perf_counter() < until):
        started = time.perf_counter()
        solve = build(problem, settings)
        ready = time.perf_counter()
        tip = solve()
        solves.append(time.perf_counter() - ready)
        setups.append(ready - started)
    seconds = {"import": imported, "setup": min(setups), "first": solves[0], "solve": min(solves)}
    return {"version": version(question["package"]), "tip": tip, "seconds": seconds}


if __name__ == "__main__":
    main()
