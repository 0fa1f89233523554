"""Rods on rough surfaces by everybody: answers are closed forms, who cannot take part says why."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import exp, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from verification.peers import rough
from verification.peers.contest import TARGET, Attempt, Contender, Measured
from verification.peers.environment import ABSENT, Environment, installed
from verification.peers.rodshape import round_drum
from verification.peers.roughothers import CAPSTAN, PLANE, ROUGH_OTHERS, rough_others_measured
from verification.peers.roughours import ROUGH_OURS, rough_ours_measured
from verification.peers.standing import standings
from verification.report import peers

pytestmark = pytest.mark.serial

ALONG, ACROSS, ROPE = rough.ROUGH


def test_answers_are_those_of_peers_md():
    """It prints six digits, the last of P7b by another value of g."""
    assert ALONG.answer[-1][0] == pytest.approx(0.169895, abs=5e-7)
    assert ACROSS.answer[-1][1] == pytest.approx(0.685539, abs=6e-6)
    assert ROPE.answer[0][0] == pytest.approx(exp(0.3 * pi))


@pytest.mark.parametrize("problem", [ALONG, ACROSS], ids=lambda problem: problem.name)
def test_friction_takes_speed_and_never_gives_any(problem):
    ways = [0.0, *np.linalg.norm(problem.answer, axis=1)]
    steps = np.diff(ways)
    assert (steps >= 0.0).all()
    assert (np.diff(steps) <= 1e-12).all()


def test_errors_are_distances_over_the_scale():
    assert ACROSS.off(np.add(ACROSS.answer, [0.0, 0.0, 3e-3])) == pytest.approx(3e-3)
    assert ROPE.off(1.01 * np.asarray(ROPE.answer)) == pytest.approx(0.01)


@given(st.integers(2, 40), st.floats(0.05, 2.0))
def test_ropes_round_drums_are_even_and_leave_them_straight(n, tail):
    places = round_drum(n, tail)
    chords = [np.subtract(b, a) for a, b in pairwise(places)]
    on = [c for c in chords if abs(c[0]) > 1e-12]
    assert len(on) == n
    assert np.linalg.norm(on, axis=1) == pytest.approx(np.full(n, 2.0 * np.sin(0.5 * pi / n)))
    assert places[0] == (-1.0, -tail, 0.0)
    assert places[-1] == (1.0, -tail, 0.0)


@pytest.mark.parametrize("own", [own for own in ROUGH_OURS if own.problem is ROPE], ids=lambda own: own.taker.name)
def test_ropes_of_ours_hold_what_they_should(own):
    """The chords of the discrete model hold more, by the square of their angle: 3.4e-3 with 16 of them."""
    found = rough_ours_measured(own, quick=True)
    assert [a.refused for a in found.attempts] == [""]
    assert found.nearest < (1e-5 if own.taker.exact else 5e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    "own",
    [own for own in ROUGH_OURS if own.problem is not ROPE],
    ids=lambda own: f"{own.problem.name}, {own.taker.name}",
)
def test_rods_of_ours_slide_as_far_as_they_should(own):
    """Within v Δt, what a first order scheme may miss."""
    found = rough_ours_measured(own, quick=True)
    assert [a.refused for a in found.attempts] == [""]
    assert found.nearest < 1e-2


@pytest.mark.slow
@pytest.mark.parametrize("problem", rough.ROUGH, ids=lambda problem: problem.name)
@pytest.mark.parametrize("other", [o for o in ROUGH_OTHERS if o.module], ids=lambda other: other.taker.name)
def test_the_real_ones_slide_where_they_are_installed(other, problem):
    """Within a hundredth on the plane; on the drum, as coarse chains, within a twentieth; or absent and saying so."""
    found = rough_others_measured(other, problem, installed(), quick=True)
    if not found.absent:
        assert [a.refused for a in found.attempts] == [""]
        assert found.nearest < (5e-2 if problem is ROPE else 1e-2)


def test_who_cannot_take_part_says_why(tmp_path):
    here = Environment(tmp_path / "python", "made")
    unable = [other for other in ROUGH_OTHERS if not other.module]
    assert [other.taker.name for other in unable] == ["EXUDYN", "OpenSees", "xara"]
    for other in unable:
        assert set(other.without) == {PLANE, CAPSTAN}
        found = [rough_others_measured(other, problem, here, quick=True) for problem in rough.ROUGH]
        assert all(c.absent and c.absent != ABSENT and not c.attempts for c in found)
        assert all(c.absent in peers.contents((c,)) for c in found)
        assert rough_others_measured(other, ALONG, None, quick=True).absent == ABSENT


def test_rough_problems_are_raced_by_both_sides_and_count_in_the_verdict():
    taken = {problem.name: [own.taker for own in ROUGH_OURS if own.problem is problem] for problem in rough.ROUGH}
    assert all(taken.values())
    right = Attempt("4", "1/9 s", Measured(1e-4, 1e-4, 1.0, 0.1, 0.2, 9, "v"))
    slow = replace(right, found=replace(right.found, solve=3.0))
    found = [Contender(name, takers[0], (right,)) for name, takers in taken.items()]
    found += [Contender(name, ROUGH_OTHERS[0].taker, (slow,)) for name in taken]
    assert {s.problem: s.ahead for s in standings(found) if s.target == TARGET and s.where == "anywhere"} == {
        "P7a": 3.0,
        "P7b": 3.0,
        "capstan": 3.0,
    }
    assert ROPE.title in peers.contents(found)
