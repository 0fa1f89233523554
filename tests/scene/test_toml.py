"""Scene files: every scene without functions comes back equal; complaints name the field."""

from __future__ import annotations

import re
import tomllib
from copy import deepcopy
from datetime import date
from math import nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.scene import Load, SceneError, Support
from dolfinrod.scene.toml import dumps, load, loads
from tests.scenes import COMPLETE

numbers = st.floats(-1e9, 1e9)
positive = st.floats(1e-12, 1e12)
vectors = st.tuples(numbers, numbers, numbers)
directions = vectors.filter(lambda v: np.linalg.norm(v) > 1e-6)
components = st.none() | numbers
bare = st.builds(
    dr.Section,
    EA=positive,
    GA=st.tuples(positive, positive),
    GJ=positive,
    EI=st.tuples(positive, positive),
    rhoA=positive,
    rhoI=st.none() | st.tuples(positive, positive, positive),
    rigid=st.sets(st.sampled_from(["shear", "extension"])),
    radius=st.none() | positive,
    damping=st.just(0.0) | positive,
)
solid = {
    "E": positive,
    "G": positive,
    "density": positive,
    "rigid": st.sets(st.just("shear")),
    "damping": st.floats(0.0, 1e3),
}
sides = st.floats(1e-6, 1e3)
sections = st.one_of(
    bare,
    st.builds(dr.Section.circle, diameter=sides, shear_factor=st.floats(0.1, 1.0), **solid),
    st.builds(
        dr.Section.rectangle, width=sides, height=sides, torsion=st.sampled_from(["st_venant", "polar"]), **solid
    ),
    st.builds(dr.Section.ramie, rigid=st.sets(st.sampled_from(["shear", "extension"])), damping=positive),
)
knots = st.lists(st.tuples(*[st.integers(-9, 9)] * 2), min_size=2, max_size=5, unique=True)
rods = st.one_of(
    st.builds(dr.Rod.straight, st.just(1.0), sections, vectors, directions, pretwist=numbers),
    st.builds(dr.Rod.curved, positive, sections, vectors, vectors, directions, pretwist=numbers),
    st.builds(dr.Rod.arc, positive, st.floats(0.1, 9.0), sections, vectors, st.just((0, 1, 1)), st.just((0, 0, 2))),
    # Ascending, so that no curve turns back on the spot.
    st.builds(
        lambda p, s, d2: dr.Rod.through([(k + 0.1, *yz) for k, yz in enumerate(p)], s, d2, pretwist=0.1),
        knots,
        sections,
        st.none() | st.sampled_from([(0, 5, 1), (0.1, 5, 1)]),
    ),
)
places = st.sampled_from(["start", "end"]) | st.floats(0.0, 1e-13)
table = st.dictionaries(numbers, numbers, min_size=1, max_size=4).map(lambda rows: sorted(rows.items()))
histories = st.none() | st.just(dr.Steady()) | table
which = st.none() | st.just(0)
forces = {"rod": which, "history": histories}
loads_ = st.one_of(
    [st.builds(kind, vectors, places, **forces) for kind in (dr.PointForce, dr.PointMoment)]
    + [st.builds(kind, vectors, places, **forces) for kind in (dr.FollowerForce, dr.FollowerMoment)]
    + [st.builds(dr.LineForce, vectors, st.none() | st.just((0.0, 1e-13)), **forces)]
    + [st.builds(dr.Gravity, vectors, histories)]
)
supports = st.one_of(
    st.builds(dr.Clamp, places, which),
    st.builds(dr.Pin, places, which),
    st.builds(dr.Guide, places, st.sets(st.sampled_from(["x", "y", "z", "rx", "ry"])), which),
    st.builds(dr.Prescribed, places, st.tuples(components, components, components), vectors, histories, which),
)
motions = st.builds(dr.Static, st.none() | st.integers(1, 99), positive)


@settings(max_examples=30, deadline=None)
@given(rods=st.lists(rods, min_size=1, max_size=3), support=supports, load=st.lists(loads_, max_size=4), motion=motions)
def test_every_scene_comes_back_equal(
    rods: list[dr.Rod], support: Support, load: list[Load], motion: dr.Static
) -> None:
    scene = dr.Scene(rods, [support], load, motion=motion)
    options = {"elements": [4] * len(rods), "degree": 3, "kinematics": "spatial"}
    assert loads(dumps(scene, options)) == (scene, options)


