"""Unstable directions just below and just above known critical points, and the way the stepping takes round them."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import both_kinematics

EULER = np.pi**2 / 4  # clamped and free, EI = L = 1
RIGID = dr.Section(GJ=0.8, EI=1.0, rigid={"shear", "extension"})
# Simo–Reissner, P (1 − P/EA + P/GA) = π²/4: case F1-Pcr-EA1200.0-GA500.0 of the references, round section.
SOFT, SOFT_CRITICAL = dr.Section(EA=1200.0, GA=500.0, GJ=0.8, EI=1.0), 2.460338954539246
# Tip load of a cantilever in its stiff plane, EI2 = GJ = 1, by EI3: cases I2 of the references, pre-buckling deflection
# included; for 100 own shooting, from which I2 is off by 2.5e-7.
LATERAL = {20.0: 4.274845164961501, 100.0: 4.0596274055}
# Sections that one strain is held in: P (1 − P/EA) and P (1 + P/GA) = π²/4.
UNSHEARABLE = dr.Section(EA=1200.0, GJ=0.8, EI=1.0, rigid={"shear"})
INEXTENSIBLE = dr.Section(GA=500.0, GJ=0.8, EI=1.0, rigid={"extension"})
COLUMNS = {
    "rigid": (RIGID, EULER),
    "soft": (SOFT, SOFT_CRITICAL),
    "unshearable": (UNSHEARABLE, 600.0 * (1.0 - np.sqrt(1.0 - EULER / 300.0))),
    "inextensible": (INEXTENSIBLE, 250.0 * (np.sqrt(1.0 + EULER / 125.0) - 1.0)),
}


def straight(section: dr.Section, d2: tuple[float, float, float] | None = None) -> dr.Rod:
    return dr.Rod.straight(length=1.0, section=section, d2=d2)


def column(section: dr.Section, force: float, lateral: float = 0.0) -> dr.Scene:
    load = dr.PointForce((-force, lateral, 0.0), at="end")
    return dr.Scene([straight(section)], [dr.Clamp("start")], [load], motion=dr.Static(steps=1))


def strip(ratio: float, force: float) -> dr.Scene:
    section = dr.Section(GJ=1.0, EI=(1.0, ratio), rigid={"shear", "extension"})
    load = dr.PointForce((0.0, force, 0.0), at="end")
    return dr.Scene([straight(section, d2=(0, 1, 0))], [dr.Clamp("start")], [load])


@both_kinematics
@pytest.mark.parametrize(
    ("name", "degree"),
    [("rigid", 2), *((name, 3) for name in COLUMNS), pytest.param("soft", 2, marks=pytest.mark.slow)],
)
def test_a_column_loses_a_direction_at_each_eulerian_load(kinematics, name, degree):
    section, critical = COLUMNS[name]
    per_load = 1 if isinstance(kinematics, dr.Planar) else 2  # a round column may go any way
    for factor, lost in ((0.9999, 0), (1.0001, 1)):
        log = dr.solve(column(section, factor * critical), elements=8, degree=degree, kinematics=kinematics).log[-1]
        assert log.stable == (lost == 0)
        assert log.unstable_directions == lost * per_load
    if section is RIGID:
        third = dr.solve(column(section, 9.1 * EULER), elements=8, degree=degree, kinematics=kinematics)
        assert third.log[-1].unstable_directions == 2 * per_load


def test_a_planar_column_is_judged_in_space():
    """Weak about d2, that is out of the plane of its load: it buckles there although the plane holds it."""
    weak = dr.Section(GJ=0.8, EI=(0.5, 1.0), rigid={"shear", "extension"})
    for factor, lost in ((0.9999, 0), (1.0001, 1)):
        scene = column(weak, 0.5 * factor * EULER)
        judged, in_plane = (dr.solve(scene, elements=8, kinematics=k) for k in (None, dr.Planar((0.0, 0.0, 1.0))))
        assert judged.formulation.kinematics == in_plane.formulation.kinematics == "planar"
        assert judged.log[-1].unstable_directions == lost
        assert in_plane.log[-1].stable
        assert any("in the plane" in note for note in in_plane.formulation.notes)


@pytest.mark.parametrize("ratio", LATERAL)
def test_a_strip_bent_in_its_stiff_plane_is_flagged_at_the_lateral_buckling_load(ratio):
    """Its way past that load is tried in shorter steps before an unstable state is accepted."""
    for factor, lost in ((0.995, 0), (0.9999, 0), (1.0001, 1), (1.005, 1)):
        result = dr.solve(strip(ratio, factor * LATERAL[ratio]), elements=8)
        assert result.formulation.kinematics == "planar"
        assert (result.log[-1].stable, result.log[-1].unstable_directions) == (lost == 0, lost)


@both_kinematics
def test_with_a_whiff_of_lateral_load_the_path_ends_on_the_buckled_branch(kinematics):
    """The buckled column at 1.5 P_cr: tip slope and place between those of cases F2a-alpha80 and F2a-alpha120."""
    result = dr.solve(column(RIGID, 1.5 * EULER, 1e-3 * 1.5 * EULER), elements=16, kinematics=kinematics)
    assert all(step.stable for step in result.log)
    # Clamped and free, P/P_cr = 1.5184 at a tip slope of 100°: x = 0.3490, y = 0.7915 (F2a-alpha100).
    np.testing.assert_allclose(result.tip[:2], [0.3490, 0.7915], atol=0.02)


@both_kinematics
def test_a_perfect_column_goes_on_straight_and_is_flagged(kinematics):
    result = dr.solve(column(RIGID, 1.5 * EULER), elements=8, kinematics=kinematics)
    np.testing.assert_allclose(result.tip, [1.0, 0.0, 0.0], atol=1e-12)
    stable = [step.stable for step in result.log]
    last = stable.index(False)
    assert stable == [True] * last + [False] * (len(stable) - last)
    # The critical point is located to a 256th of the way.
    assert result.log[last - 1].t < 1.0 / 1.5 < result.log[last].t
    assert result.log[last].t - result.log[last - 1].t <= 1.01 / 256.0


@both_kinematics
@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_hanging_is_stable_and_standing_on_a_pin_is_not(kinematics, direction):
    rod = dr.Rod.straight(length=1.0, section=SOFT, direction=(0.0, direction, 0.0))
    result = dr.solve(dr.Scene([rod], [dr.Pin("start")], [dr.LineForce((0.0, -0.1, 0.0))]), kinematics=kinematics)
    assert result.tip[1] == pytest.approx(direction, abs=1e-3)
    assert result.log[-1].stable == (direction < 0)


def test_a_neutral_turn_does_not_count():
    """Between two pins in space: the turn about their line neither raises nor lowers the energy."""
    sliding = dr.Guide("end", free={"x", "rx", "ry", "rz"})
    for factor, lost in ((0.99, 0), (1.01, 2)):
        load = dr.PointForce((-factor * np.pi**2, 0.0, 0.0), at="end")
        log = dr.solve(dr.Scene([straight(RIGID)], [dr.Pin("start"), sliding], [load]), kinematics=dr.Spatial()).log[-1]
        assert log.unstable_directions == lost


def test_an_axial_moment_on_a_section_that_turns_about_its_axis_has_a_potential():
    """Clamped rod, its end free to slide and turn about the axis under a moment M: M L/EI = 8.986818915818128 (G12)."""
    sliding = dr.Guide("end", free={"x", "rx"})
    for factor, lost in ((0.99, 0), (1.01, 2)):
        load = dr.PointMoment((factor * 8.986818915818128, 0.0, 0.0), at="end")
        log = dr.solve(dr.Scene([straight(RIGID)], [dr.Clamp("start"), sliding], [load]), kinematics=dr.Spatial()).log
        assert log[-1].unstable_directions == lost


@pytest.mark.parametrize(("force", "stable"), [(19.0, True), (21.0, False)])
def test_a_follower_load_makes_a_column_flutter(force, stable):
    """Beck's column, uniform mass, no rotary inertia: P L²/EI = 20.05 (Beck 1952, ZAMP 3:225)."""
    section = dr.Section(GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(1e-9, 1e-9, 1e-9), rigid={"shear", "extension"})
    load = dr.FollowerForce((-force, 0.0, 0.0), at="end")
    scene = dr.Scene([straight(section)], [dr.Clamp("start")], [load])
    log = dr.solve(scene, kinematics=dr.Planar((0.0, 0.0, 1.0))).log
    assert log[-1].stable is stable
    assert log[-1].unstable_directions == 0


