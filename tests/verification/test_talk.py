"""What runs beside other people's solvers: how often it times a solve."""

from __future__ import annotations

import pytest

from verification.peers import talk


@pytest.mark.parametrize(("long", "solves"), [(0.0, 1), (60.0, 3)], ids=["long", "short"])
def test_a_long_solve_is_not_repeated(monkeypatch, long, solves):
    called = []

    def build(_problem, _settings):
        return lambda: called.append(1) or [[0.0, 0.0, 0.0]]

    monkeypatch.setattr(talk, "LONG", long)
    found = talk.timed(build, {}, {}, (3, 60.0))
    assert len(called) == solves
    assert found["tip"] == [[0.0, 0.0, 0.0]]
    assert found["seconds"]["solve"] <= found["seconds"]["first"]
