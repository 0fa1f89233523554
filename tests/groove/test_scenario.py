"""Scenarios: every parameter is checked, the scene is what they say, its mirror image is built."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.groove import (
    VARIANTS,
    Bundle,
    CrossSection,
    Ends,
    FixedCore,
    LineSink,
    RollingCore,
    Scenario,
    variant,
    varied,
)
from dolfinrod.groove.described import described, key
from dolfinrod.groove.paper import MESHES, READINGS
from dolfinrod.groove.sections import KINDS
from dolfinrod.scene import Clamp, Contact, Coulomb, CreepingCoulomb, Guide, Penalty, Prescribed, RodContact, SceneError

every_kind = pytest.mark.parametrize("kind", KINDS)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Scenario("left"), 'Scenario.kind must be one of "lateral", "intermediate", "lateral_steep"'),
        (lambda: Scenario(fibres=0), "Scenario.fibres must be a whole number from 1 to 200, got 0"),
        (lambda: Scenario(seed=-1), "Scenario.seed must be a whole number"),
        (lambda: Scenario(dt=1.0), "Scenario.dt must lie between 1e-09 and 0.001 s, got 1.0 s"),
        (lambda: Scenario(t_end=6.0e3), "Scenario.t_end must lie between 1e-06 and 10 s"),
        (lambda: Scenario(output=1e-7), "Scenario.output must lie between 1e-06 and 10 s"),
        (lambda: Scenario(elements=1), "Scenario.elements must be a whole number from 2"),
        (lambda: Scenario(air="on"), "Scenario.air must be one of LineSink, None, got 'on'"),
        (lambda: Scenario(core=0.08e-3), "Scenario.core must be one of FixedCore, RollingCore, None"),
        (lambda: Scenario(wall_friction=0.64), "Scenario.wall_friction must be one of Coulomb, CreepingCoulomb, None"),
        (lambda: Scenario(ends=Ends(trailing=(6,))), r"Ends.trailing must be numbers from 1 to 5, got \[6\]"),
        (lambda: Ends(leading=(1,), trailing=(1,)), "Ends.leading must not name fibres that trail"),
        (lambda: Ends(leading="edge"), "Ends.leading"),
        (lambda: Ends(tension=0.5), "Ends.tension must lie between 0 and 0.1 N, got 0.5 N"),
        (lambda: Ends(exit="closed"), 'Ends.exit must be one of "free", "held"'),
        (lambda: Ends(speed=170.0), "Ends.speed must lie between 0 and 10 m/s"),
        (lambda: Bundle(pitch=0.25), "Bundle.pitch must lie between 1e-05 and 0.01 m, got 0.25 m"),
        (lambda: Bundle(offset=-1.0), "Bundle.offset must lie between -0.05 and 0.05 m"),
        (lambda: Bundle(height=0.2), "Bundle.height must lie between"),
        (lambda: Bundle(noise=-1e-6), "Bundle.noise must lie between 0 and 0.0001 m"),
        (lambda: Bundle(layers=1.0), "Bundle.layers must lie between"),
        (lambda: Bundle(length=40.0), "Bundle.length must lie between 0.001 and 1 m, got 40.0 m"),
        (lambda: Bundle(tail=-1.0), "Bundle.tail must lie between"),
        (lambda: Scenario(core=FixedCore(1e-3)), "core.radius must be at most 0.000416102 m to lie between the flanks"),
        (lambda: FixedCore(0.08), "FixedCore.radius must lie between 1e-05 and 0.001 m"),
        (lambda: RollingCore(fibres=0.5), "RollingCore.fibres must lie between 1 and 1000, got 0.5"),
        (lambda: RollingCore(start=1.0), "RollingCore.start must lie between"),
        (lambda: LineSink(radius=0.5), "LineSink.radius must lie between"),
        (lambda: LineSink(holes=2.0), "LineSink.holes must lie between 0 and 1, got 2.0"),
        (lambda: CrossSection(fillet=0.15), "CrossSection.fillet must lie between"),
        (lambda: Scenario(groove=CrossSection(fillet=5e-6)).scene(), "must be above 1.1e-05 m"),
        (lambda: Scenario.paper("cgs"), 'reading must be one of "SI", "mm_mN", "mm_N", got \'cgs\''),
        (lambda: Scenario.paper(mesh="fine"), 'mesh must be one of "long", "zone"'),
        (lambda: Scenario().run("beam"), 'model must be one of "continuum", "discrete"'),
        (lambda: variant(Scenario(), "L3"), "variant must be one of"),
        (lambda: varied(Scenario(), "ends.speeed", 1.0), "parameter must be the name of a parameter"),
        (lambda: varied(Scenario(), "run", 1.0), "parameter must be the name of a parameter"),
    ],
)
def test_what_cannot_be_meant_is_refused_in_words(make, words):
    with pytest.raises(SceneError, match=words):
        make()


@every_kind
def test_default_scene_has_fibres_walls_core_air_and_tension(kind):
    scenario = Scenario(kind)
    scene = scenario.scene()
    assert len(scene.rods) == 5
    assert all(rod.length == 0.04 for rod in scene.rods)
    walls = [contact for contact in scene.contacts if isinstance(contact, Contact)]
    assert len(walls) == {"lateral": 2, "intermediate": 2, "lateral_steep": 3}[kind] + 1
    assert [wall.friction for wall in walls[:-1]] == [Coulomb(0.64)] * (len(walls) - 1)
    assert walls[-1].friction == Coulomb(0.3)
    assert scene.contacts[-1] == RodContact(Penalty.tight(), Coulomb(0.3))
    assert [load.force for load in scene.loads] == [(1e-4, 0.0, 0.0)] * 5
    assert all(isinstance(support, Clamp) for support in scene.supports)
    assert scene.air is not None
    assert scene.air.field.bottom == scenario.section.bottom


@every_kind
def test_edge_fibre_lies_on_the_left_and_noise_is_of_its_size(kind):
    bundle = Bundle()
    starts = bundle.starts(200, 3, kind)
    assert (np.diff(starts[:, 1]) < 0.0).all()
    noise = starts - replace(bundle, noise=0.0).starts(200, 3, kind)
    # Four standard deviations of that of 400 draws.
    assert noise.std() == pytest.approx(1e-6, rel=4 / np.sqrt(800))


def test_a_seed_is_one_bundle_whatever_is_added_to_it():
    bundle = Bundle()
    assert np.array_equal(bundle.starts(5, 1, "lateral"), bundle.starts(5, 1, "lateral"))
    assert not np.array_equal(bundle.starts(5, 1, "lateral"), bundle.starts(5, 2, "lateral"))
    few, more = bundle.starts(5, 1, "lateral"), bundle.starts(9, 1, "lateral")
    shift = more[:5, 1] - few[:, 1]
    assert more[:5, 0] == pytest.approx(few[:, 0], abs=1e-18)
    assert shift == pytest.approx(np.full(5, shift[0]), abs=1e-15)


@every_kind
def test_mirrored_scene_is_built_with_left_and_right_exchanged(kind):
    scenario = Scenario(kind, air=LineSink(backward=1.0))
    scene, image = scenario.scene(), variant(scenario, "mirrored").scene()
    flip = np.array([1.0, 1.0, -1.0])
    for rod, other in zip(scene.rods, image.rods, strict=True):
        assert np.array_equal(rod.centerline([0.0, 0.04]) * flip, other.centerline([0.0, 0.04]))
    x = np.random.default_rng(0).uniform(-1e-3, 1e-3, (50, 3)) + np.array([0.02, 0.5e-3, 0.0])
    u, v = (each.air.field(y, 1.0) for each, y in ((scene, x), (image, x * flip)))
    assert u * flip == pytest.approx(v, abs=1e-13)
    walls, others = ([c.surface for c in each.contacts if isinstance(c, Contact)] for each in (scene, image))
    gap, mirrored = (
        np.min([surface.closest(y).distance for surface in surfaces], axis=0)
        for surfaces, y in ((walls, x), (others, x * flip))
    )
    assert gap == pytest.approx(mirrored, abs=1e-15)


@every_kind
@pytest.mark.parametrize("name", VARIANTS)
def test_every_variant_makes_a_scene(kind, name):
    assert variant(Scenario(kind), name).scene() != Scenario(kind).scene() or name == "L1"


def test_variants_change_what_they_say():
    base = Scenario()
    L0, L2 = variant(base, "L0"), variant(base, "L2")
    assert L0.wall_friction == Coulomb(0.64, at="centreline")
    assert variant(L0, "L1") == base
    rolling = L2.scene().rods[-1]
    assert len(L2.scene().rods) == 6
    assert rolling.section.radius == 0.08e-3
    assert rolling.section.rhoA == pytest.approx(52 * base.bundle.section.rhoA)
    assert L2.law.eps_N == pytest.approx(52 * base.law.eps_N)
    assert L2.law.g_0 == base.law.g_0
    assert variant(L2, "L2") == L2
    assert variant(L2, "L1") == base
    damped = variant(base, "damped")
    # A fibre that strikes a wall has half τ √(ε_N/ρA) = 1; so has a core of 52 on contact 52 times as stiff.
    assert damped.law.damping == pytest.approx(2.0 * np.sqrt(base.bundle.section.rhoA / base.law.eps_N))
    assert variant(damped, "L2") == variant(L2, "damped")
    assert variant(damped, "damped") == damped
    pinned = [s for s in variant(base, "pinned").scene().supports if isinstance(s, Guide)]
    assert [s.free for s in pinned] == [frozenset({"x", "rx", "ry", "rz"})] * 5
    trailing = variant(base, "S-trailing").scene()
    assert [s.rod for s in trailing.supports if isinstance(s, Clamp)] == [0, 1, 2, 3]
    assert [s.free for s in trailing.supports if s.rod == 4] == [frozenset({"y", "z", "rx", "ry", "rz"})]
    assert [load.rod for load in variant(base, "S-leading").scene().loads] == [0, 1, 2, 3]
    moving = variant(base, "transport").scene()
    # 7000 r/min at 680 turns/m, the design notes' 0.17157 m/s.
    assert moving.velocities[0].v[0] == pytest.approx(0.17157, abs=5e-6)
    assert moving.contacts[0].surface.motion.velocity == moving.velocities[0].v
    assert all(isinstance(s, Prescribed) for s in moving.supports)


def test_the_core_that_rolls_stays_straight():
    core, bundle = RollingCore(), Bundle()
    section = core.rod(CrossSection(), "lateral", bundle, 1e-6, mirrored=False).section
    # Sway of a beam between ends that stay parallel, under 1 N/m times its length.
    assert 0.04 * bundle.length**3 / (12.0 * section.EI[0]) == pytest.approx(1e-6 * core.radius)
    assert section.rhoI[0] == pytest.approx(0.5 * section.rhoA * core.radius**2)


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize(("reading", "c"), [("SI", 2e4), ("mm_mN", 2e7), ("mm_N", 2e10)])
def test_the_paper_as_printed(reading, c, mesh):
    scenario = Scenario.paper(reading, mesh)
    scene = scenario.scene()
    assert READINGS[reading].eps_N == c
    assert scenario.elements == 200
    assert scene.rods[0].length == {"long": 0.1, "zone": 0.04}[mesh]
    assert scene.rods[2].centerline([scenario.bundle.tail])[0] == pytest.approx([0.0, 0.0, -1e-3], abs=1e-18)
    assert scene.air is None
    assert all(isinstance(contact.friction, CreepingCoulomb) for contact in scene.contacts)


@every_kind
def test_no_fibre_of_the_paper_begins_in_a_wall(kind):
    scene = Scenario.paper(kind=kind).scene()
    x = np.concatenate([rod.centerline([0.0, 0.04]) for rod in scene.rods])
    assert min(contact.surface.closest(x).distance.min() for contact in scene.contacts) > 1e-5


def test_a_scenario_is_told_from_any_other_by_its_key():
    base = Scenario()
    others = [variant(base, name) for name in VARIANTS if name != "L1"]
    others += [varied(base, "ends.tension", 2e-4), varied(base, "groove.beta_left", 0.3), replace(base, seed=1)]
    names = {key(each, "discrete", None) for each in (base, *others)}
    assert len(names) == len(others) + 1
    assert key(Scenario(), "discrete", None) == key(base, "discrete", None)
    assert key(base, "continuum", None) != key(base, "discrete", 40)
    assert json.loads(json.dumps(described(base)))["bundle"]["section"]["radius"] == 1e-5


def test_gathering_ends_at_rest_unless_ends_move():
    assert Scenario().scene().motion.rest == 0.3
    assert Scenario(rest=None).scene().motion.rest is None
    assert Scenario(ends=Ends(speed=0.17)).scene().motion.rest is None
    with pytest.raises(SceneError, match=r"Scenario\.rest must lie between 1e-06 and 100 m/s"):
        Scenario(rest=0.0)
