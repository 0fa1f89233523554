"""Whole processes from nothing: what a user waits for who solves one scene, and where it goes."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage

import numpy as np

from dolfinrod.scene import toml
from verification.case import UPRIGHT
from verification.cases import elastica

__all__ = ["PROCESSES", "SECONDS", "Cold", "cold"]

# For a cantilever with forms that are compiled already, by the clock [s].
SECONDS = 1.5
# Words, program, and whether it runs a scene, which makes or loads forms.
PROCESSES = (
    ("Python alone", ("-c", "pass"), False),
    ("import numpy, scipy.linalg", ("-c", "import numpy, scipy.linalg"), False),
    ("import dolfinrod", ("-c", "import dolfinrod"), False),
    ("import dolfinx, petsc4py", ("-c", "import dolfinx.fem, petsc4py.PETSc"), False),
    ("import dolfinrod.continuum", ("-c", "import dolfinrod.continuum"), False),
    ("dolfinrod run, continuum", ("-m", "dolfinrod.cli", "run", "{scene}"), True),
    ("dolfinrod run, discrete", ("-m", "dolfinrod.cli", "run", "{scene}", "--model", "discrete"), False),
)


@dataclass(frozen=True)
class Cold:
    """A process from its start to its end.

    Args:
        words: What it does.
        clock: Least of its runs with compiled forms [s].
        processor: Least time on the processor of those [s].
        compiling: What the first run takes longer, on the processor, with nothing compiled; None: it compiles nothing
            or was not asked [s].
        limit: Seconds it should take at most, by the clock; None: none [s].
        failure: Why it ended early; empty: it did not.
    """

    words: str
    clock: float
    processor: float
    compiling: float | None = None
    limit: float | None = None
    failure: str = ""

    @property
    def holds(self) -> bool:
        """Whether it ran to its end: time never decides."""
        return not self.failure

    @property
    def within(self) -> bool:
        """Within the limit; on a busy machine that says little."""
        return self.holds and (self.limit is None or self.clock <= self.limit)


def cold(which: int, repeats: int, *, compiling: bool) -> Cold:
    """Run a process a few times.

    Args:
        which: Of `PROCESSES`.
        repeats: Of it with compiled forms.
        compiling: Whether to run it with nothing compiled first.
    """
    words, program, runs = PROCESSES[which]
    with tempfile.TemporaryDirectory() as folder:
        scene, home = Path(folder) / "scene.toml", Path(folder) / "cache"
        scene.write_text(toml.dumps(elastica.shear_rigid(10.0, 200.0).scene(UPRIGHT), {}), encoding="utf-8")
        called = [sys.executable, *(word.format(scene=scene) for word in program)]
        env = dict(os.environ)
        try:
            first = _timed(called, env | {"XDG_CACHE_HOME": str(home)} if compiling and runs else env)
            timed = np.array([_timed(called, env) for _ in range(repeats)])
        except subprocess.SubprocessError as error:
            said = getattr(error, "stderr", None) or str(error)
            return Cold(words, np.nan, np.nan, failure=str(said).strip().splitlines()[-1])
    clock, processor = timed.min(axis=0).tolist()
    more = first[1] - processor if compiling and runs else None
    return Cold(words, clock, processor, more, SECONDS if runs else None)


def _timed(called: Sequence[str], env: Mapping[str, str]) -> tuple[float, float]:
    """Seconds by the clock and on the processor, compilers that it calls included."""
    root = str(Path(__file__).parents[1])
    path = os.pathsep.join([root, env.get("PYTHONPATH", "")])
    before, began = getrusage(RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(called, env={**env, "PYTHONPATH": path}, capture_output=True, text=True, check=True, timeout=600)
    clock, after = time.perf_counter() - began, getrusage(RUSAGE_CHILDREN)
    return clock, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
