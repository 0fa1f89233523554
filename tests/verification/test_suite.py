"""What is asked for is planned, what is planned is done once, and a run that was stopped goes on."""

from __future__ import annotations

import json
import signal
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dolfinrod.scene import SceneError
from verification import cases, eigencases, hardcases, ledger
from verification.interrupt import Interrupt
from verification.ledger import Ledger, Unit, decode, encode
from verification.machine import this_machine
from verification.order import Order
from verification.plan import LAWS, families, headlines, known, plan, selected
from verification.shape import Shape
from verification.suite import report
from verification.trials import APART
from verification.workoff import Spent, spent, work_off
from verification.workprecision import Record, Study, Timing

pytestmark = pytest.mark.serial

MACHINE = this_machine()
NUMBERS = st.floats(allow_nan=False)
TRIALS = ("critical", "bracket", "hard", "largest", "fewest")
TIMING = Timing(3, solve=5.0, solve_min=4.5, setup=3.0, call=9.0, call_min=8.0, compile=2000.0)


def study(error: float = 1e-9) -> Study:
    record = Record("a", "continuum P3 planar", "continuum", 8, error, None, 300, 5, 1, (1.0, 2.0, 0.0), 0.0, TIMING)
    return Study("a", "A", "continuum P3 planar", "continuum", 3, (record,), Order(None, 6, None, np.nan), None)


def unit(name: str, work) -> Unit:
    return Unit("study", name, (name, 8), work)


def test_every_family_has_one_headline_its_own():
    of_family = {case.name: case.family for case in cases.CASES}
    assert [of_family[name] for name in headlines()] == list(families())
    assert set(cases.HEADLINES) <= set(headlines())


def test_all_is_planned_and_nothing_twice():
    for quick in (False, True):
        units = plan(selected(()), quick=quick)
        identities = [(unit.topic, unit.parameters) for unit in units]
        assert len(set(identities)) == len(identities)
        named = {unit.parameters[0] for unit in units if unit.topic == "study"}
        assert named == {case.name for case in cases.CASES}


def test_every_case_is_studied_on_three_meshes_by_every_model_that_poses_it():
    units = [unit for unit in plan(selected(()), quick=False) if unit.topic == "study"]
    for case in cases.CASES:
        of_case = [unit.parameters for unit in units if unit.parameters[0] == case.name]
        assert all(len(parameters) - 3 >= 3 for parameters in of_case)
        assert {str(parameters[1]).partition(" ")[0] for parameters in of_case} == set(case.models)


def test_names_stand_for_cases_families_and_wildcards():
    assert selected(()) == tuple(name for name in known() if name not in APART)
    assert selected(("elastica-10",)) == ("elastica-10",)
    assert "rollup-5" in selected(("roll*",))
    assert {unit.parameters[0] for unit in plan(selected(("rollup",)), quick=True) if unit.topic == "study"} == {
        case.name for case in cases.rollup.CASES
    }
    assert {unit.topic for unit in plan(selected((LAWS,)), quick=True)} == {"law"}
    assert {unit.topic for unit in plan(selected(("columns",)), quick=True)} == {"critical", "bracket"}
    assert {unit.parameters for unit in plan(selected(("hard:mesh-1",)), quick=True)} == {
        ("mesh-1", "continuum"),
        ("mesh-1", "discrete"),
    }


def test_no_name_stands_for_two_things():
    assert len(set(known())) == len(known())


def test_all_trials_are_planned_and_a_few_of_every_kind_in_a_quick_run():
    everything, few = (
        {kind: [u.parameters for u in plan(selected(()), quick=quick) if u.topic == kind] for kind in TRIALS}
        for quick in (False, True)
    )
    assert {parameters[0] for parameters in everything["critical"]} == {case.name for case in eigencases.CASES}
    assert {parameters[0] for parameters in everything["hard"]} == {case.name for case in hardcases.CASES}
    for kind in TRIALS:
        assert few[kind]
        assert {parameters[:2] for parameters in few[kind]} <= {parameters[:2] for parameters in everything[kind]}
    names = {parameters[0] for parameters in few["hard"]}
    assert {case.group for case in hardcases.CASES if case.name in names} == {case.group for case in hardcases.CASES}


def test_a_name_that_stands_for_nothing_is_refused_with_those_that_look_like_it():
    with pytest.raises(SceneError, match=r"no case or family is called elastika-10; did you mean elastica-10"):
        selected(("elastika-10",))
    with pytest.raises(SceneError, match="--list"):
        selected(("zzzzzzzz",))


def test_finished_units_are_recalled_and_the_rest_is_done(tmp_path):
    done = []

    def work(name):
        done.append(name)
        return study()

    def interrupted():
        raise KeyboardInterrupt

    units = [unit("first", lambda: work("first")), unit("second", interrupted)]
    with pytest.raises(KeyboardInterrupt):
        work_off(units, Ledger(tmp_path, MACHINE))
    recalled = []
    units[1] = unit("second", lambda: work("second"))
    rows = work_off(units, Ledger(tmp_path, MACHINE), lambda _, unit, known: recalled.append((unit.words, known)))
    assert done == ["first", "second"]
    assert recalled == [("first", True), ("second", False)]
    assert [row.records[0].timing for row in rows["study"]] == [TIMING, TIMING]
    work_off(units, Ledger(tmp_path, MACHINE, fresh=True))
    assert done == ["first", "second", "first", "second"]


