"""Errors fall with the square of the element length, and where they do not the reason shows."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import discrete
from dolfinrod.scene import Clamp, Gravity, LineForce, PointForce, Rod, Scene, Section, Static
from tests.scenes import FLAT, KIRCHHOFF, Pose, bend, cantilever, orders, rolled_up, tip_loaded

# Elliptic integrals, case A1: inextensible elastica at P L²/EI = 10.
ELASTICA = np.array([1.0 - 0.5549955977537513, 0.8106090248802964])
# Shooting, GA infinite: R = 100, F = 600 (peers.md, P3).
BEND = np.array([47.15215022, 15.68535578, 53.47176295])
every_form = pytest.mark.parametrize(
    ("frame", "axial"), [("element", "chord"), ("element", "paper"), ("node_i", "chord"), ("node_i", "paper")]
)


def distance(result, exact) -> float:
    return float(np.linalg.norm(result.tip[: len(exact)] - exact))


@every_form
def test_tip_of_the_elastica(frame, axial):
    """In a plane order 2 in every form. With EA = 1e8 the identity r = r_rigid + P s/EA gives the exact tip."""
    exact = ELASTICA + np.array([0.0, 10.0 / 1e8])
    n = [20, 40, 80]
    errors = [
        distance(discrete.solve(tip_loaded(KIRCHHOFF, 10.0, FLAT), elements=k, frame=frame, axial=axial), exact)
        for k in n
    ]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.35)
    assert orders(n, errors)[-1] == pytest.approx(2.0, abs=0.17)
    assert errors[-1] < (2.5e-5 if axial == "chord" else 1e-4)


def test_extensible_elastica_is_the_inextensible_one_shifted():
    """With EA = GA a dead tip force only adds P s/EA; without shear the axial part of it remains, order 2 to that."""
    scene = tip_loaded(Section(EA=1e4, GA=1e4, GJ=1.0, EI=1.0), 10.0, FLAT)
    exact = np.array([0.4451208473, 0.8114082875])
    n = [20, 40, 80]
    errors = [distance(discrete.solve(scene, elements=k), exact) for k in n]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize(("frame", "axial"), [("element", "chord"), ("element", "paper"), ("node_i", "chord")])
def test_curved_rod_in_space(frame, axial):
    n = [16, 32, 64]
    errors = [distance(discrete.solve(bend(600.0, pose=FLAT), elements=k, frame=frame, axial=axial), BEND) for k in n]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.15)


def test_the_letter_of_the_element_is_first_order_in_space():
    """Eq. 17 in the frame of node i leaves out the torque δ_v F_w − δ_w F_v of the shear force about its axis.

    δ is κ l²/2 there, so that a rod in space lacks a couple of κ l F/2 per length: order 1. In a plane the torque is
    zero and order 2 remains, with the fake strain κ² l²/6 of Eq. 16.
    """
    n = [32, 64, 128]
    scene = bend(600.0, pose=FLAT)
    errors = [distance(discrete.solve(scene, elements=k, frame="node_i", axial="paper"), BEND) for k in n]
    assert orders(n, errors)[-1] == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("elements", [10, 40])
def test_fake_strain_of_equation_16(elements):
    """A ring of curvature κ = 2π held open by nothing: Eq. 16 as printed makes each chord κ² l²/6 too long.

    An element of constant curvature turns by κ l: the normal of node i sees cos(κ l/2) of the chord.
    """
    rod = discrete.solve(rolled_up(KIRCHHOFF, 0.25, FLAT), elements=elements, axial="paper").rods[0]
    l, κ = 1.0 / elements, np.pi / 2
    chords = np.linalg.norm(np.diff(rod.r[-1], axis=0), axis=1)
    assert chords == pytest.approx(l / np.cos(κ * l / 2), rel=1e-10)
    true = 2 / κ * np.sin(κ * l / 2)
    assert chords / true - 1 == pytest.approx(κ**2 * l**2 / 6, rel=0.02)


def test_heavy_cantilever_of_the_papers_fibre():
    """process.md 1.6: ramie, 40 mm, tip drop 5.5571 mm at x = 39.5561 mm."""
    rod = Rod.straight(0.04, Section.ramie())
    scene = Scene([rod], [Clamp("start")], [Gravity((0, 0, -9.81))])
    n = [10, 20, 40]
    tips = [discrete.solve(scene, elements=k).tip for k in n]
    assert tips[-1] == pytest.approx([39.5561e-3, 0.0, -5.5571e-3], abs=3e-6)
    steps = [float(np.linalg.norm(b - a)) for a, b in pairwise(tips)]
    assert np.log2(steps[0] / steps[1]) == pytest.approx(2.0, abs=0.1)


def test_resultants_of_a_line_load_hold_up_to_the_ends():
    """A slightly loaded cantilever: n₂ = q(L − s), m₃ = q(L − s)²/2, exact at the nodes for lumped loads."""
    q = 1e-3
    h = discrete.solve(cantilever(FLAT.straight(KIRCHHOFF), LineForce((0, q, 0))), elements=10).rods[0]
    assert h.n[-1, :, 1] == pytest.approx(q * (1 - h.s), abs=1e-5 * q)
    assert h.m[-1, :, 2] == pytest.approx(q * (1 - h.s) ** 2 / 2, abs=1e-5 * q)


@pytest.mark.parametrize(("frame", "limit"), [("element", 0.02), ("node_i", 0.2)])
def test_increments_without_iterations_are_first_order_in_their_number(frame, limit):
    """2.3.3: halving the increments halves the distance from where infinitely many end."""
    tips = [
        discrete.solve(stepped(FLAT, steps), elements=20, equilibrium=False, frame=frame).tip
        for steps in (50, 100, 200, 400)
    ]
    gaps = [float(np.linalg.norm(b - a)) for a, b in pairwise(tips)]
    assert np.log2(np.divide(gaps[:-1], gaps[1:])) == pytest.approx(1.0, abs=0.05)
    end = 2 * tips[-1] - tips[-2]
    equilibrium = discrete.solve(stepped(FLAT, 1), elements=20).tip
    assert np.linalg.norm(end - equilibrium) < limit


def test_increments_end_at_the_equilibrium_of_the_same_mesh():
    tips = [discrete.solve(stepped(FLAT, steps), elements=20, equilibrium=False).tip for steps in (200, 400)]
    equilibrium = discrete.solve(stepped(FLAT, 1), elements=20).tip
    assert np.linalg.norm(tips[0] - equilibrium) < 2e-3
    assert 2 * tips[1] - tips[0] == pytest.approx(equilibrium, abs=2e-5)


def stepped(pose: Pose, steps: int) -> Scene:
    load = PointForce(pose.turned((0, 2.0, 0)), "end")
    return cantilever(pose.straight(KIRCHHOFF), load, motion=Static(steps=steps))
