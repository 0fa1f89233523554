"""Complaints: who complains, where, and in one piece."""

from __future__ import annotations

import pickle

import pytest

from dolfinrod.scene import SceneError, Section


def test_whoever_knows_the_place_tells_it() -> None:
    with pytest.raises(SceneError) as caught:
        Section(EA=1.0, GA=1.0, GJ=1.0, EI=-1.0)
    error = caught.value
    assert str(error) == "Section.EI must be positive, got -1.0 N m²"
    assert str(error.within("rods[0].section")) == "rods[0].section.EI must be positive, got -1.0 N m²"
    assert str(SceneError("must hold something", field="Guide").within("supports[1].guide")) == (
        "supports[1].guide must hold something"
    )


def test_a_complaint_is_a_value_error_and_travels_between_ranks() -> None:
    error = SceneError("must be positive, got 0.0 m", field="Rod.length")
    assert isinstance(error, ValueError)
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.field, copy.message) == (str(error), error.field, error.message)
    assert str(SceneError("the whole sentence")) == "the whole sentence"
