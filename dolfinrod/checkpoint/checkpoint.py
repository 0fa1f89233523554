"""A run's file: found where the run goes on, written now and then while it does."""

from __future__ import annotations

import os
import time
import warnings
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from dolfinrod.checkpoint.hdf import read, write
from dolfinrod.checkpoint.identity import compare, identity, origin
from dolfinrod.checkpoint.kept import Kept
from dolfinrod.checkpoint.patience import patient
from dolfinrod.scene import SceneError
from dolfinrod.scene.errors import quoted
from dolfinrod.versions import versions

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy as np
    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

    Arrays = Mapping[str, NDArray[np.float64]]

__all__ = ["Checkpoint"]

# Time between two writings, and how many times longer it is than the last one took [s].
INTERVAL, SPARING = 60.0, 20.0


class Checkpoint:
    """The file of one run of one model.

    Args:
        path: Of the file.
        scene: What is posed.
        options: Of the model, by name, its own name among them.
        start: What the run begins with; None: stress free.

    Attributes:
        name: Of the file, in words.

    Raises:
        SceneError: No path, or one that cannot be written.
    """

    def __init__(
        self, path: str | os.PathLike[str], scene: Scene, options: Mapping[str, object], start: Result | None
    ) -> None:
        if not isinstance(path, str | os.PathLike):
            raise SceneError(f"must be the path of a file, or None, got {quoted(path)}", field="checkpoint")
        self.name = f"checkpoint {os.fspath(path)}"
        self._scene, self._options = scene, {**options, "start": origin(start)}
        self._t: float | None = None
        self._written, self._took = time.monotonic(), 0.0
        try:
            # A link leads to the file, which is what is to be replaced.
            self._path = Path(path).resolve()
            folder = self._path.parent
            if self._path.is_dir():
                raise SceneError("must be a file, got a folder", field=self.name)
            if not folder.is_dir() or not os.access(folder, os.W_OK):
                raise SceneError(f"cannot be written: {folder} is no folder with permission to write", field=self.name)
        except (OSError, RuntimeError, ValueError) as error:
            if isinstance(error, SceneError):
                raise
            raise SceneError(f"cannot be written: {error}", field=self.name) from None

    def due(self) -> bool:
        """Whether it is time to write: a minute after the last time, later where writing takes long."""
        return time.monotonic() - self._written >= max(INTERVAL, SPARING * self._took)

    def now_and_then(self, t: float, gather: Callable[[], Arrays]) -> None:
        """As `write`, if it is time to."""
        if self.due():
            self.write(t, gather)

    def write(self, t: float, gather: Callable[[], Arrays]) -> None:
        """Keep a run unless it is kept already; where the file cannot be written, a warning: the run is worth more.

        Args:
            t: Time or pseudo-time that it has reached.
            gather: Gives its arrays, "group/name" → values.
        """
        if t == self._t:
            return
        begun = time.monotonic()
        try:
            about, arrays = self._about | {"t": t}, gather()
            with patient():
                write(self._path, about, arrays)
        except OSError as error:
            warnings.warn(f"{self.name} could not be written: {error.strerror or error}", RuntimeWarning, stacklevel=2)
        self._t, self._written = t, time.monotonic()
        self._took = self._written - begun

    @cached_property
    def _about(self) -> dict[str, object]:
        """Of what run the file is, and what computes it."""
        t_end = self._scene.motion.t_end
        same = identity(self._scene, self._options, t_end)
        return {"t_end": t_end, "identity": same, "versions": versions()}

    def read(self) -> Kept | None:
        """What the file holds, of this very run; None where there is no file.

        Raises:
            SceneError: It is damaged, of another kind, or of another scene or model.
        """
        try:
            with patient():
                about, arrays = read(self._path)
        except FileNotFoundError:
            return None
        except OSError as error:
            raise SceneError(f"cannot be read: {error.strerror or error}", field=self.name) from None
        except SceneError as error:
            raise SceneError(str(error), field=self.name) from None
        t, t_end, kept = (about.get(key) if isinstance(about, dict) else None for key in ("t", "t_end", "identity"))
        if not (isinstance(t, float) and isinstance(t_end, float) and isinstance(kept, dict) and 0.0 <= t <= t_end):
            raise SceneError("must say of what scene it is", field=self.name)
        own_end = self._scene.motion.t_end
        if own_end < t_end:
            raise SceneError(f"must be of no longer a run, but t_end was {t_end} and is {own_end}", field=self.name)
        try:
            compare(kept, identity(self._scene, self._options, t_end))
        except SceneError as error:
            raise SceneError(str(error), field=self.name) from None
        self._t = t
        return Kept(self.name, t, arrays)
