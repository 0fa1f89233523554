"""A question to the interpreter of other people's solvers: answers, or the reasons why there are none."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.peers.environment import ROOT

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from verification.case import Array

__all__ = ["Answer", "Refused", "ask", "ask_all", "ask_cold"]

# Seconds after which nobody waits any more: PyElastica compiles for a minute when it first runs.
PATIENCE = 300.0
# However many cores there are.
ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"),
    "1",
)
# What an MPI that has begun leaves to its children. OpenSees has another one within, which takes it for its own.
OF_MPI = ("OMPI_", "PMIX_", "PMI_", "ORTE_", "PRTE_", "HYDRA_")


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
        steps: Of the load; None where it has none.
    """

    version: str
    tip: Array
    loading: float
    setup: float
    first: float
    solve: float
    steps: int | None = None


def ask(python: Path, question: Mapping[str, Any], *, patience: float = PATIENCE) -> Answer:
    """Ask for the first setting alone.

    Args:
        python: The interpreter.
        question: As `talk` takes it.
        patience: Seconds to wait [s].

    Returns:
        The answer.

    Raises:
        Refused: The solver gave up, died, took too long, or said what is no answer.
    """
    said = spoken(python, {**question, "settings": question["settings"][:1]}, patience)
    found = heard(said, 1, len(question["problem"]["times"]), patience)[0]
    if isinstance(found, Refused):
        raise found
    return found


def ask_all(python: Path, question: Mapping[str, Any], *, patience: float = PATIENCE) -> tuple[Answer | Refused, ...]:
    """Ask for every setting, in one process as long as it lives; where it dies, the rest are asked in another.

    Args:
        python: The interpreter.
        question: As `talk` takes it.
        patience: Seconds to wait for a process [s].

    Returns:
        Answer or refusal of each setting.
    """
    settings: Sequence[Any] = question["settings"]
    found: list[Answer | Refused] = []
    while len(found) < len(settings):
        rest = settings[len(found) :]
        said = spoken(python, {**question, "settings": rest}, patience)
        found += heard(said, len(rest), len(question["problem"]["times"]), patience)
    return tuple(found)


def ask_cold(python: Path, question: Mapping[str, Any]) -> float:
    """Seconds of a whole process that solves the first setting once [s].

    Raises:
        Refused: It did not.
    """
    started = time.perf_counter()
    ask(python, {**question, "repeats": 1})
    return time.perf_counter() - started


@dataclass(frozen=True)
class Said:
    """What a process said until it ended.

    Args:
        lines: Answers.
        last: Its last words on the other channel.
        code: With which it ended; None where nobody waited any longer.
    """

    lines: tuple[str, ...]
    last: str
    code: int | None


def spoken(python: Path, question: Mapping[str, Any], patience: float) -> Said:
    """Run a process of its own on one thread.

    Raises:
        Refused: It cannot be run.
    """
    command = [str(python), "-m", "verification.peers.talk"]
    left = {name: value for name, value in os.environ.items() if not name.startswith(OF_MPI)}
    surroundings = left | ONE_THREAD | {"PYTHONPATH": str(ROOT), "PYTHONNOUSERSITE": "1"}
    # A folder to run in, because some write logs there; files to read from and write to, because PETSc ends our own
    # process where a pipe breaks, as it does when a child dies early, and because they keep what was said till then.
    with tempfile.TemporaryDirectory() as folder:
        asked, told, aside = (Path(folder) / name for name in ("question.json", "answers.json", "words"))
        asked.write_text(json.dumps(question), encoding="utf-8")
        code = None
        try:
            with asked.open() as given, told.open("w") as out, aside.open("w") as err:
                code = subprocess.run(
                    command,
                    stdin=given,
                    stdout=out,
                    stderr=err,
                    env=surroundings,
                    cwd=folder,
                    timeout=patience,
                    check=False,
                ).returncode
        except subprocess.TimeoutExpired:
            pass
        except OSError as failed:
            raise Refused(f"{python} cannot be run: {failed.strerror}") from None
        words = aside.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-1:]
        lines = told.read_text(encoding="utf-8", errors="replace").splitlines()
    return Said(tuple(lines), words[0].strip() if words else "nothing", code)


def heard(said: Said, settings: int, times: int, patience: float) -> list[Answer | Refused]:
    """Make sense of what was said.

    Args:
        said: By a process that has ended.
        settings: How many answers were asked for.
        times: How many positions each.
        patience: Seconds it was waited for [s].

    Returns:
        Answers as far as there are any, and where they stop, why.
    """
    found: list[Answer | Refused] = []
    for line in said.lines[:settings]:
        try:
            told = json.loads(line)
            found.append(understood(told, times))
        except (ValueError, KeyError, TypeError):
            break
        except Refused as refused:
            found.append(refused)
            if told.get("ended"):
                return found
    if len(found) < settings:
        silent = f"ended with exit code {said.code} and no answer, last words: {said.last}"
        found.append(Refused(silent if said.code is not None else f"no answer within {patience:g} s"))
    return found


def understood(found: dict[str, Any], times: int) -> Answer:
    """One line.

    Raises:
        Refused: It says so, or its positions are none.
    """
    if "refused" in found:
        raise Refused(str(found["refused"]))
    tip, seconds = np.asarray(found["tip"], dtype=float), found["seconds"]
    loading, setup, first, solve = (float(seconds[name]) for name in ("import", "setup", "first", "solve"))
    if tip.shape != (times, 3):
        raise Refused(f"answered positions of shape {tip.shape}, not {(times, 3)}")
    if not np.isfinite(tip).all():
        raise Refused("diverged: the positions are not finite")
    return Answer(str(found["version"]), tip, loading, setup, first, solve, found.get("steps"))
