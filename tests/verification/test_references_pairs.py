"""References of rods that touch rods: two methods each, balances, limits; no model is asked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from verification.references.bundle import Heap, Vee
from verification.references.crossing import Crossing, Strand
from verification.references.crossinglines import crossed
from verification.references.crossingshot import shot
from verification.references.plied import Ply
from verification.references.rolling import Plank, driven, most_turns
from verification.references.shots import Exchange, Lens

pytestmark = pytest.mark.serial

FIBRE = Strand(1e-2, 10.7627, 2.690683e-10, 1e-4, 0.0)
PLY = Ply(0.9998, 0.4, 1.0, 1e3, 0.0, 1e4, 0.8, 1.0)


def pressed(pull: float = 1e-4, eps_N: float = 4e5) -> Crossing:
    strand = replace(FIBRE, pull=pull)
    return Crossing((strand, strand), eps_N, 2e-5, 1e-6)


def test_crossed_fibres_by_collocation_and_by_shooting():
    """From either end of the same equations, SciPy's steps from their own linear theory, to 1e-8 and better."""
    found, other = crossed(pressed()), shot(pressed())
    assert (*found.heights, found.force) == pytest.approx(other, rel=1e-11)
    # A lens of 7 µm in a rod of 10 mm, found to round-off; finer panels change nothing.
    assert crossed(pressed(), panels=5).lens == pytest.approx(found.lens, rel=1e-11)


def test_flat_crossings_are_those_of_linear_theory():
    """(ℓ − tanh(kℓ)/k)/2T of each rod and F = 4/3 ε δ √(2 D δ) of straight ones, but for slopes squared and a/ℓ."""
    found = crossed(pressed())
    assert found.force == pytest.approx(found.crossing.linear, rel=2e-3)
    δ, a = found.crossing.lens(found.force)
    assert found.distance == pytest.approx(found.crossing.reach - δ, rel=1e-3)
    assert found.lens == pytest.approx((a, a), rel=2e-2)


@pytest.mark.slow
def test_deep_and_unequal_crossings_by_both_methods():
    strands = Strand(1.0, 1e5, 1.0, 50.0, -0.1), Strand(1.0, 1e5, 2.0, 100.0, -0.1)
    posed = Crossing(strands, 1e8, 0.02)
    found = crossed(posed)
    assert (*found.heights, found.force) == pytest.approx(shot(posed), rel=1e-11)
    other = crossed(replace(posed, strands=strands[::-1]))
    assert other.heights[::-1] == pytest.approx(found.heights, rel=1e-11)
    assert other.force == pytest.approx(found.force, rel=1e-12)


@given(
    angle=st.floats(0.05, 0.7),
    GJ=st.floats(0.1, 2.0),
    natural=st.tuples(st.floats(-0.2, 0.4), st.floats(-0.1, 0.3)),
    left=st.booleans(),
)
def test_a_ply_balances_along_its_own_curve(angle, GJ, natural, left):
    """n′ + f = 0 and m′ + r′ × n = 0 by differences of the curve, its frames and resultants, for any helix."""
    hand = -1.0 if left else 1.0
    ply = replace(PLY, angle=hand * angle, GJ=GJ, natural=(hand * natural[0], natural[1]))
    assert max(ply.off_balance(np.linspace(0.0, 5.0, 4))) < 1e-8


def test_resultants_of_a_ply_along_its_axis_are_the_same_everywhere():
    for s in (0.0, 1.3, 4.0):
        at = np.array([s])
        n, m = PLY.frames(at)[0] @ PLY.force, PLY.frames(at)[0] @ PLY.moment
        around = m + np.cross(PLY.centreline(at)[0] - PLY.centreline(np.zeros(1))[0] * [1, 0, 0], n)
        assert (2.0 * n[0], 2.0 * around[0]) == pytest.approx((PLY.tension, PLY.torque), rel=1e-13)


def test_a_mirrored_ply_pulls_as_much_and_turns_the_other_way():
    mirrored = replace(PLY, angle=-PLY.angle)
    assert (mirrored.tension, mirrored.torque) == pytest.approx((PLY.tension, -PLY.torque), rel=1e-14)


def test_strings_wound_about_each_other_press_by_tension_over_radius_of_curvature():
    """p = S sin²α/R without stiffness against bending and twisting."""
    limp = replace(PLY, EI=1e-9, GJ=1e-9)
    assert limp.line_load == pytest.approx(limp.force[0] * np.sin(PLY.angle) ** 2 / PLY.radius, rel=1e-2)
    with pytest.raises(ValueError, match="π/4"):
        replace(PLY, angle=0.9)


