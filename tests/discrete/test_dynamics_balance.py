"""Momentum and energy of motions in time: what backward Euler keeps, and where the rest goes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
from discrete.mass import node_masses
from discrete.mesh import mesh
from discrete.momentum import Inertia, in_body
from dolfinrod.result import Result
from dolfinrod.scene import (
    Air,
    Clamp,
    Dynamic,
    FollowerForce,
    FollowerMoment,
    Gravity,
    Guide,
    LineForce,
    Pin,
    PointForce,
    PointMoment,
    Prescribed,
    Rod,
    Scene,
    Section,
    Velocity,
)
from tests.scenes import FLAT, SKEW, Pose, largest

HEAVY = Section(EA=900.0, GA=400.0, GJ=0.7, EI=(2.0, 1.0), rhoA=1.0, rhoI=(0.03, 0.02, 0.01), radius=0.01)
WORKS = ("load work", "support work", "drag", "damping", "numerical")


def tumbling(t_end: float, dt: float) -> Scene:
    """A free curved rod that is thrown and bent by its own spin."""
    rod = Rod.curved(1.0, HEAVY, (0.4, 0.5, 1.0), (0, 0, 0), (1, 0, 0), (0, 1, 0), 0.9)
    thrown = Velocity(v=lambda r: np.stack([r[:, 1], 1.0 + r[:, 0] ** 2, 0.5 * np.sin(3 * r[:, 0])], axis=1))
    return Scene([rod], motion=Dynamic(t_end, dt), velocities=[thrown, Velocity(omega=(3.0, -1.0, 2.0))])


def acted_on_in_every_way(pose: Pose, section: Section, **motion: object) -> Scene:
    """Curved rod, moved at one end and guided at the other, under all loads, in a whirl."""
    rod = Rod.curved(
        1.0, section, (0.4, 0.5, 1.0), pose.placed((0, 0, 0)), pose.turned((1, 0, 0)), pose.turned((0, 1, 0))
    )
    supports = [
        Prescribed("start", pose.turned((0.1, 0.2, 0)), pose.turned((0.3, 0, 1.0)), history=lambda t: np.sin(3 * t)),
        Guide("end", free={"x", "y", "z", "rx", "ry"}),
    ]
    loads = [
        PointForce(pose.turned((0.5, 1.0, -1.0)), 0.7, history=((0.0, 0.0), (0.1, 1.0), (0.3, 0.2))),
        PointMoment(pose.turned((0.2, -0.3, 0.4)), 0.37),
        FollowerForce((0.0, 0.7, -0.4), 0.61),
        FollowerMoment((0.3, 0.0, 0.5), "end"),
        LineForce(pose.turned((0.0, 0.3, 1.5)), between=(0.2, 0.8)),
        Gravity(pose.turned((0.0, -1.0, 0.0)), history=lambda t: 1.0 + t),
    ]
    air = Air(field=lambda x, t: np.cross([0.0, 3.0, 5.0 + t], x), density=1.0, viscosity=0.02)
    return Scene([rod], supports, loads, air=air, motion=Dynamic(**{"t_end": 0.4, "dt": 0.02} | motion))


def unaccounted(result: Result) -> float:
    """What the ledger lacks, over the largest entry."""
    e = result.energy
    stored = sum(e[name] - e[name][0] for name in ("kinetic", "strain", "potential"))
    return largest(stored - sum(e[name] for name in WORKS)) / max(largest(values) for values in e.values())


def test_linear_momentum_is_kept_to_round_off_and_angular_momentum_balances():
    """Σ m v stays; Σ x₁ × m (v₁ − v₀) + Δt Σ M = 0 with the moments that the spins of the nodes take."""
    scene = tumbling(1.0, 0.02)
    h = discrete.solve(scene, elements=8).rods[0]
    inertia = Inertia(*node_masses(mesh(scene, 8), [HEAVY], whole_ends=False))
    p = np.einsum("n,tni->ti", inertia.m, h.v)
    assert p == pytest.approx(np.tile(p[0], (len(p), 1)), abs=1e-12 * largest(p))
    Ω = np.array([in_body(R, ω) for R, ω in zip(h.frames, h.omega, strict=True)])
    for k in range(1, len(h.r)):
        turned = inertia.moment(h.frames[k], Ω[k], Ω[k] - Ω[k - 1], 0.02)
        pushed = np.cross(h.r[k], inertia.force(h.v[k] - h.v[k - 1], 0.02))
        assert (turned + pushed).sum(axis=0) == pytest.approx(0.0, abs=1e-7 * np.abs(pushed).sum())


@pytest.mark.slow
def test_ten_thousand_steps_keep_linear_momentum():
    scene = tumbling(10.0, 1e-3)
    result = discrete.solve(replace(scene, motion=replace(scene.motion, output=1.0)), elements=8)
    m, _ = node_masses(mesh(scene, 8), [HEAVY], whole_ends=False)
    p = np.einsum("n,tni->ti", m, result.rods[0].v)
    assert p == pytest.approx(np.tile(p[0], (len(p), 1)), abs=1e-12 * largest(p))
    assert unaccounted(result) < 1e-9


def test_a_free_rod_loses_energy_to_the_scheme_alone_and_in_order_one():
    lost = []
    for dt in (0.02, 0.01):
        result = discrete.solve(tumbling(0.5, dt), elements=8)
        assert unaccounted(result) < 1e-9
        assert (np.diff(result.energy["numerical"]) < 0.0).all()
        assert result.energy["load work"][-1] == result.energy["support work"][-1] == result.energy["drag"][-1] == 0.0
        lost.append(result.energy["numerical"][-1])
    assert 1.3 < lost[0] / lost[1] < 2.2


@pytest.mark.parametrize("damping", [0.0, 0.03], ids=["elastic", "damped"])
@pytest.mark.parametrize("pose", [FLAT, SKEW], ids=["flat", "skew"])
def test_the_ledger_closes(pose, damping):
    result = discrete.solve(acted_on_in_every_way(pose, replace(HEAVY, damping=damping)), elements=8)
    assert unaccounted(result) < 1e-9
    entries = [
        name for name in (*WORKS, "kinetic", "strain", "potential") if largest(np.diff(result.energy[name])) > 1e-6
    ]
    assert len(entries) == (8 if damping else 7)
    assert (np.diff(result.energy["damping"]) <= 0.0).all()


@pytest.mark.parametrize(
    "options", [{"rotation": "added"}, {"end_mass": "paper"}, {"frame": "node_i"}, {"axial": "paper"}]
)
def test_the_ledger_closes_for_what_the_paper_prints(options):
    result = discrete.solve(acted_on_in_every_way(FLAT, HEAVY, t_end=0.2), elements=8, **options)
    assert unaccounted(result) < 1e-9
    ((name, value),) = options.items()
    assert f'{name}="{value}"' in result.formulation.notes


def test_the_ledger_closes_with_free_steps():
    result = discrete.solve(acted_on_in_every_way(FLAT, HEAVY, dt=None, tol=1e-3), elements=8)
    assert unaccounted(result) < 1e-9
    assert {0.1, 0.3} <= set(result.t)


def test_works_are_what_they_are_known_to_be():
    """A dead force that a support moves against, quasi-statically: its work is F u, the support's minus that of F."""
    scene = Scene(
        [FLAT.straight(HEAVY)],
        [Prescribed("start", (0, 0.5, 0), (0, 0, 0), history=lambda t: t**2 * (3 - 2 * t))],
        [PointForce((0, -0.2, 0), "start")],
        motion=Dynamic(1.0, 0.02),
    )
    energy = discrete.solve(scene, elements=4).energy
    assert energy["load work"][-1] == pytest.approx(-0.1, rel=1e-10)
    rest = sum(energy[name][-1] for name in ("kinetic", "strain")) - energy["numerical"][-1]
    assert energy["support work"][-1] == pytest.approx(0.1 + rest, rel=1e-9)


