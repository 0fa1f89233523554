"""One rank and two: that kinds of scenes are posed, compared, and judged."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from verification import processes, ranks
from verification.bundles import SAME
from verification.ledger import decode, encode
from verification.ranks import RankRow, compared
from verification.rankscenes import KINDS
from verification.ranktrials import QUICK, RANKS, listing, names, units
from verification.report.misses import sentence
from verification.report.ranks import ranks as section

pytestmark = pytest.mark.serial

ROW = RankRow("bend", "curved cantilever, statics", 1e-15, (0.05, 0.12))


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS, ids=[kind.name for kind in KINDS])
def test_two_ranks_find_what_one_finds(kind):
    row = compared(kind.name, kind.title)
    assert row.holds, row.words
    assert min(row.seconds) > 0.0


def test_one_kind_is_compared_in_processes_of_its_own():
    row = compared("bend", "curved cantilever, statics")
    assert row.holds, row.words


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ({"found": [1.0, 2.0 + 1e-6], "seconds": 1.0}, "differ by 5.0e-07"),
        ({"found": [1.0], "seconds": 1.0}, "as many numbers"),
        ({"failure": "no room"}, "no room"),
    ],
)
def test_another_answer_is_told(monkeypatch, told, words):
    """The second of two processes says something else than the first."""
    answers = iter([{"found": [1.0, 2.0], "seconds": 1.0}, told])
    monkeypatch.setattr(ranks, "said", lambda *_: next(answers))
    row = compared("bend", "a bend")
    assert not row.holds
    assert words in sentence(row)
    assert "✗" in section([row])


def test_what_a_process_does_not_survive_is_its_last_word():
    told = processes.said("verification.ranksrun", ("no such kind",))
    assert "not enough values to unpack" in told["failure"]


@pytest.mark.parametrize("text", ['{"found": [1.0]}\n', '\x1b[32m{"found": [1.0]}\x1b[0m\n\x1b[0m\n'])
def test_what_mpirun_colours_is_read(monkeypatch, text):
    monkeypatch.setattr(processes.subprocess, "run", lambda *_, **__: SimpleNamespace(returncode=0, stdout=text))
    assert processes.said("any", (), 2) == {"found": [1.0]}


def test_a_process_that_says_nothing_has_failed(monkeypatch):
    monkeypatch.setattr(processes.subprocess, "run", lambda *_, **__: SimpleNamespace(returncode=0, stdout="\x1b[0m\n"))
    assert processes.said("any", ()) == {"failure": "no word"}


def test_kinds_are_asked_for_by_name():
    assert names() == (RANKS, *(f"{RANKS}:{kind.name}" for kind in KINDS))
    assert len(list(units((RANKS,), quick=False))) == len(KINDS)
    assert [unit.parameters[0] for unit in units((RANKS,), quick=True)] == list(QUICK)
    (unit,) = units((f"{RANKS}:bend",), quick=False)
    assert unit.parameters == ("bend",)
    assert [name for name, _ in listing((f"{RANKS}:bend",))] == [RANKS, f"  {RANKS}:bend"]


def test_rows_are_kept_and_shown():
    assert decode(encode((ROW,))) == (ROW,)
    assert not replace(ROW, apart=2.0 * SAME).holds
    assert not replace(ROW, apart=np.nan).holds
    assert "2.4" in section([ROW])
