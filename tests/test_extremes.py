"""Units from 1e-12 to 1e12, ten thousand elements and two, fibres of every slenderness: the same answers."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.scenes import SKEW, largest
from verification.hardcases.together import bow

MODELS = {
    "planar": partial(dr.solve, elements=4, degree=3, kinematics=dr.Planar()),
    "spatial": partial(dr.solve, elements=4, degree=3, kinematics=dr.Spatial()),
    "discrete": partial(discrete.solve, elements=20),
}
# Bisshopp and Drucker 1945: tip of the inextensible cantilever, P L²/EI = 10 (case A1-inext-alpha10 of the references).
ELASTICA = np.array([1.0 - 0.5549955977537513, 0.8106090248802964, 0.0])
RIGID = dr.Section(GJ=0.8, EI=1.0, rigid={"shear", "extension"})


def arc_in_units(length: float, force: float) -> dr.Scene:
    """A curved rod under a follower force, a moment, a line load and a moved end; 1 m is `length`, 1 N is `force`."""
    EI = force * length**2
    section = dr.Section(EA=900.0 * force, GA=(400.0 * force, 400.0 * force), GJ=0.7 * EI, EI=EI)
    rod = dr.Rod.arc(
        radius=length,
        angle=1.2,
        section=section,
        start=SKEW.origin * length,
        direction=SKEW.turned((1, 0, 0)),
        towards=SKEW.turned((0, 1, 0)),
    )
    loads = [
        dr.FollowerForce((force, 3.0 * force, 0.0), at="end"),
        dr.PointMoment(SKEW.turned((0, 0, 2.0 * force * length)), at=0.6 * length),
        dr.LineForce(SKEW.turned((2.0 * force / length, -force / length, 0))),
    ]
    moved = dr.Prescribed("start", displacement=SKEW.turned((0.1 * length, 0.05 * length, 0)), rotation=(0, 0, 0))
    return dr.Scene([rod], [moved], loads)


@pytest.mark.parametrize("solve", MODELS.values(), ids=MODELS)
@pytest.mark.parametrize("length", [1e-12, 1.0, 1e12])
@pytest.mark.parametrize("force", [1e-12, 1e12])
def test_units_change_nothing_but_the_last_digits(solve, length, force):
    here, there = solve(arc_in_units(1.0, 1.0)), solve(arc_in_units(length, force))
    a, b = here.rods[0], there.rods[0]
    assert there.statistics.newton_iterations == here.statistics.newton_iterations
    np.testing.assert_allclose(b.r[-1] / length, a.r[-1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(b.n[-1] / force, a.n[-1], rtol=0, atol=1e-9)
    np.testing.assert_allclose(b.m[-1] / (force * length), a.m[-1], rtol=0, atol=1e-9)
    assert there.energy["strain"][-1] / (force * length) == pytest.approx(here.energy["strain"][-1], rel=1e-11)


def cantilever() -> dr.Scene:
    return dr.Scene(
        [dr.Rod.straight(length=1.0, section=RIGID)],
        [dr.Clamp("start")],
        [dr.PointForce((0.0, 10.0, 0.0), at="end")],
    )


@pytest.mark.parametrize("kinematics", [dr.Planar(), dr.Spatial()], ids=["planar", "spatial"])
@pytest.mark.parametrize(("elements", "degree", "error"), [(2, 5, 1e-6), (10_000, 1, 3e-9)])
def test_the_elastica_on_two_and_on_ten_thousand_elements(kinematics, elements, degree, error):
    result = dr.solve(cantilever(), elements=elements, degree=degree, kinematics=kinematics)
    assert np.linalg.norm(result.tip - ELASTICA) < error
    assert result.statistics.newton_iterations == 5


@pytest.mark.slow
@pytest.mark.parametrize("kinematics", [dr.Planar(), dr.Spatial()], ids=["planar", "spatial"])
def test_ten_thousand_cubic_elements_keep_twelve_digits(kinematics):
    assert np.linalg.norm(dr.solve(cantilever(), elements=10_000, kinematics=kinematics).tip - ELASTICA) < 1e-12


def test_the_elastica_on_ten_thousand_discrete_elements():
    """The stand-in EA = 1e8 EI/L² for no extension, not the mesh, is what is left."""
    assert np.linalg.norm(discrete.solve(cantilever(), elements=10_000).tip - ELASTICA) < 2e-7


@pytest.mark.parametrize("model", ["planar", "spatial", "discrete"])
@pytest.mark.parametrize(("slenderness", "whiff"), [(250.0, 1.0), (2000.0, 1e-2), (2000.0, 1e-4)])
def test_a_fibre_whose_ends_are_brought_together_by_a_tenth_buckles(model, slenderness, whiff):
    """Both ends hinged, in one load step, of which buckling takes less than a thousandth; Euler's elastica."""
    section = dr.Section(EA=16.0 * slenderness**2, GJ=0.77, EI=1.0, rigid={"shear"})
    together = dr.Prescribed("end", displacement=(-0.1, 0.0, 0.0))
    supports = [dr.Guide("start", free={"ry", "rz"}), together]
    scene = dr.Scene([dr.Rod.straight(1.0, section)], supports, [dr.LineForce((0.0, whiff, 0.0))])
    if model == "discrete":
        result = discrete.solve(scene, elements=80)
    else:
        result = dr.solve(scene, elements=16, kinematics=dr.Planar() if model == "planar" else dr.Spatial())
    assert result.log[-1].stable
    assert largest(result.rods[0].r[-1][:, 1]) == pytest.approx(bow(0.1), rel=3e-4)


@pytest.mark.parametrize("model", ["spatial", "discrete"])
def test_a_flat_rod_bent_the_stiff_way_turns_about_itself(model):
    """Its centreline hardly moves as it gives way, so that hardly any mass takes part; both models find where to."""
    section = dr.Section(EA=2.7e6, GJ=0.757, EI=(1.0, 5.73), rhoA=1.0, rigid={"shear"})
    rod = dr.Rod.arc(radius=1.0, angle=1.0, section=section)
    moved = dr.Prescribed("end", displacement=(-0.106, 0.0198, -0.0035))
    scene = dr.Scene([rod], [dr.Clamp("start"), moved], [dr.LineForce((0.0836, 0.2674, 0.1283))])
    exact = dr.solve(scene, elements=16, degree=5, kinematics=dr.Spatial())
    solve = partial(discrete.solve, elements=80) if model == "discrete" else partial(dr.solve, elements=8)
    result = solve(scene)
    assert exact.log[-1].stable
    assert result.log[-1].stable
    assert result.energy["strain"][-1] == pytest.approx(exact.energy["strain"][-1], rel=1e-3)
