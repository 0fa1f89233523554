"""Critical loads: classical columns, twisted rods and strips, their multiplicity, and the order they converge with."""

from __future__ import annotations

from dataclasses import replace

from mpi4py import MPI

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.scenes import FLAT, KIRCHHOFF

# Pinned-pinned, clamped-free, clamped-clamped, clamped-pinned, the far end sliding along x.
ENDS = {
    "PP": (dr.Pin("start"), dr.Guide("end", free={"x", "rx", "ry", "rz"})),
    "CF": (dr.Clamp("start"),),
    "CC": (dr.Clamp("start"), dr.Guide("end", free={"x"})),
    "CP": (dr.Clamp("start"), dr.Guide("end", free={"x", "rx", "ry", "rz"})),
}
# Reference cases F1: characteristic equations of the column L = EI = 1 (Timoshenko & Gere; Haringx; Reissner).
EULER = {"PP": 9.869604401089358, "CF": 2.4674011002723395, "CC": 39.47841760435743, "CP": 20.19072855642663}
# The same with EA = 1200 and GA = 500.
FLEXIBLE = {"PP": 9.758504587344596, "CF": 2.460338954539246, "CC": 37.810510453479324, "CP": 19.659928765004725}
SOFT = dr.Section(EA=1200.0, GA=500.0, GJ=1 / 1.3, EI=1.0)
# Reference cases G12: M L/EI of a rod between position pins (Greenhill), between clamps, by compression P L²/EI.
TWIST = {0: (6.283185307179586, 8.986818915818128), 5: (4.413436031524354, 8.232810781020973)}
TWIST |= {-20: (10.930618354162652, 11.800329535425245)}
COMPRESS, THEN_TWIST = ((0.0, 0.0), (1.0, 1.0)), ((1.0, 0.0), (2.0, 1.0))
BEND = COMPRESS
# Reference cases G3 (Michell 1889; Zajac 1962): twist 2π √3 EI/GJ of a ring of any radius, by GJ/EI.
RING = {1.0: 10.882796185405308, 0.75: 14.510394913873743}


def column(section: dr.Section, ends: str, P: float = 50.0) -> dr.Scene:
    """Under a dead load that grows to P."""
    return dr.Scene([FLAT.straight(section)], ENDS[ends], [dr.PointForce((-P, 0, 0), "end")])


def twisted(P: float, M: float, *, clamped: bool) -> dr.Scene:
    """Compressed until t = 1, then twisted until t = 2."""
    free = {"x", "rx"} if clamped else {"x", "rx", "ry", "rz"}
    loads = [dr.PointForce((-P, 0, 0), "end", history=COMPRESS), dr.PointMoment((M, 0, 0), "end", history=THEN_TWIST)]
    if not clamped:
        loads.append(dr.PointMoment((-M, 0, 0), "start", history=THEN_TWIST))
    start = dr.Clamp("start") if clamped else dr.Pin("start")
    rod = FLAT.straight(KIRCHHOFF)
    return dr.Scene([rod], [start, dr.Guide("end", free=free)], loads, motion=dr.Static(t_end=2.0))


def strip(EI_3: float, **elastic: float) -> dr.Scene:
    """A cantilever bent in its stiff plane; EI2 = GJ = 1."""
    rigid = {} if elastic else {"rigid": {"shear", "extension"}}
    section = dr.Section(GJ=1.0, EI=(1.0, EI_3), **rigid, **elastic)
    return dr.Scene([FLAT.straight(section)], [dr.Clamp("start")], [dr.PointForce((0, -10.0, 0), "end")])


def ring(twist: float, GJ: float = 1.0, t_end: float = 2.0, EA: float = 1e8) -> dr.Scene:
    """A straight rod of length 2π bent to arcs of ever smaller radius, closed at t = 1, then twisted until t = 2.

    Held at both ends it is straight only if it can be stretched; EA = 10⁸ moves the critical twist by 1e-8. From
    t = 1 on a round ring may roll through itself: its middle stays in the plane.
    """

    def chord(t: float) -> float:
        return float(2 * np.pi * (np.sinc(2 * min(t, 1.0)) - 1.0))

    def height(t: float) -> float:
        return float(2 * np.pi * np.sin(np.pi * min(t, 1.0)) * np.sinc(min(t, 1.0)))

    section = dr.Section(EA=EA, GJ=GJ, EI=1.0, rigid={"shear"})
    rod = dr.Rod.straight(length=2 * np.pi, section=section, start=(0, 0, 0), direction=(1, 0, 0))
    supports = [
        dr.Prescribed("start", displacement=(0, 0, 0), rotation=(twist, 0, 0), history=THEN_TWIST),
        dr.Prescribed("end", rotation=(0, 0, 2 * np.pi), history=BEND),
        dr.Prescribed("end", displacement=(1.0, None, None), history=chord),
        dr.Prescribed("end", displacement=(None, 1.0, None), history=height),
        dr.Prescribed("end", displacement=(None, None, 0.0)),
        dr.Prescribed(np.pi, displacement=(None, None, 0.0)),
    ]
    return dr.Scene([rod], supports, motion=dr.Static(t_end=t_end))


