"""The file that a run on all ranks is kept in: read and written by the first."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import numpy as np

from dolfinrod.checkpoint import Checkpoint, Kept
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Mapping

    from mpi4py import MPI

    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

    T = TypeVar("T")
    Arrays = dict[str, NDArray[np.float64]]

__all__ = ["Keeper", "onward"]


def onward(keeper: Keeper | None) -> str:
    """How an interrupted run goes on."""
    way = "dolfinrod.solve(scene, start=...)" if keeper is None else f"the same run with {keeper.name}"
    return f"`.result` holds what was reached; {way} goes on from there"


def _first(comm: MPI.Comm, ask: Callable[[], T]) -> T | None:
    """What the first rank is told, on that rank; its complaint on all of them."""
    answer, error = None, None
    if comm.rank == 0:
        try:
            answer = ask()
        except SceneError as complaint:
            error = complaint
    error = comm.bcast(error)
    if error is not None:
        raise error
    return answer


def _on_all_ranks(comm: MPI.Comm, kept: Kept | None) -> Kept | None:
    """What the first rank has, on all of them; arrays one by one, for there are limits to what goes at once."""
    told = comm.bcast(None if kept is None else (kept.name, kept.t, [(n, a.shape) for n, a in kept.arrays.items()]))
    if told is None or comm.size == 1:
        return kept
    name, t, listed = told
    arrays = {n: np.empty(shape) if kept is None else kept.arrays[n] for n, shape in listed}
    for values in arrays.values():
        comm.Bcast(values)
    return Kept(name, t, arrays)


class Keeper:
    """A run's file; all ranks call its methods together.

    Args:
        path: Of the file.
        scene: What is posed.
        options: Of the model, by name.
        start: What the run begins with.
        comm: Communicator.

    Attributes:
        name: Of the file, in words.

    Raises:
        SceneError: No path that could be written.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        scene: Scene,
        options: Mapping[str, object],
        start: Result | None,
        comm: MPI.Comm,
    ) -> None:
        self._comm, self._checkpoint = comm, _first(comm, lambda: Checkpoint(path, scene, options, start))
        self.name, self._written = f"checkpoint {path!s}", -1.0

    def read(self) -> Kept | None:
        """What the file holds; None where there is no file.

        Raises:
            SceneError: It is damaged or of something else.
        """
        file = self._checkpoint
        kept = _on_all_ranks(self._comm, _first(self._comm, lambda: None if file is None else file.read()))
        self._written = -1.0 if kept is None else kept.t
        return kept

    def now_and_then(self, t: float, gather: Callable[[], Arrays]) -> None:
        """Keep the run if it is time to, by the clock of the first rank."""
        due = self._checkpoint is not None and self._checkpoint.due()
        if self._comm.bcast(due) if self._comm.size > 1 else due:
            self.write(t, gather)

    def write(self, t: float, gather: Callable[[], Arrays]) -> None:
        """Keep the run, unless it is kept already.

        Args:
            t: Time or pseudo-time that it has reached.
            gather: Gives its arrays, "group/name" → values, the same on all ranks.
        """
        if t == self._written:
            return
        arrays, self._written = gather(), t
        if self._checkpoint is not None:
            self._checkpoint.write(t, lambda: arrays)
