"""Sweeps: the same scenario with one parameter or several at a number of values each."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any

from dolfinrod.groove.clock import Progress
from dolfinrod.groove.ensemble import Ensemble, ensemble, world
from dolfinrod.groove.rows import write_rows
from dolfinrod.groove.scenario import Scenario
from dolfinrod.groove.tables import Maybe, scenario_tables
from dolfinrod.groove.variants import varied
from dolfinrod.scene import SceneError
from dolfinrod.scene.tables import Choice, Inner, Kind, meant

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm

__all__ = ["SHORT", "grid", "sweep", "value"]

# What researchers sweep, by short names.
SHORT = {
    "angle": "groove.beta_left",
    "mu_wall": "wall_friction.mu",
    "mu_ff": "fibre_friction.mu",
    "suction": "air.speed",
    "tension": "ends.tension",
    "offset": "bundle.offset",
}


def sweep(
    scenarios: Scenario | Sequence[Scenario],
    values: Mapping[str, Iterable[Any]],
    *,
    folder: str | os.PathLike[str],
    seeds: Iterable[int] | None = range(10),
    model: str | Sequence[str] = "discrete",
    comm: Intracomm | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> Ensemble:
    """Solve scenarios at every combination of values of parameters, and list the runs in runs.csv and runs.json.

    Args:
        scenarios: One or more.
        values: Of each parameter, in SI, by its short name or as `varied` takes it.
        folder: As in `ensemble`, like all that follows.
        seeds: Of the noise.
        model: "continuum", "discrete", or both of them.
        comm: Whose ranks share the work.
        progress: Called before, during and after each run.

    Returns:
        All runs, on every rank.

    Raises:
        SceneError: No such parameter, or a value out of its range.
    """
    posed = grid(scenarios, values)
    found = ensemble(posed, folder=folder, seeds=seeds, model=model, comm=comm, progress=progress)
    if (comm or world()).rank == 0:
        write_rows(found.runs, folder)
    return found


def grid(scenarios: Scenario | Sequence[Scenario], values: Mapping[str, Iterable[Any]]) -> tuple[Scenario, ...]:
    """Scenarios at every combination of values; the last parameter varies fastest.

    Args:
        scenarios: One or more.
        values: As in `sweep`.

    Returns:
        Scenarios.

    Raises:
        SceneError: As in `sweep`.
    """
    found = []
    for scenario in (scenarios,) if isinstance(scenarios, Scenario) else scenarios:
        for chosen in product(*values.values()):
            posed = scenario
            for name, number in zip(values, chosen, strict=True):
                posed = varied(posed, SHORT.get(name, name), number)
            found.append(posed)
    return tuple(found)


def value(name: str, text: str) -> Any:
    """What a text says of a parameter, as in a file: "0.3", "0.1 mN", "held", "none".

    Args:
        name: As in `sweep`.
        text: A plain number is SI.

    Returns:
        In SI.

    Raises:
        SceneError: No such parameter, or no such quantity.
    """
    path = SHORT.get(name, name)
    fields = _fields(scenario_tables())
    if path not in fields:
        known = [*SHORT, *fields]
        raise SceneError(f"must be the name of a parameter, got {name!r}{meant(name, known)}", field="--sweep")
    return fields[path].read(_plain(text), name)


def _fields(kind: Kind, path: str = "") -> dict[str, Any]:
    """How each parameter is read, those within parts by names with dots."""
    found: dict[str, Any] = {}
    for name, field in kind.fields.items():
        inner = field.field if isinstance(field, Maybe) else field
        kinds = (
            [inner.kind] if isinstance(inner, Inner) else [*inner.kinds.values()] if isinstance(inner, Choice) else []
        )
        for each in kinds:
            found |= _fields(each, f"{path}{name}.")
        if not kinds:
            found[path + name] = field
    return found


def _plain(text: str) -> Any:
    """A number, a truth or a word."""
    for read in (int, float):
        try:
            return read(text)
        except ValueError:
            continue
    return {"true": True, "false": False}.get(text, text)
