"""Critical loads of columns and strips: order 2 in the element length, multiplicities, what lies before them."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.scenes import FLAT, KIRCHHOFF, SKEW, Pose, orders

SLIDING = dr.Guide("end", free={"x"})
PINNED = dr.Guide("end", free={"x", "rx", "ry", "rz"})
ENDS = {
    "clamped-free": [dr.Clamp("start")],
    "pinned": [dr.Pin("start"), PINNED],
    "clamped-pinned": [dr.Clamp("start"), PINNED],
    "clamped": [dr.Clamp("start"), SLIDING],
}
# Euler: cases F1, EA and GA infinite, in EI/L².
EULER = {
    "clamped-free": 2.4674011002723395,
    "pinned": 9.869604401089358,
    "clamped-pinned": 20.19072855642663,
    "clamped": 39.47841760435743,
}
HEAVY = dr.Section(GJ=1.0, EI=1.0, rhoA=1.0, rigid={"shear", "extension"})


def column(supports, section=KIRCHHOFF, force: float = 1.0) -> dr.Scene:
    return dr.Scene([FLAT.straight(section)], supports, [dr.PointForce((-force, 0, 0), "end")])


@pytest.mark.parametrize("ends", ENDS)
def test_eulers_columns_buckle_in_both_planes_with_order_two(ends):
    n = [10, 20, 40]
    found = [discrete.buckling(column(ENDS[ends]), modes=2, elements=k) for k in n]
    errors = [b.factors[0] - EULER[ends] for b in found]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.03)
    assert errors[-1] < 2.5e-3 * EULER[ends]
    assert found[-1].multiplicity.tolist() == [2, 2]


def test_one_element_buckles_at_twelve_over_pi_squared():
    """process.md 1.4: 3 EI/l² for the paper's F_n/l; rigid extension stands for EA = 1e8."""
    assert discrete.buckling(column(ENDS["clamped-free"]), modes=1, elements=1).factors == pytest.approx(
        [3.0], rel=1e-6
    )


@pytest.mark.parametrize("ends", ["clamped-free", "pinned", "clamped"])
def test_compression_before_buckling_is_in_the_critical_load(ends):
    """P (1 − P/EA) = P_E without shear, F1; the mesh sees its own P_E, that of `buckling` of the inextensible rod."""
    EA, n = 1200.0, 20
    P_E = discrete.buckling(column(ENDS[ends]), modes=1, elements=n).factors[0]
    section = dr.Section(EA=EA, GA=1.0, GJ=1.0, EI=1.0)
    found = discrete.critical(column(ENDS[ends], section, 60.0), modes=2, elements=n)
    P = 60.0 * found.factors[0]
    assert P * (1 - P / EA) == pytest.approx(P_E, rel=2e-3)
    assert found.multiplicity.tolist() == [2, 2]
    assert found.at.t[-1] < found.factors[0]


def test_modes_of_a_column_are_sines_and_normalised():
    found = discrete.buckling(column(ENDS["pinned"]), modes=4, elements=20)
    shape = found.rods[0]
    assert shape.displacement.shape == shape.spin.shape == (4, 21, 3)
    size = np.linalg.norm(shape.displacement, axis=2)
    assert size.max(axis=1) == pytest.approx(1.0)
    for k, wave in enumerate((1, 1, 2, 2)):
        assert size[k] == pytest.approx(np.abs(np.sin(wave * np.pi * shape.s)), abs=1e-2)


def test_a_heavy_column_buckles_under_its_own_weight():
    """Greenhill, case J3: w L³/EI = 7.837347438943484."""
    n = [10, 20, 40]
    scene = dr.Scene([FLAT.straight(HEAVY)], [dr.Clamp("start")], [dr.Gravity((-10.0, 0.0, 0.0))])
    found = [discrete.critical(scene, modes=2, elements=k) for k in n]
    errors = [10.0 * b.factors[0] - 7.837347438943484 for b in found]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.05)
    assert abs(errors[-1]) < 1e-3
    assert found[-1].multiplicity.tolist() == [2, 2]


@pytest.mark.parametrize(
    ("EI3", "P"),
    [
        pytest.param(100.0, 4.0596284170096615, marks=pytest.mark.slow),
        (20.0, 4.274845164961501),
    ],
)
@pytest.mark.parametrize("pose", [FLAT, pytest.param(SKEW, marks=pytest.mark.slow)], ids=["flat", "skew"])
def test_a_strip_buckles_sideways_after_it_has_bent(EI3, P, pose: Pose):
    """Prandtl–Michell with the deflection before it, cases I2 (Kirchhoff)."""
    n = [20, 40]
    section = dr.Section(GJ=1.0, EI=(1.0, EI3), rigid={"shear", "extension"})
    scene = dr.Scene(
        [pose.straight(section)], [dr.Clamp("start")], [dr.PointForce(pose.turned((0.0, -6.0, 0.0)), "end")]
    )
    errors = [6.0 * discrete.critical(scene, modes=1, elements=k).factors[0] - P for k in n]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.02)
    assert abs(errors[-1]) < 2e-3


