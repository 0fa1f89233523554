"""The clock: warm-up not counted, compile time apart, failures kept as records."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from dolfinrod.result import Formulation, NotConverged, Result, RodHistory, Statistics
from verification.cases import elastica
from verification.workprecision import measure, study

pytestmark = pytest.mark.serial

CASE = elastica.inextensible(10.0)


@dataclass
class Halving:
    """A model whose tip errs by 1/n², which counts its calls and says it compiled in the first."""

    name: str = "halving"
    family: str = "continuum"
    degree: int = 1
    tip_order: int = 2
    centreline_order: int = 2
    fails_below: int = 0
    calls: list[int] = field(default_factory=list)

    def applies_to(self, case):
        return True

    def solve(self, scene, elements):
        self.calls.append(elements)
        s = np.linspace(0.0, 1.0, elements + 1)
        r = CASE.centreline(s) + np.outer(s, (0.0, 0.0, 1.0 / elements**2))
        zero = np.zeros((1, elements + 1, 3))
        rod = RodHistory(s, r[None], np.zeros((1, elements + 1, 3, 3)), zero, zero, zero, zero)
        compiling = 1.5 if len(self.calls) == 1 else 0.0
        statistics = Statistics(10 * elements, 1, 4, 4, compiling, seconds_setup=0.002, seconds_solve=0.001)
        formulation = Formulation("continuum", "spatial", {}, ())
        result = Result(scene, np.array([0.0, 1.0]), (rod,), True, (), {}, statistics, formulation)
        if elements < self.fails_below:
            raise NotConverged(result=result, t=0.0, step=1.0, reason="too coarse", advice="refine")
        return result


def test_first_call_warms_up_and_is_not_timed():
    model = Halving()
    timing = measure(CASE, model, 4, repeats=3).timing
    assert model.calls == 4 * [4]
    assert timing.repeats == 3
    assert timing.compile == 1500.0
    assert (timing.solve, timing.solve_min, timing.setup) == pytest.approx((1.0, 1.0, 2.0))
    assert 0.0 < timing.call_min <= timing.call


def test_nothing_is_timed_unless_asked():
    model = Halving()
    assert measure(CASE, model, 4).timing is None
    assert model.calls == [4]


def test_failure_is_a_record():
    record = measure(CASE, Halving(fails_below=8), 4, repeats=3)
    assert record.failure == "too coarse"
    assert np.isnan(record.error)
    assert record.iterations == 4


def test_study_reads_orders_and_passes_over_failures():
    found = study(CASE, Halving(fails_below=4), (2, 4, 8, 16))
    assert found.tip.observed == pytest.approx(2.0)
    assert found.tip.meshes == (8, 16)
    assert found.centreline.observed == pytest.approx(2.0, abs=0.05)


def test_only_the_asked_meshes_are_timed():
    found = study(CASE, Halving(), (4, 8, 16), repeats=2, timed=(8,))
    assert [record.timing is not None for record in found.records] == [False, True, False]
