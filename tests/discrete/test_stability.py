"""Stability flags: what is counted below and above critical loads, and which branch a path ends on."""

from __future__ import annotations

import time

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from discrete.equilibrium import Equilibrium
from discrete.inertia import blocks, negative_directions
from discrete.loads import Loads
from discrete.mesh import mesh
from discrete.neutral import PhaseCondition
from discrete.solver import beginning
from discrete.stability import Judge
from tests.discrete.test_buckling import ENDS, EULER, column
from tests.discrete.test_twist import FIRST, LATER, greenhill
from tests.scenes import FLAT, KIRCHHOFF, SKEW, followed, largest, rolled_up, tip_loaded


def directions(scene: dr.Scene, elements: int) -> int | None:
    """Directions in which the equilibrium at the end of one step gives way."""
    phase, path = beginning(scene, elements, None)
    found = phase.find(path.state, scene.motion.t_end)
    assert found.converged
    return Judge(scene, phase.equilibrium.mesh).verdict(found.tangent, found.state.R).directions


@pytest.mark.parametrize("ends", ENDS)
def test_two_directions_give_way_at_each_load_of_a_round_column(ends):
    """The loads are those of the mesh; just below and just above the first two of them."""
    critical = np.unique(np.round(discrete.buckling(column(ENDS[ends]), modes=4, elements=20).factors, 6))
    for k, P in enumerate(critical):
        below, above = (directions(column(ENDS[ends], force=P * f), 20) for f in (1 - 1e-4, 1 + 1e-4))
        assert (below, above) == (2 * k, 2 * k + 2)


@pytest.mark.parametrize("elements", [1, 2, 7, 300])
def test_the_count_does_not_depend_on_the_mesh(elements):
    """Neither odd numbers of nodes nor many elements: clamped–free, first load 2.47, one element 3."""
    assert [directions(column(ENDS["clamped-free"], force=P), elements) for P in (2.4, 3.1)] == [0, 2]


def test_what_round_off_makes_of_too_many_elements_is_not_called_unstable():
    """Of a cantilever on 10⁴ elements n⁴ ε is 2; a column of 2000 gives way as ever."""
    section = dr.Section(EA=16.0 * 200.0**2, GJ=1.0 / 1.3, EI=1.0, rigid={"shear"})
    results = [discrete.solve(tip_loaded(section, 1.0, FLAT), elements=n) for n in (2000, 7000, 10_000)]
    found = [result.log[-1].stable for result in results]
    # Which of True and None it is beyond, round-off decides.
    assert found[0]
    assert False not in found
    told = [any("stability not told" in note for note in result.formulation.notes) for result in results]
    assert told == [stable is None for stable in found]
    assert np.linalg.norm(results[0].rods[0].r[-1, -1] - results[-1].rods[0].r[-1, -1]) < 1e-7
    assert [directions(column(ENDS["clamped-free"], force=P), 2000) for P in (2.4, 2.6)] == [0, 2]


def test_a_strip_has_one_direction_a_plane():
    section = dr.Section(GJ=1.0, EI=(1.0, 3.0), rigid={"shear", "extension"})
    scenes = [column(ENDS["pinned"], section, P) for P in (9.8, 10.0, 29.4, 29.9, 39.9)]
    # π² EI₂, 3π² EI₂ about the stiff axis, 4π² EI₂ the second of the weak one.
    assert [directions(scene, 40) for scene in scenes] == [0, 1, 1, 2, 3]


def test_rods_of_one_scene_are_counted_together():
    rods = [dr.Rod.straight(1.0, KIRCHHOFF), dr.Rod.straight(1.0, KIRCHHOFF, start=(0, 1, 0))]
    loads = [dr.PointForce((-4.0, 0, 0), "end", rod=k) for k in (0, 1)]
    assert directions(dr.Scene(rods, [dr.Clamp("start")], loads), (5, 8)) == 4


def test_inertia_agrees_with_eigenvalues():
    """Haynsworth: the pivots of the folded rod have the signs of the eigenvalues."""
    cut = mesh(scene := tip_loaded(dr.Section(EA=100.0, GA=1.0, GJ=0.1, EI=(0.05, 1.0)), 10.0), 13)
    phase, path = beginning(scene, 13, None)
    assert isinstance(phase, PhaseCondition)
    tangent = phase.find(path.state, 1.0).tangent
    K = np.zeros((tangent.system.n_unknowns,) * 2)
    for i, block in zip(cut.elements.node_i, tangent.elements, strict=True):
        K[7 * i : 7 * i + 13, 7 * i : 7 * i + 13] += block
    free = np.setdiff1d(np.arange(len(K)), tangent.system.held)
    eigenvalues = np.linalg.eigvalsh(0.5 * (K + K.T)[np.ix_(free, free)])
    found = negative_directions(blocks(tangent))
    assert found == (eigenvalues < 0).sum() - 13
    assert found > 0


