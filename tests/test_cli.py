"""The command `dolfinrod`: exit codes, files and words, the same on any number of ranks."""

from __future__ import annotations

import io
import json
import os
import sys
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

import dolfinrod as dr
from dolfinrod import cli
from dolfinrod.output import summary
from dolfinrod.progress import ProgressLine
from dolfinrod.scene import toml
from tests.conftest import world
from tests.output.results import MOVING, flight
from verification.progress import Progress

CANTILEVER = """
[section.strip]
EA = "1000 N"
GJ = 1.0
EI = "1 N*m**2"
rigid = ["shear", "extension"]

[[rods]]
straight = { length = "1 m" }
section = "strip"

[[supports]]
clamp = { at = "start" }

[[loads]]
point_force = { at = "end", force = [0, "-1 N", 0] }

[solve]
elements = 4
"""


@dataclass(frozen=True)
class Outcome:
    """What a command left: its exit code and what the one speaking rank wrote."""

    code: int
    out: str
    err: str


@pytest.fixture
def scene_file(shared_path):
    """A cantilever under a tip force as a file that every rank reads."""
    return text_file(shared_path / "scene.toml", CANTILEVER)


@pytest.fixture
def dolfinrod(capsys):
    """Runs the command on every rank; the others say nothing, and wait for the files of the first."""

    def command(*arguments: object) -> Outcome:
        try:
            code = cli.main([str(argument) for argument in arguments])
        except SystemExit as stop:
            code = stop.code
        said = capsys.readouterr()
        outcome = Outcome(code, said.out, said.err)
        comm = world()
        if comm is not None and comm.size > 1:
            assert comm.rank == 0 or (said.out, said.err) == ("", "")
            outcome = comm.bcast(outcome, root=0)
        return outcome

    return command


def text_file(path, text):
    """Write a file once and let every rank find it."""
    comm = world()
    if comm is None or comm.rank == 0:
        path.write_text(text, encoding="utf-8")
    if comm is not None:
        comm.barrier()
    return path


def test_record_on_disk_is_the_result(dolfinrod, scene_file, shared_path):
    done = dolfinrod("run", scene_file, "--degree", 2, "--out", shared_path / "out")
    assert (done.code, done.err) == (0, "")
    scene, options = toml.load(shared_path / "out" / "scene.toml")
    assert scene == toml.load(scene_file)[0]
    assert options == {"elements": 4, "degree": 2}
    result = dr.solve(scene, **options)
    record = json.loads((shared_path / "out" / "result.json").read_text(encoding="utf-8"))
    assert record["converged"]
    assert record["tip"] == pytest.approx(result.tip, abs=1e-14)
    assert record["log"][-1]["t"] == 1.0
    assert record["statistics"]["newton_iterations"] == result.statistics.newton_iterations
    assert record["formulation"]["kinematics"] == "planar"
    assert record["versions"]["numpy"] == np.__version__


def test_tables_hold_every_node_at_every_stored_time(dolfinrod, scene_file, shared_path):
    dolfinrod("run", scene_file, "--out", shared_path / "out")
    scene, options = toml.load(scene_file)
    rod = dr.solve(scene, **options).rods[0]
    table = np.genfromtxt(shared_path / "out" / "rod-0.csv", delimiter=",", names=True, deletechars="")
    n_t, n_s = rod.r.shape[:2]
    assert table.shape == (n_t * n_s,)
    columns = {"s_[m]": np.tile(rod.s, n_t), "y_[m]": rod.r[..., 1].ravel(), "d2x": rod.frames[..., 0, 1].ravel()}
    columns |= {"kappa3_[1/m]": rod.kappa[..., 2].ravel(), "n1_[N]": rod.n[..., 0].ravel()}
    for name, values in columns.items():
        np.testing.assert_allclose(table[name], values, atol=1e-12)