@pytest.mark.parametrize("ends", ENDS)
def test_straight_inextensible_column_needs_no_path(ends):
    """Its tangent changes linearly with the load; the round section buckles in every direction."""
    found = dr.buckling(column(KIRCHHOFF, ends), elements=8, modes=2)
    np.testing.assert_allclose(50 * found.factors, EULER[ends], rtol=3e-6)
    np.testing.assert_array_equal(found.multiplicity, 2)
    assert found.complex_factors.size == 0


@pytest.mark.parametrize("ends", ["CP", *(pytest.param(k, marks=pytest.mark.slow) for k in ("PP", "CF", "CC"))])
def test_flexible_column(ends):
    found = dr.critical(column(SOFT, ends), elements=16, modes=1)
    assert 50 * found.factors[0] == pytest.approx(FLEXIBLE[ends], rel=1e-7)
    assert found.multiplicity[0] == 2
    assert 0.999 * found.factors[0] < found.at.t[-1] < found.factors[0]


def test_weaker_direction_first():
    """EI2 resists deflection along d3, EI3 along d2."""
    section = dr.Section(GJ=1.0, EI=(1.0, 1.5), rigid={"shear", "extension"})
    found = dr.buckling(column(section, "PP"), elements=8, modes=3)
    np.testing.assert_allclose(50 * found.factors / np.pi**2, [1.0, 1.5, 4.0], rtol=1e-5)
    np.testing.assert_array_equal(found.multiplicity, 1)
    shapes, s = found.rods[0].displacement, found.rods[0].s
    wave = np.array([np.sin(np.pi * s), np.sin(np.pi * s), np.sin(2 * np.pi * s)])
    np.testing.assert_allclose(np.abs(shapes[[0, 1, 2], :, [2, 1, 2]]), np.abs(wave), atol=2e-3)
    np.testing.assert_allclose(shapes[[0, 1, 2], :, [1, 2, 1]], 0.0, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(shapes, axis=2).max(axis=1), 1.0)
    # The section stays normal to the line: spin e₁ × u′, π per unit of displacement at the ends.
    np.testing.assert_allclose(np.linalg.norm(found.rods[0].spin[:2, 0], axis=1), np.pi, rtol=1e-3)


def test_within_its_plane():
    """The stiff direction is all that is left in the plane z = 0."""
    section = dr.Section(GJ=1.0, EI=(1.0, 1.5), rigid={"shear", "extension"})
    scene = column(section, "PP")
    found = dr.buckling(scene, elements=8, modes=1, kinematics=dr.Planar((0, 0, 1)))
    np.testing.assert_allclose(50 * found.factors / np.pi**2, [1.5], rtol=1e-6)


def test_from_a_loaded_state():
    scene = column(SOFT, "CF", P=2.0)
    result = dr.solve(scene, elements=4)
    estimates = [2 * dr.buckling(scene, at=at, elements=4, modes=1).factors[0] for at in (None, result)]
    errors = np.abs(np.array(estimates) - FLEXIBLE["CF"])
    assert errors[1] < 0.1 * errors[0]


def test_steady_load_is_part_of_the_state():
    """A column under 3/5 of its Euler load bears two fifths of it more."""
    scene = column(KIRCHHOFF, "PP")
    steady = dr.PointForce((-0.6 * np.pi**2, 0, 0), "end", history=dr.Steady())
    found = dr.buckling(replace(scene, loads=[*scene.loads, steady]), elements=8, modes=1)
    assert 50 * found.factors[0] == pytest.approx(0.4 * np.pi**2, rel=1e-6)


def test_tension_is_never_critical():
    assert dr.buckling(column(KIRCHHOFF, "CC", P=-50.0), elements=4).factors.size == 0
    assert dr.critical(column(KIRCHHOFF, "CF", P=2.0), elements=4).factors.size == 0


def test_turns_that_loads_resist_stay_free():
    """A rod hung from a pin, then pushed up with less than its weight: its swing is no neutral motion."""
    stiff = dr.Section(GJ=1e3, EI=1e3, rhoA=1.0, rigid={"shear", "extension"})
    rod = dr.Rod.straight(length=1.0, section=stiff, start=(0, 0, 0), direction=(0, 0, -1))
    loads = [dr.Gravity((0, 0, -2.0), history=dr.Steady()), dr.PointForce((0, 0, 4.0), "end")]
    found = dr.buckling(dr.Scene([rod], [dr.Pin("start")], loads), elements=6, modes=2)
    # Moments about the pin balance at half the weight.
    np.testing.assert_allclose(4.0 * found.factors, 1.0, rtol=1e-4)
    np.testing.assert_array_equal(found.multiplicity, 2)


