"""Laws of motion in time: order of the schemes, momentum, energy, frames of reference, number of ranks."""

from __future__ import annotations

from dataclasses import replace

from mpi4py import MPI

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.continuum.march import targets
from tests.scenes import FLAT, SKEW, Pose, both_kinematics

# Section of the planar reference solutions K10: L = EI = ρA = 1, thickness L/10, ν of no importance.
SECTION = dr.Section(EA=1200.0, GA=400.0, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(2 / 1200, 1 / 1200, 1 / 1200))
# Three different inertias and stiffnesses, thick enough for its turning to count.
THICK = dr.Section(EA=1200.0, GA=(400.0, 300.0), GJ=0.8, EI=(1.0, 2.0), rhoA=1.0, rhoI=(3e-2, 1e-2, 2e-2))
MESH = {"elements": 4, "degree": 3}
BOTH_SCHEMES = pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])


def pulse(t: float) -> float:
    """sin⁴ over 0.8 s."""
    return float(np.sin(np.pi * t / 0.8) ** 4) if t < 0.8 else 0.0


def pushed(pose: Pose, motion: dr.Dynamic, *loads: object) -> dr.Scene:
    """K10: a cantilever whose end is pushed across for 0.8 s."""
    push = dr.PointForce(pose.turned((0.0, 6.0, 0.0)), at="end", history=pulse)
    return dr.Scene([pose.straight(SECTION)], [dr.Clamp("start")], [push, *loads], motion=motion)


def thrown(motion: dr.Dynamic) -> dr.Scene:
    """A free rod that turns about three axes and bends meanwhile."""

    def bending(r: np.ndarray) -> np.ndarray:
        return np.stack([0.0 * r[:, 0], 2.0 * np.sin(np.pi * r[:, 0]), 1.0 - np.cos(2.0 * np.pi * r[:, 0])], axis=1)

    start = (dr.Velocity(v=(0.3, 0.2, -0.1), omega=(8.0, 2.0, -3.0)), dr.Velocity(v=bending))
    return dr.Scene([dr.Rod.straight(1.0, THICK)], motion=motion, velocities=start)


def momenta(result: dr.Result) -> tuple[np.ndarray, np.ndarray]:
    """Linear momentum and moment of momentum about the origin, Gauss-Lobatto weights of cubic elements, (n_t, 3)."""
    h, section, n = result.rods[0], result.scene.rods[0].section, MESH["elements"]
    weights = np.zeros(len(h.s))
    for e in range(n):
        weights[3 * e : 3 * e + 4] += np.array([1.0, 5.0, 5.0, 1.0]) / 12.0 / n
    J = np.einsum("tsij,j,tskj->tsik", h.frames, section.rhoI, h.frames)
    p = section.rhoA * h.v
    moment = np.cross(h.r, p) + np.einsum("tsij,tsj->tsi", J, h.omega)
    return np.einsum("s,tsi->ti", weights, p), np.einsum("s,tsi->ti", weights, moment)


@BOTH_SCHEMES
@both_kinematics
def test_order_in_the_time_step(kinematics, scheme):
    """Positions, velocities and frames: 1 for backward Euler, 2 for the midpoint rule."""
    order = 1 if isinstance(scheme, dr.ImplicitEuler) else 2
    ends = []
    for n in (20, 40, 80):
        motion = dr.Dynamic(t_end=0.3, dt=0.3 / n, scheme=scheme, output=0.3)
        h = dr.solve(pushed(SKEW, motion), kinematics=kinematics, **MESH).rods[0]
        ends.append([h.r[-1], h.frames[-1], h.v[-1, 1:]])
    for coarse, middle, fine in zip(*ends, strict=True):
        observed = np.log2(np.abs(middle - coarse).max() / np.abs(fine - middle).max())
        assert observed == pytest.approx(order, abs=0.25)


def test_a_free_rod_keeps_its_momenta_and_its_energy_within_dt_squared():
    off = []
    for n in (50, 100):
        motion = dr.Dynamic(t_end=0.5, dt=0.5 / n, scheme=dr.Midpoint())
        result = dr.solve(thrown(motion), **MESH)
        for momentum in momenta(result):
            assert np.abs(momentum - momentum[0]).max() <= 1e-11 * np.abs(momentum[0]).max()
        total = result.energy["kinetic"] + result.energy["strain"]
        off.append(np.abs(total / total[0] - 1.0).max())
    assert 1e-12 < off[1] < 0.35 * off[0] < 0.01


