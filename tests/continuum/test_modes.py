"""Natural frequencies: bending, torsion and extension, free bodies, pre-stress, instability."""

from __future__ import annotations

from dataclasses import replace

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import FLAT, SKEW, cantilever

# Reference cases K1: (β L) of Euler-Bernoulli beams (Blevins 1979, Table 8-1).
CANTILEVER = np.array([1.8751040687119611, 4.694091132974175, 7.854757438237613])
FREE = np.array([4.730040744862704, 7.853204624095838, 10.995607838001671])
CLAMPED_PINNED = np.array([3.926602312047919, 7.068582745628732])
# Reference cases K2: Timoshenko beam of square section, L = EI = ρA = 1, L/h = 10, ν = 0.3, shear factor 5/6.
TIMOSHENKO_CANTILEVER = [3.4883549511812464, 20.90691543848912, 54.988379721983385]
TIMOSHENKO_FREE = [21.608485400183906, 56.207823841066585]
TIMOSHENKO_PINNED = [9.707477234868747, 37.09615884769685]
# Zeros of the Bessel function J0.
BESSEL = np.array([2.404825557695773, 5.520078110286311])

THIN = dr.Section(GJ=1 / 1.3, EI=1.0, rhoA=1.0, rhoI=(0, 0, 0), rigid={"shear", "extension"})
THICK = dr.Section(EA=1200.0, GA=384.6153846153846, GJ=1 / 1.3, EI=1.0, rhoA=1.0, rhoI=(1 / 600, 1 / 1200, 1 / 1200))
PINNED = (dr.Pin("start"), dr.Guide("end", free={"x", "rx", "ry", "rz"}))


def pulled(T: float) -> dr.Scene:
    """A pinned beam under a steady axial force."""
    return dr.Scene([FLAT.straight(THIN)], PINNED, [dr.PointForce((T, 0, 0), "end", history=dr.Steady())])


def pushed(P: float) -> dr.Scene:
    """A pinned beam under an axial force that grows to P."""
    return dr.Scene([FLAT.straight(THIN)], PINNED, [dr.PointForce((-P, 0, 0), "end")])


def test_slender_cantilever():
    found = dr.modes(cantilever(SKEW.straight(THIN)), elements=16, modes=6)
    np.testing.assert_allclose(found.omega, np.repeat(CANTILEVER**2, 2), rtol=5e-7)
    np.testing.assert_allclose(found.frequencies, found.omega.real / (2 * np.pi))
    np.testing.assert_array_equal(found.multiplicity, 2)
    assert found.stable


def test_thick_cantilever_bends_twists_and_stretches():
    """Timoshenko (K2); waves (K3): (2n − 1) π c/2 with c = √(GJ/ρI₁) and √(EA/ρA)."""
    found = dr.modes(cantilever(SKEW.straight(THICK)), elements=16, modes=8)
    torsion, extension = np.pi / 2 * np.sqrt([600 / 1.3, 1200.0])
    exact = np.sort([*np.repeat(TIMOSHENKO_CANTILEVER, 2), torsion, extension])
    np.testing.assert_allclose(found.omega, exact, rtol=5e-7)
    np.testing.assert_array_equal(found.multiplicity, [2, 2, 2, 2, 1, 1, 2, 2])
    np.testing.assert_allclose(found.rods[0].displacement[4], 0.0, atol=1e-6)
    wave = np.sin(np.pi / 2 * found.rods[0].s)
    for shape in (found.rods[0].spin[4], found.rods[0].displacement[5]):
        np.testing.assert_allclose(np.abs(shape @ SKEW.Q[:, 0]), wave, atol=1e-5)


@pytest.mark.parametrize(
    ("end", "exact"),
    [
        (dr.Guide("end", free={"x", "rx", "ry", "rz"}), CLAMPED_PINNED),
        pytest.param(dr.Guide("end", free={"x"}), FREE[:2], marks=pytest.mark.slow),
    ],
)
def test_other_ends(end, exact):
    """K1; clamped at both ends it sounds like a free one."""
    found = dr.modes(dr.Scene([FLAT.straight(THIN)], [dr.Clamp("start"), end]), elements=16, modes=4)
    np.testing.assert_allclose(found.omega, np.repeat(exact**2, 2), rtol=5e-7)


