"""Planar or spatial: the scene decides, wherever its plane lies."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import dolfinrod as dr
from dolfinrod.scene import Load, SceneError, Support, Touch, detect, obstacle

BEAM = dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=(1.0, 2.0), rhoA=1.0)
ROD = dr.Rod.straight(1.0, BEAM)
CLAMP = dr.Clamp("start")
Vector = tuple[float, float, float]
rotations = st.lists(st.floats(-3.0, 3.0), min_size=3, max_size=3).map(Rotation.from_rotvec)


def normal_of(
    *, loads: tuple[Load, ...] = (), supports: tuple[Support, ...] = (CLAMP,), rods: object = (ROD,)
) -> object:
    """Normal of the detected plane; None where the scene is spatial."""
    plane = detect(dr.Scene(tuple(rods), supports, loads))
    return plane.normal if isinstance(plane, dr.Planar) else None


@pytest.mark.parametrize(
    ("load", "normal"),
    [
        (dr.PointForce((0, -1, 0), "end"), (0, 0, 1)),
        (dr.PointForce((1, 0, 2), "end"), (0, 1, 0)),
        (dr.PointForce((1, 0, 0), "end"), (0, 0, 1)),  # along the rod: the plane of d1 and d2
        (dr.PointForce((0, 1, 1), "end"), None),  # no principal axis across it
        (dr.PointMoment((0, 0, 3), "end"), (0, 0, 1)),
        (dr.PointMoment((0, -3, 0), "end"), (0, 1, 0)),
        (dr.PointMoment((1, 0, 0), "end"), None),
        (dr.FollowerForce((1, 2, 0), 0.5), (0, 0, 1)),
        (dr.FollowerForce((1, 0, 2), 0.5), (0, 1, 0)),
        (dr.FollowerForce((0, 1, 2), 0.5), None),
        (dr.FollowerMoment((0, 0, 1), "end"), (0, 0, 1)),
        (dr.FollowerMoment((0, 1, 1), "end"), None),
        (dr.LineForce((0, 1, 0)), (0, 0, 1)),
        (dr.LineForce((0, 1, -1)), None),
        (dr.Gravity((0, 0, -9.81)), (0, 1, 0)),
        (dr.Gravity((0, 9.81, -9.81)), None),
    ],
)
def test_loads_choose_the_plane_of_a_straight_rod(load: Load, normal: Vector | None) -> None:
    assert normal_of(loads=(load,)) == normal


def test_without_loads_the_plane_is_that_of_d1_and_d2_through_the_start() -> None:
    rod = dr.Rod.straight(1.0, BEAM, start=(1, 2, 3), direction=(0, 0, 1), d2=(1, 0, 0))
    assert detect(dr.Scene([rod])) == dr.Planar(normal=(0, 1, 0), origin=(1, 2, 3))


def test_two_loads_that_ask_for_two_planes_make_it_spatial() -> None:
    across, up = dr.PointForce((0, 1, 0), "end"), dr.PointForce((0, 0, 1), "end")
    assert normal_of(loads=(across,)) != normal_of(loads=(up,))
    assert normal_of(loads=(across, up)) is None


@pytest.mark.parametrize(
    ("rod", "normal"),
    [
        (dr.Rod.arc(2.0, 8 * pi, BEAM), (0, 0, 1)),
        (dr.Rod.curved(1.0, BEAM, (0, 1, 0)), (0, 1, 0)),
        (dr.Rod.curved(2 * pi, BEAM, (0, 6, 8)), None),  # a circle whose normal is no principal axis
        (dr.Rod.curved(1.0, BEAM, (1, 0, 1)), None),
        (dr.Rod.straight(1.0, BEAM, pretwist=2 * pi), None),
        (dr.Rod.through([(0, 0, 0), (1, 1, 0), (2, 0, 0), (3, 1, 0)], BEAM), (0, 0, 1)),
        (dr.Rod.through([(0, 0, 0), (1, 0, 1), (2, 0, 0), (3, 0, 1)], BEAM, d2=(0, 1, 0)), (0, 1, 0)),
        (dr.Rod.through([(0, 0, 0), (1, 1, 0), (2, 0, 0), (3, 1, 0)], BEAM, d2=(0, 1, 1)), None),
        (dr.Rod.through([(0, 0, 0), (1, 1, 0), (2, 0, 1e-6), (3, 1, 0)], BEAM), None),
    ],
)
def test_a_shape_is_planar_with_a_principal_axis_across_it(rod: dr.Rod, normal: Vector | None) -> None:
    found = normal_of(rods=(rod,), supports=())
    assert found is None if normal is None else np.allclose(np.abs(found), normal, atol=1e-12)


def test_rods_share_the_plane_or_there_is_none() -> None:
    beside = dr.Rod.straight(1.0, BEAM, start=(0, 1, 0), direction=(0, 1, 0))
    above = dr.Rod.straight(1.0, BEAM, start=(0, 0, 1))
    on_edge = dr.Rod.straight(1.0, BEAM, d2=(0, 0, 1))
    askew = dr.Rod.straight(1.0, BEAM, d2=(0, 1, 1))
    assert normal_of(rods=(ROD, beside)) == (0, 0, 1)
    assert normal_of(rods=(ROD, above)) == (0, 1, 0)
    assert normal_of(rods=(ROD, on_edge)) == (0, 0, 1)
    assert normal_of(rods=(ROD, askew)) is None
    assert normal_of(rods=(ROD, beside, above)) is None


@pytest.mark.parametrize(
    ("support", "normal"),
    [
        (dr.Pin("end"), (0, 0, 1)),
        (dr.Guide("end", free={"x", "rz"}), (0, 0, 1)),
        (dr.Guide("end", free={"z", "rx"}), (0, 0, 1)),
        (dr.Prescribed("end", (-0.1, None, None)), (0, 0, 1)),
        (dr.Prescribed("end", (0, 0, 0.1)), (0, 1, 0)),
        (dr.Prescribed("end", (0, 0.1, 0.1)), None),
        (dr.Prescribed("end", rotation=(0, 0, 7)), (0, 0, 1)),
        (dr.Prescribed("end", rotation=(0, 7, 0)), (0, 1, 0)),
        (dr.Prescribed("end", rotation=(1, 0, 0)), None),
    ],
)
def test_supports_along_the_axes_of_the_plane_keep_it(support: Support, normal: Vector | None) -> None:
    assert normal_of(supports=(CLAMP, support)) == normal


@pytest.mark.parametrize(
    ("support", "planar"),
    [
        (dr.Clamp("end"), True),
        (dr.Pin("end"), True),
        (dr.Guide("end", free={"z", "rz"}), True),
        (dr.Guide("end", free={"x", "y", "rx", "ry"}), True),
        (dr.Guide("end", free={"x"}), False),  # holds y, which pulls out of the plane
        (dr.Guide("end", free={"rx"}), False),  # a hinge that would turn out of the plane
        (dr.Prescribed("end", (None, None, 0.1)), True),
        (dr.Prescribed("end", (0.1, None, None)), False),
    ],
)
def test_supports_along_axes_oblique_to_the_plane_couple_out_of_it(support: Support, planar: bool) -> None:
    # A plane through z at 45° to x and y.
    rod = dr.Rod.straight(1.0, BEAM, direction=(1, 1, 0), d2=(0, 0, 1))
    weight = dr.Gravity((0, 0, -9.81))
    assert (normal_of(rods=(rod,), supports=(CLAMP, support), loads=(weight,)) is not None) == planar


@settings(max_examples=20)
@given(turn=rotations, shift=st.tuples(*[st.floats(-5.0, 5.0)] * 3))
def test_a_plane_turns_with_the_scene(turn: Rotation, shift: Vector) -> None:
    def turned(v: Vector) -> NDArray[np.float64]:
        return turn.apply(v)

    points = np.array([(0, 0, 0), (1, 1, 0), (2, 0, 0), (3, 1, 0)], dtype=float)
    scene = dr.Scene(
        [
            dr.Rod.through(turn.apply(points) + shift, BEAM, d2=turned((0, 0, 1))),
            dr.Rod.arc(1.0, 3.0, BEAM, shift, turned((0, 1, 0)), turned((1, 1, 0))),
        ],
        [CLAMP],
        [
            dr.PointForce(turned((1, -2, 0)), "end"),
            dr.PointMoment(turned((0, 0, 1)), 0.5),
            dr.Gravity(turned((0, -9.81, 0))),
            dr.FollowerForce((1, 1, 0), "end", rod=1),
        ],
    )
    plane = detect(scene)
    assert isinstance(plane, dr.Planar)
    np.testing.assert_allclose(np.abs(turn.inv().apply(plane.normal)), (0, 0, 1), atol=1e-12)
    np.testing.assert_allclose(plane.origin, shift, atol=1e-12)
    tipped = replace(scene, loads=(*scene.loads, dr.PointForce(turned((0, 0, 1e-6)), "end")))
    assert detect(tipped) == dr.Spatial()


def test_obstacles_are_told_in_words() -> None:
    plane = dr.Planar(normal=(0, 0, 1), origin=(0, 0, 0))
    twisted, above = dr.Rod.straight(1.0, BEAM, pretwist=1.0), dr.Rod.straight(1.0, BEAM, start=(0, 0, 1e-6))
    up, lifted = dr.PointForce((0, 0, 1), "end"), dr.Prescribed("end", (None, None, 1.0))
    assert obstacle(dr.Scene([ROD], [CLAMP]), plane) is None
    for rod in (twisted, above):
        words = "rods[1] does not lie in the plane with a principal axis along its normal"
        assert obstacle(dr.Scene([ROD, rod]), plane) == words
    assert obstacle(dr.Scene([ROD], loads=[up]), plane) == "loads[0] acts out of the plane"
    words = "supports[1] couples motion in the plane with motion out of it"
    assert obstacle(dr.Scene([ROD], [CLAMP, lifted]), plane) == words


def test_planes_compare_and_refuse_what_is_none() -> None:
    assert dr.Planar([0, 0, 2], np.zeros(3)) == dr.Planar((0.0, 0.0, 1.0), (0, 0, 0))
    assert dr.Planar() == dr.Planar(None, None)
    with pytest.raises(SceneError, match=r"Planar\.normal must point somewhere, got \(0\.0, 0\.0, 0\.0\)"):
        dr.Planar(normal=(0, 0, 0))
    with pytest.raises(SceneError, match=r"Planar\.origin must have 3 entries \[m\], got \(1, 2\)"):
        dr.Planar(normal=(0, 0, 1), origin=(1, 2))


ROUND = dr.Section.circle(diameter=0.01, E=1e9, G=4e8, density=1e3)


@pytest.mark.parametrize(
    ("velocity", "normal"),
    [
        (dr.Velocity((0, 1, 0)), (0, 0, 1)),
        (dr.Velocity((1, 0, 2)), (0, 1, 0)),
        (dr.Velocity((0, 1, 1)), (0, -1, 1)),
        (dr.Velocity(omega=(0, 0, 3), about=(1, 2, 3)), (0, 0, 1)),
        (dr.Velocity(omega=(0, 2, 0)), (0, 1, 0)),
        (dr.Velocity((0, 1, 0), omega=(0, 2, 0)), None),
        (dr.Velocity(omega=(1, 0, 0)), None),
        (dr.Velocity(lambda r: np.sin(8 * pi * r[:, :1]) * [0.0, 0.0, 1.0]), (0, 1, 0)),
        (dr.Velocity(lambda r: np.sin(8 * pi * r[:, :1]) * [0.0, 1.0, 1e-3]), (0, -1e-3, 1)),
        (dr.Velocity(lambda r: np.stack([0 * r[:, 0], r[:, 0], r[:, 0] ** 2], axis=1)), None),
        (dr.Velocity(lambda r: np.stack([0 * r[:, 0], 1 + r[:, 0], np.sin(8 * pi * r[:, 0])], axis=1)), None),
    ],
)
def test_velocities_at_the_start_choose_the_plane_of_a_round_rod(velocity: dr.Velocity, normal: Vector | None) -> None:
    scene = dr.Scene([dr.Rod.straight(1.0, ROUND)], motion=dr.Dynamic(1.0), velocities=[velocity])
    plane = detect(scene)
    assert isinstance(plane, dr.Planar if normal else dr.Spatial)
    if isinstance(plane, dr.Planar):
        assert abs(np.dot(plane.normal, normal)) == pytest.approx(np.linalg.norm(normal), rel=1e-12)
    else:
        assert obstacle(scene, dr.Planar((0, 0, 1), (0, 0, 0))) == "velocities[0] leads out of the plane"


@pytest.mark.parametrize(
    ("field", "normal"),
    [((0, 1, 0), (0, 0, 1)), ((5, 0, 1), (0, 1, 0)), ((0, 0, 0), (0, 0, 1)), (lambda x, t: t * x, None)],
)
def test_steady_air_keeps_a_plane_and_a_function_promises_none(field: object, normal: Vector | None) -> None:
    scene = dr.Scene([dr.Rod.straight(1.0, ROUND)], motion=dr.Dynamic(1.0), air=dr.Air(field))
    plane = detect(scene)
    assert (np.abs(plane.normal) == normal).all() if isinstance(plane, dr.Planar) else normal is None
    if normal is None:
        assert obstacle(scene, dr.Planar((0, 0, 1), (0, 0, 0))) == "air may flow out of the plane"


FLAT = dr.Planar((0, 0, 1), (0, 0, 0))
ACROSS = {
    "plane": dr.Plane(normal=(1, 2, 0)),
    "core": dr.Cylinder((5, 5, 5), (0, 0, 1), 1.0),
    "tube along the plane": dr.Cylinder((0, 1, 0), (1, 2, 0), 1.0, "inside"),
    "core along the plane": dr.Cylinder((3, 1, 0), (-1, 0, 0), 0.01),
    "groove": dr.Groove.v(0.3, 0.5, 1.0, point=(0, 1, 2), axis=(0, 0, -1), up=(0.6, 0.8, 0), fillet=0.1),
}
ASKEW = {
    "floor": dr.Plane(normal=(0, 0, 1)),
    "slope": dr.Plane(normal=(0, 1, 1e-6)),
    "core": dr.Cylinder((0, 0, 0), (0, 1e-6, 1), 1.0),
    "tube above the plane": dr.Cylinder((0, 1, 1e-6), (1, 2, 0), 1.0, "inside"),
    "groove along the plane": dr.Groove.v(0.3, 0.3, 1.0, fillet=0.1),
    "groove across it": dr.Groove.v(0.3, 0.3, 1.0, axis=(0, 1e-6, 1), up=(0, 1, 0), fillet=0.1),
    "roller": dr.Groove.v(0.3, 0.3, 0.1, axis=(0, 0, 1), up=(0, 1, 0), fillet=0.01, roller=10.0),
}
WITHIN = {
    "shift": dr.WallMotion((1, 2, 0), velocity=(-1, 0, 0)),
    "turn": dr.WallMotion(rotation=(0, 0, 2), spin=(0, 0, -1), about=(3, 2, 1)),
}
WITHOUT = {
    "shift": dr.WallMotion((1, 2, 1e-6)),
    "drift": dr.WallMotion(velocity=(1, 2, 1e-6)),
    "turn": dr.WallMotion(rotation=(1e-6, 0, 1)),
    "spin": dr.WallMotion(spin=(1, 0, 0)),
}


def touching(*surfaces: object, rod: dr.Rod | None = None) -> dr.Scene:
    return dr.Scene([rod or dr.Rod.straight(1.0, ROUND)], contacts=[dr.Contact(surface) for surface in surfaces])


@pytest.mark.parametrize("motion", [None, *WITHIN.values()], ids=["rest", *WITHIN])
@pytest.mark.parametrize("surface", ACROSS.values(), ids=ACROSS)
def test_surfaces_that_a_mirror_leaves_alone_keep_the_plane(surface: object, motion: dr.WallMotion | None) -> None:
    assert obstacle(touching(dr.Plane(normal=(0, 1, 0)), replace(surface, motion=motion)), FLAT) is None


@pytest.mark.parametrize("friction", [dr.Coulomb(0.3), dr.CreepingCoulomb(0.3, 0.1)], ids=["coulomb", "creeping"])
@pytest.mark.parametrize("motion", WITHIN.values(), ids=WITHIN)
@pytest.mark.parametrize("surface", ACROSS.values(), ids=ACROSS)
def test_nothing_pushes_points_out_of_a_plane_that_is_kept(surface: object, motion: object, friction: object) -> None:
    rng = np.random.default_rng(1)
    contact = dr.Contact(replace(surface, motion=motion), dr.Penalty(1e3, g_0=10.0), friction)
    touch = Touch(contact, np.full(30, 0.1), dr.Static())
    x, move, turn = rng.normal(size=(3, 30, 3)) * np.array([[[3, 3, 0]], [[0.1, 0.1, 0]], [[0, 0, 0.3]]])
    touch.place(x, 0.0)
    touch.begin(0.1)
    reply = touch.respond(x + move, turn)
    assert reply.traction.any()
    np.testing.assert_allclose(reply.force[:, 2], 0.0, atol=1e-12 * np.abs(reply.force).max())
    np.testing.assert_allclose(reply.moment[:, :2], 0.0, atol=1e-12 * np.abs(reply.force).max())


@pytest.mark.parametrize("surface", ASKEW.values(), ids=ASKEW)
def test_other_surfaces_lead_out_of_it(surface: object) -> None:
    words = "contacts[1] may lead out of the plane"
    assert obstacle(touching(dr.Plane(normal=(0, 1, 0)), surface), FLAT) == words


@pytest.mark.parametrize("motion", WITHOUT.values(), ids=WITHOUT)
def test_so_do_walls_that_move_out_of_it(motion: dr.WallMotion) -> None:
    assert (
        obstacle(touching(dr.Plane(normal=(0, 1, 0), motion=motion)), FLAT) == "contacts[0] may lead out of the plane"
    )


@settings(max_examples=30)
@given(turn=rotations, shift=st.tuples(*[st.floats(-5.0, 5.0)] * 3), name=st.sampled_from(sorted(ACROSS)))
def test_a_round_rod_lives_in_the_plane_of_what_it_touches_wherever_that_lies(
    turn: Rotation, shift: Vector, name: str
) -> None:
    surface = ACROSS[name]
    fields = {"point": turn.apply(surface.point) + shift}
    fields |= {v: turn.apply(getattr(surface, v)) for v in ("normal", "axis", "up") if hasattr(surface, v)}
    # Transverse axes of the section that are those of no plane.
    rod = dr.Rod.straight(1.0, ROUND, shift, turn.apply((1, 0, 0)), d2=turn.apply((0, 1, 0.3)))
    plane = detect(touching(replace(surface, **fields), rod=rod))
    assert isinstance(plane, dr.Planar)
    np.testing.assert_allclose(np.abs(turn.inv().apply(plane.normal)), (0, 0, 1), atol=1e-12)


def test_walls_that_move_choose_the_plane_of_a_round_rod() -> None:
    rod = dr.Rod.straight(1.0, ROUND, d2=(0, 1, 0.3))
    drawn, turned = dr.WallMotion(velocity=(0, 2, 1)), dr.WallMotion(spin=(0, 1, -2))
    for wall in (dr.Plane(normal=(1, 0, 0), motion=drawn), dr.Plane(normal=(1, 0, 0), motion=turned)):
        plane = detect(touching(wall, rod=rod))
        assert isinstance(plane, dr.Planar)
        np.testing.assert_allclose(np.abs(plane.normal), np.abs([0, 1, -2]) / np.sqrt(5), atol=1e-12)
    both = [dr.Plane(normal=(1, 0, 0), motion=motion) for motion in (drawn, dr.WallMotion(velocity=(0, 1, 0)))]
    assert detect(touching(*both, rod=rod)) == dr.Spatial()
