"""A rod becomes a cable: its deviation from the catenary falls with EI, or with √EI where an end is held level."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from dolfinrod.scene import Planar
from verification.case import UPRIGHT
from verification.cases import cable
from verification.models import Continuum, Discrete
from verification.order import order
from verification.references import Cable, catenary, catenary_tension
from verification.references.reference import table
from verification.workprecision import study

pytestmark = pytest.mark.serial

HALF, WEIGHT = cable.HALF, cable.LENGTH**3
END = np.array([HALF])
STIFFNESSES = (np.inf, cable.EXTENSIBLE)
names = pytest.mark.parametrize("EA", STIFFNESSES, ids=["inextensible", "elastic"])


def known(EA: float) -> tuple[float, float]:
    """Tabulated tension and sag."""
    q = table()[f"J4-cable-L1.2-d1.0-h0.0-EA{None if np.isinf(EA) else EA}"]["quantities"]
    return q["H"], q["sag"]


def power(ratios: tuple[float, ...], deviations: list[float]) -> np.ndarray:
    """Exponents with which deviations fall from one stiffness to the next."""
    return np.diff(np.log(deviations)) / np.diff(np.log(ratios))


@names
def test_catenary_agrees_with_the_tabulated_cable(EA):
    H, sag = known(EA)
    assert catenary_tension(0.5, HALF, EA=EA) == pytest.approx(H, abs=1e-15)
    assert catenary(H, HALF, EA=EA) == pytest.approx((0.5, sag), abs=2e-15)


@pytest.mark.parametrize("EA", STIFFNESSES)
@pytest.mark.parametrize(("level", "ratios"), [(False, (1e-2, 1e-4, 1e-6)), (True, (1e-2, 1e-3))])
def test_collocation_has_converged(EA, level, ratios):
    for ratio in ratios:
        coarse, fine = (Cable(HALF, ratio * WEIGHT, EA, level, terms) for terms in (96, 144))
        H = catenary_tension(0.5, HALF, EA=EA)
        assert coarse.under(H, END) == pytest.approx(fine.under(H, END), abs=2e-15)
        assert coarse.across(0.5, END) == pytest.approx(fine.across(0.5, END), abs=2e-15)
        assert fine.across(0.5, END)[0, 0] == pytest.approx(0.5, abs=2e-15)


@pytest.mark.parametrize("level", [False, True])
def test_collocation_agrees_with_a_boundary_value_solver(level):
    """SciPy's fourth-order solver with a mesh of its own, for EI/(w L³) = 0.001 and EA = 20 w L."""
    EI, EA, H = 1e-3 * WEIGHT, cable.EXTENSIBLE, catenary_tension(0.5, HALF, EA=cable.EXTENSIBLE)

    def slopes(s, state):
        θ = state[0]
        λ = 1.0 + (H * np.cos(θ) + s * np.sin(θ)) / EA
        return np.stack([state[1], λ * (H * np.sin(θ) - s * np.cos(θ)) / EI, λ * np.cos(θ), λ * np.sin(θ)])

    def ends(a, b):
        return np.array([a[0], b[0] if level else b[1], a[2], a[3]])

    s = np.linspace(0.0, HALF, 200)
    found = solve_bvp(slopes, ends, s, np.zeros((4, 200)), tol=1e-10, max_nodes=20000)
    assert found.y[2:, -1] == pytest.approx(Cable(HALF, EI, EA, level).under(H, END)[0], abs=1e-11)


@names
@pytest.mark.parametrize(("level", "exponent"), [(False, 1.0), (True, 0.5)])
def test_hung_rod_tends_to_the_catenary(EA, level, exponent):
    H, sag = known(EA)
    ratios = (1e-4, 1e-5, 1e-6)
    ends = [Cable(HALF, ratio * WEIGHT, EA, level, terms=200).under(H, END)[0] for ratio in ratios]
    assert power(ratios, [np.linalg.norm(r - (0.5, sag)) for r in ends]) == pytest.approx(exponent, abs=0.02)


@pytest.mark.parametrize(("level", "exponent"), [(False, 1.0), (True, 0.5)])
def test_spanning_inextensible_rod_sags_towards_the_catenary(level, exponent):
    ratios, sag = (1e-4, 1e-5, 1e-6), known(np.inf)[1]
    ends = [Cable(HALF, ratio * WEIGHT, clamped=level, terms=200).across(0.5, END)[0] for ratio in ratios]
    assert power(ratios, [abs(r[1] - sag) for r in ends]) == pytest.approx(exponent, abs=0.03)


@pytest.mark.parametrize(
    ("model", "elements", "ratios"),
    [
        (Continuum(4, Planar()), 32, (1e-4, 1e-5, 1e-6)),
        (Continuum(3), 32, (1e-4, 1e-5)),
        (Discrete(), 160, (1e-3, 1e-4)),
    ],
    ids=["planar", "spatial", "discrete"],
)
@pytest.mark.parametrize(("level", "exponent"), [(False, 1.0), (True, 0.5)])
def test_models_tend_to_the_elastic_catenary(model, elements, ratios, level, exponent):
    _, sag = known(cable.EXTENSIBLE)
    deviations = []
    for ratio in ratios:
        case = cable.hung(ratio, cable.EXTENSIBLE, level=level)
        tip = model.solve(case.scene(UPRIGHT), elements).tip
        deviations.append(np.linalg.norm(tip - (0.5, sag, 0.0)))
    assert power(ratios, deviations) == pytest.approx(exponent, abs=0.06)


@pytest.mark.parametrize(
    ("model", "elements", "ratios"),
    [
        (Continuum(4, Planar()), 32, (1e-3, 1e-4, 1e-5)),
        (Continuum(4), 32, (1e-3, 1e-4)),
        (Discrete(), 320, (1e-3, 1e-4)),
    ],
    ids=["planar", "spatial", "discrete"],
)
def test_pinned_rods_sag_towards_the_elastic_catenary(model, elements, ratios):
    _, sag = known(cable.EXTENSIBLE)
    middles = [cable.lowest(model.solve(cable.spanning(ratio).scene(UPRIGHT), elements)) for ratio in ratios]
    assert power(ratios, [np.linalg.norm(r - (0.5, -sag, 0.0)) for r in middles]) == pytest.approx(1.0, abs=0.06)


def test_discrete_stand_in_for_a_rigid_extension_is_what_it_says():
    """Against the same rod with EA = 1e8 EI/L² the order is 2 where it stalls against the inextensible one."""
    case = cable.hung(1e-6)
    EI = 1e-6 * WEIGHT
    stretched = Cable(HALF, EI, EA=1e8 * EI / HALF**2).under(catenary_tension(0.5, HALF), END)[0]
    found = study(case, Discrete(), (40, 80, 160))
    errors = [
        np.linalg.norm(Discrete().solve(case.scene(UPRIGHT), n).tip[:2] - stretched) / HALF for n in (40, 80, 160)
    ]
    assert found.records[-1].error > 1e-3
    assert order(errors, (40, 80, 160), 2).observed == pytest.approx(2.0, abs=0.1)
    assert "stand-in" in case.note
    assert "stand-in" not in cable.hung(1e-6, cable.EXTENSIBLE).note