def test_a_strip_bent_in_its_stiff_plane_is_flagged_at_the_right_load():
    """Case I2, EI3 = 20: P = 4.2748; two states beside it on the planar path."""
    section = dr.Section(GJ=1.0, EI=(1.0, 20.0), rigid={"shear", "extension"})
    flags = []
    for P in (4.26, 4.29):
        scene = dr.Scene([FLAT.straight(section)], [dr.Clamp("start")], [dr.PointForce((0.0, -P, 0.0), "end")])
        result = discrete.solve(scene)
        assert largest(result.rods[0].r[..., 2]) == 0.0
        flags.append(result.log[-1].stable)
    assert flags == [True, False]


@pytest.mark.parametrize(("factor", "stable"), [(0.99, True), (1.01, False)])
def test_neutral_motions_do_not_count(factor, stable):
    """Greenhill's rod turns freely about its axis; case G12-P5, error of 40 elements 4e-4."""
    result = discrete.solve(greenhill(5.0, factor * 4.4138), elements=40)
    assert [row.stable for row in result.log] == [True, stable]


def test_a_perfect_column_goes_straight_on_and_is_flagged():
    result = discrete.solve(column(ENDS["clamped-free"], force=1.5 * EULER["clamped-free"]))
    assert result.statistics.load_steps == 1
    assert result.log[-1].stable is False
    assert largest(result.rods[0].r[-1, :, 1:]) < 1e-12


@pytest.mark.parametrize("pose", [FLAT, SKEW], ids=["flat", "skew"])
def test_a_whiff_of_lateral_load_leads_to_the_buckled_branch(pose):
    """peers.md P4: 1.5 π²/4 along the rod and 1e-3 of it across, EA = 1e4, no shear; the perfect elastica is near."""
    P = 1.5 * np.pi**2 / 4
    section = dr.Section(EA=1e4, GA=1.0, GJ=1 / 1.3, EI=1.0)
    load = dr.PointForce(pose.turned((-P, 1e-3 * P, 0.0)), "end")
    result = discrete.solve(dr.Scene([pose.straight(section)], [dr.Clamp("start")], [load]))
    assert pose.back(result.tip) == pytest.approx([0.3632844440, 0.7885710075, 0.0], abs=3e-4)
    assert all(row.stable for row in result.log)
    assert sum(row.cuts for row in result.log) > 0
    assert result.statistics.newton_iterations <= 150


@pytest.mark.parametrize(
    ("overload", "imperfection"),
    [(1.2, 1e-2), *(pytest.param(overload, 1e-4, marks=pytest.mark.slow) for overload in (1.2, 3.0))],
)
def test_any_whiff_does(overload, imperfection):
    P = overload * EULER["clamped-free"]
    load = dr.PointForce((-P, 0.0, imperfection * P), "end")
    result = discrete.solve(dr.Scene([FLAT.straight(KIRCHHOFF)], [dr.Clamp("start")], [load]), elements=40)
    assert result.log[-1].stable
    assert result.tip[2] > 0.4


def test_a_dead_moment_rolls_a_rod_up_until_it_falls_out_of_its_plane():
    flags = [discrete.solve(rolled_up(KIRCHHOFF, turns, FLAT)).log[-1].stable for turns in (0.25, 2.0)]
    assert flags == [True, False]


@pytest.mark.parametrize(("factor", "stable"), [(0.97, True), (1.03, False)])
def test_becks_column_flutters(factor, stable):
    """Tangential follower force on a cantilever: 20.05 EI/L² (Beck 1952), uniform mass, no divergence."""
    scene = dr.Scene(
        [FLAT.straight(dr.Section(EA=1e6, GA=1.0, GJ=1.0, EI=(1.0, 30.0)))],
        [dr.Clamp("start")],
        [dr.FollowerForce((-factor * 20.05, 0.0, 0.0), "end")],
    )
    assert discrete.solve(scene, elements=40).log[-1].stable is stable


def test_a_follower_load_is_judged_by_eigenvalues():
    assert discrete.solve(followed(KIRCHHOFF, 3.0, FLAT), elements=40).log[-1].stable


