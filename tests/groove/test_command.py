"""`dolfinrod groove`: exit codes, words and files, going on after Ctrl-C, failures among others."""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, replace

import pytest

from dolfinrod import cli
from dolfinrod.cli import bundles
from dolfinrod.cli.watch import Watch
from dolfinrod.groove import Progress, Run, Scenario, toml
from dolfinrod.groove.clock import Job
from dolfinrod.result import NotConverged

pytestmark = pytest.mark.serial

BRIEF = """
fibres = 1
elements = 4
dt = "10 us"
output = "10 us"
t_end = "20 us"
"""


@dataclass(frozen=True)
class Outcome:
    """What a command left."""

    code: int
    out: str
    err: str


@pytest.fixture(autouse=True)
def no_page(monkeypatch):
    """Pages have tests of their own."""
    monkeypatch.setattr(bundles, "report", lambda folder: folder / "index.html")


@pytest.fixture
def groove(capsys):
    """Runs the command."""

    def command(*words: object) -> Outcome:
        try:
            code = cli.main(["groove", *(str(word) for word in words)])
        except SystemExit as stop:
            code = stop.code
        said = capsys.readouterr()
        return Outcome(code, said.out, said.err)

    return command


@pytest.fixture
def brief(tmp_path):
    """A scenario of a single fibre and two steps."""
    path = tmp_path / "brief.toml"
    path.write_text(BRIEF, encoding="utf-8")
    return path


def records(folder):
    """Finished runs by name."""
    return {path.name: path.read_bytes() for path in folder.glob("*.json") if path.name != "runs.json"}


def test_runs_are_kept_told_and_listed(groove, brief, tmp_path):
    out = tmp_path / "out"
    done = groove(brief, "--seeds", 2, "--out", out)
    assert done.code == 0
    lines = done.out.splitlines()
    assert lines[0].startswith("lateral, discrete: 2 of 2 runs finished; ")
    assert lines[1] == f"one row a run: {out / 'runs.csv'}"
    assert done.err.splitlines()[1].startswith("run 2 of 2: lateral, seed 1, discrete: finished in ")
    assert len(records(out)) == 2
    assert len((out / "runs.csv").read_text(encoding="utf-8").splitlines()) == 3


def test_a_second_time_nothing_is_solved_and_the_same_is_said(groove, brief, tmp_path, monkeypatch):
    words = (brief, "--seeds", 2, "--out", tmp_path / "out")
    first = groove(*words)
    monkeypatch.setattr(Scenario, "run", None)
    again = groove(*words)
    assert (again.code, again.out) == (0, first.out)
    assert again.err == "2 of 2 runs were finished before\n"


def test_both_systems_are_compared_with_the_yarns(groove, tmp_path):
    words = ("--fibres", 2, "--elements", 2, "--duration", "2us", "--seeds", 2, "--sweep", "fibres_touch=false")
    done = groove("both", *words, "--out", tmp_path)
    assert done.code == 0
    assert "lateral against intermediate, discrete: " in done.out
    assert "the yarns of Table 1 differ by +55.0 (46.3 to 63.7)" in done.out


def test_options_change_the_scenario(groove, brief):
    words = ("--fibres", 3, "--duration", "1 ms", "--variant", "L2", "--variant", "mirrored", "--sweep", "mu_wall=0.3")
    done = groove(brief, *words, "--toml")
    assert (done.code, done.err) == (0, "")
    found = toml.loads(done.out)
    assert (found.fibres, found.elements, found.t_end, found.mirrored) == (3, 4, 1e-3, True)
    assert found.wall_friction.mu == 0.3
    assert type(found.core).__name__ == "RollingCore"


def test_parameters_are_listed(groove):
    done = groove("--parameters")
    assert (done.code, done.err) == (0, "")
    assert "ends.tension" in done.out
    assert "Short names: angle = groove.beta_left" in done.out


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        ((), "which groove? Name both, lateral"),
        (("left",), "a groove must be both, lateral, intermediate, lateral_steep or a file FILE.toml, got 'left'"),
        (("absent.toml",), "absent.toml cannot be read: No such file or directory"),
        (("lateral", "--fibres", "0"), "fibres must be a whole number from 1 to 200"),
        (("lateral", "--duration", "6 kg"), "t_end must be a quantity in s, got '6 kg'"),
        (("lateral", "--seeds", "0"), "--seeds: must be a positive whole number, got 0"),
        (("lateral", "--variant", "L7"), "--variant"),
        (("lateral", "--sweep", "mu_wall"), "--sweep: must be a name and values, such as mu_wall=0.1,0.3,0.64"),
        (("lateral", "--sweep", "mu=0.1"), "--sweep must be the name of a parameter, got 'mu'"),
        (("lateral", "--sweep", "suction=-2600"), "LineSink.speed must lie between 0 and 200 m/s, got -2600.0 m/s"),
        (("lateral", "--sweep", "groove.fillet=5um"), "must be above"),
        (("lateral", "--model", "beam"), "--model"),
        (("lateral", "--out", "/dev/null/out"), "--out /dev/null/out cannot be written"),
    ],
)
def test_what_cannot_be_meant_is_refused_in_one_line(groove, words, complaint):
    done = groove(*words)
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert complaint in done.err


