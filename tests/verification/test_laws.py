"""Every law of the report's table holds for every model that can be asked."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from verification.laws import LAWS, MODELS, measured
from verification.lawscenes import HERE, MIRRORED, MOVED, Axes, bent

pytestmark = pytest.mark.serial

TESTS = Path(__file__).parents[1]
ASKED = [(law, model) for law in LAWS for model in MODELS if law.holds_for(model)]


@pytest.mark.parametrize(("law", "model"), ASKED, ids=lambda part: part.name.replace(" ", "-"))
def test_every_law_holds(law, model):
    row = measured(law, model)
    assert row.holds, f"{row.statement}: {row.found} exceeds {row.bound}"


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_every_law_names_a_test_that_exists(law):
    file, _, name = law.test.partition("::")
    assert f"def {name}(" in (TESTS / file).read_text(encoding="utf-8")


def test_both_models_are_asked_whatever_both_can_answer():
    for law in LAWS:
        asked = {model.family for model in MODELS if law.holds_for(model)}
        assert asked == ({"continuum"} if law.name == "kinematics" else {"continuum", "discrete"})


@pytest.mark.parametrize("axes", [MOVED, MIRRORED, Axes(metre=1e-12, newton=1e12)], ids=["moved", "mirrored", "units"])
def test_a_scene_and_its_image_have_the_same_stress_free_shape(axes):
    here, there = (bent(a, flat=False).rods[0] for a in (HERE, axes))
    s = np.linspace(0.0, 1.0, 5)
    r = there.centerline(s * axes.metre) / axes.metre
    np.testing.assert_allclose((r - np.asarray(axes.origin)) @ axes.Q, here.centerline(s), rtol=0, atol=1e-14)
    np.testing.assert_allclose(axes.Q.T @ there.frames(s * axes.metre) * axes.sections, here.frames(s), atol=1e-14)


def test_a_violated_law_is_seen():
    """A scene that is not moved with its axes is no image."""
    law = next(law for law in LAWS if law.name == "objectivity")
    row = measured(law, MODELS[0])
    assert row.holds
    assert not type(row)(**{**vars(row), "found": np.nan}).holds
