"""Short runs of the groove: both models, the mirror image, and ensembles that go on where they were stopped."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.groove import Bundle, Film, LineSink, Scenario, course, ensemble, filmed, measure, variant
from dolfinrod.groove.runs import Folder
from dolfinrod.result import NotConverged
from dolfinrod.scene import Groove, SceneError

# Strong air from the start, and few elements: much happens in few steps.
GUST = LineSink(speed=40.0, ramp=0.0)
TIMES = {"t_end": 1e-4, "dt": 1e-5, "output": 1e-5}


def brief(kind: str = "lateral", *, steps: int = 5, fibres: int = 2, elements: int = 8) -> Scenario:
    """Fibres that do not touch one another for some steps of 10 µs."""
    times = {"t_end": steps * 1e-5, "dt": 1e-5, "output": 1e-5, "rest": None}
    return Scenario(kind, fibres=fibres, air=GUST, fibres_touch=False, elements=elements, **times)


@pytest.mark.serial
def test_both_models_gather_the_same_fibre():
    scenario = brief(fibres=1, elements=80, steps=10)
    fine = scenario.run("continuum").rods[0].at(0.02)
    assert np.linalg.norm(fine[-1] - fine[0]) > 5e-5
    error = [np.abs(scenario.run("discrete", elements=n).rods[0].at(0.02) - fine).max() for n in (40, 80)]
    assert error[1] < 1e-3 * np.linalg.norm(fine[-1] - fine[0])
    # The discrete model is of second order; 2 is what is left of 4 where elements are long against the bent ends.
    assert error[0] > 2.0 * error[1]


@pytest.mark.serial
@pytest.mark.parametrize(("kind", "offset"), [("lateral", -1e-4), ("intermediate", 0.0)])
def test_the_mirror_image_is_solved_as_the_image_of_the_solution(kind, offset):
    # Near the bottom, so that walls and core are soon touched.
    scenario = replace(brief(kind, steps=15), bundle=Bundle(height=-2.5e-4, offset=offset))
    result, image = (each.run("discrete") for each in (scenario, variant(scenario, "mirrored")))
    assert course(result, scenario).walls.max() > 0.0
    flip = np.array([1.0, 1.0, -1.0])
    for rod, other in zip(result.rods, image.rods, strict=True):
        assert np.abs(rod.r[-1] - rod.r[0]).max() > 1e-5
        assert np.abs(rod.r * flip - other.r).max() <= 1e-8 * 0.04


@pytest.mark.serial
def test_no_air_and_no_friction_gather_nothing():
    scenario = Scenario(air=None, wall_friction=None, fibre_friction=None, fibres_touch=False, elements=8, **TIMES)
    result = scenario.run("discrete")
    over = course(result, scenario)
    assert over.width == pytest.approx(np.full(len(over.t), over.width[0]), rel=1e-12)
    assert measure(result, scenario).wound == 0


@pytest.mark.serial
def test_in_the_paper_as_printed_nothing_moves():
    scenario = replace(Scenario.paper(), elements=8, **TIMES)
    result = scenario.run("discrete")
    # Tension alone, 0.1 mN on 10.8 N, stretches 40 mm by 0.4 µm, and as much again where it swings.
    for rod in result.rods:
        assert np.abs(rod.r - rod.r[0]).max() <= 2.1 * 1e-4 * 0.04 / scenario.bundle.section.EA


def test_a_second_call_repeats_no_finished_run(shared_path, monkeypatch):
    counted = []
    solve = Scenario.run
    monkeypatch.setattr(
        Scenario, "run", lambda self, *given, **options: counted.append(1) or solve(self, *given, **options)
    )
    told = []
    found = ensemble(brief(), folder=shared_path, seeds=range(3), progress=told.append)
    assert total(len(counted)) == 3
    again = ensemble(brief(), folder=shared_path, seeds=range(4))
    assert total(len(counted)) == 4
    assert again.runs[:3] == found.runs
    assert [run.seed for run in again.finished] == [0, 1, 2, 3]
    assert (told[0].done, told[0].total, told[0].left) == (0, 3, None)
    assert sorted(path.suffix for path in shared_path.iterdir()) == [".json"] * 4 + [".npz"] * 4
    arrays = Folder(shared_path).arrays(found.runs[0].key)
    assert arrays["paths"].shape == (6, 2, 9, 3)
    assert arrays["course width"].shape == arrays["course t"].shape == (6,)


def test_a_run_that_fails_is_recorded_and_the_others_go_on(shared_path, monkeypatch):
    solve = Scenario.run

    def sometimes(self, *given, **options):
        if self.seed == 1:
            result = solve(self, *given, **options)
            raise NotConverged(result=result, t=2e-5, step=1e-5, reason="a test", advice="None.")
        return solve(self, *given, **options)

    monkeypatch.setattr(Scenario, "run", sometimes)
    found = ensemble(brief(), folder=shared_path, seeds=range(3))
    assert [run.seed for run in found.finished] == [0, 2]
    (failed,) = found.failed
    assert (failed.seed, failed.t) == (1, 2e-5)
    assert "NotConverged: no next state found" in failed.failed
    assert len(found.values("T_pair", "lateral")) == 2
    assert found.values("T_pair", "intermediate") == ()
    assert found.values("edge_crosses") == found.values("T_crossed") == (0.0, 0.0)


@pytest.mark.serial
def test_what_an_end_by_force_leaves_is_swept_and_half_a_record_is_none(tmp_path):
    (run,) = ensemble(brief(), folder=tmp_path, seeds=[0]).runs
    (tmp_path / f"{run.key}.json").write_text('{"key": ')
    (tmp_path / "x.1.part").write_text("")
    (tmp_path / ".claims-old").mkdir()
    (tmp_path / ".claims-old" / run.key).touch()
    again = ensemble(brief(), folder=tmp_path, seeds=[0])
    assert again.runs[0].T_pair == run.T_pair
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.serial
def test_a_run_is_finished_when_all_of_it_is_there(tmp_path):
    (run,) = ensemble(brief(), folder=tmp_path, seeds=[0]).runs
    kept, record = Folder(tmp_path), tmp_path / f"{run.key}.json"
    assert kept.runs() == (run,)
    table = json.loads(record.read_text())
    record.write_text(json.dumps(table | {"format": "another"}))
    assert kept.runs() == ()
    record.write_text(json.dumps(table))
    (tmp_path / "report.json").write_text("[1, 2]")
    assert kept.runs() == (run,)
    (tmp_path / f"{run.key}.npz").unlink()
    assert kept.read(run.key) is None


@pytest.mark.serial
@pytest.mark.parametrize("name", ["mirrored", "L2"])
def test_a_film_keeps_what_the_result_says(name):
    scenario = replace(variant(brief(steps=4), name), bundle=Bundle(height=-2.5e-4, offset=None), fibres_touch=True)
    result = scenario.run("discrete")
    film = Film.of(filmed(result, scenario))
    assert (film.times == result.t).all()
    assert (film.paths[:, 1] == result.rods[1].r).all()
    assert film.energy.keys() == result.energy.keys()
    assert film.course["width"] == pytest.approx(course(result, scenario).width)
    # Line load over the length is the force that the course tells.
    share = np.gradient(film.s) * np.where((film.s == 0.0) | (film.s == film.s[-1]), 0.5, 1.0)
    assert (film.pressed @ share).sum(axis=1) == pytest.approx(film.course["walls"], rel=1e-9, abs=1e-15)
    # The core begins on the wall, or lies between the flanks.
    y, z, radius = film.core[0]
    wall = Groove(film.outline.tolist())
    assert wall.closest(np.array([[0.0, y, z]])).distance[0] == pytest.approx(radius, abs=2e-6)


@pytest.mark.serial
def test_a_long_run_keeps_some_of_its_states_and_its_whole_course():
    scenario = brief(steps=80, fibres=1, elements=2)
    result = scenario.run("discrete")
    film = Film.of(filmed(result, scenario))
    assert len(film.times) <= 61
    assert (film.times[0], film.times[-1]) == (result.t[0], result.t[-1])
    assert len(film.course["t"]) == len(result.t) == 81


def test_an_ensemble_has_runs(shared_path):
    with pytest.raises(SceneError, match="seeds must ask for at least one run, got none"):
        ensemble(brief(), folder=shared_path, seeds=())


def total(n: int) -> int:
    """Sum over all ranks."""
    from tests.conftest import world

    comm = world()
    return n if comm is None else int(comm.allreduce(n))
