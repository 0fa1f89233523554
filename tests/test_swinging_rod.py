"""A rod that swings in space while its clamp moves and turns: orders in the step, and the moments of both models."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise

from mpi4py import MPI

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.scenes import SKEW, largest

MIDPOINT, EULER = dr.Midpoint(), dr.ImplicitEuler()
# So thick and soft that the steps resolve all vibrations of the mesh; no two inertias or stiffnesses alike.
SOFT = dr.Section(EA=100.0, GA=(50.0, 40.0), GJ=0.8, EI=(1.0, 2.0), rhoA=1.0, rhoI=(0.1, 0.04, 0.06), radius=0.05)
# Hardly any rotary inertia, and no shear, which the discrete model does not know.
SLIM = dr.Section(EA=900.0, GJ=0.7, EI=(2.0, 1.0), rhoA=1.0, rhoI=(2e-6, 1e-6, 1e-6), radius=0.02, rigid={"shear"})
CONTINUUM = partial(dr.solve, elements=4, degree=3)
SCHEMES = pytest.mark.parametrize(
    ("solve", "scheme", "order"),
    [(CONTINUUM, MIDPOINT, 2), (CONTINUUM, EULER, 1), (partial(discrete.solve, elements=6), EULER, 1)],
    ids=["continuum, midpoint", "continuum, Euler", "discrete, Euler"],
)


def begun(t: float) -> float:
    """From 0 to 1 in a second, so smoothly that no vibration is struck."""
    return float(np.sin(0.5 * np.pi * min(t, 1.0)) ** 4)


def swinging(t_end: float, dt: float, scheme: dr.ImplicitEuler | dr.Midpoint) -> dr.Scene:
    """Under its weight, a moment that turns with its end and a wind, on a clamp that moves and turns out of plane."""
    clamp = dr.Prescribed(
        "start", displacement=SKEW.turned((0.1, 0.0, 0.2)), rotation=SKEW.turned((0.4, 0.3, 0.8)), history=begun
    )
    loads = [
        dr.Gravity(SKEW.turned((0.5, -3.0, 1.0)), history=begun),
        dr.FollowerMoment((0.2, -0.4, 0.7), "end", history=begun),
        dr.PointForce(SKEW.turned((0.3, 0.5, -0.8)), 0.5, history=lambda t: t**2 * np.exp(-t)),
    ]
    air = dr.Air(field=lambda x, t: begun(t) * np.cross([0.0, 3.0, 5.0 + t], x), density=1.0, viscosity=0.02)
    motion = dr.Dynamic(t_end=t_end, dt=dt, scheme=scheme, output=t_end)
    return dr.Scene([SKEW.straight(SOFT)], [clamp], loads, air=air, motion=motion)


@pytest.mark.serial
@SCHEMES
def test_orders_in_the_step(solve, scheme, order):
    """Positions and frames everywhere, velocities and spins off the clamp, forces and moments."""
    ends = []
    for n in (10, 20, 40, 80):
        h = solve(swinging(0.4, 0.4 / n, scheme)).rods[0]
        ends.append((h.r[-1], h.frames[-1], h.v[-1, 1:], h.omega[-1, 1:], h.n[-1], h.m[-1]))
    for values in zip(*ends, strict=True):
        gaps = [largest(fine - coarse) for coarse, fine in pairwise(values)]
        assert np.log2(gaps[0] / gaps[-1]) / 2.0 == pytest.approx(order, abs=0.25)


@pytest.mark.serial
def test_moments_of_both_models_agree():
    """Backward Euler with the same steps: what is left is the discrete model's n⁻², in forces and moments alike."""
    scene = on_slim_rod(EULER)
    h = dr.solve(scene, elements=8, degree=3).rods[0]
    gaps = []
    for n in (16, 32):
        d = discrete.solve(scene, elements=n).rods[0]
        of, at = (np.abs(rod.s[:, None] - np.linspace(0.0, 0.75, 4)).argmin(axis=0) for rod in (d, h))
        gaps.append([largest(getattr(d, name)[-1, of] - getattr(h, name)[-1, at]) for name in ("m", "n")])
    ratios = np.divide(*gaps)
    assert ratios == pytest.approx(4.0, abs=0.8)
    assert largest(gaps[1]) < 0.01 * largest(h.m[-1])


@pytest.mark.serial
@pytest.mark.parametrize(
    ("solve", "cells"),
    [(dr.solve, (4, 8)), (discrete.solve, (16, 32))],
    ids=["continuum", "discrete"],
)
def test_moments_are_those_of_the_curvature(solve, cells):
    """M = (GJ κ₁, EI₂ κ₂, EI₃ κ₃), κ from the frames of neighbouring nodes, which is known to the square of their gap.

    At the end it is the moment that acts there, 0.2, −0.4, 0.7.
    """
    gaps = []
    for n in cells:
        h = solve(on_slim_rod(EULER), elements=n).rods[0]
        gaps.append(largest(of_curvature(h) - 0.5 * (h.m[-1, 1:] + h.m[-1, :-1])))
    assert gaps[0] / gaps[1] == pytest.approx(4.0, abs=1.0)
    assert h.m[-1, -1] == pytest.approx([0.2, -0.4, 0.7], abs=1e-3)


@pytest.mark.serial
def test_moments_between_midpoint_steps_are_those_of_the_curvature():
    """There forces and moments are not unknowns, but come from the strains: in order two of the step."""
    section, gaps = replace(SLIM, GA=(400.0, 300.0), rigid=frozenset()), []
    for dt in (0.01, 0.005):
        h = CONTINUUM(on_slim_rod(MIDPOINT, section, dt)).rods[0]
        gaps.append(largest(h.m[-1, -1] - [0.2, -0.4, 0.7]))
        assert largest(of_curvature(h) - 0.5 * (h.m[-1, 1:] + h.m[-1, :-1])) < 0.01 * largest(h.m[-1])
    assert gaps[0] / gaps[1] == pytest.approx(4.0, abs=1.0)


def of_curvature(h: dr.RodHistory) -> np.ndarray:
    """Mean moments between neighbouring nodes by their frames at the last time."""
    turned = np.swapaxes(h.frames[-1, :-1], 1, 2) @ h.frames[-1, 1:]
    return exp_inverse(turned) / np.diff(h.s)[:, None] * [SLIM.GJ, *SLIM.EI]


def on_slim_rod(scheme: dr.ImplicitEuler | dr.Midpoint, section: dr.Section = SLIM, dt: float = 0.02) -> dr.Scene:
    """The same with a rod that resists next to no turning of its sections, a second long."""
    scene = swinging(1.0, dt, scheme)
    return replace(scene, rods=(SKEW.straight(section),))


def exp_inverse(R: np.ndarray) -> np.ndarray:
    """Rotation vectors of small rotations, shapes (n, 3, 3) → (n, 3)."""
    axial = 0.5 * np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=1)
    sine = np.linalg.norm(axial, axis=1, keepdims=True)
    return axial * np.arcsin(sine) / sine


@pytest.mark.parametrize("scheme", [MIDPOINT, EULER], ids=["midpoint", "Euler"])
def test_one_and_two_ranks_agree(scheme):
    scene = swinging(0.2, 0.01, scheme)
    together, alone = (CONTINUUM(scene, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    for name in ("r", "frames", "v", "omega", "n", "m"):
        a, b = getattr(together.rods[0], name), getattr(alone.rods[0], name)
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-10 * max(1.0, largest(b)))
    for name, values in alone.energy.items():
        np.testing.assert_allclose(together.energy[name], values, rtol=0, atol=1e-10 * max(1.0, largest(values)))
