"""Rods that hit, rub and roll on surfaces in time, by the discrete model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
from dolfinrod.result import NotConverged, Result
from dolfinrod.scene import (
    AugmentedLagrangian,
    Clamp,
    Contact,
    Coulomb,
    CreepingCoulomb,
    Dynamic,
    Gravity,
    LineForce,
    Penalty,
    Plane,
    PointForce,
    Rod,
    Scene,
    Section,
    SmoothPenalty,
    Velocity,
    WallMotion,
)
from tests.scenes import FLAT, SKEW, Pose, largest
from verification.references.friction import restitution

FIBRE = Section.ramie()
LENGTH = 0.04
MU = 0.64
C = 2e4
# Half a period of a fibre on a spring of c per length.
HALF = np.pi * np.sqrt(FIBRE.rhoA / C)
HEAVY = Section(EA=900.0, GA=400.0, GJ=0.7, EI=(2.0, 1.0), rhoA=1.0, rhoI=(0.03, 0.02, 0.01), radius=0.05)
WORKS = ("load work", "support work", "drag", "damping", "friction", "wall work", "numerical")
STORED = ("kinetic", "strain", "potential", "contact")


def unaccounted(result: Result) -> float:
    """What the ledger lacks, over the largest entry."""
    e = result.energy
    assert set(e) == {*WORKS, *STORED}
    stored = sum(e[name] - e[name][0] for name in STORED)
    return largest(stored - sum(e[name] for name in WORKS)) / max(largest(values) for values in e.values())


def thrown(law: object, steps: int, pose: Pose = FLAT, times: float = 1.2) -> Scene:
    """C2: a fibre parallel to a plane that flies against it at 1 m/s, in so many steps of the time it is to touch."""
    rod = pose.straight(FIBRE, length=LENGTH, start=(0, 0, FIBRE.radius + 2e-6))
    motion = Dynamic(2e-6 + times * HALF, HALF / steps)
    plane = Plane(pose.placed((0, 0, 0)), pose.turned((0, 0, 1)))
    flight = Velocity(v=pose.turned((0, 0, -1.0)))
    return Scene([rod], contacts=[Contact(plane, law)], motion=motion, velocities=[flight])


def test_a_fibre_springs_back_from_a_wall():
    """C2: depth v √(ρA/c), time π √(ρA/c); restitution goes to one with Δt, in order one, and never beyond."""
    lost = []
    for steps in (50, 100):
        result = discrete.solve(thrown(Penalty(C), steps, SKEW), elements=3)
        rod = result.contacts[0].rods[0]
        depth, back = -rod.gap.min(), SKEW.back(result.rods[0].v[-1] + SKEW.origin)
        assert back == pytest.approx(np.tile(back[0], (4, 1)), abs=1e-6)
        lost.append((1.0 - depth / np.sqrt(FIBRE.rhoA / C), 1.0 - back[0, 2]))
        touched = (rod.pressure > 0.0).any(axis=1).sum() / steps
        assert touched == pytest.approx(1.0, abs=2.5 / steps)
        assert unaccounted(result) < 1e-9
        assert (np.diff(result.energy["numerical"]) <= 1e-12 * result.energy["kinetic"][0]).all()
        assert {"Contact", "Inertia"} <= set(result.formulation.terms)
    assert 0.0 < lost[1][0] < lost[0][0] < 0.06
    assert 0.0 < lost[1][1] < lost[0][1] < 0.12
    assert lost[0][1] / lost[1][1] == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize("ratio", [0.1, 1.5], ids=["swings", "creeps"])
def test_a_wall_with_damping_returns_what_its_ratio_says(ratio):
    """Its coefficient of restitution; none of what is lost is more than damping's and the scheme's."""
    off = []
    for steps in (50, 100):
        result = discrete.solve(thrown(Penalty(C, damping=2.0 * ratio * HALF / np.pi), steps, SKEW, 2.0), elements=3)
        back = SKEW.back(result.rods[0].v[-1] + SKEW.origin)
        assert back == pytest.approx(np.tile(back[0], (4, 1)), abs=1e-6)
        assert unaccounted(result) < 1e-9
        assert (np.diff(result.energy["damping"]) <= 1e-12 * result.energy["kinetic"][0]).all()
        assert (np.diff(result.energy["numerical"]) <= 1e-12 * result.energy["kinetic"][0]).all()
        assert (result.contacts[0].rods[0].pressure >= 0.0).all()
        off.append(restitution(ratio) - back[0, 2])
    assert off[0] / off[1] == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize("law", [SmoothPenalty(C, 1e-6), Penalty(1e8), AugmentedLagrangian(1e6, 1e-8)], ids=repr)
def test_no_law_gives_energy_in_an_impact(law):
    result = discrete.solve(thrown(law, 20), elements=2)
    assert unaccounted(result) < 1e-9
    total = sum(result.energy[name] for name in STORED)
    # Multipliers leave a gap or a depth within their tolerance: the next step may lead from one to the other.
    left = 2.0 * getattr(law, "tolerance", 0.0) / (HALF / 20)
    assert (np.diff(total) <= 1e-9 * total[0] + 0.5 * FIBRE.rhoA * LENGTH * left**2).all()
    assert result.rods[0].v[-1, 0, 2] > -1e-3


def conveyed(friction: object, steps: int = 50) -> Scene:
    """C9: a fibre at rest, pressed upon a wall that moves along it."""
    q, v = 0.01, 0.1716
    rod = Rod.straight(LENGTH, FIBRE, start=(0, 0, FIBRE.radius - q / C))
    belt = Plane(motion=WallMotion(velocity=(v, 0, 0)))
    t = v / (MU * q / FIBRE.rhoA)
    motion = Dynamic(1.5 * t, t / steps)
    return Scene([rod], (), [LineForce((0, 0, -q))], contacts=[Contact(belt, Penalty(C), friction)], motion=motion)


def test_a_wall_that_moves_takes_a_fibre_along():
    """C9: v(t) = μ q t/ρA up to the speed of the wall; it does the work ρA v², half of which is kinetic energy."""
    scene = conveyed(Coulomb(MU, eps_T=1e9))
    result = discrete.solve(scene, elements=2)
    v, t, m = 0.1716, 0.1716 / (MU * 0.01 / FIBRE.rhoA), FIBRE.rhoA * LENGTH
    speed = result.rods[0].v[:, 1, 0]
    sliding = (result.t > 0.1 * t) & (result.t < 0.9 * t)
    assert speed[sliding] == pytest.approx(v * result.t[sliding] / t, rel=1e-3)
    assert speed[-1] == pytest.approx(v, rel=1e-3)
    assert result.contacts[0].rods[0].state[-1].tolist() == [1, 1, 1]
    assert result.energy["wall work"][-1] == pytest.approx(m * v**2, rel=0.02)
    # Backward Euler stops within a step of when it should, 1/50 of the way.
    assert result.energy["friction"][-1] == pytest.approx(-0.5 * m * v**2, rel=0.03)
    assert unaccounted(result) < 1e-9
    slip = result.contacts[0].rods[0].slip
    assert slip[-1] == pytest.approx(0.5 * v * t, rel=0.03)


def test_the_rule_of_the_paper_knows_no_wall_that_moves():
    """To the letter friction acts against the velocity in space: what rests stays at rest."""
    result = discrete.solve(conveyed(CreepingCoulomb(MU, 1e-3), 10), elements=2)
    assert largest(result.rods[0].v[..., 0]) < 1e-12
    assert unaccounted(result) < 1e-9


def on_a_slope(tan: float, friction: object, t_end: float, dt: float) -> Scene:
    """A fibre that cannot roll, pressed upon the plane z = 0 and dragged along its own length."""
    q = 0.01
    rod = Rod.straight(LENGTH, FIBRE, start=(0, 0, FIBRE.radius - q / C))
    loads = [LineForce((tan * q, 0, -q))]
    return Scene([rod], (), loads, contacts=[Contact(Plane(), Penalty(C), friction)], motion=Dynamic(t_end, dt))


def test_a_fibre_sticks_on_a_slope_without_any_creep():
    """C10: the anchors do not move at all, and carry the load, −ε_T u = −q tan β."""
    tan = np.tan(np.deg2rad(15.0))
    result = discrete.solve(on_a_slope(tan, Coulomb(MU, eps_T=1e6), 1e-2, 1e-4), elements=2)
    rod = result.contacts[0].rods[0]
    assert (rod.slip == 0.0).all()
    assert (rod.state[1:] == 1).all()
    assert rod.traction[-1] == pytest.approx(np.tile((-0.01 * tan, 0, 0), (3, 1)), abs=1e-7)
    assert unaccounted(result) < 1e-9


def test_a_fibre_on_a_steep_slope_slides_with_what_friction_leaves():
    """C5: a = (q/ρA)(sin β − μ cos β), 5262 m/s² on 45° with q = 0.01 N/m; here with the normal part as q."""
    result = discrete.solve(on_a_slope(1.0, Coulomb(MU, eps_T=1e6), 2e-5, 1e-6), elements=2)
    v = result.rods[0].v[:, 1, 0]
    a = 0.01 / FIBRE.rhoA * (1.0 - MU)
    assert a * np.cos(np.pi / 4) == pytest.approx(5262, rel=1e-3)
    assert np.diff(v)[3:] / 1e-6 == pytest.approx(a, rel=1e-3)


def test_a_cylinder_rolls_down_a_slope():
    """A = ⅔ g sin β without slip, ω = a t/r: the moment of friction turns it."""
    r, g, β = 0.01, 9.81, np.deg2rad(30.0)
    stiff = Section(EA=1e6, GA=1e6, GJ=1e3, EI=1e3, rhoA=1.0, rhoI=(0.5 * r**2, 0.25 * r**2, 0.25 * r**2), radius=r)
    sunk = g * np.cos(β) / 1e6
    rod = Rod.straight(1.0, stiff, start=(0, 0, r - sunk), direction=(0, 1, 0))
    plane = Contact(Plane(), Penalty(1e6), Coulomb(MU))
    down = Gravity((g * np.sin(β), 0, -g * np.cos(β)))
    result = discrete.solve(Scene([rod], (), [down], contacts=[plane], motion=Dynamic(0.5, 2e-3)), elements=2)
    h, a = result.rods[0], 2 / 3 * g * np.sin(β)
    assert h.v[-1, :, 0] == pytest.approx(a * 0.5, rel=2e-3)
    assert h.omega[-1, :, 1] == pytest.approx(a * 0.5 / r, rel=2e-3)
    assert result.contacts[0].rods[0].slip[-1] == pytest.approx(0.0, abs=1e-12)
    assert result.statistics.newton_iterations <= 8 * len(result.log)
    assert unaccounted(result) < 1e-9


def whirled(damping: float = 0.0, **motion: object) -> Scene:
    """A clamped heavy rod, swung against two walls that move, one of them rough."""
    rod = Rod.curved(
        1.0, HEAVY, (0.4, 0.5, 1.0), SKEW.placed((0, 0, 0)), SKEW.turned((1, 0, 0)), SKEW.turned((0, 1, 0))
    )
    shaken = WallMotion(displacement=SKEW.turned((0.05, 0.1, 0)), history=((0.0, 0.0), (0.11, 1.0), (0.2, 0.3)))
    floor = Plane(SKEW.placed((0, 0, -0.1)), SKEW.turned((0.1, 0, 1)), shaken)
    side = Plane(SKEW.placed((0, -0.03, 0)), SKEW.turned((0, 1, 0.2)), WallMotion(spin=SKEW.turned((0, 0.4, 0))))
    contacts = [
        Contact(floor, Penalty(3e3, 0.01, damping), Coulomb(0.5)),
        Contact(side, SmoothPenalty(1e4, 1e-3, damping=damping), Coulomb(0.2)),
    ]
    loads = [LineForce(SKEW.turned((0.0, -8.0, -20.0))), PointForce(SKEW.turned((0, 0, 1.0)), 0.7)]
    thrown = [Velocity(omega=SKEW.turned((0, 1.0, -0.5)))]
    motion = Dynamic(**{"t_end": 0.3, "dt": 0.01} | motion)
    return Scene([rod], [Clamp("start")], loads, contacts=contacts, motion=motion, velocities=thrown)


@pytest.mark.parametrize("damping", [0.0, 0.01], ids=["elastic", "damped"])
@pytest.mark.parametrize("steps", [{}, {"dt": None, "tol": 1e-3}], ids=["equal", "free"])
def test_the_ledger_closes(steps, damping):
    result = discrete.solve(whirled(damping, **steps), elements=6)
    assert unaccounted(result) < 1e-9
    e = result.energy
    for name in ("contact", "friction", "wall work"):
        assert largest(np.diff(e[name])) > 1e-6
    assert (np.diff(e["friction"]) <= 0.0).all()
    assert {0.11, 0.2} <= set(result.t)
    assert len(result.contacts) == 2
    assert all(touched.length.max() > 0.0 for touched in result.contacts)


def test_momentum_changes_by_what_acts():
    """Σ m Δv = Δt (loads + contact) step by step, for a rod that is free."""
    scene = replace(whirled(), supports=())
    result = discrete.solve(scene, elements=6)
    h, share = result.rods[0], result.contacts[0].rods[0].share
    p = np.einsum("n,tni->ti", HEAVY.rhoA * share, h.v)
    acting = np.array(SKEW.turned((0.0, -8.0, -20.0))) + SKEW.turned((0, 0, 1.0))
    acting = acting + sum(touched.force for touched in result.contacts)[1:]
    assert np.diff(p, axis=0) == pytest.approx(np.diff(result.t)[:, None] * acting, abs=1e-7 * largest(p))


@pytest.mark.serial
@pytest.mark.parametrize(
    "steps",
    [{}, pytest.param({"dt": None, "tol": 1e-3, "output": 0.07}, marks=pytest.mark.slow)],
    ids=["equal", "free"],
)
def test_a_run_in_two_parts_is_one_run(steps, tmp_path):
    """From a checkpoint and from the record of the first part."""
    scene = whirled(**steps)
    whole = discrete.solve(scene, elements=4)

    def stop(row: object, _: float) -> None:
        if row.t >= 0.14:
            raise KeyboardInterrupt

    with pytest.raises(NotConverged, match="interrupted") as caught:
        discrete.solve(scene, elements=4, progress=stop, checkpoint=tmp_path / "run.h5")
    kept = discrete.solve(scene, elements=4, checkpoint=tmp_path / "run.h5")
    started = discrete.solve(scene, elements=4, start=caught.value.result)
    np.testing.assert_allclose(kept.t, whole.t, rtol=1e-9)
    # A run that starts from a record finds the length of its free steps anew.
    for one, off in ((kept, 1e-6), (started, 1e-6 if not steps else 1e-2)):
        for name, values in whole.energy.items():
            assert one.energy[name][-1] == pytest.approx(values[-1], abs=off * largest(whole.energy["kinetic"]))
        for a, b in zip(one.contacts, whole.contacts, strict=True):
            for name in ("gap", "slip"):
                x, y = getattr(a.rods[0], name), getattr(b.rods[0], name)
                assert x[-1] == pytest.approx(y[-1], abs=off * largest(y))
    assert kept.contacts[0].rods[0].pressure.shape == whole.contacts[0].rods[0].pressure.shape
