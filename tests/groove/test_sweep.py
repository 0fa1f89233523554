"""Sweeps, their rows, what they say in words, and how far they are."""

from __future__ import annotations

import csv
import json
import signal
from dataclasses import replace
from itertools import product

import pytest

from dolfinrod.groove import Ensemble, Run, Scenario, ensemble, grid, rows, sweep, variant, varied, write_rows
from dolfinrod.groove.clock import Clock, Job
from dolfinrod.groove.closing import closing, groups
from dolfinrod.groove.described import described, key
from dolfinrod.groove.runs import Folder
from dolfinrod.groove.sweep import value
from dolfinrod.result import NotConverged, StepLog
from dolfinrod.scene import SceneError
from tests.conftest import world

BRIEF = Scenario(fibres=1, elements=4, t_end=2e-5, dt=1e-5, output=1e-5)


def run(scenario: Scenario, model: str = "discrete", **measures) -> Run:
    """A finished run as it is kept."""
    blank = Run(key(scenario, model, None), scenario.kind, scenario.seed, model, described(scenario), 1.0, None, 6e-3)
    n = scenario.fibres
    return replace(blank, winding=((0.0,) * n,) * n, **measures)


def test_a_grid_has_every_combination_and_the_last_varies_fastest():
    found = grid(Scenario(), {"mu_wall": (0.1, 0.64), "ends.tension": (1e-4, 2e-4, 5e-4)})
    assert [(s.wall_friction.mu, s.ends.tension) for s in found] == [*product((0.1, 0.64), (1e-4, 2e-4, 5e-4))]
    assert grid(Scenario(), {}) == (Scenario(),)


@pytest.mark.parametrize(
    ("name", "text", "number", "changed"),
    [
        ("angle", "30deg", 0.5235987755982988, lambda s: s.section.beta_left),
        ("mu_wall", "0.3", 0.3, lambda s: s.wall_friction.mu),
        ("mu_ff", "0", 0, lambda s: s.fibre_friction.mu),
        ("suction", "30 m/s", 30.0, lambda s: s.air.speed),
        ("tension", "0.2mN", 2e-4, lambda s: s.ends.tension),
        ("offset", "-1 mm", -1e-3, lambda s: s.bundle.offset),
        ("fibres", "7", 7, lambda s: s.fibres),
        ("ends.exit", "held", "held", lambda s: s.ends.exit),
        ("bundle.offset", "none", None, lambda s: s.bundle.offset),
        ("fibres_touch", "false", False, lambda s: s.fibres_touch),
    ],
)
def test_what_researchers_sweep_has_a_name_and_units(name, text, number, changed):
    assert value(name, text) == number
    (found,) = grid(Scenario(), {name: (value(name, text),)})
    assert changed(found) == number


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("tensoin", "1", "must be the name of a parameter, got 'tensoin'; did you mean tension"),
        ("tension", "1 m", "tension must be a quantity in N, got '1 m'"),
    ],
)
def test_what_cannot_be_swept_is_refused_in_words(name, text, words):
    with pytest.raises(SceneError, match=words):
        value(name, text)