def test_a_file_that_cannot_be_meant_is_named(groove, brief):
    brief.write_text("fibers = 5", encoding="utf-8")
    done = groove(brief)
    assert (done.code, done.out) == (2, "")
    assert f"{brief}: fibers is unknown" in done.err


def test_a_run_that_fails_is_told_at_once_and_at_the_end_and_the_others_go_on(groove, brief, tmp_path, monkeypatch):
    solve = Scenario.run

    def sometimes(self, *given, **options):
        result = solve(self, *given, **options)
        if self.seed == 1:
            raise NotConverged(result=result, t=1e-5, step=1e-5, reason="a test", advice="None.")
        return result

    monkeypatch.setattr(Scenario, "run", sometimes)
    done = groove(brief, "--seeds", 3, "--out", tmp_path / "out")
    assert done.code == 1
    assert "2 of 3 runs finished" in done.out
    second, third, *_, last = done.err.splitlines()[1:]
    assert second.startswith("run 2 of 3: lateral, seed 1, discrete: failed at t = 0.01 ms")
    assert third.startswith("run 3 of 3: lateral, seed 2, discrete: finished")
    assert last.startswith("dolfinrod: failed: lateral, seed 1, discrete: NotConverged: no next state found")
    assert last.endswith(".json to try again)")


def test_interrupted_the_same_command_repeats_no_finished_run(groove, brief, tmp_path):
    out = tmp_path / "out"
    words = (brief, "--duration", "0.2 ms", "--seeds", 3, "--out", out)
    command = [sys.executable, "-m", "dolfinrod.cli", "groove", *(str(word) for word in words)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        while not (out.is_dir() and records(out)) and process.poll() is None:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        said, complaint = process.communicate()
    before = records(out)
    assert (process.returncode, said) == (130, "")
    assert 0 < len(before) < 3
    assert f"interrupted: {len(before)} of 3 runs finished, kept in {out}" in complaint
    assert "the same command goes on from there" in complaint
    again = groove(*words)
    assert (again.code, len(records(out))) == (0, 3)
    assert again.err.startswith(f"{len(before)} of 3 runs were finished before\n")
    assert {name: records(out)[name] for name in before} == before


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self):
        return True


def test_a_terminal_shows_the_run_at_hand_and_keeps_failures(monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    job = Job(Scenario(seed=3), "discrete")
    failed = Run("k", "lateral", 2, "discrete", {}, 7.0, "NotConverged: it blew up", 1e-3)
    fine = replace(failed, failed=None, t=6e-3, T_crossed=-1.5, wound=2)
    terminal, pipe = Terminal(), io.StringIO()
    for stream in (terminal, pipe):
        watch = Watch(stream)
        watch(Progress(1, 0, 20, 0.0, None))
        watch(Progress(1, 0, 20, 60.0, 90.0, doing=job, t=2.1e-3))
        watch(Progress(3, 1, 20, 60.0, 90.0, ended=(failed, fine)))
        watch.clear()
        assert watch.told == "3 of 20 runs finished"
    before, shown, kept, _ = (text for text in terminal.getvalue().replace("\r\033[K", "\r").split("\r")[1:])
    assert before == "1 of 20 runs were finished before\n"
    assert shown == "run 2 of 20, about 1:30 min left: lateral, seed 3, discrete, t = 2.100 of 6 ms"
    assert kept.startswith("run 2 of 20: lateral, seed 2, discrete: failed at t = 1 ms in 7 s of processor time: NotC")
    last = "run 3 of 20: lateral, seed 2, discrete: finished in 7 s of processor time, 2 wound pairs, -1.5 turns/m by "
    assert pipe.getvalue().splitlines()[-1].startswith(last)


def test_the_page_is_named_last(groove, brief, tmp_path):
    done = groove(brief, "--seeds", 1, "--out", tmp_path / "out")
    assert done.out.splitlines()[-1] == str(tmp_path / "out" / "index.html")


def test_long_commands_begin_on_one_thread(monkeypatch):
    began = []
    monkeypatch.setattr(sys, "argv", ["dolfinrod", "groove", "both"])
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    monkeypatch.setattr(os, "execv", lambda _, words: began.append((words[1:], os.environ["OMP_NUM_THREADS"])))
    monkeypatch.setattr(cli, "groove", lambda _: 0)
    cli.main()
    assert began == [(["-m", "dolfinrod.cli", "groove", "both"], "1")]


def test_a_record_on_disk_is_the_run(groove, brief, tmp_path):
    groove(brief, "--seeds", 1, "--out", tmp_path / "out")
    (text,) = records(tmp_path / "out").values()
    table = json.loads(text)
    assert (table["seed"], table["scenario"]["elements"], table["failed"]) == (0, 4, None)
