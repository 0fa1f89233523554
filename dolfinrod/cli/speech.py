"""What every command shares: one voice on any number of ranks, and looking before a long solve."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from dolfinrod.scene import SceneError

__all__ = ["check_writable", "complain", "is_first_rank", "ranks", "readable"]


def ranks() -> int:
    """How many processes were started together."""
    from mpi4py import MPI

    return MPI.COMM_WORLD.size


def is_first_rank() -> bool:
    """Whether this is the one that speaks."""
    from mpi4py import MPI

    return MPI.COMM_WORLD.rank == 0


def complain(message: str) -> None:
    """One line on stderr, from one rank; what would steer the terminal is escaped."""
    if is_first_rank():
        line = " ".join(message.split())
        print("dolfinrod:", "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line), file=sys.stderr)


def check_writable(folder: Path | None) -> None:
    """Find out before a long solve, not after it.

    Raises:
        SceneError: Nothing can be written there.
    """
    if folder is None:
        return
    ground = next(place for place in (folder, *folder.absolute().parents) if place.exists())
    if not (ground.is_dir() and os.access(ground, os.W_OK)):
        raise SceneError(f"--out {folder} cannot be written: {ground} is no folder with permission to write")


@contextmanager
def readable(path: Path) -> Iterator[None]:
    """Whatever is wrong with a file that is read meanwhile is told with its name.

    Raises:
        SceneError: It cannot be read, or says what cannot be.
    """
    try:
        yield
    except OSError as error:
        raise SceneError(f"{path} cannot be read: {error.strerror}") from error
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from error
    except ValueError as error:  # no file can have such a name
        raise SceneError(f"{path} cannot be read: {error}") from error