@pytest.mark.parametrize(("push", "said"), [(9.0, "; stable"), (11.0, "; unstable in 1 direction")])
def test_a_column_says_whether_it_stands(dolfinrod, shared_path, push, said):
    """Euler's load of a column on two pins is π² EI/L²; more than one step is listed."""
    scene = text_file(
        shared_path / "column.toml",
        f"""
        [section.s]
        rigid = ["extension", "shear"]
        GJ = "1 N m**2"
        EI = "1 N m**2"
        [[rods]]
        straight = {{ length = "1 m" }}
        section = "s"
        [[supports]]
        pin = {{ at = "start" }}
        [[supports]]
        guide = {{ at = "end", free = ["x", "ry", "rz"] }}
        [[loads]]
        point_force = {{ at = "end", force = ["{-push} N", "0 N", "0 N"] }}
        [motion.static]
        steps = 2
        """,
    )
    done = dolfinrod("run", scene, "--kinematics", "planar")
    first, _, head, *rows = done.out.splitlines()
    assert first.endswith(said)
    assert head.split() == ["step", "t", "iterations", "cuts", "state"]
    assert [row.split()[1] for row in (rows[0], rows[-1])] == ["0.5", "1"]
    assert rows[0].endswith("  stable")
    assert rows[-1].endswith(said.removeprefix("; "))


def test_both_models_are_written_side_by_side_and_agree(dolfinrod, scene_file, shared_path):
    done = dolfinrod("run", scene_file, "--model", "both", "--elements", 40, "--out", shared_path)
    assert done.code == 0
    tips = [
        json.loads((shared_path / model / "result.json").read_text(encoding="utf-8"))["tip"]
        for model in ("continuum", "discrete")
    ]
    np.testing.assert_allclose(*tips, atol=1e-3)
    assert "continuum: converged" in done.out
    assert "discrete: converged" in done.out


def test_what_converged_is_written_when_the_end_is_not_reached(dolfinrod, scene_file, shared_path, monkeypatch):
    import dolfinrod.continuum as continuum

    solve = continuum.solve

    def fails(scene, **options):
        result = replace(solve(scene, **options), converged=False)
        raise dr.NotConverged(result=result, t=0.5, step=0.1, reason="line search failed", advice="Try more steps")

    monkeypatch.setattr(continuum, "solve", fails)
    done = dolfinrod("run", scene_file, "--out", shared_path / "out")
    assert done.code == 1
    assert "line search failed. Try more steps" in done.err
    record = json.loads((shared_path / "out" / "result.json").read_text(encoding="utf-8"))
    assert not record["converged"]
    assert record["failure"] == {"t": 0.5, "step": 0.1, "reason": "line search failed", "advice": "Try more steps"}
    assert (shared_path / "out" / "rod-0.csv").exists()


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ('EI = "1 N*m**2"', 'EI = "-1 N*m**2"', "EI must be positive, got -1.0 N m²"),
        ('EI = "1 N*m**2"', 'EI = "1 N"', "EI"),
        ('at = "end"', "at = 2.0", "loads[0]"),
        ("[solve]", "[solves]", "solves"),
        ("elements = 4", "element = 4", "solve.element is unknown; known are elements, degree, kinematics"),
        ("elements = 4", "elements = 0", "elements"),
        ("elements = 4", 'kinematics = "flat"', "solve.kinematics must be planar or spatial, got 'flat'"),
        ("[[rods]]", "[[rods]", "TOML"),
    ],
)
def test_bad_scene_is_refused_in_one_line_and_nothing_is_written(dolfinrod, shared_path, old, new, complaint):
    file = text_file(shared_path / "bad.toml", CANTILEVER.replace(old, new))
    done = dolfinrod("run", file, "--out", shared_path / "out")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("dolfinrod: ")
    assert done.err.count("\n") == 1
    assert complaint in done.err
    assert not (shared_path / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--degree", "9"], "degree must be"),
        (["--degree", "two"], "--degree"),
        (["--elements", "4.5"], "--elements: must be a whole number or one a rod, such as 16 or 16,24, got 4.5"),
        (["--elements", "4,4"], "elements"),
        (["--kinematics", "flat"], "--kinematics"),
        (["--model", "discrete", "--degree", "2"], "--degree belongs to the continuum model"),
        (["--out", "/dev/null/out"], "--out /dev/null/out cannot be written"),
    ],
)
def test_bad_option_is_refused_in_one_line(dolfinrod, scene_file, arguments, complaint):
    done = dolfinrod("run", scene_file, *arguments)
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert complaint in done.err


def test_missing_file_and_folder_are_refused(dolfinrod, shared_path):
    absent = dolfinrod("run", shared_path / "absent.toml")
    assert (absent.code, absent.err.count("\n")) == (2, 1)
    assert "absent.toml cannot be read: No such file or directory" in absent.err
    assert dolfinrod("info", shared_path).code == 2


