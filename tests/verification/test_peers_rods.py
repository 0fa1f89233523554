"""Rods in equilibrium by everybody: references are recomputed, who is ahead is what the numbers say."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, dist, inf, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from discrete.equilibrium import Equilibrium
from dolfinrod.continuum.newton import Newton
from dolfinrod.scene import Dynamic, Midpoint
from verification.case import SKEW
from verification.peers import rods
from verification.peers.contest import Attempt, Contender, Measured, Taker
from verification.peers.conversation import Refused
from verification.peers.environment import installed
from verification.peers.onestep import LOADS, ONCE, largest
from verification.peers.parts import parts_of
from verification.peers.rodothers import LADDER, ROD_OTHERS, attempt, rod_others_measured, together
from verification.peers.rodours import DISCRETE, ROD_OURS, measured, posed
from verification.peers.rodshape import equal, nodes
from verification.peers.standing import aims, standing, standings
from verification.peers.swing import scene as swing_scene
from verification.references.bvp import solve
from verification.references.scenes import rod_problem
from verification.report import peers, race
from verification.stepper import ContinuumStepper, DiscreteStepper

pytestmark = pytest.mark.serial

COLLOCATED = [problem for problem in rods.RODS if problem.source == rods.COLLOCATED]
# What peers.md (November 2026) prints of each, to ten digits.
PUBLISHED = {
    ("P1", "sheared"): (0.4450044022, 0.8116090249, 0.0),
    ("P1", "stretched"): (0.4451208473, 0.8114082875, 0.0),
    ("P1", "rigid"): (0.4450044022, 0.8106090249, 0.0),
    ("P3", "sheared"): (47.15043857, 15.68480053, 53.47485879),
    ("P3", "stretched"): (47.15215022, 15.68535578, 53.47176295),
    ("P4", "sheared"): (0.3629618704, 0.7886585441, 0.0),
    ("P4", "stretched"): (0.3632844440, 0.7885710075, 0.0),
}


def ran(name: str, ours: bool, *runs: tuple[float, float], problem: str = "P3", space: bool = True) -> Contender:
    """Somebody whose settings have these errors and seconds."""
    taker = Taker(name, ours, True, "steps", "element", "sheared", space)
    attempts = [Attempt(f"{8 * k}", "1 step", Measured(e, e, s, 0.1, 0.2, 1, "v")) for k, (e, s) in enumerate(runs, 1)]
    return Contender(problem, taker, tuple(attempts))


@pytest.mark.parametrize(("name", "assumes"), PUBLISHED)
def test_references_are_those_of_peers_md(name, assumes):
    problem = next(p for p in rods.RODS if p.name == name)
    assert dist(problem.tips[assumes], PUBLISHED[name, assumes]) < 1e-9 * problem.length


@pytest.mark.slow
@pytest.mark.parametrize("problem", COLLOCATED, ids=lambda problem: problem.name)
@pytest.mark.parametrize("assumes", rods.RIGID)
def test_references_are_recomputed(problem, assumes):
    """The column needs small steps on its way, or the straight branch is found."""
    found = solve(replace(rod_problem(problem.scene(assumes)), steps=64)).centreline(np.array([problem.length]))[0]
    tip = SKEW.back(found + np.asarray(SKEW.start(problem.length)), problem.length)
    assert dist(tip, problem.tips[assumes]) < 1e-11 * problem.length


@given(st.integers(1, 40), st.floats(-2.0 * pi, 2.0 * pi), st.floats(0.1, 10.0))
def test_nodes_lie_on_the_rod_and_their_tangents_turn_evenly(n, angle, length):
    places = nodes(length, angle, equal(n))
    assert places[0] == (0.0, 0.0, 0.0)
    assert places[-1][2] == pytest.approx(angle)
    half = 0.5 * angle / n
    chord = length / n * (sin(half) / half if half else 1.0)
    for (x, y, a), (x_1, y_1, b) in pairwise(places):
        middle = 0.5 * (a + b)
        assert (x_1 - x, y_1 - y) == pytest.approx((chord * cos(middle), chord * sin(middle)), abs=1e-12 * length)


def test_fibres_with_and_without_units_are_one_problem():
    si, plain = (next(p for p in rods.RODS if p.name == name) for name in ("P6", "P6n"))
    for assumes, tip in si.tips.items():
        assert np.asarray(tip) / si.length == pytest.approx(plain.tips[assumes])
    assert si.EA * si.length**2 / si.EI == pytest.approx(16.0 * (0.04 / 20e-6) ** 2)
    assert plain.EA == pytest.approx(6.4e7)


@pytest.mark.parametrize("own", [ROD_OURS[0], ROD_OURS[3], DISCRETE], ids=lambda own: own.taker.name)
def test_our_models_are_measured(own):
    found = measured(rods.RODS[0], own.taker.assumes, own.meshes[1], (1, 0.0))
    assert 0.0 < found.error < 3e-3
    assert found.solve > 0.0


def test_a_plane_model_does_not_bend_out_of_its_plane():
    bend = next(p for p in rods.RODS if p.name == "P3")
    assert not bend.planar
    assert {own.taker.space for own in ROD_OURS if not own.without(bend)} == {True}
    assert {other.without(bend) for other in ROD_OTHERS if not other.taker.space} == {"an element in the plane"}
    assert "a model in the plane" in race.settings([Contender("P3", ROD_OURS[0].taker, (), ROD_OURS[0].without(bend))])


def test_who_is_ahead_is_the_ratio_of_the_quickest_that_are_exact_enough():
    found = (ran("A", True, (1e-4, 2.0), (1e-6, 4.0)), ran("B", False, (1e-4, 1.0), (1e-6, 40.0)))
    assert standing(found, "P3", 1e-3, "in space").ahead == 0.5
    assert standing(found, "P3", 1e-5, "in space").ahead == 10.0
    assert standing(found, "P3", 1e-8, "in space").ahead == 1.0
    assert [(a.words, a.holds) for a in aims(found)][:2] == [
        ("P3 to 1e-05, in space", True),
        ("P3 to 1e-08, in space", False),
    ]
    alone = (ran("A", True, (1e-9, 2.0)), found[1])
    assert standing(alone, "P3", 1e-8, "in space").ahead == inf
    words = peers.verdict(found)
    assert "ours are ahead on P3 to 1e-05 (10 ×)" in words
    assert "others are ahead on P3 to 0.001 (B, 2.0 ×)" in words


def test_an_aim_that_is_missed_says_what_costs_the_time():
    """More steps, or dearer ones."""

    def swung(name: str, ours: bool, steps: int, seconds: float) -> Contender:
        one = ran(name, ours, (1e-4, seconds), problem="swing")
        (attempt,) = one.attempts
        return replace(one, attempts=(replace(attempt, found=replace(attempt.found, steps=steps)),))

    dear, many = swung("A", True, 160, 0.32), swung("A", True, 16000, 0.32)
    other = swung("B", False, 200, 0.01)
    (aim,), (steps,) = (aims((one, other)) for one in (dear, many))
    assert not aim.holds
    assert aim.profile == "steps: 160 of 2 ms against 200 of 0.05 ms, so what a step costs makes the difference"
    assert steps.profile.endswith("so how many steps it takes makes the difference")
    assert aim.profile in peers.asked([aim])
    (attempt,) = dear.attempts
    taken_apart = replace(attempt, found=replace(attempt.found, parts=(("assembly", 0.7), ("the rest", 0.3))))
    (told,) = aims((replace(dear, attempts=(taken_apart,)), other))
    assert told.profile == f"{aim.profile}; of ours 70 % assembly, 30 % the rest"
    assert "steps:" not in peers.asked([replace(aim, ahead=1.0)])


@pytest.mark.parametrize("stepper", [ContinuumStepper(Midpoint(), 1, 2), DiscreteStepper(4)])
def test_seconds_of_our_models_are_taken_apart_and_nothing_stays_watched(stepper):
    watched = {(kind, method): getattr(kind, method) for kind, method in ((Newton, "_run"), (Equilibrium, "_iterate"))}
    posed = swing_scene("sheared", Dynamic(t_end=0.05, dt=0.01))
    parts = parts_of(stepper.family, lambda: stepper.solve(posed))
    assert sum(part for _, part in parts) == pytest.approx(1.0)
    assert all(part > 0.0 for _, part in parts)
    assert [part for _, part in parts] == sorted((part for _, part in parts), reverse=True)
    assert "residual and tangent of the elements" in dict(parts)
    assert all(getattr(kind, method) is call for (kind, method), call in watched.items())


def test_plane_elements_are_not_compared_in_space():
    found = (ran("A", True, (1e-4, 2.0)), ran("B", False, (1e-4, 1.0), space=False), ran("C", False, (1e-4, 8.0)))
    assert standing(found, "P3", 1e-3, "in space").ahead == 4.0
    assert standing(found, "P3", 1e-3, "anywhere").ahead == 0.5
    assert len(standings(found)) == 6


def test_the_quickest_to_an_error_is_bold_and_a_reason_is_shown():
    refused = replace(ran("C", False), attempts=(Attempt("8", "", refused="no such rod"),))
    found = (ran("A", True, (1e-4, 2e-3)), ran("B", False, (1e-6, 3e-3)), refused)
    page = race.seconds(found)
    assert page.count("<b>") == 2
    assert "<b>2.0, 8, 1 step</b>" in page
    assert "<b>3.0, 8, 1 step</b>" in page
    assert "refused: no such rod" in race.settings(found)
    assert "Errors" not in peers.contents(found)


def test_loads_in_one_step_count_up_to_the_first_that_fails():
    right, wrong = Measured(1e-3, 1e-3, 1.0, 0.1, 0.2, 1, "v"), "the tip ends 0.2 L from where it should"
    good = [Attempt("16", f"{load:g}", right) for load in LOADS]
    bad = replace(good[2], found=None, refused=wrong)
    c = Contender(ONCE, Taker("A", False, True, "m", "e", "sheared"), (*good[:2], bad, *good[3:]))
    assert largest(c) == LOADS[1]
    assert "✓" in peers.contents((c,))


@pytest.mark.slow
@pytest.mark.parametrize("others", together(), ids=lambda others: others[0].package)
def test_the_real_ones_solve_the_cantilever_where_they_are_installed(others):
    """Within a hundredth of the length, a tenth where rods come to rest by chains of first order; or a reason."""
    contenders = rod_others_measured(others, rods.RODS[0], installed(), quick=True)
    for other, found in zip(others, contenders, strict=True):
        assert found.taker == other.taker
        refused = {a.refused for a in found.attempts}
        if not found.absent and not any(other.needs and other.needs in words for words in refused):
            assert refused == {""}
            assert found.nearest < (1e-1 if other.relaxes else 1e-2)


def test_what_it_needs_is_said_where_it_is_not_installed():
    xara = next(other for other in ROD_OTHERS if other.needs)
    missing = attempt(xara, rods.RODS[0], 8, Refused("ModuleNotFoundError: No module named 'xara'"))
    assert missing.refused == "ModuleNotFoundError: No module named 'xara'; needs Python 3.12 or later"
    assert attempt(xara, rods.RODS[0], 8, Refused("diverged")).refused == "diverged"


def test_who_has_no_statics_is_tried_on_the_first_problem_only():
    relaxing = [other for other in ROD_OTHERS if other.relaxes]
    assert relaxing
    for other in relaxing:
        assert [p.name for p in rods.RODS if not other.without(p)] == ["P1"]


def test_load_steps_go_up():
    assert list(LADDER) == sorted(set(LADDER))
    assert posed(rods.RODS[0], "rigid", 3).motion.steps == 3