schemes = st.sampled_from([dr.ImplicitEuler(), dr.Midpoint()])
ends = st.floats(1e-9, 1e9)
parts = st.floats(1e-5, 1.0)
output = (
    st.none() | parts | st.sets(st.floats(0.0, 1.0), min_size=1, max_size=4).map(lambda times: tuple(sorted(times)))
)


@st.composite
def dynamics(draw: st.DrawFn) -> dr.Dynamic:
    """Any motion in time: steps of given length or free, stored now and then."""
    t_end, part, stored = draw(ends), draw(st.none() | parts), draw(output)
    stored = tuple(t_end * t for t in stored) if isinstance(stored, tuple) else stored and t_end * stored
    tol = draw(st.none() | st.floats(1e-12, 0.1)) if part is None else None
    return dr.Dynamic(t_end, part and t_end * part, draw(schemes), tol, stored)


flows = st.builds(dr.Air, vectors, positive, positive)
velocities = st.builds(dr.Velocity, vectors, vectors, vectors, which)
round_rods = st.builds(dr.Rod.straight, positive, st.builds(dr.Section.circle, diameter=sides, **solid))


@settings(max_examples=30, deadline=None)
@given(
    rods=st.lists(round_rods, min_size=1, max_size=2),
    motion=dynamics(),
    air=st.none() | flows,
    moved=st.lists(velocities, max_size=2),
)
def test_every_scene_that_moves_comes_back_equal(
    rods: list[dr.Rod], motion: dr.Dynamic, air: dr.Air | None, moved: list[dr.Velocity]
) -> None:
    scene = dr.Scene(rods, motion=motion, air=air, velocities=moved)
    assert loads(dumps(scene)) == (scene, {})


tables = histories | st.just(((0.0, 1.0), (0.5, -2.0)))
moves = st.none() | st.builds(
    lambda displacement, history, velocity, axis, about: dr.WallMotion(
        displacement, axis, history, velocity, 3.0 * np.array(axis), about
    ),
    vectors,
    tables,
    vectors,
    directions,
    vectors,
)
profiles = st.lists(st.tuples(*[st.integers(-9, 9)] * 2), min_size=2, max_size=5, unique_by=lambda p: p[0]).map(sorted)
upright = st.tuples(directions, directions).filter(
    lambda pair: np.linalg.norm(np.cross(*pair)) > 1e-3 * np.linalg.norm(pair[0]) * np.linalg.norm(pair[1])
)
surfaces = st.one_of(
    st.builds(dr.Plane, vectors, directions, moves),
    st.builds(dr.Cylinder, vectors, directions, positive, st.sampled_from(["outside", "inside"]), moves),
    st.builds(
        lambda profile, point, pair, motion: dr.Groove(profile, point, *pair, motion=motion),
        profiles,
        vectors,
        upright,
        moves,
    ).flatmap(lambda groove: st.sampled_from(groove.faces())),
    st.builds(
        lambda roller, fillet: dr.Groove([(-3, 0), (-1, 0), (3, 0)], fillet=fillet, roller=roller),
        st.none() | st.floats(2.0, 1e6),
        st.floats(0.0, 0.1),
    ),
)
laws = st.one_of(
    st.builds(dr.Penalty, positive, numbers, st.just(0.0) | positive),
    st.builds(dr.SmoothPenalty, positive, positive, numbers, st.just(0.0) | positive),
    st.builds(dr.AugmentedLagrangian, positive, positive),
)
frictions = st.one_of(
    st.none(),
    st.builds(dr.Coulomb, st.floats(0.0, 9.0), st.none() | positive),
    st.builds(dr.CreepingCoulomb, st.floats(0.0, 9.0), positive),
)
contacts = st.builds(dr.Contact, surfaces, laws, frictions, which)


@settings(max_examples=50, deadline=None)
@given(rods=st.lists(round_rods, min_size=1, max_size=2), touched=st.lists(contacts, min_size=1, max_size=3))
def test_every_contact_comes_back_equal(rods: list[dr.Rod], touched: list[dr.Contact]) -> None:
    scene = dr.Scene(rods, contacts=touched, motion=dr.Dynamic(1.0))
    assert loads(dumps(scene)) == (scene, {})


