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