@pytest.mark.parametrize("factor", [0.999, 1.001])
@pytest.mark.parametrize(
    ("posed", "kinematics"),
    [
        (lambda factor: column(RIGID, factor * EULER), dr.Planar((0.0, 0.0, 1.0))),
        (lambda factor: column(RIGID, factor * EULER), dr.Spatial()),
        (lambda factor: column(SOFT, factor * SOFT_CRITICAL), dr.Spatial()),
        (lambda factor: strip(20.0, factor * LATERAL[20.0]), None),
    ],
    ids=["in its plane", "rigid", "soft", "planar judged in space"],
)
def test_the_same_verdict_on_any_number_of_ranks(posed, kinematics, factor):
    together, alone = (
        dr.solve(posed(factor), elements=6, kinematics=kinematics, comm=comm)
        for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)
    )
    assert together.log[-1].unstable_directions == alone.log[-1].unstable_directions
    assert together.log[-1].stable == alone.log[-1].stable == (factor < 1.0)


@pytest.mark.parametrize("elements", [8, 16])
@pytest.mark.parametrize("kinematics", [None, dr.Spatial()], ids=["planar judged in space", "spatial"])
def test_what_costs_nothing_is_no_instability(kinematics, elements):
    """A round rod that hangs bent from a pin turns about its own axis at no cost, on any mesh."""
    section = dr.Section(GJ=0.01, EI=0.01, rigid={"shear", "extension"})
    loads = [dr.LineForce((0.0, -1.0, 0.0)), dr.PointForce((0.3, 0.0, 0.0), at="end")]
    result = dr.solve(dr.Scene([straight(section)], [dr.Pin("start")], loads), elements=elements, kinematics=kinematics)
    assert [row.unstable_directions for row in result.log] == [0] * len(result.log)


