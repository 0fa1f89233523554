"""What a run keeps of its result: some frames of the bundle with its forces, its course in time and its energies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove.core import FixedCore, RollingCore
from dolfinrod.groove.course import course
from dolfinrod.groove.measures import STATIONS, Measures, measure
from dolfinrod.scene import Groove

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.groove.scenario import Scenario
    from dolfinrod.result import Result

    Array = NDArray[np.float64]

__all__ = ["Film", "filmed"]

# So many show a motion; all stored times of a long one would fill disks.
MOST_FRAMES = 61
ENERGY, COURSE = "energy ", "course "
# Points along the section of the groove, and how far its lands are drawn beyond its lips, as a part of its width.
POINTS, LAND = 240, 0.35


@dataclass(frozen=True, eq=False)
class Film:
    """A bundle at some of the stored times, the first and the last among them, and its course over all.

    Args:
        times: Of the frames, shape (n_f,) [s].
        s: Arc length of the nodes, alike in all fibres, shape (n_s,) [m].
        paths: Centrelines of the fibres in the straight groove, unrolled where it goes around a roller, shape
            (n_f, N, n_s, 3) [m].
        pull: Axial force, shape (n_f, N, n_s) [N].
        pressed: Line load of groove and core, shape (n_f, N, n_s) [N/m].
        met: Spots where rods press rods, a row each: frame, rod a, rod b, X, Y, Z in the straight groove [m], normal
            force [N].
        crossed: Crossings seen from above, a row each: frame, k, l, the one on top, X [m], sign.
        X: Ends of the stretches along X, shape (n_f, n + 1) [m].
        T: Twist by pairs in each, shape (n_f, n) [turns/m].
        along: Means over each stretch of width [m], tension [N], line loads of walls and of fibres on one another
            [N/m], shape (n_f, 4, n).
        turns: Of each pair of fibres, shape (n_f, N, N).
        outline: Section of the groove, z and y, shape (n, 2) [m].
        core: Axis of the core, y and z, and its radius, shape (n_f, 3) [m]; no rows: there is none.
        radius: Of a fibre, shape (1,) [m].
        course: By the names of `Course`.
        energy: Ledger over all stored times, by name [J].
    """

    times: Array
    s: Array
    paths: Array
    pull: Array
    pressed: Array
    met: Array
    crossed: Array
    X: Array
    T: Array
    along: Array
    turns: Array
    outline: Array
    core: Array
    radius: Array
    course: dict[str, Array]
    energy: dict[str, Array]

    @classmethod
    def of(cls, arrays: Mapping[str, Array]) -> Film:
        """From the arrays of a run."""
        marked = {
            mark: {key.removeprefix(mark): arrays[key] for key in arrays if key.startswith(mark)}
            for mark in (COURSE, ENERGY)
        }
        plain = {f.name: arrays[f.name] for f in fields(cls) if f.name not in ("course", "energy")}
        return cls(**plain, course=marked[COURSE], energy=marked[ENERGY])

    def crossings(self, frame: int) -> Array:
        """Rows of one frame, counted from the end where negative."""
        return np.asarray(self.crossed[self.crossed[:, 0] == frame % len(self.times)])


def filmed(result: Result, scenario: Scenario) -> dict[str, Array]:
    """All arrays that a run keeps.

    Args:
        result: Of the scenario, by either model.
        scenario: What was solved.

    Returns:
        Arrays by the names of `Film`; not a number where fibres cannot be measured.
    """
    n = len(result.t)
    chosen = np.unique(np.linspace(0, n - 1, min(n, MOST_FRAMES)).round().astype(int))
    rods = result.rods[: scenario.fibres]
    told = [_told(result, scenario, int(i)) for i in chosen]
    arrays = {
        "times": result.t[chosen],
        "s": rods[0].s,
        "paths": np.stack([[scenario.unrolled(h.r[i]) for i in chosen] for h in rods], axis=1),
        "pull": np.stack([h.n[chosen, :, 0] for h in rods], axis=1),
        "pressed": np.stack([_pressed(result, k, chosen) for k in range(len(rods))], axis=1),
        "met": _met(result, scenario, chosen),
        "crossed": np.array([row for f, m in enumerate(told) for row in _crossed(f, m)]).reshape(-1, 6),
        **_stretches(told, scenario.fibres),
        "outline": _outline(scenario),
        "core": _core(result, scenario, chosen),
        "radius": np.array([scenario.bundle.radius]),
    }
    over = {COURSE + name: values for name, values in asdict(course(result, scenario)).items()}
    return arrays | over | {ENERGY + name: values for name, values in result.energy.items()}


def _told(result: Result, scenario: Scenario, i: int) -> Measures | None:
    """What can be measured at a stored time; None where fibres meet or are too coarse."""
    try:
        return measure(result, scenario, i)
    except ValueError:
        return None


def _pressed(result: Result, rod: int, chosen: NDArray[np.int64]) -> Array:
    """Line load of all walls on a fibre, at its nodes."""
    felt = [touching for history in result.contacts if (touching := history.rods[rod]) is not None]
    return np.asarray(sum((each.pressure[chosen] for each in felt), np.zeros((len(chosen), len(result.rods[rod].s)))))


def _met(result: Result, scenario: Scenario, chosen: NDArray[np.int64]) -> Array:
    """Spots of all contacts among rods."""
    rows = []
    for history in result.meetings:
        for f, i in enumerate(chosen):
            met = history.times[int(i)]
            force = np.einsum("ni,ni->n", met.force, met.normal)
            ends = np.full(len(force), f), met.rod_a, met.rod_b
            rows.append(np.column_stack((*ends, scenario.unrolled(met.point), force)))
    return np.concatenate(rows) if rows else np.empty((0, 7))


def _crossed(frame: int, told: Measures | None) -> list[tuple[float, ...]]:
    """Rows of a frame."""
    found = () if told is None else told.crossings
    return [(frame, each.k, each.l, each.over, each.X, each.sign) for each in found]


def _stretches(told: list[Measures | None], fibres: int) -> dict[str, Array]:
    """What was measured along X, frame by frame."""
    X, T = np.full((len(told), STATIONS + 1), np.nan), np.full((len(told), STATIONS), np.nan)
    along, turns = np.full((len(told), 4, STATIONS), np.nan), np.full((len(told), fibres, fibres), np.nan)
    for f, found in enumerate(told):
        if found is None:
            continue
        turns[f] = found.winding
        if found.T is not None:
            T[f] = found.T.pairs
        if found.along is not None:
            here = found.along
            X[f], along[f] = here.X, (here.width, here.tension, here.walls, here.fibres)
    return {"X": X, "T": T, "along": along, "turns": turns}


def _outline(scenario: Scenario) -> Array:
    """Section of the groove with its fillet, and a part of the lands beside it."""
    section = scenario.section
    groove = Groove.v(section.beta_left, section.beta_right, section.half_width, section.depth, fillet=section.fillet)
    corners = np.asarray(groove.profile)
    room = LAND * float(np.ptp(corners[1:-1, 0]))
    corners[[0, -1]] = corners[1] - (room, 0.0), corners[-2] + (room, 0.0)
    way = np.r_[0.0, np.cumsum(np.hypot(*np.diff(corners, axis=0).T))]
    at = np.union1d(np.linspace(0.0, way[-1], POINTS), way) if section.fillet else way
    z, y = (np.interp(at, way, corners[:, c]) for c in (0, 1))
    # Points in a corner that the fillet cuts off go to the fillet.
    near = groove.closest(np.column_stack((np.zeros_like(z), y, z)))
    yz = np.column_stack((y, z)) - near.distance[:, None] * near.normal[:, 1:]
    return np.column_stack((-yz[::-1, 1], yz[::-1, 0]) if scenario.mirrored else (yz[:, 1], yz[:, 0]))


def _core(result: Result, scenario: Scenario, chosen: NDArray[np.int64]) -> Array:
    """Where the core lies and how thick it is, frame by frame."""
    core = scenario.core
    if isinstance(core, RollingCore):
        middle = result.rods[scenario.fibres].r[chosen].mean(axis=1)
        return np.column_stack((middle[:, 1:], np.full(len(chosen), core.radius)))
    if isinstance(core, FixedCore):
        _, y, z = np.asarray(core.surface(scenario.section, None, mirrored=scenario.mirrored).point)
        return np.tile((y, z, core.radius), (len(chosen), 1))
    return np.empty((0, 3))
