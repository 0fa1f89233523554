"""Laws of rods that rest on, press and slide along surfaces: balance, meshes, frames of reference, histories, ranks."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from mpi4py import MPI

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.newton import Newton
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.spatial import SpatialRods
from tests.scenes import FLAT, SKEW, Pose, both_kinematics, differences

RADIUS = 0.01
# Slender and round: L = EI = 1, no strain alike.
SECTION = dr.Section(EA=4e3, GA=1.5e3, GJ=0.8, EI=1.0, radius=RADIUS)
EPS, Q = 2e4, 3.0
LAWS = [dr.Penalty(EPS, 1e-3), dr.SmoothPenalty(EPS, 1e-4, 1e-3), dr.AugmentedLagrangian(EPS, 1e-9)]
all_laws = pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)


def floor(pose: Pose, law: object, friction: object = None, motion: dr.WallMotion | None = None) -> dr.Contact:
    """The half space y < 0."""
    plane = dr.Plane(pose.placed((0.0, 0.0, 0.0)), pose.turned((0.0, 1.0, 0.0)), motion)
    return dr.Contact(plane, law, friction)


def lying(pose: Pose, law: object, friction: object = None, *loads: object, **parts: object) -> dr.Scene:
    """A rod that lies on the floor, just touching it, under a line load Q that presses it down."""
    rod = pose.straight(SECTION, start=(0.0, RADIUS + law.g_0, 0.0))
    pressing = dr.LineForce(pose.turned((0.0, -Q, 0.0)))
    return dr.Scene([rod], loads=[pressing, *loads], contacts=[floor(pose, law, friction)], **parts)


@all_laws
@both_kinematics
@pytest.mark.parametrize(("elements", "degree"), [(1, 1), (3, 2), (5, 3), (2, 5)])
def test_every_node_carries_its_share_of_a_line_load(elements, degree, kinematics, law):
    """C1: p = q everywhere, whatever the mesh; the gap is that of the law."""
    result = dr.solve(lying(SKEW, law), elements=elements, degree=degree, kinematics=kinematics)
    (touching,) = result.contacts[0].rods
    np.testing.assert_allclose(touching.pressure[-1], Q, rtol=1e-8)
    np.testing.assert_allclose(
        law.pressure(touching.gap[-1], np.zeros(len(touching.s)))[0][-1], 0.0 if law is LAWS[2] else Q, atol=1e-3
    )
    np.testing.assert_allclose(result.contacts[0].force[-1], SKEW.turned((0.0, Q, 0.0)), atol=1e-8)
    np.testing.assert_allclose(touching.share.sum(), 1.0, rtol=1e-14)
    assert result.contacts[0].length[-1] == pytest.approx(1.0)


def test_an_augmented_lagrangian_leaves_no_more_than_its_tolerance():
    law = dr.AugmentedLagrangian(20.0, 1e-7)
    result = dr.solve(lying(FLAT, law), elements=3)
    (touching,) = result.contacts[0].rods
    assert np.abs(touching.gap[-1]).max() <= 1e-7
    np.testing.assert_allclose(touching.pressure[-1], Q, rtol=1e-8)


def bent_over(pose: Pose, friction: object = None, eps: float = 1e5, steps: int | None = None) -> dr.Scene:
    """A cantilever above the floor, whose free part is pulled down onto it and along it."""
    rod = pose.straight(SECTION, start=(0.0, 0.1, 0.0))
    pull = dr.PointForce(pose.turned((1.0, -12.0, 0.0)), at="end")
    return dr.Scene(
        [rod], [dr.Clamp("start")], [pull], [floor(pose, dr.Penalty(eps), friction)], motion=dr.Static(steps=steps)
    )


@both_kinematics
def test_surfaces_balance_what_supports_do_not(kinematics):
    """Force on the rod: load + contact = force in the clamped section."""
    pose = SKEW
    result = dr.solve(bent_over(pose, dr.Coulomb(0.4)), elements=12, kinematics=kinematics)
    h = result.rods[0]
    at_clamp = h.frames[-1, 0] @ h.n[-1, 0]
    np.testing.assert_allclose(at_clamp, result.contacts[0].force[-1] + pose.turned((1.0, -12.0, 0.0)), atol=1e-5)
    assert result.contacts[0].length[-1] > 0.0


def test_planar_and_spatial_agree():
    scene = bent_over(SKEW, dr.Coulomb(0.4))
    flat, space = (dr.solve(scene, elements=12, kinematics=kin) for kin in (dr.Planar(), dr.Spatial()))
    assert max(differences(flat, space).values()) <= 1e-4
    np.testing.assert_allclose(flat.contacts[0].force, space.contacts[0].force, atol=1e-4)


@both_kinematics
def test_a_scene_may_be_anywhere(kinematics):
    """Turned and shifted as a whole, it has the same gaps, pressures and slips."""
    here, there = (
        dr.solve(bent_over(pose, dr.Coulomb(0.4)), elements=8, kinematics=kinematics) for pose in (FLAT, SKEW)
    )
    for name, scale in (("gap", 1e-9), ("pressure", 1e-9 * 1e5), ("slip", 1e-9)):
        a, b = (getattr(result.contacts[0].rods[0], name)[-1] for result in (here, there))
        np.testing.assert_allclose(a, b, atol=10 * scale)


def test_without_friction_the_way_does_not_matter():
    one, many = (dr.solve(bent_over(FLAT, steps=n), elements=12) for n in (1, 12))
    assert max(differences(many, one).values()) <= 1e-8


def test_with_friction_the_way_matters():
    """Pressed first and pulled then, a rod sticks where it slides if pulled first."""
    pull = (1.0, 0.0, 0.0)
    table = {"first": [(0.0, 0.0), (1.0, 1.0)], "then": [(1.0, 0.0), (2.0, 1.0)]}
    ends = []
    for press, drag in (("first", "then"), ("then", "first")):
        scene = dr.Scene(
            [FLAT.straight(SECTION, start=(0.0, RADIUS, 0.0))],
            [dr.Guide("start", free={"y", "rz"})],
            [dr.LineForce((0.0, -Q, 0.0), history=table[press]), dr.PointForce(pull, at="end", history=table[drag])],
            [floor(FLAT, dr.Penalty(EPS), dr.Coulomb(0.6))],
            motion=dr.Static(t_end=2.0),
        )
        ends.append(dr.solve(scene, elements=6).tip[0])
    assert ends[1] - 1.0 == pytest.approx(1.0 / SECTION.EA, rel=1e-3)
    assert ends[0] - 1.0 < 0.9 * (ends[1] - 1.0)


@both_kinematics
@pytest.mark.parametrize("law", [LAWS[0], LAWS[2]], ids=["Penalty", "AugmentedLagrangian"])
def test_a_rod_slides_where_its_slope_exceeds_mu(kinematics, law):
    """Pushed along the floor it sticks, with no slip at all, and holds up to |t| = μ q; beyond there is nothing."""
    mu = 0.3

    def pushed(part: float) -> dr.Result:
        scene = lying(FLAT, law, dr.Coulomb(mu), dr.LineForce((part * mu * Q, 0.0, 0.0)))
        pressed = replace(scene.loads[0], history=dr.Steady())
        return dr.solve(replace(scene, loads=[pressed, scene.loads[1]]), elements=2, kinematics=kinematics)

    (touching,) = pushed(0.9).contacts[0].rods
    assert (touching.state[-1] == 1).all()
    np.testing.assert_array_equal(touching.slip[-1], 0.0)
    assert pushed(1.0 - 1e-6).contacts[0].force[-1][0] == pytest.approx(-(1.0 - 1e-6) * mu * Q, rel=1e-8)
    with pytest.raises(dr.NotConverged) as caught:
        pushed(1.0 + 1e-6)
    assert caught.value.t == pytest.approx(1.0, abs=1e-3)


@both_kinematics
def test_a_wall_carries_along_what_sticks_to_it(kinematics):
    """Shifted with the rod on it, the wall does no work against friction: nothing slips, nothing is strained."""
    shift = (0.03, -0.02, 0.0)
    scene = lying(FLAT, dr.Penalty(EPS), dr.Coulomb(0.5))
    moved = replace(scene, contacts=[floor(FLAT, dr.Penalty(EPS), dr.Coulomb(0.5), dr.WallMotion(displacement=shift))])
    rest, carried = (dr.solve(s, elements=3, kinematics=kinematics) for s in (scene, moved))
    np.testing.assert_allclose(carried.rods[0].r[-1] - rest.rods[0].r[-1], np.tile(shift, (10, 1)), atol=1e-9)
    np.testing.assert_allclose(carried.contacts[0].rods[0].traction[-1], 0.0, atol=1e-6)


def test_friction_turns_a_rod_that_is_dragged_across():
    """Its moment about the centreline, r t per length, twists a rod whose ends are held: m₁ = ± μ q r L/2 there."""
    mu = 0.2
    rod = FLAT.straight(SECTION, start=(0.0, RADIUS, 0.0))
    held = [dr.Prescribed(at, displacement=(0.0, None, 0.05), rotation=(0.0, 0.0, 0.0)) for at in ("start", "end")]
    scene = dr.Scene([rod], held, [dr.LineForce((0.0, -Q, 0.0))], [floor(FLAT, dr.Penalty(1e6), dr.Coulomb(mu))])
    result = dr.solve(scene, elements=8)
    torque = result.rods[0].m[-1, :, 0]
    across = result.contacts[0].rods[0].traction[-1, :, 2]
    assert torque[0] == pytest.approx(-torque[-1], rel=1e-6)
    # The rod bows by 2e-3, which lets the pressures have moments of 1e-5 of that of friction.
    assert abs(torque[0]) == pytest.approx(0.5 * RADIUS * abs(across @ result.contacts[0].rods[0].share), rel=1e-4)


@both_kinematics
def test_going_on_from_a_result_is_going_on(kinematics):
    """Friction remembers through `start`: what was stopped halfway ends where the whole ends."""
    pull = dr.PointForce((0.8, 0.0, 0.0), at="end", history=[(0.0, 0.0), (1.0, 1.0), (2.0, -0.5)])
    held = [dr.Guide("start", free={"x", "y", "rz"})]
    posed = lying(FLAT, dr.Penalty(EPS), dr.Coulomb(0.3), pull, supports=held)
    pressing = replace(posed.loads[0], history=dr.Steady())
    scene = replace(posed, loads=[pressing, pull], motion=dr.Static(t_end=2.0, steps=8))

    def stop(row: dr.StepLog, _: float) -> None:
        if row.t >= 1.0:
            raise KeyboardInterrupt

    options = {"elements": 4, "kinematics": kinematics, "comm": MPI.COMM_SELF}
    whole = dr.solve(scene, **options)
    with pytest.raises(dr.NotConverged) as stopped:
        dr.solve(scene, progress=stop, **options)
    on = dr.solve(scene, start=stopped.value.result, **options)
    assert max(differences(on, whole).values()) <= 1e-9
    slip = whole.contacts[0].rods[0].slip
    np.testing.assert_allclose(on.contacts[0].rods[0].slip[-1], slip[-1], atol=1e-12)
    assert slip[-1].max() > slip[4].max() > 0.0


@settings(max_examples=20)
@given(seed=st.integers(0, 2**32 - 1))
@pytest.mark.parametrize("rods", [PlanarRods(), SpatialRods()], ids=["planar", "spatial"])
@pytest.mark.serial
def test_the_tangent_is_the_derivative_of_the_residual(rods, seed):
    """Sticking and sliding nodes, with the moments of friction, at any state."""
    random = np.random.default_rng(seed)
    scene = bent_over(FLAT, dr.Coulomb(0.4))
    d = Discretization(MPI.COMM_SELF, rods, 3, (2,), rubbed=True)
    kinematics = dr.Planar((0.0, 0.0, 1.0), (0.0, 0.0, 0.0)) if rods.dim == 2 else dr.Spatial()
    problem = Problem(scene, d, Placement.of(scene, kinematics))
    r, q = d.owned_nodes("r"), d.owned_nodes("q")
    problem.x[r] += 0.02 * random.standard_normal(r.shape) - np.eye(rods.dim)[1] * 0.1
    change = 0.1 * random.standard_normal(q.shape)
    problem.x[q] = rods.turn(problem.x[q], rods.increment(problem.x[q], change))
    problem.contacts.begin(1.0)
    way = np.zeros(len(problem.x))
    way[r] = random.standard_normal(r.shape)
    way[q] = rods.increment(problem.x[q], random.standard_normal(q.shape))
    x, h = problem.x.copy(), 1e-7

    def contact_at(state: np.ndarray) -> np.ndarray:
        problem.x[:] = state
        b = np.zeros(len(x))
        problem.contacts.add_residual(b, problem.x[q])
        return b

    slope = (contact_at(x + h * way) - contact_at(x - h * way)) / (2 * h)
    contact_at(x)
    found = np.zeros(len(x))
    for rows, columns, blocks in problem.contacts.blocks(problem.x[q]):
        np.add.at(found, rows, np.einsum("nij,nj->ni", blocks, way[columns]))
    np.testing.assert_allclose(found, slope, atol=1e-4 * max(1.0, np.abs(slope).max()))


def test_what_a_scene_does_not_touch_leaves_no_trace():
    scene = lying(FLAT, LAWS[0], dr.Coulomb(0.3))
    touching, alone = dr.solve(scene, elements=2), dr.solve(replace(scene, contacts=(), loads=()), elements=2)
    assert {"Contact", "Friction"} <= set(touching.formulation.terms)
    assert not {"Contact", "Friction"} & set(alone.formulation.terms)
    assert alone.contacts == ()
    assert "touch" not in alone.state


def test_stability_is_judged_where_contact_has_no_memory():
    """A rod pressed down on a floor is stable; one that rubs is not judged, and says so."""
    smooth, rough = (dr.solve(lying(FLAT, LAWS[0], friction), elements=2) for friction in (None, dr.Coulomb(0.3)))
    assert smooth.log[-1].stable is True
    assert rough.log[-1].stable is None
    assert any("memory" in note for note in rough.formulation.notes)
    with pytest.raises(dr.SceneError, match="memory"):
        dr.buckling(lying(FLAT, LAWS[0], dr.Coulomb(0.3)))


@both_kinematics
@all_laws
@pytest.mark.parametrize("elements", [1, 5])
def test_ranks_do_not_matter(elements, kinematics, law):
    scene = bent_over(SKEW, dr.Coulomb(0.4))
    scene = replace(scene, contacts=[replace(scene.contacts[0], law=law)])
    together, alone = (
        dr.solve(scene, elements=elements, kinematics=kinematics, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)
    )
    assert max(differences(together, alone).values()) <= 1e-7
    for name in ("gap", "slip", "share"):
        a, b = (getattr(result.contacts[0].rods[0], name) for result in (together, alone))
        np.testing.assert_allclose(a, b, atol=1e-8)
    np.testing.assert_allclose(together.contacts[0].force, alone.contacts[0].force, atol=1e-5)


@both_kinematics
@pytest.mark.parametrize("friction", [None, dr.Coulomb(0.4)], ids=["smooth", "rough"])
@pytest.mark.serial
def test_newton_is_quadratic_where_contact_is_smooth(kinematics, friction, monkeypatch):
    """Increments of the last solve, below 0.1 and above round-off: each is at most some squares of the one before."""
    sizes: list[float] = []
    limit = Newton._limit

    def noting(self: Newton, *vectors: object) -> bool:
        done = limit(self, *vectors)
        sizes.append(self._size)
        return done

    monkeypatch.setattr(Newton, "_limit", noting)
    rod = FLAT.straight(SECTION, start=(0.0, 0.05, 0.0))
    pull = dr.PointForce((0.5, -6.0, 0.0), at="end")
    contact = floor(FLAT, dr.SmoothPenalty(1e3, 2e-2), friction)
    dr.solve(dr.Scene([rod], [dr.Clamp("start")], [pull], [contact]), elements=6, kinematics=kinematics)
    last = len(sizes) - 1
    while sizes[last - 1] > sizes[last]:
        last -= 1
    tail = [size for size in sizes[last:] if 1e-11 < size < 1e-1]
    assert len(tail) >= 2
    for before, after in pairwise(tail):
        assert after <= 10.0 * before**2