def test_backward_euler_keeps_the_linear_momentum_and_loses_energy():
    result = dr.solve(thrown(dr.Dynamic(t_end=0.2, dt=0.01)), **MESH)
    linear, _ = momenta(result)
    assert np.abs(linear - linear[0]).max() <= 1e-12
    total = result.energy["kinetic"] + result.energy["strain"]
    assert (np.diff(total) < 0.0).all()


@BOTH_SCHEMES
@both_kinematics
def test_the_ledger_closes(kinematics, scheme):
    """What is stored equals the works done, with a weight, a push, and a clamp that moves and turns."""
    moving = dr.Prescribed(
        "start",
        displacement=FLAT.turned((0.0, 0.3, 0.0)),
        rotation=FLAT.turned((0.0, 0.0, 0.5)),
        history=lambda t: np.sin(3.0 * t) ** 2,
    )
    motion = dr.Dynamic(t_end=0.5, dt=0.02, scheme=scheme)
    scene = replace(pushed(FLAT, motion, dr.Gravity(FLAT.turned((0.5, -2.0, 0.0)))), supports=(moving,))
    energy = dr.solve(scene, kinematics=kinematics, **MESH).energy
    stored = energy["kinetic"] + energy["strain"] + energy["potential"]
    works = sum(energy[name] for name in ("load work", "support work", "drag", "damping", "numerical"))
    np.testing.assert_allclose(stored - stored[0], works, rtol=0, atol=1e-10)
    assert np.abs(energy["support work"]).max() > 0.01


@pytest.mark.serial
def test_planar_reference_of_large_motion():
    """K10-cantilever at 0.4 s, the two finest of three steps extrapolated to none: 1e-6."""
    tip = np.array([0.9063091847993885, 0.34982239512781893])
    ends = [
        dr.solve(
            pushed(FLAT, dr.Dynamic(t_end=0.4, dt=dt, scheme=dr.Midpoint(), output=0.4)),
            kinematics=dr.Planar((0, 0, 1)),
            elements=6,
            degree=4,
        ).tip
        for dt in (0.005, 0.0025)
    ]
    np.testing.assert_allclose(FLAT.back((4.0 * ends[1] - ends[0]) / 3.0)[:2], tip, atol=1e-6)


@BOTH_SCHEMES
def test_space_and_plane_agree(scheme):
    motion = dr.Dynamic(t_end=0.2, dt=0.01, scheme=scheme)
    planar, spatial = (dr.solve(pushed(FLAT, motion), kinematics=k, elements=8) for k in (None, dr.Spatial()))
    np.testing.assert_allclose(planar.rods[0].r, spatial.rods[0].r, atol=1e-6)
    np.testing.assert_allclose(planar.rods[0].omega, spatial.rods[0].omega, atol=1e-3)


@BOTH_SCHEMES
def test_one_and_two_ranks_agree(scheme):
    motion = dr.Dynamic(t_end=0.1, dt=0.01, scheme=scheme)
    together, alone = (dr.solve(thrown(motion), comm=comm, **MESH) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    for name in ("r", "frames", "v", "omega", "n", "m"):
        a, b = getattr(together.rods[0], name), getattr(alone.rods[0], name)
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-10 * max(1.0, np.abs(b).max()))
    for name, values in alone.energy.items():
        np.testing.assert_allclose(together.energy[name], values, rtol=0, atol=1e-10 * max(1.0, np.abs(values).max()))


@both_kinematics
def test_huge_steps_of_backward_euler_end_at_rest(kinematics):
    """Steps of a hundred periods damp all motion: what is left is the static shape."""
    weight = dr.Gravity(SKEW.turned((0.0, -5.0, 0.0)))
    still = dr.Scene([SKEW.straight(SECTION)], [dr.Clamp("start")], [weight])
    rest = dr.solve(still, kinematics=kinematics, **MESH)
    moved = dr.solve(replace(still, motion=dr.Dynamic(t_end=4e3, dt=200.0)), kinematics=kinematics, **MESH)
    np.testing.assert_allclose(moved.rods[0].r[-1], rest.rods[0].r[-1], atol=1e-9)
    np.testing.assert_allclose(moved.rods[0].m[-1], rest.rods[0].m[-1], atol=1e-7)


