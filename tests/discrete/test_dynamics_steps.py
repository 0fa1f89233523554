"""Steps in time: where they land, how long they are, what is kept of them, how they fail and go on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
from dolfinrod.result import NotConverged, StepLog
from dolfinrod.scene import (
    Clamp,
    Dynamic,
    Midpoint,
    PointForce,
    Prescribed,
    Rod,
    Scene,
    SceneError,
    Section,
    Static,
    Velocity,
)
from tests.scenes import FLAT, largest

HEAVY = Section(EA=900.0, GA=400.0, GJ=0.7, EI=(2.0, 1.0), rhoA=1.0, rhoI=(0.003, 0.002, 0.001))


def pushed(motion: Dynamic | Static, force: float = 1.0, history: object = None, damping: float = 0.0) -> Scene:
    """A cantilever under a force across it."""
    load = PointForce((0.1 * force, force, -0.3 * force), "end", history=history)
    return Scene([FLAT.straight(replace(HEAVY, damping=damping))], [Clamp("start")], [load], motion=motion)


def test_what_the_model_does_not_know_is_refused():
    scene = pushed(Dynamic(0.1, 0.01))
    with pytest.raises(
        SceneError, match=r"motion\.scheme must be ImplicitEuler\(\), discrete knows ImplicitEuler only"
    ):
        discrete.solve(pushed(Dynamic(0.1, 0.01, scheme=Midpoint())), elements=2)
    with pytest.raises(SceneError, match='rotation must be "exponential" or "added", got \'quaternion\''):
        discrete.solve(scene, elements=2, rotation="quaternion")
    with pytest.raises(SceneError, match='end_mass must be "half" or "paper", got 1'):
        discrete.solve(scene, elements=2, end_mass=1)
    with pytest.raises(SceneError, match="equilibrium must be True"):
        discrete.solve(scene, elements=2, equilibrium=False)
    with pytest.raises(SceneError, match=r'rods\[0\]\.section\.damping must be 0 s where frame is "node_i"'):
        discrete.solve(pushed(Dynamic(0.1, 0.01), damping=0.1), elements=2, frame="node_i")


@pytest.mark.parametrize("steps", [{"dt": 0.03}, {"tol": 1e-3}], ids=["fixed", "free"])
def test_steps_land_on_kinks_and_on_output_times(steps):
    scene = pushed(Dynamic(0.5, **steps, output=(0.11, 0.4)), history=((0.0, 0.0), (0.2, 1.0), (0.31, 0.5)))
    landed: list[float] = []
    result = discrete.solve(scene, elements=4, progress=lambda row, _: landed.append(row.t))
    assert result.t.tolist() == [0.0, 0.11, 0.4, 0.5]
    assert {0.11, 0.2, 0.31, 0.4, 0.5} <= set(landed)
    assert [row.t for row in result.log] == landed
    assert result.statistics.load_steps == len(landed)
    assert result.energy["kinetic"].shape == (4,)


def test_output_at_a_period():
    result = discrete.solve(pushed(Dynamic(0.3, 0.03, output=0.1)), elements=4)
    assert result.t == pytest.approx([0.0, 0.1, 0.2, 0.3])
    assert len(result.log) == 12


def test_steps_of_free_length_keep_to_the_tolerance():
    """The error of a step is ½ Δt² a, so that steps are ∝ √tol, and so is the error at the end."""
    fine = discrete.solve(pushed(Dynamic(0.3, 2e-3, output=0.3)), elements=3).tip
    finer = discrete.solve(pushed(Dynamic(0.3, 1e-3, output=0.3)), elements=3).tip
    exact = 2 * finer - fine
    counts, errors = [], []
    for tol in (1e-2, 1e-3, 1e-4):
        result = discrete.solve(pushed(Dynamic(0.3, tol=tol)), elements=3)
        counts.append(len(result.log))
        errors.append(np.linalg.norm(result.tip - exact))
    assert counts[0] < counts[1]
    assert counts[2] / counts[1] == pytest.approx(np.sqrt(10.0), rel=0.3)
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 0.2 * errors[0]


def test_a_step_that_cannot_be_taken_is_halved():
    """A clamp that turns by 4 rad in a step: half of it is told from the other way round."""
    turn = Prescribed("start", (0, 0, 0), (0, 0, 4.0), history=lambda t: t)
    scene = Scene([FLAT.straight(HEAVY)], [turn], motion=Dynamic(1.0, 1.0))
    result = discrete.solve(scene, elements=6)
    assert result.log[0].cuts >= 1
    assert result.log[0].t <= 0.5
    assert result.t[-1] == 1.0
    assert result.rods[0].frames[-1, 0, :, 0] == pytest.approx([np.cos(4.0), np.sin(4.0), 0.0])
    assert result.rods[0].omega[-1, 0] == pytest.approx([0, 0, 4.0])


def test_what_was_reached_is_kept():
    """A support that jumps by more than half a turn: no step however short tells which way."""
    jump = Prescribed("end", None, (0, 0, 10.0), history=lambda t: float(t > 0.05))
    scene = Scene([FLAT.straight(HEAVY)], [Clamp("start"), jump], motion=Dynamic(0.1, 0.02, output=(0.1,)))
    with pytest.raises(NotConverged, match="a support turns by about half a turn or more in one step") as caught:
        discrete.solve(scene, elements=4)
    failure = caught.value
    assert not failure.result.converged
    assert 0.04 <= failure.t <= 0.05
    assert failure.result.t[-1] == failure.t
    assert failure.result.rods[0].r.shape == (2, 5, 3)
    assert "Dynamic(dt=0.002)" in failure.advice


def test_an_interrupted_run_goes_on_to_the_same_answer():
    scene = pushed(Dynamic(0.3, 0.01, output=0.3), damping=0.01)

    def interrupt(row: StepLog, _: float) -> None:
        if row.t > 0.125:
            raise KeyboardInterrupt

    with pytest.raises(NotConverged, match="interrupted by the user") as caught:
        discrete.solve(scene, elements=6, progress=interrupt)
    reached = caught.value.result
    assert reached.t.tolist() == [0.0, 0.13]
    whole, rest = discrete.solve(scene, elements=6), discrete.solve(scene, elements=6, start=reached)
    assert rest.t.tolist() == [0.13, 0.3]
    assert rest.rods[0].r[-1] == pytest.approx(whole.rods[0].r[-1], abs=1e-9)
    assert rest.rods[0].v[-1] == pytest.approx(whole.rods[0].v[-1], abs=1e-7)
    for name, values in whole.energy.items():
        assert rest.energy[name][-1] == pytest.approx(values[-1], abs=1e-8)


def test_an_interrupted_equilibrium_keeps_what_was_reached():
    def interrupt(row: StepLog, _: float) -> None:
        if row.t > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(NotConverged, match=r"interrupted by the user.*goes on from there") as caught:
        discrete.solve(pushed(Static(steps=4)), elements=4, progress=interrupt)
    assert caught.value.result.t.tolist() == [0.0, 0.25, 0.5, 0.75]


def test_a_sudden_release_starts_from_the_equilibrium():
    bent = discrete.solve(pushed(Static()), elements=6)
    free = Scene([FLAT.straight(HEAVY)], [Clamp("start")], motion=Dynamic(0.5, 0.005))
    result = discrete.solve(free, elements=6, start=bent)
    assert result.rods[0].r[0] == pytest.approx(bent.rods[0].r[-1], abs=1e-14)
    assert result.energy["strain"][0] == pytest.approx(bent.energy["strain"][-1], rel=1e-9)
    assert result.energy["kinetic"][0] == 0.0
    assert result.energy["kinetic"].max() > 0.5 * result.energy["strain"][0]


@pytest.mark.parametrize("dt", [1e-8, 1e-6, 1e-4, 1e-2, 1e-1])
def test_every_step_from_round_off_to_quasi_statics(dt):
    """The paper's fibre under its weight with 20 steps of each length; none is lost, the ledger closes."""
    fibre = Rod.straight(0.04, Section.ramie(), start=(0, 0, 0), direction=(1, 0, 0))
    load = PointForce((0, 1e-7, -1e-7), "end")
    result = discrete.solve(Scene([fibre], [Clamp("start")], [load], motion=Dynamic(20 * dt, dt)), elements=20)
    e = result.energy
    stored = sum(e[name] - e[name][0] for name in ("kinetic", "strain", "potential"))
    works = sum(e[name] for name in ("load work", "support work", "drag", "damping", "numerical"))
    assert largest(stored - works) <= 1e-9 * largest(e["load work"])
    assert e["load work"][-1] > 0.0
    assert e["numerical"][-1] < 0.0


