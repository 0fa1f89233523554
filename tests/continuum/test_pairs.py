"""Laws of rods that press and slide along one another at rest: balance, names, ranks, frames, friction, the tangent."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from mpi4py import MPI

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.continuum.coupled import coupled
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.newton import Newton
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.spatial import SpatialRods
from tests.scenes import FLAT, SKEW, Pose, differences, force_in_space, largest

RADIUS, EPS, GAP = 0.01, 1e4, 1e-4
# Slender and round: L = EI = 1, no strain alike.
SECTION = dr.Section(EA=4e3, GA=1.5e3, GJ=0.8, EI=1.0, radius=RADIUS)
LAW = dr.Penalty(EPS, GAP)
# Beside the middles of the rods, so that no node lies where they cross.
ASIDE = 0.013


def crossed(pose: Pose = FLAT, friction: dr.Coulomb | None = None, *, press: float = 1.0, order: int = 1) -> dr.Scene:
    """Two rods clamped at both ends, one across the other, pressed together by line loads."""
    lower = dr.Rod.straight(1.0, SECTION, start=pose.placed((-0.5, ASIDE, 0.0)), direction=pose.turned((1, 0, 0)))
    start, across = (ASIDE, -0.6, 2 * RADIUS + GAP), pose.turned((0.2, 1.0, 0.0))
    upper = dr.Rod.straight(1.1, SECTION, start=pose.placed(start), direction=across)
    up, down = pose.turned((0.0, 0.0, press)), pose.turned((0.0, 0.0, -press))
    loads = [(0, dr.LineForce(up, rod=0)), (1, dr.LineForce(down, rod=1))]
    supports = [dr.Clamp("start"), dr.Clamp("end")]
    rods, loads = [lower, upper][::order], [replace(load, rod=k if order > 0 else 1 - k) for k, load in loads]
    return dr.Scene(rods, supports, loads, [dr.RodContact(LAW, friction)])


def stacked(pose: Pose, q: float = 2.0) -> dr.Scene:
    """A rod on a floor and one on top of it, which a line load presses down from the start."""
    rods = [pose.straight(SECTION, start=(0.0, h, 0.0)) for h in (RADIUS, 3 * RADIUS)]
    floor = dr.Contact(dr.Plane(pose.placed((0.0, 0.0, 0.0)), pose.turned((0.0, 1.0, 0.0))), LAW)
    held = dr.Guide("start", free={"y", "z", "rx", "ry", "rz"})
    load = dr.LineForce(pose.turned((0.0, -q, 0.0)), history=dr.Steady(), rod=1)
    return dr.Scene(rods, [held], [load], [floor, dr.RodContact(LAW)])


@pytest.fixture(scope="module")
def pressed() -> dr.Result:
    # What one element feels is dealt out to nodes of those beside it too: none of these is at a clamp.
    return dr.solve(crossed(SKEW), elements=6)


def test_what_one_rod_feels_the_other_feels_reversed(pressed):
    """Each rod by itself: the sections at its clamps and the line load balance ±F."""
    F = pressed.meetings[0].force(-1, 0, 1)
    np.testing.assert_allclose(pressed.meetings[0].force(-1, 1, 0), -F, rtol=1e-14)
    assert np.linalg.norm(F) > 0.1
    for k, sign in ((0, 1.0), (1, -1.0)):
        h, load = pressed.rods[k], np.asarray(pressed.scene.loads[k].force) * pressed.scene.rods[k].length
        held = force_in_space(h, -1) - force_in_space(h, 0)
        np.testing.assert_allclose(held + load + sign * F, 0.0, atol=1e-8)


def test_the_record_says_where_and_how_they_touch(pressed):
    (met,) = pressed.meetings[0].times[-1:]
    assert set(zip(met.rod_a, met.rod_b, strict=True)) == {(0, 1), (1, 0)}
    np.testing.assert_allclose(met.s_a[met.rod_a == 0], met.s_b[met.rod_a == 1], atol=1e-4)
    assert (met.gap < GAP).all()
    assert (met.state == 2).all()
    np.testing.assert_allclose(np.einsum("ni,ni->n", met.force, met.normal), np.linalg.norm(met.force, axis=1))
    # They begin at the very edge of the halo, where round-off says whether they touch, and nothing pushes.
    np.testing.assert_allclose(pressed.meetings[0].times[0].gap, GAP, rtol=0, atol=1e-15)
    assert largest(pressed.meetings[0].force(0, 0, 1)) <= 1e-12 * largest(pressed.meetings[0].force(-1, 0, 1))
    assert {"Rod contact"} <= set(pressed.formulation.terms)
    assert not {"Contact", "Friction"} & set(pressed.formulation.terms)


def test_it_does_not_matter_which_rod_is_named_first(pressed):
    other = dr.solve(crossed(SKEW, order=-1), elements=6)
    F, G = pressed.meetings[0].force(-1, 0, 1), other.meetings[0].force(-1, 1, 0)
    np.testing.assert_allclose(F, G, atol=1e-12 * largest(F))
    for one, another in zip(pressed.rods, other.rods[::-1], strict=True):
        np.testing.assert_allclose(one.r[-1], another.r[-1], atol=1e-10)


@pytest.mark.parametrize(("elements", "degree"), [(1, 2), (3, 3)])
def test_parallel_rods_carry_a_line_load_everywhere(elements, degree):
    """p = q along both contacts, whatever the mesh; surfaces and rods act together, in the plane in which all lie."""
    q, result = 2.0, dr.solve(stacked(FLAT), elements=elements, degree=degree, kinematics=dr.Planar())
    assert {"Contact", "Rod contact"} <= set(result.formulation.terms)
    met, down = result.meetings[0].times[-1], (0.0, -q, 0.0)
    np.testing.assert_allclose(met.gap, GAP - q / EPS, atol=1e-9)
    np.testing.assert_allclose(result.meetings[0].force(-1, 0, 1), down, atol=1e-8)
    np.testing.assert_allclose(result.contacts[0].rods[0].pressure[-1], q, rtol=1e-7)
    assert result.contacts[0].rods[1].length[-1] == 0.0
    assert result.log[-1].stable is True


@pytest.mark.parametrize(("μ", "shift", "state"), [(20.0, 1e-6, 1), (0.3, 5e-3, 2)], ids=["sticks", "slides"])
def test_friction_holds_up_to_its_cone_and_no_further(μ, shift, state):
    """A rod drawn along itself over another: inside the cone it sticks, beyond the traction is μ p against the way."""
    pressed = crossed(friction=dr.Coulomb(μ))
    along = np.array((0.2, 1.0, 0.0)) / np.hypot(0.2, 1.0)
    held = [dr.Clamp("start", rod=0), dr.Clamp("end", rod=0)]
    later = ((0.0, 0.0), (0.5, 0.0), (1.0, 1.0))
    drawn = [dr.Prescribed(at, shift * along, (0.0, 0.0, 0.0), history=later, rod=1) for at in ("start", "end")]
    loads = [replace(load, history=((0.0, 0.0), (0.5, 1.0))) for load in pressed.loads]
    scene = replace(pressed, supports=[*held, *drawn], loads=loads, motion=dr.Static(steps=2))
    result = dr.solve(scene, elements=4)
    met = result.meetings[0].times[-1]
    p, t = np.linalg.norm(met.force - met.traction, axis=1), np.linalg.norm(met.traction, axis=1)
    assert (met.state == state).all()
    # Normals turn along a spot by as much as its length over the distance of the rods, so that |∫ p n ds| < ∫ p ds.
    assert (t <= 1.05 * μ * p).all()
    on_drawn = np.where((met.rod_a == 1)[:, None], met.traction, -met.traction).sum(axis=0)
    assert on_drawn @ along < 0.0
    if state == 2:
        np.testing.assert_allclose(-on_drawn @ along, μ * p.sum(), rtol=0.05)
    assert "Friction" in result.formulation.terms
    assert result.log[-1].stable is None
    assert any("memory" in note for note in result.formulation.notes)


@settings(max_examples=10)
@given(seed=st.integers(0, 2**32 - 1))
@pytest.mark.parametrize("rods", [PlanarRods(), SpatialRods()], ids=["planar", "spatial"])
@pytest.mark.parametrize("friction", [None, dr.Coulomb(0.4)], ids=["smooth", "rough"])
@pytest.mark.serial
def test_the_tangent_is_the_derivative_of_the_residual(rods, friction, seed):
    """P + C of two rods that lie along each other, at any state near that."""
    random = np.random.default_rng(seed)
    scene = stacked(FLAT)
    scene = replace(scene, contacts=[replace(scene.contacts[1], friction=friction)])
    d = Discretization(MPI.COMM_SELF, rods, 3, (2, 2), rubbed=friction is not None)
    plane = dr.Planar((0.0, 0.0, 1.0), (0.0, 0.0, 0.0)) if rods.dim == 2 else dr.Spatial()
    problem = Problem(scene, d, Placement.of(scene, plane))
    r, q = d.owned_nodes("r"), d.owned_nodes("q")
    problem.x[r[problem.x[r][:, 1] > RADIUS]] -= 0.3 * RADIUS * np.eye(rods.dim)[1]
    problem.x[r] += 1e-4 * random.standard_normal(r.shape)
    problem.x[q] = rods.turn(problem.x[q], rods.increment(problem.x[q], 1e-3 * random.standard_normal(q.shape)))
    problem.contacts.begin(1.0)
    way = np.zeros(len(problem.x))
    way[r] = random.standard_normal(r.shape)
    way[q] = rods.increment(problem.x[q], random.standard_normal(q.shape))
    free = ~problem.excluded
    way *= free
    x, h = problem.x.copy(), 1e-7

    def residual_at(state: np.ndarray) -> np.ndarray:
        problem.x[:] = state
        b = np.zeros(len(x))
        problem.add_residual(b)
        return b

    slope = (residual_at(x + h * way) - residual_at(x - h * way)) / (2 * h)
    residual_at(x)
    problem.assemble_tangent(d.matrix)
    with coupled(d.matrix, problem) as tangent:
        along, found = tangent.createVecs()
        along.array[:] = way
        tangent.mult(along, found)
        off = largest((found.array - slope) * free)
    assert off <= 1e-5 * max(1.0, largest(slope))


@pytest.mark.parametrize("friction", [None, dr.Coulomb(0.4)], ids=["smooth", "rough"])
def test_products_are_those_of_the_blocks(friction):
    """C u by what points of contact answer, on any number of ranks, is C u by its entries less what is in P."""
    rng, scene = np.random.default_rng(0), stacked(FLAT)
    scene = replace(scene, contacts=[replace(scene.contacts[1], friction=friction)])
    d = Discretization(MPI.COMM_WORLD, SpatialRods(), 3, (2, 2), rubbed=friction is not None)
    problem = Problem(scene, d, Placement.of(scene, dr.Spatial()))
    pairs, r = problem.pairs, d.dofs["r"].reshape(-1, 3)
    problem.x[r[problem.x[r][:, 1] > 2 * RADIUS]] -= 0.3 * RADIUS * np.eye(3)[1]
    pairs.begin(1.0)
    problem.assemble_tangent(d.matrix)
    with coupled(d.matrix, problem) as whole:
        u, product, alone = d.matrix.createVecRight(), d.matrix.createVecLeft(), d.matrix.createVecLeft()
        u.array[pairs.at] = rng.standard_normal(pairs.at.shape)
        whole.mult(u, product)
        d.matrix.mult(u, alone)
        product.axpy(-1.0, alone)
        mine = u.array[pairs.at]
        by_points = pairs.links().times(mine) - np.einsum("nij,nj->ni", pairs.inside, mine)
        size = d.comm.allreduce(largest(product.array), op=MPI.MAX)
        assert size > 1.0
        np.testing.assert_allclose(by_points, product.array[pairs.at], rtol=0, atol=1e-11 * size)


@pytest.mark.serial
def test_newton_is_quadratic_where_rods_touch(monkeypatch):
    """Increments below 0.1 and above round-off: each is at most some squares of the one before."""
    sizes: list[float] = []
    limit = Newton._limit

    def noted(self, X, Y):
        answer = limit(self, X, Y)
        sizes.append(self._size)
        return answer

    monkeypatch.setattr(Newton, "_limit", noted)
    result = dr.solve(crossed(), elements=4)
    assert result.log[-1].iterations <= 25
    pairs = [(a, b) for a, b in pairwise(sizes) if 1e-7 < a < 1e-2]
    assert pairs
    assert all(b <= max(100.0 * a * a, 1e-2 * a) for a, b in pairs)


@pytest.mark.parametrize("friction", [None, dr.Coulomb(0.3)], ids=["smooth", "rough"])
def test_ranks_do_not_matter(friction):
    scene = crossed(SKEW, friction)
    together, alone = (dr.solve(scene, elements=4, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    assert max(differences(together, alone).values()) <= 1e-7
    F, G = (result.meetings[0].force(-1, 0, 1) for result in (together, alone))
    np.testing.assert_allclose(F, G, atol=1e-7)
    for name in ("rod_a", "s_a", "gap"):
        a, b = (getattr(result.meetings[0].times[-1], name) for result in (together, alone))
        np.testing.assert_allclose(a, b, atol=1e-8)


@pytest.mark.parametrize("friction", [None, dr.Coulomb(0.3)], ids=["smooth", "rough"])
def test_a_path_goes_on_where_it_was_interrupted(friction, shared_path):
    scene = replace(crossed(friction=friction), motion=dr.Static(steps=3))
    whole, file = dr.solve(scene, elements=3), shared_path / "path.h5"

    def stop(step: dr.StepLog, _t_end: float) -> None:
        if step.t > 0.6:
            raise KeyboardInterrupt

    with pytest.raises(dr.NotConverged, match="interrupted") as caught:
        dr.solve(scene, elements=3, checkpoint=file, progress=stop)
    for again in (
        dr.solve(scene, elements=3, checkpoint=file),
        dr.solve(scene, elements=3, start=caught.value.result),
    ):
        assert max(differences(again, whole).values()) <= 1e-8
        F, G = (result.meetings[0].force(-1, 0, 1) for result in (again, whole))
        np.testing.assert_allclose(F, G, atol=1e-7)


def test_stability_is_judged_with_what_links_the_rods(pressed):
    """By the whole tangent where loads have a potential; else it is not known, and the result says so."""
    assert (pressed.log[-1].stable, pressed.log[-1].unstable_directions) == (True, 0)
    scene = pressed.scene
    twisted = replace(scene, loads=[*scene.loads, dr.FollowerForce((0.0, 0.1, 0.0), at=0.25, rod=0)])
    result = dr.solve(twisted, elements=4)
    assert result.log[-1].stable is None
    assert any("not judged" in note for note in result.formulation.notes)


def test_what_no_rod_meets_leaves_no_trace():
    scene = replace(crossed(), contacts=())
    alone = dr.solve(scene, elements=2)
    assert alone.meetings == ()
    assert not [name for name in alone.state if name.startswith("meet")]
    assert "Rod contact" not in alone.formulation.terms


def test_critical_loads_of_rods_that_touch_are_refused_in_words():
    scene = crossed()
    heavy = [replace(rod, section=replace(SECTION, rhoA=1.0, rhoI=(0.0, 0.0, 0.0))) for rod in scene.rods]
    for analyse in (dr.buckling, dr.modes):
        with pytest.raises(dr.SceneError, match="RodContact"):
            analyse(replace(scene, rods=heavy))
