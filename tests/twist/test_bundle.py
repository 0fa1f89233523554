"""Twist of solved rods, in a line."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from dolfinrod.twist import TooCoarse, refined
from dolfinrod.twist.bundle import FINER

pytestmark = pytest.mark.serial

SECTION = dr.Section(GJ=1.0, EI=1.0, rigid={"shear", "extension"})
RADIUS, LENGTH = 0.05, 1.0
AXIS = (0.0, 0.0)


def strands(turns, n=3):
    """Helices about the X axis, stress free."""
    x = np.linspace(0.0, LENGTH, 60)
    angle = 2.0 * np.pi * turns * x / LENGTH
    return [
        dr.Rod.through(np.stack([x, RADIUS * np.cos(angle + φ), RADIUS * np.sin(angle + φ)], axis=1), SECTION)
        for φ in 2.0 * np.pi * np.arange(n) / n
    ]


@pytest.fixture(scope="module", params=[1.5, -1.5])
def laid(request):
    scene = dr.Scene(strands(request.param), [dr.Clamp("start")])
    return request.param, discrete.solve(scene, elements=40)


def test_twist_of_a_bundle_in_one_line(laid):
    turns, result = laid
    assert dr.twist.of(result).T_pair == pytest.approx(turns / LENGTH, rel=1e-4)
    assert dr.twist.of(result).T_axis == pytest.approx(turns / LENGTH, rel=1e-4)


def test_measures_of_each_rod(laid):
    turns, result = laid
    bundle = dr.twist.of(result)
    np.testing.assert_allclose(bundle.material, 0.0, atol=1e-9)
    np.testing.assert_allclose(bundle.writhe, bundle.writhe[0], rtol=1e-6)
    assert np.sign(bundle.writhe[0]) == np.sign(turns)


def test_a_single_rod_about_a_core(laid):
    turns, result = laid
    bundle = dr.twist.of(result, rods=[1], axis=AXIS)
    assert bundle.T_axis == pytest.approx(turns / LENGTH, rel=1e-4)
    assert np.isnan(bundle.T_pair)
    assert np.isnan(dr.twist.of(result, rods=[1]).T_axis)


def test_a_rod_that_turns_back_has_windings_but_no_axis(laid):
    _, result = laid
    h = result.rods[1]
    r = h.r.copy()
    r[-1, 20, 0] = r[-1, 18, 0]
    bundle = dr.twist.of(replace(result, rods=(result.rods[0], replace(h, r=r), result.rods[2])))
    assert bundle.pairs.gauss.sum() == 4
    assert np.isnan(bundle.T_axis)
    assert bundle.T_pair == pytest.approx(dr.twist.of(result).T_pair, rel=1e-3)


@pytest.mark.parametrize("solve", [discrete.solve, dr.solve], ids=["discrete", "continuum"])
def test_a_twisted_rod(solve):
    """An end turned about its axis by a turn and a half; κ₁ of ten elements is off by 1e-8, as their solution is."""
    rod = dr.Rod.straight(LENGTH, dr.Section(EA=1e4, GA=4e3, GJ=1.0, EI=10.0))
    turned = dr.Prescribed("end", displacement=(0, 0, 0), rotation=(3.0 * np.pi, 0, 0))
    result = solve(dr.Scene([rod], [dr.Clamp("start"), turned]), elements=10)
    bundle = dr.twist.of(result)
    assert bundle.material == pytest.approx([1.5], abs=1e-7)
    assert bundle.pairs is None
    assert dr.twist.frame_twist(result.rods[0].frames[-1]) == pytest.approx(1.5, abs=1e-9)
    (line,) = dr.twist.centrelines(result)
    assert line.shape == (4 * (len(result.rods[0].s) - 1) + 1, 3)
    np.testing.assert_allclose(line[:, 1:], 0.0, atol=1e-9)
    assert dr.twist.of(result, 0).material == pytest.approx([0.0], abs=1e-12)


@pytest.mark.parametrize("given", ["points", "slopes"])
def test_smooth_curves_come_nearer_with_the_order_of_cubics(given):
    """Distance of points of a helix' cubic from it: fourth power of the nodes' distance, third where slopes are not."""
    errors = []
    for n in (21, 41, 81):
        t = np.linspace(0.0, 1.0, n)
        φ = 2.0 * np.pi * t
        r = np.stack([t, np.cos(φ), np.sin(φ)], axis=1)
        slope = np.stack([1.0 + 0.0 * t, -2 * np.pi * np.sin(φ), 2 * np.pi * np.cos(φ)], axis=1)
        curve = dr.twist.smooth(r, t, slope if given == "slopes" else None)
        off = np.abs(np.hypot(curve[:, 1], curve[:, 2]) - 1.0)
        np.testing.assert_allclose(curve[::4], r, atol=1e-15)
        errors.append(off[8:-8].max())
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert order[-1] == pytest.approx(4.0, abs=0.3)


@pytest.mark.parametrize(
    ("options", "words"),
    [({"s": [0.0, 1.0, 1.0]}, "must ascend"), ({"slope": np.ones((2, 3))}, "a slope at each of 3 points")],
)
def test_what_is_no_curve_is_refused(options, words):
    with pytest.raises(ValueError, match=words):
        dr.twist.smooth(np.arange(9.0).reshape(3, 3), **options)


@pytest.mark.parametrize("needed", FINER)
def test_curves_are_as_fine_as_it_takes(needed):
    """The coarsest that can tell; where none can, the finest says so."""
    tried = []

    def measured(pieces):
        tried.append(pieces)
        if pieces < needed:
            raise TooCoarse("too far apart")
        return pieces

    assert refined(measured) == needed
    assert tried == [pieces for pieces in FINER if pieces <= needed]


def test_no_curve_fine_enough_is_said():
    def never(pieces):
        raise TooCoarse(f"{pieces} pieces")

    with pytest.raises(TooCoarse, match=f"{FINER[-1]} pieces"):
        refined(never)
