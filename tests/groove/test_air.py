"""The line sink: where it points, how it decays, what it must conserve."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dolfinrod.groove import LineSink
from dolfinrod.scene import SceneError

# The ramp is over.
LATER = 1.0
few = settings(max_examples=25)
places = st.tuples(st.floats(-0.02, 0.06), st.floats(-3e-3, 3e-3), st.floats(-3e-3, 3e-3))
sinks = st.builds(LineSink, speed=st.floats(1.0, 40.0), radius=st.floats(1e-4, 1e-3), bottom=st.just((-4e-4, 1e-4)))


def at(sink: LineSink, *places, t: float = LATER):
    return sink(np.array(places, dtype=float), t)


@few
@given(sinks, places)
def test_air_flows_towards_the_line_no_faster_than_at_the_edge_of_its_core(sink, place):
    (u,) = at(sink, place)
    away = np.array(place[1:]) - np.array(sink.bottom)
    ρ = np.hypot(*away)
    s = min(sink.radius / ρ, ρ / sink.radius) if ρ else 0.0
    assert np.linalg.norm(u) == pytest.approx(sink.speed * s, abs=1e-12)
    assert u[0] == 0.0
    assert u[1:] @ away <= 0.0
    assert abs(u[1] * away[1] - u[2] * away[0]) <= 1e-15 * sink.speed


@few
@given(sinks, st.floats(1.1, 5.0), st.floats(-np.pi, np.pi))
def test_no_air_is_lost_outside_the_core(sink, factor, angle):
    centre = np.array([0.0, *sink.bottom]) + factor * sink.radius * np.array([0.0, np.cos(angle), np.sin(angle)])
    h = 1e-4 * sink.radius
    step = h * np.eye(3)
    divergence = sum((at(sink, centre + step[i])[0, i] - at(sink, centre - step[i])[0, i]) / (2 * h) for i in (1, 2))
    # Central differences of a field that bends over a radius: h² of the shear rate.
    assert abs(divergence) <= 10.0 * (h / sink.radius) ** 2 * sink.speed / sink.radius


def test_flow_grows_in_proportion_over_the_ramp():
    sink, place = LineSink(ramp=4e-4), (0.0, 1e-3, 0.0)
    full = at(sink, place)
    for t, share in ((0.0, 0.0), (1e-4, 0.25), (4e-4, 1.0), (1.0, 1.0)):
        assert at(sink, place, t=t) == pytest.approx(share * full, rel=1e-14)
    assert at(LineSink(ramp=0.0), place, t=0.0) == pytest.approx(full, rel=1e-14)


def test_holes_swell_the_flow_and_keep_its_mean():
    plain, sink = LineSink(), LineSink(holes=0.5, pitch=3e-3)
    X = np.arange(30) * 1e-4
    u, v = (at(s, *[(x, 0.0, 1e-3) for x in X])[:, 2] for s in (sink, plain))
    assert u / v == pytest.approx(1.0 + 0.5 * np.cos(2 * np.pi * X / 3e-3), rel=1e-12)
    assert u.mean() == pytest.approx(v.mean(), rel=1e-12)


def test_backward_flow_and_the_stretch_that_is_sucked():
    sink = LineSink(backward=2.0, between=(0.0, 0.04))
    u = at(sink, (-1e-3, 0.0, 1e-3), (0.0, 0.0, 1e-3), (0.04, 0.0, 1e-3), (0.041, 0.0, 1e-3))
    assert u[:, 0].tolist() == [0.0, -2.0, -2.0, 0.0]
    assert not u[[0, 3]].any()


def test_a_pressure_is_no_speed():
    with pytest.raises(SceneError, match=r"LineSink.speed must lie between 0 and 200 m/s, got -2600.0 m/s"):
        LineSink(speed=-2600.0)
