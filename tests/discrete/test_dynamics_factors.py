"""What makes steps in time quick: rows, factors that turn with their sections, how long they are trusted."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import discrete
from discrete.assembly import gather, scatter
from discrete.ends import Ends
from discrete.mass import node_masses
from discrete.mesh import mesh
from discrete.rotation import exp
from discrete.rows import cross, dot, of_frames, of_vectors, turn, turn_back, turned
from discrete.wear import Wear
from dolfinrod.scene import Clamp, Dynamic, Guide, Pin, PointForce, Rod, Scene, Section, Velocity
from tests.scenes import FLAT, SKEW, largest

HEAVY = Section(EA=900.0, GA=400.0, GJ=0.7, EI=(2.0, 1.0), rhoA=1.0, rhoI=(0.03, 0.02, 0.01))


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1), st.floats(0.0, 6.0))
def test_rows_are_the_rotations(seed, size):
    rng = np.random.default_rng(seed)
    R, v = exp(rng.normal(size=(5, 3))), rng.normal(size=(5, 3))
    θ = size * v / np.linalg.norm(v, axis=1)[:, None]
    found = turned(of_frames(R), of_vectors(θ)).transpose(2, 0, 1)
    assert found == pytest.approx(exp(θ) @ R, abs=1e-14)
    assert cross(of_vectors(θ), of_vectors(v + 1.0)).T == pytest.approx(np.cross(θ, v + 1.0), abs=1e-14)
    assert dot(of_vectors(θ), of_vectors(v)) == pytest.approx((θ * v).sum(axis=1))
    there = turn(of_frames(R), of_vectors(v)[None])
    assert there[0].T == pytest.approx(np.einsum("nij,nj->ni", R, v), abs=1e-14)
    assert turn_back(of_frames(R), there)[0].T == pytest.approx(v, abs=1e-14)


def test_ends_by_rows_are_those_of_the_assembly():
    """Of two rods, one of them curved."""
    rods = [Rod.arc(1.0, 0.7, HEAVY), FLAT.straight(HEAVY, start=(0, 2.0, 0))]
    cut = mesh(Scene(rods), [3, 4])
    rng, elements, n = np.random.default_rng(2), cut.elements, len(cut.x)
    ends, unknowns, force = Ends(elements, n), rng.normal(size=(n, 7)), rng.normal(size=(7, 13))
    assert (ends.gather(unknowns.T).T == gather(unknowns, elements.node_i)).all()
    assert (ends.scatter(force.T).T == scatter(force, elements.node_i, n)).all()
    assert ends.triads(of_frames(cut.R)).transpose(3, 2, 0, 1) == pytest.approx(elements.triads(cut.R), abs=1e-15)
    chords = cut.x[elements.node_i + 1] - cut.x[elements.node_i]
    assert (ends.chords(of_vectors(cut.x)).T == chords).all()


@pytest.mark.parametrize("supports", [(), (Pin("start"),)], ids=["free", "pinned"])
def test_factors_turn_with_a_rod(supports):
    """By 1.3 rad in 200 steps; factors in fixed directions would be made anew in almost every one."""
    section = Section(EA=1e4, GA=1.0, GJ=1e4, EI=1e4, rhoA=1.0)
    about = SKEW.placed((0.5 * (not supports), 0, 0))
    spun = Velocity(omega=SKEW.turned((0, 0, 4 * np.pi)), about=about)
    scene = Scene([SKEW.straight(section)], supports, motion=Dynamic(0.1, 5e-4, output=0.1), velocities=[spun])
    result = discrete.solve(scene, elements=6)
    assert SKEW.turned((0, 0, 1.0)) @ result.rods[0].frames[-1, 0] == pytest.approx([0, 0, 1.0], abs=1e-9)
    assert result.statistics.factorizations < 200 / 10
    assert result.statistics.newton_iterations <= 3 * 200


def test_sections_held_in_part_do_not_mix_with_free_directions():
    """A sleeve that slides along x: nothing else moves there, however far the rod turns elsewhere."""
    sleeve = Guide("end", free={"x", "rz"})
    loads = [PointForce((0, 6.0, 2.0), 0.5)]
    scene = Scene([FLAT.straight(HEAVY)], [Clamp("start"), sleeve], loads, motion=Dynamic(1.0, 0.02))
    h = discrete.solve(scene, elements=8).rods[0]
    assert largest(h.r[:, -1, 0] - 1.0) > 0.01
    assert largest(h.r[:, -1, 1:]) < 1e-14
    assert largest(h.frames[:, -1, 2, :2]) < 1e-12


def test_loose_rods_keep_their_momentum_while_others_are_held():
    thrown = Velocity(v=lambda r: np.stack([r[:, 1], 1.0 + r[:, 0] ** 2, np.sin(3 * r[:, 0])], axis=1), rod=1)
    rods = [FLAT.straight(HEAVY), FLAT.straight(HEAVY, start=(0, 0, 3.0))]
    supports, loads = [Clamp("start", rod=0)], [PointForce((0, 1.0, 0), "end", rod=0)]
    scene = Scene(rods, supports, loads, motion=Dynamic(0.5, 0.01), velocities=[thrown])
    v = discrete.solve(scene, elements=[4, 6]).rods[1].v
    m, _ = node_masses(mesh(scene, [4, 6]), [HEAVY, HEAVY], whole_ends=False)
    p = np.einsum("n,tni->ti", m[5:], v)
    assert p == pytest.approx(np.tile(p[0], (len(p), 1)), abs=1e-12 * largest(p))


def test_what_is_learnt_of_factors_is_trusted_until_they_are_twice_as_old():
    wear = Wear()
    assert not wear.enough(1e-6, 1e-3, 1e-9)
    assert not wear.see(3, 1e-4)
    assert wear.enough(1e-6, 1e-3, 2e-9)
    assert not wear.enough(1e-6, 1e-4, 2e-9)
    assert not wear.see(2, 0.0)
    assert not wear.enough(1e-6, 1e-3, 2e-9)


def test_factors_are_given_up_once_new_ones_pay():
    wear = Wear()
    wear.see(2, 0.0)
    steps = 1
    while not wear.see(3, 0.0):
        steps += 1
    assert 2 <= steps <= 5
    assert wear.slow(1.0, 1.0, 1e-9)
