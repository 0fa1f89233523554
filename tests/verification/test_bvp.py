"""The boundary-value solutions agree with tabulated ones, with themselves, with other steps, and with statics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from dolfinrod.scene import (
    Clamp,
    Gravity,
    Guide,
    LineForce,
    Pin,
    PointForce,
    PointMoment,
    Prescribed,
    Rod,
    Scene,
    Section,
)
from verification.case import UPRIGHT
from verification.cases import CASES, curved, parabola, several, spans
from verification.references import Solved, bvp, rod_problem, solved
from verification.references.bvp import solve
from verification.references.posed import AXES, Curvature, Held, PointLoad, Problem
from verification.references.reference import table
from verification.references.retrace import retraced
from verification.references.solved import computed

pytestmark = pytest.mark.serial

CLAMP = Held(0.0, about=AXES)
SECTION = Section(EA=300.0, GA=(90.0, 150.0), GJ=0.6, EI=(1.0, 2.5))
KEPT = [case.reference for case in (*CASES, *spans.ALIGNED, *spans.FAR) if isinstance(case.reference, Solved)]


def inverse(stiffness: float | None) -> float:
    """Compliance; none where a table has no stiffness."""
    return 0.0 if stiffness is None else 1.0 / stiffness


def tabulated(name: str) -> tuple[dict[str, float], np.ndarray]:
    """Parameters of a tabulated problem, and its tip."""
    entry = table()[name]
    q = entry["quantities"]
    tip = (1.0 - q["u"], q["w"], 0.0) if "u" in q else (q["x"], q["y"], q["z"])
    return entry["parameters"], np.array(tip)


def tip(problem: Problem) -> np.ndarray:
    """Position of the end."""
    return solve(problem).centreline(np.array([problem.length]))[0]


BENDS = [name for name in table() if name.startswith("D-")]
# One in every run, the others with the long tests.
SOON = ("D-SR-JSV-F600",)


@pytest.mark.parametrize("name", [n if n in SOON else pytest.param(n, marks=pytest.mark.slow) for n in BENDS])
def test_bend_agrees_with_the_tabulated_shooting(name):
    p, expected = tabulated(name)
    length = p["R"] * np.pi / 4
    problem = Problem(
        length,
        (inverse(p["EA"]), inverse(p["GA"]), inverse(p["GA"])),
        (1 / p["GJ"], 1 / p["EI"], 1 / p["EI"]),
        (CLAMP,),
        (PointLoad(length, (0.0, 0.0, p["F"])),),
        curvature=Curvature((0.0, 0.0, 1 / p["R"])),
    )
    assert tip(problem) == pytest.approx(expected, abs=1e-12 * length)


@pytest.mark.parametrize("alpha", [pytest.param(1, marks=pytest.mark.slow), 10])
def test_cantilever_agrees_with_the_tabulated_quadrature(alpha):
    p, expected = tabulated(f"A2-SR-alpha{alpha}-Lh10-nu0.3")
    compliance = (1 / p["EA"], 1 / p["GA"], 1 / p["GA"])
    problem = Problem(1.0, compliance, (1.0, 1.0, 1.0), (CLAMP,), (PointLoad(1.0, (0.0, p["P"], 0.0)),))
    assert tip(problem) == pytest.approx(expected, abs=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize("load", [0.05, 0.1])
def test_rod_bent_to_a_helix_agrees_with_the_tabulated_shooting(load):
    p, q = table()["E-SR-F50"]["parameters"], table()["E-SR-F50"]["quantities"]
    end = PointLoad(p["L"], (0.0, 0.0, load * p["F"]), (0.0, 0.0, load * p["M"]))
    problem = Problem(p["L"], 3 * (1 / p["EA"],), 3 * (1 / p["EI"],), (CLAMP,), (end,))
    expected = [q[f"{name}@{load:g}"] for name in ("x", "y", "uz")]
    assert tip(problem) == pytest.approx(expected, abs=3e-12 * p["L"])


@pytest.mark.slow
def test_varying_curvature_is_taken_as_given():
    """BeamDyn's parabola: κ₀ = −2b/(1 + y′²)^3/2 about d3 = −z, at the x that lies at arc length s."""
    p, expected = tabulated("D2-parabola-F600")
    points = parabola.THROUGH
    a, b = np.linalg.solve(points[:, :1] ** [1, 2], points[:, 1])

    def arc(x: float) -> float:
        t = a + 2 * b * np.array([0.0, x])
        return float(np.diff(t * np.sqrt(1 + t**2) + np.arcsinh(t))[0] / (4 * b))

    def curvature(s: np.ndarray) -> np.ndarray:
        x = np.array([brentq(lambda x, s=s: arc(x) - s, -1.0, 80.0, xtol=1e-13) for s in s])
        κ = 2 * b / (1 + (a + 2 * b * x) ** 2) ** 1.5
        return np.stack([0 * κ, 0 * κ, κ], axis=-1)

    d1 = np.array([1.0, a, 0.0]) / np.hypot(1.0, a)
    length = arc(points[-1, 0])
    problem = Problem(
        length,
        (1 / p["EA"], 1 / p["GA"], 1 / p["GA"]),
        (1 / p["GJ"], 1 / p["EI"], 1 / p["EI"]),
        (CLAMP,),
        (PointLoad(length, (0.0, 0.0, p["F"])),),
        curvature=curvature,
        d1=tuple(d1),
        d2=(-d1[1], d1[0], 0.0),
    )
    assert tip(problem) == pytest.approx(expected, abs=1e-12 * length)