@pytest.mark.parametrize(("rhoA", "slenderness"), [(1e-12, 10.0), (1.0, 2000.0)])
def test_a_step_as_hard_as_an_equilibrium_is_taken(rhoA, slenderness):
    """Inertia next to nothing, or 1e5 times the explicit limit of a slender rod, under a sudden force of 10 EI/L²."""
    section = Section(EA=16 * slenderness**2, GA=1.0, GJ=0.8, EI=1.0, rhoA=rhoA)
    load = PointForce((0, 10.0, 3.0), "end")
    scene = Scene([FLAT.straight(section)], [Clamp("start")], [load], motion=Dynamic(0.5, 0.1))
    result = discrete.solve(scene, elements=10)
    assert [row.cuts for row in result.log] == [0] * 5
    if rhoA < 1.0:
        still = discrete.solve(replace(scene, motion=Static()), elements=10)
        assert result.tip == pytest.approx(still.tip, abs=1e-7)


def test_a_whip_survives():
    """A slender rod flung around by its end, 2000 times longer than thick."""
    EA = 16.0 * 2000.0**2
    section = Section(EA=EA, GA=EA, GJ=0.8, EI=1.0, rhoA=1.0)
    nip = Prescribed("start", (0, 0, 0), (0, 0, 6.0), history=lambda t: 1.0 - np.cos(3.0 * t))
    scene = Scene([FLAT.straight(section)], [nip], motion=Dynamic(1.0, 0.02), velocities=[Velocity(v=(0, 0, 0.1))])
    result = discrete.solve(scene, elements=20)
    assert result.converged
    assert largest(result.rods[0].v[-1]) > 1.0
