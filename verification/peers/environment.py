"""Where other people's solvers live: an interpreter of their own, made by `./run peers`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

__all__ = ["ABSENT", "ROOT", "Environment", "installed"]

ROOT = Path(__file__).parents[2]
ABSENT = "not installed: ./run peers makes their environment"


@dataclass(frozen=True)
class Environment:
    """An interpreter with solvers.

    Args:
        python: Path of the interpreter.
        stamp: What it was made from, as `./run peers` notes it.
    """

    python: Path
    stamp: str


def installed(folder: Path = ROOT / ".venv-peers") -> Environment | None:
    """The environment that `./run peers` made; None where there is none, or none that was finished.

    Args:
        folder: Of the environment.
    """
    python, stamp = folder / "bin" / "python", folder / "stamp"
    if not (python.exists() and stamp.exists()):
        return None
    return Environment(python, stamp.read_text(encoding="utf-8").strip())
