"""Motions and equilibrium paths in the arrays of a checkpoint, in units of the model, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from discrete.keptmet import met_of, recalled, resume_met
from discrete.marching import Mark
from discrete.moving import Moving
from discrete.record import Snapshot
from discrete.state import State
from discrete.trajectory import Entry
from dolfinrod.checkpoint import columns, rows

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from discrete.equilibrium import Equilibrium
    from discrete.marching import March
    from discrete.statics import Path
    from discrete.trajectory import Trajectory
    from dolfinrod.checkpoint import Kept

    Array = NDArray[np.float64]
    Arrays = dict[str, Array]

__all__ = ["motion_of", "path_of", "resume_motion", "resume_path"]

# Names in the file, and those of the records.
MOVING = {"x": "x", "R": "R", "F_n": "F_n", "v": "v", "omega": "ω", "factors": "factors", "theta": "θ"}
STATE = {name: name for name in ("x", "R", "u", "F_n", "factors")}
SNAPSHOT = {name: name for name in ("t", "x", "R", "force", "halves", "energy", "v", "elastic", "touching")}
SNAPSHOT["omega"] = "ω"
RATES = ("v", "omega", "F_n")


def motion_of(march: March, trajectory: Trajectory, seconds: float) -> Arrays:
    """All that a motion goes on from, and all that is stored of it.

    Args:
        march: At its mark.
        trajectory: As far as that.
        seconds: Spent on it in this run [s].

    Returns:
        "group/name" → values.
    """
    mark, last, (iterations, factorizations, earlier) = march.mark, trajectory.last(), trajectory.work
    arrays = _work(iterations=iterations, factorizations=factorizations, seconds=earlier + seconds, step=mark.step)
    arrays |= _work(rested=mark.rested)
    arrays |= _fields("state", mark.state, MOVING) | {"state/goals": np.array(mark.goals)}
    for group, rates in (("trend", mark.state.trend), ("bend", mark.state.bend)):
        if rates is not None:
            arrays |= {f"{group}/{name}": rate for name, rate in zip(RATES, rates, strict=True)}
    if last is not None:
        arrays |= _fields("last", last, SNAPSHOT) | met_of("last", [last.met])
    arrays |= {f"now/{name}": np.array(value) for name, value in trajectory.entry.now.items()}
    for name in trajectory.books[0]:
        arrays[f"ledger/{name}"] = np.array([book[name] for book in trajectory.books])
    return arrays | _stacked(trajectory.kept) | columns(trajectory.log) | remembered(mark.entry.memory)


def resume_motion(march: March, trajectory: Trajectory, kept: Kept) -> None:
    """Take up a motion.

    Args:
        march: Newly made.
        trajectory: The same, with its first state.
        kept: From `motion_of`.

    Raises:
        SceneError: It does not fit.
    """
    like, first = march.mark.state, trajectory.kept[0]
    state = Moving(kept.t, **_taken(kept, "state", like, MOVING), **_rates(kept, like))
    trajectory.kept = _snapshots(kept, first)
    n = len(trajectory.kept)
    ledger = {name: kept.take(f"ledger/{name}", (n,)) for name in trajectory.books[0]}
    trajectory.books = [{name: float(values[k]) for name, values in ledger.items()} for k in range(n)]
    trajectory.log = rows(kept)
    solved, made = kept.count("work/iterations"), kept.count("work/factorizations")
    trajectory.earlier = solved, made, kept.number("work/seconds")
    now = {name: kept.number(f"now/{name}") for name in trajectory.entry.now}
    last = None
    if "last/t" in kept.arrays:
        (met,) = resume_met(kept, "last", 1, len(first.met))
        last = _snapshot(_taken(kept, "last", first, SNAPSHOT) | {"met": met})
    goals = kept.arrays.get("state/goals", np.zeros(0))
    entry = Entry(n, len(trajectory.log), now, last, recalled(kept, trajectory.entry.memory))
    rested = bool(kept.count("work/rested"))
    march.take_up(Mark(state, kept.number("work/step"), entry, tuple(np.ravel(goals).tolist()), rested))
    trajectory.rewind(entry, state)


def path_of(path: Path[Any], memory: Arrays) -> Arrays:
    """All that is kept of an equilibrium path, as far as its log goes.

    Args:
        path: The path.
        memory: What contacts remember of its last state.

    Returns:
        "group/name" → values.
    """
    n = len(path.log) + 1
    arrays = _fields("state", path.state, STATE) | _work(iterations=path.iterations)
    return arrays | _stacked(path.kept[:n]) | columns(path.log) | remembered(memory)


def remembered(memory: Mapping[str, Array]) -> Arrays:
    """What contacts remember as arrays of the file."""
    return {f"contact/{name}": values for name, values in memory.items()}


def resume_path(path: Path[State], kept: Kept, equilibrium: Equilibrium) -> None:
    """Make a path that has just begun the one that `path_of` kept.

    Args:
        path: Newly made.
        kept: From `path_of`.
        equilibrium: Solver of the scene, whose contacts are to remember what they did.

    Raises:
        SceneError: It does not fit.
    """
    state, like = State(**_taken(kept, "state", path.state, STATE)), path.kept[0]
    path.log[:] = rows(kept)
    kept.take("stored/t", (len(path.log) + 1,))
    path.kept[:] = _snapshots(kept, like)
    path.state, path.iterations = state, kept.count("work/iterations")
    equilibrium.place(state, path.kept[-1].t, recalled(kept, equilibrium.memory()))


def _work(**numbers: float) -> Arrays:
    return {f"work/{name}": np.array(float(value)) for name, value in numbers.items()}


def _fields(group: str, record: object, names: Mapping[str, str]) -> Arrays:
    """Arrays of a record, those it has."""
    values = {name: getattr(record, field) for name, field in names.items()}
    return {f"{group}/{name}": np.asarray(value) for name, value in values.items() if value is not None}


def _taken(kept: Kept, group: str, like: object, names: Mapping[str, str]) -> dict[str, Any]:
    """Arrays of a record of the same shapes as another, by the names of its fields."""
    shapes = {name: np.shape(value) for name, value in _fields(group, like, names).items()}
    return {names[name.removeprefix(f"{group}/")]: kept.take(name, shape) for name, shape in shapes.items()}


def _rates(kept: Kept, like: Moving) -> dict[str, Any]:
    """Rates over the step behind and theirs, as far as they are known."""
    v, F_n = like.v.shape, like.F_n.shape
    return {
        group: (kept.take(f"{group}/v", v), kept.take(f"{group}/omega", v), kept.take(f"{group}/F_n", F_n))
        for group in ("trend", "bend")
        if f"{group}/v" in kept.arrays
    }


def _stacked(path: Sequence[Snapshot]) -> Arrays:
    """Snapshots as one array a field."""
    parts = [_fields("stored", snapshot, SNAPSHOT) for snapshot in path]
    stacks = {name: np.stack([part[name] for part in parts]) for name in parts[0]}
    return stacks | met_of("stored", [snapshot.met for snapshot in path])


def _snapshots(kept: Kept, like: Snapshot) -> list[Snapshot]:
    """Snapshots back from such arrays."""
    times = kept.times("stored/t").tolist()
    shapes = {name: np.shape(value) for name, value in _fields("stored", like, SNAPSHOT).items()}
    stacks = {SNAPSHOT[name.removeprefix("stored/")]: kept.take(name, (len(times), *of)) for name, of in shapes.items()}
    met = resume_met(kept, "stored", len(times), len(like.met))
    stacked = [{field: values[k] for field, values in stacks.items()} for k in range(len(times))]
    return [_snapshot(arrays | {"met": one}) for arrays, one in zip(stacked, met, strict=True)]


def _snapshot(arrays: dict[str, Any]) -> Snapshot:
    """One of them."""
    return Snapshot(**arrays | {field: float(arrays[field]) for field in ("t", "energy")})