def test_a_failure_near_a_limit_point_names_it():
    """DaDeppo & Schmidt's arch, case H1: limit load 8.97309 EI/R²."""
    angle = np.deg2rad(215.0)
    arch = dr.Rod.arc(1.0, angle, dr.Section(GJ=1.0, EI=1.0, rigid={"shear", "extension"}))
    first, crown, last = arch.centerline(np.array([0.0, 0.5 * angle, angle]))
    down = 0.5 * (first + last) - crown
    load = dr.PointForce(tuple(12.0 * down / np.linalg.norm(down)), 0.5 * angle)
    with pytest.raises(dr.NotConverged, match="critical point was passed") as failure:
        discrete.solve(dr.Scene([arch], [dr.Clamp("start"), dr.Guide("end", free={"rz"})], [load]), elements=40)
    assert 12.0 * failure.value.t == pytest.approx(8.97309, rel=1e-2)
    assert failure.value.result.log[-1].t == failure.value.t


def test_a_failure_on_an_unstable_path_says_where_that_began():
    """A perfect column pushed together along its axis, until nothing is left of it at t = 1."""
    supports = [dr.Clamp("start"), dr.Prescribed("end", displacement=(-1.0, 0, 0), rotation=(0, 0, 0))]
    with pytest.raises(dr.NotConverged, match=r"unstable from t = [\d.e-]+ on") as failure:
        discrete.solve(dr.Scene([FLAT.straight(KIRCHHOFF)], supports), elements=6)
    result = failure.value.result
    assert 0.99 < result.log[-1].t == failure.value.t < 1.0
    assert result.log[-1].stable is False
    assert np.isfinite(result.rods[0].r).all()


def test_a_rod_pressed_to_nothing_is_no_equilibrium():
    """Its chords vanish at t = 1, where forces have no direction: energy and tangent were no numbers."""
    section, gone = dr.Section(EA=100.0, GJ=1.0, EI=1.0, rigid={"shear"}), dr.Prescribed("end", displacement=(-1, 0, 0))
    with pytest.raises(dr.NotConverged) as failure:
        discrete.solve(dr.Scene([FLAT.straight(section)], [dr.Clamp("start"), gone]), elements=6)
    assert np.isfinite(failure.value.result.energy["strain"]).all()


@pytest.mark.serial
def test_the_flag_is_cheap():
    """Judging an elastica of 80 elements next to solving it, both in one run; the bound leaves room for noise."""
    scene = tip_loaded(KIRCHHOFF, 10.0)
    phase, path = beginning(scene, 80, None)
    judge = Judge(scene, phase.equilibrium.mesh)
    found = phase.find(path.state, 1.0)
    seconds = {"solve": np.inf, "judge": np.inf}
    for _ in range(12):
        for name, act in (
            ("solve", lambda: discrete.solve(scene)),
            ("judge", lambda: judge.verdict(found.tangent, found.state.R)),
        ):
            started = time.perf_counter()
            act()
            seconds[name] = min(seconds[name], time.perf_counter() - started)
    assert seconds["judge"] < 0.25 * seconds["solve"]


def test_compressing_after_twisting_is_another_path_to_the_same_state():
    loads = [
        dr.PointForce((-3.0, 0.2, 0.0), "end", history=order)
        if force
        else dr.PointMoment((1.0, 0.0, 0.0), "end", history=order)
        for force, order in ((True, FIRST), (False, LATER))
    ]
    swapped = [
        dr.PointForce((-3.0, 0.2, 0.0), "end", history=LATER),
        dr.PointMoment((1.0, 0.0, 0.0), "end", history=FIRST),
    ]
    supports = [dr.Clamp("start"), dr.Guide("end", free={"x", "rx"})]
    ends = [
        discrete.solve(
            dr.Scene([FLAT.straight(KIRCHHOFF)], supports, parts, motion=dr.Static(t_end=2.0)), elements=10
        ).rods[0]
        for parts in (loads, swapped)
    ]
    assert ends[0].r[-1] == pytest.approx(ends[1].r[-1], abs=1e-10)
    assert ends[0].frames[-1] == pytest.approx(ends[1].frames[-1], abs=1e-9)


def test_loads_of_a_scene_are_found_again():
    """The tangent after an attempt is that of its end."""
    scene = tip_loaded(KIRCHHOFF, 5.0)
    phase, path = beginning(scene, 10, None)
    assert isinstance(phase.equilibrium, Equilibrium)
    assert isinstance(phase.equilibrium.loads, Loads)
    found = phase.find(path.state, 1.0)
    there = phase.equilibrium.tangent(found.state, phase.equilibrium.loads.level(1.0))
    assert found.tangent.elements == pytest.approx(there.elements, rel=1e-6, abs=1e-5)
