"""Motions that end when nothing moves much any more."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.conftest import world

SECTION = dr.Section(EI=50.0, GJ=40.0, EA=5e3, rhoA=1.0, rhoI=(2e-3, 1e-3, 1e-3), rigid={"shear"})
REST, DT = 1.5, 0.02
MODELS = {
    "planar": partial(dr.solve, elements=1, degree=3, kinematics=dr.Planar()),
    "spatial": partial(dr.solve, elements=1, degree=3, kinematics=dr.Spatial()),
    "discrete": partial(discrete.solve, elements=3),
}
every_model = pytest.mark.parametrize("solve", MODELS.values(), ids=MODELS)


def swing(rest: float | None, t_end: float = 3.0, **steps: float) -> dr.Scene:
    """A stiff rod that falls from the horizontal and comes up on the other side, where it is slow."""
    motion = dr.Dynamic(t_end, **(steps or {"dt": DT}), output=0.1, rest=rest)
    rod = dr.Rod.straight(1.0, SECTION)
    return dr.Scene([rod], [dr.Pin("start")], [dr.Gravity((0.0, -9.81, 0.0))], motion=motion)


def speeds(result: dr.Result) -> np.ndarray:
    """Of the fastest node at stored times."""
    return np.linalg.norm(result.rods[0].v, axis=2).max(axis=1)


@every_model
@pytest.mark.parametrize("steps", [{"dt": DT}, {"tol": 1e-4}], ids=["fixed", "free"])
def test_a_motion_ends_with_the_step_that_makes_it_slow(solve, steps):
    ended, on = solve(swing(REST, **steps)), solve(swing(None, **steps))
    assert ended.converged
    # It began slower than that, and swings for 0.6 s until it comes to rest.
    assert 0.5 < ended.t[-1] < 0.95
    assert ended.log[-1].t == ended.t[-1]
    assert speeds(ended)[-1] < REST <= speeds(ended)[-2]
    assert on.t[-1] == 3.0
    same = ended.t[:-1]
    assert np.array_equal(on.t[: len(same)], same)
    assert np.array_equal(on.rods[0].r[: len(same)], ended.rods[0].r[:-1])
    step = next(log for log in on.log if log.t == ended.t[-1])
    assert (step.iterations, step.energy) == (ended.log[-1].iterations, ended.log[-1].energy)


@every_model
def test_what_has_come_to_rest_is_over(solve, shared_path):
    file = shared_path / "swing.h5"
    ended = solve(swing(REST), checkpoint=file)
    again = solve(swing(REST), checkpoint=file)
    assert np.array_equal(again.t, ended.t)
    assert np.array_equal(again.rods[0].r, ended.rods[0].r)
    with pytest.raises(dr.SceneError, match=r"motion\.rest was 1\.5 and is 0\.75"):
        solve(swing(0.5 * REST), checkpoint=file)


@every_model
def test_interrupted_it_ends_where_it_would_have(solve, shared_path):
    def stop(step: dr.StepLog, _t_end: float) -> None:
        if step.t > 0.4:
            raise KeyboardInterrupt

    file = shared_path / "swing.h5"
    with pytest.raises(dr.NotConverged):
        solve(swing(REST), checkpoint=file, progress=stop)
    assert solve(swing(REST), checkpoint=file).t[-1] == solve(swing(REST)).t[-1]


def test_a_speed_that_is_none_is_refused():
    with pytest.raises(dr.SceneError, match=r"Dynamic\.rest must be positive, got -1\.0 m/s"):
        dr.Dynamic(1.0, rest=-1.0)


def test_ranks_agree_on_the_end():
    ended = MODELS["spatial"](replace(swing(REST)), elements=4)
    comm = world()
    assert len({ended.t[-1]} if comm is None else set(comm.allgather(ended.t[-1]))) == 1
    assert ended.t[-1] < 1.0
