"""Laws of rods that hit, slide on and stick to surfaces in time: energy, impulse, thresholds, walls, restarts."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from dolfinrod.continuum.pressed import DIRECT
from tests.scenes import FLAT, SKEW, Pose, both_kinematics, differences
from verification.references.friction import restitution

RADIUS = 0.01
SECTION = dr.Section(EA=4e3, GA=1.5e3, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(5e-5, 2.5e-5, 2.5e-5), radius=RADIUS)
EPS = 1e4
# Half a period of a point mass ρA on the stiffness ε_N, all in units of 1.
BOUNCE = np.pi / np.sqrt(EPS)
both_schemes = pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])
LAWS = dr.Penalty(EPS), dr.Penalty(EPS, damping=0.3 / np.sqrt(EPS))
both_laws = pytest.mark.parametrize("law", LAWS, ids=["elastic", "damped"])
MESH = {"elements": 2, "degree": 3}


def floor(
    pose: Pose, friction: object = None, motion: dr.WallMotion | None = None, law: object = dr.Penalty(EPS)
) -> dr.Contact:
    """The half space y < 0 of a pose."""
    plane = dr.Plane(pose.placed((0.0, 0.0, 0.0)), pose.turned((0.0, 1.0, 0.0)), motion)
    return dr.Contact(plane, law, friction)


def thrown(
    motion: dr.Dynamic, v: tuple[float, float, float], *, pose: Pose = FLAT, friction: object = None, **more: object
) -> dr.Scene:
    """A rod that flies at the floor, which it is about to touch."""
    rod = pose.straight(SECTION, start=(0.0, RADIUS + 1e-6, 0.0))
    start = dr.Velocity(v=pose.turned(v))
    return dr.Scene([rod], contacts=[floor(pose, friction, **more)], motion=motion, velocities=[start])


def lying(
    motion: dr.Dynamic,
    push: tuple[float, float, float],
    friction: object,
    wall: dr.WallMotion | None = None,
    **more: object,
) -> dr.Scene:
    """A rod at rest on the floor, as deep as the line load presses it."""
    rod = FLAT.straight(SECTION, start=(0.0, RADIUS + push[1] / EPS, 0.0))
    return dr.Scene([rod], loads=[dr.LineForce(push)], contacts=[floor(FLAT, friction, wall)], motion=motion, **more)


def unclosed(result: dr.Result) -> float:
    """What the ledger does not account for, over the energy there was."""
    e = result.energy
    stored = sum(e[name] - e[name][0] for name in ("kinetic", "strain", "potential", "contact"))
    works = ("load work", "support work", "wall work", "drag", "damping", "friction", "numerical")
    scale = max(float(np.abs(e[name]).max()) for name in ("kinetic", "contact", "wall work", "load work"))
    return float(np.abs(stored - sum(e[name] for name in works)).max()) / scale


@both_schemes
@both_kinematics
def test_an_impact_gains_no_energy(kinematics, scheme):
    """C2: largest penetration v √(ρA/ε), time of contact π √(ρA/ε), and back at the same speed as steps shrink."""
    back, depth = [], []
    for n in (40, 80):
        motion = dr.Dynamic(1.5 * BOUNCE, 1.5 * BOUNCE / n, scheme)
        result = dr.solve(thrown(motion, (0.0, -1.0, 0.0), pose=SKEW), kinematics=kinematics, **MESH)
        e = result.energy
        assert (e["kinetic"] + e["strain"] + e["contact"]).max() <= e["kinetic"][0] * (1.0 + 1e-8)
        assert unclosed(result) <= 1e-8
        back.append(1.0 - float((result.rods[0].v[-1] @ SKEW.turned((0.0, 1.0, 0.0))).mean()))
        depth.append(-float(result.contacts[0].rods[0].gap.min()) * np.sqrt(EPS) - 1.0)
    if isinstance(scheme, dr.Midpoint):
        assert np.abs(back).max() <= 1e-7
        assert abs(depth[1]) <= 1e-3
    else:
        assert back[0] / back[1] == pytest.approx(2.0, rel=0.15)
        assert depth[0] / depth[1] == pytest.approx(2.0, rel=0.15)


@both_schemes
@both_kinematics
@pytest.mark.parametrize("ratio", [0.1, 1.5], ids=["swings", "creeps"])
def test_a_wall_with_damping_returns_what_its_ratio_says(kinematics, scheme, ratio):
    """Its coefficient of restitution; what is lost is damping's, but for what implicit Euler takes itself."""
    law, off = dr.Penalty(EPS, damping=2.0 * ratio / np.sqrt(EPS)), []
    for n in (50, 100):
        motion = dr.Dynamic(2.0 * BOUNCE, BOUNCE / n, scheme)
        result = dr.solve(thrown(motion, (0.0, -1.0, 0.0), pose=SKEW, law=law), kinematics=kinematics, **MESH)
        e, v = result.energy, result.rods[0].v[-1] @ SKEW.turned((0.0, 1.0, 0.0))
        assert v == pytest.approx(v[0], rel=1e-6)
        assert unclosed(result) <= 1e-8
        assert np.diff(e["damping"]).max() <= 1e-12
        assert (result.contacts[0].rods[0].pressure >= 0.0).all()
        off.append(restitution(ratio) - float(v[0]))
        if isinstance(scheme, dr.Midpoint):
            assert e["kinetic"][0] - e["kinetic"][-1] + e["damping"][-1] == pytest.approx(0.0, abs=1e-8)
    if isinstance(scheme, dr.Midpoint):
        assert np.abs(off).max() <= 2e-4
    else:
        assert off[0] / off[1] == pytest.approx(2.0, rel=0.1)