def test_damping_stops_vibrations_as_its_law_says():
    """A mode of frequency ω under k (Δ + τ Δ̇) decays as exp(−ω²τt/2) where that is slow; the scheme adds ω²Δt/2."""
    tips = []
    for τ in (0.0, 0.01):
        section = Section(EA=1e6, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0, damping=τ)
        still = Scene([FLAT.straight(section)], [Clamp("start")])
        mode = discrete.modes(still, modes=1, elements=8)
        shape = mode.rods[0].displacement[0] / largest(mode.rods[0].displacement[0])
        push = Velocity(v=lambda _, shape=shape: 1e-5 * shape)
        scene = replace(still, motion=Dynamic(1.78, 0.01, output=1.78), velocities=[push])
        tips.append(discrete.solve(scene, elements=8).energy["kinetic"][-1])
    assert tips[1] / tips[0] == pytest.approx(np.exp(-(mode.omega[0].real ** 2) * 0.01 * 1.78), rel=0.03)


def test_a_pinned_rod_that_spins_freely_keeps_spinning():
    """No section inertia: what stands in for it lets the rod spin without energy to speak of."""
    section = Section(EA=900.0, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0)
    supports = [Pin("start"), Pin("end")]
    whirled = Velocity(omega=(5.0, 0, 0))
    result = discrete.solve(
        Scene([FLAT.straight(section)], supports, motion=Dynamic(1.0, 0.05), velocities=[whirled]), elements=6
    )
    assert result.rods[0].omega[-1] == pytest.approx(np.tile([5.0, 0, 0], (7, 1)), abs=1e-9)
    assert any("stands in" in note for note in result.formulation.notes)
