"""One vector after the other: the same as LAPACK, and turns that are turns."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from discrete import assembly
from discrete.assembly import BandedSystem
from discrete.rotation import exp
from discrete.singly import resisted, turned_back, turned_blocks, turned_on
from discrete.unknowns import N_ELEMENT, N_NODE

ROUND_OFF = 1e-12
SEEDS = st.integers(0, 2**32 - 1)


def _turns(rng: np.random.Generator, n: int) -> np.ndarray:
    return np.ascontiguousarray(exp(rng.standard_normal((n, 3))).transpose(1, 2, 0))


@settings(max_examples=20, deadline=None)
@given(SEEDS, st.integers(1, 12), st.integers(1, 3))
def test_one_system_is_solved_as_several_are(seed: int, n: int, rods: int) -> None:
    rng = np.random.default_rng(seed)
    first = np.arange(rods) * (n + 1)
    node_i = np.concatenate([a + np.arange(n) for a in first])
    held = np.concatenate([N_NODE * a + np.arange(6) for a in first])
    system = BandedSystem(rods * (n + 1), node_i, rng.uniform(0.01, 0.1, len(node_i)), held)
    half = rng.standard_normal((len(node_i), N_ELEMENT, N_ELEMENT))
    inverse = system.inverse(half @ np.swapaxes(half, 1, 2) + np.eye(N_ELEMENT))
    right = rng.standard_normal(system.n_unknowns)
    several, one = inverse.times(right[:, None])[:, 0], inverse.single(right)
    residual = np.abs(one - several)
    assert residual.max() <= ROUND_OFF * np.abs(several).max() * np.abs(inverse.left).max() / np.abs(inverse.left).min()


@pytest.mark.parametrize("rods", [1, 3])
def test_a_system_filled_in_blocks_is_the_same(rods, monkeypatch):
    rng, n = np.random.default_rng(rods), 11
    node_i = np.concatenate([a + np.arange(n) for a in np.arange(rods) * (n + 1)])
    l, held = rng.uniform(0.01, 0.1, len(node_i)), np.arange(6)
    tangent, right = rng.standard_normal((len(node_i), N_ELEMENT, N_ELEMENT)), rng.standard_normal(rods * (n + 1) * 7)
    whole = BandedSystem(rods * (n + 1), node_i, l, held).solve(tangent, right.copy())
    monkeypatch.setattr(assembly, "BLOCK", 2)
    found = BandedSystem(rods * (n + 1), node_i, l, held).solve(tangent, right.copy())
    np.testing.assert_array_equal(found, whole)


@given(SEEDS)
def test_what_is_turned_on_and_back_is_what_it_was(seed: int) -> None:
    rng = np.random.default_rng(seed)
    Q, d = _turns(rng, 5), rng.standard_normal((5, N_NODE))
    np.testing.assert_allclose(turned_back(Q, turned_on(Q, d)), d, atol=ROUND_OFF)
    np.testing.assert_allclose(turned_on(Q, d)[:, 3:6], np.einsum("ijn,nj->ni", Q, d[:, 3:6]), atol=ROUND_OFF)


@given(SEEDS)
def test_turned_nodes_resist_as_they_did_in_their_own_axes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    Q, d, nodes = _turns(rng, 5), rng.standard_normal((5, N_NODE)), np.array([1, 4])
    blocks, turned, own = rng.standard_normal((2, 6, 6)), np.zeros((5, N_NODE)), np.zeros((5, N_NODE))
    resisted(nodes, turned_blocks(Q, nodes, blocks), d, turned)
    resisted(nodes, blocks, turned_back(Q, d), own)
    np.testing.assert_allclose(turned, turned_on(Q, own), atol=ROUND_OFF)