def test_the_complete_scene_file_is_the_scene_of_the_python_example() -> None:
    scene, options = loads(COMPLETE)
    ramie = dr.Section.circle(diameter=20e-6, E=34.25884e9, G=1.63548e9, density=1540.0)
    fibre = dr.Rod.straight(length=0.04, section=ramie, start=(0, 0, 0), direction=(1, 0, 0))
    assert scene == dr.Scene((fibre,), (dr.Clamp(at="start"),), (dr.PointForce((0, -1e-6, 0), at="end"),))
    assert options == {"elements": 16, "degree": 3}


def test_files_are_read_as_their_text(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(COMPLETE, encoding="utf-8")
    assert load(file) == load(str(file)) == loads(COMPLETE)
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(SceneError, match=r"a scene must be text in UTF-8"):
        load(file)


EVERY_KIND = """
[section.strip.rectangle]
width = "2 mm"
height = "0.5 mm"
E = "2 GPa"
G = 1e9
density = 1000
torsion = "polar"

[section.bare]
GJ = 1
EI = ["1 N*m**2", 2]
rigid = ["shear", "extension"]
rhoA = "4.84 dtex"

[section.fibre.ramie]

[[rods]]
arc = { radius = "1 m", angle = "90 deg", towards = [0, 0, 1] }
section = "strip"

[[rods]]
curved = { length = 2, curvature = ["0.5 1/m", 0, 0], start = [0, 0, "1 cm"], pretwist = "1 turn/m" }
section = "bare"

[[rods]]
through = { points = [[0, 0, 0], ["1 m", 0, 0], [2, 1, 0]], d2 = [0, 0, 1] }
section = "fibre"

[[supports]]
guide = { at = "end", free = ["x", "rz"], rod = 0 }

[[supports]]
prescribed = { at = "50 cm", displacement = ["1 mm", "free", 0], rotation = [0, 0, "1 turn"], rod = 1 }

[[loads]]
gravity = { g = [0, 0, "-9.81 m/s**2"], history = "steady" }

[[loads]]
follower_moment = { moment = [0, 0, "2 mN*m"], at = "end" }

[[loads]]
line_force = { force = ["1 mN/mm", 0, 0], between = ["10 cm", "20 cm"], history = [[0, 1], [0.5, 2]] }

[motion.static]
steps = 10
t_end = 2
"""


def test_every_kind_reads_as_in_python() -> None:
    scene, options = loads(EVERY_KIND)
    strip = dr.Section.rectangle(width=2e-3, height=5e-4, E=2e9, G=1e9, density=1e3, torsion="polar")
    bare = dr.Section(GJ=1.0, EI=(1.0, 2.0), rigid={"shear", "extension"}, rhoA=4.84e-7)
    assert scene.rods == (
        dr.Rod.arc(1.0, np.pi / 2, strip, towards=(0, 0, 1)),
        dr.Rod.curved(2.0, bare, (0.5, 0, 0), (0, 0, 0.01), pretwist=2 * np.pi),
        dr.Rod.through([(0, 0, 0), (1, 0, 0), (2, 1, 0)], dr.Section.ramie(), d2=(0, 0, 1)),
    )
    assert scene.supports == (
        dr.Guide("end", {"x", "rz"}, rod=0),
        dr.Prescribed(0.5, (1e-3, None, 0.0), (0, 0, 2 * np.pi), rod=1),
    )
    assert scene.loads == (
        dr.Gravity((0, 0, -9.81), history=dr.Steady()),
        dr.FollowerMoment((0, 0, 0.002), "end"),
        dr.LineForce((1.0, 0, 0), (0.1, 0.2), history=((0.0, 1.0), (0.5, 2.0))),
    )
    assert scene.motion == dr.Static(steps=10, t_end=2.0)
    assert options == {}


MOVING = """
[section.fibre.ramie]
damping = "1 ms"

[section.rod.circle]
diameter = "1 cm"
E = "1 GPa"
G = "0.4 GPa"
density = 1000
damping = 0.002

[section.bare]
GJ = 1
EI = 1
rigid = ["shear", "extension"]
rhoA = 1
radius = "1 mm"
damping = "3 us"

[[rods]]
straight = { length = "40 mm" }
section = "fibre"

[[rods]]
straight = { length = 1, start = [0, 1, 0] }
section = "rod"

[[rods]]
straight = { length = 1, start = [0, 2, 0] }
section = "bare"

[[loads]]
gravity = { g = [0, 0, "-9.81 m/s**2"], history = [[0, 0], [0.5, 1]] }

[air]
field = ["1 m/s", "-36 km/hour", 0]
density = "1.2 kg/m**3"
viscosity = "18 uPa*s"

[motion.dynamic]
t_end = "1 s"
dt = "1 ms"
scheme = "midpoint"
output = ["10 ms", 0.5, "1 s"]

[[velocities]]
v = ["1 m/s", 0, 0]
omega = [0, 0, "1 turn/s"]
about = ["1 cm", 0, 0]
rod = 1
"""


def test_a_motion_in_time_reads_as_in_python() -> None:
    scene, _ = loads(MOVING)
    assert [rod.section.damping for rod in scene.rods] == [1e-3, 0.002, pytest.approx(3e-6)]
    assert scene.rods[0].section == dr.Section.ramie(damping=1e-3)
    assert scene.rods[1].section == dr.Section.circle(diameter=0.01, E=1e9, G=4e8, density=1e3, damping=0.002)
    assert scene.air == dr.Air((1.0, -10.0, 0.0), density=1.2, viscosity=18e-6)
    assert scene.motion == dr.Dynamic(1.0, dt=1e-3, scheme=dr.Midpoint(), output=(0.01, 0.5, 1.0))
    assert scene.velocities == (dr.Velocity((1, 0, 0), (0, 0, 2 * np.pi), (0.01, 0, 0), rod=1),)
    regular = MOVING.replace('["10 ms", 0.5, "1 s"]', '"10 ms"').replace(
        'dt = "1 ms"\nscheme = "midpoint"', "tol = 1e-4"
    )
    assert loads(regular)[0].motion == dr.Dynamic(1.0, tol=1e-4, output=0.01)
    bare = MOVING.replace('field = ["1 m/s", "-36 km/hour", 0]\ndensity = "1.2 kg/m**3"\nviscosity = "18 uPa*s"', "")
    assert loads(bare)[0].air == dr.Air()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('t_end = "1 s"\n', "", r"^motion\.dynamic\.t_end is missing$"),
        ('"1 ms"\nscheme', '"1 mm"\nscheme', r"^motion\.dynamic\.dt must be a quantity in s, got '1 mm'"),
        (
            '"1 ms"\nscheme',
            '"1 ns"\nscheme',
            r"^motion\.dynamic\.dt must be at least t_end/1000000 = 1e-06 s, got 1e-09 s",
        ),
        (
            '"midpoint"',
            '"mid point"',
            r'scheme must be "implicit_euler" or "midpoint", got .*; did you mean midpoint\?',
        ),
        ('"midpoint"', "2", r'^motion\.dynamic\.scheme must be "implicit_euler" or "midpoint", got 2$'),
        ('"midpoint"', '"midpoint"\ntol = 0.1', r"^motion\.dynamic\.tol must be left out where dt is given, got 0\.1"),
        ('0.5, "1 s"', '0.5, "1 min"', r"^motion\.dynamic\.output must ascend between 0 and t_end = 1\.0 s, got"),
        ('["10 ms", 0.5, "1 s"]', '"often"', r"^motion\.dynamic\.output must be a quantity in s, got 'often'"),
        ('["1 m/s", "-36', '["1 m", "-36', r"^air\.field\[0\] must be a quantity in m/s, got '1 m'"),
        ('["1 m/s", "-36 km/hour", 0]', '"gusty"', r"^air\.field must be a quantity in m/s, got 'gusty'"),
        ('"1.2 kg/m**3"', '"0 kg/m**3"', r"^air\.density must be positive, got 0\.0 kg/m³"),
        (
            "viscosity",
            "viscous",
            r"^air\.viscous is unknown; known are field, density, viscosity; did you mean viscosity\?",
        ),
        ("[air]", "[[air]]", r"^air must be a table, got \["),
        ("[[velocities]]", "[velocities]", r"^velocities must be a list of tables, written \[\[velocities\]\], got"),
        ("rod = 1", "rod = 3", r"^velocities\[0\]\.rod must be below 3, the number of rods, got 3"),
        ("omega = [0, 0,", "omega = [0,", r"^velocities\[0\]\.omega must have 3 entries \[rad/s\], got"),
        ('damping = "3 us"', 'damping = "-3 us"', r"^section\.bare\.damping must not be negative, got -3"),
        ('damping = "3 us"', 'damping = "3 N"', r"^section\.bare\.damping must be a quantity in s, got '3 N'"),
        ('radius = "1 mm"', "", r"^rods\[2\]\.section\.radius must be given \[m\], since air drags the rod"),
        (
            "[motion.dynamic]",
            "[motion.dynamics]",
            r"^motion\.dynamics is unknown; known are static, dynamic; did you mean",
        ),
    ],
)
def test_a_motion_that_cannot_be_is_refused_by_field(old: str, new: str, message: str) -> None:
    assert old in MOVING
    with pytest.raises(SceneError, match=message):
        loads(MOVING.replace(old, new))