def test_pinned_thick_rod():
    """Free to slide at one end and to turn about its axis at both: waves π c/2 of extension and π c of torsion (K3)."""
    found = dr.modes(dr.Scene([FLAT.straight(THICK)], PINNED), elements=16, modes=7)
    waves = np.pi * np.array([0.5 * np.sqrt(1200.0), np.sqrt(600 / 1.3)])
    np.testing.assert_allclose(found.omega, [0.0, *np.repeat(TIMOSHENKO_PINNED, 2), *waves], rtol=5e-7)
    np.testing.assert_array_equal(found.multiplicity, [1, 2, 2, 2, 2, 1, 1])


@pytest.mark.parametrize(("section", "rigid"), [(THICK, 3), (THIN, 2)], ids=["thick", "thin"])
def test_rod_on_one_pin(section, rigid):
    """Three turns about the pin, of which the one about its axis is no motion without rotary inertia."""
    found = dr.modes(dr.Scene([SKEW.straight(section)], [dr.Pin("start")]), elements=8, modes=rigid + 2)
    np.testing.assert_array_equal(found.omega[:rigid], 0.0)
    np.testing.assert_array_equal(found.multiplicity, [rigid] * rigid + [2, 2])
    if section is THIN:
        np.testing.assert_allclose(found.omega[rigid:], CLAMPED_PINNED[0] ** 2, rtol=1e-6)


def test_hanging_chain():
    """K4: j₀ₙ/2 √(g/L) in the limit of no stiffness, to which √EI/L is the distance at a pin."""
    section = dr.Section(GJ=1e-6, EI=1e-6, rhoA=1.0, rhoI=(0, 0, 0), rigid={"shear", "extension"})
    rod = dr.Rod.straight(length=1.0, section=section, start=(0, 0, 0), direction=(0, 0, -1))
    scene = dr.Scene([rod], [dr.Pin("start")], [dr.Gravity((0, 0, -1.0), history=dr.Steady())])
    found = dr.modes(scene, elements=16, modes=4)
    np.testing.assert_allclose(found.omega, np.repeat(BESSEL / 2, 2), rtol=2e-4)


def test_free_rod_has_six_rigid_motions():
    found = dr.modes(dr.Scene([SKEW.straight(THICK)]), elements=16, modes=10)
    np.testing.assert_array_equal(found.omega[:6], 0.0)
    np.testing.assert_array_equal(found.multiplicity[:6], 6)
    np.testing.assert_allclose(found.omega[6:], np.repeat(TIMOSHENKO_FREE, 2), rtol=5e-7)


def test_spin_without_inertia_is_no_motion():
    """A thin free rod has five rigid motions: nothing resists a turn about its axis, neither stiffness nor mass."""
    found = dr.modes(dr.Scene([SKEW.straight(THIN)]), elements=16, modes=7)
    np.testing.assert_array_equal(found.omega[:5], 0.0)
    np.testing.assert_allclose(found.omega[5:], FREE[0] ** 2, rtol=1e-7)


@pytest.mark.parametrize("g", [10.0, -10.0])
def test_pendulum(g):
    """Hanging it swings in two directions with ω² = 3g/2L; standing it falls as fast."""
    section = dr.Section(EA=1e8, GA=1e8, GJ=1e4, EI=1e6, rhoA=1.0, rhoI=(1e-3, 0, 0))
    rod = dr.Rod.straight(length=1.0, section=section, start=(0, 0, 0), direction=(0, 0, -1))
    scene = dr.Scene([rod], [dr.Pin("start")], [dr.Gravity((0, 0, -g), history=dr.Steady())])
    found = dr.modes(scene, elements=4, modes=3)
    swings = np.delete(found.omega, np.argmin(np.abs(found.omega)))
    np.testing.assert_allclose(swings, np.sqrt(1.5 * g + 0j), rtol=1e-5)


def test_within_the_plane():
    scene = cantilever(FLAT.straight(THIN))
    found = dr.modes(scene, elements=16, modes=3, kinematics=dr.Planar((0, 0, 1)))
    np.testing.assert_allclose(found.omega, CANTILEVER**2, rtol=5e-7)
    np.testing.assert_array_equal(found.multiplicity, 1)


@pytest.mark.parametrize("T", [10.0, -5.0])
def test_tension_raises_frequencies(T):
    """Reference cases K4: ω = √((nπ)⁴ + T (nπ)²)."""
    found = dr.modes(pulled(T), elements=16, modes=4)
    n = np.pi * np.array([1, 1, 2, 2])
    np.testing.assert_allclose(found.omega, np.sqrt(n**4 + T * n**2), rtol=1e-7)