@pytest.mark.parametrize("fresh", [False, True])
def test_runs_of_a_unit_that_have_ended_outlast_its_interruption(fresh, tmp_path):
    """They are found again, but where all is done afresh; nothing is left of them once the unit is whole."""
    done = []

    def work(folder):
        folder.mkdir(exist_ok=True)
        for run in ("first", "second"):
            if not (folder / run).exists():
                done.append(run)
                if len(done) == 2:
                    raise KeyboardInterrupt
                (folder / run).touch()
        return study()

    units = [Unit("study", "many", ("many", 8), work, in_parts=True)]
    with pytest.raises(KeyboardInterrupt):
        work_off(units, Ledger(tmp_path, MACHINE))
    work_off(units, Ledger(tmp_path, MACHINE, fresh=fresh))
    assert done == ["first", "second", *(["first"] if fresh else []), "second"]
    assert Ledger(tmp_path, MACHINE).recall(units[0]) is not None
    assert not [path for path in tmp_path.glob("*/*") if path.is_dir()]


def test_ctrl_c_that_a_solver_takes_for_a_failure_is_not_lost(tmp_path):
    """Nor is the unit kept that it disturbed."""

    def disturbed():
        with suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        return study()

    book = Ledger(tmp_path, MACHINE)
    with pytest.raises(KeyboardInterrupt), Interrupt() as interrupt:
        work_off([unit("first", disturbed)], book, interrupt=interrupt)
    assert book.recall(unit("first", disturbed)) is None
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.parametrize("change", ["machine", "source", "parameters"])
def test_what_numbers_depend_on_is_part_of_their_name(change, tmp_path, monkeypatch):
    kept = unit("first", lambda: study())
    Ledger(tmp_path, MACHINE).keep(kept, (study(),))
    assert Ledger(tmp_path, MACHINE).recall(kept) is not None
    machine = MACHINE
    if change == "machine":
        machine = replace(MACHINE, versions={**MACHINE.versions, "numpy": "0"})
    if change == "source":
        monkeypatch.setattr(ledger, "source_hash", lambda: "other")
    if change == "parameters":
        kept = replace(kept, parameters=("first", 16))
    (tmp_path / "mine").mkdir()
    assert Ledger(tmp_path, machine).recall(kept) is None
    # What another source found is thrown away, what is not a ledger's is let alone.
    assert len(list(tmp_path.glob("*/*.json"))) == (change == "parameters")
    assert (tmp_path / "mine").exists()


def test_what_the_suite_took_is_kept_with_the_rows(tmp_path):
    """Also when a later run recalls them; of what was not done there is nothing."""
    book, units = Ledger(tmp_path, MACHINE), [unit("first", study), unit("second", study)]
    for k, one in enumerate(units):
        book.keep(one, (study(),), 1.0 + k)
    (row,) = spent(units, Ledger(tmp_path, MACHINE))
    assert row == Spent("study", 2, 3.0, "second", 2.0)
    assert book.seconds(unit("third", study)) == 0.0
    rows, seconds = units[0].done(tmp_path)
    assert rows == (study(),)
    assert seconds > 0.0


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"rows": 1}', '{"rows": [{"kind": "Study"}]}', '{"rows": [{"kind": "os"}]}']
)
def test_a_spoilt_file_counts_as_none(text, tmp_path):
    kept = unit("first", lambda: study())
    book = Ledger(tmp_path, MACHINE)
    book.keep(kept, (study(),))
    (file,) = tmp_path.glob("*/*.json")
    file.write_text(text, encoding="utf-8")
    assert book.recall(kept) is None


@given(error=st.one_of(NUMBERS, st.just(np.inf)), x=NUMBERS)
def test_records_survive_the_disk(error, x):
    shape = Shape("a", (np.array([[x, 0.0, 1.0]]),), (), (), (), (x, 0.0, 0.0))
    text = json.dumps(encode((study(error), shape)), allow_nan=False)
    back, line = decode(json.loads(text))
    assert replace(back, tip=None) == replace(study(error), tip=None)
    assert np.isnan(back.tip.worst)
    np.testing.assert_array_equal(line.stress_free[0], shape.stress_free[0])
    assert line.reference == shape.reference


def test_a_family_nobody_has_named_is_reported_like_any_other(monkeypatch):
    """Nothing in plan and report lists families: one case more, in a family of its own, is all there is to add."""
    stranger = replace(cases.elastica.inextensible(10.0), name="stranger-1", title="A stranger", family="strangers")
    more = (*cases.CASES, stranger)
    for module in ("verification.cases", "verification.suite", "verification.checks"):
        monkeypatch.setattr(f"{module}.CASES", more)
    assert families()[-1] == "strangers"
    assert headlines()[-1] == "stranger-1"
    found = report({}, selected(("strangers",)), MACHINE, quick=True)
    assert [s.title for s in found.statements] == ["A stranger"]
