"""The page shows what was found, misses included, and needs nothing but itself."""

from __future__ import annotations

import json
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from verification import __main__ as command
from verification import report as page_package
from verification import suite
from verification.cases import elastica
from verification.checks import Check
from verification.crosscheck import CrossCheck
from verification.machine import this_machine
from verification.models import Continuum
from verification.onestep import OneStep
from verification.order import Order
from verification.report import sections, write
from verification.report.remarks import remarks
from verification.report.tables import Column, Mark, scientific, table
from verification.speed import Speed
from verification.suite import Report, Shape
from verification.workprecision import Record, Study, Timing

pytestmark = pytest.mark.serial

TEN = elastica.inextensible(10.0)
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source"}
TIMING = Timing(3, solve=5.0, solve_min=4.5, setup=3.0, call=9.0, call_min=8.0, compile=2000.0)


def record(error: float) -> Record:
    return Record(TEN.name, "continuum P3 spatial", "continuum", 8, error, 1e-6, 300, 5, 1, TIMING)


def report(**changes: object) -> Report:
    """A small report in which everything holds but the speed."""
    found = Study(
        case=TEN.name,
        title=TEN.title,
        model=Continuum(3).name,
        family="continuum",
        degree=3,
        records=(record(1e-5), record(2e-7)),
        tip=Order(5.9, 6, (4, 8), 1e-5),
        centreline=Order(None, 4, None, np.nan),
    )
    made = Report(
        machine=this_machine(),
        quick=True,
        checks=(Check(TEN.title, Continuum(3).name, "8 × P3", "error of the tip", 1e-8, 2e-7, True),),
        one_step=(OneStep(TEN.title, "spatial", "8 × P3", 5, 8, 1, 1e-7, None),),
        speeds=(Speed("slow", "spatial 8 × P3", record(1e-7), 1.0),),
        headlines=(found,),
        cases=(found,),
        crosschecks=(CrossCheck(TEN.title, 20, 1e-3, 1e-3, 1e-9),),
        references={TEN.title: TEN.reference},
        shapes=tuple(Shape(TEN.name, f, "continuum", np.eye(3), (1.0, 0.0, 0.0)) for f in ("elastica", "bend45")),
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
        if tag in {"img", "script", "link", "iframe", "object"}:
            self.loads.append(tag)
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
    assert found.loads == []
    assert "url(http" not in page
    assert page.count("<svg") == 3


def test_links_of_the_page_lead_somewhere(page):
    ids = outline(page).ids
    targets = [part.partition('"')[0] for part in page.split('href="#')[1:]]
    assert len(targets) >= 10
    assert set(targets) <= ids


def test_ink_of_the_figures_is_that_of_the_page(page):
    assert "currentColor" in page
    assert "#010203" not in page


def test_json_holds_the_record_without_nan(folder):
    found = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    assert found["holds"] is True
    assert found["headlines"][0]["records"][0]["timing"]["compile"] == 2000.0
    assert found["headlines"][0]["centreline"]["worst"] is None
    assert found["references"][TEN.title]["digits_trusted"] == 14


def test_a_miss_is_a_marked_row():
    missed = Check(TEN.title, Continuum(3).name, "8 × P3", "error of the tip", 3e-7, 2e-7, False)
    text = sections.errors(report(checks=(missed,)))
    assert '<tr class="bad">' in text
    assert "3.0e−7" in text
    assert "✗ missed" in text


def test_a_slow_figure_is_marked_but_no_miss(page):
    assert report().missed == ()
    assert '<tr class="slow">' in page
    assert "✗ slower" in page
    assert '<tr class="bad">' not in page


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({}, 0),
        ({"checks": (Check("c", "m", "8", "error of the tip", 1.0, 1e-3, False),)}, 1),
        ({"one_step": (OneStep("c", "spatial", "8 × P3", 9, 8, 1, 1e-7, None),)}, 1),
        ({"crosschecks": (CrossCheck("c", 20, 1e-2, 1e-3, 1e-9),)}, 1),
    ],
)
def test_exit_code_follows_numbers_never_time(changes, code, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(suite, "run", lambda **_: report(**changes))
    monkeypatch.setattr(page_package, "write", lambda _, folder: folder / "index.html")
    assert command.main(["--quick", "--out", str(tmp_path)]) == code
    output = capsys.readouterr()
    assert output.out.splitlines()[-1] == str(tmp_path / "index.html")
    assert output.err.count("missed") == code


def test_a_deviating_order_is_put_into_words():
    study = report().headlines[0]
    fast = replace(study, tip=Order(8.0, 6, (4, 8), 1e-5), centreline=None)
    assert remarks([fast]) == [f"{TEN.title}: continuum P3 spatial tip 8.0 instead of 6."]
    assert remarks([replace(fast, tip=Order(5.9, 6, (4, 8), 1e-5))]) == []


def test_cells_are_escaped_and_numbers_stand_right():
    text = table((Column("a"), Column("b", kind="number"), Column("")), [("<x>", scientific(2.1e-8), Mark(True))])
    assert "&lt;x&gt;" in text
    assert '<td class="number">2.1e−8</td>' in text
    assert "✓ holds" in text
