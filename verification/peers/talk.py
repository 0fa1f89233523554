"""One problem in, answers out: what runs in the interpreter of other people's solvers, never in that of the project.

    .venv-peers/bin/python -m verification.peers.talk < question.json > answers.json

Question: `module` (of an adapter), `package` (as installed), `pose` (what the adapter is to pose), `problem` (numbers),
`settings` (a list), `repeats`, and `budget`, seconds after which there are no more repeats. Answers, one a line as soon
as it is found, in the order of the settings: `version`, `tip` (times, 3) [m], `steps` of the load, and `seconds`:
import, set-up, first solve, quickest solve. Where the solver gives up, `refused` with the reason instead, and `ended`
where that ended the process. Only the standard library is needed here.

A setting with `ladder` is tried with each of these numbers of load steps until the solver has found the equilibrium
twice, that is one whose tip is not farther than `within` from `near`; the quicker of the two numbers is timed. A
setting with `problem` changes these numbers of the problem.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterator
from importlib import import_module
from importlib.metadata import version
from math import dist
from types import TracebackType
from typing import Any, TextIO

__all__ = ["answers", "main"]

# Numbers of load steps that find the equilibrium, of which the quickest counts.
FEWEST = 2
# A solve of so many seconds warms itself up: it is not repeated.
LONG = 1.0
Build = Callable[[dict[str, Any], dict[str, Any]], Callable[[], list[list[float]]]]


def main() -> None:
    """Read the question from standard input, write the answers to standard output."""
    # What a solver prints must not mix with the answers: from here on standard output is standard error.
    channel = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)

    def refuse(kind: type[BaseException], value: BaseException, _: TracebackType | None) -> None:
        """An exception that nobody caught is a reason."""
        tell(channel, refusal(kind.__name__, value) | {"ended": True})

    sys.excepthook = refuse
    for found in answers(json.load(sys.stdin)):
        tell(channel, found)


def tell(channel: TextIO, found: dict[str, Any]) -> None:
    """Write the answer now: some solvers end the process in their own way."""
    channel.write(json.dumps(found) + "\n")
    channel.flush()


def refusal(kind: str, value: BaseException) -> dict[str, Any]:
    """A reason in words."""
    said = " ".join(str(value).split())
    return {"refused": f"{kind}: {said}" if said and kind else said or kind}


def answers(question: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Answer for one setting after the other.

    Args:
        question: As the module says.

    Yields:
        An answer a setting; a refusal where its adapter says that the solver gave up.

    Raises:
        ImportError: The solver is not installed.
        LookupError: The adapter poses no such problem.
    """
    started = time.perf_counter()
    adapter = import_module(question["module"])
    imported = time.perf_counter() - started
    if question["pose"] not in adapter.POSED:
        raise LookupError(f"the adapter of {question['package']} does not pose {question['pose']}")
    build = adapter.POSED[question["pose"]]
    for settings in question["settings"]:
        problem = question["problem"] | settings.get("problem", {})
        try:
            taken = settings | settled(build, problem, settings)
            found = timed(build, problem, taken, (question["repeats"], question["budget"]))
        except ArithmeticError as failed:
            yield refusal("", failed)
            continue
        found["seconds"]["import"] = imported
        yield {"version": version(question["package"]), "steps": taken.get("steps")} | found


def settled(build: Build, problem: dict[str, Any], settings: dict[str, Any]) -> dict[str, int]:
    """The quicker of the two fewest numbers of load steps of a ladder; nothing where there is no ladder.

    Raises:
        ArithmeticError: None of them finds the equilibrium.
    """
    if "ladder" not in settings:
        return {}
    reason, spent = "", list[tuple[float, int]]()
    for steps in settings["ladder"]:
        solve = build(problem, settings | {"steps": steps})
        started = time.perf_counter()
        try:
            tip = solve()[-1]
        except ArithmeticError as failed:
            reason = str(failed)
            continue
        spent.append((time.perf_counter() - started, steps))
        if dist(tip, settings["near"]) > settings["within"]:
            reason = f"the tip ends {dist(tip, settings['near']):.2g} m from where it should"
            spent.pop()
        if len(spent) == FEWEST:
            break
    if not spent:
        tried = ", ".join(str(steps) for steps in settings["ladder"])
        raise ArithmeticError(f"not in {tried} load steps; in the last, {reason}")
    return {"steps": min(spent)[1]}


def timed(build: Build, problem: dict[str, Any], settings: dict[str, Any], effort: tuple[int, float]) -> dict[str, Any]:
    """Pose the problem anew for every repeat; build and solve are timed apart."""
    setups: list[float] = []
    solves: list[float] = []
    tip: list[list[float]] = []
    repeats, budget = effort
    until = time.perf_counter() + budget
    while len(solves) < (repeats if not solves or solves[0] < LONG else 1) and (
        len(solves) < min(2, repeats) or time.perf_counter() < until
    ):
        started = time.perf_counter()
        solve = build(problem, settings)
        ready = time.perf_counter()
        tip = solve()
        solves.append(time.perf_counter() - ready)
        setups.append(ready - started)
    return {"tip": tip, "seconds": {"setup": min(setups), "first": solves[0], "solve": min(solves)}}


if __name__ == "__main__":
    main()
