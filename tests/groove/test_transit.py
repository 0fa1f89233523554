"""What lies around the gathering: transit and the twist delivered, pressing, the roller, both ends held."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dolfinrod.groove import Bundle, Ends, LineSink, Pressing, Scenario, course, delivery, filmed, measure, variant
from dolfinrod.groove.flow import Flow
from dolfinrod.groove.roller import turned, unrolled, wrapped
from dolfinrod.groove.variants import DELIVERY
from dolfinrod.scene import Air, SceneError

GUST = LineSink(speed=40.0, ramp=0.0)


def brief(kind: str = "lateral", *, steps: int = 10, **changes) -> Scenario:
    """Two fibres that do not touch one another for some steps of 10 µs."""
    given = {"fibres": 2, "air": GUST, "fibres_touch": False, "elements": 8} | changes
    return Scenario(kind, t_end=steps * 1e-5, dt=1e-5, output=1e-5, **given)


@pytest.mark.serial
@pytest.mark.parametrize("model", ["discrete", "continuum"])
def test_on_a_moving_roller_all_happens_as_on_one_at_rest(model):
    # Near the bottom, so that walls are soon touched; air that goes along, since drag is against the air.
    still = brief(bundle=Bundle(height=-2.6e-4, offset=-1e-4), steps=10, fibres=1)
    along = replace(variant(still, "transport"), air=replace(GUST, backward=-DELIVERY))
    result, moved = still.run(model), along.run(model)
    assert course(result, still).walls.max() > 0.0
    way = DELIVERY * result.t[:, None, None] * np.array([1.0, 0.0, 0.0])
    for rod, other in zip(result.rods, moved.rods, strict=True):
        assert np.abs(rod.r - rod.r[0]).max() > 1e-5
        assert np.abs(rod.r + way - other.r).max() <= 1e-9 * 0.04


@pytest.mark.serial
def test_fibres_that_are_let_go_at_A_are_drawn_along_at_the_speed_of_the_machine():
    scenario = variant(brief(), "transit")
    result = scenario.run("discrete")
    for rod in result.rods:
        assert rod.r[:, -1, 0] == pytest.approx(0.04 + DELIVERY * result.t, abs=1e-12)
        # Drag along, of a flow across, shortens none by more than a micrometre.
        assert rod.r[-1, 0, 0] == pytest.approx(DELIVERY * result.t[-1], abs=1e-6)
        assert np.abs(rod.r[-1, 0, 1:] - rod.r[0, 0, 1:]).max() > 1e-5


@settings(max_examples=20)
@given(T=st.floats(-60.0, 60.0), steps=st.integers(2, 30))
def test_a_rigid_helix_in_transit_delivers_its_twist(T, steps):
    scenario = Scenario(fibres=2, ends=Ends(speed=DELIVERY))
    t, s = np.linspace(0.0, 6e-3, steps + 1), np.linspace(0.0, 0.05, 3001)
    rods = []
    for phase in (0.0, np.pi):
        φ = 2.0 * np.pi * T * s + phase
        curve = np.stack([s, 1e-4 * np.cos(φ), 1e-4 * np.sin(φ)], axis=1)
        rods.append(SimpleNamespace(r=curve + DELIVERY * t[:, None, None] * np.array([1.0, 0.0, 0.0])))
    out = delivery(SimpleNamespace(t=t, rods=rods), scenario)
    # Chords of 17 µm instead of the curve.
    assert out.mean == pytest.approx(T, abs=1e-2)
    assert delivery(SimpleNamespace(t=t, rods=rods), scenario, since=t[1] if steps > 2 else 0.0).mean == pytest.approx(
        T, abs=1e-2
    )


def test_nothing_is_delivered_where_nothing_moves_on():
    result = SimpleNamespace(t=np.linspace(0.0, 1e-3, 3), rods=[])
    with pytest.raises(SceneError, match=r"Ends\.speed must be above 0"):
        delivery(result, Scenario(fibres=2))
    with pytest.raises(SceneError, match="since must leave two stored times or more"):
        delivery(result, variant(Scenario(fibres=2), "transit"), since=1e-3)


@settings(max_examples=20)
@given(pressure=st.floats(1.0, 2600.0), x=st.floats(0.0, 0.04), along=st.floats(-0.45e-3, -0.1e-3))
def test_a_fibre_at_rest_on_a_wall_is_pressed_onto_it_by_pressure_times_diameter(pressure, x, along):
    scenario = Scenario(air=LineSink(speed=0.0, ramp=0.0), pressing=Pressing(pressure))
    flow = scenario.scene().air.field
    ramp, d = scenario.section.beta_left, 2.0 * scenario.bundle.radius
    normal = np.array([0.0, np.cos(ramp), np.sin(ramp)])
    foot = np.array([x, scenario.section.bottom[0] - np.tan(ramp) * along, along])
    u = flow(foot + 0.5 * d * normal[None], 1e-3)
    force = Air().drag(u, np.array([[1.0, 0.0, 0.0]]), np.array([d]))
    assert force[0] == pytest.approx(-pressure * d * normal, rel=1e-9, abs=1e-12 * pressure * d)
    above = flow(foot + 1.5001 * d * normal[None], 1e-3)
    assert not above.any()


def test_pressing_ends_at_the_side_of_the_slot_and_is_mirrored_with_the_groove():
    scenario = Scenario(pressing=Pressing(), air=LineSink(ramp=0.0))
    flow, image = scenario.scene().air.field, variant(scenario, "mirrored").scene().air.field
    assert isinstance(flow, Flow)
    rng = np.random.default_rng(0)
    x = np.stack([rng.uniform(0, 0.04, 200), rng.uniform(-4e-4, 2e-4, 200), rng.uniform(-1.4e-3, 1e-4, 200)], axis=1)
    flip = np.array([1.0, 1.0, -1.0])
    assert flow(x, 1.0) * flip == pytest.approx(image(x * flip, 1.0), rel=1e-12, abs=1e-12)
    aside = np.array([[0.0, scenario.section.bottom[0] + 1e-5, -0.51e-3]])
    assert np.array_equal(flow(aside, 1.0), replace(flow, pressing=None)(aside, 1.0))


@settings(max_examples=20)
@given(X=st.floats(-0.05, 0.05), Y=st.floats(-4e-4, 1e-3), R=st.floats(0.02, 1.0))
def test_wrapping_and_unrolling_are_each_other_s_reverse(X, Y, R):
    place = np.array([[X, Y, 1e-4]])
    assert unrolled(wrapped(place, R), R) == pytest.approx(place, abs=1e-14)
    h = 1e-6
    out = np.array([[0.0, h, 0.0]])
    slope = (wrapped(place + out, R) - wrapped(place - out, R)) / (2.0 * h)
    assert turned(np.array([[0.0, 1.0, 0.0]]), place, R) == pytest.approx(slope, abs=1e-8)


@pytest.mark.parametrize("R", [0.025, 0.5])
def test_around_a_roller_fibres_and_walls_are_wrapped(R):
    straight = Scenario(core=None)
    scene, bent = straight.scene(), replace(straight, roller=R).scene()
    for rod, other in zip(scene.rods, bent.rods, strict=True):
        points = wrapped(rod.centerline(np.linspace(0.0, 1.0, 9) * rod.length), R)
        assert other.centerline(np.linspace(0.0, 1.0, 9) * other.length) == pytest.approx(points, abs=1e-15)
    x = np.random.default_rng(1).uniform([0.0, -4e-4, -1.4e-3], [0.04, 2e-4, 1e-4], (50, 3))
    for wall, other in zip(scene.walls, bent.walls, strict=True):
        assert other.surface.closest(wrapped(x, R)).distance == pytest.approx(
            wall.surface.closest(x).distance, abs=1e-15
        )
    assert np.hypot(*bent.loads[0].force[:2]) == pytest.approx(1e-4, rel=1e-12)
    assert bent.loads[0].force[1] < 0.0


@pytest.mark.serial
def test_the_wider_the_roller_the_more_the_groove_is_a_straight_one():
    straight = brief(core=None, ends=Ends(tension=0.0), fibres=1)
    plain = straight.run("discrete").rods[0].r[-1]
    off = []
    for R in (0.25, 0.5):
        scenario = replace(straight, roller=R)
        off.append(np.abs(scenario.unrolled(scenario.run("discrete").rods[0].r[-1]) - plain).max())
    assert off[0] < 1e-4
    assert off[0] / off[1] == pytest.approx(2.0, rel=0.1)


@pytest.mark.serial
def test_what_a_run_stores_lies_in_the_straight_groove():
    """So pictures of a bundle around a roller are of the groove unrolled: it begins where the straight one does."""
    straight = brief(core=None, steps=1)
    bent = replace(straight, roller=0.025)
    film = filmed(bent.run("discrete"), bent)
    assert film["paths"][0] == pytest.approx(np.stack([h.r[0] for h in straight.run("discrete").rods]), abs=1e-12)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, "must be None where there is a core"),
        ({"core": None, "bundle": Bundle(tail=0.01)}, "must be None where fibres have a tail"),
        ({"core": None, "ends": Ends(speed=0.1)}, "must be None where fibres go on along X"),
        ({"core": None, "ends": Ends(exit="held")}, "must be None where B holds fibres"),
    ],
)
def test_what_is_straight_does_not_go_around_a_roller(changes, words):
    with pytest.raises(SceneError, match=rf"Scenario\.roller {words}.*, got 0.025 m"):
        Scenario(roller=0.025, **changes)


def test_pressing_is_part_of_the_air():
    with pytest.raises(SceneError, match=r"Scenario\.pressing must be None where there is no air"):
        Scenario(air=None, pressing=Pressing())
    with pytest.raises(SceneError, match=r"Pressing\.pressure must lie between 0 and 100000 Pa"):
        Pressing(pressure=-1.0)


@pytest.mark.serial
def test_fibres_held_at_both_ends_keep_their_net_winding():
    near = Bundle(pitch=3e-5, height=0.0, offset=-1e-4)
    scenario = variant(brief(fibres_touch=True, bundle=near, steps=6), "pinned")
    result = scenario.run("discrete")
    assert max(np.abs(rod.r[-1] - rod.r[0]).max() for rod in result.rods) > 5e-5
    # Fibres held at different X at B, some micrometres apart, are measured where the first ends.
    assert [measure(result, scenario, i).winding[0, 1] for i in (0, 3, -1)] == pytest.approx([0.0] * 3, abs=1e-4)
    free = replace(scenario, ends=Ends())
    assert abs(measure(free.run("discrete"), free).winding[0, 1]) > 1e-3


@pytest.mark.serial
@pytest.mark.parametrize(
    "names", [("pinned", "transit"), ("S-trailing", "transport"), ("S-leading", "transport"), ("L2", "transit")]
)
def test_variants_that_move_on_can_be_combined_and_solved(names):
    scenario = brief(steps=1)
    for name in names:
        scenario = variant(scenario, name)
    result = scenario.run("discrete")
    drawn = [k for k in range(2) if k + 1 not in scenario.ends.leading]
    way = DELIVERY * 1e-5
    # What is drawn by a tension alone goes a little farther in that time: 0.1 mN stretches 40 mm by 0.4 µm.
    assert [result.rods[k].r[-1, -1, 0] - 0.04 for k in drawn] == pytest.approx([way] * len(drawn), abs=1e-6)