def test_a_sweep_lists_its_runs(shared_path):
    found = sweep(BRIEF, {"tension": (1e-4, 2e-4)}, folder=shared_path, seeds=(3,))
    assert [r.scenario["ends"]["tension"] for r in found.runs] == [1e-4, 2e-4]
    comm = world()
    if comm is not None:
        comm.barrier()
    listed = json.loads((shared_path / "runs.json").read_text(encoding="utf-8"))
    assert [row["ends.tension"] for row in listed["runs"]] == [1e-4, 2e-4]
    with (shared_path / "runs.csv").open(encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    assert [float(row["ends.tension [N]"]) for row in table] == [1e-4, 2e-4]
    assert {row["seed"] for row in table} == {"3"}
    assert float(table[0]["T_pair [turns/m]"]) == 0.0
    assert float(table[0]["seconds [s]"]) > 0.0


def test_rows_have_all_parameters_and_measures_under_the_same_names(tmp_path):
    base = Scenario()
    failed = replace(run(variant(base, "L2")), failed="NotConverged: …", t=1e-3)
    table = rows([run(base, T_pair=3.0, wound=2), failed])
    assert table[0].keys() == table[1].keys()
    assert (table[0]["core"], table[1]["core"]) == ("FixedCore", "RollingCore")
    assert (table[0]["core.fibres"], table[1]["core.fibres"]) == (None, 52.0)
    assert (table[0]["T_pair"], table[1]["T_pair"]) == (3.0, None)
    assert (table[1]["t"], table[1]["failed"]) == (1e-3, "NotConverged: …")
    write_rows([], tmp_path)
    assert (tmp_path / "runs.csv").read_text() == "\n"


def test_groups_differ_by_what_was_changed():
    base = Scenario()
    several = [replace(each, seed=k) for each in grid(base, {"tension": (1e-4, 5e-4)}) for k in range(3)]
    found = groups(Ensemble(tuple(run(each, model) for model in ("discrete", "continuum") for each in several)))
    assert [group.others for group in found] == [
        "discrete, ends.tension 0.1 mN",
        "discrete, ends.tension 0.5 mN",
        "continuum, ends.tension 0.1 mN",
        "continuum, ends.tension 0.5 mN",
    ]
    assert [len(group.runs) for group in found] == [3, 3, 3, 3]


def both(lateral, intermediate, wound=((1, 2, 3), (0, 0, 1))) -> Ensemble:
    """Runs of both systems by their twists."""
    found = []
    for kind, twists, pairs in (("lateral", lateral, wound[0]), ("intermediate", intermediate, wound[1])):
        found += [
            run(Scenario(kind, seed=k), T_crossed=twist, wound=n, width=2e-4)
            for k, (twist, n) in enumerate(zip(twists, pairs, strict=True))
        ]
    return Ensemble(tuple(found))


@pytest.mark.parametrize(
    ("lateral", "intermediate", "words"),
    [
        ((50.0, 55.0, 60.0), (0.0, 1.0, -1.0), ("lateral bundles have more twist: +55.0", "which this one meets")),
        ((-50.0, -55.0, -60.0), (0.0, 1.0, -1.0), ("lateral bundles have less twist: -55.0", "does not meet")),
        ((1.0, -2.0, 3.0), (0.0, 1.0, -1.0), ("show no difference in twist beyond chance: +0.7", "does not meet")),
        ((2.0, 2.0, 2.0), (0.0, 0.0, 0.0), ("have more twist: +2.0 (2.0 to 2.0)", "no run differs from another")),
    ],
)
def test_the_verdict_is_made_of_the_numbers(lateral, intermediate, words):
    said = "\n".join(closing(both(lateral, intermediate)))
    for each in (*words, "Table 1 differ by +55.0 (46.3 to 63.7)", "3 of 3 runs finished", "0.2 mm wide"):
        assert each in said


def test_too_few_and_failed_runs_are_said_so():
    (line, *_) = closing(Ensemble((replace(run(Scenario()), failed="it blew up"),)))
    assert line == "lateral, discrete: 0 of 1 run finished."
    said = closing(both((1.0,), (2.0,), wound=((1,), (1,))))
    assert said[-1].endswith("too few runs for a verdict, at least two of each are needed.")


def test_time_left_is_that_of_the_unknowns_and_steps_left(tmp_path, monkeypatch):
    seconds = [0.0]
    monkeypatch.setattr("dolfinrod.groove.clock.time.monotonic", lambda: seconds[0])
    # The second costs twice as much, the first three times as much with three fibres.
    jobs = [
        Job(replace(BRIEF, fibres=3), "discrete"),
        Job(replace(BRIEF, t_end=4e-5), "discrete"),
        Job(BRIEF, "discrete"),
    ]
    asked = {key(job.scenario, job.model, None): job for job in jobs}
    told, kept = [], Folder(tmp_path)
    clock = Clock(kept, asked, 1, told.append)
    clock.begin(jobs[0])
    assert (told[-1].left, told[-1].done, told[-1].doing) == (None, 0, jobs[0])
    seconds[0] = 10.0
    clock.step(StepLog(t=1e-5, iterations=1, cuts=0, residual=0.0, energy=0.0), 2e-5)
    # One and a half of six parts took 10 s.
    assert told[-1].left == pytest.approx(30.0)
    assert told[-1].t == pytest.approx(1e-5)
    kept.write(run(jobs[0].scenario), {})
    seconds[0] = 24.0
    clock.end()
    assert (told[-1].done, told[-1].left) == (1, pytest.approx(24.0))
    assert [r.key for r in told[-1].ended] == [next(iter(asked))]
    assert told[-1].doing is None


@pytest.mark.serial
def test_an_interruption_that_a_solver_takes_for_a_failure_is_none(tmp_path, monkeypatch):
    solve = Scenario.run

    def interrupted(self, *given, **options):
        result = solve(self, *given, **options)
        try:
            signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            raise NotConverged(result=result, t=1e-5, step=1e-5, reason="interrupted", advice="None.") from None
        return result

    monkeypatch.setattr(Scenario, "run", interrupted)
    with pytest.raises(KeyboardInterrupt):
        ensemble(BRIEF, folder=tmp_path, seeds=range(2))
    assert not list(tmp_path.glob("*.json"))
    monkeypatch.undo()
    assert len(ensemble(BRIEF, folder=tmp_path, seeds=range(2)).finished) == 2


@pytest.mark.serial
def test_an_interruption_counts_a_run_that_was_just_written(tmp_path, monkeypatch):
    write, told = Folder.write, []

    def interrupted(self, *given):
        write(self, *given)
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Folder, "write", interrupted)
    with pytest.raises(KeyboardInterrupt):
        ensemble(BRIEF, folder=tmp_path, seeds=range(2), progress=told.append)
    assert len(list(tmp_path.glob("*.json"))) == told[-1].done == 1


def test_ranks_take_the_longest_first_and_every_run_is_done_once(shared_path, monkeypatch):
    done = []
    solve = Scenario.run
    monkeypatch.setattr(
        Scenario, "run", lambda self, *given, **options: done.append(self) or solve(self, *given, **options)
    )
    several = [replace(BRIEF, elements=n) for n in (2, 3, 4, 5)]
    found = ensemble(several, folder=shared_path, seeds=None, model=("discrete",))
    assert [r.scenario["elements"] for r in found.runs] == [2, 3, 4, 5]
    sizes = [scenario.elements for scenario in done]
    assert sizes == sorted(sizes, reverse=True)
    comm = world()
    everywhere = [sizes] if comm is None else comm.allgather(sizes)
    assert sorted(n for each in everywhere for n in each) == [2, 3, 4, 5]


def test_models_share_a_folder(shared_path):
    found = ensemble(BRIEF, folder=shared_path, seeds=(0,), model=("discrete", "continuum"))
    assert [r.model for r in found.finished] == ["discrete", "continuum"]
    assert found.runs[0].key != found.runs[1].key


def test_a_scenario_keeps_its_own_seed_where_none_are_asked_for(shared_path):
    found = ensemble([replace(BRIEF, seed=7), varied(BRIEF, "seed", 9)], folder=shared_path, seeds=None)
    assert [r.seed for r in found.runs] == [7, 9]
