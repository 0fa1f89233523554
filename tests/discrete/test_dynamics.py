"""Motion in time: order, frequencies, what moves supports and air, poses, answers known beforehand."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import discrete
from discrete.mass import node_masses
from discrete.mesh import mesh
from dolfinrod.scene import (
    Air,
    Clamp,
    Dynamic,
    FollowerForce,
    Gravity,
    Guide,
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

# EI = ρA = 1 and no two stiffnesses alike.
HEAVY = Section(EA=900.0, GA=400.0, GJ=0.7, EI=(2.0, 1.0), rhoA=1.0, rhoI=(0.003, 0.002, 0.001))
ROUND = Section(EA=1e6, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0)


def swinging(pose: Pose, motion: Dynamic, section: Section = HEAVY) -> Scene:
    """A cantilever that a sudden force and a follower force bend out of plane."""
    loads = [PointForce(pose.turned((0.5, 1.0, -1.0)), "end"), FollowerForce((0.0, 0.7, -0.4), 0.5)]
    return Scene([pose.straight(section)], [Clamp("start")], loads, motion=motion)


def test_order_one_in_the_time_step():
    tips = [discrete.solve(swinging(FLAT, Dynamic(0.2, 0.2 / n)), elements=6).tip for n in (20, 40, 80, 160)]
    gaps = [np.linalg.norm(b - a) for a, b in pairwise(tips)]
    assert gaps[1] / gaps[2] == pytest.approx(2.0, abs=0.1)
    assert gaps[0] / gaps[1] > 1.7


@pytest.mark.parametrize(
    ("n", "ratios"),
    [
        (8, (0.9899, 0.9567, 0.9195)),
        (20, (0.9984, 0.9927, 0.9857)),
        (40, (0.9996, 0.9982, 0.9964)),
        (80, (0.9999, 0.9995, 0.9991)),
    ],
)
def test_frequencies_of_small_free_vibrations(n, ratios):
    """process.md 1.5 over case K1: in a mode q₊ (1 + ω²Δt²) − 2 q + q₋ = 0 with backward Euler."""
    exact = np.array([1.8751040687119611, 4.694091132974175, 7.854757438237613]) ** 2
    section = Section(EA=1e6, GA=1.0, GJ=1.0, EI=(8.0, 1.0), rhoA=1.0)
    still = Scene([FLAT.straight(section)], [Clamp("start")])
    shapes = discrete.modes(still, modes=5, elements=n)
    in_plane = [k for k in range(5) if largest(shapes.rods[0].displacement[k][:, 1]) > 0.1][:3]
    m, J = node_masses(mesh(still, n), [section], whole_ends=False)
    found = []
    for k, ω in zip(in_plane, exact, strict=True):
        dt, φ, spin = 0.2 / ω, shapes.rods[0].displacement[k], shapes.rods[0].spin[k]
        push = Velocity(v=lambda _, φ=φ: 1e-5 * φ / largest(φ))
        h = discrete.solve(replace(still, motion=Dynamic(12 * dt, dt), velocities=[push]), elements=n).rods[0]
        turned = h.frames[:, :, 1, 0]
        q = (h.r - h.r[0])[..., 1] @ (m * φ[:, 1]) + turned @ (J[:, 2] * spin[:, 2])
        found.append(np.sqrt((2 * q[9] - q[8] - q[10]) / (q[10] * dt**2)))
        assert found[-1] == pytest.approx(shapes.omega[k].real, rel=1e-5)
    assert np.array(found) / exact == pytest.approx(ratios, abs=6e-5)


def test_the_paper_makes_rods_too_heavy_by_an_element():
    free = Scene([FLAT.straight(HEAVY)], loads=[PointForce((0, 1.0, 0), 0.5)], motion=Dynamic(0.1, 0.05))
    for ends, mass in (("half", 1.0), ("paper", 1.1)):
        h = discrete.solve(free, elements=10, end_mass=ends).rods[0]
        m, J = node_masses(mesh(free, 10), [HEAVY], whole_ends=ends == "paper")
        assert m.sum() / (m[1:-1].sum() / 0.9) == pytest.approx(mass)
        assert J[0] / J[1] == pytest.approx(np.full(3, 0.5 if ends == "half" else 1.0))
        assert (m @ h.v[-1]) / m[5] * 0.1 == pytest.approx([0.0, 0.1, 0.0], rel=1e-9, abs=1e-12)


def test_a_falling_fibre_reaches_its_terminal_speed():
    """process.md 2.4: 0.08695 m/s across a horizontal ramie fibre, after 8.6 ms each a factor e."""
    fibre = Rod.straight(0.04, Section.ramie(), start=(0, 0, 0), direction=(1, 0, 0))
    scene = Scene([fibre], loads=[Gravity((0, 0, -9.81))], air=Air(), motion=Dynamic(0.2, 4e-3))
    result = discrete.solve(scene, elements=10)
    assert result.rods[0].v[-1] == pytest.approx(np.tile([0, 0, -0.08695], (11, 1)), abs=5e-6)
    assert "Drag" in result.formulation.terms


def test_air_of_any_flow_carries_a_fibre_along():
    def whirl(x, t):
        return np.stack([np.zeros(len(x)), 0.3 * np.cos(50 * t) - x[:, 2], 10 * x[:, 0]], axis=1)

    fibre = Rod.straight(0.04, Section.ramie(), start=(0, 0, 0), direction=(1, 0, 0))
    scene = Scene([fibre], [Clamp("start")], air=Air(field=whirl), motion=Dynamic(0.02, 5e-4))
    result = discrete.solve(scene, elements=10)
    assert result.rods[0].v[-1, -1, 2] > 0.0
    assert result.energy["drag"][-1] > 0.0


def test_a_moving_nip_takes_a_rod_along():
    """All at the speed of the nip from the start: nothing deforms."""
    nip = Prescribed("start", (0.3, -0.2, 0.1), (0, 0, 0), history=lambda t: t)
    along = Velocity(v=(0.3, -0.2, 0.1))
    scene = Scene([SKEW.straight(HEAVY)], [nip], motion=Dynamic(1.0, 0.1), velocities=[along])
    result = discrete.solve(scene, elements=6)
    h = result.rods[0]
    assert h.r[-1] - h.r[0] == pytest.approx(np.tile([0.3, -0.2, 0.1], (7, 1)), abs=1e-12)
    assert h.v == pytest.approx(np.tile([0.3, -0.2, 0.1], (11, 7, 1)), abs=1e-10)
    assert largest(result.energy["support work"]) < 1e-12


@pytest.mark.parametrize("pose", [FLAT, SKEW], ids=["flat", "skew"])
def test_a_turning_clamp_turns_at_its_rate(pose):
    """A table with a kink at 0.25 s, on which a step ends: 4 rad/s, then none."""
    spin = np.array(pose.turned((0, 0, 1.0)))
    clamp = Prescribed("start", (0, 0, 0), tuple(spin), history=((0.0, 0.0), (0.25, 1.0)))
    whirled = Velocity(omega=tuple(4.0 * spin), about=pose.placed((0, 0, 0)))
    scene = Scene([pose.straight(HEAVY)], [clamp], motion=Dynamic(0.5, 0.04), velocities=[whirled])
    h = discrete.solve(scene, elements=6).rods[0]
    result = discrete.solve(scene, elements=6)
    before = result.t <= 0.25
    assert 0.25 in result.t
    assert h.omega[before][:, 0] == pytest.approx(np.tile(4.0 * spin, (before.sum(), 1)), abs=1e-9)
    assert h.omega[~before][:, 0] == pytest.approx(0.0, abs=1e-12)
    assert largest(h.v[:, 0]) < 1e-12
    assert pose.Q.T @ h.frames[-1, 0] @ pose.Q == pytest.approx(
        pose.Q.T @ _about(spin, 1.0) @ h.frames[0, 0] @ pose.Q, abs=1e-12
    )


def test_centrifugal_stretch_of_a_spinning_rod():
    """Case K6, a = ΩL √(ρA/EA) = 0.5: tip at tan(a)/a, N(0)/EA = 1/cos(a) − 1; damping lets vibrations die out."""
    section = Section(EA=100.0, GA=1.0, GJ=10.0, EI=10.0, rhoA=1.0, damping=0.1)
    clamp = Prescribed("start", (0, 0, 0), (0, 0, 5.0), history=lambda t: t)
    whirled = Velocity(omega=(0, 0, 5.0))
    scene = Scene([FLAT.straight(section)], [clamp], motion=Dynamic(1.5, 1e-2, output=1.5), velocities=[whirled])
    h = discrete.solve(scene, elements=20).rods[0]
    assert np.linalg.norm(h.r[-1, -1]) == pytest.approx(1.092604979687581, rel=1e-3)
    assert np.linalg.norm(h.r[-1, 10]) == pytest.approx(0.5638306183331582, rel=1e-3)
    assert h.n[-1, 0, 0] / 100.0 == pytest.approx(0.13949392732454913, rel=3e-3)
    assert h.n[-1, -1] / 100.0 == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("dt", [0.05, 0.02])
def test_a_flying_rod_keeps_to_the_law_of_its_centre_of_mass(dt):
    """Case K9: p = 20 after 2.5 s; with backward Euler x = 0.4 t (t + Δt) until then, 2 m/s later."""
    section = Section(EA=1e4, GA=1e4, GJ=500.0, EI=500.0, rhoA=1.0, rhoI=(20.0, 10.0, 10.0))
    rod = Rod.straight(10.0, section, start=(6, 0, 0), direction=(-0.6, 0.8, 0))

    def on(t: float) -> float:
        return 1.0 if t <= 2.5 + 1e-9 else 0.0

    loads = [PointForce((8.0, 0, 0), "start", history=on), PointMoment((0, 0, 80.0), "start", history=on)]
    scene = Scene([rod], loads=loads, motion=Dynamic(3.5, dt, output=(2.5, 3.5)))
    h = discrete.solve(scene, elements=10).rods[0]
    m, _ = node_masses(mesh(scene, 10), [section], whole_ends=False)
    weight = m / m.sum()
    x, v = np.einsum("n,tni->ti", weight, h.r - h.r[0]), np.einsum("n,tni->ti", weight, h.v)
    assert v[1:] == pytest.approx(np.array([[2.0, 0, 0], [2.0, 0, 0]]), abs=1e-9)
    assert x[1] == pytest.approx([0.4 * 2.5 * (2.5 + dt), 0, 0], abs=1e-8)
    assert x[2] - x[1] == pytest.approx([2.0, 0, 0], abs=1e-8)


@pytest.mark.parametrize(("start", "T"), [(0.1, 5.130200297365177), (90.0, 6.055382539204989)])
def test_pendulum(start, T):
    """Case K5: at rest again on the other side after T/2; lumped masses make J larger by 3l²/4."""
    n = 6
    section = Section(EA=1e5, GA=1.0, GJ=1e4, EI=1e4, rhoA=1.0)
    angle = np.deg2rad(start)
    rod = Rod.straight(1.0, section, start=(0, 0, 0), direction=(np.sin(angle), -np.cos(angle), 0), d2=(0, 0, 1))
    half = 0.5 * T * np.sqrt(1.0 + 0.75 / n**2)
    ends = []
    for steps in (80, 160):
        scene = Scene([rod], [Pin("start")], [Gravity((0, -1.0, 0))], motion=Dynamic(half, half / steps, output=half))
        r = discrete.solve(scene, elements=n).tip
        ends.append(np.arctan2(r[0], -r[1]))
    assert 2 * ends[1] - ends[0] == pytest.approx(-angle, abs=0.02 * angle)
    assert abs(ends[1] + angle) < 0.6 * abs(ends[0] + angle)


def test_a_planar_scene_stays_planar():
    section = replace(HEAVY, EI=(2.0, 1.0))
    scene = Scene(
        [FLAT.straight(section)], [Clamp("start")], [PointForce((0.5, 8.0, 0), "end")], motion=Dynamic(1.0, 0.02)
    )
    h = discrete.solve(scene, elements=8).rods[0]
    assert largest(h.r[..., 1]) > 0.3
    assert largest(h.r[..., 2]) == 0.0
    assert largest(h.omega[..., :2]) == 0.0


def test_a_moved_scene_has_the_moved_answer():
    here, there = (discrete.solve(swinging(pose, Dynamic(0.3, 0.02)), elements=8).rods[0] for pose in (FLAT, SKEW))
    assert SKEW.back(there.r) == pytest.approx(here.r, abs=1e-8)
    assert SKEW.Q.T @ there.frames == pytest.approx(here.frames, abs=1e-7)
    assert there.m == pytest.approx(here.m, abs=1e-6)
    assert there.v @ SKEW.Q == pytest.approx(here.v, abs=1e-6)


def test_at_rest_it_is_the_equilibrium():
    """Damped motion under steady loads ends where statics does; a guided end and a follower included."""
    supports = [Clamp("start"), Guide("end", free={"x", "y", "z", "rx", "ry"})]
    loads = [PointForce((0.0, 1.0, -1.0), "end"), FollowerForce((0, 0.7, -0.4), 0.5)]
    section = replace(HEAVY, damping=0.2)
    motion = Dynamic(200.0, 2.0, output=200.0)
    moved = discrete.solve(Scene([FLAT.straight(section)], supports, loads, motion=motion), elements=8)
    still = discrete.solve(Scene([FLAT.straight(section)], supports, loads), elements=8)
    assert moved.tip == pytest.approx(still.tip, abs=1e-7)
    assert moved.rods[0].m[-1] == pytest.approx(still.rods[0].m[-1], abs=1e-6)
    assert largest(moved.rods[0].v[-1]) < 1e-8


def _about(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rotation matrix."""
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
