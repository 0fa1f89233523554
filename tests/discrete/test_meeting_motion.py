"""Rods that hit one another, rub and rebound in time, by the discrete model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import discrete
from discrete.coupled import joined
from dolfinrod.result import NotConverged, Result
from dolfinrod.scene import (
    Clamp,
    Contact,
    Coulomb,
    Dynamic,
    Guide,
    LineForce,
    Penalty,
    Plane,
    Rod,
    RodContact,
    Scene,
    Section,
    Static,
    Velocity,
)
from tests.scenes import FLAT, SKEW, Pose, largest
from verification.references.friction import restitution

FIBRE = Section.ramie()
RADIUS = 1e-5
LENGTH = 0.002
MU = 0.3
STORED = ("kinetic", "strain", "potential", "contact")
ELASTIC = Penalty.tight()
# Half of the critical damping of two fibres.
DAMPED = replace(ELASTIC, damping=np.sqrt(0.5 * FIBRE.rhoA / ELASTIC.eps_N))


def unaccounted(result: Result) -> float:
    """What the ledger lacks, over the largest entry."""
    e = result.energy
    stored = sum(e[name] - e[name][0] for name in STORED)
    works = sum(values for name, values in e.items() if name not in STORED)
    return largest(stored - works) / max(largest(values) for values in e.values())


def momentum(result: Result) -> np.ndarray:
    """That of all rods together at the stored times, shape (n_t, 3)."""
    total = np.zeros((len(result.t), 3))
    for rod, of in zip(result.scene.rods, result.rods, strict=True):
        l = np.diff(of.s)
        mass = rod.section.rhoA * 0.5 * (np.append(l, 0.0) + np.append(0.0, l))
        total += np.einsum("s,tsi->ti", mass, of.v)
    return total


def bundle(friction: Coulomb | None = None, pose: Pose = SKEW, law: Penalty = ELASTIC, **motion: object) -> Scene:
    """Three free fibres around an axis, no two parallel, that fly towards it at 0.1 m/s and turn about it."""
    rods, velocities = [], []
    for k, angle in enumerate(2 * np.pi * np.arange(3) / 3):
        out = np.array([0.0, np.cos(angle), np.sin(angle)])
        around = np.array([0.0, -np.sin(angle), np.cos(angle)])
        along = np.array([1.0, 0.0, 0.0]) + 2e-3 * around
        at = pose.placed(1.18 * RADIUS * out - 0.5 * LENGTH * along)
        rods.append(Rod.straight(LENGTH, FIBRE, start=at, direction=pose.turned(along), d2=pose.turned(out)))
        velocities.append(Velocity(v=pose.turned(0.02 * around - 0.1 * out), rod=k))
    time = Dynamic(**({"t_end": 4e-5, "dt": 1e-6, "output": 5e-6} | motion))
    return Scene(rods, contacts=[RodContact(law, friction)], motion=time, velocities=velocities)


@pytest.mark.parametrize("friction", [None, Coulomb(MU)], ids=["smooth", "rough"])
@pytest.mark.parametrize("law", [ELASTIC, DAMPED], ids=["elastic", "damped"])
def test_a_free_bundle_keeps_its_momentum(law, friction):
    """And the ledger closes; what friction and damping take is lost."""
    result = discrete.solve(bundle(friction, law=law), elements=6)
    p = momentum(result)
    size = 3 * FIBRE.rhoA * LENGTH * 0.1
    assert p == pytest.approx(np.broadcast_to(p[0], p.shape), rel=0, abs=1e-9 * size)
    assert largest(result.energy["contact"]) > 0.0
    assert unaccounted(result) < 1e-9
    assert result.energy["numerical"][-1] < 0.0
    assert (result.energy["friction"][-1] < 0.0) == (friction is not None)
    assert (result.energy["damping"][-1] < 0.0) == (law is DAMPED)
    assert np.mean([row.iterations for row in result.log]) < 8.0
    assert not any(row.cuts for row in result.log)


def test_fibres_with_damping_part_as_their_restitution_says():
    """Two alike side by side: a spring between two masses, of half of one of them."""
    ratio, half, off = 0.5, np.sqrt(0.5 * FIBRE.rhoA / 2e4), []
    law = Penalty(2e4, 0.0, 2.0 * ratio * half)
    rods = [SKEW.straight(FIBRE, length=LENGTH, start=(0.0, 0.0, z)) for z in (0.0, 2.0 * RADIUS + 1e-9)]
    flights = [Velocity(SKEW.turned((0.0, 0.0, v)), rod=k) for k, v in enumerate((0.05, -0.05))]
    for steps in (50, 100):
        motion = Dynamic(2.0 * np.pi * half, np.pi * half / steps)
        # On coarse meshes the loads of splines bend the ends a little.
        result = discrete.solve(Scene(rods, contacts=[RodContact(law)], motion=motion, velocities=flights), elements=32)
        assert unaccounted(result) < 1e-9
        v = result.rods[1].v[-1] @ SKEW.turned((0.0, 0.0, 1.0))
        off.append(restitution(ratio) - 0.5 * (v[1:] + v[:-1]).mean() / 0.05)
    assert off[0] / off[1] == pytest.approx(2.0, rel=0.15)


def across(height: float, motion: Dynamic | Static, pose: Pose = SKEW, **parts: object) -> Scene:
    """A fibre, and one above it across its middle, its centreline so high."""
    still = pose.straight(FIBRE, length=LENGTH, start=(-0.5 * LENGTH, 0.0, 0.0))
    turned = Pose(pose.Q @ np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), pose.origin)
    above = turned.straight(FIBRE, length=LENGTH, start=(-0.5 * LENGTH, 0.0, height))
    return Scene([still, above], motion=motion, **{"contacts": [RodContact()]} | parts)


def test_a_shot_is_cut_and_does_not_go_through():
    """More than two diameters a step: the step is cut, momentum is kept and the fibres never change sides."""
    flight = Velocity(v=SKEW.turned((0, 0, -1.0)), rod=1)
    scene = across(5 * RADIUS, Dynamic(2e-4, 5e-5), velocities=[flight])
    result = discrete.solve(scene, elements=8)
    assert sum(row.cuts for row in result.log) > 0
    below, above = (rod.r[:, 4] @ np.array(SKEW.turned((0, 0, 1))) for rod in result.rods)
    assert (above - below > RADIUS).all()
    p = momentum(result)
    assert p == pytest.approx(np.broadcast_to(p[0], p.shape), rel=0, abs=1e-9 * largest(p))
    # The one that was hit moves on, the other one is slower.
    middle = [rod.v[-1].mean(axis=0) @ np.array(SKEW.turned((0, 0, 1))) for rod in result.rods]
    assert middle[0] < 0.0
    assert middle[1] > -1.0


@pytest.mark.serial
@pytest.mark.parametrize("law", [ELASTIC, DAMPED], ids=["elastic", "damped"])
def test_a_run_in_two_parts_is_one_run(law, tmp_path):
    """From a checkpoint and from the record of the first part, in the midst of an impact with friction."""
    scene = bundle(Coulomb(MU), FLAT, law, t_end=2.4e-5, output=8e-6)
    whole = discrete.solve(scene, elements=6)

    def stop(row: object, _: float) -> None:
        if row.t >= 1.35e-5:
            raise KeyboardInterrupt

    with pytest.raises(NotConverged, match="interrupted") as caught:
        discrete.solve(scene, elements=6, progress=stop, checkpoint=tmp_path / "run.h5")
    kept = discrete.solve(scene, elements=6, checkpoint=tmp_path / "run.h5")
    started = discrete.solve(scene, elements=6, start=caught.value.result)
    np.testing.assert_allclose(kept.t, whole.t, rtol=1e-9)
    for one in (kept, started):
        for name, values in whole.energy.items():
            assert one.energy[name][-1] == pytest.approx(values[-1], abs=1e-6 * largest(whole.energy["kinetic"]))
        for a, b in zip(one.rods, whole.rods, strict=True):
            assert a.r[-1] == pytest.approx(b.r[-1], rel=0, abs=1e-9 * LENGTH)
    assert [len(met.s_a) for met in kept.meetings[0].times] == [len(met.s_a) for met in whole.meetings[0].times]


def test_fibres_on_fibres_on_a_plane():
    """Surfaces and rods in one scene, guides among the supports: ledger, and the plane carries both."""
    rods = [FLAT.straight(FIBRE, length=LENGTH, start=(0.0, 0.0, z * RADIUS)) for z in (1, 3)]
    free = {"start": ("z", "ry", "rz"), "end": ("x", "z", "ry", "rz")}
    held = [Guide(at, free=names, rod=k) for k in (0, 1) for at, names in free.items()]
    contacts = [Contact(Plane((0, 0, 0))), RodContact()]
    load = LineForce((0, 0, -1e-2), rod=1)
    scene = Scene(rods, held, [load], contacts=contacts, motion=Dynamic(3e-4, 2e-5))
    result = discrete.solve(scene, elements=(6, 5))
    assert unaccounted(result) < 1e-12
    assert set(result.energy) >= {"contact", "friction", "wall work"}
    weight = 1e-2 * LENGTH
    assert result.contacts[0].force[-1] == pytest.approx([0.0, 0.0, weight], abs=1e-2 * weight)
    assert result.meetings[0].force(-1, 1, 0) == pytest.approx([0.0, 0.0, weight], abs=1e-2 * weight)
    assert result.formulation.terms == ("Elasticity", "Inertia", "LineForce", "Contact", "RodContact")


@given(seed=st.integers(0, 2**32 - 1), n=st.integers(1, 12), coupling=st.sampled_from([0.0, 1e-6, 0.3, 3.0]))
def test_what_is_found_by_iteration_is_the_solution(seed, n, coupling):
    """d = d₀ + A⁻¹ C d of any C: that of (A − C) d = A d₀."""
    random = np.random.default_rng(seed)
    A, C = np.eye(n) + 0.1 * random.standard_normal((n, n)) / n, coupling * random.standard_normal((n, n))
    start = random.standard_normal((n, 1))
    assume(np.linalg.cond(A - C) < 1e4)
    found = joined(start, lambda f: np.linalg.solve(A, f), lambda d: C @ d, 1e-10)
    np.testing.assert_allclose(found, np.linalg.solve(A - C, A @ start), rtol=0, atol=1e-5 * largest(found))


@pytest.mark.parametrize("most", [2, 60], ids=["together", "iterated"])
def test_rods_that_inertia_does_not_hold_are_solved_for(most, monkeypatch):
    """By one system where the iteration gives up, by the iteration where it does not: the same as statics."""
    monkeypatch.setattr("discrete.coupled.MOST_ITERATIONS", most)
    held = [Clamp(at, rod=k) for k in (0, 1) for at in ("start", "end")]
    load = LineForce(SKEW.turned((0, 0, -0.02)), rod=1)
    parts = {"supports": held, "loads": [load], "contacts": [RodContact(Penalty(4e7, 1e-6))]}
    moved = discrete.solve(across(2.05 * RADIUS, Dynamic(0.3, 0.1), **parts), elements=6)
    still = discrete.solve(across(2.05 * RADIUS, Static(), **parts), elements=6)
    assert still.meetings[0].total(-1) > 0.0
    for k in (0, 1):
        assert moved.rods[k].r[-1] == pytest.approx(still.rods[k].r[-1], rel=0, abs=1e-7 * LENGTH)
