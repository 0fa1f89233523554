"""Bad input line by line of issue 3: the same mistake in Python and in a file, in the same words, exit code 2."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import discrete
import dolfinrod as dr
from dolfinrod import cli
from dolfinrod.scene import SceneError
from tests.conftest import world
from tests.scenes import COMPLETE

RAMIE = dr.Section.ramie()
LIGHT = dr.Section.circle(diameter=1.0, E=1.0, G=1.0)
FIBRE = dr.Rod.straight(0.04, RAMIE)
CLAMP = dr.Clamp("start")
PUSH = dr.PointForce((0, -1e-6, 0), "end")
CLAMP_TEXT = '[[supports]]\nclamp = { at = "start" }\n'
FORCE_TEXT = 'point_force = { at = "end", force = ["0 N", "-1 uN", "0 N"] }'


@dataclass(frozen=True)
class Mistake:
    """One mistake made twice.

    Args:
        python: Makes it in Python.
        old: Text of the complete scene file.
        new: What is written instead.
        words: What both answers say.
    """

    python: Callable[[], object]
    old: str
    new: str
    words: str


def solved(supports: list[object], *loads: object) -> Callable[[], object]:
    return lambda: discrete.solve(dr.Scene([FIBRE], supports, loads), elements=2)


def circle(**changes: object) -> Callable[[], object]:
    return lambda: dr.Section.circle(**{"diameter": 2e-5, "E": 1e9, "G": 1e9, **changes})


def fibre(**changes: object) -> Callable[[], object]:
    return lambda: dr.Rod.straight(**{"length": 0.04, "section": RAMIE, **changes})


def tip_force(force: object, at: object = "end", **changes: object) -> Callable[[], object]:
    return lambda: discrete.solve(dr.Scene([FIBRE], [CLAMP], [dr.PointForce(force, at, **changes)]), elements=2)


def row(name: str, python: Callable[[], object], old: str, new: str, words: str) -> object:
    assert old in COMPLETE
    return pytest.param(Mistake(python, old, new, words), id=name)


UP = (0, 1, 0)
FLOOR = dr.Contact(dr.Plane())
MOTION_TEXT = "[motion.static]"


def touching(**changes: object) -> Callable[[], object]:
    return lambda: dr.Scene([FIBRE], [CLAMP], contacts=[dr.Contact(**{"surface": dr.Plane(), **changes})])


def contact_row(name: str, python: Callable[[], object], table: str, words: str) -> object:
    """A mistake in a contact, which the complete scene file has none of."""
    return row(name, python, MOTION_TEXT, f"[[contacts]]\n{table}\n{MOTION_TEXT}", words)


MISTAKES = [
    row("negative length", fibre(length=-0.04), '"40 mm"', '"-40 mm"', "length must be positive, got -0.04 m"),
    row("zero diameter", circle(diameter=0.0), '"20 um"', '"0 um"', "diameter must be positive, got 0.0 m"),
    row("nan modulus", circle(G=float("nan")), '"106.2 cN/tex"', "nan", "G must be a finite number [Pa], got nan Pa"),
    row(
        "infinite modulus", circle(E=float("inf")), '"2224.6 cN/tex"', "inf", "E must be a finite number [Pa], got inf"
    ),
    row(
        "minus infinite force", tip_force((0, float("-inf"), 0)), '"-1 uN"', "-inf", "force[1] must be a finite number"
    ),
    row("no diameter", lambda: dr.Section.circle(E=1.0, G=1.0), 'diameter = "20 um"', "", "diameter is missing"),
    row(
        "no density under gravity",
        lambda: dr.Scene([dr.Rod.straight(1.0, LIGHT)], [CLAMP], [dr.Gravity((0, 0, -9.81))]),
        COMPLETE[: COMPLETE.index("[motion")],
        '[section.a.circle]\ndiameter = 1\nE = 1\nG = 1\n[[rods]]\nstraight = { length = 1 }\nsection = "a"\n'
        f"{CLAMP_TEXT}[[loads]]\ngravity = {{ g = [0, 0, -9.81] }}\n",
        "rods[0].section.rhoA must be given [kg/m], since loads[0] is Gravity",
    ),
    row("dynamic", lambda: dr.Scene([FIBRE], motion="dynamic"), "[motion.static]", "[motion.dynamic]", "motion"),
    row("unit of another dimension", tip_force(("1 m", 0, 0)), '"-1 uN"', '"-1 um"', "force["),
    row(
        "rod that is none",
        tip_force(UP, rod=1),
        ", force =",
        ", rod = 1, force =",
        "rod must be below 1, the number of rods",
    ),
    row("half a rod", tip_force(UP, rod=0.5), ", force =", ", rod = 0.5, force =", "rod must be the number of a rod"),
    row(
        "load off the rod",
        tip_force(UP, 0.05),
        '"end"',
        '"5 cm"',
        "at must lie on rod 0, between 0 and 0.04 m, got 0.05",
    ),
    row("load before the rod", tip_force(UP, -0.01), '"end"', '"-1 cm"', "at must not be negative, got -0.01 m"),
    row(
        "load in the middle of nowhere", tip_force(UP, "middle"), '"end"', '"middle"', 'at must be "start", "end" or a'
    ),
    row(
        "held twice",
        solved([CLAMP, dr.Pin(0.0)]),
        CLAMP_TEXT,
        f"{CLAMP_TEXT}[[supports]]\npin = {{ at = 0 }}\n",
        "supports[1] must not hold x, y, z again at s = 0.0 m of rod 0: supports[0] does already",
    ),
    row(
        "held and moved",
        solved([CLAMP, dr.Prescribed("start", (0, 1e-3, None))]),
        CLAMP_TEXT,
        f'{CLAMP_TEXT}[[supports]]\nprescribed = {{ at = "start", displacement = [0, "1 mm", "free"] }}\n',
        "supports[1] must not hold x, y again at s = 0.0 m of rod 0: supports[0] does already",
    ),
    row(
        "no support",
        solved([], PUSH),
        CLAMP_TEXT,
        "",
        "rods[0] is free to move along (0, -1, 0), and its loads push it there with 1e-06 N",
    ),
    row(
        "a guide along the force",
        solved([dr.Guide("start", free={"y"})], PUSH),
        'clamp = { at = "start" }',
        'guide = { at = "start", free = ["y"] }',
        "rods[0] is free to move along (0, -1, 0), and its loads push it there with 1e-06 N",
    ),
    row(
        "nothing to hold",
        lambda: dr.Guide("start", free={"x", "y", "z", "rx", "ry", "rz"}),
        'clamp = { at = "start" }',
        'guide = { at = "start", free = ["x", "y", "z", "rx", "ry", "rz"] }',
        "free must leave something held, got all six components",
    ),
    row(
        "times that do not ascend",
        tip_force(UP, history=[(0, 0), (0, 1)]),
        ", force =",
        ", history = [[0, 0], [0, 1]], force =",
        "history[1][0] must be later than 0.0, the row before, got 0.0",
    ),
    row(
        "no steps", lambda: dr.Static(steps=0), "[motion.static]", "[motion.static]\nsteps = 0", "steps must be a whole"
    ),
    row(
        "no time", lambda: dr.Static(t_end=0), "[motion.static]", "[motion.static]\nt_end = 0", "t_end must be positive"
    ),
    row("no rods", lambda: dr.Scene([]), COMPLETE, "", "rods must hold at least one rod, got none"),
    row(
        "no elements",
        lambda: discrete.solve(dr.Scene([FIBRE], [CLAMP]), elements=0),
        "elements = 16",
        "elements = 0",
        "of at least 1, got 0",
    ),
    contact_row(
        "a wall as soft as air",
        lambda: dr.Penalty(0.0),
        'plane = {}\nlaw.penalty = { eps_N = "0 N/m**2" }',
        "eps_N must be positive, got 0.0 N/m²",
    ),
    contact_row(
        "friction that drives",
        lambda: dr.Coulomb(-0.3),
        "plane = {}\nfriction.coulomb = { mu = -0.3 }",
        "mu must not be negative, got -0.3",
    ),
    contact_row(
        "a wall without direction",
        lambda: dr.Plane(normal=(0, 0, 0)),
        "plane = { normal = [0, 0, 0] }",
        "normal must not be zero, got",
    ),
    contact_row(
        "a roller of no radius",
        lambda: dr.Cylinder((0, 0, 0), UP, 0.0),
        'cylinder = { point = [0, 0, 0], axis = [0, 1, 0], radius = "0 mm" }',
        "radius must be positive, got 0.0 m",
    ),
    contact_row(
        "neither outside nor inside",
        lambda: dr.Cylinder((0, 0, 0), UP, 1.0, "above"),
        'cylinder = { point = [0, 0, 0], axis = [0, 1, 0], radius = 1, side = "above" }',
        'side must be "outside" or "inside", got \'above\'',
    ),
    contact_row(
        "a wall that turns about two axes",
        lambda: dr.WallMotion(rotation=(1, 0, 0), spin=(0, 1, 0)),
        "plane = { motion = { rotation = [1, 0, 0], spin = [0, 1, 0] } }",
        "spin must be along rotation (1.0, 0.0, 0.0) rad, got (0.0, 1.0, 0.0) rad/s",
    ),
    contact_row(
        "a rod that is none touches",
        touching(rod=1),
        "plane = {}\nrod = 1",
        "contacts[0].rod must be below 1, the number of rods, got 1",
    ),
    contact_row(
        "a rod that is none touches rods",
        lambda: dr.Scene([FIBRE], [CLAMP], contacts=[dr.RodContact(rods=[0, 1])]),
        "rods = { rods = [0, 1] }",
        "contacts[0].rods[1] must be below 1, the number of rods, got 1",
    ),
    contact_row(
        "a rod is to touch itself twice",
        lambda: dr.RodContact(rods=[0, 0]),
        "rods = { rods = [0, 0] }",
        "rods must be numbers of rods, each named once, got [0, 0]",
    ),
    contact_row(
        "creep at rest",
        touching(friction=dr.CreepingCoulomb(0.3, 1e-3)),
        'plane = {}\nfriction.creeping_coulomb = { mu = 0.3, v_0 = "1 mm/s" }',
        "contacts[0].friction must not be CreepingCoulomb, since motion is Static",
    ),
    row(
        "a rod of no thickness touches",
        lambda: dr.Scene(
            [dr.Rod.straight(1.0, dr.Section(GJ=1, EI=1, rigid={"shear", "extension"}))], contacts=[FLOOR]
        ),
        COMPLETE,
        '[section.a]\nGJ = 1\nEI = 1\nrigid = ["shear", "extension"]\n[[rods]]\nstraight = { length = 1 }\n'
        'section = "a"\n[[contacts]]\nplane = {}\n',
        "rods[0].section.radius must be given [m], since the rod may touch contacts[0]",
    ),
]
# What Python answers by itself, as for every misspelt name and every key given twice.
IN_FILES = [
    ("diameter", "diametre", "section.ramie.circle.diametre is unknown; known are diameter, E, "),
    (".circle", ".cirkle", "section.ramie.cirkle is unknown; known are EA, GA, GJ, EI, "),
    ("clamp =", "clam =", "supports[0].clam is unknown; known are clamp, pin, guide, prescribed; did you mean clamp?"),
    ('section = "ramie"', 'section = "rami"', "must be the name of a section (ramie), got 'rami'; did you mean ramie?"),
    ('"20 um"', '"20 smoot"', "diameter must be a quantity in m, got '20 smoot': there is no unit 'smoot'"),
    ('"20 um"', '"20"', "diameter must be a quantity in m, got '20'"),
    ('"40 mm"', '"40 kg"', "rods[0].straight.length must be a quantity in m, got '40 kg'"),
    ('"1.54 g/cm**3"', '"1.54 g/cm**2"', "density must be a quantity in kg/m**3, got '1.54 g/cm**2'"),
    ('"-1 uN"', '"9**9**9 N"', "force[1] must be a quantity in N, got '9**9**9 N'"),
    ('density = "1.54 g/cm**3"', "", "density must be given, since E is a modulus per density"),
    ('G = "106.2 cN/tex"', 'G = "106.2 cN/tex"\nG = 1.0', "a scene must be a TOML file: Cannot overwrite a value"),
    ("[[rods]]", "[section.ramie.circle]\n[[rods]]", "Cannot declare ('section', 'ramie', 'circle') twice"),
    (FORCE_TEXT, f"{FORCE_TEXT}\n{FORCE_TEXT}", "a scene must be a TOML file: Cannot overwrite a value"),
    (FORCE_TEXT, f"{FORCE_TEXT}\ngravity = {{ g = [0, 0, 1] }}", "loads[0] must be one of point_force, "),
    (MOTION_TEXT, "[[contacts]]\nplain = {}", "contacts[0].plain is unknown; known are plane, cylinder, groove, rods,"),
    (MOTION_TEXT, "[[contacts]]\nlaw = 'tight'", "contacts[0] must be one of plane, cylinder, groove, rods, got none"),
    (
        MOTION_TEXT,
        "[[contacts]]\nplane = {}\nlaw = 'soft'",
        'contacts[0].law must be "paper" or "tight", or a table that',
    ),
    ("degree = 3", "degree = 9", "solve.degree must be at most 5, got 9"),
    ("degree = 3", "order = 3", "solve.order is unknown; known are elements, degree, kinematics"),
]


def refusal(file: Path, *command: str) -> str:
    """What the command says when it refuses a file, checked for exit code 2 and one line."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        assert cli.main([*command, str(file)]) == 2
    comm = world()
    said = err.getvalue() if comm is None else comm.bcast(err.getvalue(), root=0)
    assert out.getvalue() == ""
    assert said.startswith("dolfinrod: ")
    assert said.index("\n") == len(said) - 1
    return said


