"""The paper's element: Eq. 12–17 against hand values and against what a rod must do."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from discrete import corotation, stiffness
from discrete.corotation import ChordElement
from discrete.mesh import mesh
from discrete.rotation import exp
from tests.scenes import GENERAL, SKEW, tip_loaded

# Ramie fibre, process.md 1.1: EA, EI, G I_p in SI units.
EA, EI, GI_P = 10.7627, 2.690683e-10, 2.569006e-11
# Unlike bending stiffnesses, so that a confused plane shows.
UNLIKE = {"EA": 7.0, "GI_p": 0.3, "EI_v": 2.0, "EI_w": 5.0}
positive = st.floats(0.01, 100.0)


@pytest.mark.parametrize(
    ("l", "expected"),
    [
        (0.5e-3, (21525.5, 25.8306, 6.45764e-3, 2.15255e-6, 1.07627e-6, 5.13801e-8)),
        (0.2e-3, (53813.7, 403.60, 4.03602e-2, 5.38137e-6, 2.69068e-6, 1.28450e-7)),
    ],
)
def test_entries_of_the_papers_fibre(l, expected):
    k = stiffness(EA=EA, GI_p=GI_P, EI_v=EI, EI_w=EI, l=l)[0]
    entries = k[0, 0], k[1, 1], k[1, 5], k[5, 5], k[5, 11], k[3, 3]
    assert entries == pytest.approx(expected, rel=2e-5)


def test_every_entry_of_equations_15_to_17():
    l, F = 0.5, 3.0
    k = stiffness(**UNLIKE, l=l, F_n=F)[0]
    a, g = 7.0 / l, 0.3 / l
    pv, qv, Bv, bv = 12 * 5.0 / l**3 + F / l, 6 * 5.0 / l**2, 4 * 5.0 / l, 2 * 5.0 / l
    pw, qw, Bw, bw = 12 * 2.0 / l**3 + F / l, 6 * 2.0 / l**2, 4 * 2.0 / l, 2 * 2.0 / l
    expected = [
        [a, 0, 0, 0, 0, 0, -a, 0, 0, 0, 0, 0],
        [0, pv, 0, 0, 0, qv, 0, -pv, 0, 0, 0, qv],
        [0, 0, pw, 0, -qw, 0, 0, 0, -pw, 0, -qw, 0],
        [0, 0, 0, g, 0, 0, 0, 0, 0, -g, 0, 0],
        [0, 0, -qw, 0, Bw, 0, 0, 0, qw, 0, bw, 0],
        [0, qv, 0, 0, 0, Bv, 0, -qv, 0, 0, 0, bv],
        [-a, 0, 0, 0, 0, 0, a, 0, 0, 0, 0, 0],
        [0, -pv, 0, 0, 0, -qv, 0, pv, 0, 0, 0, -qv],
        [0, 0, -pw, 0, qw, 0, 0, 0, pw, 0, qw, 0],
        [0, 0, 0, -g, 0, 0, 0, 0, 0, g, 0, 0],
        [0, 0, -qw, 0, bw, 0, 0, 0, qw, 0, Bw, 0],
        [0, qv, 0, 0, 0, bv, 0, -qv, 0, 0, 0, Bv],
    ]
    assert k == pytest.approx(np.array(expected), rel=1e-15)


@given(EA=positive, GI_p=positive, EI_v=positive, EI_w=positive, l=positive, F_n=st.floats(-100.0, 100.0))
def test_stiffness_is_symmetric_and_its_end_forces_balance(EA, GI_p, EI_v, EI_w, l, F_n):
    k = stiffness(EA=EA, GI_p=GI_p, EI_v=EI_v, EI_w=EI_w, l=l, F_n=F_n)[0]
    assert (k == k.T).all()
    scale = np.abs(k).max()
    assert np.abs(k[:3] + k[6:9]).max() <= 1e-14 * scale


@given(EA=positive, GI_p=positive, EI_v=positive, EI_w=positive)
def test_six_rigid_motions_cost_nothing_without_axial_force(EA, GI_p, EI_v, EI_w):
    values = np.linalg.eigvalsh(stiffness(EA=EA, GI_p=GI_p, EI_v=EI_v, EI_w=EI_w, l=1.0)[0])
    assert np.abs(values[:6]).max() <= 1e-12 * values[-1]
    assert values[6] > 1e-6 * values[-1]


def test_tension_is_turned_with_the_element():
    """A small rotation about w or v turns the pair of axial forces and asks for no moment."""
    F, l, φ = 4.0, 0.7, 1e-3
    k = stiffness(**UNLIKE, l=l, F_n=F)[0]
    about_w = np.zeros(12)
    about_w[[7, 5, 11]] = l * φ, φ, φ
    about_v = np.zeros(12)
    about_v[[8, 4, 10]] = -l * φ, φ, φ
    assert k @ about_w == pytest.approx([0, -F * φ, 0, 0, 0, 0, 0, F * φ, 0, 0, 0, 0], abs=1e-15)
    assert k @ about_v == pytest.approx([0, 0, F * φ, 0, 0, 0, 0, 0, -F * φ, 0, 0, 0], abs=1e-15)


@pytest.mark.parametrize(("stiff", "dofs"), [("EI_w", [7, 11]), ("EI_v", [8, 10])])
def test_one_cantilever_element_buckles_at_twelve_over_pi_squared(stiff, dofs):
    """Its tangent is singular at P = 3 EI/l², which is 12/π² times Euler's π² EI/4l²."""
    l, EI = 0.8, UNLIKE[stiff]

    def determinant(P: float) -> float:
        return np.linalg.det(stiffness(**UNLIKE, l=l, F_n=-P)[0][np.ix_(dofs, dofs)])

    critical = 12 / np.pi**2 * np.pi**2 * EI / (4 * l**2)
    scale = determinant(0.0)
    assert abs(determinant(critical)) <= 1e-14 * scale
    assert determinant(0.999 * critical) > 0.0 > determinant(1.001 * critical)


def test_tip_of_one_element_deflects_like_a_beam():
    l, P = 2.0, 0.3
    k = stiffness(**UNLIKE, l=l)[0][6:, 6:]
    assert np.linalg.solve(k, [0, P, 0, 0, 0, 0]) == pytest.approx(
        [0, P * l**3 / 15, 0, 0, 0, P * l**2 / 10], abs=1e-14
    )


def test_elements_answer_in_blocks_as_they_do_at_once(monkeypatch):
    """Each is a law of its own, with what viscosity leaves behind, too."""
    turn = np.random.default_rng(3)
    elements = mesh(tip_loaded(GENERAL, 1.0, SKEW), 10).elements
    law = ChordElement(elements, paper_strain=False)
    law = law.changed(1.0 + turn.random(10), elements.l_0, 0.1 * turn.standard_normal((10, 2, 3)))
    E = exp(0.1 * turn.standard_normal((10, 2, 3)))
    e, F_n = elements.l_0[:, None] * E[:, 0, :, 0], turn.standard_normal(10)
    whole = law.respond(e, E, F_n)
    monkeypatch.setattr(corotation, "BLOCK", 4)
    for found, right in zip(law.respond(e, E, F_n), whole, strict=True):
        assert np.abs(found - right).max() <= 1e-14 * np.abs(right).max()