TOUCHING = """
[section.fibre.ramie]

[[rods]]
straight = { length = "40 mm" }
section = "fibre"

[[rods]]
straight = { length = "40 mm", start = [0, "1 mm", 0] }
section = "fibre"

[[contacts]]
cylinder = { point = [0, 0, "-25 mm"], axis = [0, 1, 0], radius = "25 mm", side = "outside" }
law.penalty = { eps_N = "4e5 N/m**2", g_0 = "1 um" }
friction.coulomb = { mu = 0.64, eps_T = "2e5 Pa" }

[[contacts]]
law = "tight"
rod = 1
[contacts.plane]
point = [0, 0, "-1 mm"]
normal = [0, 0, 2]
[contacts.plane.motion]
displacement = [0, 0, "1 mm"]
rotation = [0, "0.5 turn", 0]
history = [[0, 0], [0.5, 1]]
velocity = ["1 mm/s", 0, 0]
spin = [0, "0.1 rad/s", 0]
about = ["2 cm", 0, 0]

[[contacts]]
law.smooth_penalty = { eps_N = "20 kPa", foot = "10 um", g_0 = "75 um" }
friction.creeping_coulomb = { mu = 0.3, v_0 = "1 mm/s" }
[contacts.groove]
profile = [["-6 mm", 0], ["-1.5 mm", 0], [0, "-0.402 mm"], ["1.5 mm", 0], ["6 mm", 0]]
point = [0, 0, "-1 cm"]
axis = [1, 0, 0]
up = [0, 0, 1]
fillet = "0.15 mm"
roller = "25 mm"

[[contacts]]
plane = {}
law.augmented_lagrangian = { eps_N = "4e5 Pa", tolerance = "1 nm" }

[[contacts]]
plane = {}
law = "paper"

[motion.dynamic]
t_end = "1 s"
"""