def test_at_rest_there_is_no_damping():
    """A rod pressed on a wall, step by step of a pseudo-time: the same to the last digit."""
    rod = FLAT.straight(SECTION, start=(0.0, RADIUS, 0.0))
    found = []
    for damping in (0.0, 0.3):
        held = [dr.Clamp(at="start")]
        wall = floor(FLAT, law=dr.Penalty(EPS, damping=damping))
        scene = dr.Scene([rod], held, [dr.LineForce((0.0, -50.0, 0.0))], contacts=[wall])
        found.append(dr.solve(scene, **MESH))
    one, other = (result.contacts[0].rods[0].pressure for result in found)
    np.testing.assert_array_equal(one, other)
    assert one[-1].max() > 10.0


@both_schemes
def test_momentum_changes_by_the_impulse_of_the_surface(scheme):
    motion = dr.Dynamic(0.5 * BOUNCE, 0.5 * BOUNCE / 50, scheme)
    result = dr.solve(thrown(motion, (0.6, -1.0, 0.3), friction=dr.Coulomb(0.3)), **MESH)
    touching = result.contacts[0].rods[0]
    momentum = np.einsum("s,tsi->ti", touching.share, result.rods[0].v)
    np.testing.assert_allclose(
        np.diff(momentum, axis=0), np.diff(result.t)[:, None] * touching_force(result), atol=1e-8
    )


def touching_force(result: dr.Result) -> np.ndarray:
    """Resultant of the surface in each step; the stored one is what has acted in the step that led there."""
    return result.contacts[0].force[1:]


@both_schemes
@both_kinematics
def test_friction_only_takes(kinematics, scheme):
    """An oblique impact, sliding and turning the rod."""
    motion = dr.Dynamic(2.0 * BOUNCE, BOUNCE / 40, scheme)
    scene = thrown(motion, (0.8, -1.0, 0.0), friction=dr.Coulomb(0.2))
    result = dr.solve(scene, kinematics=kinematics, **MESH)
    e = result.energy
    assert unclosed(result) <= 1e-8
    assert np.diff(e["friction"]).max() <= 1e-12
    assert e["friction"][-1] < -0.1
    total = e["kinetic"] + e["strain"] + e["contact"]
    assert total.max() <= total[0] * (1.0 + 1e-8)


@both_schemes
@both_kinematics
@pytest.mark.parametrize("mu", [0.3, 0.64])
def test_a_rod_slides_with_what_friction_leaves(kinematics, scheme, mu):
    """C5: acceleration (tan β − μ) q/ρA along a slope where tan β > μ, and no slip at all below.

    A load that is put on at once swings the anchors twice as far as it holds them in the end.
    """
    q, steps = 50.0, 20
    for tangent, moves in ((mu + 0.4, True), (0.45 * mu, False)):
        motion = dr.Dynamic(0.02, 0.02 / steps, scheme)
        loads = (q * tangent, -q, 0.0)
        scene = lying(motion, loads, dr.Coulomb(mu, eps_T=1e7))
        result = dr.solve(scene, kinematics=kinematics, **MESH)
        velocity = float(result.rods[0].v[-1, :, 0].mean())
        if moves:
            assert velocity == pytest.approx((tangent - mu) * q * 0.02, rel=1e-3)
        else:
            np.testing.assert_array_equal(result.contacts[0].rods[0].slip[-1], 0.0)
            assert (result.contacts[0].rods[0].state[-1] == 1).all()