def test_nothing_varies():
    scene = column(KIRCHHOFF, "CF")
    scene = replace(scene, loads=[replace(scene.loads[0], history=dr.Steady())])
    with pytest.raises(dr.SceneError, match="nothing varies"):
        dr.buckling(scene, elements=4)


def test_state_of_another_scene():
    result = dr.solve(column(KIRCHHOFF, "CF", P=1.0), elements=4)
    with pytest.raises(dr.SceneError, match="same scene"):
        dr.buckling(column(KIRCHHOFF, "CF"), at=result, elements=4)
    with pytest.raises(dr.SceneError, match="same elements"):
        dr.buckling(column(KIRCHHOFF, "CF", P=1.0), at=result, elements=5)


@pytest.mark.parametrize("analysis", [dr.buckling, dr.modes])
def test_at_is_a_result_of_this_model(analysis):
    section = dr.Section(GJ=1.0, EI=1.0, rhoA=1.0, rhoI=(0, 0, 0), rigid={"shear", "extension"})
    scene = column(section, "CF", P=1.0)
    for at in (discrete.solve(scene, elements=4), scene, "out/"):
        with pytest.raises(dr.SceneError, match=r"at must be a result of `dolfinrod\.solve`"):
            analysis(scene, at=at, elements=4)


@pytest.mark.parametrize("analysis", [dr.buckling, dr.critical, dr.modes])
@pytest.mark.parametrize("n", [0, -1, 2.5, True, "3", 1001])
def test_number_of_modes(analysis, n):
    with pytest.raises(dr.SceneError, match="modes must be"):
        analysis(column(SOFT, "CF"), modes=n)


@pytest.mark.parametrize(
    ("P", "clamped"),
    [(0, True), *(pytest.param(P, c, marks=pytest.mark.slow) for P in TWIST for c in (False, True) if P or not c)],
)
def test_compressed_then_twisted(P, clamped):
    found = dr.critical(twisted(P, 20.0, clamped=clamped), elements=16, modes=1)
    assert 20 * (found.factors[0] - 1) == pytest.approx(TWIST[P][clamped], rel=1e-7)
    assert found.multiplicity[0] == 2


# Reference cases I2: shooting, pre-buckling deflection included; inextensible, and with EA and GA.
STRIPS = {
    "EI3 = 20": (strip(20.0), 4.274845164961501, 12),
    "elastic": (strip(20.0, EA=1e4, GA=4e3), 4.275101236738336, 12),
    # Own shooting (Kirchhoff rod, DOP853 at 1e-13, lateral state about the planar elastica); I2 has 4.0596284, which
    # that shooting and every mesh miss by the same 2.5e-7.
    "EI3 = 100": (strip(100.0), 4.0596274055, 16),
}


@pytest.mark.parametrize("name", ["EI3 = 20", *(pytest.param(k, marks=pytest.mark.slow) for k in list(STRIPS)[1:])])
def test_strip_buckles_sideways(name):
    scene, P, elements = STRIPS[name]
    found = dr.critical(scene, elements=elements, modes=1)
    assert 10 * found.factors[0] == pytest.approx(P, rel=1e-7)
    assert found.multiplicity[0] == 1


def test_planar_state_is_judged_in_space():
    """A strip loaded to 99.9 % of its lateral buckling load, solved in its plane."""
    scene, P, _ = STRIPS["EI3 = 20"]
    near = replace(scene, loads=[dr.PointForce((0, -0.999 * P, 0), "end")])
    result = dr.solve(near, elements=12)
    assert result.formulation.kinematics == "planar"
    found = dr.buckling(near, at=result, elements=12, modes=1)
    assert found.factors[0] == pytest.approx(1 / 0.999, rel=1e-6)
    assert found.at.formulation.kinematics == "spatial"


@pytest.mark.slow
@pytest.mark.parametrize("GJ", [1.0, 0.75])
def test_ring_leaves_its_plane(GJ):
    """With the two shapes cos 2φ and sin 2φ."""
    twist = 1.2 * RING[GJ]
    found = dr.critical(ring(twist, GJ), elements=24, modes=2)
    np.testing.assert_allclose((found.factors - 1.0) * twist, RING[GJ], rtol=5e-7)
    np.testing.assert_array_equal(found.multiplicity, 2)
    assert found.at.log[-1].stable