def test_info_names_versions_and_what_the_scene_holds(dolfinrod, scene_file):
    done = dolfinrod("info", scene_file)
    assert done.code == 0
    assert f"numpy {np.__version__}" in done.out
    for words in (
        "PETSc 3.",
        "rods[0]: ",
        "length 1 m",
        "Section(EA=",
        "supports[0]: Clamp",
        "loads[0]: PointForce",
    ):
        assert words in done.out
    assert "kinematics: planar, normal (0, 0, 1)" in done.out


@pytest.mark.serial
def test_verify_reports_what_was_asked_for_and_goes_on_where_it_was(dolfinrod, tmp_path):
    words = ("verify", "elastica-1", "--quick", "--out", tmp_path)
    first, again = dolfinrod(*words), dolfinrod(*words)
    assert (first.code, first.err) == (0, "")
    assert first.out == f"{tmp_path / 'index.html'}\n" == again.out
    assert "Elastica, PL²/EI = 1, inextensible" in (tmp_path / "index.html").read_text(encoding="utf-8")
    units = len(list((tmp_path / "finished").glob("*/*.json")))
    assert f"{units} of {units} results reused" in again.err
    assert "reused" not in dolfinrod(*words, "--fresh").err


@pytest.mark.serial
@pytest.mark.slow
def test_verify_with_two_jobs_finds_the_same(dolfinrod, tmp_path):
    words = ("verify", "elastica-1", "--quick", "--out", tmp_path, "--jobs", "2")
    done = dolfinrod(*words)
    assert done.code == 0
    first = errors_in(tmp_path)
    assert "results reused" not in done.err
    assert "results reused" in dolfinrod(*words).err
    assert dolfinrod(*words[:-2], "--fresh").code == 0
    assert errors_in(tmp_path) == first


def errors_in(folder):
    studies = json.loads((folder / "report.json").read_text())["studies"]
    return [(study["model"], [record["error"] for record in study["records"]]) for study in studies]


@pytest.mark.serial
def test_verify_lists_names_and_solves_nothing(dolfinrod, tmp_path):
    done = dolfinrod("verify", "--list", "roll*", "--out", tmp_path / "out")
    assert done.code == 0
    family, *members = done.out.splitlines()
    assert family.startswith("rollup: ")
    assert all(line.startswith("  rollup-") for line in members)
    assert not (tmp_path / "out").exists()


@pytest.mark.serial
@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["elastika-10"], "no case or family is called elastika-10; did you mean elastica-10"),
        (["--quik"], "--quik"),
        (["--out", "/dev/null/out"], "--out /dev/null/out cannot be written"),
    ],
)
def test_verify_refuses_in_one_line(dolfinrod, words, complaint):
    done = dolfinrod("verify", *words)
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert complaint in done.err


@pytest.mark.serial
def test_verify_interrupted_says_how_to_go_on(dolfinrod, tmp_path, monkeypatch):
    from verification import workoff

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(workoff, "work_off", interrupted)
    done = dolfinrod("verify", "elastica-1", "--out", tmp_path)
    assert (done.code, done.out) == (130, "")
    assert done.err.count("\n") == 1
    assert "the same command goes on from there" in done.err


@pytest.mark.serial
def test_verify_measures_one_thread(monkeypatch):
    began = []
    monkeypatch.setattr(sys, "argv", ["dolfinrod", "verify", "rollup", "--quick"])
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    monkeypatch.setattr(os, "execv", lambda _, words: began.append((words[1:], os.environ["OMP_NUM_THREADS"])))
    monkeypatch.setattr(cli, "verify", lambda _: 0)
    cli.main()
    assert began == [(["-m", "verification", "rollup", "--quick"], "1")]
    cli.main()
    assert len(began) == 1


def test_verify_is_for_one_rank(dolfinrod, monkeypatch):
    if world() is None or world().size == 1:
        monkeypatch.setattr(cli, "ranks", lambda: 2)
    done = dolfinrod("verify", "--list")
    assert done.code == 2
    assert "verify measures one process" in done.err


