"""The report of a folder: what is said follows from what was stored, and nothing is said that was not run."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import meshio
import pytest

from dolfinrod.groove import FixedCore, Folder, RollingCore, Scenario, difference, ensemble, report
from dolfinrod.groove.page.acceptance import FEWEST, acceptance
from dolfinrod.groove.page.headline import headline
from dolfinrod.groove.page.listing import failures
from dolfinrod.groove.page.sentences import sentences
from dolfinrod.groove.page.settings import settings
from dolfinrod.groove.page.show import Show
from dolfinrod.groove.page.tables import write_tables
from dolfinrod.scene import SceneError
from tests.groove.films import LENGTH, NODES, helices, twisted

pytestmark = pytest.mark.serial

LATERAL, INTERMEDIATE = Scenario("lateral", fibres=3), Scenario("intermediate", fibres=3)
TIMES = {"t_end": 5e-5, "dt": 1e-5, "output": 1e-5}


def shown(folder) -> Show:
    """What a report of a folder shows."""
    kept = Folder(folder)
    return Show.of(kept, kept.runs())


def outcomes(folder) -> dict[str, str]:
    """Of the acceptance, by letter."""
    return {row.letter: row.outcome for row in shown(folder).judged}


def items(page) -> list[str]:
    """The sentences on the first screen."""
    first = page.read_text(encoding="utf-8").split("</header>")[0]
    return re.findall(r"<li>(.*?)</li>", first, re.DOTALL)


def columns(path) -> tuple[list[str], list[list[str]]]:
    """Heads and cells of a table."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return lines[0].split(","), [line.split(",") for line in lines[1:]]


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    """A folder with short runs of both kinds, solved, and its report."""
    folder = tmp_path_factory.mktemp("groove")
    scenarios = [Scenario(kind, fibres=2, elements=8, **TIMES) for kind in ("lateral", "intermediate")]
    found = ensemble(scenarios, folder=folder, seeds=[0, 1])
    assert report(folder) == folder / "index.html"
    return folder, scenarios, found


def test_a_page_needs_nothing_else_and_begins_with_five_sentences(real):
    page = real[0] / "index.html"
    text = page.read_text(encoding="utf-8")
    assert len(items(page)) == 5
    assert "55.0 (46.3 to 63.7)" in items(page)[0]
    assert not re.search(r'(src|href)="(https?:|//)', text)
    assert text.count("data:image/svg+xml") > 20
    for target in set(re.findall(r'href="([^"#:,]+)"', text)):
        assert (real[0] / target).is_file()


def test_a_report_leaves_the_runs_as_they_are(real):
    folder, scenarios, found = real
    assert ensemble(scenarios, folder=folder, seeds=[0, 1]) == found


def test_paraview_gets_the_fibres_of_every_frame(real):
    folder, _, found = real
    film = Folder(folder).film(found.runs[0].key)
    mesh = meshio.read(folder / "paraview" / "lateral-0005.vtu")
    assert mesh.points == pytest.approx(film.paths[-1].reshape(-1, 3), rel=1e-12, abs=1e-18)
    assert set(mesh.point_data) == {"s", "tension", "walls", "radius"}
    assert (folder / "paraview" / "lateral.pvd").read_text().count("<DataSet") == 3 * len(film.times)


def test_every_table_names_its_units_and_holds_what_was_stored(tmp_path):
    (run,) = twisted(tmp_path, LATERAL, [3])
    write_tables(shown(tmp_path), tmp_path / "data")
    film = Folder(tmp_path).film(run.key)
    heads, rows = columns(tmp_path / "data" / "along.csv")
    assert ",".join(heads[3:]) == (
        "X_begin [m],X_end [m],T_pairs [turns/m],width [m],tension [N],walls [N/m],fibres [N/m]"
    )
    assert [float(row[5]) for row in rows] == film.T[-1].tolist()
    heads, rows = columns(tmp_path / "data" / "sections.csv")
    assert {"s [m]", "X [m]", "Y [m]", "Z [m]", "tension [N]", "walls [N/m]"} <= set(heads)
    assert len(rows) == 2 * 3 * NODES
    heads, rows = columns(tmp_path / "data" / "energy.csv")
    assert heads[3:] == ["t [s]", "kinetic [J]", "drag [J]"]
    record = json.loads((tmp_path / "data" / "groove.json").read_text(encoding="utf-8"))
    assert set(record["tables"]) == {"along", "course", "crossings", "sections", "energy"}
    assert record["runs"][0]["T_pair"] == run.T_pair


