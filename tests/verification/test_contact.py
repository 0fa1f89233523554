"""Contact cases: references against each other, the cheap ones within their limits, wrong ones missed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.scene import AugmentedLagrangian
from verification.contact import MOST_ITERATIONS, contactstudy
from verification.contacts import NORMAL
from verification.contacts.cylinders import wound
from verification.contacts.runs import DISCRETE, PLANE, SPACE, touch
from verification.contacttrials import CONTACT
from verification.references.contact import edges, solved_anew, touching, value, wound_evenly
from verification.references.contactposed import FALLS, POSED, WALLS, WOUND, quantities
from verification.references.contactrod import ANGLE, M, Y
from verification.report.misses import sentence

BY_NAME = {case.name: case for case in NORMAL}
ROPES = {case.name: case for case in CONTACT.cases if case.name.startswith("capstan")}
# Cases of a few milliseconds, and the first of their runs that are marked for quick reports.
CHEAP = [name for name in BY_NAME if not any(word in name for word in ("wall", "wound", "roller", "touchdown"))]
DEAR = sorted(BY_NAME.keys() - CHEAP)


def study(name, model, words=""):
    case = BY_NAME[name]
    run = next(run for run in case.runs if run.model == model and words in run.label)
    return contactstudy(case, run)


def test_names_are_unique_and_listed():
    assert len(BY_NAME) == len(NORMAL)
    assert len(set(CONTACT.names())) == len(CONTACT.names())
    assert {"contact:normal", "contact:line-load"} <= set(CONTACT.names())
    assert ("  contact:line-load", BY_NAME["contact-line-load"].title) in list(CONTACT.listing((CONTACT.name,)))


def test_every_case_is_taken_by_both_models():
    for case in NORMAL:
        assert {run.model for run in case.runs} == {"continuum", "discrete"}, case.name
        assert any(run.limit is not None or run.order is not None for run in case.runs)


def test_units_of_one_case_and_of_quick_runs():
    name = "contact-wall-beta10"
    found = list(CONTACT.units((CONTACT.asked_as(name),), quick=False))
    assert len(found) == len(BY_NAME[name].runs)
    assert {unit.topic for unit in found} == {"contact"}
    assert len({unit.parameters for unit in CONTACT.units((CONTACT.name,), quick=False)}) == len(
        list(CONTACT.units((CONTACT.name,), quick=False))
    )
    assert 0 < len(list(CONTACT.units((CONTACT.asked_as(name),), quick=True))) < len(found)


@pytest.mark.parametrize("model", ["continuum", "discrete"])
@pytest.mark.parametrize("name", CHEAP)
def test_limits_and_orders_of_cheap_cases(name, model):
    found = study(name, model)
    assert found.holds, found


@pytest.mark.slow
@pytest.mark.parametrize("model", ["continuum", "discrete"])
@pytest.mark.parametrize("name", DEAR)
def test_limits_and_orders_of_dear_cases(name, model):
    for run in BY_NAME[name].runs:
        if run.model == model:
            found = contactstudy(BY_NAME[name], run)
            assert found.holds, found


def test_an_elastica_on_a_wall_as_by_a_bvp_with_the_order_of_its_elements():
    """Lii: nodal values superconverge with 2k where a node lies at the edge of contact."""
    found = study("contact-wall-beta25", "continuum", "a node")
    assert found.holds
    assert found.order == pytest.approx(6.0, abs=0.5)


@pytest.mark.parametrize("model", ["continuum", "discrete"])
@pytest.mark.parametrize("beta", [1, 10])
def test_a_rigid_wall_is_found_in_few_iterations_a_step(beta, model):
    """By multipliers, on walls harder than any rod; 12 are asked of every case."""
    case = BY_NAME[f"contact-wall-beta{beta}-rigid"]
    run = next(run for run in case.runs if run.model == model and "multipliers" in run.label)
    (record,) = contactstudy(case, replace(run, levels=run.levels[1:2])).records
    assert record.failure is None
    assert record.cuts == 0
    assert record.iterations <= 6 * record.steps


@pytest.mark.parametrize(
    ("turn", "elements", "tolerance"), [("180", 300, 1e-8), ("180", 300, 1e-11), ("120", 400, 1e-11)]
)
@pytest.mark.parametrize("model", [PLANE, SPACE, DISCRETE], ids=lambda model: model.name)
def test_multipliers_are_found_on_fine_meshes(model, turn, elements, tolerance):
    """On walls so stiff that the round-off of positions is more of the forces than what ends an iteration elsewhere."""
    found = model.solve(wound(WOUND[turn], AugmentedLagrangian(1e8, tolerance)), elements)
    one = touch(found)
    pressed, gap = one.pressure[-1] > 0.0, one.gap[-1]
    assert np.abs(gap[pressed]).max() <= tolerance
    assert gap[~pressed].min() > -tolerance
    assert sum(log.cuts for log in found.log) == 0
    assert sum(log.iterations for log in found.log) <= 12 * len(found.log)


def test_a_wrong_reference_is_missed():
    case = BY_NAME["contact-v-45"]
    wrong = replace(case.reference, value=(1.001 * case.reference.value[0], *case.reference.value[1:]))
    assert not contactstudy(replace(case, reference=wrong), case.runs[0]).holds


def test_a_missing_order_is_missed():
    found = study("contact-wall-beta25", "continuum", "a node")
    assert not replace(found, least=found.order + 0.1).holds


def test_a_refused_level_does_not_hold():
    found = study("contact-v-45", "continuum")
    failed = replace(found.records[-1], failure="none found")
    assert not replace(found, records=(*found.records[:-1], failed)).holds


def test_many_iterations_a_step_are_missed():
    found = study("contact-v-45", "continuum")
    slow = replace(found.records[-1], iterations=round(MOST_ITERATIONS * found.records[-1].steps) + 1)
    beyond = replace(found, records=(*found.records[:-1], slow))
    assert not beyond.holds
    assert f"{slow.level} elements: 13.0 iterations a step, at most 12" in sentence(beyond)


def test_a_rope_pulled_again_is_cut_sooner_than_its_wall_is_softened():
    """Softer walls took 16 iterations a step: friction has a path, and shorter steps along it take fewer."""
    (run,) = (run for run in ROPES["capstan-loses-0.3-180-0.9"].runs if run.model == "discrete")
    found = run.solve(8)
    assert found.statistics.newton_iterations <= MOST_ITERATIONS * found.statistics.load_steps


def test_references_on_walls_that_yield_tend_to_those_on_rigid_ones():
    """To ε_N^−3/4, by which a point force sinks in; the moment of the lifted rod is exact, √(2 EI w h)."""
    for h in (1e-4, 0.05, 0.5):
        rigid = touching(f"Liib-touchdown-h{h:g}" if h > 1e-3 else "Liib-touchdown-h0.0001", "Mc", "F", "l")
        shear = rigid.value[2] - rigid.value[1]
        name = f"touchdown-h{h:g}"
        assert -value(name, "m0") == pytest.approx(rigid.value[0], rel=1e-3)
        assert -value(name, "n_y0") == pytest.approx(shear, rel=1e-3)
    for β in WALLS:
        rigid = value(f"Lii-wall-beta{β}", "F_wall")
        assert 2.0 * value(f"wall-beta{β}", "pressed") == pytest.approx(rigid, rel=1e-2)
    for turn, name in (("120", "Lib-stiffrod-F4.0-R1.0-EI1.0-120"), ("180", "Lib-stiffrod-F1.0-R1.0-EI1.0-180")):
        assert value(f"wound-{turn}", "n_x0") == pytest.approx(value(name, "T_contact"), rel=1e-4)


def test_energy_along_rods_over_cylinders():
    """Without friction T + m²/2EI − ε_N g²/2 is at the crest what it is at the end, F times the cosine left to it."""
    for turn, half in WOUND.items():
        T, m, y, θ = (value(f"wound-{turn}", name) for name in ("n_x0", "m0", "y0", "angle1"))
        kept = T + 0.5 * m**2 - 0.5 * half.eps_N * (half.radius - y) ** 2
        assert kept == pytest.approx(half.pull * np.cos(half.below + θ), rel=1e-11)


def test_the_even_part_lies_as_a_string_with_less_tension():
    """T/R but for what bending takes, EI/2R², and what the wall stores; process.md 6.8, C3."""
    T, p, gap = wound_evenly(1.0, 1e-4, 1e9, 1.0)
    assert T == pytest.approx(1.0 - 0.5e-4, rel=1e-8)
    assert p == pytest.approx(T / (1.0 + gap), rel=1e-14)
    assert gap == pytest.approx(-p / 1e9, rel=1e-9)


def test_the_bvp_against_the_tensionless_foundation():
    """Weitsman 1970, Hetényi 1946: contact ends at βs = π/2; slopes of 1e-4 leave linear theory exact to 1e-8."""
    closed = touching("Liii-tensionless", "beta_a", "wc_k_over_Pbeta", "Mc_beta_over_P", "end_slope_k_over_Pbeta2")
    found = POSED["tensionless"].solved()
    ours = (found.edges[0], -4e3 * found.start[Y], 1e3 * -found.start[M], 4e3 * found.end[ANGLE])
    assert np.abs(ours) == pytest.approx(closed.value, rel=1e-7)
    for name, number in quantities(found).items():
        assert value("tensionless", name) == pytest.approx(number, rel=1e-9, abs=1e-11)
    assert edges("tensionless") == pytest.approx(tuple(found.edges))


def test_balance_and_energy_of_lifted_rods():
    """∫ p is what the clamp leaves of the weight; m²/2EI = w (h − w/2ε_N), as T + m²/2EI − w y − ε_N g²/2 is kept."""
    for h, length, eps_N in FALLS:
        force, shear, m = (value(f"touchdown-h{h:g}", name) for name in ("pressed", "n_y0", "m0"))
        assert force - shear == pytest.approx(length, rel=1e-12)
        assert 0.5 * m**2 == pytest.approx(h - 0.5 / eps_N, rel=1e-9)


@pytest.mark.slow
def test_all_kept_references_are_found_anew():
    for name, entry in solved_anew().items():
        for key, number in entry["quantities"].items():
            assert value(name, key) == pytest.approx(number, rel=1e-8, abs=1e-9), (name, key)
