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
)
solid = {"E": positive, "G": positive, "density": positive, "rigid": st.sets(st.just("shear"))}
sides = st.floats(1e-6, 1e3)
sections = st.one_of(
    bare,
    st.builds(dr.Section.circle, diameter=sides, shear_factor=st.floats(0.1, 1.0), **solid),
    st.builds(
        dr.Section.rectangle, width=sides, height=sides, torsion=st.sampled_from(["st_venant", "polar"]), **solid
    ),
    st.builds(dr.Section.ramie, rigid=st.sets(st.sampled_from(["shear", "extension"]))),
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


def leaves(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of all plain values in nested tables and lists."""
    if isinstance(value, dict | list):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        return [found for key, inner in pairs for found in leaves(inner, (*path, key))]
    return [path]


DATA = tomllib.loads(EVERY_KIND + "[solve]\nelements = [4, 4, 4]\ndegree = 3\nkinematics = 'planar'")


@pytest.mark.parametrize("wrong", [{"a": 1}, "absurd", nan, date(1979, 5, 27), [[[]]], "9 lightyear**9"])
@pytest.mark.parametrize("path", leaves(DATA), ids=str)
def test_whatever_single_field_is_wrong_is_named(path: tuple[Any, ...], wrong: object) -> None:
    data = deepcopy(DATA)
    inner = data
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = wrong
    with pytest.raises(SceneError) as caught:
        loads(tomli_w.dumps(data))
    field = [key for key in path if isinstance(key, str)][-1]
    # The constructor knows the side of an arc as its d2.
    assert {"towards": "d2"}.get(field, field) in re.split(r"[.\[\]]", caught.value.field)


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
            r"^resolve is unknown; known are section, rods, supports, loads, motion, solve",
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
        ("[motion.static]", "[motion.dynamic]", r"motion\.dynamic is unknown; known are static"),
        ("[solve]", "[air]", r"air is unknown"),
    ],
)
def test_a_file_that_cannot_be_is_refused_by_field(old: str, new: str, message: str) -> None:
    assert old in COMPLETE
    with pytest.raises(SceneError, match=message):
        loads(COMPLETE.replace(old, new))
