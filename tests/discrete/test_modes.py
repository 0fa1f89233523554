"""Natural frequencies: masses of the paper, order 2, tension, rigid motions, what has no inertia."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.discrete.test_buckling import ENDS, HEAVY, column
from tests.scenes import FLAT, SKEW, Pose, orders


@pytest.mark.parametrize(
    ("n", "ratios"),
    [
        (8, (0.9899, 0.9567, 0.9195)),
        (20, (0.9984, 0.9927, 0.9857)),
        (40, (0.9996, 0.9982, 0.9964)),
        (80, (0.9999, 0.9995, 0.9991)),
    ],
)
def test_frequencies_of_the_papers_nodes(n, ratios):
    """process.md 1.5, accuracy of the rigid-node model, over the exact ones of case K1."""
    found = discrete.modes(dr.Scene([FLAT.straight(HEAVY)], [dr.Clamp("start")]), elements=n)
    exact = np.array([1.8751040687119611, 4.694091132974175, 7.854757438237613]) ** 2
    assert found.omega.real[::2] / exact == pytest.approx(ratios, abs=5.1e-5)
    assert found.omega.real[1::2] == pytest.approx(found.omega.real[::2])
    assert found.multiplicity.tolist() == [2] * 6
    assert found.stable


def test_frequencies_of_stretching_and_twisting_have_order_two():
    """Case K3, fixed–free: (2n − 1) π c/2L with c² = EA/ρA = 300 and GJ/ρI₁ = 100."""
    section = dr.Section(EA=300.0, GA=1.0, GJ=2.0, EI=1.0, rhoA=1.0, rhoI=(0.02, 0.01, 0.01))
    n = [10, 20]
    found = [
        discrete.modes(dr.Scene([FLAT.straight(section)], [dr.Clamp("start")]), modes=10, elements=k).omega.real
        for k in n
    ]
    for exact in (0.5 * np.pi * np.sqrt(300.0), 0.5 * np.pi * 10.0):
        errors = [np.abs(omega - exact).min() for omega in found]
        assert orders(n, errors) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("tension", [10.0, 0.0, -5.0])
def test_tension_raises_frequencies(tension):
    """Case K4: ω_n² = (nπ)⁴ + T (nπ)²; frequencies in Hz."""
    scene = dr.Scene([FLAT.straight(HEAVY)], ENDS["pinned"], [dr.PointForce((tension, 0, 0), "end")])
    n = [20, 40]
    exact = np.sqrt(np.pi**4 + tension * np.pi**2)
    found = [discrete.modes(scene, modes=2, at=discrete.solve(scene, elements=k)) for k in n]
    assert found[-1].omega.real == pytest.approx([exact] * 2, rel=5e-4)
    assert found[-1].frequencies == pytest.approx([exact / (2 * np.pi)] * 2, rel=5e-4)
    if tension >= 0.0:
        assert orders(n, [exact - b.omega[0].real for b in found]) == pytest.approx(2.0, abs=0.02)


@pytest.mark.parametrize("rhoI", [None, (0.0, 0.0, 0.0)])
@pytest.mark.parametrize("elements", [1, 20])
def test_a_spin_without_inertia_is_no_vibration(rhoI, elements):
    """Case K4 between pins, where a straight rod spins freely: without ρI nothing moves, with it at frequency zero."""
    section = dr.Section(GJ=1.0, EI=1.0, rhoA=1.0, rhoI=rhoI, rigid={"shear", "extension"})
    found = discrete.modes(dr.Scene([FLAT.straight(section)], ENDS["pinned"]), modes=4, elements=elements)
    exact = np.sqrt(48.0) if elements == 1 else np.pi**2
    assert found.omega.real[:2] == pytest.approx([exact] * 2, rel=2e-3)
    assert found.stable
    heavy = replace(section, rhoI=(0.01, 0.0, 0.0))
    spinning = discrete.modes(dr.Scene([FLAT.straight(heavy)], ENDS["pinned"]), modes=3, elements=elements)
    assert spinning.omega.real == pytest.approx([0.0, exact, exact], rel=2e-3)


@pytest.mark.parametrize("pose", [FLAT, SKEW], ids=["flat", "skew"])
def test_a_free_rod_has_rigid_modes_of_zero_frequency(pose: Pose):
    """Case K1 free–free; no rotary inertia, so that only five rigid motions have mass."""
    found = discrete.modes(dr.Scene([pose.straight(HEAVY)], []), modes=7, elements=80)
    assert np.abs(found.omega[:5]).max() == 0.0
    assert found.omega.real[5:] == pytest.approx(4.730040744862704**2, rel=2e-3)


def test_a_state_beyond_its_critical_load_has_imaginary_frequencies():
    section = dr.Section(GJ=1.0, EI=1.0, rhoA=1.0, rigid={"shear", "extension"})
    scene = column(ENDS["pinned"], section, 12.0)
    found = discrete.modes(scene, modes=4, at=discrete.solve(scene, elements=20))
    assert found.omega[:2].imag == pytest.approx([np.sqrt(12.0 * np.pi**2 - np.pi**4)] * 2, rel=0.02)
    assert not found.stable
