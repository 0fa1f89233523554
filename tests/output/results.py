"""Results that no solver needs to find: any doubles in the arrays of a real scene."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

import dolfinrod as dr
from tests.scenes import GENERAL

Array = NDArray[np.float64]

# Products of two of them and of ten are still doubles.
doubles = st.floats(-1e100, 1e100)
VECTORS = ("r", "gamma", "kappa", "n", "m")
VELOCITIES = ("v", "omega")
LEDGER = ("kinetic", "strain", "potential", "load work", "support work", "drag", "damping", "numerical")
SCENE = dr.Scene(
    rods=[dr.Rod.straight(1.0, GENERAL), dr.Rod.through([(0, 1, 0), (1, 1.1, 0.3), (2, 1, 0.1)], GENERAL)],
    supports=[dr.Clamp("start")],
    loads=[dr.PointForce((0.1, -0.7, 0.3), "end", history=[(0.0, 0.0), (1.0, 1 / 3)])],
)


MOVING = dr.Scene(
    rods=[dr.Rod.straight(1.0, dr.Section(EA=900.0, GA=400.0, GJ=0.7, EI=(1.0, 2.0), rhoA=1.0))],
    motion=dr.Dynamic(2.0, dt=0.125, scheme=dr.Midpoint()),
    velocities=[dr.Velocity((0.0, 1.0, 0.0), omega=(0.0, 0.0, 3.0))],
)


def flight() -> dr.Result:
    """The free rod `MOVING` as it flies and turns for ever, on a ledger of round numbers."""
    s, t, turn = np.linspace(0.0, 1.0, 5), np.linspace(0.0, 2.0, 17), 3.0
    cos, sin, zero = np.cos(turn * t)[:, None], np.sin(turn * t)[:, None], np.zeros((17, 5))
    r = np.stack([s * cos, s * sin + t[:, None], zero], axis=2)
    d1, d2 = (np.stack(np.broadcast_arrays(x, y, zero), axis=2) for x, y in ((cos, sin), (-sin, cos)))
    d3 = np.broadcast_to([0.0, 0.0, 1.0], r.shape)
    v = np.stack([-turn * s * sin, turn * s * cos + 1.0, zero], axis=2)
    still = {name: np.zeros_like(r) for name in VECTORS[1:]}
    rod = dr.RodHistory(s=s, r=r, frames=np.stack([d1, d2, d3], axis=3), **still, v=v, omega=turn * d3)
    return dr.Result(
        scene=MOVING,
        t=t,
        rods=(rod,),
        converged=True,
        log=tuple(dr.StepLog(time, 3, 0, 1e-12, 0.5 * time) for time in t[1:].tolist()),
        energy={name: 1e-3 * (i + 1) * t for i, name in enumerate(LEDGER[:-1])} | {"numerical": 0.0 * t},
        statistics=dr.Statistics(30, 16, 48, 48),
        formulation=dr.Formulation("continuum", "planar", {"r": 10}, ("Elasticity", "Inertia")),
    )


ROUND = replace(GENERAL, radius=0.01)
FLOOR, WALL = (
    dr.Plane((0.0, -0.01, 0.0), (0, 1, 0)),
    dr.Plane((0, 0, 0), (1, 0, 0), dr.WallMotion(velocity=(0.1, 0, 0))),
)
LYING = dr.Scene(
    rods=[dr.Rod.straight(1.0, ROUND), dr.Rod.straight(0.5, ROUND, start=(0.2, 0.1, 0.0))],
    contacts=[
        dr.Contact(FLOOR, dr.Penalty(1e6, 5e-5), dr.Coulomb(0.3)),
        dr.Contact(WALL, dr.AugmentedLagrangian(1e6, 1e-9), rod=1),
    ],
)
MU, N_S = 0.3, 41


def lain() -> dr.Result:
    """Rods that a floor and a wall carry, as if they had been bent so: round numbers, not an equilibrium."""
    t = np.array([0.0, 0.5, 1.0])
    rods = tuple(_bent(rod, sag, t) for rod, sag in zip(LYING.rods, (1e-4, 2e-4), strict=True))
    floor = dr.ContactHistory(tuple(_on_floor(rod, LYING.contacts[0].law) for rod in rods))
    apart = np.full((3, N_S), 0.2)
    push = np.outer(t, np.eye(1, N_S)[0])
    none = np.zeros((3, N_S, 3))
    normal = np.where(push[:, :, None] > 0.0, [1.0, 0.0, 0.0], 0.0)
    wall = dr.Touching(
        s=rods[1].s,
        share=_shares(rods[1].s),
        gap=apart + rods[1].s,
        pressure=push,
        normal=normal,
        traction=none,
        slip=np.zeros((3, N_S)),
        state=(2 * (push > 0.0)).astype(np.int8),
    )
    return dr.Result(
        scene=LYING,
        t=t,
        rods=rods,
        converged=True,
        log=tuple(dr.StepLog(time, 3, 0, 1e-12, 0.5 * time) for time in t[1:].tolist()),
        energy={"strain": 1e-3 * t},
        statistics=dr.Statistics(30, 2, 6, 6),
        formulation=dr.Formulation("continuum", "planar", {"r": 10}, ("Elasticity", "Contact")),
        contacts=(floor, dr.ContactHistory((None, wall))),
    )


def apart() -> dr.Result:
    """The same rods too far off to touch anything."""
    result = lain()
    contacts = [tuple(rod and _lifted(rod) for rod in contact.rods) for contact in result.contacts]
    return replace(result, contacts=tuple(dr.ContactHistory(rods) for rods in contacts))


def _lifted(rod: dr.Touching) -> dr.Touching:
    """The same above the surface."""
    still = {name: np.zeros_like(getattr(rod, name)) for name in ("pressure", "normal", "traction", "state")}
    return replace(rod, gap=np.abs(rod.gap) + 1.0, **still)


def _bent(rod: dr.Rod, sag: float, t: Array) -> dr.RodHistory:
    """A rod whose middle sinks below y = 0 by `sag` in the end, and whose ends rise."""
    s = np.linspace(0.0, rod.length, N_S)
    x = 2.0 * s / rod.length - 1.0
    y = np.outer(t, sag * (16.0 * x**2 - 1.0)) + np.outer(1.0 - t, np.full(N_S, 0.01))
    flat = rod.centerline(s)
    r = np.stack(np.broadcast_arrays(flat[:, 0], y, 0.0), axis=2)
    still = {name: np.zeros_like(r) for name in VECTORS[1:]}
    return dr.RodHistory(s=s, r=r, frames=np.broadcast_to(np.eye(3), (*r.shape, 3)).copy(), **still)


def _shares(s: Array) -> Array:
    """Half of the distance to either neighbour."""
    return 0.5 * np.diff(s, prepend=s[0]) + 0.5 * np.diff(s, append=s[-1])


def _on_floor(rod: dr.RodHistory, law: dr.Penalty) -> dr.Touching:
    """What the floor does: friction at its limit where little presses, half of it where much does."""
    gap = rod.r[:, :, 1]
    pressure = law.eps_N * np.maximum(law.g_0 - gap, 0.0)
    state = np.where(pressure > 0.5 * pressure.max(), 1, 2 * (pressure > 0.0)).astype(np.int8)
    traction = np.zeros((*gap.shape, 3))
    traction[:, :, 0] = -MU * pressure * np.where(state == 1, 0.5, 1.0)
    return dr.Touching(
        s=rod.s,
        share=_shares(rod.s),
        gap=gap,
        pressure=pressure,
        normal=np.where(pressure[:, :, None] > 0.0, [0.0, 1.0, 0.0], 0.0),
        traction=traction,
        slip=1e-5 * (state == 2),
        state=state,
    )


def histories(rod: dr.Rod, n_t: int, n_s: int, velocities: tuple[str, ...] = ()) -> st.SearchStrategy[dr.RodHistory]:
    """Any arrays on nodes that divide a rod evenly."""
    vectors = {name: arrays(np.float64, (n_t, n_s, 3), elements=doubles) for name in (*VECTORS, *velocities)}
    frames = arrays(np.float64, (n_t, n_s, 3, 3), elements=doubles)
    return st.builds(dr.RodHistory, s=st.just(np.linspace(0.0, rod.length, n_s)), frames=frames, **vectors)


@st.composite
def results(draw: st.DrawFn) -> dr.Result:
    """Any record of two rods."""
    t = np.array(sorted(draw(st.sets(st.floats(-1e9, 1e9), min_size=1, max_size=3))))
    moving = draw(st.sampled_from([(), VELOCITIES]))
    rods = tuple(draw(histories(rod, len(t), draw(st.integers(2, 3)), moving)) for rod in SCENE.rods)
    counts, seconds = st.integers(0, 10**9), st.floats(0.0, 1e9)
    return dr.Result(
        scene=SCENE,
        t=t,
        rods=rods,
        converged=draw(st.booleans()),
        log=tuple(draw(st.lists(st.builds(dr.StepLog, doubles, counts, counts, doubles, doubles), max_size=2))),
        energy={
            name: draw(arrays(np.float64, len(t), elements=doubles)) for name in (LEDGER if moving else ("strain",))
        },
        statistics=draw(st.builds(dr.Statistics, *[counts] * 4, *[seconds] * 3)),
        formulation=dr.Formulation("continuum", "spatial", {"r": 6}, ("Elasticity",), (draw(st.text()),)),
        state=draw(st.dictionaries(st.sampled_from("rqNm"), arrays(np.float64, (2, 1, 3), elements=doubles))),
    )


def touchings(s: Array, n_t: int) -> st.SearchStrategy[dr.Touching]:
    """Any arrays at the points of a rod."""
    lines, vectors = (arrays(np.float64, shape, elements=doubles) for shape in ((n_t, len(s)), (n_t, len(s), 3)))
    return st.builds(
        dr.Touching,
        s=st.just(s),
        share=arrays(np.float64, len(s), elements=st.floats(0.0, 1e9)),
        gap=lines,
        pressure=lines,
        normal=vectors,
        traction=vectors,
        slip=lines,
        state=arrays(np.int8, (n_t, len(s)), elements=st.integers(0, 2)),
    )


@st.composite
def touched(draw: st.DrawFn) -> dr.Result:
    """Any record of two rods of which a floor may touch both, a wall the second."""
    t = np.array(sorted(draw(st.sets(st.floats(-1e9, 1e9), min_size=1, max_size=3))))
    rods = tuple(draw(histories(rod, len(t), draw(st.integers(2, 3)))) for rod in LYING.rods)
    both, (_, second) = (tuple(draw(touchings(rod.s, len(t))) for rod in rods) for _ in range(2))
    return replace(
        lain(),
        t=t,
        rods=rods,
        energy={"strain": draw(arrays(np.float64, len(t), elements=doubles))},
        contacts=(dr.ContactHistory(both), dr.ContactHistory((None, second))),
    )


PILED = replace(
    LYING, contacts=[dr.RodContact(dr.Penalty(1e6, 5e-5), dr.Coulomb(0.3)), *LYING.contacts, dr.RodContact(rods=[1])]
)


def piled() -> dr.Result:
    """The rods of `lain`, of which the second also presses the first in two spots more and more, and itself nowhere."""
    result, none = lain(), rows(0)
    s = (np.array([[0.4], [0.6]]) + np.array([-1e-3, 0.0, 1e-3])).ravel()
    share = np.tile([0.5e-3, 1e-3, 0.5e-3], 2)
    once = rows(6)
    up, along = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
    spots = replace(
        once,
        rod_a=np.ones(6, dtype=np.int64),
        s_a=s - 0.2,
        s_b=s,
        point=np.outer(s, along),
        gap=np.full(6, -1e-5),
        length=share,
        normal=np.tile(up, (6, 1)),
        state=np.repeat([1, 2], 3).astype(np.int8),
    )
    press = np.outer(1e3 * share, up)
    rub = np.outer(1e3 * share * np.repeat([0.1, 0.3], 3), along)
    times = [none, *(replace(spots, force=f * (press + rub), traction=f * rub) for f in (0.5, 1.0))]
    meetings = (dr.MeetingHistory(tuple(times)), dr.MeetingHistory((none,) * 3))
    return replace(result, scene=PILED, meetings=meetings)


def rows(n: int) -> dr.Meetings:
    """Rows of zeros."""
    line, vectors, whole = np.zeros(n), np.zeros((n, 3)), np.zeros(n, dtype=np.int64)
    two = {"rod_a": whole, "s_a": line, "rod_b": whole, "s_b": line, "point": vectors, "gap": line, "length": line}
    return dr.Meetings(**two, force=vectors, normal=vectors, traction=vectors, state=np.zeros(n, dtype=np.int8))


@st.composite
def meetings_of(draw: st.DrawFn, rods: tuple[int, ...]) -> dr.Meetings:
    """Any rows of some of the rods of `PILED`."""
    n = draw(st.integers(0, 3))
    among = arrays(np.int64, n, elements=st.sampled_from(rods))
    lines, vectors = (arrays(np.float64, shape, elements=doubles) for shape in (n, (n, 3)))
    places = arrays(np.float64, n, elements=st.floats(0.0, 0.5))
    return draw(
        st.builds(
            dr.Meetings,
            rod_a=among,
            s_a=places,
            rod_b=among,
            s_b=places,
            point=vectors,
            gap=lines,
            length=arrays(np.float64, n, elements=st.floats(0.0, 1e9)),
            force=vectors,
            normal=vectors,
            traction=vectors,
            state=arrays(np.int8, n, elements=st.integers(0, 2)),
        )
    )


@st.composite
def met(draw: st.DrawFn) -> dr.Result:
    """Any record of two rods that touch one another, surfaces, or themselves."""
    result = draw(touched())
    kinds = ((0, 1), (1,))
    meetings = tuple(dr.MeetingHistory(tuple(draw(meetings_of(rods)) for _ in result.t)) for rods in kinds)
    return replace(result, scene=PILED, meetings=meetings)


def shortened(result: dr.Result, states: slice) -> dr.Result:
    """The same with some of its stored states only."""
    rods = tuple(
        replace(rod, **{name: getattr(rod, name)[states] for name in (*VECTORS, "frames")}) for rod in result.rods
    )
    energy = {name: values[states] for name, values in result.energy.items()}
    return replace(result, t=result.t[states], rods=rods, energy=energy)


def identical(a: object, b: object) -> bool:
    """Whether two records hold the same kinds of things and the same doubles."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if type(a) is not type(b):
        return False
    if isinstance(a, dr.Scene) or not (is_dataclass(a) or isinstance(a, (dict, tuple))):
        return a == b
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(identical(a[key], b[key]) for key in a)
    if isinstance(a, tuple):
        return len(a) == len(b) and all(map(identical, a, b))
    return all(identical(getattr(a, field.name), getattr(b, field.name)) for field in fields(a))
