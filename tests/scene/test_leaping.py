"""Steps of backward Euler that lead a rod past another to win energy are seen, and no others."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from dolfinrod.scene import Penalty, RodContact
from dolfinrod.scene.meeting import Meeting, Strands

Array = NDArray[np.float64]

RADIUS, DENSITY, STEP = 0.02, 0.3, 1e-3
S = np.linspace(-0.5, 0.5, 6)
LINES = Strands.smooth([S, S], [RADIUS, RADIUS])
LAW = Penalty(1e6, 1e-4)
OFFSETS = st.floats(0.2, 1.8)


def led(start: Array, end: Array, level: float = 1.0, density: float | None = DENSITY) -> tuple[Meeting, Array]:
    """A rod along x, and one beside it that a step leads from one place (y, z) to another; forces on all nodes."""
    places = [
        np.concatenate([np.stack([S, 0 * S, 0 * S], axis=1), [0.0, *at] + S[:, None] * [1.0, 0.0, 0.0]])
        for at in (start, end)
    ]
    meeting = Meeting(RodContact(LAW), LINES, level, density=None if density is None else np.full(2, density))
    meeting.place(places[0], 0.0)
    meeting.begin(STEP)
    return meeting, meeting.respond(places[1], np.zeros_like(places[1])).force


@settings(max_examples=20, deadline=None)
@given(before=st.tuples(OFFSETS, OFFSETS), after=st.tuples(OFFSETS, OFFSETS))
def test_what_is_won_is_what_the_ledger_would_have(before, after):
    """U₁ − U₀ + F₁·Δx of whole rods, closed form: their gap is the same all along."""
    start, end = (RADIUS * np.array(at) for at in (before, after))
    meeting, force = led(start, end)
    stored = [float(LAW.energy(np.array([np.hypot(*at) - 2.0 * RADIUS]), np.zeros(1))[0]) for at in (start, end)]
    way = end - start
    expected = stored[1] - stored[0] + float(force[6:, 1:].sum(axis=0) @ way)
    won, leaps = meeting.won()
    size = max(*stored, 1e-12)
    assert won == pytest.approx(expected if leaps else 0.0, abs=1e-9 * size)
    if np.hypot(*way) > 0.5 * RADIUS * 1.01 and stored[1] > 0.0:
        assert leaps
    kinetic = 0.5 * DENSITY * float(way @ way) / STEP**2
    assert meeting.leapt(meeting.won()) == bool(leaps and won > 1e-3 * kinetic)


@settings(max_examples=20, deadline=None)
@given(fall=st.floats(0.0, 20.0), deep=st.floats(0.0, 0.9))
def test_one_that_comes_head_on_wins_nothing(fall, deep):
    """Along the normal the energy of penetration is convex, however far a step leads."""
    end = np.array([0.0, (2.0 - deep) * RADIUS])
    meeting, _ = led(end + fall * RADIUS * np.array([0.0, 1.0]), end)
    assert meeting.won()[0] <= 1e-12
    assert not meeting.leapt(meeting.won())


def test_one_that_leaps_over_the_edge_of_another_does():
    """It was clear of the other on one side, and is pushed on where it came from nowhere on the other."""
    start, end = RADIUS * np.array([1.9, -1.5]), RADIUS * np.array([1.9, 0.4])
    meeting, force = led(start, end)
    assert force[6:, 2].sum() > 0.0
    assert meeting.leapt(meeting.won())
    for other in (led(start, end, level=0.5)[0], led(start, end, density=None)[0]):
        assert not other.leapt(other.won())


def test_ways_of_less_than_half_a_radius_are_let_be():
    start, end = RADIUS * np.array([1.9, 0.0]), RADIUS * np.array([1.9, 0.49])
    meeting, _ = led(start, end)
    assert not meeting.won().any()
    assert not meeting.leapt(meeting.won())