def test_unstable_direction_grows():
    """Beyond the Euler load ω² of the first mode is negative."""
    found = dr.modes(pulled(-20.0), elements=16, modes=3)
    rate = np.sqrt(20 * np.pi**2 - np.pi**4)
    np.testing.assert_allclose(found.omega[:2], 1j * rate, rtol=1e-7)
    np.testing.assert_array_equal(found.frequencies[:2], 0.0)
    assert not found.stable
    assert found.omega[2] == pytest.approx(np.sqrt(16 * np.pi**4 - 80 * np.pi**2), rel=1e-6)


def test_frequency_vanishes_at_the_critical_load():
    """ω² falls linearly with the load of a straight column, to zero at the load that `buckling` finds."""
    scene = pushed(9.0)
    result = dr.solve(scene, elements=8, kinematics=dr.Spatial())
    squares = [dr.modes(scene, at=at, elements=8, modes=1).omega[0].real ** 2 for at in (None, result)]
    factor = dr.buckling(scene, elements=8, modes=1).factors[0]
    assert squares[0] / (squares[0] - squares[1]) == pytest.approx(factor, rel=1e-7)


def test_at_the_critical_load():
    """Two directions in which the column neither swings nor falls."""
    critical = 10.0 * dr.buckling(pushed(10.0), elements=8, modes=1).factors[0]
    result = dr.solve(pushed(critical), elements=8, kinematics=dr.Spatial())
    found = dr.modes(pushed(critical), at=result, elements=8, modes=3)
    np.testing.assert_array_equal(found.omega[:2], 0.0)
    np.testing.assert_array_equal(found.multiplicity[:2], 2)
    assert found.omega[2] == pytest.approx(np.sqrt(12.0) * np.pi**2, rel=1e-5)


def test_a_moment_along_the_rod_does_not_change_its_frequencies_in_the_plane():
    """Bent to a quarter circle by its tip moment it vibrates as one that was made so: both store ½ ∫ EI (Δκ)²."""
    section = replace(THIN, rhoI=(1e-3, 5e-4, 5e-4))
    scene = dr.Scene([FLAT.straight(section)], [dr.Clamp("start")], [dr.PointMoment((0, 0, np.pi / 2), "end")])
    bent = dr.modes(scene, at=dr.solve(scene, elements=16), elements=16, modes=3, kinematics=dr.Planar())
    arc = dr.Scene([FLAT.arc(section, radius=2 / np.pi, angle=np.pi / 2)], [dr.Clamp("start")])
    made = dr.modes(arc, elements=16, modes=3, kinematics=dr.Planar())
    np.testing.assert_allclose(bent.omega, made.omega, rtol=1e-7)
    assert bent.stable


@pytest.mark.parametrize(
    ("degree", "elements"), [pytest.param(1, (8, 16), marks=pytest.mark.slow), (2, (4, 8)), (3, (2, 4))]
)
def test_order(degree, elements):
    found = [dr.modes(cantilever(FLAT.straight(THIN)), elements=n, degree=degree, modes=1) for n in elements]
    errors = [abs(modes.omega[0] - CANTILEVER[0] ** 2) for modes in found]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2 * degree, abs=0.4)


def test_units():
    """A ramie fibre of 40 mm, in hertz."""
    section = dr.Section.ramie()
    rod = dr.Rod.straight(length=0.04, section=section, start=(0, 0, 0), direction=(1, 0, 0))
    found = dr.modes(dr.Scene([rod], [dr.Clamp("start")]), elements=8, modes=1)
    slender = CANTILEVER[0] ** 2 * np.sqrt(section.EI[0] / (section.rhoA * 0.04**4)) / (2 * np.pi)
    assert found.frequencies[0] == pytest.approx(slender, rel=1e-5)


@pytest.mark.parametrize(("name", "value"), [("rhoA", None), ("rhoI", None)])
def test_missing_density(name, value):
    given = {"rhoA": 1.0, "rhoI": (1.0, 1.0, 1.0)} | {name: value}
    section = dr.Section(EA=1e3, GA=1e3, GJ=1.0, EI=1.0, **given)
    with pytest.raises(dr.SceneError, match=rf"rods\[0\].section.{name} must be given"):
        dr.modes(cantilever(FLAT.straight(section)), elements=4)


def test_same_on_any_number_of_ranks():
    scene = replace(pulled(-20.0), rods=[FLAT.straight(THICK)])
    together, alone = (dr.modes(scene, elements=6, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    np.testing.assert_allclose(together.omega, alone.omega, rtol=1e-10, atol=1e-10)
    np.testing.assert_array_equal(together.multiplicity, alone.multiplicity)
