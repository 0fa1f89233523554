"""Motions against references: structure of the cases, what they find, and that what is wrong is missed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.scene import Midpoint, Planar
from verification import motiontrials
from verification.drift import KEPT, STEPPERS, driftstudy
from verification.frequency import frequency, frequencystudy
from verification.ledger import decode, encode
from verification.motion import extrapolated, motionstudy, self_order
from verification.motions import CASES, VIBRATIONS, swing
from verification.pace import PACES, pace
from verification.references.lines import Thick, Thin, lobatto
from verification.references.moving import moving
from verification.references.wind import Fibre
from verification.report.misses import sentence
from verification.report.motion import contents, studies
from verification.report.motiontables import drifts, frequencies, paces
from verification.stepper import ContinuumStepper

pytestmark = pytest.mark.serial

BY_NAME = {case.name: case for case in CASES}
VIBRATING = {case.name: case for case in VIBRATIONS}
PLANE = Planar((0.0, 0.0, 1.0))
CHEAP = ("motion-falling-onset", "motion-falling")


def by_model(name: str, model: str):
    """A run of a case."""
    return next(run for run in BY_NAME[name].runs if run.stepper.name == model)


def test_names_are_unique_and_known():
    assert len(BY_NAME) + len(VIBRATING) == len(CASES) + len(VIBRATIONS)
    assert len(set(motiontrials.names())) == len(motiontrials.names())


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_every_case_is_posed_as_its_runs_need(case):
    """Steps in one ratio where an order is sought, a reference of as many numbers as are read off."""
    assert case.runs
    for run in case.runs:
        ratios = np.array(run.steps[1:]) / np.array(run.steps[:-1])
        assert not run.ordered or (len(run.steps) >= 3 and np.ptp(ratios) == 0.0)
        assert run.ordered or run.limit is not None or len(run.steps) > 1
        scene = case.scene(run.stepper.motion(case.t_end, run.steps[0], (case.t_end,)))
        assert scene.motion.t_end == case.t_end


def test_all_is_planned_once_and_a_quick_run_is_part_of_it():
    for quick in (False, True):
        units = list(motiontrials.units((motiontrials.MOTION,), quick=quick))
        assert len({(unit.topic, unit.parameters) for unit in units}) == len(units)
    assert not list(motiontrials.units((), quick=False))
    only = list(motiontrials.units(("motion-sag",), quick=False))
    assert {unit.parameters[0] for unit in only} == {"motion-sag"}
    assert [words for name, words in motiontrials.listing(("motion-sag",)) if "sag" in name] == [
        BY_NAME["motion-sag"].title
    ]


@pytest.mark.parametrize("name", CHEAP)
def test_limits_and_orders_of_cheap_cases(name):
    for run in BY_NAME[name].runs:
        study = motionstudy(BY_NAME[name], run)
        assert study.holds, sentence(study)
        assert decode(encode(study)) == study
        assert study.title in studies((study,))


def test_the_pulse_to_a_millionth_and_with_second_order():
    case = BY_NAME["motion-pulse-cantilever"]
    study = motionstudy(case, by_model(case.name, "continuum midpoint"))
    assert study.holds
    assert study.rest <= 1e-6
    assert study.order == pytest.approx(2.0, abs=0.1)


def test_a_wrong_reference_is_missed():
    case = BY_NAME["motion-falling"]
    wrong = replace(case, reference=replace(case.reference, value=(1.001 * case.reference.value[0],)))
    study = motionstudy(wrong, by_model(case.name, "discrete Euler"))
    assert not study.holds
    assert "1.0e−3 off, at most 1e−5" in sentence(study)


def test_a_wrong_order_is_missed():
    """What is extrapolated with another power is off by more than the limit, and the order says so."""
    case = BY_NAME["motion-falling-onset"]
    study = motionstudy(case, by_model(case.name, "discrete Euler"))
    assert not replace(study, theory=2).holds


def test_extrapolation_and_order_of_a_known_error():
    steps = (10, 20, 40)
    found = [np.array([1.0 + 3.0 / n**2, 2.0 - 1.0 / n**2]) for n in steps]
    assert self_order(found, steps) == pytest.approx(2.0)
    assert extrapolated(found, 2, 2.0) == pytest.approx([1.0, 2.0], abs=1e-14)


def test_the_matrix_pencil_tells_the_strongest_of_two_damped_vibrations():
    t = 0.05 * np.arange(80)
    signal = np.exp(-0.1 * t) * np.sin(3.0 * t + 0.3) + 0.2 * np.exp(-2.0 * t) * np.cos(11.0 * t)
    assert frequency(signal, 0.05) == pytest.approx(3.0, rel=1e-9)
    assert np.isnan(frequency(np.exp(-t), 0.05))


def test_ratios_of_the_papers_masses_in_time():
    """process.md 1.5, n = 8 and 20; its end masses make a rod too slow by far more."""
    case = VIBRATING["motion-vibration-cantilever-1"]
    half, paper = (model for model in case.models if model.steppers[0].family == "discrete")
    few = [replace(m, steppers=m.steppers[:2], meshes=m.meshes[:2], ratios=m.ratios[:2]) for m in (half, paper)]
    study, heavy = (frequencystudy(case, model) for model in few)
    assert study.holds
    assert study.apart < 1e-5
    assert (np.array(heavy.errors) > 10.0 * np.array(study.errors)).all()
    assert "0.9899, 0.9984" in frequencies((study, heavy))
    assert not replace(study, ratios=(0.99, 0.9984)).holds


def test_a_free_rod_keeps_what_its_scheme_keeps():
    midpoint, euler = (driftstudy(stepper, 0.2, (100, 200)) for stepper in (STEPPERS[0], STEPPERS[2]))
    assert midpoint.holds
    assert max(midpoint.angular) <= KEPT
    assert euler.holds
    assert max(euler.angular) > KEPT
    assert not replace(midpoint, angular=euler.angular).holds
    assert midpoint.mesh in drifts((midpoint, euler))
    assert decode(encode(midpoint)) == midpoint


def test_milliseconds_a_step_stand_beside_their_aim():
    row = pace(PACES[0], 2)
    assert row.ms > 0.0
    assert row.iterations >= 1.0
    assert "one fibre" in paces((row,))


def test_a_page_without_motions_has_no_section():
    class Nothing:
        moved = frequencies = drifts = fibres = paces = ()

    assert contents(Nothing()) == {}


def test_lobatto_derives_polynomials():
    s, w, D = lobatto(5)
    assert w.sum() == pytest.approx(1.0)
    assert D @ s**5 == pytest.approx(5.0 * s**4, abs=1e-12)
    assert w @ s**9 == pytest.approx(0.1)


def test_drag_of_the_reference_is_that_of_the_design():
    """process.md 2.4, table: f_n and f_t at 0.1, 1 and 10 m/s."""
    fibre = Fibre(diameter=2e-5, mass=4.83805e-7, EA=10.7627, EI=2.690683e-10, length=0.04)
    v = np.array([0.1, 1.0, 10.0])
    f_n, f_t = fibre.drag(v, v)
    assert f_n == pytest.approx([5.64e-6, 1.081e-4, 3.046e-3], rel=1e-3)
    assert f_t == pytest.approx([3.21e-6, 6.29e-5, 1.454e-3], rel=1e-3)
    assert fibre.terminal_speed() == pytest.approx(0.08695, abs=5e-6)


@pytest.mark.slow
def test_kept_tips_are_found_anew():
    """On coarser polynomials; and the pulse of K10, which others computed."""
    thin = Thin(1e4).tip(swing.pushed_forces, 1.0, degree=10, tol=1e-9)
    assert thin == pytest.approx(moving("aside-thin").value, abs=5e-6)
    section = {"C_n": (1200.0, 400.0, 400.0), "C_m": (0.8, 1.0, 1.0), "J": (2 / 1200, 1 / 1200, 1 / 1200)}
    tip = Thick(**section, clamped=True).tip(
        lambda t: (np.zeros(3), np.array([0.0, 6.0 * np.sin(np.pi * t / 0.8) ** 4, 0.0])), 0.4, degree=12, tol=1e-9
    )
    assert tip[:2] == pytest.approx(moving("K10-cantilever", "x1@0.4", "y1@0.4").value, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["motion-aside-thick", "motion-pendulum-90-at-the-bottom", "motion-sag"])
def test_limits_of_dearer_cases(name):
    study = motionstudy(BY_NAME[name], BY_NAME[name].runs[0])
    assert study.holds, sentence(study)


def test_the_same_mesh_in_words():
    assert ContinuumStepper(Midpoint(), 4, 3, PLANE).mesh == "4 × P3 planar"