@given(slope=st.floats(0.3, 1.0), right=st.integers(0, 2), left=st.integers(0, 2))
@settings(max_examples=20)
def test_circles_in_a_v_by_statics_and_by_springs(slope, right, left):
    """Springs of any stiffness come to the closed form as 1/ε, those between circles of equal ε at once."""
    vee = Vee(slope, 2.0, right, left, 0.1)
    # Lowest pressed to both flanks, chains of both flanks apart.
    if min(vee.bottom) < 0.1 or (right and left and 4.0 * np.cos(slope) < 2.1):
        return
    off = [np.abs(_walls(vee, eps) - vee.bottom).max() for eps in (1e5, 1e6)]
    assert off[1] < 1e-4
    assert off[1] < 0.11 * off[0] + 1e-9


def _walls(vee: Vee, eps: float) -> np.ndarray:
    """Of the lowest circle, every other load checked against the weights."""
    n = 1 + vee.right + vee.left
    heap = Heap(np.full(n, 0.1), np.tile([0.0, -vee.load], (n, 1)), np.zeros((2, 2)), vee.flanks, eps, eps)
    found = heap.settled(vee.centres * (1.0 - 1e-9))
    assert (found.walls @ vee.flanks).sum(axis=0) == pytest.approx((0.0, n * vee.load), abs=1e-8)
    for chain, links in zip((range(1, vee.right + 1), range(vee.right + 1, n)), vee.links, strict=True):
        below = [0, *chain]
        assert [found.pairs[a, b] for a, b in zip(chain, below, strict=False)] == pytest.approx(links, rel=1e-3)
    return found.walls[0]


def test_two_circles_in_a_v_of_45_degrees():
    """By hand: q/√2 on the upper one's flank, as much between them; √2/2 q and √2 q below."""
    vee = Vee(np.pi / 4, 2.0, 1, 0)
    assert vee.flank == pytest.approx(np.sqrt(2.0))
    assert vee.links[0] == pytest.approx([np.sqrt(2.0)])
    assert vee.bottom == pytest.approx((np.sqrt(2.0), 2.0 * np.sqrt(2.0)))


@given(first=st.floats(0.1, 10.0), second=st.floats(0.1, 10.0), v=st.floats(0.1, 5.0), w=st.floats(-5.0, 0.0))
def test_exchanges_keep_momentum_and_energy(first, second, v, w):
    found = Exchange(first, second, v, w)
    a, b = found.after
    assert first * a + second * b == pytest.approx(first * v + second * w, abs=1e-12)
    assert first * a**2 + second * b**2 == pytest.approx(first * v**2 + second * w**2, rel=1e-12)
    assert b - a == pytest.approx(v - w, rel=1e-12)


def test_the_lens_between_stiff_crossed_rods():
    """Its energy against SciPy's quadrature of both forces, its time against steps of the motion."""
    lens, m, v = Lens(1e6, 0.02), 0.5, 0.1
    δ = lens.deepest(m, v)
    assert lens.energy(0.02 - δ) == pytest.approx(0.5 * m * v**2, rel=1e-12)

    def force(d: float) -> float:
        a = np.sqrt(max(0.02**2 - d**2, 0.0))
        points, weights = np.polynomial.legendre.leggauss(40)
        D = np.sqrt((a * points) ** 2 + d**2)
        return float(1e6 * a * weights @ ((0.02 - D) * d / D))

    step = 1e-6 * δ
    near = lens.energy(0.02 - δ - step), lens.energy(0.02 - δ + step)
    assert (near[0] - near[1]) / (2.0 * step) == pytest.approx(force(0.02 - δ), rel=1e-6)
    t = lens.time(m, v)
    # From the deepest point to where they part.
    moved = solve_ivp(lambda _, u: (u[1], force(u[0]) / m), (0.0, 0.5 * t), (0.02 - δ, 0.0), rtol=1e-10, atol=1e-16)
    assert moved.y[:, -1] == pytest.approx((0.02, v), abs=1e-6 * δ, rel=1e-8)
    # Shallow lenses: F = 4/3 ε √(2D) δ^3/2, which touch as Hertz's spheres do, 2.9433 δ/v.
    shallow = lens.deepest(m, 1e-4)
    assert lens.time(m, 1e-4) == pytest.approx(2.9432766 * shallow / 1e-4, rel=1e-3)


def test_rollers():
    """Without gaps a plank goes twice as far as its roller; equal rods turn one another by as much."""
    plank = Plank(0.1, 0.2)
    assert plank.axis == pytest.approx(0.1)
    assert plank.angle / (2.0 * np.pi) == pytest.approx(most_turns(plank.axis, 0.1))
    assert driven(0.3, 0.1, 0.1, -1e-4) == pytest.approx(-0.3)
    assert driven(0.3, 0.2, 0.1, 0.0) == pytest.approx(-0.6)