@BOTH_SCHEMES
@both_kinematics
def test_a_fibre_falls_as_fast_as_the_air_lets_it(kinematics, scheme):
    """Ramie, 20 µm, level: 0.08695 m/s (process.md 2.4, drag = weight); the air takes all the weight gives."""
    scene = dr.Scene(
        [dr.Rod.straight(0.04, dr.Section.ramie())],
        loads=[dr.Gravity((0.0, 0.0, -9.81))],
        air=dr.Air(),
        motion=dr.Dynamic(t_end=0.15, dt=0.002, scheme=scheme, output=0.15),
    )
    result = dr.solve(scene, kinematics=kinematics, elements=2)
    np.testing.assert_allclose(result.rods[0].v[-1], np.tile([0.0, 0.0, -0.08695], (7, 1)), atol=5e-6)
    gained = {name: values[-1] - values[0] for name, values in result.energy.items()}
    assert gained["drag"] < 0.0
    assert gained["kinetic"] + gained["potential"] == pytest.approx(gained["drag"] + gained["numerical"], rel=1e-9)


@BOTH_SCHEMES
def test_wind_bends_a_cantilever_the_same_in_any_pose(scheme):
    def tip(pose: Pose) -> np.ndarray:
        section = dr.Section.circle(diameter=20e-6, E=34e9, G=1.6e9, density=1540.0)
        scene = dr.Scene(
            [pose.straight(section, length=0.01)],
            [dr.Clamp("start")],
            air=dr.Air(field=lambda x, _t: np.tile(pose.turned((0.0, 3.0, 1.0)), (len(x), 1))),
            motion=dr.Dynamic(t_end=2e-3, dt=1e-4, scheme=scheme, output=2e-3),
        )
        return pose.back(dr.solve(scene, **MESH).tip)

    blown = tip(FLAT)
    assert blown[1] > 1e-4
    np.testing.assert_allclose(tip(SKEW), blown, rtol=0, atol=1e-10)


def test_steps_of_free_length_follow_the_tolerance():
    """The error of a step is h³ and that of a run h², so a hundredth of the one is 100^⅔ of the other; few steps do."""
    tip = np.array([0.9063091847993885, 0.34982239512781893])
    errors = []
    for tol in (1e-4, 1e-6):
        motion = dr.Dynamic(t_end=0.4, tol=tol, scheme=dr.Midpoint(), output=0.4)
        result = dr.solve(pushed(FLAT, motion), kinematics=dr.Planar((0, 0, 1)), elements=6, degree=4)
        errors.append(np.abs(FLAT.back(result.tip)[:2] - tip).max())
    assert errors[0] <= 10.0 * 1e-4
    assert errors[0] / errors[1] == pytest.approx(100.0 ** (2.0 / 3.0), rel=0.3)
    assert len(result.log) <= 100


def test_an_interrupted_run_keeps_what_it_reached():
    def stop(step: dr.StepLog, _t_end: float) -> None:
        if step.t > 0.05:
            raise KeyboardInterrupt

    with pytest.raises(dr.NotConverged, match="interrupted by the user") as caught:
        dr.solve(thrown(dr.Dynamic(t_end=0.2, dt=0.01)), progress=stop, **MESH)
    assert caught.value.result.t[-1] == pytest.approx(0.06)
    assert not caught.value.result.converged


@pytest.mark.parametrize("dt", [4e-3, 1e-3])
@both_kinematics
def test_a_stiff_rod_that_spins_goes_on_to_spin(kinematics, dt):
    """200 times as long as thick, 0.13 rad a step: strains of a state between, shorter by ⅛ (ω Δt)², would burst it."""
    EA = 16.0 * 200.0**2
    section = dr.Section(EA=EA, GA=0.9 * EA / 2.6, GJ=1 / 1.3, EI=1.0, rhoA=1.0, rhoI=(2 / EA, 1 / EA, 1 / EA))
    motion = dr.Dynamic(0.2, dt, dr.Midpoint())
    spin = [dr.Velocity(omega=(0.0, 0.0, 31.4))]
    scene = dr.Scene([dr.Rod.straight(1.0, section)], [dr.Pin("start")], motion=motion, velocities=spin)
    energy = dr.solve(scene, **MESH, kinematics=kinematics).energy
    whole = energy["kinetic"] + energy["strain"]
    assert np.abs(whole / whole[0] - 1.0).max() <= 5e-3
    assert np.abs(energy["numerical"]).max() <= 5e-3 * whole[0]


@example(6, 0.002, None)
@given(st.integers(1, 400), st.floats(1e-7, 1e3), st.sampled_from([None, 1.0, 3.0]))
def test_equal_steps_end_where_the_motion_ends(n, dt, every):
    """n steps and none left out, however n Δt is rounded."""
    motion = dr.Dynamic(n * dt, dt, output=None if every is None else every * dt)
    met = targets(dr.Scene([dr.Rod.straight(1.0, SECTION)], motion=motion), motion)
    assert met[-1] == motion.t_end
    assert len(met) == n
    np.testing.assert_allclose(np.diff([0.0, *met]), dt, rtol=1e-6)
