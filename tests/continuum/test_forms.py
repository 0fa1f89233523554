"""The weak form depends on the kinematics and the degree alone: it is compiled once and serves every scene."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import dolfinrod as dr
from dolfinrod.continuum.precompile import compiled
from tests.scenes import GENERAL, SKEW, cantilever, tip_loaded

ROOT = Path(__file__).parents[2]

# Solves very different scenes of one kinematics and degree, and prints how many times FFCx has compiled and how many
# libraries the cache holds after each.
COUNT = """
import json, os, pathlib, sys
import dolfinrod as dr
import ffcx.codegeneration.jit
from tests.scenes import GENERAL, KIRCHHOFF, SKEW, cantilever

compile_forms = ffcx.codegeneration.jit._compile_objects
compiled = 0
def counted(*arguments, **options):
    global compiled
    compiled += 1
    return compile_forms(*arguments, **options)
ffcx.codegeneration.jit._compile_objects = counted

turned = SKEW.turned
rod = SKEW.straight(GENERAL)
arc = SKEW.arc(dr.Section(EA=7.0, GA=5.0, GJ=3.0, EI=2.0, rhoA=0.1), radius=0.3)
other = SKEW.straight(KIRCHHOFF, start=(0, 1, 0), length=2.0)
up = dr.PointForce(turned((0, 1, 0)), "end")
scenes = [
    (cantilever(rod, up), 2),
    (cantilever(rod, dr.PointForce(turned((0, -3.5, 0)), 0.4)), 2),
    (cantilever(SKEW.straight(KIRCHHOFF), up), 3),
    (cantilever(arc, dr.Gravity(turned((0, -1, 0))), dr.LineForce(turned((1, 0, 0)), between=(0.05, 0.1))), 4),
    (cantilever(rod, dr.PointMoment(turned((0, 0, 1)), "end"), dr.FollowerMoment((0, 0, 1), "end")), 3),
    (cantilever(rod, dr.FollowerForce((0, 1, 0), "end")), 2),
    (dr.Scene([rod, other], [dr.Clamp("start"), dr.Pin("end", rod=1)], [up]), 3),
    (dr.Scene([rod], [dr.Clamp("start"), dr.Prescribed("end", rotation=turned((0, 0, 1)))]), 2),
]
cache = pathlib.Path(os.environ["XDG_CACHE_HOME"], "fenics")
rows = []
for scene, elements in scenes:
    result = dr.solve(scene, elements=elements, degree=1)
    assert result.formulation.kinematics == "planar"
    rows.append((compiled, len(list(cache.glob("*.so")))))
print(json.dumps(rows))
"""


def fresh_process(code: str, cache: Path) -> str:
    """What a new Python with a cache of its own prints."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))}
    environment |= {"XDG_CACHE_HOME": str(cache), "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.serial
def test_other_values_rods_meshes_and_loads_compile_nothing(tmp_path):
    rows = json.loads(fresh_process(COUNT, tmp_path))
    assert rows[0][0] > 0
    assert rows[0][1] > 0
    assert rows == [rows[0]] * len(rows)
    # A second process finds all of it on disk.
    again = json.loads(fresh_process(COUNT, tmp_path))
    assert again == [[0, rows[0][1]]] * len(rows)


@pytest.mark.serial
def test_importing_the_package_loads_no_solver(tmp_path):
    loaded = fresh_process("import sys, dolfinrod; print(*sys.modules)", tmp_path).split()
    assert "dolfinrod" in loaded
    assert not {"dolfinx", "petsc4py", "mpi4py", "ufl", "dolfinrod.continuum"}.intersection(loaded)


LOADS = {
    "PointForce": dr.PointForce(SKEW.turned((0, 1, 0)), "end"),
    "PointMoment": dr.PointMoment(SKEW.turned((0, 0, 1)), "end"),
    "FollowerForce": dr.FollowerForce((0, 1, 0), 0.5),
    "FollowerMoment": dr.FollowerMoment((0, 0, 1), "end"),
    "LineForce": dr.LineForce(SKEW.turned((0, 1, 0))),
}


def test_nothing_is_in_the_form_but_what_the_scene_lists():
    rod = SKEW.straight(GENERAL)
    assert dr.solve(cantilever(rod), elements=2, degree=1).formulation.terms == ("Elasticity",)
    for name, load in LOADS.items():
        assert dr.solve(cantilever(rod, load), elements=2, degree=1).formulation.terms == ("Elasticity", name)
    everything = dr.solve(cantilever(rod, *LOADS.values(), *LOADS.values()), elements=2, degree=1)
    assert everything.formulation.terms == ("Elasticity", *LOADS)


@pytest.mark.parametrize(("elements", "degree"), [(1, 1), (4, 3), (3, 5)])
def test_unknowns_are_those_of_the_kinematics(elements, degree):
    nodes, resultants = elements * degree + 1, elements * degree
    scene = tip_loaded(GENERAL, 1.0)
    planar = dr.solve(scene, elements=elements, degree=degree).formulation
    assert planar.unknowns == {"r": 2 * nodes, "q": nodes, "N": 2 * resultants, "m": resultants}
    spatial = dr.solve(scene, elements=elements, degree=degree, kinematics=dr.Spatial()).formulation
    assert spatial.unknowns == {
        "r": 3 * nodes,
        "q": 4 * nodes,
        "multiplier": nodes,
        "N": 3 * resultants,
        "m": 3 * resultants,
    }


def test_rigid_sections_change_values_not_unknowns():
    rigid = dr.Section(GJ=0.7, EI=(1.0, 2.0), rigid={"shear", "extension"})
    a, b = (dr.solve(tip_loaded(section, 1.0), elements=3, degree=2).formulation for section in (GENERAL, rigid))
    assert a == b


def test_forms_of_a_degree_are_made_ahead():
    words = list(compiled((1,)))
    assert [sentence.partition(":")[0] for sentence in words] == ["planar, degree 1", "spatial, degree 1"]
