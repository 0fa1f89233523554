"""The house stands as drawn: what loads what, which names are public, how long a thought may be."""

from __future__ import annotations

import ast
import inspect
import subprocess
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement

import discrete
import dolfinrod as dr

pytestmark = pytest.mark.serial

ROOT = Path(__file__).parents[1]
PACKAGES = ("dolfinrod", "discrete", "verification")
MODULES = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))
SOURCES = [*MODULES, *sorted((ROOT / "tests").rglob("*.py"))]
MOST_LINES_OF_A_MODULE = 250
MOST_LINES_OF_A_FUNCTION = 40

IMPORT_ALL = """
import importlib, pkgutil, sys
for name in sys.argv[1:]:
    package = importlib.import_module(name)
    for module in pkgutil.walk_packages(package.__path__, name + "."):
        importlib.import_module(module.name)
print(*sys.modules)
"""


def loaded_after(code: str, *arguments: str) -> set[str]:
    """Modules in a fresh Python that ran some code, which prints them."""
    command = [sys.executable, "-c", code, *arguments]
    return set(subprocess.run(command, capture_output=True, text=True, check=True).stdout.split())


def within(package: str, modules: set[str]) -> set[str]:
    """The modules of one package."""
    return {name for name in modules if name == package or name.startswith(f"{package}.")}


def relative(path: Path) -> str:
    return str(path.relative_to(ROOT))


@pytest.mark.parametrize("heavy", ["dolfinx", "petsc4py", "mpi4py", "numba", "pint", "matplotlib"])
def test_importing_both_models_loads_no_solver(heavy):
    modules = loaded_after("import dolfinrod, discrete, sys; print(*sys.modules)")
    assert {"dolfinrod", "discrete"} <= modules
    assert not within(heavy, modules)


def test_scene_and_result_need_numpy_only():
    modules = loaded_after("import dolfinrod, sys; print(*sys.modules)")
    assert within("numpy", modules)
    assert not within("scipy", modules)


@pytest.mark.parametrize(("model", "other"), [("discrete", "dolfinrod.continuum"), ("dolfinrod.continuum", "discrete")])
def test_neither_model_loads_the_other(model, other):
    modules = loaded_after(IMPORT_ALL, model)
    assert len(within(model, modules)) > 3
    assert not within(other, modules)


@pytest.mark.parametrize(
    ("owner", "names"),
    [
        (dr, "Section Rod Scene SceneError Static Steady Planar Spatial Result NotConverged solve"),
        (dr, "Clamp Pin Guide Prescribed"),
        (dr, "PointForce PointMoment LineForce Gravity FollowerForce FollowerMoment"),
        (dr.Section, "circle rectangle ramie compliance_n compliance_m"),
        (dr.Rod, "straight arc curved through centerline frames curvature length breakpoints"),
        (dr.Result, "tip"),
        (dr.RodHistory, "at"),
        (dr, "buckling critical modes Buckling Modes RodShapes"),
        (dr.twist, "winding pairs axis_winding profile delivered crossings exchanges writhe twist link outflow of"),
        (discrete, "solve buckling critical modes"),
    ],
)
def test_public_names_exist(owner, names):
    assert [name for name in names.split() if not hasattr(owner, name)] == []


@pytest.mark.parametrize(
    ("record", "fields"),
    [
        (dr.Result, "rods t converged log energy statistics formulation"),
        (dr.RodHistory, "s r frames gamma kappa n m"),
        (dr.StepLog, "t iterations cuts residual energy stable unstable_directions"),
        (
            dr.Statistics,
            "dofs load_steps newton_iterations factorizations seconds_compile seconds_setup seconds_solve",
        ),
        (dr.Formulation, "kinematics unknowns terms"),
    ],
)
def test_records_have_the_agreed_fields(record, fields):
    assert set(fields.split()) <= set(record.__dataclass_fields__)


def test_models_take_the_agreed_options():
    from dolfinrod.continuum import solve

    assert {"elements", "degree", "kinematics", "comm", "progress", "start"} <= set(inspect.signature(solve).parameters)
    assert {"elements", "axial", "frame", "equilibrium"} <= set(inspect.signature(discrete.solve).parameters)


@pytest.mark.parametrize("path", MODULES, ids=relative)
def test_module_is_short_and_says_what_it_is(path):
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= MOST_LINES_OF_A_MODULE
    assert ast.get_docstring(ast.parse(text))


@pytest.mark.parametrize("path", SOURCES, ids=relative)
def test_functions_are_short(path):
    functions = [
        node
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    ]
    lengths = {f"{node.name}, line {node.lineno}": node.end_lineno - node.lineno + 1 for node in functions}
    assert {name: length for name, length in lengths.items() if length > MOST_LINES_OF_A_FUNCTION} == {}


def test_declared_dependencies_are_those_installed():
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    wanted = [Requirement(text) for text in (*declared["dependencies"], *declared["optional-dependencies"]["dev"])]
    found = {wish.name: metadata.version(wish.name) for wish in wanted}
    assert [str(wish) for wish in wanted if not wish.specifier.contains(found[wish.name])] == []


def test_numpy_is_the_one_dolfinx_was_built_with():
    import numpy

    assert Path(numpy.__file__).is_relative_to("/usr/lib/python3/dist-packages")
