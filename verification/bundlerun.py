"""One bundle in a process of its own, whose memory is that of nothing else; says what it took as a line of JSON.

python -m verification.bundlerun MODEL ELEMENTS DEGREE FIBRES STEPS
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from time import perf_counter, process_time
from typing import TYPE_CHECKING, Any, Self

from dolfinrod.scene import Spatial
from verification.bundlescene import bundle

if TYPE_CHECKING:
    from dolfinrod.result import Result, StepLog

__all__ = ["Watch", "main", "memory"]

# Methods by what they do: of the law both models share, and of the solvers.
PARTS = {
    "law": (
        ("dolfinrod.scene.meeting.meeting", "Meeting", "place begin respond gradient pierces accept stored recall met"),
    ),
    "continuum": (("dolfinrod.continuum.coupled", "CoupledLU", "setUp apply"),),
    "discrete": (("discrete.factors", "Workshop", "found"),),
}


class Watch:
    """Seconds on the processor by what they are spent on; what one asks of another counts as the other's.

    Attributes:
        seconds: By name [s].
    """

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._running: list[str] = []
        self._replaced: list[tuple[Any, str, Any]] = []
        self._since = process_time()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Count no more."""
        for owner, method, call in reversed(self._replaced):
            setattr(owner, method, call)

    def time(self, name: str, module: str, kind: str, methods: str) -> None:
        """Let calls of methods of a class count under a name from now on."""
        owner = getattr(import_module(module), kind)
        self.seconds.setdefault(name, 0.0)
        for method in methods.split():
            call = getattr(owner, method)
            self._replaced.append((owner, method, call))
            setattr(owner, method, self._timed(name, call))

    def _timed(self, name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def timed(*args: Any, **options: Any) -> Any:
            self._turn()
            self._running.append(name)
            try:
                return call(*args, **options)
            finally:
                self._turn()
                self._running.pop()

        return timed

    def _turn(self) -> None:
        """Book what has passed."""
        now = process_time()
        if self._running:
            self.seconds[self._running[-1]] += now - self._since
        self._since = now


def main(model: str, elements: int, degree: int, fibres: int, steps: int) -> None:
    """Solve, and print."""
    watch, tried = Watch(), list[int]()
    solve = import_module("discrete" if model == "discrete" else "dolfinrod.continuum").solve
    for name, parts in (("law", PARTS["law"]), ("solver", PARTS[model])):
        for part in parts:
            watch.time(name, *part)
    options: dict[str, Any] = {"elements": elements}
    if model == "continuum":
        options |= {"degree": degree, "kinematics": Spatial()}
    scene = bundle(fibres, steps)

    def progress(row: StepLog, _: float) -> None:
        tried.append(row.cuts)

    before, began, clock = memory(), process_time(), perf_counter()
    result: Result = solve(scene, progress=progress, **options)
    told = {
        "steps": result.statistics.load_steps,
        "cuts": sum(tried),
        "iterations": result.statistics.newton_iterations,
        "factorizations": result.statistics.factorizations,
        "spots": len(result.meetings[0].times[-1].s_a),
        "seconds": process_time() - began,
        **watch.seconds,
        "memory": memory() - before,
        "clock": perf_counter() - clock,
        "x": [rod.r[-1].tolist() for rod in result.rods],
    }
    # All ranks have the same answer; one says it.
    if os.environ.get("OMPI_COMM_WORLD_RANK", "0") == "0":
        sys.stdout.write(json.dumps(told) + "\n")


def memory() -> float:
    """Largest so far [MB]; that of `resource` would begin with what the caller had."""
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    return float(status.split("VmHWM:")[1].split()[0]) / 1e3


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:6]))
