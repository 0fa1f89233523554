"""Runs of an ensemble in a folder: one record and one file of arrays each, written when it is finished."""

from __future__ import annotations

import json
import os
import shutil
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove.film import Film

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Folder", "Run"]

CLAIMS = ".claims-"
# Records of another format are of no use to who reads these: their runs are done again.
FORMAT = "dolfinrod groove run 2"


@dataclass(frozen=True)
class Run:
    """One finished run.

    Args:
        key: Its name.
        kind: Of groove.
        seed: Of the noise.
        model: That solved it.
        scenario: What was solved, as `described`.
        seconds: Processor time it took [s].
        failed: Why it has no end, in words; None: it has one.
        t: Time that it reached [s].
        T_pair: Twist of the bundle at the end [turns/m].
        T_crossed: By crossings alone, without what the angles at the ends add [turns/m]; None: fibres turn back.
        wound: Pairs of fibres that wind by 0.4 turns or more.
        winding: Turns of each pair.
        edge_crosses: Whether the edge fibre has crossed its neighbour ("5 crosses 4").
        crossings: Seen from above.
        width: Mean extent of the bundle along Z [m].
    """

    key: str
    kind: str
    seed: int
    model: str
    scenario: dict[str, object]
    seconds: float
    failed: str | None
    t: float
    T_pair: float = 0.0
    T_crossed: float | None = 0.0
    wound: int = 0
    winding: tuple[tuple[float, ...], ...] = ()
    edge_crosses: bool = False
    crossings: int = 0
    width: float = 0.0


class Folder:
    """Where runs are kept. Files appear complete or not at all; any number of processes may write.

    Args:
        path: Made where it does not exist.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.path.mkdir(parents=True, exist_ok=True)

    def read(self, key: str) -> Run | None:
        """A finished run; None where it is not finished, or its record is not whole."""
        try:
            table = json.loads((self.path / f"{key}.json").read_text(encoding="utf-8"))
            table["winding"] = tuple(tuple(row) for row in table["winding"])
            run = Run(**{field.name: table[field.name] for field in fields(Run)})
        except (FileNotFoundError, KeyError, TypeError, ValueError):
            return None
        whole = run.failed is not None or (self.path / f"{key}.npz").is_file()
        return run if whole and table.get("format") == FORMAT else None

    def runs(self) -> tuple[Run, ...]:
        """All finished runs, by kind and seed."""
        found = [run for path in sorted(self.path.glob("*.json")) if (run := self.read(path.stem)) is not None]
        return tuple(sorted(found, key=lambda run: (run.kind, run.seed, run.key)))

    def film(self, key: str) -> Film:
        """What a finished run keeps of its result."""
        return Film.of(self.arrays(key))

    def arrays(self, key: str) -> dict[str, Array]:
        """Arrays of a finished run by name, as `filmed` gives them; a failed run has none."""
        with np.load(self.path / f"{key}.npz", allow_pickle=False) as file:
            return {name: file[name] for name in file.files}

    def write(self, run: Run, arrays: Mapping[str, Array]) -> None:
        """Keep a run: its arrays, such as `filmed`, and then the record that says it is finished."""
        part = self.path / f"{run.key}.{os.getpid()}.part"
        with part.open("wb") as file:
            np.savez_compressed(file, **arrays)
        part.replace(self.path / f"{run.key}.npz")
        part.write_text(json.dumps({"format": FORMAT, **asdict(run)}, indent=1), encoding="utf-8")
        part.replace(self.path / f"{run.key}.json")

    def claim(self, session: str, key: str) -> bool:
        """Whether this process is the first of a session to ask for a run: it then is its to do."""
        claims = self.path / f"{CLAIMS}{session}"
        claims.mkdir(exist_ok=True)
        try:
            (claims / key).touch(exist_ok=False)
        except FileExistsError:
            return False
        return True

    def sweep(self) -> None:
        """Leave finished runs only: no claims, no parts of files that an end by force has left."""
        for left in self.path.glob(f"{CLAIMS}*"):
            shutil.rmtree(left)
        for part in self.path.glob("*.part"):
            part.unlink()
