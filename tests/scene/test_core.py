"""A core as a rod: a solid cylinder that stays straight, with guides that leave free what should be."""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.scene import SceneError
from dolfinrod.scene.core import STRAIGHT
from dolfinrod.scene.toml import dumps, loads

sizes = st.floats(1e-3, 1e3)
ROUND = dr.Section.circle(diameter=0.2, E=1e9, G=4e8, density=1e3)


@given(sizes, sizes, sizes)
def test_a_solid_core_has_mass_and_inertia_of_a_cylinder_and_sways_by_little(
    radius: float, length: float, density: float
) -> None:
    core = dr.Core((1, 2, 3), (0, 0, 2), radius, length, density=density)
    section = core.rod.section
    assert section.rhoA is not None
    assert section.rhoI is not None
    assert section.rhoA == pytest.approx(density * pi * radius**2)
    assert section.rhoI[0] == pytest.approx(0.5 * section.rhoA * radius**2)
    assert section.radius == radius
    assert section.rigid == {"shear"}
    weight = section.rhoA * length * 9.81
    assert weight * length**3 / (12.0 * section.EI[0]) == pytest.approx(STRAIGHT * radius)
    assert section.GJ == pytest.approx(section.EI[0])
    np.testing.assert_allclose(core.rod.centerline(np.array([0.0, length])), [(1, 2, 3), (1, 2, 3 + length)])


@pytest.mark.parametrize(
    ("axis", "free", "start", "end"),
    [
        ((1, 0, 0), ("y", "z", "roll"), {"y", "z", "rx"}, {"x", "y", "z", "rx"}),
        ((0, -2, 0), {"x", "roll"}, {"x", "ry"}, {"x", "y", "z", "ry"}),
        ((0, 0, 1), ["roll"], {"rz"}, {"x", "y", "z", "rz"}),
        ((1, 1, 0), ("z",), {"z"}, {"x", "y", "z"}),
        ((1, 0, 0), (), set(), {"x", "y", "z"}),
    ],
)
def test_guides_hold_what_is_not_free_and_both_ends_parallel(
    axis: tuple[float, ...], free: object, start: set[str], end: set[str]
) -> None:
    core = dr.Core((0, 0, 0), axis, 0.1, 1.0, density=1e3, free=free)
    assert core.supports(3) == (dr.Guide("start", start, rod=3), dr.Guide("end", end, rod=3))


def test_a_core_belongs_to_a_scene_as_its_rod_and_its_supports() -> None:
    core = dr.Core((0, 0, 0.1), (1, 0, 0), 0.1, 1.0, density=1e3)
    fibre = dr.Rod.straight(1.0, dr.Section.ramie(), start=(0, 0, 0.3))
    scene = dr.Scene(
        [fibre, core.rod],
        core.supports(1),
        contacts=[dr.RodContact(), dr.Contact(dr.Plane(), rod=1)],
        motion=dr.Dynamic(1.0),
    )
    assert loads(dumps(scene)) == (scene, {})


def test_stiffness_and_section_may_be_given() -> None:
    assert dr.Core((0, 0, 0), (1, 0, 0), 0.1, 1.0, density=1e3, E=1e9).rod.section.EI[0] == pytest.approx(
        1e9 * pi * 0.1**4 / 4
    )
    assert dr.Core((0, 0, 0), (1, 0, 0), 0.1, 1.0, section=ROUND).rod.section == ROUND


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda core: core(radius=0.0), r"^Core\.radius must be positive, got 0\.0 m$"),
        (lambda core: core(length=-1.0), r"^Core\.length must be positive, got -1\.0 m$"),
        (lambda core: core(point=(0, 0)), r"^Core\.point must have 3 entries \[m\], got \(0, 0\)$"),
        (lambda core: core(axis=(0, 0, 0)), r"^Core\.axis must not be zero"),
        (lambda core: core(axis=(1, 1, 0)), r"^Core\.axis must be along x, y or z, since the core may roll about it"),
        (lambda core: core(free=("rx",)), r"^Core\.free must be a set of names out of x, y, z, roll, got \('rx',\)$"),
        (lambda core: core(density=None), r"^Core\.density is missing$"),
        (lambda core: core(density=0.0), r"^Core\.density must be positive, got 0\.0 kg/m³$"),
        (lambda core: core(E=0.0), r"^Core\.E must be positive, got 0\.0 Pa$"),
        (lambda core: core(section=ROUND), r"^Core\.density must be left out where section is given, got 1000\.0$"),
        (
            lambda core: core(section=ROUND, density=None, E=1.0),
            r"^Core\.E must be left out where section is given, got 1\.0$",
        ),
        (
            lambda core: core(section=ROUND, density=None, radius=0.2),
            r"^Core\.section\.radius must be the radius of the core, 0\.2 m, got 0\.1 m$",
        ),
        (lambda core: core(section="ramie", density=None), r"^Core\.section must be a Section or None, got 'ramie'$"),
    ],
)
def test_a_core_that_cannot_be_is_refused_in_words(
    make: Callable[[Callable[..., dr.Core]], object], message: str
) -> None:
    def core(**fields: object) -> dr.Core:
        usual = {"point": (0, 0, 0), "axis": (1, 0, 0), "radius": 0.1, "length": 1.0, "density": 1000.0}
        return dr.Core(**usual | fields)

    with pytest.raises(SceneError, match=message):
        make(core)
