"""Other people's solvers: answers are taken as they are, refusals with their reason, absence said; none is needed."""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, replace

import numpy as np
import pytest

from verification.ledger import decode, encode
from verification.peers import environment, onestep, others, ours, race, rodothers, rodours, rods, rough, talk
from verification.peers.contest import TARGET, Attempt, Contender, Measured, Taker
from verification.peers.conversation import Refused, ask, ask_all
from verification.peers.environment import Environment, installed
from verification.peers.reference import PATHS
from verification.peers.roughothers import ROUGH_OTHERS
from verification.peers.roughours import ROUGH_OURS
from verification.peers.swing import SECTIONS, SWING, solution
from verification.references.moving import moving
from verification.report import peers, swing

pytestmark = pytest.mark.serial

OTHER = others.OTHERS[0]
QUESTION = {
    "module": "a",
    "package": "b",
    "pose": "swing",
    "problem": asdict(SWING),
    "settings": [{}],
    "repeats": 1,
    "budget": 1.0,
}
SECONDS = {"import": 0.5, "setup": 0.1, "first": 0.4, "solve": 0.25}


@pytest.fixture
def interpreter(tmp_path):
    """Makes an environment whose Python is a shell script."""

    def made(script: str) -> Environment:
        python = tmp_path / "bin" / "python"
        python.parent.mkdir(exist_ok=True)
        python.write_text(f"#!/bin/sh\n{script}\n")
        python.chmod(0o755)
        (tmp_path / "stamp").write_text("made\n")
        return installed(tmp_path)

    return made


def says(answer: dict) -> str:
    """A script that answers that."""
    return f"cat >/dev/null; echo '{json.dumps(answer)}'"


def answer(tip: np.ndarray) -> dict:
    return {"version": "1.2", "tip": tip.tolist(), "seconds": SECONDS}


def contender(ours: bool, *runs: tuple[float, float], absent: str = "") -> Contender:
    """Whose settings have these errors and seconds."""
    taker = Taker("Ours" if ours else "Theirs", ours, True, "rule", "element", "sheared")
    attempts = [Attempt("8", "1/100 s", Measured(e, e / 10, s, 0.1, 0.2, 100, "v 1")) for e, s in runs]
    return Contender("swing", taker, tuple(attempts), absent)


def test_an_answer_becomes_an_error_and_seconds(interpreter):
    off = solution("stretched") + np.linspace(0.0, 1e-3, 20)[::-1, None] * [0.0, 0.0, 1.0]
    found = others.others_measured(OTHER, interpreter(says(answer(off))), quick=True).attempts[0].found
    assert found.error == pytest.approx(1e-3)
    assert found.final == 0.0
    assert (found.solve, found.setup, found.version) == (0.25, 0.1, "exudyn 1.2")
    assert found.once == pytest.approx(0.5 + 0.4 - 0.25)


@pytest.mark.parametrize(
    ("script", "reason"),
    [
        (says({"refused": "ArithmeticError: unstable before t = 0.1 s"}), "unstable before t = 0.1 s"),
        ("echo Bus error >&2; exit 135", "exit code 135 and no answer, last words: Bus error"),
        ("echo hello", "exit code 0 and no answer, last words: nothing"),
        (says({"version": "1"}), "no answer"),
        (says(answer(np.zeros((3, 3)))), r"shape \(3, 3\), not \(20, 3\)"),
        (says(answer(np.full((20, 3), np.nan))), "diverged"),
        ("exec sleep 60", "no answer within 0.5 s"),
    ],
    ids=["refusal", "crash", "chatter", "half", "few", "nan", "silence"],
)
def test_whatever_is_no_answer_is_refused_with_the_reason(script, reason, interpreter):
    with pytest.raises(Refused, match=reason):
        ask(interpreter(script).python, QUESTION, patience=0.5 if "sleep" in script else 20.0)


def test_a_refusal_is_kept_with_its_reason_and_shown(interpreter):
    environment_ = interpreter(says({"refused": "no such rod"}))
    found = others.others_measured(OTHER, environment_, quick=True)
    assert [a.refused for a in found.attempts] == ["no such rod"]
    assert "refused: no such rod" in peers.contents((found,))


def test_an_interpreter_that_cannot_be_run_is_a_reason(tmp_path):
    with pytest.raises(Refused, match="cannot be run"):
        ask(tmp_path / "python", QUESTION)


