"""Steps in which a rod goes through another are seen, and no others."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import dolfinrod as dr
from dolfinrod.scene.meeting import PASSED, Meeting, Strands
from dolfinrod.scene.meeting.passing import SQUEEZED
from dolfinrod.scene.rodcontact import RodContact
from tests.scenes import FLAT, Pose, poses

Array = NDArray[np.float64]

RADIUS, TIGHT = 0.02, 2 * 0.02
S = np.linspace(-0.5, 0.5, 6)
LINES = Strands.smooth([S, S], [RADIUS, RADIUS])
ANGLES = st.one_of(st.floats(0.0, np.pi / 2), st.sampled_from([0.0, 1e-9, 1e-3]))


def bar(angle: float, height: float = 0.0, shift: float = 0.0, bend: float = 0.0) -> Array:
    """A rod across the z axis, shape (n, 3)."""
    along = (S + shift)[:, None] * np.array([np.cos(angle), np.sin(angle), 0.0])
    return along + np.stack([0 * S, 0 * S, height + 0.5 * bend * S**2], axis=1)


def pierces(start: tuple[Array, Array], end: tuple[Array, Array], pose: Pose) -> bool:
    """Whether a step from there to there, set up elsewhere, is found too long, whoever is named first."""
    found = []
    for order in (1, -1):
        x_0, x = (pose.origin + np.concatenate(rods[::order]) @ pose.Q.T for rods in (start, end))
        meeting = Meeting(RodContact(dr.Penalty(1.0, 0.001)), LINES)
        meeting.place(x_0, 0.0)
        meeting.respond(x, np.zeros_like(x))
        found.append(bool(meeting.pierces()))
    assert found[0] == found[1]
    return found[0]


@settings(max_examples=12, deadline=None)
@given(angle=ANGLES, above=st.floats(0.95, 3.0), below=st.floats(0.6, 20.0), shift=st.floats(-0.3, 0.3), pose=poses())
def test_a_shot_through_a_rod_is_seen(angle, above, below, shift, pose: Pose):
    target = bar(0.0)
    shot, gone = bar(angle, above * TIGHT, shift), bar(angle, -below * TIGHT, shift)
    assert pierces((target, shot), (target, gone), pose)
    # The same seen from the shot: the other comes.
    assert pierces((target, shot), (target + shot - gone, shot), pose)


@pytest.mark.parametrize("height", [0.0, 0.45])
@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_one_that_stays_in_the_middle_of_another_is_seen(angle, height):
    """Where centrelines meet, forces of any direction balance: no place for a step to end."""
    ends = (bar(0.0), bar(angle, height * TIGHT))
    assert pierces((bar(0.0), bar(angle, TIGHT)), ends, FLAT)


@settings(max_examples=12, deadline=None)
@given(angle=ANGLES, above=st.floats(0.95, 3.0), below=st.floats(0.6, 20.0), aside=st.floats(1.0, 3.0), pose=poses())
def test_one_that_passes_by_an_end_is_not(angle, above, below, aside, pose: Pose):
    beyond = np.array([0.5 + aside * TIGHT, 0.0, 0.0])
    shot = bar(angle, above * TIGHT)
    shot = shot - [shot[:, 0].min(), 0.0, 0.0] + beyond
    gone = shot - [0.0, 0.0, (above + below) * TIGHT]
    assert not pierces((bar(0.0), shot), (bar(0.0), gone), pose)


@settings(max_examples=12, deadline=None)
@given(angle=st.sampled_from([0.0, 1e-9, 1e-3]), roll=st.floats(0.0, np.pi / 2), pose=poses())
def test_one_that_rolls_around_another_is_not(angle, roll, pose: Pose):
    start, end = bar(angle, TIGHT), bar(angle) + TIGHT * np.array([0.0, np.sin(roll), np.cos(roll)])
    assert not pierces((bar(0.0), start), (bar(0.0), end), pose)


@settings(max_examples=12, deadline=None)
@given(angle=ANGLES, above=st.floats(1.0, 20.0), bend=st.floats(-1.0, 1.0), slide=st.floats(-1.0, 1.0), pose=poses())
def test_one_that_lands_and_slides_is_not(angle, above, bend, slide, pose: Pose):
    """Both are bent alike, and the one that comes stays on its side."""
    target, shot = bar(0.0, 0.0, 0.0, bend), bar(angle, above * TIGHT, 0.0, bend)
    landed = bar(angle, 0.9 * TIGHT, 0.0, bend) + 0.1 * np.array([slide, 0.0, abs(bend)])
    assert not pierces((target, shot), (target, landed), pose)


def test_a_rod_that_moves_far_does_not_go_through_itself():
    s = np.linspace(0.0, 1.0, 11)
    meeting = Meeting(RodContact(dr.Penalty(1.0, 0.001)), Strands.smooth([s], [0.01]))
    x = np.stack([s, 0 * s, 0 * s], axis=1)
    meeting.place(x, 0.0)
    meeting.respond(x + np.array([0.0, 5.0, 0.0]), np.zeros_like(x))
    assert not meeting.pierces()


@pytest.mark.parametrize("through", [True, False])
def test_a_loop_that_is_pulled_through_itself_is_seen(through):
    s = np.linspace(0.0, 1.0, 41)
    φ = 2 * np.pi * s / 0.8
    loop = np.stack([0.127 * np.cos(φ), 0.127 * np.sin(φ), 0.06 * s], axis=1)
    turned = loop * [1.0, 1.0, -1.0 if through else 2.0]
    meeting = Meeting(RodContact(dr.Penalty(1.0, 0.001)), Strands.smooth([s], [0.015]))
    meeting.place(loop, 0.0)
    meeting.respond(turned, np.zeros_like(loop))
    assert bool(meeting.pierces()) == through


@pytest.mark.parametrize(("depth", "words"), [(0.45, ""), (0.55, SQUEEZED), (2.5, PASSED)])
def test_half_way_into_another_is_told_from_through_it(depth, words):
    meeting = Meeting(RodContact(dr.Penalty(1.0, 0.001)), LINES)
    start, end = (np.concatenate((bar(0.0), bar(0.7, height * TIGHT))) for height in (1.0, 1.0 - depth))
    meeting.place(start, 0.0)
    meeting.respond(end, np.zeros_like(end))
    assert meeting.pierces() == words