def test_kept_references_are_those_of_the_cases(monkeypatch):
    """None is computed while the cases are loaded, and each is known to 1e-11 of its length."""
    monkeypatch.delitem(solved.__globals__, "computed")
    assert len(KEPT) >= 19
    for one in KEPT:
        assert solved(one.id, one.problem, one.at) == one
        assert one.agreement < 1e-11 * one.problem.length
        assert one.digits_trusted >= 11


@pytest.mark.slow
@pytest.mark.parametrize("reference", KEPT, ids=lambda reference: reference.id)
def test_kept_references_are_found_anew(reference):
    found = computed(reference.problem, reference.at)
    assert found["value"] == pytest.approx(reference.value, abs=2 * reference.agreement)
    assert found["agreement"] < 1e-11 * reference.problem.length


def test_other_parameters_are_another_problem(monkeypatch):
    """A name alone finds nothing in the file."""
    case = curved.coil(1.0)
    monkeypatch.setitem(solved.__globals__, "computed", lambda *_: {"value": (1, 2, 3), "agreement": 1e-9})
    softer = replace(case.reference.problem, compliance_m=(2.0, 1.0, 0.4))
    assert solved(case.name, case.reference.problem, case.length).value == case.reference.value
    assert solved(case.name, softer, case.length).value == (1, 2, 3)
    assert solved(case.name, case.reference.problem, 1.0).value == (1, 2, 3)


@pytest.fixture(scope="module")
def hinged() -> bvp.Solution:
    """The helix through a sleeve, held by a hinge, under a line force and a point force."""
    return solve(spans.hinged(4.0).reference.problem)


def test_reactions_hold_the_loads(hinged):
    """Σ F = 0 and Σ (M + r × F) = 0 over loads and reactions, the line force by Gauss quadrature."""
    x, w = np.polynomial.legendre.leggauss(40)
    problem = hinged.problem
    force, moment = np.zeros(3), np.zeros(3)
    for held in problem.supports:
        F, M = hinged.reaction(held.s)
        force += F
        moment += M + np.cross(hinged.centreline(np.array([held.s]))[0], F)
    for load in problem.loads:
        force += load.force
        moment += np.cross(hinged.centreline(np.array([load.s]))[0], load.force)
    for a, b in zip(problem.places[:-1], problem.places[1:], strict=True):
        r = hinged.centreline(0.5 * (a + b) + 0.5 * (b - a) * x)
        force += (b - a) * np.array(problem.lines[0].force)
        moment += 0.5 * (b - a) * w @ np.cross(r, problem.lines[0].force)
    assert np.abs(force).max() < 1e-12
    assert np.abs(moment).max() < 1e-11


def test_sleeve_holds_across_and_turns_about_its_axis(hinged):
    """The middle stays at its height and its section turns about z alone: z keeps its components in the section."""
    free = solve(replace(hinged.problem, supports=(CLAMP,), loads=(), lines=()))
    middle = np.array([1.0])
    now, then = hinged.at(middle)[0], free.at(middle)[0]
    assert now[1] == pytest.approx(then[1], abs=1e-14)
    assert abs(now[0] - then[0]) > 1e-3
    back = np.array([1.0, -1.0, -1.0, -1.0])
    z = np.array([0.0, 0.0, 1.0])
    assert bvp.rotated(now[3:7] * back, z) == pytest.approx(bvp.rotated(then[3:7] * back, z), abs=1e-13)
    assert hinged.reaction(1.0)[1][2] == 0.0


def test_walk_finds_what_is_wrong(hinged):
    assert retraced(hinged) < 1e-12
    stiffer = replace(hinged, problem=replace(hinged.problem, compliance_m=(1.6, 1.0, 0.4)))
    assert retraced(stiffer) > 1e-3
    unloaded = replace(hinged, problem=replace(hinged.problem, loads=()))
    assert retraced(unloaded) > 1e-1