def test_solvers_run_on_one_thread_and_leave_nothing_behind(interpreter, tmp_path, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    monkeypatch.chdir(tmp_path)
    python = interpreter("echo log >LOG; echo $OMP_NUM_THREADS $OPENBLAS_NUM_THREADS $NUMBA_NUM_THREADS >&2").python
    with pytest.raises(Refused, match="last words: 1 1 1"):
        ask(python, QUESTION)
    assert not (tmp_path / "LOG").exists()


def test_solvers_know_nothing_of_the_mpi_that_asks(interpreter, monkeypatch):
    """OpenSees brings an MPI of its own, which took what ours had left for its own and ended: refused on all meshes."""
    monkeypatch.setenv("PMIX_RANK", "0")
    monkeypatch.setenv("OMPI_COMM_WORLD_SIZE", "1")
    with pytest.raises(Refused, match=r"last words: \[\] \[\]"):
        ask(interpreter("echo [$PMIX_RANK] [$OMPI_COMM_WORLD_SIZE] >&2").python, QUESTION)


def at_once() -> int:
    """How many of the others are asked for whole loads, and by a quick report."""
    return sum(not others[0].relaxes for others in rodothers.together())


def test_without_them_the_race_is_run_and_says_so(tmp_path, monkeypatch):
    assert installed(tmp_path) is None
    monkeypatch.setattr(race, "installed", lambda: None)
    units = list(race.units((race.PEERS,), quick=True))
    absent = [unit.work() for unit in units if "absent" in unit.parameters]
    sliding = len(rough.ROUGH) * len(ROUGH_OTHERS)
    assert len(absent) == len(others.OTHERS) + (1 + len(rods.QUICK)) * at_once() + sliding
    found = [c for rows in absent for c in (rows if isinstance(rows, tuple) else (rows,))]
    assert all(c.absent == environment.ABSENT and not c.attempts for c in found)
    page = peers.contents((contender(True, (1e-4, 2.0)), *found))
    assert f"Nobody else took part: {environment.ABSENT}" in page
    assert f"Nobody else did: {environment.ABSENT}" in page


def test_what_was_absent_is_asked_again_once_it_is_there(monkeypatch, interpreter):
    def parameters() -> set:
        return {unit.parameters for unit in race.units((race.PEERS,), quick=False)}

    monkeypatch.setattr(race, "installed", lambda: None)
    absent = parameters()
    monkeypatch.setattr(race, "installed", lambda: interpreter("exit"))
    theirs = len(others.OTHERS) + len(rods.RODS) * len(rodothers.together()) + at_once()
    theirs += len(rough.ROUGH) * len(ROUGH_OTHERS)
    mine = sum(own.poses(rod) for own in rodours.ROD_OURS for rod in rods.RODS)
    assert len(absent - parameters()) == theirs
    assert len(absent) == theirs + mine + len(onestep.ONCE_OURS) + len(ours.OURS) + len(ROUGH_OURS)


def test_the_quickest_of_those_exact_enough_counts_and_nothing_between():
    c = contender(True, (2 * TARGET, 0.1), (0.9 * TARGET, 0.5), (0.1 * TARGET, 0.4), (0.01 * TARGET, 3.0))
    assert c.quickest().found.solve == 0.4
    assert c.quickest(final=True).found.solve == 0.1
    assert c.quickest(1e-3 * TARGET) is None
    assert c.nearest == pytest.approx(0.01 * TARGET)


def test_ratios_and_the_aim_are_told():
    found = (contender(True, (5e-4, 0.2)), contender(False, (5e-4, 0.8)), contender(False, (5e-2, 0.1)))
    page = peers.contents(found)
    assert "0.2 s per simulated second (Ours, sheared); the aim of 0.3 s is met" in page
    assert "quickest of the others is Theirs with 0.8 s" in page
    assert "4.0 ×" in page
    assert "not reached" in page
    assert "Among those who move in space, ours are ahead on P5 to 0.001 (4.0 ×)" in peers.verdict(found)
    assert peers.contents(()) == ""
    assert "missed" in swing.summary((contender(True, (5e-4, 0.4)),))


def test_contenders_survive_the_disk():
    c = contender(False, (1e-4, 0.3))
    c = replace(c, attempts=(*c.attempts, Attempt("8", "1/9 s", refused="unstable")))
    assert decode(json.loads(json.dumps(encode(c)))) == c


def test_the_other_end_times_and_answers(monkeypatch):
    """With the adapter a stand-in: set-up for every repeat, the first solve kept apart."""
    made = []

    def build(problem, settings):
        made.append(settings)
        return lambda: [[problem["g"], 0.0, 0.0]]

    adapter = type(sys)("stand_in")
    adapter.POSED = {"swing": build}
    monkeypatch.setitem(sys.modules, "stand_in", adapter)
    question = QUESTION | {"module": "stand_in", "package": "numpy", "repeats": 3}
    (found,) = talk.answers(question)
    assert found["tip"] == [[9.81, 0.0, 0.0]]
    assert found["version"] == np.__version__
    assert set(found["seconds"]) == set(SECONDS)
    assert made == [{}] * 3
    with pytest.raises(LookupError, match="does not pose other"):
        list(talk.answers(question | {"pose": "other"}))


def test_load_steps_are_the_fewest_that_find_the_equilibrium(monkeypatch):
    """One step fails, two find another equilibrium, three and four the one sought."""
    made = []

    def build(problem, settings):
        steps = settings["steps"]
        made.append(steps)

        def solve():
            if steps == 1:
                raise ArithmeticError("Newton's method failed")
            return [[0.0, 0.0, problem["y"] if steps > 2 else 5.0]]

        return solve

    adapter = type(sys)("stand_in")
    adapter.POSED = {"rod": build}
    monkeypatch.setitem(sys.modules, "stand_in", adapter)
    setting = {"ladder": [1, 2, 3, 4, 6], "near": [0.0, 0.0, 1.0], "within": 0.1, "problem": {"y": 1.05}}
    hopeless = setting | {"ladder": [1, 2]}
    question = QUESTION | {"module": "stand_in", "package": "numpy", "pose": "rod", "settings": [setting, hopeless]}
    found, refused = talk.answers(question)
    assert found["steps"] in (3, 4)
    assert found["tip"] == [[0.0, 0.0, 1.05]]
    assert made[:4] == [1, 2, 3, 4]
    assert refused["refused"] == "not in 1, 2 load steps; in the last, the tip ends 4 m from where it should"


def test_settings_that_follow_a_death_are_asked_again(interpreter, tmp_path):
    """The first process answers once and dies, the second answers the rest."""
    line = json.dumps(answer(solution("stretched")))
    (tmp_path / "line").write_text(line + "\n")
    here = tmp_path / "line"
    script = f"cat >/dev/null; cat {here}; if [ -e {tmp_path}/again ]; then cat {here}; else touch {tmp_path}/again; "
    python = interpreter(script + "echo Bus error >&2; exit 135; fi").python
    found = ask_all(python, QUESTION | {"settings": [{}] * 4}, patience=20.0)
    assert [isinstance(one, Refused) for one in found] == [False, True, False, False]
    assert "Bus error" in str(found[1])


def test_a_refusal_that_ends_the_process_counts_once(interpreter):
    python = interpreter(says({"refused": "ImportError: none", "ended": True}) + "; exit 1").python
    found = ask_all(python, QUESTION | {"settings": [{}] * 2}, patience=20.0)
    assert [str(one) for one in found] == ["ImportError: none"] * 2


def test_the_other_end_refuses_in_words_when_it_fails():
    """In this interpreter the solvers are missing: the way a half-made environment fails."""
    question = QUESTION | {"module": "verification.peers.exudyn", "package": "exudyn"}
    with pytest.raises(Refused, match="ModuleNotFoundError: No module named 'exudyn'"):
        ask(environment.Path(sys.executable), question)


@pytest.mark.parametrize(("assumes", "id"), [("stretched", "P5-eb"), ("sheared", "P5-se")])
def test_the_reference_ends_where_other_solvers_converge(assumes, id):
    np.testing.assert_allclose(solution(assumes)[-1], moving(id, "x", "y", "z").value, atol=2e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("assumes", "degree"), [("sheared", 10), ("stretched", 6), ("rigid", 8)])
def test_the_reference_is_recomputed(assumes, degree):
    """On fewer polynomials than it was tabulated with: 1e-4 is a tenth of what solvers are asked for."""
    np.testing.assert_allclose(PATHS[assumes](degree), solution(assumes)[:, :2], atol=1e-4)


def test_everybody_is_asked_for_the_same_problem():
    assert {t.taker.assumes for t in (*others.OTHERS, *ours.OURS)} == set(SECTIONS)
    assert {o.taker.implicit for o in others.OTHERS} == {True, False}
    for section in SECTIONS.values():
        assert section.rhoA == SWING.rhoA
        assert section.EI == (SWING.EI, SWING.EI)
    assert SECTIONS["sheared"].GA == (SWING.GA, SWING.GA)
    assert SECTIONS["sheared"].rhoI[1:] == (SWING.rhoI, SWING.rhoI)


@pytest.mark.slow
@pytest.mark.parametrize("other", others.OTHERS, ids=lambda other: other.taker.name)
def test_the_real_ones_solve_it_where_they_are_installed(other):
    """Quick settings: within a hundredth of the length, or absent and saying so."""
    found = others.others_measured(other, installed(), quick=True)
    if not found.absent:
        assert [a.refused for a in found.attempts] == [""]
        assert found.nearest < 1e-2


@pytest.mark.slow
@pytest.mark.parametrize("own", ours.OURS, ids=lambda own: f"{own.taker.name}, {own.taker.assumes}")
def test_our_models_solve_it(own):
    """Second order within 1e-3 by the first setting of the sweep, backward Euler within a fifth of the length."""
    found = ours.ours_measured(own, quick=True)
    assert [a.refused for a in found.attempts] == [""]
    assert found.nearest < (TARGET if "midpoint" in own.taker.name else 0.2)
