"""Hard motions: finished with a ledger that closes or refused in words; the ledger catches what blows up."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.result import StepLog
from dolfinrod.scene import Dynamic, ImplicitEuler, Midpoint
from verification.hardcases.motions import CASES
from verification.hardmotion import CLOSED, GAIN, LOSS, SOLVERS, MotionRow, books, hard_motion
from verification.patience import Patience
from verification.report.hardmotion import hard_motions
from verification.stepping import HARD_MOTION, units
from verification.whereabouts import At

pytestmark = pytest.mark.serial

BY_NAME = {case.name: case for case in CASES}
EULER, MIDPOINT = ImplicitEuler(), Midpoint()
NAMES = ("kinetic", "strain", "potential", "load work", "support work", "drag", "damping", "numerical")


def ledger(**entries: tuple[float, ...]) -> dict[str, np.ndarray]:
    """Entries that are named, zeros for the rest."""
    return {name: np.array(entries.get(name.replace(" ", "_"), (0.0, 0.0, 0.0))) for name in NAMES}


def test_names_are_unique():
    assert len(BY_NAME) == len(CASES)


def test_an_audit_finds_a_gap_a_loss_and_a_gain():
    sound = ledger(kinetic=(0.0, 1.0, 1.8), load_work=(0.0, 1.0, 2.0), numerical=(0.0, 0.0, -0.2))
    gap, lost, gained = books(sound)
    assert gap == pytest.approx(0.0, abs=1e-15)
    assert (lost, gained) == (pytest.approx(0.1), 0.0)
    gap, _, _ = books(sound | {"drag": np.array([0.0, 0.1, 0.2])})
    assert gap == pytest.approx(0.1)
    blown = ledger(kinetic=(1.0, 5.0, 0.5), numerical=(0.0, 4.0, -0.5))
    assert books(blown) == (pytest.approx(0.0, abs=1e-15), pytest.approx(0.5), pytest.approx(4.0))


def test_a_fall_counts_as_energy_that_went_in():
    fallen = ledger(potential=(0.0, -1.0, -2.0), kinetic=(0.0, 1.0, 1.9), numerical=(0.0, 0.0, -0.1))
    assert books(fallen)[1] == pytest.approx(0.05)


@pytest.mark.parametrize("name", ["step-1e-08", "massless-1e-06-0"])
@pytest.mark.parametrize("model", ["discrete", "continuum"])
def test_implicit_euler_says_what_it_took(name, model):
    row = hard_motion(BY_NAME[name], model, EULER)
    assert row.outcome == "damped"
    assert row.gap <= CLOSED
    assert row.gained == 0.0
    assert row.error <= 0.1
    assert row.lost > LOSS


def test_what_resolves_the_motion_finishes():
    row = hard_motion(BY_NAME["step-0.0001"], "continuum", MIDPOINT)
    assert (row.outcome, row.cuts, row.holds) == ("finished", 0, True)
    assert row.error <= BY_NAME["step-0.0001"].limit


def test_a_clean_ledger_and_another_end_are_wrong():
    elsewhere = replace(BY_NAME["step-0.0001"], check=At((9.0, 9.0, 9.0), (9.0, 9.0, 9.0), "elsewhere"))
    row = hard_motion(elsewhere, "continuum", MIDPOINT)
    assert (row.outcome, row.holds) == ("WRONG", False)
    assert "clean ledger" in row.reason
    assert "WRONG" in hard_motions((row,))


def test_a_scene_without_rotary_inertia_is_refused_in_words():
    row = hard_motion(BY_NAME["unsaid-rhoI"], "continuum", EULER)
    assert (row.outcome, row.steps, row.holds) == ("refused", 0, True)
    assert "rhoI must be given" in row.reason
    assert "rhoI must be given" in hard_motions((row,))


def test_a_motion_whose_steps_mostly_fail_is_stopped():
    patience = Patience(Dynamic(1.0, 0.02))
    for k in range(25):
        patience(StepLog(0.02 * k, 5, 2, 0.0, 0.0), 1.0)
    assert not patience.over
    with pytest.raises(KeyboardInterrupt):
        patience(StepLog(0.52, 5, 1, 0.0, 0.0), 1.0)
    assert patience.over


def test_a_quick_run_has_at_most_one_of_a_group_and_every_solver():
    chosen = [unit.parameters for unit in units((HARD_MOTION,), quick=True)]
    names = dict.fromkeys(name for name, _, _ in chosen)
    assert len({BY_NAME[name].group for name in names}) == len(names) >= 5
    assert len(chosen) == len(SOLVERS) * len(names)


def every_row(model: str, scheme: object) -> tuple[MotionRow, ...]:
    return tuple(hard_motion(case, model, scheme) for case in CASES)


@pytest.mark.slow
@pytest.mark.parametrize("model", ["discrete", "continuum"])
def test_implicit_euler_is_never_wrong(model):
    rows = every_row(model, EULER)
    assert [(row.case, row.outcome, row.reason) for row in rows if not row.holds] == []
    assert all(row.reason for row in rows if row.outcome == "refused")


@pytest.mark.slow
def test_the_ledger_catches_what_the_midpoint_rule_makes():
    """Whatever is wrong is known from the ledger alone, without any reference."""
    for row in every_row("continuum", MIDPOINT):
        assert row.gap <= CLOSED or row.steps == 0, row
        assert row.gained > GAIN or row.outcome != "WRONG", row


def test_every_model_and_scheme_is_tried():
    assert [(model, type(scheme).__name__) for model, scheme in SOLVERS] == [
        ("discrete", "ImplicitEuler"),
        ("continuum", "ImplicitEuler"),
        ("continuum", "Midpoint"),
    ]