@pytest.mark.slow
def test_prandtls_strip_does_not_bend_in_its_plane():
    """Case I1; taken for EI₃ = 1e8 EI₂, which moves the load by 1e-8 of it."""
    n = [20, 40]
    section = dr.Section(GJ=1.0, EI=(1.0, 1e8), rigid={"shear", "extension"})
    scene = dr.Scene([FLAT.straight(section)], [dr.Clamp("start")], [dr.PointForce((0.0, -6.0, 0.0), "end")])
    errors = [6.0 * discrete.critical(scene, modes=1, elements=k).factors[0] - 4.012599343578901 for k in n]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.02)


@pytest.mark.parametrize("ends", ENDS)
@pytest.mark.parametrize("elements", [20, 320])
def test_a_column_that_bends_a_little_buckles_where_a_straight_one_does(ends, elements):
    """Elements turn with the rod, and what they turn by stands in no tangent: least of all that of short ones."""
    beside = [dr.PointForce((0.0, 0.15, 0.05), "end"), dr.LineForce((0.0, 1.5, 0.5))]
    straight, section = column(ENDS[ends], force=30.0), dr.Section(EA=640e3, GJ=0.77, EI=(1.0, 1.2), rigid={"shear"})
    scene = replace(straight, rods=[dr.Rod.straight(1.0, section)], loads=[*straight.loads, *beside])
    found = discrete.buckling(scene, modes=2, elements=elements)
    np.testing.assert_allclose(30.0 * found.factors, EULER[ends] * np.array([1.0, 1.2]), rtol=1e-2)
    # Modes are of the rod as it hangs in its supports then, not in axes of its own.
    held = found.rods[0].displacement[:, [0] if ends == "clamped-free" else [0, -1], 1:]
    np.testing.assert_allclose(held, 0.0, atol=1e-9)


def test_round_off_is_refused_before_it_shows():
    """Of ω² on 2000 elements a part in a thousand is round-off, of a critical load as much."""
    rod = dr.Rod.straight(1.0, replace(HEAVY, rigid={"shear"}, EA=640e3), direction=(0.3, -0.7, 0.45))
    clamped, pushed = dr.Scene([rod], [dr.Clamp("start")]), dr.PointForce((-0.3, 0.7, -0.45), "end")
    for analysis in (discrete.modes, partial(discrete.buckling, modes=1)):
        scene = clamped if analysis is discrete.modes else replace(clamped, loads=[pushed])
        assert analysis(scene, elements=1000) is not None
        with pytest.raises(dr.SceneError, match=r"elements must be fewer: .* on 3000, .*continuum model"):
            analysis(scene, elements=3000)


def test_a_path_without_critical_points_has_none():
    found = discrete.critical(column(ENDS["pinned"], force=5.0), elements=10)
    assert found.factors.shape == found.multiplicity.shape == (0,)
    assert found.rods[0].displacement.shape == (0, 11, 3)
    pulled = discrete.buckling(column(ENDS["clamped-free"], force=-1.0), elements=10)
    assert len(pulled.factors) == 0


def test_an_estimate_from_a_loaded_state_is_the_better_the_nearer_it_is():
    section = dr.Section(GJ=1.0, EI=(1.0, 20.0), rigid={"shear", "extension"})

    def strip(P: float) -> dr.Scene:
        history = ((0.0, 0.0), (10.0, 10.0))
        return dr.Scene(
            [FLAT.straight(section)],
            [dr.Clamp("start")],
            [dr.PointForce((0.0, -1.0, 0.0), "end", history=history)],
            motion=dr.Static(t_end=P),
        )

    exact = discrete.critical(strip(6.0), modes=1, elements=20).factors[0]
    errors = []
    for P in (2.0, 3.0, 4.0):
        scene = strip(P)
        found = discrete.buckling(scene, modes=1, at=discrete.solve(scene, elements=20))
        errors.append(abs(found.factors[0] - exact))
    assert errors[0] > 2 * errors[1] > 8 * errors[2]


def test_what_is_missing_is_said_in_words():
    with pytest.raises(dr.SceneError, match=r"rods\[0\]\.section\.rhoA .* needed for frequencies"):
        discrete.modes(column(ENDS["pinned"]))
    with pytest.raises(dr.SceneError, match="nothing varies"):
        discrete.buckling(dr.Scene([FLAT.straight(HEAVY)], [dr.Clamp("start")]))
    with pytest.raises(dr.SceneError, match="result of this scene"):
        discrete.buckling(column(ENDS["pinned"]), at=discrete.solve(column(ENDS["clamped"]), elements=4))
    with pytest.raises(dr.SceneError, match="modes"):
        discrete.buckling(column(ENDS["pinned"]), modes=0)
