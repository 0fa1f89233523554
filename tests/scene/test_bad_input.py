"""Wrong input and the words that answer it: every row is a mistake somebody makes."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import inf, nan

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import discrete
import dolfinrod as dr
from dolfinrod.scene import SceneError, toml
from tests.scenes import COMPLETE

SECTION = dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0)
ROD = dr.Rod.straight(1.0, SECTION)
CLAMP = dr.Clamp("start")
UP = (0, 0, 1)
PUSH = dr.PointForce(UP, "end")
CANTILEVER = dr.Scene([ROD], [CLAMP], [PUSH])


def section(**changes: object) -> Callable[[], object]:
    return lambda: dr.Section(**{"EA": 1.0, "GA": 1.0, "GJ": 1.0, "EI": 1.0, **changes})


def circle(**changes: object) -> Callable[[], object]:
    return lambda: dr.Section.circle(**{"diameter": 1.0, "E": 1.0, "G": 1.0, **changes})


def rectangle(**changes: object) -> Callable[[], object]:
    return lambda: dr.Section.rectangle(**{"width": 1.0, "height": 1.0, "E": 1.0, "G": 1.0, **changes})


def straight(**changes: object) -> Callable[[], object]:
    return lambda: dr.Rod.straight(**{"length": 1.0, "section": SECTION, **changes})


def arc(**changes: object) -> Callable[[], object]:
    return lambda: dr.Rod.arc(**{"radius": 1.0, "angle": 1.0, "section": SECTION, **changes})


def curved(*curvature: object) -> Callable[[], object]:
    return lambda: dr.Rod.curved(1.0, SECTION, curvature)


def through(*points: object, **changes: object) -> Callable[[], object]:
    return lambda: dr.Rod.through(points, SECTION, **changes)


def force(**changes: object) -> Callable[[], object]:
    return lambda: dr.PointForce(**{"force": UP, "at": "end", **changes})


def scene(*, supports: object = (CLAMP,), **changes: object) -> Callable[[], object]:
    return lambda: dr.Scene(**{"rods": [ROD], "supports": supports, **changes})


def file(old: str, new: str) -> Callable[[], object]:
    assert old in COMPLETE
    return lambda: toml.loads(COMPLETE.replace(old, new))


def continuum(**options: object) -> Callable[[], object]:
    return lambda: dr.solve(CANTILEVER, **options)


def springs(**options: object) -> Callable[[], object]:
    return lambda: discrete.solve(CANTILEVER, **options)


NUMBERS = [
    (section(EA=-1.0), "Section.EA must be positive, got -1.0 N"),
    (section(EA=None), "Section.EA is missing"),
    (dr.Section, "Section.EA is missing, and so are GA and GJ and EI"),
    (lambda: dr.Section(rigid={"shear", "extension"}, EI=1.0), "Section.GJ is missing"),
    (lambda: dr.Section(EA=1.0, GA=1.0, GJ=1.0), "Section.EI is missing"),
    (dr.Section.circle, "Section.diameter is missing, and so are E and G"),
    (lambda: dr.Section.rectangle(width=1.0, height=1.0, E=1.0), "Section.G is missing"),
    (section(EA=10**5000), "Section.EA must be a finite number [N], got more digits than can be written N"),
    (section(EI=[10**5000] * 3), "Section.EI must have 2 entries [N m²], got more digits than can be written"),
    (section(GA=0.0), "Section.GA must be positive, got 0.0 N"),
    (section(GA=(1.0, nan)), "Section.GA[1] must be a finite number [N], got nan N"),
    (section(GA=(1.0, 1.0, 1.0)), "Section.GA must have 2 entries [N], got (1.0, 1.0, 1.0)"),
    (section(GJ=inf), "Section.GJ must be a finite number [N m²], got inf N m²"),
    (section(GJ=10**400), "Section.GJ must be a finite number [N m²], got 1000"),
    (section(EI="1"), "Section.EI must have 2 entries [N m²], got '1'"),
    (section(EI=np.array(1.0)), "Section.EI must have 2 entries [N m²], got array(1.)"),
    (section(EI={1.0, 2.0}), "Section.EI must have 2 entries [N m²], got {1.0, 2.0}"),
    (section(rhoA=0.0), "Section.rhoA must be positive, got 0.0 kg/m"),
    (section(rhoI=(1, 1, -1)), "Section.rhoI[2] must not be negative, got -1.0 kg m"),
    (section(radius=-inf), "Section.radius must be a finite number [m], got -inf m"),
    (section(damping=-1.0), "Section.damping must not be negative, got -1.0 s"),
    (section(damping=inf), "Section.damping must be a finite number [s], got inf s"),
    (section(rigid="bending"), "Section.rigid must be a set of names out of shear, extension, got 'bending'"),
    (section(rigid=np.array([["shear"]])), "Section.rigid must be a set of names out of shear, extension"),
    (circle(diameter=nan), "Section.diameter must be a finite number [m], got nan m"),
    (circle(diameter=1e200), "Section.EA must be a finite number [N], got inf N"),
    (circle(diameter=1e-100), "Section.GJ must be positive, got 0.0 N m²"),
    (circle(E=True), "Section.E must be a finite number [Pa], got True"),
    (circle(G=-1), "Section.G must be positive, got -1.0 Pa"),
    (circle(density=0), "Section.density must be positive, got 0.0 kg/m³"),
    (circle(shear_factor=0), "Section.shear_factor must be positive, got 0.0"),
    (rectangle(width=0), "Section.width must be positive, got 0.0 m"),
    (rectangle(height=1e200), "Section.EI[0] must be a finite number [N m²], got inf N m²"),
    (rectangle(torsion="thin"), 'Section.torsion must be "st_venant" or "polar", got \'thin\''),
    (rectangle(torsion=np.array(["a", "b"])), 'Section.torsion must be "st_venant" or "polar", got array('),
    (lambda: dr.Static(steps=0), "Static.steps must be a whole number of at least 1, got 0"),
    (lambda: dr.Static(steps=2.5), "Static.steps must be a whole number of at least 1, got 2.5"),
    (lambda: dr.Static(steps=10**400), "Static.steps must be at most 1000000, got 1000"),
    (lambda: dr.Static(steps=10**5000), "Static.steps must be at most 1000000, got more digits than can be written"),
    (lambda: dr.Static(t_end=1e308), "Static.t_end must lie between 1e-100 and 1e+100, got 1e+308"),
    (lambda: dr.Static(t_end=5e-324), "Static.t_end must lie between 1e-100 and 1e+100, got 5e-324"),
    (lambda: dr.Static(t_end=0), "Static.t_end must be positive, got 0.0"),
    (lambda: dr.Static(t_end=nan), "Static.t_end must be a finite number, got nan"),
    (lambda: dr.Planar(normal=(0, 0, 0)), "Planar.normal must point somewhere"),
    (lambda: dr.Planar(normal=(0, nan, 1)), "Planar.normal[1] must be a finite number, got nan"),
]
RODS = [
    (straight(length=-1), "Rod.length must be positive, got -1.0 m"),
    (straight(length="1 m"), "Rod.length must be a finite number [m], got '1 m'"),
    (straight(section=1.0), "Rod.section must be a Section, got 1.0"),
    (straight(start=(0, 0, inf)), "Rod.start[2] must be a finite number [m], got inf m"),
    (straight(direction=(0, 0)), "Rod.direction must have 3 entries, got (0, 0)"),
    (straight(direction=(0, 0, 0)), "Rod.direction must point somewhere"),
    (straight(d2=(-1, 0, 0)), "Rod.d2 must not be along the rod, got (-1, 0, 0)"),
    (straight(pretwist=nan), "Rod.pretwist must be a finite number [rad/m], got nan rad/m"),
    (arc(radius=0), "Rod.radius must be positive, got 0.0 m"),
    (arc(radius=1e-320), "Rod.curvature[2] must be a finite number [1/m], got inf 1/m"),
    (arc(angle=-1), "Rod.angle must be positive, got -1.0 rad"),
    (arc(radius=1e300, angle=1e300), "Rod.length must be a finite number [m], got inf m"),
    (curved(0, nan, 0), "Rod.curvature[1] must be a finite number [1/m], got nan 1/m"),
    (curved(0, 1), "Rod.curvature must have 3 entries [1/m], got (0, 1)"),
    (through(), "Rod.points must be at least two points [m], got ()"),
    (through(*[(i, 0, 0) for i in range(10_001)]), "Rod.points must be at most 10000, got 10001"),
    (through((0, 0, 0), (0, 0)), "Rod.points[1] must have 3 entries [m], got (0, 0)"),
    (through((0, 0, 0), (0, 0, 0)), "Rod.points[1] must lie apart from the point before"),
    (through((0, 0, 0), (1, 0, 0), d2=(nan, 0, 0)), "Rod.d2[0] must be a finite number, got nan"),
    (lambda: dr.Rod("line", SECTION), "Rod.shape must be a framed curve, such as Rod.straight makes, got 'line'"),
]
PARTS = [
    (force(force=None), "PointForce.force must have 3 entries [N], got None"),
    (force(force=np.array(1.0)), "PointForce.force must have 3 entries [N], got array(1.)"),
    (force(force=np.eye(3)), "PointForce.force[0] must be a finite number [N], got array([1., 0., 0.])"),
    (force(force={1, 2, 3}), "PointForce.force must have 3 entries [N], got {1, 2, 3}"),
    (force(at="middle"), 'PointForce.at must be "start", "end" or an arc length [m], got \'middle\''),
    (force(at=-0.1), "PointForce.at must not be negative, got -0.1 m"),
    (force(at=np.array([0.0, 1.0])), "PointForce.at must be a finite number [m], got array([0., 1.])"),
    (force(rod=-1), "PointForce.rod must be the number of a rod (0, 1, …) or None for every rod, got -1"),
    (force(rod=1.0), "PointForce.rod must be the number of a rod (0, 1, …) or None for every rod, got 1.0"),
    (force(history="ramp"), "PointForce.history must be None, Steady(), rows (t, factor) or a function of t"),
    (force(history=[1, 2]), "PointForce.history[0] must have 2 entries, got 1"),
    (force(history=[(0, 0), (0, 1)]), "PointForce.history[1][0] must be later than 0.0, the row before, got 0.0"),
    (force(history=[(0, nan)]), "PointForce.history[0][1] must be a finite number, got nan"),
    (lambda: dr.PointMoment((0, 0, inf), "end"), "PointMoment.moment[2] must be a finite number [N m], got inf N m"),
    (lambda: dr.FollowerForce((0, 0), "end"), "FollowerForce.force must have 3 entries [N], got (0, 0)"),
    (lambda: dr.FollowerMoment("xyz", "end"), "FollowerMoment.moment must have 3 entries [N m], got 'xyz'"),
    (lambda: dr.LineForce(UP, between=(0.5, 0.5)), "LineForce.between must ascend, got (0.5, 0.5) m"),
    (lambda: dr.LineForce((nan, 0, 0)), "LineForce.force[0] must be a finite number [N/m], got nan N/m"),
    (lambda: dr.Gravity(-9.81), "Gravity.g must have 3 entries [m/s²], got -9.81"),
    (lambda: dr.Clamp(None), "Clamp.at must be a finite number [m], got None"),
    (lambda: dr.Pin(nan), "Pin.at must be a finite number [m], got nan m"),
    (lambda: dr.Guide("end", free={"w"}), "Guide.free must be a set of names out of x, y, z, rx, ry, rz, got {'w'}"),
    (lambda: dr.Guide("end", free={"x", "y", "z", "rx", "ry", "rz"}), "Guide.free must leave something held"),
    (lambda: dr.Prescribed("end"), "Prescribed must have a displacement component or a rotation, got neither"),
    (lambda: dr.Prescribed("end", (0, inf, None)), "Prescribed.displacement[1] must be a finite number [m], got inf m"),
    (lambda: dr.Prescribed("end", rotation=90), "Prescribed.rotation must have 3 entries [rad], got 90"),
]
SCENES = [
    (scene(rods=[]), "rods must hold at least one rod, got none"),
    (scene(rods=[ROD] * 10_001), "rods must be at most 10000, got 10001"),
    (scene(loads=[PUSH] * 10_001), "loads must be at most 10000, got 10001"),
    (
        scene(rods=[ROD] * 1001, loads=[PUSH] * 1000),
        "supports and loads must be at no more than 1000000 places of all rods, got 1002001",
    ),
    (scene(rods=ROD), "rods must be a tuple, got Rod("),
    (scene(supports=[PUSH]), "supports[0] must be one of Clamp, Pin, Guide, Prescribed, got PointForce("),
    (scene(loads=[CLAMP]), "loads[0] must be one of PointForce, PointMoment"),
    (scene(motion="static"), "motion must be Static or Dynamic, got 'static'"),
    (scene(loads=[dr.Gravity((0, 0, -9.81))]), "rods[0].section.rhoA must be given [kg/m], since loads[0] is Gravity"),
    (scene(loads=[dr.PointForce(UP, 1.1)]), "loads[0].at must lie on rod 0, between 0 and 1.0 m, got 1.1 m"),
    (scene(loads=[dr.LineForce(UP, (0, 2))]), "loads[0].between[1] must lie on rod 0, between 0 and 1.0 m, got 2.0 m"),
    (scene(loads=[dr.LineForce(UP, rod=3)]), "loads[0].rod must be below 1, the number of rods, got 3"),
    (scene(supports=[dr.Pin("end", rod=1)]), "supports[0].rod must be below 1, the number of rods, got 1"),
    (scene(supports=[CLAMP, CLAMP]), "supports[1] must not hold rx, ry, rz, x, y, z again at s = 0.0 m of rod 0"),
    (scene(supports=[CLAMP, dr.Prescribed(0.0, (0, 1, None))]), "supports[1] must not hold x, y again at s = 0.0 m"),
    (scene(supports=[dr.Prescribed(1.0, (0, 1, None)), dr.Pin("end")]), "supports[1] must not hold x, y again at"),
    (scene(supports=[dr.Pin(0.3 * 3), dr.Pin(0.9)]), "supports[1] must not hold x, y, z again at s = 0.9"),
    (
        scene(supports=[dr.Pin(0), dr.Guide(0, free={"x"})]),
        "supports[1] must not hold y, z again at s = 0.0 m of rod 0",
    ),
]
FILES = [
    (file("diameter", "diametre"), "section.ramie.circle.diametre is unknown; known are diameter"),
    (file("diameter", "diametre"), "known are diameter, E, G, density, shear_factor, rigid, damping; did you"),
    (file("point_force", "pointForce"), "loads[0].pointForce is unknown; known are point_force, point_moment, "),
    (file("point_force", "pointForce"), "; did you mean point_force?"),
    (
        file("[[rods]]", "[[rod]]"),
        "rod is unknown; known are section, rods, supports, loads, contacts, air, motion, velocities, solve; did you",
    ),
    (file('"ramie"\n', '"Ramie"\n'), "must be the name of a section (ramie), got 'Ramie'; did you mean ramie?"),
    (
        file("E = ", "e = "),
        "section.ramie.circle.e is unknown; known are diameter, E, G, density, shear_factor, rigid, damping; ",
    ),
    (file("elements", "element"), "solve.element is unknown; known are elements, degree, kinematics; did you mean el"),
    (file("elements = 16", "elements = 0"), "solve.elements must be a whole number of at least 1, got 0"),
    (file("elements = 16", "elements = true"), "solve.elements must be a whole number of at least 1, got True"),
    (file("elements = 16", "elements = 1e1"), "solve.elements must be a whole number of at least 1, got 10.0"),
    (file("elements = 16", "elements = 1000001"), "solve.elements must be at most 1000000, got 1000001"),
    (file("elements = 16", "elements = [4, 4]"), "solve.elements must be one number or one for each of the 1 rods"),
    (file("elements = 16", 'elements = ["4"]'), "solve.elements[0] must be a whole number of at least 1, got '4'"),
    (file("degree = 3", "degree = 6"), "solve.degree must be at most 5, got 6"),
    (file("degree = 3", 'degree = "3"'), "solve.degree must be a whole number of at least 1, got '3'"),
    (file("degree = 3", 'kinematics = ["planar"]'), "solve.kinematics must be planar or spatial, got ['planar']"),
    (file("[solve]", "[[solve]]"), "solve must be a table, got [{"),
    (file("[motion.static]", f"[motion.static]\nsteps = 1{'0' * 400}"), "motion.static.steps must be at most 1000000"),
    (file(".circle", ".hexagon"), "section.ramie.hexagon is unknown"),
    (file('"ramie"\n', '"flax"\n'), "rods[0].section must be the name of a section (ramie), got 'flax'"),
    (file('"20 um"', '"20 smoots"'), "diameter must be a quantity in m, got '20 smoots': there is no unit 'smoots'"),
    (file('"40 mm"', '"40 kg"'), "rods[0].straight.length must be a quantity in m, got '40 kg'"),
    (file('"20 um"', "1" + "0" * 400), "section.ramie.circle.diameter must be a finite number [m], got 1000"),
    (file('"20 um"', '"1 m/0"'), "section.ramie.circle.diameter must be a quantity in m, got '1 m/0'"),
    (file("cN/tex", "cN/tex**9**9**9**9"), "circle.E must be a quantity in Pa, got '2224.6 cN/tex**9**9**9**9'"),
    (
        file('"20 um"', f'"1 {"(" * 999}m{")" * 999}"'),
        "section.ramie.circle.diameter must be a quantity in m, got '1 ((",
    ),
    (file('"-1 uN"', "1979-05-27"), "point_force.force[1] must be a quantity in N, got datetime.date(1979, 5, 27)"),
    (file('at = "end"', "at = {}"), 'point_force.at must be "start", "end" or a length, got {}'),
    (file('at = "end"', 'at = "end", rod = 1'), "loads[0].rod must be below 1, the number of rods, got 1"),
    (file("[motion.static]", '[motion]\n"" = 1'), 'motion."" is unknown; known are static'),
    (file("[motion.static]", "[[motion]]"), "motion must be a table, got [{}]"),
    (file("clamp = {", "pin = { at = 0 }\nclamp = {"), "supports[0] must be one of clamp, pin"),
]
OPTIONS = [
    (continuum(elements=0), "elements must be a whole number of at least 1, got 0"),
    (continuum(elements=10**9), "elements must be at most 1000000, got 1000000000"),
    (springs(elements=10**9), "elements must be at most 1000000, got 1000000000"),
    (continuum(elements=2.5), "elements must be a whole number of at least 1, got 2.5"),
    (continuum(elements="8"), "elements must be a whole number of at least 1, got '8'"),
    (continuum(elements=[4, 4]), "elements must be one number or one for each of the 1 rods, got [4, 4]"),
    (continuum(degree=0), "degree must be 1, 2, 3, 4 or 5, got 0"),
    (continuum(degree="3"), "degree must be 1, 2, 3, 4 or 5, got '3'"),
    (continuum(degree=True), "degree must be 1, 2, 3, 4 or 5, got True"),
    (continuum(degree=3.0), "degree must be 1, 2, 3, 4 or 5, got 3.0"),
    (continuum(kinematics="planar"), "kinematics must be Planar(), Spatial() or None, got 'planar'"),
    (continuum(kinematics=dr.Planar), "kinematics must be Planar(), Spatial() or None, got <class"),
    (continuum(kinematics=dr.Planar(normal=UP)), "kinematics cannot be Planar(normal=(0.0, 0.0, 1.0)): loads[0]"),
    (
        lambda: dr.solve(CANTILEVER, elements=2, start=dr.solve(CANTILEVER, elements=3)),
        "start must be a result on the same elements, degree and kinematics",
    ),
    (springs(elements=-1), "elements must be a whole number of at least 1, got -1"),
    (springs(elements=[True]), "elements[0] must be a whole number of at least 1, got True"),
    (springs(elements=[]), "elements must be one number or one for each of the 1 rods, got []"),
    (springs(axial="cable"), 'axial must be "chord" or "paper", got \'cable\''),
    (springs(frame="node"), 'frame must be "element" or "node_i", got \'node\''),
    (
        lambda: discrete.solve(CANTILEVER, elements=2, start=discrete.solve(CANTILEVER, elements=3)),
        "start must be a result of the discrete model, with equilibrium, on the same elements",
    ),
]


@pytest.mark.parametrize(("make", "words"), [*NUMBERS, *RODS, *PARTS, *SCENES, *FILES, *OPTIONS])
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], words: str) -> None:
    with pytest.raises(SceneError, match=re.escape(words)):
        make()


def test_a_complaint_is_short_whatever_it_quotes() -> None:
    with pytest.raises(SceneError) as caught:
        dr.PointForce([0.0] * 100_000, "end")
    assert str(caught.value).startswith("PointForce.force must have 3 entries [N], got [0.0, 0.0, ")
    assert len(str(caught.value)) < 1100


TOKEN = re.compile(r"\w+|\s+|.")
TOKENS = TOKEN.findall(COMPLETE)
EDITS = st.tuples(
    st.sampled_from(["delete", "duplicate", "swap", "replace"]),
    st.integers(0, len(TOKENS) - 1),
    st.integers(0, len(TOKENS) - 1),
)


def edited(tokens: list[str], edits: list[tuple[str, int, int]]) -> str:
    """The tokens after deleting, doubling, swapping or overwriting some of them."""
    tokens = list(tokens)
    for kind, i, j in edits:
        if kind == "delete":
            tokens[i] = ""
        elif kind == "duplicate":
            tokens[i] *= 2
        elif kind == "swap":
            tokens[i], tokens[j] = tokens[j], tokens[i]
        else:
            tokens[i] = tokens[j]
    return "".join(tokens)


@settings(max_examples=300, deadline=None)
@example(edits=[])
@given(edits=st.lists(EDITS, max_size=6))
def test_whatever_is_typed_is_a_scene_or_is_refused(edits: list[tuple[str, int, int]]) -> None:
    try:
        made, options = toml.loads(edited(TOKENS, edits))
    except SceneError:
        return
    assert isinstance(made, dr.Scene)
    assert isinstance(options, dict)
