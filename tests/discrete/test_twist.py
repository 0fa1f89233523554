"""Rods that buckle because they are twisted: between pins, between clamps, as a ring; order 2, multiplicities."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.discrete.test_buckling import ENDS
from tests.scenes import FLAT, KIRCHHOFF, orders

# Up, then hold: compress first, twist later.
FIRST, LATER = ((0.0, 0.0), (1.0, 1.0)), ((1.0, 0.0), (2.0, 1.0))


def greenhill(compression: float, moment: float) -> dr.Scene:
    """Pinned rod, compressed, then twisted by opposite dead couples."""
    loads = [
        dr.PointForce((-compression, 0, 0), "end", history=FIRST),
        dr.PointMoment((moment, 0, 0), "end", history=LATER),
        dr.PointMoment((-moment, 0, 0), "start", history=LATER),
    ]
    return dr.Scene([FLAT.straight(KIRCHHOFF)], ENDS["pinned"], loads, motion=dr.Static(t_end=2.0))


@pytest.mark.parametrize(
    ("compression", "moment"),
    [
        (5.0, 4.413436031524354),
        pytest.param(0.0, 6.283185307179586, marks=pytest.mark.slow),
        pytest.param(-20.0, 10.930618354162652, marks=pytest.mark.slow),
    ],
)
def test_greenhills_rod_under_thrust_and_couple(compression, moment):
    """Cases G12: (M/2EI)² + P/EI = (π/L)²; compressed first, then twisted to the critical couple."""
    n = [20, 40]
    errors = [
        20.0 * (discrete.critical(greenhill(compression, 20.0), modes=1, elements=k).factors[0] - 1.0) - moment
        for k in n
    ]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.05)
    assert abs(errors[-1]) < 2e-3 * moment


def test_twist_buckling_of_a_clamped_rod():
    """Case G12-P0: M L/EI = 8.986818915818128, tan(β/2) = β/2; double for a round section."""
    n = [20, 40]
    supports = [dr.Clamp("start"), dr.Guide("end", free={"x", "rx"})]
    scene = dr.Scene([FLAT.straight(KIRCHHOFF)], supports, [dr.PointMoment((12.0, 0, 0), "end")])
    found = [discrete.critical(scene, modes=2, elements=k) for k in n]
    errors = [12.0 * b.factors[0] - 8.986818915818128 for b in found]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.05)
    assert found[-1].multiplicity.tolist() == [2, 2]


@pytest.mark.slow
@pytest.mark.parametrize(("compression", "moment"), [(5.0, 8.232810781020973), (-20.0, 11.800329535425245)])
def test_twist_buckling_of_a_clamped_rod_compressed_or_pulled_before(compression, moment):
    """Cases G12-P5 and G12-P-20."""
    n = [20, 40]
    supports = [dr.Clamp("start"), dr.Guide("end", free={"x", "rx"})]
    loads = [
        dr.PointForce((-compression, 0, 0), "end", history=FIRST),
        dr.PointMoment((15.0, 0, 0), "end", history=LATER),
    ]
    scene = dr.Scene([FLAT.straight(KIRCHHOFF)], supports, loads, motion=dr.Static(t_end=2.0))
    found = [discrete.critical(scene, modes=2, elements=k) for k in n]
    errors = [15.0 * (b.factors[0] - 1.0) - moment for b in found]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.05)
    assert found[-1].multiplicity.tolist() == [2, 2]


def ring(GJ: float, twist: float) -> dr.Scene:
    """A straight rod bent to a circle of radius 1 until t = 1, then twisted at its start; its middle stays in plane.

    Where its end goes: x = sin α/α, y = (1 − cos α)/α in lengths, α = 2πt.
    """
    around = 2 * np.pi
    section = dr.Section(EA=1e6, GJ=GJ, EI=1.0, rigid={"shear"})

    def along(t: float) -> float:
        return float(np.sinc(2.0 * min(t, 1.0)) - 1.0)

    def across(t: float) -> float:
        return float(np.pi * min(t, 1.0) * np.sinc(min(t, 1.0)) ** 2)

    supports = [
        dr.Prescribed("start", displacement=(0, 0, 0), rotation=(twist, 0, 0), history=LATER),
        dr.Prescribed("end", rotation=(0, 0, around), history=FIRST),
        dr.Prescribed("end", displacement=(around, None, None), history=along),
        dr.Prescribed("end", displacement=(None, around, None), history=across),
        dr.Prescribed("end", displacement=(None, None, 0)),
        dr.Prescribed(0.5 * around, displacement=(None, None, 0)),
    ]
    return dr.Scene([dr.Rod.straight(around, section)], supports, motion=dr.Static(t_end=2.0))


@pytest.mark.slow
@pytest.mark.parametrize(("GJ", "twist"), [(1.0, 10.882796185405308), (0.75, 14.510394913873743)])
def test_michells_ring(GJ, twist):
    """Cases G3: 2π√3 EI/GJ, double. A rod that is being bent has the next critical point for ever close ahead."""
    n = [30, 60]
    most = 1.2 * twist
    found = [discrete.critical(ring(GJ, most), modes=2, elements=k) for k in n]
    errors = [most * (b.factors[0] - 1.0) - twist for b in found]
    assert orders(n, errors) == pytest.approx(2.0, abs=0.05)
    assert abs(errors[-1]) < 1e-3 * twist
    assert found[-1].multiplicity.tolist() == [2, 2]


@pytest.mark.slow
def test_strides_grow_where_predictions_recede():
    """The ring once more, coarse, on the way to a circle: each prediction lies 1e-2 ahead of the rod."""
    scene = ring(1.0, 0.0)
    found = discrete.critical(replace(scene, motion=dr.Static(t_end=1.0)), modes=1, elements=10)
    assert len(found.factors) == 0
    assert found.at.statistics.load_steps < 15