def test_a_strand_of_z_twist_has_z_crossings_everywhere(tmp_path):
    (run,) = twisted(tmp_path, LATERAL, [0])
    write_tables(shown(tmp_path), tmp_path / "data")
    heads, rows = columns(tmp_path / "data" / "crossings.csv")
    assert len(rows) > 0
    assert {row[heads.index("sign")] for row in rows} == {"1"}
    assert Folder(tmp_path).film(run.key).T[-1] == pytest.approx(1.2 / LENGTH, rel=1e-9)


@pytest.mark.parametrize(
    ("apart", "words"),
    [
        (0.0, "the interval holds zero"),
        (55.0 * LENGTH, "as much as the yarns show"),
        (10.0 * LENGTH, "not as much as there"),
        (-10.0 * LENGTH, "against what the yarns show"),
    ],
)
def test_the_verdict_follows_from_the_runs(tmp_path, apart, words):
    twisted(tmp_path, LATERAL, range(10), turns=1.0 + apart)
    twisted(tmp_path, INTERMEDIATE, range(10), turns=1.0)
    show = shown(tmp_path)
    told = sentences(show.base, show.films)
    T = [show.base.values("T_crossed", kind) for kind in ("lateral", "intermediate")]
    assert f"{difference(*T).value:.1f}".replace("-0.0", "0.0").replace("-", "−") in told[1]
    assert words in told[1]


def test_how_long_is_told_of_runs_that_come_to_rest_sooner_or_later(tmp_path):
    twisted(tmp_path, LATERAL, [0, 1])
    show = shown(tmp_path)
    one, other = show.films["lateral"]
    whole = 1e3 * one.times[-1]
    assert f" {whole:.3g} ms of gathering" in sentences(show.base, show.films)[0]
    told = sentences(show.base, {"lateral": (one, replace(other, times=0.5 * other.times))})
    assert f" {0.5 * whole:.3g} to {whole:.3g} ms of gathering" in told[0]
    assert f"are {0.5 * whole:.3g} to {whole:.3g} ms of " in told[4]


def test_runs_without_scatter_have_a_difference():
    assert difference([2.0, 2.0], [1.0, 1.0]) == difference([1.0, 1.0, 1.0], [0.0, 0.0])
    assert difference([2.0, 2.0], [1.0, 1.0]).low == 1.0


@pytest.mark.parametrize("seeds", [[0], [0, 1]])
def test_one_kind_has_a_verdict_but_no_difference(tmp_path, seeds):
    twisted(tmp_path, INTERMEDIATE, seeds)
    show = shown(tmp_path)
    told = sentences(show.base, show.films)
    assert len(told) == 5
    assert "takes two runs of each" in told[1]
    assert headline(show.base).svg.startswith(b"<?xml")
    assert set(outcomes(tmp_path).values()) == {"not run"}


@pytest.mark.slow
@pytest.mark.parametrize("fibres", [1, 7])
def test_one_run_of_any_bundle_is_enough_for_a_page(tmp_path, fibres):
    ensemble(Scenario(fibres=fibres, elements=8, fibres_touch=False, **TIMES), folder=tmp_path, seeds=[0])
    first = report(tmp_path).read_bytes()
    assert (b'id="crossings"' in first) == (fibres > 1)
    assert b'id="views"' in first
    assert report(tmp_path).read_bytes() == first


def test_failed_runs_are_named_with_their_reason_and_left_out(tmp_path):
    twisted(tmp_path, LATERAL, [0, 1])
    twisted(tmp_path, LATERAL, [2], failed="NotConverged: a <test>")
    show = shown(tmp_path)
    text = failures(show.runs)
    assert "One run failed" in text
    assert "NotConverged: a &lt;test&gt;" in text
    assert len(show.films["lateral"]) == 2


