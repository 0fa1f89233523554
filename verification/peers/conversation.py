"""A question to the interpreter of other people's solvers: an answer, or the reason why there is none."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.peers.environment import ROOT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from verification.case import Array

__all__ = ["Answer", "Refused", "ask"]

# Seconds after which nobody waits any more: PyElastica compiles for a minute when it first runs.
PATIENCE = 300.0
# However many cores there are.
ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"),
    "1",
)


class Refused(RuntimeError):  # noqa: N818
    """No answer, with the reason in words."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What a solver found and took.

    Args:
        version: Of its package.
        tip: At the times asked for, shape (times, 3) [m].
        loading: Seconds its import took [s].
        setup: Seconds to pose the problem [s].
        first: Seconds of the first solve, compilation included [s].
        solve: Seconds of the quickest solve [s].
    """

    version: str
    tip: Array
    loading: float
    setup: float
    first: float
    solve: float


def ask(python: Path, question: Mapping[str, Any], *, patience: float = PATIENCE) -> Answer:
    """Ask once, in a process of its own and on one thread.

    Args:
        python: The interpreter.
        question: As `talk` takes it.
        patience: Seconds to wait [s].

    Returns:
        The answer.

    Raises:
        Refused: The solver gave up, died, took too long, or said what is no answer.
    """
    command = [str(python), "-m", "verification.peers.talk"]
    surroundings = os.environ | ONE_THREAD | {"PYTHONPATH": str(ROOT), "PYTHONNOUSERSITE": "1"}
    try:
        # A folder to run in, because some write logs there; a file to read from, because PETSc ends our own process
        # where a pipe breaks, as it does when a child dies early.
        with tempfile.TemporaryDirectory() as folder, (Path(folder) / "question.json").open("w+") as file:
            json.dump(question, file)
            file.seek(0)
            said = subprocess.run(
                command,
                stdin=file,
                capture_output=True,
                text=True,
                errors="replace",
                env=surroundings,
                cwd=folder,
                timeout=patience,
                check=False,
            )
    except subprocess.TimeoutExpired:
        raise Refused(f"no answer within {patience:g} s") from None
    except OSError as failed:
        raise Refused(f"{python} cannot be run: {failed.strerror}") from None
    return heard(said, len(question["problem"]["times"]))


def heard(said: subprocess.CompletedProcess[str], times: int) -> Answer:
    """Make sense of what was said.

    Args:
        said: By a process that has ended.
        times: How many positions were asked for.

    Returns:
        The answer.

    Raises:
        Refused: There is none.
    """
    try:
        found = json.loads(said.stdout)
        if "refused" in found:
            raise Refused(str(found["refused"]))
        tip, seconds = np.asarray(found["tip"], dtype=float), found["seconds"]
        spent = [float(seconds[name]) for name in ("import", "setup", "first", "solve")]
        answer = Answer(str(found["version"]), tip, *spent)
    except (ValueError, KeyError, TypeError):
        last = said.stderr.strip().splitlines()[-1:] or ["nothing"]
        raise Refused(f"ended with exit code {said.returncode} and no answer, last words: {last[0].strip()}") from None
    if tip.shape != (times, 3):
        raise Refused(f"answered positions of shape {tip.shape}, not {(times, 3)}")
    if not np.isfinite(tip).all():
        raise Refused("diverged: the positions are not finite")
    return answer