def written(path: Path, text: str) -> Path:
    """A file that every rank reads."""
    comm = world()
    if comm is None or comm.rank == 0:
        path.write_text(text, encoding="utf-8")
    if comm is not None:
        comm.barrier()
    return path


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_answered_alike_in_python_and_in_a_file(mistake: Mistake, shared_path: Path) -> None:
    with pytest.raises(SceneError, match=re.escape(mistake.words)):
        mistake.python()
    file = written(shared_path / "scene.toml", COMPLETE.replace(mistake.old, mistake.new))
    assert mistake.words in refusal(file, "run", "--model", "discrete")


@pytest.mark.parametrize(("old", "new", "words"), IN_FILES)
@pytest.mark.parametrize("command", ["run", "info"])
def test_a_mistake_that_only_a_file_can_hold(command: str, old: str, new: str, words: str, shared_path: Path) -> None:
    assert old in COMPLETE
    assert words in refusal(written(shared_path / "scene.toml", COMPLETE.replace(old, new)), command)


SCRAPS = [
    "",
    "[",
    "]",
    "{",
    "}",
    '"',
    "=",
    ",",
    ".",
    "\n",
    "#",
    "nan",
    "-inf",
    "1e999",
    "true",
    "'",
    "\\",
    "\0",
    "é",
    "[[",
]
EDITS = st.tuples(st.integers(0, len(COMPLETE)), st.integers(0, 12), st.sampled_from(SCRAPS))


@pytest.mark.serial
@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(edits=st.lists(EDITS, min_size=1, max_size=4))
def test_the_command_never_gives_a_traceback(tmp_path: Path, edits: list[tuple[int, int, str]]) -> None:
    text = COMPLETE
    for begin, length, scrap in edits:
        text = text[:begin] + scrap + text[begin + length :]
    file = tmp_path / "scene.toml"
    file.write_text(text, encoding="utf-8")
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()) as err:
        code = cli.main(["info", str(file)])
    assert code in (0, 2)
    assert (code == 0) == (err.getvalue() == "")
