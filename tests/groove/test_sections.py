"""Cross-sections: the points that process and paper give, cylinders that touch what they must, left and right."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dolfinrod.groove import CrossSection
from dolfinrod.groove.sections import KINDS
from dolfinrod.scene import SceneError

CORE = 0.08e-3
every_kind = pytest.mark.parametrize("kind", KINDS)


def distances(section: CrossSection, y: float, z: float, *, mirrored: bool = False) -> list[float]:
    """From each face [m]."""
    faces = section.surfaces(None, mirrored=mirrored)
    return [float(face.closest(np.array([[0.01, y, z]])).distance[0]) for face in faces]


# Design notes on the process, 6.2 and 6.3, in mm to the digits given there: lip, bottom, right lip; core.
@pytest.mark.parametrize(
    ("kind", "points", "seat"),
    [
        ("lateral", [(-1.5, 0.0), (0.0, -0.402), (0.108, 0.0)], (-0.304, -0.057)),
        ("intermediate", [(-1.5, 0.0), (0.0, -0.402), (1.5, 0.0)], (-0.319, 0.0)),
        ("lateral_steep", [(-1.108, 0.0), (-1.0, -0.402), (0.0, -0.402), (0.108, 0.0)], None),
    ],
)
def test_default_sections_are_those_of_the_process(kind, points, seat):
    section = CrossSection.of(kind)
    profile = 1e3 * np.asarray(section._groove().profile)
    assert profile[1:-1] == pytest.approx(np.array(points), abs=5e-4)
    assert profile[[0, -1], 1].tolist() == [0.0, 0.0]
    if seat is not None:
        assert 1e3 * np.array(section.seat(CORE)) == pytest.approx(seat, abs=5e-4)


@every_kind
def test_a_core_in_the_bottom_touches_both_flanks(kind):
    section = CrossSection.of(kind)
    touched = sorted(distances(section, *section.seat(CORE)))
    assert touched[:2] == pytest.approx([CORE, CORE], rel=1e-9)


@settings(max_examples=20)
@given(st.floats(0.1, 1.4), st.floats(0.1, 1.4), st.floats(1e-5, 1e-4))
def test_any_v_holds_any_core_as_thick_as_it_is_deep(left, right, radius):
    section = CrossSection(left, right)
    assert distances(section, *section.seat(radius)) == pytest.approx([radius, radius], rel=1e-6)


def test_a_core_in_a_wider_fillet_touches_its_middle():
    section = CrossSection(fillet=0.15e-3)
    (distance,) = distances(section, *section.seat(CORE))
    assert distance == pytest.approx(CORE, rel=1e-9)
    assert section.seat(CORE)[0] < CrossSection().seat(CORE)[0] + 1e-4


@every_kind
def test_a_core_on_the_ramp_touches_it(kind):
    section = CrossSection.of(kind)
    y, z = section.ramp(-0.9e-3, CORE)
    assert z == -0.9e-3
    assert min(distances(section, y, z)) == pytest.approx(CORE, rel=1e-9)


@every_kind
@settings(max_examples=20)
@given(y=st.floats(-3e-4, 1e-3), z=st.floats(-2e-3, 2e-3))
def test_a_mirrored_groove_is_as_far_on_the_other_side(kind, y, z):
    section = CrossSection.of(kind)
    mirrored = distances(section, y, -z, mirrored=True)
    assert min(mirrored) == pytest.approx(min(distances(section, y, z)), abs=1e-15)


def test_metres_are_meant():
    with pytest.raises(SceneError, match=r"CrossSection.half_width must lie between 1e-05 and 0.1 m, got 1.5 m"):
        CrossSection(half_width=1.5)
    with pytest.raises(SceneError, match=r"CrossSection.beta_left must lie between 0.01 and 1.5708 rad, got 15.0 rad"):
        CrossSection(beta_left=15.0)
    with pytest.raises(SceneError, match=r"Groove.depth must be at most"):
        CrossSection(depth=1e-3)
