"""The page shows what was found, misses included, and needs nothing but itself."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from dolfinrod.scene import Planar
from verification import __main__ as command
from verification import report as page_package
from verification import suite, workoff
from verification.case import Case
from verification.cases import bend45, elastica
from verification.checks import Check
from verification.crosscheck import CrossCheck
from verification.hard import HardRow, Share
from verification.laws import LawRow
from verification.machine import this_machine
from verification.models import Continuum, Discrete
from verification.onestep import OneStep
from verification.order import Order
from verification.reach import reaches
from verification.references import peers
from verification.report import sections, write
from verification.report.misses import sentence
from verification.report.page import html
from verification.report.remarks import deviations
from verification.report.shapes import projection
from verification.report.tables import Column, Mark, scientific, table
from verification.robustness import LOADS, OneStepLoads, Steps
from verification.shape import Shape
from verification.speed import Speed
from verification.stability import Bracket, EigenStudy
from verification.statement import statement
from verification.suite import Report
from verification.workprecision import Record, Study, Timing

pytestmark = pytest.mark.serial

TEN = elastica.inextensible(10.0)
BEND = bend45.bend(600.0, kirchhoff=True)
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source"}
TIMING = Timing(3, solve=5.0, solve_min=4.5, setup=3.0, call=9.0, call_min=8.0, compile=2000.0)
CRITICAL = EigenStudy(
    "column-PP",
    "Column",
    "columns",
    "P L²/EI",
    "continuum P3",
    9.87,
    "F1; closed form",
    (4, 8),
    (9.88, 9.87),
    (1e-3, 1e-8),
    Order(6.0, 6, (4, 8), 1e-3),
    2,
    2,
    1e-6,
    5.0,
    None,
    "",
)
BRACKET = Bracket("column-PP", "Column", "continuum P3", 0.995, 1.005, (True, False), (0, 2), 2, None)
SOLVED = HardRow(
    "soft", "supports", "Soft rod", "continuum", "16 × P3", "converged", "", 2, 9, 1, True, 1e-9, "straight", 5.0
)
REFUSED = replace(SOLVED, model="discrete", outcome="refused", reason="diverged", stable=None, error=np.nan)
AT_ONCE = OneStepLoads("continuum P3 planar", (5,) * len(LOADS), 5000.0)
FEW = Steps("rollup-10", "Ten turns", "continuum P3 spatial", 80, 3, 60, 2, 1e-9, 3, 60, "P2a", None)
ARC = np.array([[0.0, 0.0, 0.0], [0.6, 0.3, 0.1], [0.8, 0.6, 0.4]])


def record(case: Case, model: Continuum | Discrete, elements: int, error: float) -> Record:
    return Record(case.name, model.name, model.family, elements, error, 1e-6, 300, 5, 1, (0.4, 0.8, 0.0), 0.0, TIMING)


def study(case: Case, model: Continuum | Discrete, errors: tuple[float, float] = (1e-5, 2e-7)) -> Study:
    return Study(
        case=case.name,
        title=case.title,
        model=model.name,
        family=model.family,
        degree=model.degree,
        records=tuple(record(case, model, n, e) for n, e in zip((4, 8), errors, strict=True)),
        tip=Order(5.9, 6, (4, 8), 1e-5),
        centreline=Order(None, 4, None, np.nan),
    )


def report(**changes: object) -> Report:
    """A small report in which everything holds but the speed."""
    studies = (study(TEN, Continuum(3, Planar())), study(TEN, Discrete(), (1e-3, 3e-4)), study(BEND, Continuum(3)))
    made = Report(
        machine=this_machine(),
        quick=True,
        statements=tuple(replace(statement(case), note="A note.") for case in (TEN, BEND)),
        headlines=(TEN.name, BEND.name),
        checks=(
            Check(TEN.name, TEN.title, Continuum(3).name, "8 × P3", "error of the tip", 1e-8, 2e-7, True),
            Check(TEN.name, TEN.title, Discrete().name, "4 → 8", "order of the tip", 1.5, 1.7, False, "because"),
        ),
        one_step=(OneStep(TEN.name, TEN.title, "spatial", "8 × P3", 5, 8, 1, 1e-7, None),),
        speeds=(Speed("slow", "spatial 8 × P3", record(TEN, Continuum(3), 8, 1e-7), 1.0, peers("elastica")),),
        studies=studies,
        crosschecks=(CrossCheck(TEN.name, TEN.title, 20, 1e-3, 1e-3, 1e-9),),
        laws=(
            LawRow("rest", "Rest", "What is at rest stays so.", "test_cli.py::test_x", "discrete chord", 1e-15, 1e-11),
        ),
        critical=(CRITICAL,),
        brackets=(BRACKET,),
        hard=(SOLVED, REFUSED),
        shares=(Share(19, 20, 0.95),),
        largest=(AT_ONCE,),
        fewest=(FEW, replace(FEW, model="discrete chord", most_steps=None, failure="diverged")),
        reaches=reaches(studies),
        shapes=(
            Shape(TEN.name, (ARC * (1, 1, 0),), (ARC * (1, 1, 0),), (ARC * (1, 1, 0),), (), TEN.reference.value),
            Shape(BEND.name, (ARC,), (ARC,), (ARC,), (ARC[:2],), BEND.reference.value),
        ),
    )
    return replace(made, **changes)


class Outline(HTMLParser):
    """Opened and closed tags, and addresses of whatever is loaded."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.loads: list[str] = []
        self.ids: set[str] = set()

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.ids.add(values.get("id"))
        self.loads += [values[name] for name in ("src", "data", "srcset") if name in values]
        if tag == "link":
            self.loads.append(values["href"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.ids.add(dict(attrs).get("id"))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def outline(text: str) -> Outline:
    parser = Outline()
    parser.feed(text)
    parser.close()
    return parser


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    return write(report(), tmp_path_factory.mktemp("report")).parent


@pytest.fixture(scope="module")
def page(folder) -> str:
    return (folder / "index.html").read_text(encoding="utf-8")


def test_page_is_well_formed_and_loads_nothing(page):
    found = outline(page)
    assert found.open == []
    assert set(found.loads) <= {"data:,"}
    assert "url(http" not in page
    assert "nan" not in page.lower().replace("nanoseconds", "")


def test_links_of_the_page_lead_somewhere(page):
    ids = outline(page).ids
    targets = [part.partition('"')[0] for part in page.split('href="#')[1:]]
    assert len(targets) >= 20
    assert set(targets) <= ids


def test_tests_are_found_from_the_folder_of_the_page(page, folder):
    (address,) = {
        part.partition('"')[0] for part in page.split('href="')[1:] if "tests/test_cli.py" in part.partition('"')[0]
    }
    assert (folder / address).resolve() == Path(__file__).parents[1] / "test_cli.py"


@pytest.mark.parametrize("case", [TEN, BEND], ids=lambda case: case.name)
def test_every_case_has_its_picture_errors_statement_and_notes(case, page):
    part = page.split(f'id="case-{case.name}"')[1].split("</details>")[0]
    assert part.count("<figure>") == 3
    assert part.count("<svg role") == 3
    for words in ("Error over resolution", "Error over time", case.reference.id, "A note.", f"verify {case.name}"):
        assert words in part
    assert f"{case.reference.digits_trusted} digits trusted" in part


def test_every_curve_and_marker_of_a_figure_has_a_style(page):
    for kind in ("p3", "chord", "paper"):
        assert f"polyline.{kind} {{ stroke" in page
        assert f'id="m-{kind}"' in page


def test_json_holds_the_record_without_nan(folder):
    found = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    assert found["holds"] is True
    assert found["studies"][0]["records"][0]["timing"]["compile"] == 2000.0
    assert found["studies"][0]["centreline"]["worst"] is None
    assert found["statements"][0]["reference"]["digits_trusted"] == 14


def test_seconds_to_an_error_are_those_of_the_quickest_run_that_reached_it():
    slow, quick = record(TEN, Continuum(3), 8, 1e-7), record(TEN, Continuum(3), 16, 1e-9)
    slow = replace(slow, timing=replace(TIMING, solve_min=9.0))
    found = {r.target: r for r in reaches([replace(study(TEN, Continuum(3)), records=(slow, quick))])}
    assert [found[t].seconds for t in (1e-3, 1e-5, 1e-8)] == pytest.approx([0.0045] * 3)
    far = {r.target: r for r in reaches([replace(study(TEN, Continuum(3)), records=(slow,))])}
    assert (far[1e-5].seconds, far[1e-5].mesh) == (pytest.approx(0.009), "8 × P3")
    assert (far[1e-8].seconds, far[1e-8].error) == (None, 1e-7)
    text = sections.reached(report(), {TEN.name})
    assert "0.0045 · 8 × P3" in text
    assert "not reached" in text


def test_a_deviation_that_the_case_explains_is_marked_but_no_miss():
    text = sections.orders(report())
    assert "explained at the case" in text
    assert report().missed == ()


def test_an_empty_report_is_a_page_too():
    nothing = {f.name: () for f in fields(Report) if f.name not in ("machine", "quick", "headlines")}
    text = html(report(**nothing))
    assert outline(text).open == []
    assert 'id="machine"' in text


@pytest.mark.parametrize(
    ("points", "view"),
    [
        (ARC * (1, 1, 0), [[1, 0, 0], [0, 1, 0]]),
        (ARC * (1, 0, 1), [[1, 0, 0], [0, 0, 1]]),
        (ARC * (0, 1, 1), [[0, 1, 0], [0, 0, 1]]),
    ],
)
def test_what_lies_in_a_coordinate_plane_is_seen_from_its_normal(points, view):
    np.testing.assert_array_equal(projection(points), view)


def test_what_lies_in_space_is_seen_in_parallel_projection_with_z_up():
    view = projection(ARC)
    np.testing.assert_allclose(view @ view.T, np.eye(2), atol=1e-14)
    assert view[0, 2] == 0.0
    assert view[1, 2] > 0.8


LONG = Check(TEN.name, TEN.title, Continuum(3).name, "8 × P3", "error of the tip", 3e-7, 2e-7, False)
LATE = OneStep(TEN.name, TEN.title, "spatial", "8 × P3", 9, 8, 1, 1e-7, None)
APART = CrossCheck(TEN.name, TEN.title, 20, 1e-2, 1e-3, 1e-9)
BROKEN = LawRow("rest", "Rest", "…", "test_cli.py::test_x", "discrete chord", 1e-3, 1e-11)
OFF = replace(CRITICAL, errors=(1e-3, 1e-5))
BLIND = replace(BRACKET, stable=(True, True), directions=(0, 0))
WRONG = replace(SOLVED, outcome="WRONG", error=0.3)
FEWER = Share(18, 20, 0.95)
LIGHT = replace(AT_ONCE, iterations=(5, 5, None, *AT_ONCE.iterations[3:]))
MORE = replace(FEW, iterations=91)
MISSES = {
    "checks": (LONG,),
    "one_step": (LATE,),
    "crosschecks": (APART,),
    "laws": (BROKEN,),
    "critical": (OFF,),
    "brackets": (BLIND,),
    "hard": (WRONG,),
    "shares": (FEWER,),
    "largest": (LIGHT,),
    "fewest": (MORE,),
}


def test_a_miss_is_a_marked_row():
    text = sections.errors(report(checks=(LONG,)))
    assert '<tr class="bad">' in text
    assert "3.0e−7" in text
    assert "✗ missed" in text


def test_misses_stand_on_the_first_screen_and_at_their_cases():
    text = html(report(**MISSES))
    first = text.split("<nav")[0]
    assert f"Beyond their limits: {len(MISSES)}" in first
    assert all(sentence(row) in first.replace("&#x27;", "'") for rows in MISSES.values() for row in rows)
    assert text.split(f'id="case-{TEN.name}"')[1].count("Missed: ") == 3


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (LONG, "error of the tip 3.0e−7 (8 × P3), at most 2e−7"),
        (
            replace(LONG, quantity="order of the tip", found=5.0, limit=5.7),
            "order of the tip 5.00 (8 × P3), at least 5.70",
        ),
        (replace(LONG, quantity="digits"), "least error 3.0e−7 (8 × P3), at most 2e−7, or the order of theory"),
        (LATE, "1 load step(s) and 9 iterations"),
        (replace(LATE, failure="diverged"), "did not converge: diverged"),
        (APART, "differ by 1.0e−2 on 20 discrete elements, estimated 1.0e−3"),
        (replace(APART, failure="diverged"), "diverged"),
        (BROKEN, "violates it by 1.0e−3, at most 1e−11"),
        (OFF, "errors 1.0e−3 (4) · 1.0e−5 (8), order 6.00 of 6, 2 mode(s) of 2"),
        (replace(OFF, found=(9.9, np.nan), failure="8 elements: none"), "P L²/EI – instead of 9.87; 8 elements: none"),
        (BLIND, "stable below the critical load and stable above, directions lost 0; expected stable, unstable, 2"),
        (replace(BLIND, failure="diverged"), "no verdict on both sides of the critical load: diverged"),
        (WRONG, "continuum 16 × P3 ends 3.0e−1 off (straight), stable, without a warning"),
        (FEWER, "18 of 20 continuum rows converge, at least 95 %"),
        (LIGHT, "takes 2 EI/L², at least 5000"),
        (MORE, "took 3 load step(s) and 91 iterations, error 1.0e−9; at most 3 step(s) and at most 60 iterations"),
        (replace(FEW, failure="diverged"), "on 80 elements did not converge: diverged"),
    ],
)
def test_a_miss_is_said_in_a_sentence(row, words):
    assert words in sentence(row)