def test_contacts_read_as_in_python() -> None:
    scene, _ = loads(TOUCHING)
    core = dr.Cylinder((0, 0, -0.025), (0, 1, 0), 0.025)
    pushed = dr.WallMotion((0, 0, 1e-3), (0, np.pi, 0), [(0, 0), (0.5, 1)], (1e-3, 0, 0), (0, 0.1, 0), (0.02, 0, 0))
    profile = [(-6e-3, 0), (-1.5e-3, 0), (0, -0.402e-3), (1.5e-3, 0), (6e-3, 0)]
    groove = dr.Groove(profile, (0, 0, -0.01), (1, 0, 0), (0, 0, 1), fillet=0.15e-3, roller=0.025)
    assert scene.contacts == (
        dr.Contact(core, dr.Penalty(4e5, 1e-6), dr.Coulomb(0.64, 2e5)),
        dr.Contact(dr.Plane((0, 0, -1e-3), (0, 0, 1), pushed), dr.Penalty.tight(), rod=1),
        dr.Contact(groove, dr.SmoothPenalty(2e4, 1e-5, 75e-6), dr.CreepingCoulomb(0.3, 1e-3)),
        dr.Contact(dr.Plane(), dr.AugmentedLagrangian(4e5, 1e-9)),
        dr.Contact(dr.Plane(), dr.Penalty.paper()),
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "cylinder = {",
            "cilinder = {",
            r"^contacts\[0\]\.cilinder is unknown; known are plane, cylinder, groove, rods, law, friction, rod; did",
        ),
        ('point = [0, 0, "-1 mm"]', "at = 0", r"^contacts\[1\]\.plane\.at is unknown; known are point, normal, motion"),
        ("[contacts.groove]", "[contacts.other]", r"^contacts\[2\]\.other is unknown; known are plane, cylinder, gr"),
        ("plane = {}", "", r"^contacts\[3\] must be one of plane, cylinder, groove, rods, got none$"),
        (
            "plane = {}",
            "plane = {}\ncylinder = {}",
            r"^contacts\[3\] must be one of plane, cylinder, groove, rods, got plane, cylinder$",
        ),
        ("plane = {}", "plane = 0", r"^contacts\[3\]\.plane must be a table, got 0$"),
        ('radius = "25 mm", ', "", r"^contacts\[0\]\.cylinder\.radius is missing$"),
        ('"outside"', '"top"', r'^contacts\[0\]\.cylinder\.side must be "outside" or "inside", got \'top\'$'),
        (
            '"4e5 N/m**2"',
            '"4e5 N/m"',
            r"^contacts\[0\]\.law\.penalty\.eps_N must be a quantity in N/m\*\*2, got '4e5 N/m'",
        ),
        ('"4e5 N/m**2"', "0", r"^contacts\[0\]\.law\.penalty\.eps_N must be positive, got 0\.0 N/m²$"),
        (
            '"tight"',
            '"tigth"',
            r"^contacts\[1\]\.law must be .* or a table that names one of penalty, .*'tigth'; did you mean tight\?$",
        ),
        ('"tight"', "4e5", r"^contacts\[1\]\.law must be a table, got 400000\.0$"),
        ("law.penalty", "law.penality", r"^contacts\[0\]\.law\.penality is unknown; .* did you mean penalty\?$"),
        (
            "friction.coulomb",
            "friction.columb",
            r"^contacts\[0\]\.friction\.columb is unknown; .* did you mean coulomb\?$",
        ),
        ("mu = 0.64, ", "", r"^contacts\[0\]\.friction\.coulomb\.mu is missing$"),
        ("mu = 0.64", "mu = -0.64", r"^contacts\[0\]\.friction\.coulomb\.mu must not be negative, got -0\.64$"),
        ("rod = 1", "rod = 2", r"^contacts\[1\]\.rod must be below 2, the number of rods, got 2$"),
        (
            "0.5 turn",
            "0.5 mm",
            r"^contacts\[1\]\.plane\.motion\.rotation\[1\] must be a quantity in rad, got '0\.5 mm'",
        ),
        ("[0, 0, 2]", "[0, 0, 0]", r"^contacts\[1\]\.plane\.normal must not be zero, got"),
        (
            'spin = [0, "0.1 rad/s", 0]',
            "spin = [1, 0, 0]",
            r"^contacts\[1\]\.plane\.motion\.spin must be along rotation",
        ),
        (
            '[motion.dynamic]\nt_end = "1 s"',
            "",
            r"^contacts\[2\]\.friction must not be CreepingCoulomb, since motion is",
        ),
        ("[[contacts]]", "[contacts]", r"^a scene must be a TOML file: "),
    ],
)
def test_a_contact_that_cannot_be_is_refused_by_field(old: str, new: str, message: str) -> None:
    assert old in TOUCHING
    with pytest.raises(SceneError, match=message):
        loads(TOUCHING.replace(old, new, 1))


