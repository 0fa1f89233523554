"""Forces of the elements are what their energy, their balance and their tangents say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from discrete.element import stiffness
from discrete.endforces import deformed
from discrete.frames import direction_cosines, element_frame, transformation
from discrete.rotation import exp, log
from tests.discrete.laws import ENERGETIC, LAWS, N, moved, some_elements, some_state

every_law = pytest.mark.parametrize("law", LAWS, ids="-".join)
energetic = pytest.mark.parametrize("law", ENERGETIC, ids="-".join)


def setting(law: tuple[str, str], seed: int = 3):
    rng = np.random.default_rng(seed)
    elements = some_elements(rng)
    return LAWS[law](elements), elements, some_state(rng), rng


@every_law
def test_tangent_passes_the_taylor_test(law):
    """What the tangent leaves over falls with the square of the step."""
    element, _, state, rng = setting(law)
    d = rng.normal(size=(N, 13))
    force, tangent = element.respond(*state)
    steps = 0.1 * 0.5 ** np.arange(3, 9)
    left = [
        np.abs(element.respond(*moved(*state, h * d))[0] - force - h * np.einsum("nij,nj->ni", tangent, d)).max()
        for h in steps
    ]
    assert np.diff(np.log(left)) / np.diff(np.log(steps)) == pytest.approx(2.0, abs=0.1)


@every_law
def test_tangent_agrees_with_central_differences(law):
    element, _, state, _ = setting(law)
    _, tangent = element.respond(*state)
    h = 1e-6
    for k, unit in enumerate(np.eye(13)):
        d = np.tile(h * unit, (N, 1))
        slope = (element.respond(*moved(*state, d))[0] - element.respond(*moved(*state, -d))[0]) / (2 * h)
        assert tangent[:, :, k] == pytest.approx(slope, abs=2e-7)


@energetic
def test_forces_are_the_gradient_of_the_energy(law):
    """Π = F_n ε − ½ F_n² l/EA + U_bend; its derivative along F_n is the defect of Eq. 16."""
    element, _, state, _ = setting(law)

    def potential(e, E, F_n):
        force, energy = element.measure(e, E, F_n)
        return energy + F_n * force[:, 6]

    force, _ = element.measure(*state)
    h = 1e-6
    for k, unit in enumerate(np.eye(13)):
        d = np.tile(h * unit, (N, 1))
        slope = (potential(*moved(*state, d)) - potential(*moved(*state, -d))) / (2 * h)
        assert force[:, k] == pytest.approx(slope, abs=1e-8)


@every_law
def test_measure_and_respond_give_the_same_forces(law):
    element, _, state, _ = setting(law)
    assert element.measure(*state)[0] == pytest.approx(element.respond(*state)[0], abs=1e-15)


@every_law
def test_rigid_rotation_turns_the_forces(law):
    element, _, (e, E, F_n), _ = setting(law)
    Q = exp(np.array([0.8, -1.1, 2.0]))
    turned = element.respond(e @ Q.T, Q @ E, F_n)[0]
    force = element.respond(e, E, F_n)[0]
    for part in (slice(0, 3), slice(3, 6), slice(7, 10), slice(10, 13)):
        assert turned[:, part] == pytest.approx(force[:, part] @ Q.T, abs=1e-12)
    assert turned[:, 6] == pytest.approx(force[:, 6], abs=1e-13)


@every_law
def test_end_forces_are_opposite_and_moments_balance(law):
    """The letter of Eq. 18–22 balances all but the moment of the shear force about the displaced axis of node i."""
    element, elements, (e, E, F_n), _ = setting(law)
    force = element.respond(e, E, F_n)[0]
    assert force[:, 0:3] == pytest.approx(-force[:, 7:10], abs=1e-14)
    left = force[:, 3:6] + force[:, 10:13] + np.cross(e, force[:, 7:10])
    if law == ("node_i", "paper"):
        u = E[:, 0]
        δ = np.einsum("nji,nj->ni", u, e) - [1, 0, 0] * elements.l_0[:, None]
        F = np.einsum("nji,nj->ni", u, force[:, 7:10])
        # Natural lengths along rod and chord differ here: Eq. 15 balances with l, the chord with l_0.
        short = δ[:, 0] + elements.l_0 - elements.l
        stray = np.stack([δ[:, 1] * F[:, 2] - δ[:, 2] * F[:, 1], -short * F[:, 2], short * F[:, 1]], axis=1)
        left = np.einsum("nji,nj->ni", u, left) - stray
    assert left == pytest.approx(np.zeros_like(left), abs=1e-12)


@energetic
def test_tangent_is_symmetric_where_moments_balance(law):
    """Spins do not commute: the antisymmetric part of a node's block is half the moment there, and nothing else."""
    element, _, state, _ = setting(law)
    force, K = element.respond(*state)
    left = K - np.swapaxes(K, 1, 2)
    for spin in (slice(3, 6), slice(10, 13)):
        m = force[:, spin]
        block = left[:, spin, spin].copy()
        axial = np.stack([block[:, 2, 1], block[:, 0, 2], block[:, 1, 0]], axis=1)
        assert np.abs(axial) == pytest.approx(np.abs(m), abs=1e-11)
        left[:, spin, spin] = 0.0
    assert left == pytest.approx(np.zeros_like(left), abs=1e-11)


@every_law
def test_straight_element_has_the_papers_stiffness(law):
    """Eq. 18 and 19: straight and under F_n, the tangent is tᵀ k*(F_n) t once the unknown F_n is eliminated."""
    rng = np.random.default_rng(8)
    elements = some_elements(rng)
    elements = replace(elements, l_0=elements.l)
    Q, F_n = exp(rng.normal(size=(N, 3))), rng.normal(size=N)
    _, K = LAWS[law](elements).respond(Q[:, :, 0] * elements.l[:, None], np.stack([Q, Q], axis=1), F_n)
    ends = np.delete(np.arange(13), 6)
    row, column = K[:, 6, ends], K[:, ends, 6]
    eliminated = K[:, ends[:, None], ends] - column[:, :, None] * row[:, None] / K[:, 6, 6, None, None]
    k_star = elements.k_star + stiffness(EA=0.0, GI_p=0.0, EI_v=0.0, EI_w=0.0, l=elements.l, F_n=F_n)
    t = transformation(direction_cosines(Q))
    assert eliminated == pytest.approx(np.swapaxes(t, 1, 2) @ k_star @ t, abs=1e-12)


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1), st.floats(1e-8, 1.5))
def test_rows_hold_what_frames_and_rotation_vectors_are(seed, bend):
    """Component by component as element by element."""
    rng = np.random.default_rng(seed)
    d = np.zeros((N, 13))
    d[:, 10:13] = bend * rng.normal(size=(N, 3))
    e, E, _ = moved(*some_state(rng), d)
    by_rows, frame = deformed(e.T.copy(), E.transpose(2, 3, 1, 0).copy()), element_frame(e, E)
    assert by_rows.axes.transpose(2, 0, 1) == pytest.approx(frame.axes, abs=1e-14)
    assert by_rows.turned.transpose(3, 2, 0, 1) == pytest.approx(frame.turned, abs=1e-14)
    assert by_rows.θ.transpose(2, 1, 0) == pytest.approx(log(frame.turned), abs=1e-13)