@pytest.mark.slow
@given(
    kappa=st.tuples(*3 * [st.floats(-2.0, 2.0)]),
    pretwist=st.floats(-3.0, 3.0),
    load=st.tuples(*6 * [st.floats(-0.6, 0.6)]),
)
@settings(max_examples=10, deadline=None)
def test_two_resolutions_and_the_walk_agree(kappa, pretwist, load):
    rod = Rod.curved(1.5, SECTION, kappa, pretwist=pretwist)
    loads = [PointForce(load[:3], at="end"), PointMoment(load[3:], at=0.5)]
    problem = rod_problem(Scene(rods=[rod], supports=[Clamp(at="start")], loads=loads))
    assert computed(problem, 1.5)["agreement"] < 1e-12


@given(kappa=st.tuples(*3 * [st.floats(-3.0, 3.0)]), pretwist=st.floats(-3.0, 3.0), s=st.floats(0.0, 1.5))
@settings(max_examples=2, deadline=None)
def test_stress_free_shape_is_that_of_the_scene(kappa, pretwist, s):
    rod = Rod.curved(1.5, SECTION, kappa, direction=(1.0, 2.0, -0.5), pretwist=pretwist)
    y = solve(rod_problem(Scene(rods=[rod], supports=[Clamp(at="start")]))).at(np.array([s]))[0]
    assert y[:3] == pytest.approx(rod.centerline(np.array([s]))[0], abs=1e-9)
    d1, d2, d3 = rod.frames(np.array([s]))[0].T
    found = [bvp.rotated(y[3:7], axis) for axis in np.eye(3)]
    assert np.array(found) == pytest.approx(np.array([d1, d2, d3]), abs=1e-9)


def test_scene_is_read_as_it_is_meant():
    heavy = Section(EA=3.0, GA=2.0, GJ=1.0, EI=1.0, rhoA=2.0)
    rods = [Rod.straight(1.0, heavy), Rod.straight(2.0, heavy, direction=(0.0, 0.0, 1.0))]
    scene = Scene(
        rods=rods,
        supports=[Clamp(at="start"), Pin(at=1.5, rod=1), Prescribed(at="end", displacement=(None, 0.2, None), rod=1)],
        loads=[Gravity((0.0, 0.0, -9.0)), LineForce((1.0, 0.0, 0.0), between=(0.2, 0.4), rod=1)],
    )
    first, second = rod_problem(scene, 0), rod_problem(scene, 1)
    assert [held.s for held in first.supports] == [0.0]
    assert [line.force for line in first.lines] == [(0.0, 0.0, -18.0)]
    assert [(held.s, held.along, held.moved) for held in second.supports[1:]] == [
        (1.5, AXES, (0.0, 0.0, 0.0)),
        (2.0, AXES[1:2], (0.0, 0.2, 0.0)),
    ]
    assert [(line.a, line.b) for line in second.lines] == [(0.0, 2.0), (0.2, 0.4)]
    assert second.d1 == (0.0, 0.0, 1.0)


def test_what_is_not_posed_is_said():
    clamped = {"supports": [Clamp(at="start")]}
    spline = Rod.through([(0, 0, 0), (1, 0, 0), (2, 1, 0)], SECTION)
    with pytest.raises(ValueError, match="uniform curvature"):
        rod_problem(Scene(rods=[spline], **clamped))
    turned = Prescribed(at="end", rotation=(0.0, 0.0, 1.0))
    with pytest.raises(ValueError, match="prescribed rotation"):
        rod_problem(Scene(rods=[Rod.straight(1.0, SECTION)], supports=[Clamp(at="start"), turned]))
    half_free = Guide(at="end", free=("x", "y", "z", "ry", "rz"))
    with pytest.raises(ValueError, match="no hinge"):
        rod_problem(Scene(rods=[Rod.straight(1.0, SECTION)], supports=[Clamp(at="start"), half_free]))


def test_what_is_not_found_is_said(monkeypatch):
    monkeypatch.setattr(bvp, "MAX_ITERATIONS", 3)
    with pytest.raises(ArithmeticError, match="no equilibrium found beyond load factor 0"):
        solve(replace(several.member(2).reference.problem, loads=(PointLoad(1.0, (1e7, 0.0, 0.0)),)))
    monkeypatch.setattr(bvp, "MAX_ITERATIONS", 1)
    with pytest.raises(ArithmeticError, match="stress-free shape"):
        solve(curved.coil(1.0).reference.problem)


def test_guides_need_axes_along_those_of_space():
    assert spans.axes(UPRIGHT) == ("x", "y", "z")
    with pytest.raises(ValueError, match="along those of space"):
        spans.axes(replace(UPRIGHT, rotation_vector=(0.4, -0.9, 1.3)))
