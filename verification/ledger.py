"""Finished work kept on disk, so that a verification that was stopped goes on where it was.

One JSON file a unit, written beside its place and moved there whole; until then a folder of those of its runs that have
ended, where it is many. Files lie in a folder named by what all numbers depend on, machine, versions and source, and
are named by the unit's parameters. Whatever of that changes, the unit is done again; what was found by another source
is thrown away.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from math import isfinite
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from verification.bundles import BundleCost, BundleRanks, BundleStudy
from verification.checks import Check
from verification.contact import ContactRecord, ContactStudy
from verification.contactmaps import ContactCell
from verification.drift import DriftStudy
from verification.explicitlimit import ExplicitLimit
from verification.frequency import FrequencyStudy
from verification.groovebench import GroovePoint, GrooveSweep
from verification.groovepaper import PaperRun
from verification.grooveprofile import GrooveProfile, SideBySide
from verification.groovescenario import GrooveEnsemble
from verification.groovescenariobeside import GrooveImage, GrooveModels
from verification.groovescenariosteps import GrooveSteps
from verification.growth import Cost, Growth
from verification.hard import HardRow
from verification.hardcontact import ContactRow
from verification.hardmotion import MotionRow
from verification.laws import LawRow
from verification.machine import Machine
from verification.maps import Cell
from verification.motion import MotionRecord, MotionStudy
from verification.onestep import OneStep
from verification.order import Order
from verification.pace import Pace, PaperFibre
from verification.peers.contest import Attempt, Contender, Measured, Taker
from verification.ranks import RankRow
from verification.references import Peer
from verification.rigid import TopStudy
from verification.robustness import OneStepLoads, Steps
from verification.scaling import EnsembleScaling, Scaling
from verification.shape import Shape
from verification.speed import Speed
from verification.stability import Bracket, EigenStudy
from verification.twist import TwistStudy
from verification.workprecision import Record, Study, Timing

if TYPE_CHECKING:
    from verification.interrupt import Interrupt

__all__ = ["Ledger", "Unit", "source_hash"]

Trial = Bracket | EigenStudy | HardRow | OneStep | OneStepLoads | Steps
Moved = BundleRanks | BundleStudy | DriftStudy | FrequencyStudy | MotionStudy | Pace | PaperFibre | RankRow | TopStudy
Shared = EnsembleScaling | Scaling
Touched = ContactCell | ContactRow | ContactStudy | GrooveSweep | SideBySide
Gathered = GrooveEnsemble | GrooveImage | GrooveModels | GrooveSteps | PaperRun
Other = Cell | Check | Contender | ExplicitLimit | LawRow | MotionRow | Shape | Speed | Study | TwistStudy
Row = Trial | Moved | Shared | Touched | Gathered | Cost | Other
PARTS = (
    Attempt,
    BundleCost,
    ContactRecord,
    GroovePoint,
    GrooveProfile,
    Growth,
    Measured,
    MotionRecord,
    Order,
    Peer,
    Record,
    Taker,
    Timing,
)
RECORDS: dict[str, Any] = {kind.__name__: kind for kind in (*get_args(Row), *PARTS)}
PACKAGES = ("dolfinrod", "discrete", "verification")
NAME = re.compile("[0-9a-f]{24}")
# What numbers can depend on; the page is written anew every time.
SOURCES, READERS = ("*.py", "*.json"), ("verification/report/",)


@dataclass(frozen=True)
class Unit:
    """A piece of work that is done whole or not at all.

    Args:
        topic: Of the report: "study", "shape", "limit", "one step", "speed", "law", "critical", "bracket", "hard",
            "largest", "fewest", "explicit limit", "map", "hard motion", "peer", "motion",
            "frequency", "drift", "bundle", "ranks", "cost",
            "pace", "paper fibre", "rigid", "contact", "groove", "side by side", "contact map",
            "hard contact", "meeting", "twist" or "groove scenario".
        words: What is solved, for people.
        parameters: What sets it apart from others of its topic; strings and numbers.
        work: Solves it; returns a row, or rows, for the report.
        alone: Whether it compares times on all cores, so that nothing else may run beside it.
        rests_on: A solution that it is held against, by a name: units in a row that share it are left to one process,
            which then solves it once; empty: none that others share.
        in_parts: Whether `work` is many runs, told a folder in which it keeps those that have ended and finds them
            again.
    """

    topic: str
    words: str
    parameters: tuple[str | int | float, ...]
    work: Callable[..., Row | tuple[Row, ...]]
    alone: bool = False
    rests_on: str = ""
    in_parts: bool = False

    def done(self, folder: Path) -> tuple[tuple[Row, ...], float]:
        """Do it, its parts kept in a folder where it has any: rows, and seconds by the clock."""
        began = perf_counter()
        rows = self.work(folder) if self.in_parts else self.work()
        return rows if isinstance(rows, tuple) else (rows,), perf_counter() - began


class Ledger:
    """Rows of finished units in a folder.

    Args:
        folder: Made where it does not exist.
        machine: On which this runs.
        fresh: Whether to ignore what is there.
    """

    def __init__(self, folder: Path, machine: Machine, *, fresh: bool = False) -> None:
        self._fresh, self._trusted = fresh, set[Path]()
        facts = (machine.processor, machine.cores, machine.threads, machine.system, sorted(machine.versions.items()))
        self._folder = folder / name_of([*facts, source_hash()])
        self._folder.mkdir(parents=True, exist_ok=True)
        for old in folder.iterdir():
            if old != self._folder and NAME.fullmatch(old.name):
                shutil.rmtree(old)

    def recall(self, unit: Unit) -> tuple[Row, ...] | None:
        """What an earlier run found; None where the unit is still to be done.

        A file that cannot be read as such a record counts as none.
        """
        if self._fresh and self._place(unit) not in self._trusted:
            return None
        try:
            found = decode(json.loads(self._place(unit).read_text(encoding="utf-8"))["rows"])
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return found if isinstance(found, tuple) else None

    def fill(self, unit: Unit, interrupt: Interrupt | None = None) -> tuple[Row, ...]:
        """Do a unit and keep its rows, or of one that is interrupted the parts that have ended.

        The interrupt is asked after it, so that none is kept that was disturbed.
        """
        parts = self._place(unit).with_suffix("")
        if self._fresh:
            shutil.rmtree(parts, ignore_errors=True)
        rows, seconds = unit.done(parts)
        if interrupt is not None:
            interrupt.check()
        self.keep(unit, rows, seconds)
        shutil.rmtree(parts, ignore_errors=True)
        return rows

    def trust(self, unit: Unit) -> None:
        """Recall this unit even where all others are done afresh: it was kept by a process of this run."""
        self._trusted.add(self._place(unit))

    def seconds(self, unit: Unit) -> float:
        """What a kept unit took, by the clock; 0 where it is not kept [s]."""
        try:
            return float(json.loads(self._place(unit).read_text(encoding="utf-8"))["seconds"])
        except (OSError, ValueError, KeyError, TypeError):
            return 0.0

    def keep(self, unit: Unit, rows: tuple[Row, ...], seconds: float = 0.0) -> None:
        """Write the rows of a unit and what it took [s], whole or not at all."""
        place = self._place(unit)
        facts = {"topic": unit.topic, "words": unit.words, "parameters": unit.parameters, "seconds": seconds}
        record = facts | {"rows": encode(rows)}
        draft = place.with_suffix(f".{os.getpid()}")
        draft.write_text(json.dumps(record, ensure_ascii=False, allow_nan=False), encoding="utf-8")
        draft.replace(place)

    def _place(self, unit: Unit) -> Path:
        return self._folder / f"{name_of([unit.topic, unit.parameters])}.json"


def name_of(facts: Any) -> str:
    """A file name that other facts do not have."""
    return hashlib.sha256(json.dumps(facts).encode()).hexdigest()[:24]


def source_hash() -> str:
    """Of every file that a number can depend on."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for file in sorted(f for package in PACKAGES for kind in SOURCES for f in (root / package).rglob(kind)):
        name = file.relative_to(root).as_posix()
        if not name.startswith(READERS):
            digest.update(name.encode() + b"\0" + file.read_bytes() + b"\0")
    return digest.hexdigest()


def encode(value: Any) -> Any:
    """A record as what JSON can hold: sequences as lists, arrays, records and numbers beyond JSON by their kind."""
    if is_dataclass(value):
        return {"kind": type(value).__name__, **{f.name: encode(getattr(value, f.name)) for f in fields(value)}}
    if isinstance(value, tuple | list):
        return [encode(entry) for entry in value]
    if isinstance(value, np.ndarray):
        return {"kind": "array", "values": encode(value.tolist())}
    if isinstance(value, np.generic):
        return encode(value.item())
    if isinstance(value, float) and not isfinite(value):
        return {"kind": "float", "value": str(value)}
    return value


def decode(value: Any) -> Any:
    """The record again, sequences as tuples.

    Raises:
        KeyError: The kind of a record is not known.
        TypeError: A record has other fields.
    """
    if isinstance(value, list):
        return tuple(decode(entry) for entry in value)
    if not isinstance(value, dict):
        return value
    kind = value["kind"]
    if kind == "array":
        return np.asarray(decode(value["values"]), dtype=float)
    if kind == "float":
        return float(value["value"])
    return RECORDS[kind](**{name: decode(entry) for name, entry in value.items() if name != "kind"})
