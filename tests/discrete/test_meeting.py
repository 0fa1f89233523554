"""Rods at rest against one another, by the discrete model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
from discrete.equilibrium import Equilibrium
from discrete.loads import Loads
from discrete.meeting import Encounters
from discrete.mesh import mesh
from discrete.options import law
from discrete.rotation import exp
from discrete.supports import Supports
from discrete.surroundings import surroundings_of
from discrete.turns import Turns
from discrete.unknowns import SPIN, X
from dolfinrod.result import NotConverged, Result
from dolfinrod.scene import (
    Clamp,
    Contact,
    Coulomb,
    Guide,
    LineForce,
    Penalty,
    Plane,
    Prescribed,
    RodContact,
    Scene,
    SceneError,
    Section,
    SmoothPenalty,
    Static,
)
from tests.scenes import FLAT, SKEW, Pose, largest

FIBRE = Section.ramie()
RADIUS = 1e-5
LENGTH = 0.004
MU = 0.3
LAWS = [Penalty.tight(), Penalty(4e6, 1e-6), SmoothPenalty(4e5, 2e-7, 1e-6)]


def crossed(
    pose: Pose = FLAT,
    law: object = LAWS[0],
    friction: Coulomb | None = None,
    *,
    swapped: bool = False,
    depth: float = 12e-6,
    drag: float = 0.0,
    **options: object,
) -> Scene:
    """A fibre between clamps, and one across it, 6 µm above it, whose ends move down and along it."""
    lower = pose.straight(FIBRE, length=LENGTH, start=(-0.5 * LENGTH, 0.0, 0.0))
    turned = Pose(pose.Q @ np.array([[0.3, -0.954, 0.0], [0.954, 0.3, 0.0], [0.0, 0.0, 1.0]]), pose.origin)
    start = np.array([-0.47 * LENGTH, 0.0, 2 * RADIUS + 6e-6])
    upper = turned.straight(FIBRE, length=LENGTH, start=start)
    i, j = (1, 0) if swapped else (0, 1)
    down = pose.turned((drag, 0, -depth))
    supports = [Clamp("start", rod=i), Clamp("end", rod=i)]
    supports += [Prescribed(at, displacement=down, rotation=(0, 0, 0), rod=j) for at in ("start", "end")]
    rods = [upper, lower] if swapped else [lower, upper]
    return Scene(rods, supports, contacts=[RodContact(law, friction)], **options)


def reaction(result: Result, rod: int) -> np.ndarray:
    """Force that supports at both ends of a rod take up, in space."""
    of = result.rods[rod]
    ends = of.frames[-1, [0, -1]] @ of.n[-1, [0, -1], :, None]
    return np.asarray(ends[1, :, 0] - ends[0, :, 0])


@pytest.mark.parametrize("pose", [FLAT, SKEW], ids=["flat", "skew"])
@pytest.mark.parametrize("how", LAWS, ids=["tight", "stiff", "smooth"])
def test_crossed_fibres_push_each_other_apart(how, pose):
    """Third law, and equilibrium of each: its supports take up what the other does to it."""
    result = discrete.solve(crossed(pose, how), elements=13)
    (met,) = result.meetings
    on_lower, on_upper = met.force(-1, 0, 1), met.force(-1, 1, 0)
    assert on_lower == pytest.approx(-on_upper, abs=1e-15 * largest(on_upper))
    for k, force in enumerate((on_lower, on_upper)):
        assert reaction(result, k) == pytest.approx(-force, abs=1e-7 * largest(force))
    local = force @ pose.Q
    assert local[2] > 0.0
    assert local[:2] == pytest.approx(0.0, abs=1e-3 * local[2])
    assert "RodContact" in result.formulation.terms
    assert sum(row.iterations for row in result.log) <= 25


def test_forces_do_not_depend_on_who_is_named_first():
    one, other = (discrete.solve(crossed(swapped=swapped), elements=13) for swapped in (False, True))
    for k in (0, 1):
        assert one.rods[k].r[-1] == pytest.approx(other.rods[1 - k].r[-1], rel=0, abs=1e-12 * LENGTH)
    a, b = one.meetings[0].force(-1, 0, 1), other.meetings[0].force(-1, 1, 0)
    assert a == pytest.approx(b, rel=0, abs=1e-12 * largest(a))


def stacked(law: object, friction: Coulomb | None = None) -> Scene:
    """A fibre on a plane and one on top of it under a line load of 1 mN/m, both held sideways at their ends."""
    rods = [FLAT.straight(FIBRE, length=LENGTH, start=(0.0, 0.0, z * RADIUS)) for z in (1, 3)]
    free = {"start": ("z", "ry", "rz"), "end": ("x", "z", "ry", "rz")}
    held = [Guide(at, free=names, rod=k) for k in (0, 1) for at, names in free.items()]
    contacts = [Contact(Plane((0, 0, 0)), law), RodContact(law, friction)]
    return Scene(rods, held, [LineForce((0, 0, -1e-3), rod=1)], contacts=contacts)


@pytest.mark.parametrize("elements", [(5, 9), (20, 20)])
@pytest.mark.parametrize("how", LAWS, ids=["tight", "stiff", "smooth"])
def test_a_fibre_that_lies_on_another_weighs_on_it(how, elements):
    """On meshes that need not match; the gap is that of the line load, but for what nodes make of the ends."""
    result = discrete.solve(stacked(how), elements=elements)
    (met,) = result.meetings
    weight = 1e-3 * LENGTH
    assert met.force(-1, 1, 0) == pytest.approx([0.0, 0.0, weight], rel=0, abs=1e-9 * weight)
    assert result.contacts[0].force[-1] == pytest.approx([0.0, 0.0, weight], rel=0, abs=1e-9 * weight)
    if elements == (20, 20):
        inner = np.abs(met.times[-1].s_a - 0.5 * LENGTH) < 0.25 * LENGTH
        p, _ = how.pressure(met.times[-1].gap[inner], np.zeros(inner.sum()))
        assert p == pytest.approx(1e-3, rel=1e-3)


@pytest.mark.parametrize("drag", [1e-6, 2e-5], ids=["sticks", "slides"])
def test_friction_sticks_and_slides(drag):
    """Dragged along by less and by more than what friction takes up: |t| below mu N, and mu N where all slides.

    The resultant over a spot on round rods is a little more or less than that of any of its points.
    """
    scene = crossed(friction=Coulomb(MU), drag=drag, motion=Static(steps=4))
    result = discrete.solve(scene, elements=13)
    met = result.meetings[0].times[-1]
    along = np.linalg.norm(met.traction, axis=1)
    pressed = np.einsum("ni,ni->n", met.force, met.normal)
    assert "Friction" in result.formulation.terms
    if drag > 1e-5:
        assert (met.state == 2).all()
        assert along == pytest.approx(MU * pressed, rel=1e-2)
    else:
        assert (0.1 * MU * pressed < along).all()
        assert (along < 0.7 * MU * pressed).all()


def test_couples_of_friction_leave_no_moment():
    """All that rods that rub do to each other, forces and moments about any point, adds up to nothing."""
    scene = crossed(SKEW, friction=Coulomb(MU), drag=1e-5)
    cut = mesh(scene, 21)
    others = Encounters(scene, cut, Turns())
    rng = np.random.default_rng(1)
    others.recall({}, cut.x, cut.R, 0.0)
    others.begin(1.0)
    x = cut.x.copy()
    x[cut.first[1] :] += np.array(SKEW.turned((4e-6, 3e-6, -1e-5))) / cut.units.length
    R = exp(rng.normal(scale=0.05, size=x.shape)) @ cut.R
    felt = others.force(x, R)
    force, moment = felt[:, X], felt[:, SPIN]
    assert others.met
    assert force.sum(axis=0) == pytest.approx(0.0, abs=1e-12 * largest(force))
    about = (np.cross(x, force) + moment).sum(axis=0)
    assert about == pytest.approx(0.0, abs=1e-12 * largest(force))


@pytest.mark.parametrize("friction", [None, Coulomb(MU)], ids=["smooth", "rough"])
def test_what_rods_answer_is_the_slope_of_what_they_do(friction):
    """Of forces and moments at nodes, by differences; products, blocks and entries of the matrix are one thing."""
    scene = crossed(SKEW, Penalty(4e5, 4e-6), friction)
    cut = mesh(scene, 9)
    others = Encounters(scene, cut, Turns())
    rng = np.random.default_rng(2)
    others.recall({}, cut.x, cut.R, 0.0)
    others.begin(1.0)
    x = cut.x.copy()
    x[cut.first[1] :] += np.array(SKEW.turned((2e-7, 3e-7, -8e-6))) / cut.units.length
    R = exp(rng.normal(scale=1e-3, size=x.shape)) @ cut.R
    others.force(x, R)
    links = others.links()
    d = rng.normal(size=(len(x), 7)) * np.array([1e-5, 1e-5, 1e-5, 1e-3, 1e-3, 1e-3, 0.0])
    # How the ends of a spot move with the nodes is left out of the slope; spins do not move them.
    moved, off = (X, 2e-2) if friction is None else (SPIN, 1e-5)
    only, h = np.zeros_like(d), 1e-3
    only[:, moved] = d[:, moved]
    ahead, behind = (others.force(x + a * only[:, X], exp(a * only[:, SPIN]) @ R) for a in (h, -h))
    slope = links.change(only)
    assert largest(slope) > 0.0 or friction is None
    assert slope == pytest.approx((ahead - behind) / (2 * h), rel=0, abs=off * largest(slope))
    foretold = links.change(d)
    whole = np.zeros((d.size, d.size))
    rows, columns, values = links.entries()
    np.add.at(whole, (rows, columns), values)
    nodes, blocks = links.nodal
    for node, block in zip(nodes, blocks, strict=True):
        at = slice(7 * node, 7 * node + 6)
        whole[at, at] += block
    assert -(whole @ d.reshape(-1)).reshape(d.shape) == pytest.approx(foretold, rel=0, abs=1e-10 * largest(foretold))


@pytest.mark.parametrize("friction", [None, Coulomb(MU)], ids=["smooth", "rough"])
def test_rods_that_touch_are_one_system(friction):
    """Factors of band and coupling together undo their product, guided sections and held unknowns among them."""
    scene = stacked(Penalty.tight(), friction)
    cut = mesh(scene, (5, 7))
    parts = Loads(scene, cut), Supports(scene, cut), surroundings_of(scene, cut)
    equilibrium = Equilibrium(cut, law(cut.elements, "chord", "element"), *parts)
    state = equilibrium.begin()
    x, R = state.x.copy(), state.R
    x[:, 2] -= 3e-7 / cut.units.length * np.arange(len(x)) / len(x)
    equilibrium.place(state, 0.0, {})
    moved = replace(state, x=x, R=exp(np.full_like(x, 1e-4)) @ R)
    tangent = equilibrium.tangent(moved, equilibrium.loads.level(1.0), 1.0)
    assert tangent.coupled
    assert len(tangent.guided)
    v = np.random.default_rng(3).normal(size=(tangent.system.n_unknowns, 2)) * tangent.system.scale[:, None]
    v[tangent.system.held] = 0.0
    right = tangent.times(v)
    right[tangent.system.held] = 0.0
    found = tangent.inverse().times(right)
    assert found / tangent.system.scale[:, None] == pytest.approx(v / tangent.system.scale[:, None], rel=0, abs=1e-6)


def test_a_step_through_a_fibre_is_cut():
    """A prescribed way of two diameters in one load step: the fibres still press each other afterwards."""
    scene = crossed(SKEW, depth=4.5e-5)
    result = discrete.solve(scene, elements=9)
    assert sum(row.cuts for row in result.log) > 0
    assert result.meetings[0].force(-1, 1, 0) @ np.array(SKEW.turned((0, 0, 1))) > 0.0


@pytest.mark.serial
def test_a_path_in_two_parts_is_one_path(tmp_path):
    """From a checkpoint and from the record of the first part, with all that friction remembers."""
    scene = crossed(friction=Coulomb(MU), drag=1e-5, motion=Static(steps=4))
    whole = discrete.solve(scene, elements=13)

    def stop(row: object, _: float) -> None:
        if row.t >= 0.5:
            raise KeyboardInterrupt

    with pytest.raises(NotConverged, match="interrupted") as caught:
        discrete.solve(scene, elements=13, progress=stop, checkpoint=tmp_path / "run.h5")
    kept = discrete.solve(scene, elements=13, checkpoint=tmp_path / "run.h5")
    started = discrete.solve(scene, elements=13, start=caught.value.result)
    size = whole.meetings[0].total(-1)
    assert size > 0.0
    for one in (kept, started):
        assert one.meetings[0].force(-1, 0, 1) == pytest.approx(whole.meetings[0].force(-1, 0, 1), abs=1e-6 * size)
        assert one.rods[0].r[-1] == pytest.approx(whole.rods[0].r[-1], rel=0, abs=1e-9 * LENGTH)
    for a, b in zip(kept.meetings[0].times, whole.meetings[0].times, strict=True):
        np.testing.assert_array_equal(a.rod_a, b.rod_a)


def test_rods_that_may_touch_are_not_judged_and_say_so():
    result = discrete.solve(crossed(), elements=7)
    assert all(row.stable is None for row in result.log)
    assert any("not judged" in note for note in result.formulation.notes)
    with pytest.raises(SceneError, match="rods with rods"):
        discrete.critical(replace(crossed(), motion=Static()), elements=7)