def leaves(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of all plain values in nested tables and lists."""
    if isinstance(value, dict | list):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        return [found for key, inner in pairs for found in leaves(inner, (*path, key))]
    return [path]


DATA = tomllib.loads(EVERY_KIND + "[solve]\nelements = [4, 4, 4]\ndegree = 3\nkinematics = 'planar'")
TIMES = tomllib.loads(MOVING)
TOUCHED = tomllib.loads(TOUCHING)
EVERY_FIELD = [(data, path) for data in (DATA, TIMES, TOUCHED) for path in leaves(data)]


@pytest.mark.parametrize("wrong", [{"a": 1}, "absurd", nan, date(1979, 5, 27), [[[]]], "9 lightyear**9"])
@pytest.mark.parametrize(("given", "path"), EVERY_FIELD, ids=[str(path) for _, path in EVERY_FIELD])
def test_whatever_single_field_is_wrong_is_named(given: dict[str, Any], path: tuple[Any, ...], wrong: object) -> None:
    data = deepcopy(given)
    inner = data
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = wrong
    with pytest.raises(SceneError) as caught:
        loads(tomli_w.dumps(data))
    field = [key for key in path if isinstance(key, str)][-1]
    # The constructor knows the side of an arc as its d2.
    assert {"towards": "d2"}.get(field, field) in re.split(r"[.\[\]]", caught.value.field)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"air": dr.Air(lambda x, t: t * x)}, "air.field"),
        ({"velocities": [dr.Velocity(), dr.Velocity(np.sin)]}, "velocities[1].v"),
    ],
)
def test_a_flow_that_is_a_function_cannot_be_written(changes: dict[str, Any], field: str) -> None:
    scene = dr.Scene([dr.Rod.straight(1.0, dr.Section.ramie())], motion=dr.Dynamic(1.0), **changes)
    with pytest.raises(SceneError, match="must be a vector to be written to a file, got the function") as caught:
        dumps(scene)
    assert caught.value.field == field


def test_a_function_of_time_cannot_be_written() -> None:
    rod = dr.Rod.straight(1.0, dr.Section.ramie())
    scene = dr.Scene([rod], loads=[dr.Gravity((0, 0, 1)), dr.Gravity((0, 0, 1), history=np.sin)])
    with pytest.raises(SceneError, match=r"loads\[1\]\.gravity\.history must be a table to be written to a file, got"):
        dumps(scene)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[solve]", "[solve", r"a scene must be a TOML file: "),
        (
            "[solve]",
            "[resolve]",
            r"^resolve is unknown; known are section, rods, supports, loads, contacts, air, motion, vel",
        ),
        (
            'at = "end", force',
            'at = "end", farce',
            r"loads\[0\]\.point_force\.farce is unknown; known are force",
        ),
        ('at = "end", ', "", r"loads\[0\]\.point_force\.at is missing"),
        ('"-1 uN"', '"-1 um"', r"loads\[0\]\.point_force\.force\[1\] must be a quantity in N, got '-1 um'"),
        ('"-1 uN"', '"-1 newt"', r"loads\[0\]\.point_force\.force\[1\] .* there is no unit 'newt'"),
        ('"-1 uN"', "nan", r"loads\[0\]\.point_force\.force\[1\] must be a finite number \[N\], got nan N"),
        ('"-1 uN"', "true", r"loads\[0\]\.point_force\.force\[1\] must be a quantity in N, got True"),
        (', "0 N"]', "]", r"loads\[0\]\.point_force\.force must have 3 entries \[N\], got \(0\.0, -1e-06\)"),
        ("point_force", "push", r"loads\[0\]\.push is unknown; known are point_force, point_moment,"),
        ("[[loads]]", "[loads]", r"loads must be a list of tables, written \[\[loads\]\], got"),
        ('at = "start"', 'at = "3 kg"', r"supports\[0\]\.clamp\.at must be \"start\", \"end\" or a length, got '3 kg'"),
        ('clamp = { at = "start" }', "", r"supports\[0\] must be one of clamp, pin, guide, prescribed, got none"),
        ('{ at = "start" }', '"start"', r"supports\[0\]\.clamp must be a table, got 'start'"),
        ('at = "start"', 'at = "41 mm"', r"supports\[0\]\.at must lie on rod 0, between 0 and 0\.04 m, got 0\.041 m"),
        ('"40 mm"', '"-40 mm"', r"rods\[0\]\.straight\.length must be positive, got -0\.04 m"),
        ("[1, 0, 0]", "[0, 0, 0]", r"rods\[0\]\.straight\.direction must point somewhere, got \(0\.0, 0\.0, 0\.0\)"),
        (
            'section = "ramie"',
            'section = "flax"',
            r"rods\[0\]\.section must be the name of a section \(ramie\), got 'flax'",
        ),
        ('section = "ramie"', "", r"rods\[0\]\.section is missing"),
        ('diameter = "20 um"', "", r"section\.ramie\.circle\.diameter is missing"),
        ('"20 um"', '"0 um"', r"section\.ramie\.circle\.diameter must be positive, got 0\.0 m"),
        ('"2224.6 cN/tex"', '"34 kg"', r"section\.ramie\.circle\.E must be a quantity in Pa, got '34 kg'"),
        (
            "density =",
            "shear_factor = 1 #",
            r"section\.ramie\.circle\.density must be given, since E is a modulus per density",
        ),
        (".circle]", "]", r"section\.ramie\.diameter is unknown; known are EA, GA, GJ, EI"),
        (
            "[motion.static]",
            "[motion.static]\nsteps = 0",
            r"motion\.static\.steps must be a whole number of at least 1, got 0",
        ),
        ("[motion.static]", "[motion.dynamic]", r"motion\.dynamic\.t_end is missing"),
        ("[solve]", "[air]", r"air\.elements is unknown; known are field, density, viscosity"),
    ],
)
def test_a_file_that_cannot_be_is_refused_by_field(old: str, new: str, message: str) -> None:
    assert old in COMPLETE
    with pytest.raises(SceneError, match=message):
        loads(COMPLETE.replace(old, new))