def test_a_folder_without_finished_runs_is_refused_in_words(tmp_path):
    with pytest.raises(SceneError, match=r"must be a folder of runs, got .*missing, which does not exist"):
        report(tmp_path / "missing")
    assert not (tmp_path / "missing").exists()
    with pytest.raises(SceneError, match="must hold finished runs, got none"):
        report(tmp_path)
    twisted(tmp_path, LATERAL, [0], failed="a test")
    with pytest.raises(SceneError, match=r"got 1 in .* that all failed"):
        report(tmp_path)


def test_few_runs_decide_nothing(tmp_path):
    twisted(tmp_path, LATERAL, range(FEWEST - 1))
    twisted(tmp_path, INTERMEDIATE, range(FEWEST - 1), turns=0.0, wound=0)
    assert set(outcomes(tmp_path).values()) == {"not run"}


def test_enough_runs_pass_or_fail(tmp_path):
    twisted(tmp_path, LATERAL, range(FEWEST), wound=3)
    twisted(tmp_path, INTERMEDIATE, range(FEWEST), turns=1e-3, wound=0)
    assert {**outcomes(tmp_path), "a": "pass", "b": "pass"} == outcomes(tmp_path)
    other = tmp_path / "other"
    twisted(other, LATERAL, range(FEWEST), wound=0)
    twisted(other, INTERMEDIATE, range(FEWEST), turns=1.0, wound=3)
    assert {**outcomes(other), "a": "fail", "b": "fail"} == outcomes(other)


def test_mirror_images_are_compared_path_by_path(tmp_path):
    twisted(tmp_path, LATERAL, [0])
    twisted(tmp_path, replace(LATERAL, mirrored=True), [0])
    assert outcomes(tmp_path)["c"] == "pass"
    run = next(run for run in Folder(tmp_path).runs() if run.scenario["mirrored"])
    kept = Folder(tmp_path)
    arrays = kept.arrays(run.key)
    kept.write(run, {**arrays, "paths": arrays["paths"] + 2e-8 * LENGTH})
    assert outcomes(tmp_path)["c"] == "fail"


def test_variants_are_judged_from_their_own_runs(tmp_path):
    twisted(tmp_path, LATERAL, range(FEWEST))
    twisted(tmp_path, replace(LATERAL, core=RollingCore()), range(FEWEST))
    twisted(tmp_path, replace(LATERAL, core=RollingCore(), mirrored=True), range(2))
    twisted(tmp_path, replace(LATERAL, air=None, wall_friction=None, fibre_friction=None), [0])
    found = outcomes(tmp_path)
    assert (found["e"], found["d"]) == ("pass", "fail")


def test_refinements_are_held_against_the_first_setting(tmp_path):
    for scenario in (LATERAL, INTERMEDIATE):
        twisted(tmp_path, scenario, range(FEWEST))
        twisted(tmp_path, replace(scenario, elements=160), range(FEWEST))
    assert outcomes(tmp_path)["f"] == "pass"
    for scenario in (LATERAL, INTERMEDIATE):
        twisted(tmp_path, replace(scenario, dt=5e-7), range(FEWEST), wound=9)
    assert outcomes(tmp_path)["f"] == "fail"


def test_settings_say_how_they_differ(tmp_path):
    twisted(tmp_path, LATERAL, range(3))
    twisted(tmp_path, replace(LATERAL, ends=replace(LATERAL.ends, tension=5e-4)), [0])
    twisted(tmp_path, replace(LATERAL, core=FixedCore(5e-5)), [0])
    twisted(tmp_path, replace(LATERAL, core=None), [0])
    kept = Folder(tmp_path)
    found = settings(kept.runs())
    assert found[0].words == "discrete model"
    assert {s.words for s in found[1:]} == {
        "discrete model; ends.tension 0.0005, not 0.0001",
        "discrete model; core.radius 5e-05, not 8e-05",
        "discrete model; core none, not FixedCore",
    }
    assert acceptance(found, kept)[0].letter == "a"


def test_helices_turn_as_far_as_they_should():
    from dolfinrod.twist import pairs

    assert pairs(list(helices(1.2, 3))).T == pytest.approx(1.2 / LENGTH, rel=1e-9)