@pytest.mark.slow
@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_ten_thousand_elements_are_judged_right(factor):
    log = dr.solve(column(RIGID, factor * EULER), elements=10_000, kinematics=dr.Planar((0.0, 0.0, 1.0))).log
    assert log[-1].stable == (factor < 1.0)


@pytest.mark.parametrize(("factor", "lost"), [(0.995, 0), (1.005, 1)])
def test_the_stiffest_strip_is_judged_by_its_soft_side(factor, lost):
    """Prandtl's strip: P L²/√(EI₂ GJ) = 4.0125985 (I1), EI₃ = 1e8 EI₂."""
    section = dr.Section(GJ=1.0, EI=(1.0, 1e8), rigid={"shear", "extension"})
    load = dr.PointForce((0.0, -4.0125985 * factor, 0.0), at="end")
    log = dr.solve(dr.Scene([straight(section)], [dr.Clamp("start")], [load])).log
    assert log[-1].unstable_directions == lost


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.3, -0.7, 0.45), (-0.2, 0.1, 0.9)])
@both_kinematics
def test_a_constraint_that_another_one_implies_is_no_direction(kinematics, axis):
    """The force along an inextensible rod held at both ends is anything: refused, or told as such, never counted."""
    section = dr.Section(GJ=1.0, EI=1.0, rigid={"shear", "extension"})
    rod, pushed = dr.Rod.straight(1.0, section, direction=axis), dr.PointForce((1, 2, 0), "end")
    scene = dr.Scene([rod], [dr.Clamp("start"), dr.Pin("end")], [pushed])
    try:
        log = dr.solve(scene, elements=4, kinematics=kinematics).log
    except dr.NotConverged as failed:
        log = failed.result.log
    assert [(row.stable, row.unstable_directions) for row in log] in ([], [(None, None)])
