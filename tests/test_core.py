"""A core that rolls: a solid cylinder, or any round body, down an incline in both models, straight and in its track."""

from __future__ import annotations

from functools import partial
from math import cos, pi, radians, sin

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from dolfinrod.scene.core import STRAIGHT

SLOPE, G, MU, EPS = radians(15.0), 9.81, 0.64, 1e8
RADIUS, LENGTH, DENSITY = 0.025, 0.06, 1000.0
MASS = DENSITY * pi * RADIUS**2 * LENGTH
T, STEPS = 0.25, 100
DOWN, NORMAL = np.array([0.0, cos(SLOPE), -sin(SLOPE)]), np.array([0.0, sin(SLOPE), cos(SLOPE)])
SOLID = dr.Core((0, 0, 0), (1, 0, 0), RADIUS, LENGTH, density=DENSITY)
MODELS = {
    "continuum": partial(dr.solve, elements=2, degree=2),
    "discrete": partial(discrete.solve, elements=4),
}


def of_section(polar: float) -> dr.Core:
    """A core as heavy and stiff as the solid one, with another moment of inertia, polar · m R²."""
    solid = SOLID.section
    inertia = tuple(polar * solid.rhoA * RADIUS**2 * np.array([1.0, 0.5, 0.5]))
    section = dr.Section(
        EA=solid.EA, EI=solid.EI, GJ=solid.GJ, rhoA=solid.rhoA, rhoI=inertia, radius=RADIUS, rigid={"shear"}
    )
    return dr.Core((0, 0, 0), (1, 0, 0), RADIUS, LENGTH, section=section)


def rolling(core: dr.Core) -> dr.Scene:
    """The core at rest on a slope that falls towards +y, pressed in by its weight."""
    weight = core.section.rhoA * G
    on_slope = dr.Rod.straight(LENGTH, core.section, start=tuple((RADIUS - weight * cos(SLOPE) / EPS) * NORMAL))
    return dr.Scene(
        rods=[on_slope],
        supports=core.supports(0),
        loads=[dr.Gravity((0, 0, -G))],
        contacts=[dr.Contact(dr.Plane((0, 0, 0), tuple(NORMAL)), dr.Penalty(EPS), dr.Coulomb(MU))],
        motion=dr.Dynamic(T, dt=T / STEPS, scheme=dr.ImplicitEuler()),
    )


@pytest.mark.parametrize(("model", "polar"), [("continuum", 0.5), ("discrete", 0.5), ("discrete", 1.0)])
def test_a_core_rolls_down_an_incline_without_slip(model, polar):
    core = SOLID if polar == 0.5 else of_section(polar)
    rod = MODELS[model](rolling(core)).rods[0]
    # a = g sin β / (1 + I/mR²), textbook: ⅔ g sin β for a solid cylinder.
    a = G * sin(SLOPE) / (1.0 + polar)
    v, spin = np.asarray(rod.v)[-1] @ DOWN, -np.asarray(rod.omega)[-1, :, 0]
    np.testing.assert_allclose(v, a * T, rtol=1e-3)
    np.testing.assert_allclose(RADIUS * spin, v, rtol=1e-3)
    # Equal steps of implicit Euler go ½ a T² (1 + 1/n).
    np.testing.assert_allclose((rod.r[-1] - rod.r[0]) @ DOWN, 0.5 * a * T**2 * (1.0 + 1.0 / STEPS), rtol=1e-3)
    across = rod.r[:, :, 1:]
    assert np.abs(across - across[:, :1]).max() < STRAIGHT * RADIUS
    np.testing.assert_allclose(rod.r[:, :, 0] - rod.s, 0.0, atol=STRAIGHT * RADIUS)


@pytest.mark.parametrize("model", MODELS)
def test_a_force_as_large_as_its_weight_leaves_a_core_straight(model):
    held = dr.Core((0, 0, 0), (1, 0, 0), RADIUS, LENGTH, density=DENSITY, free=())
    scene = dr.Scene([held.rod], held.supports(0), [dr.PointForce((0, 0, -MASS * 9.81), "end")])
    off = MODELS[model](scene).rods[0].r[-1, -1]
    # F L³/12EI, the sway between parallel ends, which elements of either model bend to exactly.
    assert -off[2] == pytest.approx(STRAIGHT * RADIUS, rel=1e-9)
