"""Moments along rods whose sections turn: the method of sections in motion."""

from __future__ import annotations

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