@both_schemes
def test_a_roller_is_found_to_roll_on_without_softer_floors(scheme):
    """A solid cylinder pushed across itself slides until it rolls, at ⅔ of its speed but for the error of the steps.

    Its anchors, far stiffer than the steps resolve, swing from one side to the other in each: sticking all the same.
    The speed: m v₀ r = (m r² + ½ m r²) ω, the moment of momentum about a line on the floor, which friction keeps.
    """
    speed, q, eps = 1.0, 10.0, 1e8
    plane = dr.Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    scene = dr.Scene(
        [FLAT.straight(SECTION, start=(0.0, RADIUS - q / eps, 0.0))],
        loads=[dr.LineForce((0.0, -q, 0.0))],
        contacts=[dr.Contact(plane, dr.Penalty(eps), dr.Coulomb(0.3))],
        velocities=[dr.Velocity((0.0, 0.0, speed))],
        motion=dr.Dynamic(0.2, 0.01, scheme),
    )
    result = dr.solve(scene, **MESH)
    np.testing.assert_allclose(result.rods[0].v[-1, :, 2], 2.0 / 3.0 * speed, rtol=0.05)
    assert (result.contacts[0].rods[0].state[-1] == 1).all()
    assert max(row.iterations for row in result.log) < DIRECT


@both_schemes
def test_a_wall_that_starts_moving_takes_a_rod_along(scheme):
    """C9: at speed v after v ρA/(μ q); of the work of the wall, half moves the rod, half is rubbed off.

    Backward Euler takes the velocity at the end of a step for that of the step, and slips less by one of them.
    """
    mu, q, v = 0.5, 20.0, 0.3
    t = v / (mu * q)
    motion = dr.Dynamic(2.0 * t, t / 20, scheme)
    wall = dr.WallMotion(velocity=(v, 0.0, 0.0))
    result = dr.solve(lying(motion, (0.0, -q, 0.0), dr.Coulomb(mu, eps_T=1e8), wall), **MESH)
    speed = result.rods[0].v[:, :, 0].mean(axis=1)
    assert speed[10] == pytest.approx(0.5 * v, rel=0.03)
    assert speed[-1] == pytest.approx(v, rel=1e-2)
    e = result.energy
    assert e["wall work"][-1] == pytest.approx(v**2, rel=0.05)
    rubbed = 0.5 * v**2 * (1.0 - 1.0 / 20 if isinstance(scheme, dr.ImplicitEuler) else 1.0)
    assert e["friction"][-1] == pytest.approx(-rubbed, rel=0.02)
    assert unclosed(result) <= 1e-8


def test_what_has_settled_does_not_creep():
    """C10: anchors stand still to the last bit; friction against the velocity lets the rod creep."""
    mu, q = 0.64, 20.0
    push = (q * np.tan(np.radians(15.0)), -q, 0.0)
    motion = dr.Dynamic(0.2, 0.002)
    sticks = dr.solve(lying(motion, push, dr.Coulomb(mu)), **MESH)
    slip = sticks.contacts[0].rods[0].slip
    np.testing.assert_array_equal(slip[50:], np.tile(slip[50], (len(slip) - 50, 1)))
    v_0 = 1e-3
    creeps = dr.solve(lying(motion, push, dr.CreepingCoulomb(mu, v_0)), **MESH)
    expected = v_0 * push[0] / np.sqrt((mu * q) ** 2 - push[0] ** 2)
    assert float(creeps.rods[0].v[-1, :, 0].mean()) == pytest.approx(expected, rel=1e-3)


