"""The verdict: its figure, its sentences, its Markdown, and the schema of the record."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from xml.etree import ElementTree

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.verification.test_report import BLIND, report
from verification.__main__ import main
from verification.groovescenarioclaims import GrooveClaim
from verification.report import summarise, write
from verification.report.misses import sentence
from verification.report.outcomes import outcomes
from verification.report.page import misses
from verification.report.schema import schema
from verification.report.sections import machine
from verification.report.verdict import front, panels, sentences
from verification.workoff import Spent

pytestmark = pytest.mark.serial

TIMES = st.lists(st.tuples(st.floats(1e-3, 1e3), st.floats(1e-12, 1.0)), min_size=1, max_size=30)


@given(points=TIMES)
def test_no_run_is_quicker_and_nearer_than_one_of_the_front(points):
    kept = front(points)
    assert set(kept) <= set(points)
    for time, error in points:
        assert any(t <= time and e <= error for t, e in kept)
    assert list(kept) == sorted(kept)
    assert [e for _, e in kept] == sorted({e for _, e in kept}, reverse=True)


def test_sentences_are_made_of_the_numbers():
    said = sentences(report())
    assert 2 <= len(said) <= 5
    total = sum(o.total for o in outcomes(report()))
    assert f"Of {total} numbers with a limit" in said[0]
    assert "none is beyond" in said[0]
    assert any(words.startswith("A cantilever") and "ms" in words for words in said)


def test_what_is_missed_is_said_first():
    missed = report(brackets=(BLIND,))
    assert "1 is beyond" in sentences(missed)[0]
    assert any(o.sign == "✗" for o in outcomes(missed))


def test_a_report_without_limits_says_nothing_of_them():
    """As of other people's solvers alone: a race has winners, and no number beyond its limit."""
    full = report()
    emptied = {f.name: () for f in fields(full) if isinstance(getattr(full, f.name), tuple)}
    race = replace(full, **emptied)
    assert not any("limit" in words for words in sentences(race))
    assert misses(race) == ""


def test_what_is_only_told_counts_as_nothing():
    """Claims for which runs are too few are no numbers that hold."""
    claims = (GrooveClaim("a", "found", holds=True), GrooveClaim("b", "found", holds=True, asked=False))
    (found,) = (o for o in outcomes(report(scenarios=claims)) if "claims" in o.words)
    assert (found.good, found.total) == (1, 1)
    assert "1 not judged" in found.words


def test_the_summary_holds_outcomes_misses_picture_and_machine(tmp_path):
    found = report(brackets=(BLIND,))
    page = summarise(found, tmp_path / "kept", "dolfinrod verify --summary")
    text = page.read_text(encoding="utf-8")
    for outcome in outcomes(found):
        assert f"| {outcome.good} of {outcome.total} | {outcome.words} |" in text
    assert f"- {sentence(BLIND)}" in text
    assert found.machine.processor in text
    assert "results.svg" in text
    picture = ElementTree.parse(page.with_name("results.svg")).getroot()
    assert len(picture.findall("{http://www.w3.org/2000/svg}svg")) == len(panels(found))


def test_nothing_solved_is_no_picture(tmp_path):
    found = report(studies=(), reaches=(), grooves=())
    assert panels(found) == ()
    text = summarise(found, tmp_path, "x").read_text(encoding="utf-8")
    assert "results.svg" not in text


def test_the_record_is_as_its_schema_says(tmp_path):
    folder = write(report(), tmp_path).parent
    record = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    written = json.loads((folder / "report.schema.json").read_text(encoding="utf-8"))
    assert written == json.loads(json.dumps(schema()))
    jsonschema.Draft202012Validator.check_schema(written)
    jsonschema.Draft202012Validator(written).validate(record)
    with pytest.raises(jsonschema.ValidationError, match="'sometimes' is not of type 'boolean'"):
        jsonschema.Draft202012Validator(written).validate(record | {"quick": "sometimes"})


def test_a_page_says_by_which_source_it_was_made():
    found = report()
    assert replace(found.machine, source="").source == ""
    assert found.machine.source


def test_a_page_says_what_the_suite_took_and_how_many_units_ran_at_once():
    text = machine(report(jobs=2, spent=(Spent("study", 3, 90.0, "the longest of them", 60.0),)))
    assert "2, so that times are noisier" in text
    assert "1.5 min of work" in text
    assert "the longest of them" in text


def test_the_command_writes_the_summary(tmp_path, capsys):
    words = ["laws", "--quick", "--out", str(tmp_path / "report"), "--summary", str(tmp_path / "kept")]
    assert main(words) == 0
    assert "the verdict is in" in capsys.readouterr().err
    text = (tmp_path / "kept" / "RESULTS.md").read_text(encoding="utf-8")
    assert "dolfinrod verify --summary --quick laws" in text
    assert "laws hold" in text