@pytest.mark.slow
def test_ring_from_a_twisted_state():
    """Half way to it the critical twist is seen to 1e-6, of each of the two shapes."""
    twist = 1.2 * RING[1.0]
    scene = ring(twist, t_end=1.5, EA=1e6)
    result = dr.solve(scene, elements=12, degree=4)
    found = dr.buckling(scene, at=result, elements=12, degree=4, modes=2)
    np.testing.assert_allclose((found.factors - 1.0) * twist, RING[1.0], rtol=1e-6)
    assert len(found.factors) == 2


@pytest.mark.slow
def test_ring_rolls_through_itself():
    """A round ring with nothing but its ends held turns about their tangent as soon as it is closed."""
    scene = ring(10.0)
    free = dr.critical(replace(scene, supports=scene.supports[:-1]), elements=12, modes=1)
    assert free.factors[0] == pytest.approx(1.0, abs=1e-6)
    assert free.multiplicity[0] == 1
    # About the tangent at the ends, which is x: the farthest point moves most, out of the plane.
    shape, s = free.rods[0].displacement[0], free.rods[0].s
    np.testing.assert_allclose(np.abs(shape[:, 2]), 0.5 * (1.0 - np.cos(s)), atol=1e-4)
    np.testing.assert_allclose(shape[:, :2], 0.0, atol=1e-4)


def test_self_buckling():
    """Reference case J3 (Greenhill 1881): w L³/EI = 7.8373, a Bessel zero."""
    section = dr.Section(GJ=1.0, EI=1.0, rhoA=1.0, rigid={"shear", "extension"})
    rod = dr.Rod.straight(length=1.0, section=section, start=(0, 0, 0), direction=(0, 0, 1))
    found = dr.critical(dr.Scene([rod], [dr.Clamp("start")], [dr.Gravity((0, 0, -20.0))]), elements=8, modes=2)
    np.testing.assert_allclose(20 * found.factors, 7.837347438943484, rtol=1e-7)
    np.testing.assert_array_equal(found.multiplicity, 2)


@pytest.mark.parametrize(
    ("degree", "elements"), [pytest.param(1, (8, 16), marks=pytest.mark.slow), (2, (4, 8)), (3, (2, 4))]
)
def test_order(degree, elements):
    """Twice the degree, as of every energy."""
    scene = column(KIRCHHOFF, "CP")
    loads = [50 * dr.buckling(scene, elements=n, degree=degree, modes=1).factors[0] for n in elements]
    errors = np.abs(np.array(loads) - EULER["CP"])
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2 * degree, abs=0.4)


# Scene, critical pseudo-time, and the coarsest mesh on which the order of degree 3 shows.
ON_THE_WAY = {
    "strip": (strip(20.0), STRIPS["EI3 = 20"][1] / 10, 4),
    "twist": (twisted(5.0, 20.0, clamped=True), 1 + TWIST[5][1] / 20, 8),
    "flexible": (column(SOFT, "CP"), FLEXIBLE["CP"] / 50, 4),
}


@pytest.mark.slow
@pytest.mark.parametrize("degree", [2, 3])
@pytest.mark.parametrize("name", ON_THE_WAY)
def test_order_on_the_way(name, degree):
    """The same where rods bend, twist or shorten before they buckle."""
    scene, factor, coarse = ON_THE_WAY[name]
    n = coarse if degree == 3 else 8
    errors = [abs(dr.critical(scene, elements=m, degree=degree, modes=1).factors[0] - factor) for m in (n, 2 * n)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2 * degree, abs=0.4)


def test_any_units():
    """A fibre of 20 µm and a mast of the same proportions."""
    factors = []
    for unit in (1e-6, 1e3):
        section = dr.Section.circle(diameter=0.02 * unit, E=1e9, G=4e8)
        rod = dr.Rod.straight(length=unit, section=section, start=(0, 0, 0), direction=(1, 0, 0))
        load = dr.PointForce((-section.EI[0] / unit**2, 0, 0), "end")
        factors.append(dr.buckling(dr.Scene([rod], ENDS["CF"], [load]), elements=4, modes=2).factors)
    np.testing.assert_allclose(factors[0], factors[1], rtol=1e-9)
    assert factors[0][0] == pytest.approx(np.pi**2 / 4, rel=1e-3)


@pytest.mark.parametrize("scene", [column(SOFT, "PP"), twisted(5.0, 20.0, clamped=False), strip(20.0)])
def test_same_on_any_number_of_ranks(scene):
    together, alone = (dr.buckling(scene, elements=6, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    np.testing.assert_allclose(together.factors, alone.factors, rtol=1e-10)
    np.testing.assert_array_equal(together.multiplicity, alone.multiplicity)