def test_a_slow_figure_is_marked_but_no_miss(page):
    assert report().missed == ()
    assert '<tr class="slow">' in page
    assert "✗ slower" in page
    assert '<tr class="bad">' not in page


@pytest.mark.parametrize(("changes", "code"), [({}, 0), *(({key: rows}, 1) for key, rows in MISSES.items())])
def test_exit_code_follows_numbers_never_time(changes, code, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(workoff, "work_off", lambda *_: {})
    monkeypatch.setattr(suite, "report", lambda *_, **__: report(**changes))
    monkeypatch.setattr(page_package, "write", lambda _, folder: folder / "index.html")
    assert command.main(["--quick", "--out", str(tmp_path)]) == code
    output = capsys.readouterr()
    assert output.out.splitlines()[-1] == str(tmp_path / "index.html")
    assert output.err.count("missed") == code


def test_a_refusal_with_a_reason_is_marked_but_no_miss(page):
    part = page.split('id="hard"')[1].split("</section>")[0]
    assert "✗ refused" in part
    assert "diverged" in part
    assert "95 %" in part


def test_hard_cases_solved_are_counted_on_the_first_screen(page):
    first = page.split("<nav")[0]
    assert "✓ 19 of 20" in first
    assert "✗ 18 of 20" in html(report(shares=(FEWER,)))


def test_a_deviating_order_is_put_into_words():
    fast = replace(study(TEN, Continuum(3)), tip=Order(8.0, 6, (4, 8), 1e-5), centreline=None)
    assert deviations([fast]) == ["continuum P3 spatial: tip 8.0 instead of 6"]
    assert deviations([replace(fast, tip=Order(5.9, 6, (4, 8), 1e-5))]) == []


def test_cells_are_escaped_and_numbers_stand_right():
    text = table((Column("a"), Column("b", kind="number"), Column("")), [("<x>", scientific(2.1e-8), Mark(True))])
    assert "&lt;x&gt;" in text
    assert '<td class="number">2.1e−8</td>' in text
    assert "✓ holds" in text
