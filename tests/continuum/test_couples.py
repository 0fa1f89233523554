"""Moments along rods whose sections turn: the method of sections in motion."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import both_kinematics

# Thick enough for the turning of its sections to count.
THICK = dr.Section(EA=1200.0, GA=(400.0, 300.0), GJ=0.8, EI=(1.0, 2.0), rhoA=1.0, rhoI=(3e-2, 1e-2, 2e-2))
PLACES = (0.0, 0.125, 0.375, 0.625, 0.875, 1.0)


def pulse(t: float) -> float:
    """sin⁴ over 0.6 s."""
    return float(np.sin(np.pi * t / 0.6) ** 4)


def moments(elements: int, kinematics: object, scheme: object) -> np.ndarray:
    """Bending moment at some places of a cantilever with a pin in its middle, pushed and twisted for 0.4 s."""
    scene = dr.Scene(
        [dr.Rod.straight(1.0, THICK)],
        [dr.Clamp("start"), dr.Pin(0.5)],
        [
            dr.PointForce((0.0, 1.0, 0.0), at="end", history=pulse),
            dr.PointMoment((0.0, 0.0, 0.3), at=0.25, history=pulse),
        ],
        motion=dr.Dynamic(0.4, 0.02, scheme, output=0.4),
    )
    h = dr.solve(scene, elements=elements, kinematics=kinematics).rods[0]
    return np.array([h.m[-1, np.abs(h.s - s).argmin(), 2] for s in PLACES])


@pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])
@both_kinematics
def test_moments_of_turning_sections_converge(kinematics, scheme):
    """Between, next to and at supports and loads, by at least order 3; the free end has none."""
    coarse, medium, fine = (moments(n, kinematics, scheme) for n in (8, 16, 32))
    assert abs(coarse[-1]) <= 1e-12
    assert np.abs(coarse - fine).max() <= 1e-5 * np.abs(fine).max()
    assert np.abs(medium - fine).max() <= np.abs(coarse - fine).max() / 4.0


@pytest.mark.parametrize("rigid", [{"shear"}, {"shear", "extension"}], ids=["shear", "both"])
@both_kinematics
def test_rigid_strains_leave_the_moments_alone(kinematics, rigid):
    """A bent rod whose shear is rigid: between midpoint steps only strains that it has get resultants of their own."""
    section = dr.Section(EA=900.0, GA=400.0, GJ=0.7, EI=1.0, rhoA=1.0, rhoI=(2e-6, 1e-6, 1e-6), rigid=rigid)
    motion = dr.Dynamic(1.0, 0.02, dr.Midpoint(), output=1.0)
    weight = dr.Gravity((0.0, -3.0, 0.0), history=lambda t: float(np.sin(0.5 * np.pi * min(t, 1.0)) ** 4))
    scene = dr.Scene([dr.Rod.straight(1.0, section)], [dr.Clamp("start")], [weight], motion=motion)
    h = dr.solve(scene, elements=4, degree=3, kinematics=kinematics).rods[0]
    assert abs(h.m[-1, -1, 2]) <= 1e-9
    curvature = h.frames[-1, 1, 1, 0] - h.frames[-1, 0, 1, 0]
    assert h.m[-1, 0, 2] == pytest.approx(curvature / (h.s[1] - h.s[0]), rel=0.15)


@pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])
@both_kinematics
def test_a_rank_without_elements_or_without_inertia_moves_along(kinematics, scheme):
    """One element a rod: of two ranks one has none, or only sections that neither turn nor shear, and that damp."""
    other = dr.Section(EA=900.0, GJ=0.7, EI=1.0, rhoA=1.0, rhoI=(0.0, 0.0, 0.0), rigid={"shear"}, damping=0.01)
    rods = [dr.Rod.straight(1.0, THICK), dr.Rod.straight(1.0, other, start=(0.0, 1.0, 0.0))]
    spin = [dr.Velocity(omega=(0.0, 0.0, 2.0))]
    for posed in (rods[:1], rods):
        weight = [dr.Gravity((0.0, -3.0, 0.0))]
        motion = dr.Dynamic(0.1, 0.02, scheme)
        scene = dr.Scene(posed, [dr.Clamp("start")], weight, motion=motion, velocities=spin)
        together = dr.solve(scene, elements=1, kinematics=kinematics)
        alone = dr.solve(scene, elements=1, kinematics=kinematics, comm=MPI.COMM_SELF)
        for one, same in zip(together.rods, alone.rods, strict=True):
            np.testing.assert_allclose(one.r, same.r, rtol=0, atol=1e-12)
            np.testing.assert_allclose(one.m, same.m, rtol=0, atol=1e-10)
        for name, values in alone.energy.items():
            np.testing.assert_allclose(together.energy[name], values, rtol=0, atol=1e-10, err_msg=name)
