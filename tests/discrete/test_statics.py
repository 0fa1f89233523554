"""Laws of equilibrium: balance, objectivity, paths, several rods, failures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

import discrete
from dolfinrod.result import NotConverged
from dolfinrod.scene import (
    Clamp,
    FollowerForce,
    FollowerMoment,
    Gravity,
    LineForce,
    PointForce,
    PointMoment,
    Rod,
    Scene,
    SceneError,
    Section,
    Static,
)
from tests.scenes import FLAT, GENERAL, KIRCHHOFF, SKEW, Pose, cantilever, differences, largest, poses

HEAVY = Section(EA=900.0, GA=400.0, GJ=0.7, EI=(1.0, 2.0), rhoA=0.5)


def loaded_in_every_way(pose: Pose, motion: Static | None = None) -> Scene:
    """A curved, pretwisted rod under all kinds of loads, some of them between its ends."""
    rod = Rod.curved(
        1.0, HEAVY, (0.4, 0.5, 1.0), pose.placed((0, 0, 0)), pose.turned((1, 0, 0)), pose.turned((0, 1, 0)), 0.9
    )
    return cantilever(
        rod,
        PointForce(pose.turned((0.5, 1.0, -1.0)), "end"),
        PointMoment(pose.turned((0.2, -0.3, 0.4)), 0.37),
        FollowerForce((0.0, 0.7, -0.4), 0.61),
        FollowerMoment((0.3, 0.0, 0.5), "end"),
        LineForce(pose.turned((0.0, 0.3, 1.5)), between=(0.2, 0.8)),
        Gravity(pose.turned((0.0, -1.0, 0.0))),
        motion=motion,
    )


@settings(max_examples=10)
@given(poses())
def test_a_moved_scene_has_the_moved_answer(pose):
    here = discrete.solve(loaded_in_every_way(FLAT), elements=12).rods[0]
    there = discrete.solve(loaded_in_every_way(pose), elements=12).rods[0]
    assert pose.back(there.r[-1]) == pytest.approx(here.r[-1], abs=1e-10)
    assert pose.Q.T @ there.frames[-1] == pytest.approx(here.frames[-1], abs=1e-10)
    assert there.m[-1] == pytest.approx(here.m[-1], abs=1e-9)
    assert there.n[-1] == pytest.approx(here.n[-1], abs=1e-8)


def test_forces_and_moments_balance_about_the_clamp():
    """What the clamp answers is the sum of all loads on the deformed rod; line loads act through the nodes."""
    scene = loaded_in_every_way(SKEW)
    h = discrete.solve(scene, elements=30).rods[0]
    r, R = h.r[-1], h.frames[-1]
    _, moment, pushed, twisted, line, weight = scene.loads
    at = {s: int(np.argmin(np.abs(h.s - s))) for s in (0.37, 0.61)}
    nodal = np.zeros_like(r)
    nodal[-1] += scene.loads[0].force
    nodal[at[0.61]] += R[at[0.61]] @ pushed.force
    lengths = np.diff(h.s)
    middle = 0.5 * (h.s[1:] + h.s[:-1])
    per_length = np.where((middle > 0.2) & (middle < 0.8), 1.0, 0.0)[:, None] * line.force + 0.5 * np.array(weight.g)
    half = 0.5 * lengths[:, None] * per_length
    nodal[:-1] += half
    nodal[1:] += half
    couples = np.array(moment.moment) + R[-1] @ twisted.moment
    reaction = R[0] @ h.n[-1, 0]
    assert reaction == pytest.approx(nodal.sum(axis=0), abs=1e-9)
    assert R[0] @ h.m[-1, 0] == pytest.approx(couples + np.cross(r - r[0], nodal).sum(axis=0), abs=1e-9)


def test_number_of_steps_does_not_matter():
    states = [discrete.solve(loaded_in_every_way(SKEW, Static(steps=k)), elements=12) for k in (1, 8, 20)]
    assert [s.statistics.load_steps for s in states] == [1, 8, 20]
    # Follower loads and dead moments are in the tangent: convergence is quadratic.
    assert states[0].statistics.newton_iterations <= 7
    for other in states[1:]:
        assert largest(list(differences(states[0], other).values())) < 1e-10


@pytest.mark.parametrize("frame", ["element", "node_i"])
def test_closed_load_path_returns(frame):
    path = ((0.0, 0.0), (1.0, 1.0), (2.0, -0.5), (3.0, 0.0))
    loads = (
        PointForce(SKEW.turned((0.0, 4.0, 3.0)), "end", history=path),
        PointMoment(SKEW.turned((1.0, 2.0, 0.0)), "end", history=path),
    )
    scene = cantilever(SKEW.straight(GENERAL), *loads, motion=Static(t_end=3.0))
    result = discrete.solve(scene, elements=10, frame=frame)
    h = result.rods[0]
    assert result.t.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert h.r[-1] == pytest.approx(h.r[0], abs=1e-10)
    assert h.frames[-1] == pytest.approx(h.frames[0], abs=1e-10)
    assert largest(h.r[1] - h.r[0]) > 0.5


@pytest.mark.parametrize("equilibrium", [True, False])
@pytest.mark.parametrize("frame", ["element", "node_i"])
def test_nothing_drifts_without_load(frame, equilibrium):
    """A curved and pretwisted rod is free of stress as it is, however often that is found out."""
    rod = Rod.curved(1.0, GENERAL, (0.4, 2.0, 1.0), pretwist=3.0)
    scene = Scene([rod], [Clamp("start")], motion=Static(steps=50))
    result = discrete.solve(scene, elements=10, frame=frame, equilibrium=equilibrium)
    h = result.rods[0]
    assert h.r[-1] == pytest.approx(rod.centerline(h.s), abs=1e-13)
    assert h.frames[-1] == pytest.approx(rod.frames(h.s), abs=1e-13)
    assert largest(h.m) < 1e-10
    assert result.energy["strain"] == pytest.approx(np.zeros(51), abs=1e-20)


def test_rods_of_one_scene_do_not_know_each_other():
    one = Rod.straight(1.0, GENERAL)
    two = Rod.arc(2.0, 0.4, KIRCHHOFF, start=(0.0, 3.0, 0.0))
    load = PointForce((0.3, 1.0, -0.5), "end")
    both = discrete.solve(Scene([one, two], [Clamp("start")], [load]), elements=(9, 14))
    for rod, n, h in zip((one, two), (9, 14), both.rods, strict=True):
        alone = discrete.solve(Scene([rod], [Clamp("start")], [load]), elements=n).rods[0]
        assert h.r[-1] == pytest.approx(alone.r[-1], abs=1e-9)
        assert h.m[-1] == pytest.approx(alone.m[-1], abs=1e-7)


def test_strain_energy_is_the_work_of_a_proportional_load():
    """dU = F·dr along the path, by the trapezoidal rule on the stored states."""
    scene = cantilever(SKEW.straight(GENERAL), PointForce(SKEW.turned((0, 2, 1)), "end"), motion=Static(steps=40))
    result = discrete.solve(scene, elements=8)
    along = result.rods[0].r[:, -1] @ np.array(scene.loads[0].force)
    work = 0.5 * float((result.t[1:] + result.t[:-1]) @ np.diff(along))
    assert result.energy["strain"][-1] == pytest.approx(work, rel=1e-3)
    assert [row.energy for row in result.log] == pytest.approx(result.energy["strain"][1:])


def test_an_earlier_result_is_a_first_guess():
    scene = cantilever(SKEW.straight(GENERAL), PointForce(SKEW.turned((0, 5, 1)), "end"))
    first = discrete.solve(scene, elements=10)
    again = discrete.solve(scene, elements=10, start=first)
    assert again.statistics.newton_iterations == 1
    assert largest(list(differences(first, again).values())) < 1e-10
    with pytest.raises(SceneError, match="on the same elements"):
        discrete.solve(scene, elements=11, start=first)
    with pytest.raises(SceneError, match="start must be None"):
        discrete.solve(scene, elements=10, start=first, equilibrium=False)


def test_stepping_goes_on_where_an_earlier_result_of_the_scene_ended():
    load = PointForce(SKEW.turned((0, 5, 1)), "end", history=((0.0, 0.0), (1.0, 1.0)))
    scene = cantilever(SKEW.straight(GENERAL), load)
    half = discrete.solve(replace(scene, motion=Static(t_end=0.5)), elements=10)
    rest = discrete.solve(scene, elements=10, start=replace(half, scene=scene))
    assert rest.t.tolist() == [0.5, 1.0]
    assert rest.rods[0].r[0] == pytest.approx(half.rods[0].r[-1], abs=1e-15)
    assert largest(list(differences(discrete.solve(scene, elements=10), rest).values())) < 1e-10


@pytest.mark.parametrize("equilibrium", [True, False])
def test_what_is_free_to_move_is_said_and_nothing_is_lost(equilibrium):
    scene = Scene([Rod.straight(1.0, GENERAL)], [], [FollowerMoment((0, 0, 1), "end")])
    with pytest.raises(NotConverged, match=r"rods\[0\] is held nowhere") as failure:
        discrete.solve(scene, elements=4, equilibrium=equilibrium)
    assert failure.value.t == 0.0
    assert not failure.value.result.converged
    assert failure.value.result.rods[0].r.shape == (1, 5, 3)


def test_load_is_cut_and_restored_where_it_must_be():
    """A history with a jump too large for one step: it is halved on failure and doubled after success."""
    seen = []
    scene = cantilever(Rod.straight(1.0, KIRCHHOFF), PointMoment((0, 0, 200.0), "end"))
    result = discrete.solve(scene, elements=100, progress=lambda step, end: seen.append((step, end)))
    assert sum(step.cuts for step in result.log) > 0
    assert result.statistics.newton_iterations > sum(step.iterations for step in result.log)
    assert [step for step, _ in seen] == list(result.log)
    assert {end for _, end in seen} == {1.0}
    assert result.rods[0].m[-1] == pytest.approx(np.tile([0, 0, 200.0], (101, 1)), abs=1e-6)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"axial": "Chord"}, 'axial must be "chord" or "paper"'),
        ({"frame": "mid"}, 'frame must be "element" or "node_i"'),
        ({"elements": 0}, "elements must be a whole number of at least 1"),
        ({"elements": (4, 4)}, "elements must be one number or one for each of the 1 rods"),
        ({"elements": 1}, "elements must be at least 2"),
    ],
)
def test_wrong_options_are_refused_in_words(options, message):
    scene = cantilever(Rod.straight(1.0, GENERAL), PointForce((0, 1, 0), 0.5))
    with pytest.raises(SceneError, match=message):
        discrete.solve(scene, **options)


def test_model_does_not_depend_on_units():
    """A fibre of 20 µm and the same rod in units of L and EI: one shape."""
    fibre = Section.ramie()
    L, EI = 0.04, fibre.EI[0]
    small = cantilever(Rod.straight(L, fibre), PointForce((0, 10 * EI / L**2, 0), "end"))
    unit = Section(EA=fibre.EA * L**2 / EI, GA=1.0, GJ=fibre.GJ / EI, EI=1.0)
    large_ = cantilever(Rod.straight(1.0, unit), PointForce((0, 10.0, 0), "end"))
    a, b = discrete.solve(small, elements=20), discrete.solve(large_, elements=20)
    assert a.rods[0].r[-1] / L == pytest.approx(b.rods[0].r[-1], abs=1e-12)
    assert a.statistics.newton_iterations == b.statistics.newton_iterations == 5