def test_progress_of_verify_tells_what_how_far_and_time_left(monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    seconds = iter([0.0, 8.0])
    terminal = Terminal()
    line = Progress(terminal, 4, clock=lambda: next(seconds))
    for done, recalled in enumerate([True, False, False]):
        line(done, SimpleNamespace(words=f"unit {done}"), recalled)
    line.clear()
    _, *shown, last = terminal.getvalue().split("\r\033[K")
    # One of the three was recalled, the other one solved by now took 8 s, two are left.
    assert shown == ["1 of 4: unit 0", "2 of 4: unit 1", "3 of 4, about 16 s left: unit 2"]
    assert (last, line.recalled) == ("", 1)


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self):
        return True


def test_progress_tells_step_load_iterations_and_time_left(monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    seconds = iter([0.0, 30.0, 90.0])
    terminal = Terminal()
    line = ProgressLine(terminal, name="continuum", clock=lambda: next(seconds))
    line(dr.StepLog(t=0.5, iterations=6, cuts=0, residual=1e-12, energy=1.0), 2.0)
    line(dr.StepLog(t=1.0, iterations=5, cuts=1, residual=1e-12, energy=2.0), 2.0)
    line.clear()
    _, begun, first, second, last = terminal.getvalue().split("\r\033[K")
    assert begun == "continuum: setting up"
    assert first == "continuum: step 1, t = 0.5 of 2 (25%), 6 iterations, about 1:30 min left"
    assert second == "continuum: step 2, t = 1 of 2 (50%), 11 iterations, about 1:30 min left"
    assert last == ""


def test_progress_in_time_is_in_seconds_and_no_faster_than_it_can_be_read(monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    seconds = iter([0.0, 1.0, 1.01, 1.02, 2.0])
    terminal = Terminal()
    line = ProgressLine(terminal, name="continuum", unit="s", clock=lambda: next(seconds))
    for k in range(1, 5):
        line(dr.StepLog(t=1e-3 * k, iterations=2, cuts=0, residual=1e-12, energy=1.0), 8e-3)
    _, _, first, last = terminal.getvalue().split("\r\033[K")
    assert first == "continuum: step 1, t = 0.001 of 0.008 s (12%), 2 iterations, about 7 s left"
    assert last == "continuum: step 4, t = 0.004 of 0.008 s (50%), 8 iterations, about 2 s left"


def test_summary_of_a_motion_is_in_seconds_and_energies():
    first, tip, energy, head, *rows = summary("continuum", flight()).splitlines()
    assert first.startswith(
        "continuum: converged at t = 2 s; planar, 30 unknowns; time steps: 16, Newton iterations: 48, "
    )
    assert "stab" not in "".join([first, *rows])
    assert tip.startswith("  tip (0.96017028")
    assert energy.startswith("  energy [J]: kinetic +0.002, strain +0.004, potential +0.006, load work +0.008")
    assert head.split() == ["step", "t", "[s]", "iterations", "cuts", "strain", "energy", "[J]"]
    assert rows[-1].split() == ["16", "2", "3", "0", "1"]


def test_a_motion_is_run_and_told_in_seconds(dolfinrod, shared_path, monkeypatch):
    import dolfinrod.continuum as continuum

    seen = []
    monkeypatch.setattr(continuum, "solve", lambda scene, **_: seen.append(scene) or flight())
    file = text_file(shared_path / "moving.toml", toml.dumps(MOVING))
    done = dolfinrod("run", file, "--out", shared_path / "out")
    assert (done.code, done.err) == (0, "")
    assert seen == [MOVING]
    assert "converged at t = 2 s" in done.out
    info = dolfinrod("info", file).out
    assert "motion: Dynamic(t_end=2.0, dt=0.125, scheme=Midpoint()" in info
    assert "velocities[0]: Velocity(v=(0.0, 1.0, 0.0)" in info


def test_a_motion_that_stops_says_when():
    failure = dr.NotConverged(result=flight(), t=0.5, step=0.125, reason="it blew up", advice="Try less")
    assert str(failure) == "no next state found beyond t = 0.5 s (last step tried 0.125 s): it blew up. Try less"


def test_progress_never_wraps_and_is_quiet_in_a_pipe(monkeypatch):
    monkeypatch.setenv("COLUMNS", "20")
    step = dr.StepLog(t=0.5, iterations=6, cuts=0, residual=1e-12, energy=1.0)
    terminal, pipe = Terminal(), io.StringIO()
    for stream in (terminal, pipe):
        ProgressLine(stream, name="continuum")(step, 1.0)
    assert max(len(text) for text in terminal.getvalue().split("\r\033[K")) == 19
    assert pipe.getvalue() == ""
