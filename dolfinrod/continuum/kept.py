"""Motions and equilibrium paths in the arrays of a checkpoint, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.checkpoint import columns, rows
from dolfinrod.continuum.met import is_ragged
from dolfinrod.continuum.path import Path
from dolfinrod.continuum.restart import moving_state, shapes, take_up
from dolfinrod.continuum.trajectory import Mark

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from dolfinrod.checkpoint import Kept
    from dolfinrod.continuum.march import March
    from dolfinrod.continuum.readout import State

    Arrays = dict[str, NDArray[np.float64]]

__all__ = ["motion_of", "path_of", "resume_motion", "resumed_path"]


def motion_of(march: March, seconds: float) -> Arrays:
    """All that a motion goes on from, and all that is stored of it.

    Args:
        march: Its problem is at its mark.
        seconds: Spent on it so far, by earlier runs too [s].

    Returns:
        "group/name" → values, on every rank.
    """
    mark, trajectory = march.mark, march.trajectory
    factorizations = trajectory.factorizations + march.newton.factorizations
    arrays = _work(iterations=trajectory.iterations, factorizations=factorizations, seconds=seconds, rested=mark.rested)
    arrays |= {f"state/{name}": values for name, values in moving_state(march).items()}
    arrays |= {f"now/{name}": np.array(value) for name, value in mark.energy.items()}
    arrays |= {f"ledger/{name}": np.array([row[name] for row in march.ledger.rows]) for name in mark.energy}
    return arrays | _stored(trajectory.t, trajectory.states) | columns(trajectory.log)


def resume_motion(march: March, kept: Kept) -> None:
    """Take up a motion.

    Args:
        march: Newly made.
        kept: From `motion_of`.

    Raises:
        SceneError: It does not fit.
    """
    first, added = shapes(march)
    shape = first | added if "state/a" in kept.arrays else first
    state = {name: _taken(kept, f"state/{name}", of, ragged=is_ragged(name)) for name, of in shape.items()}
    trajectory = march.trajectory
    trajectory.t, trajectory.states = _states(kept, march.state())
    n = len(trajectory.t)
    ledger = {name: kept.take(f"ledger/{name}", (n,)) for name in march.mark.energy}
    march.ledger.rows[:] = [{name: float(values[k]) for name, values in ledger.items()} for k in range(n)]
    trajectory.log, trajectory.iterations = rows(kept), kept.count("work/iterations")
    trajectory.factorizations, trajectory.seconds = kept.count("work/factorizations"), kept.number("work/seconds")
    energy = {name: kept.number(f"now/{name}") for name in march.mark.energy}
    count = n, len(trajectory.log), trajectory.iterations
    rested = bool(kept.count("work/rested"))
    mark = Mark(kept.t, march.mark.x, march.mark.motion, float(state["length"]), energy, *count, rested=rested)
    take_up(march, state, mark)


def path_of(path: Path) -> Arrays:
    """All that is kept of an equilibrium path, as far as its log goes."""
    n = len(path.log) + 1
    arrays = _work(iterations=path.iterations, seconds=path.seconds_stability)
    return (
        arrays | {"ledger/strain": np.array(path.energy[:n])} | _stored(path.t[:n], path.states[:n]) | columns(path.log)
    )


def resumed_path(begun: Path, kept: Kept) -> Path:
    """The path that `path_of` kept.

    Args:
        begun: The same path when it began, for its shapes.
        kept: What there is of it.

    Raises:
        SceneError: It does not fit.
    """
    t, states = _states(kept, begun.states[0])
    log = rows(kept)
    energy = kept.take("ledger/strain", (len(log) + 1,)).tolist()
    kept.take("stored/t", (len(log) + 1,))
    stable = log[-1].stable if log else begun.stable
    return Path(t, states, energy, log, kept.count("work/iterations"), stable, kept.number("work/seconds"))


def _work(**numbers: float) -> Arrays:
    return {f"work/{name}": np.array(float(value)) for name, value in numbers.items()}


def _stored(t: Sequence[float], states: Sequence[State]) -> Arrays:
    """States as one array a field."""
    met = [name for name in states[0] if is_ragged(name)]
    fields = {f"stored/{name}": np.stack([state[name] for state in states]) for name in states[0] if name not in met}
    fields |= {f"stored/{name}": np.concatenate([state[name] for state in states]) for name in met}
    fields |= {f"rows/{name}": np.array([float(len(state[name])) for state in states]) for name in met}
    return fields | {"stored/t": np.array(t)}


def _states(kept: Kept, like: Mapping[str, NDArray[np.float64]]) -> tuple[list[float], list[State]]:
    """Times and states back from such arrays."""
    times = kept.times("stored/t").tolist()
    fields: dict[str, Sequence[NDArray[np.float64]]] = {}
    for name, values in like.items():
        if not is_ragged(name):
            fields[name] = list(kept.take(f"stored/{name}", (len(times), *values.shape)))
            continue
        rows = np.cumsum(kept.take(f"rows/{name}", (len(times),))).astype(np.int64)
        fields[name] = np.split(kept.take(f"stored/{name}", (int(rows[-1]), *values.shape[1:])), rows[:-1])
    return times, [{name: values[k] for name, values in fields.items()} for k in range(len(times))]


def _taken(kept: Kept, name: str, shape: tuple[int, ...], *, ragged: bool) -> NDArray[np.float64]:
    """An array of a shape, or of any number of such rows."""
    found = kept.arrays.get(name)
    if ragged and found is not None and found.ndim:
        shape = (len(found), *shape[1:])
    return kept.take(name, shape)
