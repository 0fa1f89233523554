"""Steps find their own size: many turns, aliasing, helices, paths that do not matter."""

from __future__ import annotations

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from discrete import equilibrium
from discrete.failure import advice, rounding
from discrete.mesh import mesh
from discrete.predictor import Memory
from discrete.solver import beginning
from discrete.statics import StepFailed
from tests.scenes import FLAT, KIRCHHOFF, SKEW, differences, followed, largest, rolled_up, tip_loaded

# Case E: the helical form of Ibrahimbegovic 1997 with EA = GA = 1e4.
HELIX = dr.Section(EA=1e4, GA=1e4, GJ=100.0, EI=100.0)


def helix(steps: int | None = None, factor: float = 1.0) -> dr.Scene:
    """A share of the loads of case E."""
    loads = [dr.PointForce((0, 0, factor * 50.0), "end"), dr.PointMoment((0, 0, factor * 200 * np.pi), "end")]
    return dr.Scene([dr.Rod.straight(10.0, HELIX)], [dr.Clamp("start")], loads, motion=dr.Static(steps=steps))


def twisted(turns: float) -> dr.Scene:
    supports = [dr.Clamp("start"), dr.Prescribed("end", displacement=(0, 0, 0), rotation=(2 * np.pi * turns, 0, 0))]
    return dr.Scene([FLAT.straight(KIRCHHOFF)], supports)


def test_ten_turns_take_one_step_and_few_iterations():
    result = discrete.solve(rolled_up(KIRCHHOFF, 10, FLAT))
    assert result.statistics.load_steps == 1
    assert result.statistics.newton_iterations <= 50
    assert result.tip == pytest.approx(np.zeros(3), abs=1e-10)


def test_ten_turns_in_space_where_round_off_leads_astray():
    result = discrete.solve(rolled_up(KIRCHHOFF, 10, SKEW))
    assert result.statistics.load_steps <= 3
    assert result.statistics.newton_iterations <= 90
    assert SKEW.back(result.tip) == pytest.approx(np.zeros(3), abs=1e-10)


def test_ten_turn_helix_needs_no_hand_holding():
    """Issue 4: ≤ 40 steps and ≤ 300 iterations, failed attempts included. Without shear u_z lacks F L/GA = 0.05.

    How near the discrete one comes: 1.6e-3 on 160 elements, a sixteenth of a turn each.
    """
    result = discrete.solve(helix(), elements=160)
    assert result.statistics.load_steps <= 6
    assert result.statistics.newton_iterations <= 100
    exact = np.array([0.00480324964971212, 7.24968465382423e-05, -0.07644174175446661 - 0.05])
    assert result.tip == pytest.approx(exact, abs=2e-3)


def test_the_end_of_the_helix_does_not_depend_on_the_steps():
    ends = [discrete.solve(helix(steps), elements=80) for steps in (None, 9)]
    for other in ends[1:]:
        assert largest(list(differences(ends[0], other).values())) < 1e-9


def test_twenty_turns_of_twist_are_twenty_and_not_fewer():
    result = discrete.solve(twisted(20.0), elements=80)
    assert result.rods[0].m[-1, :, 0] == pytest.approx(40 * np.pi / 1.3, rel=1e-9)


@pytest.mark.parametrize("scene", [twisted(20.0), rolled_up(KIRCHHOFF, 10, FLAT)], ids=["twist", "roll-up"])
def test_what_an_element_cannot_tell_is_refused_not_swallowed(scene):
    """Two turns an element, or one: the last equilibrium has less than half a turn in each."""
    with pytest.raises(dr.NotConverged, match="more elements") as failure:
        discrete.solve(scene, elements=10)
    rod = failure.value.result.rods[0]
    assert 0.2 * np.pi < largest(rod.kappa[-1]) / 10 < np.pi
    assert failure.value.t > 0.2


def test_kinks_are_met_and_never_stepped_over():
    """A load reversed within a short time; every time in a table is a time of the path, whatever lies between."""
    history = ((0.0, 0.0), (0.3, 1.0), (0.35, -1.0), (1.0, 0.5))
    load = dr.PointForce(SKEW.turned((0.0, 8.0, 2.0)), "end", history=history)
    scene = dr.Scene([SKEW.straight(KIRCHHOFF)], [dr.Clamp("start")], [load])
    result = discrete.solve(scene, elements=10)
    assert {0.0, 0.3, 0.35, 1.0} <= set(result.t.tolist())
    assert result.statistics.load_steps <= 10


def test_extrapolated_shapes_are_rotations_and_exact_for_even_growth():
    """Constant curvature grows evenly under an end moment: the guess is the answer, over turns of 4π."""
    phase, path = beginning(rolled_up(KIRCHHOFF, 4, SKEW), 40, None)
    memory = Memory(phase.equilibrium, 0.0, path.state)
    assert memory.ahead(1.0) is None
    memory.add(0.5, phase.find(path.state, 0.5).state)
    guess = memory.ahead(1.0)
    assert guess.turned == pytest.approx(4 * np.pi)
    assert guess.state.x[-1] == pytest.approx(np.zeros(3), abs=1e-9)
    products = np.swapaxes(guess.state.R, 1, 2) @ guess.state.R
    assert products == pytest.approx(np.tile(np.eye(3), (41, 1, 1)), abs=1e-13)
    assert phase.find(guess.state, 1.0).iterations <= 3
    memory.forget()
    assert memory.ahead(1.0) is None


def test_small_steps_end_where_large_ones_do():
    """Extrapolation adds nothing of its own, however often it is done."""
    ends = [discrete.solve(helix(steps, 0.05), elements=40) for steps in (1, 25)]
    assert largest(list(differences(*ends).values())) < 1e-9


def test_a_mechanism_is_named():
    torque = dr.FollowerMoment((1.0, 0.0, 0.0), "end")
    supports = [dr.Pin("start"), dr.Guide("end", free={"x", "rx", "ry", "rz"})]
    with pytest.raises(dr.NotConverged, match="Likely a mechanism"):
        discrete.solve(dr.Scene([FLAT.straight(KIRCHHOFF)], supports, [torque]), elements=10)


def test_loads_that_few_elements_cannot_resolve_are_named():
    """A follower of 1000 EI/L² bends a rod within 0.03 L; here an element is 0.25 L long."""
    with pytest.raises(dr.NotConverged, match="Likely too few elements for such loads") as failure:
        discrete.solve(followed(KIRCHHOFF, 1e3, FLAT), elements=4)
    assert failure.value.result.log[-1].t == failure.value.t > 0.0


def test_meshes_too_fine_for_double_precision_are_named(monkeypatch):
    """A linear answer is off by as many digits as are foretold, one more or less; where none is left, that is said."""
    monkeypatch.setattr(equilibrium, "MOST_ITERATIONS", 1)
    P, scene, failure = 1e-3, tip_loaded(KIRCHHOFF, 1e-3, FLAT), StepFailed(t=0.0, step=1.0, reason="")
    for n in (2_000, 5_000, 10_000):
        phase, path = beginning(scene, n, None)
        tip = phase.find(path.state, 1.0).state.x[-1, 1]
        cut = mesh(scene, n)
        assert 0.05 < abs(tip / (P / 3.0) - 1.0) / rounding(cut) < 20.0
        assert "too many" not in advice(scene, cut, failure, ())
    told = advice(scene, mesh(scene, 40_000), failure, ())
    assert told.startswith("Likely too many elements for double precision")