def test_a_solid_cylinder_rolls():
    """Down a slope with a = ⅔ g sin β as long as tan β < 3 μ: friction acts at its surface."""
    radius, q, mu = 0.1, 20.0, 0.5
    solid = dr.Section(
        EA=4e5,
        GA=1.5e5,
        GJ=80.0,
        EI=100.0,
        rhoA=1.0,
        rhoI=(0.5 * radius**2, 0.25 * radius**2, 0.25 * radius**2),
        radius=radius,
    )
    slope = np.radians(40.0)
    down = (0.0, -q * np.cos(slope), q * np.sin(slope))
    rod = FLAT.straight(solid, start=(0.0, radius + down[1] / EPS, 0.0))
    motion = dr.Dynamic(0.1, 0.001, dr.Midpoint())
    scene = dr.Scene(
        [rod], loads=[dr.LineForce(down)], contacts=[floor(FLAT, dr.Coulomb(mu, eps_T=1e8))], motion=motion
    )
    result = dr.solve(scene, elements=1, degree=3, kinematics=dr.Spatial())
    v, spin = result.rods[0].v[-1, :, 2].mean(), result.rods[0].omega[-1, :, 0].mean()
    assert v == pytest.approx(2.0 / 3.0 * q * np.sin(slope) * 0.1, rel=1e-2)
    assert spin * radius == pytest.approx(v, rel=1e-2)
    assert result.energy["friction"][-1] >= -1e-3 * result.energy["kinetic"][-1]


@both_schemes
@both_laws
@pytest.mark.serial
def test_a_motion_goes_on_where_it_was_stopped(tmp_path, law, scheme):
    """Anchors and slips are kept, in a result and in a file: stopped halfway, a motion ends where it would have."""

    def scene(t_end: float) -> dr.Scene:
        motion = dr.Dynamic(t_end, BOUNCE / 20, scheme)
        return thrown(motion, (0.3, -1.0, 0.2), friction=dr.Coulomb(0.4), law=law)

    def stop(row: dr.StepLog, _: float) -> None:
        if row.t > 0.6 * BOUNCE:
            raise KeyboardInterrupt

    whole = dr.solve(scene(2.0 * BOUNCE), **MESH)
    on = [dr.solve(scene(2.0 * BOUNCE), start=dr.solve(scene(0.5 * BOUNCE), **MESH), **MESH)]
    file = tmp_path / "motion.h5"
    with pytest.raises(dr.NotConverged, match="interrupted"):
        dr.solve(scene(2.0 * BOUNCE), checkpoint=file, progress=stop, **MESH)
    on.append(dr.solve(scene(2.0 * BOUNCE), checkpoint=file, **MESH))
    for result in on:
        assert max(differences(result, whole).values()) <= 1e-9
        slip = result.contacts[0].rods[0].slip[-1]
        np.testing.assert_allclose(slip, whole.contacts[0].rods[0].slip[-1], atol=1e-12)
        for name in ("friction", "damping"):
            assert result.energy[name][-1] == pytest.approx(whole.energy[name][-1], rel=1e-9)


@both_schemes
@both_laws
@both_kinematics
def test_ranks_do_not_matter(kinematics, law, scheme):
    motion = dr.Dynamic(BOUNCE, BOUNCE / 20, scheme)
    scene = thrown(motion, (0.8, -1.0, 0.0), friction=dr.Coulomb(0.2), law=law)
    together, alone = (
        dr.solve(scene, kinematics=kinematics, comm=comm, **MESH) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)
    )
    assert max(differences(together, alone).values()) <= 1e-8
    for name in ("friction", "damping", "contact", "wall work"):
        np.testing.assert_allclose(together.energy[name], alone.energy[name], atol=1e-10)


STIFF = {
    "Euler stiffer": (dr.ImplicitEuler(), 100, 1e11),
    "Euler finer": (dr.ImplicitEuler(), 400, 1e9),
    "midpoint stiffer": (dr.Midpoint(), 100, 1e12),
    "midpoint finer": (dr.Midpoint(), 400, 1e9),
}


@both_kinematics
@pytest.mark.parametrize(("scheme", "elements", "eps_N"), STIFF.values(), ids=STIFF)
def test_round_off_of_stiff_walls_ends_an_iteration(kinematics, scheme, elements, eps_N):
    """A fibre of 4 cm pressed to a wall: what is rounded off of positions is more of the forces than a tolerance."""
    fibre = dr.Section.ramie()
    rod = FLAT.straight(fibre, start=(0.0, fibre.radius, 0.0), length=0.04)
    wall = dr.Contact(dr.Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)), dr.Penalty(eps_N), dr.Coulomb(0.3))
    motion = dr.Dynamic(8e-6, 1e-6, scheme)
    scene = dr.Scene([rod], loads=[dr.LineForce((1e-3, -1e-2, 0.0))], contacts=[wall], motion=motion)
    result = dr.solve(scene, elements=elements, degree=3, kinematics=kinematics)
    assert result.statistics.load_steps == 8
    assert result.statistics.newton_iterations <= 6 * 8
    assert result.contacts[0].force[-1] @ np.array([0.0, 1.0, 0.0]) > 0.0
