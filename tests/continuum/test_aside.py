"""The direction in which stability was lost, and the side of it to which ways go, by Lanczos' method."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dolfinrod.continuum.aside import MOST, SEEN, Lanczos

# Softnesses of a rod fall as 1/k²; those below zero stand for directions that were lost.
SOFT = np.array([1.0 / k**2 for k in range(1, 31)])


def lost(softness, ways):
    """The direction found from unit vectors in eigendirections, or None; the rods' 30 spins are their parts."""
    units = [np.atleast_2d(way).T / np.linalg.norm(way) for way in ways]
    lanczos, basis, parts = Lanczos(MPI.COMM_SELF, units), [], None
    while parts is None and len(basis) < MOST and not lanczos.complete:
        basis.append(lanczos.newest)
        lanczos.grow(softness[:, None] * lanczos.newest)
        parts = lanczos.lost(np.full(len(ways), SEEN))
    return None if parts is None else np.tensordot(parts, basis, axes=1)[:, 0]


def ways(part, seed, n=2):
    """Ways at random, with such a part along the first direction."""
    found = np.random.default_rng(seed).normal(size=(n, len(SOFT)))
    found[:, 0] = part
    return found


@pytest.mark.serial
@given(part=st.floats(1e-4, 1.0), side=st.sampled_from([-1.0, 1.0]), size=st.floats(1.0, 1e4), seed=st.integers(0, 99))
@settings(max_examples=30)
def test_what_is_found_is_the_lost_direction_on_the_side_of_the_ways(part, side, size, seed):
    """It is off by less than the part of either way that goes along it, or its side would not be known."""
    both = ways(np.full(2, side * part), seed)
    direction = lost(np.array([-size, *SOFT[1:]]), both)
    assert direction is not None
    assert side * direction[0] > 0.0
    off = np.linalg.norm(direction[1:])
    assert (both @ direction / np.linalg.norm(both, axis=1) >= off).all()


@pytest.mark.serial
@given(part=st.floats(0.0, 1e-10), seed=st.integers(0, 99))
@settings(max_examples=10)
def test_round_off_has_no_side(part, seed):
    assert lost(np.array([-1e4, *SOFT[1:]]), ways(np.full(2, part), seed)) is None


@pytest.mark.serial
@pytest.mark.parametrize("seed", range(5))
def test_ways_to_different_sides_tell_nothing(seed):
    assert lost(np.array([-10.0, *SOFT[1:]]), ways(np.array([0.5, -0.5]), seed)) is None


@pytest.mark.serial
@pytest.mark.parametrize("seed", range(5))
def test_a_stable_state_has_no_such_direction(seed):
    assert lost(SOFT, ways(np.ones(2), seed)) is None


@pytest.mark.serial
def test_where_the_operator_leads_nowhere_else_all_is_known():
    softness, way = np.array([-3.0]), np.array([0.7])
    assert lost(softness, [way, way]) == pytest.approx([1.0])
