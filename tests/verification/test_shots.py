"""Rods shot at rods over up to twenty radii a step: refused or stopped, but never on the other side."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import cKDTree

import discrete
import dolfinrod as dr
from dolfinrod.scene.meeting import Strands
from dolfinrod.scene.meeting.curves import Spans

pytestmark = [pytest.mark.serial, pytest.mark.slow]

Array = NDArray[np.float64]

RADIUS, STEP = 0.01, 2e-3
SECTION = dr.Section(EA=4e3, GA=1.5e3, GJ=0.8, EI=1.0, radius=RADIUS, rhoA=1.0, rhoI=(5e-5, 2.5e-5, 2.5e-5))
ELEMENTS = {"discrete": 8, "continuum": 3}
# Places on a span, and times of a step, at which centrelines are compared.
PLACES, TIMES = np.linspace(0.0, 1.0, 30), np.linspace(0.0, 1.0, 9)
MODELS = [("discrete", dr.ImplicitEuler()), ("continuum", dr.ImplicitEuler()), ("continuum", dr.Midpoint())]


def lines(result: dr.Result, model: str) -> list[list[Array]]:
    """Places on the centrelines of both rods, on the curves of the model, at all stored times."""
    s = [h.s for h in result.rods]
    if model == "discrete":
        strands = Strands.smooth(s, [RADIUS, RADIUS])
    else:
        n = ELEMENTS[model]
        cells = np.concatenate([3 * np.arange(n)[:, None] + np.arange(4) + rod * (3 * n + 1) for rod in range(2)])
        ends = np.concatenate([np.stack([own[:-1:3], own[3::3]], axis=1) for own in s])
        nodes = (s[0][:4] - s[0][0]) / (s[0][3] - s[0][0])
        strands = Strands.lagrange(np.repeat([0, 1], n), ends, cells, nodes, np.full(2, RADIUS))
    spans, found = Spans(strands), []
    for i in range(len(result.t)):
        course = spans.course(np.concatenate([h.r[i] for h in result.rods]))
        each = [np.repeat(np.flatnonzero(spans.rod == rod), len(PLACES)) for rod in range(2)]
        found.append([course.place(of, np.tile(PLACES, len(of) // len(PLACES))) for of in each])
    return found


@pytest.mark.parametrize(("model", "scheme"), MODELS)
@settings(max_examples=5, deadline=None)
@given(
    radii=st.floats(1.0, 20.0),
    power=st.floats(5.0, 9.0),
    angle=st.floats(0.2, np.pi / 2),
    offsets=st.tuples(*2 * (st.floats(0.15, 0.85),)),
    above=st.floats(2.03, 10.0),
)
def test_centrelines_never_meet(model, scheme, radii, power, angle, offsets, above):
    """All rods keep more than half of their distance in every step taken, and between its ends, going straight."""
    along = np.array([np.cos(angle), np.sin(angle), 0.0])
    target = dr.Rod.straight(
        1.0, SECTION, start=tuple(above * RADIUS * np.eye(3)[2] - offsets[1] * along), direction=tuple(along)
    )
    rods = [dr.Rod.straight(1.0, SECTION, start=(-offsets[0], 0.0, 0.0)), target]
    scene = dr.Scene(
        rods,
        contacts=[dr.RodContact(dr.Penalty(10.0**power, 1e-4))],
        velocities=[dr.Velocity((0.0, 0.0, radii * RADIUS / STEP), rod=0)],
        motion=dr.Dynamic(3.0 * STEP, dt=STEP, scheme=scheme),
    )
    try:
        result = (discrete.solve if model == "discrete" else dr.solve)(scene, elements=ELEMENTS[model])
    except dr.NotConverged as refused:
        # Where they are too soft to be kept apart.
        result = refused.result
    for (a_0, b_0), (a, b) in pairwise(lines(result, model)):
        for τ in TIMES:
            near = cKDTree((1.0 - τ) * b_0 + τ * b).query((1.0 - τ) * a_0 + τ * a)[0].min()
            assert near > 0.99 * RADIUS
