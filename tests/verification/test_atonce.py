"""Several units of work at once, and those that must run alone."""

from __future__ import annotations

from os import getpid
from typing import TYPE_CHECKING

import pytest

from verification.atonce import at_once
from verification.cold import Cold
from verification.ledger import Ledger, Unit
from verification.machine import this_machine
from verification.workoff import work_off

if TYPE_CHECKING:
    from pathlib import Path


def process() -> Cold:
    """The process in which it runs, in place of its time."""
    return Cold("process", float(getpid()), 0.0)


def sharing() -> tuple[Unit, ...]:
    """Eight units, four of which rest on one solution."""
    return tuple(Unit("cost", f"unit {k}", (k,), process, rests_on="it" if 2 <= k < 6 else "") for k in range(8))


def plan() -> tuple[Unit, ...]:
    """Four units, of which one needs all cores."""
    return tuple(Unit("cost", f"unit {k}", (k,), process, alone=k == 1) for k in range(4))


@pytest.mark.serial
def test_what_compares_times_on_all_cores_waits_until_the_others_are_done(tmp_path: Path) -> None:
    ledger, told = Ledger(tmp_path, this_machine()), list[tuple[int, str, bool]]()
    at_once(plan, ledger, 2, lambda done, unit, recalled: told.append((done, unit.words, recalled)))
    assert [done for done, _, _ in told] == [0, 1, 2]
    assert {words for _, words, _ in told} == {"unit 0", "unit 2", "unit 3"}
    left: list[int] = []
    rows = work_off(plan(), ledger, lambda k, _, recalled: left.append(k) if not recalled else None)
    assert left == [1]
    assert [row.clock == getpid() for row in rows["cost"]] == [False, True, False, False]


@pytest.mark.serial
def test_units_that_rest_on_one_solution_are_done_by_one_process(tmp_path: Path) -> None:
    ledger = Ledger(tmp_path, this_machine())
    at_once(sharing, ledger, 2, lambda *_: None)
    by = [row.clock for row in work_off(sharing(), ledger)["cost"]]
    assert len(set(by[2:6])) == 1
    assert len(by) == 8
    assert getpid() not in by
