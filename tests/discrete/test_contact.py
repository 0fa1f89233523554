"""Rods at rest against surfaces, by the discrete model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
from discrete.contact import Contacts
from discrete.mesh import mesh
from discrete.rotation import exp
from discrete.turns import Turns
from discrete.unknowns import AXIAL, SPIN, X
from dolfinrod.result import NotConverged, Result
from dolfinrod.scene import (
    AugmentedLagrangian,
    Clamp,
    Contact,
    Coulomb,
    Guide,
    LineForce,
    Penalty,
    Pin,
    Plane,
    PointForce,
    Rod,
    Scene,
    SceneError,
    Section,
    SmoothPenalty,
    Static,
    Steady,
    WallMotion,
)
from tests.scenes import FLAT, SKEW, Pose

ROUND = Section(EA=900.0, GA=400.0, GJ=0.7, EI=1.0, radius=0.01)
FIBRE = Section.ramie()
LENGTH = 0.04
MU = 0.64
LAWS = [
    Penalty.paper(),
    Penalty.tight(),
    Penalty(1e9),
    SmoothPenalty(4e5, 1e-8, 1e-6),
    AugmentedLagrangian(4e5, 1e-12),
]


def wall(pose: Pose, beta: float = 0.0, **motion: WallMotion) -> Plane:
    """A plane through the origin of a scene, its normal along z but for an angle towards y."""
    return Plane(pose.placed((0, 0, 0)), pose.turned((0.0, np.sin(beta), np.cos(beta))), **motion)


def lying(pose: Pose, above: float = 0.0) -> Rod:
    """A fibre along x that just touches the plane z = 0, or lies so far above."""
    return pose.straight(FIBRE, length=LENGTH, start=(0.0, 0.0, FIBRE.radius + above))


def over_a_wall(law: object, friction: Coulomb | None = None, **options: object) -> Scene:
    """A cantilever that a line load bends down upon a plane."""
    touched = Contact(Plane((0, 0, -0.11)), law, friction)
    loads = [LineForce((0, 0, -20.0))]
    return Scene([Rod.straight(1.0, ROUND)], [Clamp("start")], loads, contacts=[touched], **options)


@pytest.mark.parametrize("elements", [3, 8])
@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("pose", [FLAT, SKEW], ids=["flat", "skew"])
def test_a_fibre_on_a_plane_feels_its_line_load_on_any_mesh(pose, law, elements):
    """C1: p = q and g = g_0 − q/ε_N at every node, q l at inner nodes and half of it at the ends."""
    q = 0.01
    scene = Scene([lying(pose)], (), [LineForce(pose.turned((0, 0, -q)))], contacts=[Contact(wall(pose), law)])
    touched = discrete.solve(scene, elements=elements).contacts[0]
    rod, (force,) = touched.rods[0], touched.force[-1:]
    # Places are known to round-off of a metre, and pressures to that times the stiffness.
    off = 1e-8 + 1e-15 * law.eps_N / q
    assert rod.pressure[-1] == pytest.approx(q, rel=off)
    if isinstance(law, Penalty):
        assert rod.gap[-1] == pytest.approx(law.g_0 - q / law.eps_N, abs=off * q / law.eps_N)
    nodal = rod.share * rod.pressure[-1]
    l = LENGTH / elements
    assert nodal == pytest.approx(q * l * np.r_[0.5, np.ones(elements - 1), 0.5], rel=off)
    assert force == pytest.approx(pose.turned((0, 0, q * LENGTH)), abs=off * q * LENGTH)
    assert touched.length[-1] == pytest.approx(LENGTH, rel=1e-12)


@pytest.mark.parametrize("above", [pytest.param(5e-5, marks=pytest.mark.slow), 1e-3], ids=["near", "far"])
def test_a_fibre_above_a_plane_comes_to_rest_on_it(above):
    q, law = 0.01, Penalty.tight()
    scene = Scene([lying(SKEW, above)], (), [LineForce(SKEW.turned((0, 0, -q)))], contacts=[Contact(wall(SKEW), law)])
    result = discrete.solve(scene, elements=5)
    assert result.contacts[0].rods[0].gap[-1] == pytest.approx(law.g_0 - q / law.eps_N, abs=1e-8 * q / law.eps_N)


@pytest.mark.parametrize("degrees", [15.0, 40.0])
def test_two_walls_share_a_load(degrees):
    """C4: N = q/(2 cos β) on each wall of a V."""
    q, β, law = 0.01, np.deg2rad(degrees), Penalty.tight()
    rod = SKEW.straight(FIBRE, length=LENGTH, start=(0.0, 0.0, FIBRE.radius / np.cos(β)))
    walls = [Contact(wall(SKEW, angle), law) for angle in (β, -β)]
    result = discrete.solve(Scene([rod], (), [LineForce(SKEW.turned((0, 0, -q)))], contacts=walls), elements=4)
    for touched in result.contacts:
        assert touched.rods[0].pressure[-1] == pytest.approx(q / (2 * np.cos(β)), rel=1e-8)


@pytest.mark.parametrize("friction", [None, Coulomb(0.3)], ids=["smooth", "rough"])
def test_a_wall_answers_what_pulls_a_rod_on_to_it(friction):
    """As C3: two tensions at an angle b press with 2 T sin b, wherever the rod bends."""
    T, b = 50.0, 0.4
    rod = Rod.straight(1.0, ROUND, start=(0, 0, ROUND.radius))
    pulls = [PointForce((sign * T * np.cos(b), 0, -T * np.sin(b)), at) for sign, at in ((-1, "start"), (1, "end"))]
    supports = [Guide(0.5, free={"z", "ry"})]
    result = discrete.solve(
        Scene([rod], supports, pulls, contacts=[Contact(Plane(), Penalty(1e5), friction)]), elements=20
    )
    assert result.contacts[0].force[-1] == pytest.approx((0, 0, 2 * T * np.sin(b)), abs=1e-7 * T)


@pytest.mark.parametrize("law", [Penalty(1e4), Penalty(1e6), Penalty(1e9), SmoothPenalty(1e4, 1e-3)], ids=repr)
@pytest.mark.parametrize("friction", [None, Coulomb(0.3)], ids=["smooth", "rough"])
def test_a_rod_bends_upon_a_wall_in_a_few_load_steps(law, friction):
    result = discrete.solve(over_a_wall(law, friction), elements=20)
    assert len(result.log) <= 4
    assert result.statistics.newton_iterations <= 60 * len(result.log)
    assert all(row.stable is (True if friction is None else None) for row in result.log)
    assert ("Friction" in result.formulation.terms) is (friction is not None)
    assert any("not judged" in note for note in result.formulation.notes) is (friction is not None)
    rod = result.contacts[0].rods[0]
    assert (rod.gap[-1] > -30.0 / law.eps_N * 20).all()
    assert rod.state[-1][0] == 0
    assert rod.state[-1][-1] > 0


def test_an_augmented_lagrangian_lets_nothing_in_however_soft_it_begins():
    deep = discrete.solve(over_a_wall(AugmentedLagrangian(1e6, 1e-7)), elements=20)
    rod = deep.contacts[0].rods[0]
    assert np.abs(rod.gap[-1][rod.pressure[-1] > 0.0]).max() <= 1e-7
    hard = discrete.solve(over_a_wall(Penalty(1e9)), elements=20)
    assert deep.tip == pytest.approx(hard.tip, abs=1e-6)
    assert deep.log[0].stable is None
    soft = discrete.solve(over_a_wall(AugmentedLagrangian(10.0, 1e-9)), elements=20)
    rod = soft.contacts[0].rods[0]
    assert np.abs(rod.gap[-1][rod.pressure[-1] > 0.0]).max() <= 1e-9
    assert soft.tip == pytest.approx(hard.tip, abs=1e-6)


def on_a_slope(tan: float) -> Scene:
    """C5: a fibre pressed upon a wall by its normal load, dragged across it in proportion to the pseudo-time.

    It is kept from rolling at each of its nodes: a round rod does not stay on a slope.
    """
    q = 0.01
    loads = [LineForce((0, 0, -q), history=Steady()), LineForce((0, tan * q, 0))]
    touched = Contact(wall(FLAT), Penalty.tight(), Coulomb(MU))
    held = [Guide(s, free={"x", "y", "z", "ry", "rz"}) for s in ("start", 0.5 * LENGTH, "end")]
    return Scene([lying(FLAT)], held, loads, contacts=[touched])


def test_a_fibre_sticks_on_a_slope_up_to_the_coefficient_of_friction():
    rod = discrete.solve(on_a_slope(MU * (1 - 1e-6)), elements=2).contacts[0].rods[0]
    assert (rod.slip[-1] == 0.0).all()
    assert (rod.state[-1] == 1).all()
    assert np.linalg.norm(rod.traction[-1], axis=1) == pytest.approx(MU * 0.01, rel=2e-6)


def test_a_fibre_slides_beyond_it():
    with pytest.raises(NotConverged) as caught:
        discrete.solve(on_a_slope(MU * (1 + 1e-6)), elements=2)
    assert 1.0 - caught.value.t == pytest.approx(0.0, abs=2 / 2**12)
    with pytest.raises(NotConverged) as caught:
        discrete.solve(on_a_slope(1.5 * MU), elements=2)
    assert caught.value.t == pytest.approx(2 / 3, abs=2 / 2**12)


def test_a_wall_that_moves_drags_a_fibre_with_all_its_friction():
    """Once it slides all along, the tension at the clamp is μ times all that the wall carries, nearly μ q L.

    The moments of friction, r n × t, bend the fibre a little, so that the clamp carries its part.
    """
    q = 0.01
    motion = WallMotion(displacement=(1e-3, 0, 0), history=((0.0, 0.0), (0.3, 0.0), (0.7, 1.0), (1.0, 1.0)))
    touched = Contact(wall(FLAT, motion=motion), Penalty(4e5), Coulomb(MU))
    rod = FLAT.straight(FIBRE, length=LENGTH, start=(0.0, 0.0, FIBRE.radius - q / 4e5))
    scene = Scene([rod], [Clamp("start")], [LineForce((0, 0, -q), history=Steady())], contacts=[touched])
    result = discrete.solve(scene, elements=6)
    assert {0.3, 0.7} <= set(result.t)
    along = result.contacts[0].force[:, 0]
    assert along[-1] == pytest.approx(MU * result.contacts[0].force[-1, 2], rel=1e-8)
    assert along[-1] == pytest.approx(MU * q * LENGTH, rel=1e-3)
    assert along[list(result.t).index(0.3)] == pytest.approx(0.0, abs=1e-12)
    assert result.rods[0].n[-1, 0, 0] == pytest.approx(along[-1], rel=1e-8)


@pytest.mark.serial
def test_friction_depends_on_the_way_and_a_kept_run_remembers_it(tmp_path):
    """A rod dragged to and fro: the second half by itself, from a file, ends as the whole does."""
    history = ((0.0, 0.0), (0.5, 1.0), (1.0, -0.2))
    pull = PointForce((15.0, 0, 0), "end", history=history)
    press = LineForce((0, 0, -20.0), history=Steady())
    touched = Contact(Plane(), Penalty(1e5, 1e-3), Coulomb(0.3))
    rod = Rod.straight(1.0, ROUND, start=(0, 0, ROUND.radius))
    scene = Scene([rod], [Clamp("start")], [press, pull], contacts=[touched], motion=Static(steps=8))
    whole = discrete.solve(scene, elements=6)

    def stop(row: object, _: float) -> None:
        if row.t >= 0.6:
            raise KeyboardInterrupt

    with pytest.raises(NotConverged, match="interrupted"):
        discrete.solve(scene, elements=6, checkpoint=tmp_path / "run.h5", progress=stop)
    kept = discrete.solve(scene, elements=6, checkpoint=tmp_path / "run.h5")
    with pytest.raises(NotConverged, match="interrupted") as caught:
        discrete.solve(scene, elements=6, progress=stop)
    started = discrete.solve(scene, elements=6, start=caught.value.result)
    assert_same_contact(kept, whole)
    assert started.contacts[0].rods[0].slip[-1] == pytest.approx(whole.contacts[0].rods[0].slip[-1], abs=1e-12)
    slip = whole.contacts[0].rods[0].slip
    assert (np.diff(slip, axis=0) >= 0.0).all()
    assert slip[-1, -1] > 1e-3


def assert_same_contact(one: Result, other: Result) -> None:
    """Two records of one path."""
    np.testing.assert_allclose(one.t, other.t)
    for a, b in zip(one.contacts, other.contacts, strict=True):
        for name in ("gap", "pressure", "traction", "slip"):
            x, y = getattr(a.rods[0], name), getattr(b.rods[0], name)
            np.testing.assert_allclose(x, y, rtol=0, atol=1e-8 * np.abs(y).max())


def test_a_column_between_two_walls_buckles_as_on_a_foundation():
    """P = EI (mπ/L)² + k (L/mπ)² at its least over m, k the two stiffnesses ε_N together (Winkler; Timoshenko 1961)."""
    k = 2e4
    P = min((m * np.pi) ** 2 + k / (m * np.pi) ** 2 for m in range(1, 9))
    section = Section(EA=1e9, GA=1.0, GJ=1.0, EI=(1.0, 100.0), radius=0.01)
    halo = Penalty(k / 2, 0.05)
    walls = [Contact(Plane((0, 0, -sign * 0.03), (0, 0, sign)), halo) for sign in (1, -1)]
    for load, stable in ((0.97, True), (1.03, False)):
        scene = Scene(
            [Rod.straight(1.0, section, d2=(0, 1, 0))],
            [Guide("start", free={"ry", "rz"}), Guide("end", free={"x", "ry", "rz"})],
            [PointForce((-load * P, 0, 0), "end")],
            contacts=walls,
        )
        assert discrete.solve(scene, elements=60).log[-1].stable is stable


@pytest.mark.parametrize("friction", [None, Coulomb(0.4), Coulomb(5.0)], ids=["smooth", "slides", "sticks"])
def test_blocks_are_the_derivative_of_forces(friction):
    rng = np.random.default_rng(7)
    turning = WallMotion(displacement=(0.1, 0, 0), rotation=(0, 0, 0.3), spin=(0, 0, 0.1))
    touched = Contact(Plane(normal=(0.1, 0.2, 1.0), motion=turning), Penalty(300.0, 0.05), friction)
    scene = Scene([Rod.straight(1.0, ROUND)], contacts=[touched, Contact(Plane(normal=(0, 1, 1)), Penalty(80.0, 0.1))])
    cut = mesh(scene, 4)
    contacts = Contacts(scene, cut, Turns())
    contacts.recall({}, cut.x, cut.R, 0.0)
    x, R = cut.x + 0.02 * rng.normal(size=cut.x.shape), exp(0.3 * rng.normal(size=cut.x.shape)) @ cut.R
    contacts.at(x, R, 0.7)
    found = contacts.blocks()
    assert len(found.nodes) >= 3
    h = 1e-6
    for k in range(AXIAL):
        d = np.zeros((len(x), AXIAL))
        d[:, k] = h
        ahead, behind = (contacts.at(x + s * d[:, X], exp(s * d[:, SPIN]) @ R, 0.7) for s in (1, -1))
        slope = ((ahead - behind) / (2 * h))[found.nodes, :AXIAL]
        assert slope == pytest.approx(-found.blocks[:, :, k], abs=1e-6 * np.abs(found.blocks).max())


def test_increments_without_iterations_are_refused():
    with pytest.raises(SceneError, match="equilibrium must be True where rods touch surfaces"):
        discrete.solve(over_a_wall(Penalty(1e4)), equilibrium=False)


def test_a_scene_that_touches_nothing_is_solved_as_without():
    """The same bits, and nothing recorded."""
    scene = over_a_wall(Penalty(1e4))
    far = replace(scene, contacts=[Contact(Plane((0, 0, -10.0)), Penalty(1e4))])
    free = discrete.solve(replace(scene, contacts=()), elements=10)
    assert free.contacts == ()
    assert "Contact" not in free.formulation.terms
    assert (discrete.solve(far, elements=10).rods[0].r == free.rods[0].r).all()


def test_vibrations_of_a_pinned_rod_are_raised_by_a_wall():
    """ω² = (EI (π/L)⁴ + ε_N)/ρA of a beam on a foundation that its halo keeps pressed."""
    k = 500.0
    section = Section(EA=1e6, GA=1.0, GJ=1.0, EI=(1.0, 50.0), rhoA=1.0, radius=0.01)
    walls = [Contact(Plane((0, 0, -s * 0.03), (0, 0, s)), Penalty(k / 2, 0.05)) for s in (1, -1)]
    ends = [Pin("start"), Guide("end", free={"x", "ry", "rz"})]
    scene = Scene([Rod.straight(1.0, section, d2=(0, 1, 0))], ends, contacts=walls)
    first = discrete.modes(scene, modes=1, elements=40).frequencies[0]
    assert 2 * np.pi * first == pytest.approx(np.sqrt(np.pi**4 + k), rel=2e-3)
