"""Arrays that a run was kept in, handed out only in the shapes that the run has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Kept"]


@dataclass(frozen=True, eq=False)
class Kept:
    """What a checkpoint holds.

    Args:
        name: Of the file, as complaints begin.
        t: Time or pseudo-time that the run had reached.
        arrays: "group/name" → values.
    """

    name: str
    t: float
    arrays: Mapping[str, Array]

    def group(self, name: str) -> dict[str, Array]:
        """All arrays of a group by their own names."""
        start = f"{name}/"
        return {key.removeprefix(start): values for key, values in self.arrays.items() if key.startswith(start)}

    def take(self, name: str, shape: tuple[int, ...]) -> Array:
        """An array of a shape.

        Raises:
            SceneError: There is none.
        """
        found = self.arrays.get(name)
        if found is None or found.shape != shape:
            got = "none" if found is None else f"one of shape {found.shape}"
            raise SceneError(f"must hold an array {name} of shape {shape}, got {got}", field=self.name)
        return found

    def number(self, name: str) -> float:
        """A number."""
        return float(self.take(name, ()))

    def count(self, name: str) -> int:
        """A number of things.

        Raises:
            SceneError: It is none.
        """
        value = self.number(name)
        if value < 0.0 or value != int(value):
            raise SceneError(f"must hold a number of things in {name}, got {value}", field=self.name)
        return int(value)

    def times(self, name: str) -> Array:
        """Ascending times, none later than the run had come.

        Raises:
            SceneError: They are not.
        """
        found = self.arrays.get(name, np.zeros(0))
        if found.ndim != 1 or not len(found) or found[0] < 0.0 or found[-1] > self.t or (np.diff(found) <= 0.0).any():
            raise SceneError(f"must hold ascending times from 0 to {self.t} in {name}", field=self.name)
        return found
