"""Normal laws: line loads that only push, known gaps under known loads, work that is a difference of energies."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import dolfinrod as dr
from dolfinrod.scene import SceneError

Array = NDArray[np.float64]
some = settings(max_examples=60)
EPS = float(np.finfo(float).eps)

magnitudes = st.floats(-6.0, 10.0).map(lambda exponent: 10.0**exponent)
lengths = st.floats(-9.0, 1.0).map(lambda exponent: 10.0**exponent)
onsets = st.just(0.0) | lengths | lengths.map(lambda g: -g)
penalties = st.builds(dr.Penalty, magnitudes, onsets)
smooth = st.builds(dr.SmoothPenalty, magnitudes, lengths, onsets)
laws = penalties | smooth
# Depths below g_0 in units of the foot, or of anything: beyond contact, in the foot, where pieces meet, far below it.
depths = (
    st.sampled_from([-1.0, 0.0, 1.0]) | st.floats(-2.0, 3.0) | st.floats(-1e-6, 1e-6) | st.floats(1 - 1e-6, 1 + 1e-6)
)


def scale(law: dr.Penalty | dr.SmoothPenalty) -> float:
    """A length in which the law has its shape [m]."""
    return law.foot if isinstance(law, dr.SmoothPenalty) else abs(law.g_0) or 1.0


def at(law: dr.Penalty | dr.SmoothPenalty, *depths: float) -> Array:
    """Gaps so deep below g_0."""
    return law.g_0 - scale(law) * np.array(depths)


def blur(law: dr.Penalty | dr.SmoothPenalty, *gaps: Array) -> float:
    """Round-off of a line load at gaps."""
    return 8 * EPS * law.eps_N * (abs(law.g_0) + scale(law) + max(float(np.abs(g).max()) for g in gaps))


@some
@given(law=laws, depth=depths, other=depths)
def test_a_wall_only_pushes_from_g_0_on_and_harder_the_nearer(law, depth: float, other: float) -> None:
    near, far = at(law, max(depth, other)), at(law, min(depth, other))
    (p, slope), (q, _) = law.pressure(near, np.zeros(1)), law.pressure(far, np.zeros(1))
    assert p >= q >= 0.0
    assert -law.eps_N <= slope <= 0.0
    assert (p > 0.0) <= (near < law.g_0)
    assert (law.energy(near, np.zeros(1)) >= law.energy(far, np.zeros(1))).all()
    beyond = np.array([law.g_0, law.g_0 + scale(law)])
    for value in (*law.pressure(beyond, np.zeros(2)), law.energy(beyond, np.zeros(2))):
        assert not value.any()


@some
@given(law=penalties, q=magnitudes)
def test_a_line_load_is_met_at_g_0_less_q_over_the_stiffness(law: dr.Penalty, q: float) -> None:
    gap = np.array([law.g_0 - q / law.eps_N])
    assert law.pressure(gap, np.zeros(1))[0] == pytest.approx(q, rel=1e-12, abs=blur(law, gap))


@some
@given(law=smooth, more=st.floats(0.0, 10.0))
def test_beyond_its_foot_a_smooth_law_lies_half_a_foot_deeper(law: dr.SmoothPenalty, more: float) -> None:
    q = law.eps_N * law.foot * (0.5 + more)
    gap = np.array([law.g_0 - 0.5 * law.foot - q / law.eps_N])
    assert law.pressure(gap, np.zeros(1))[0] == pytest.approx(q, rel=1e-12, abs=blur(law, gap))


@some
@given(law=smooth, depth=depths, other=depths)
def test_the_slope_of_a_smooth_law_is_its_own_and_never_jumps(
    law: dr.SmoothPenalty, depth: float, other: float
) -> None:
    g, h = at(law, depth), at(law, other)
    (p, slope), (q, end) = law.pressure(g, np.zeros(1)), law.pressure(h, np.zeros(1))
    way, bend = abs(h - g), law.eps_N / law.foot
    assert abs(end - slope) <= bend * way + 8 * EPS * law.eps_N * (1 + abs(law.g_0) / law.foot)
    # Trapezoids of a slope that bends by no more than ε_N/w.
    assert abs(q - p - 0.5 * (slope + end) * (h - g)) <= 0.25 * bend * way**2 + 8 * EPS * (blur(law, g, h) / EPS)


@some
@given(law=laws, depth=depths, other=depths)
def test_work_is_the_difference_of_energies(law, depth: float, other: float) -> None:
    g, h = at(law, depth), at(law, other)
    mean, _ = law.mean(g, h, np.zeros(1))
    before, after = law.energy(g, np.zeros(1)), law.energy(h, np.zeros(1))
    assert mean * (h - g) == pytest.approx(before - after, abs=8 * blur(law, g, h) * scale(law))
    ends = [float(law.pressure(gap, np.zeros(1))[0][0]) for gap in (g, h)]
    assert min(ends) - blur(law, g, h) <= mean <= max(ends) + blur(law, g, h)


@some
@given(law=laws, depth=depths)
def test_where_nothing_moves_the_mean_is_the_pressure(law, depth: float) -> None:
    g = at(law, depth)
    p, slope = law.pressure(g, np.zeros(1))
    mean, half = law.mean(g, g, np.zeros(1))
    assert mean == pytest.approx(p, rel=1e-14)
    assert half == pytest.approx(0.5 * slope, rel=1e-14)


@some
@given(
    law=st.builds(dr.Penalty, magnitudes) | st.builds(dr.SmoothPenalty, magnitudes, lengths),
    depth=depths,
    way=st.floats(0.01, 3.0) | st.floats(-3.0, -0.01),
)
def test_slopes_of_means_are_those_of_differences(law, depth: float, way: float) -> None:
    g, step = at(law, depth), 1e-6
    low, high = (law.mean(g, at(law, depth + way + shift), np.zeros(1))[0] for shift in (step, -step))
    slope = law.mean(g, at(law, depth + way), np.zeros(1))[1]
    # Means bend by no more than ε_N over the way, a hundredth of the scale at least.
    assert (high - low) / (2 * step * scale(law)) == pytest.approx(slope, abs=2 * step / 0.01 * law.eps_N)


@some
@given(law=smooth, depth=depths)
def test_a_short_foot_makes_a_smooth_law_a_penalty(law: dr.SmoothPenalty, depth: float) -> None:
    gap, sharp = at(law, depth), dr.Penalty(law.eps_N, law.g_0)
    less = sharp.pressure(gap, np.zeros(1))[0] - law.pressure(gap, np.zeros(1))[0]
    assert -blur(law, gap) <= less <= 0.5 * law.eps_N * law.foot + blur(law, gap)


def test_presets_are_the_numbers_of_the_paper_and_of_fibres_that_touch() -> None:
    # design/process.md, 1.2: 1.5 N/m where surfaces meet; under 0.01 N/m a fibre floats 74.5 µm off the wall.
    paper, tight, none = dr.Penalty.paper(), dr.Penalty.tight(), np.zeros(1)
    assert (paper, tight) == (dr.Penalty(eps_N=2e4, g_0=75e-6), dr.Penalty(eps_N=4e5, g_0=1e-6))
    assert paper.pressure(none, none)[0] == pytest.approx(1.5)
    assert paper.pressure(np.array([74.5e-6]), none)[0] == pytest.approx(0.01)


@some
@given(eps_N=magnitudes, tolerance=lengths, gap=st.floats(-1.0, 1.0), push=st.just(0.0) | magnitudes)
def test_multipliers_push_where_penetration_does_not(eps_N: float, tolerance: float, gap: float, push: float) -> None:
    law, g, λ = dr.AugmentedLagrangian(eps_N, tolerance), np.array([gap]), np.array([push])
    p, slope = law.pressure(g, λ)
    assert p == max(push - eps_N * gap, 0.0)
    assert slope == (-eps_N if p > 0.0 else 0.0)
    assert law.mean(np.zeros(1), g, λ) == (p, slope)
    assert not law.energy(g, λ).any()
    np.testing.assert_array_equal(law.pressure(g, 0 * λ), dr.Penalty(eps_N).pressure(g, 0 * λ))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: dr.Penalty(0.0), r"^Penalty\.eps_N must be positive, got 0\.0 N/m²$"),
        (lambda: dr.Penalty(1.0, np.nan), r"^Penalty\.g_0 must be a finite number \[m\], got nan m$"),
        (lambda: dr.SmoothPenalty(-1.0, 1.0), r"^SmoothPenalty\.eps_N must be positive, got -1\.0 N/m²$"),
        (lambda: dr.SmoothPenalty(1.0, 0.0), r"^SmoothPenalty\.foot must be positive, got 0\.0 m$"),
        (lambda: dr.SmoothPenalty(1.0, 1.0, "1 um"), r"^SmoothPenalty\.g_0 must be a finite number \[m\], got '1 um'"),
        (
            lambda: dr.AugmentedLagrangian("stiff", 1e-6),
            r"^AugmentedLagrangian\.eps_N must be a finite number \[N/m²\]",
        ),
        (lambda: dr.AugmentedLagrangian(1.0, 0.0), r"^AugmentedLagrangian\.tolerance must be positive, got 0\.0 m$"),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()
