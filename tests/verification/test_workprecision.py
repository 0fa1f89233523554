"""The clock: warm-up not counted, compile time apart, failures kept as records."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from dolfinrod.result import Formulation, NotConverged, Result, RodHistory, Statistics
from verification.case import SKEW, UPRIGHT
from verification.cases import elastica
from verification.models import Continuum
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
    seconds: float = 0.001
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
        statistics = Statistics(10 * elements, 1, 4, 4, compiling, seconds_setup=0.002, seconds_solve=self.seconds)
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


def test_the_first_mesh_warms_up_for_the_finer_ones():
    model = Halving()
    found = study(CASE, model, (4, 8, 16), repeats=2)
    assert model.calls == [4, 4, 4, 8, 8, 16, 16]
    assert [record.timing.repeats for record in found.records] == [2, 2, 2]


def test_a_long_solve_warms_up_itself():
    model = Halving(seconds=1.0)
    model.calls = [4]
    timing = measure(CASE, model, 4, repeats=1).timing
    assert model.calls == [4, 4]
    assert timing.repeats == 1


def test_what_was_found_is_kept_in_the_axes_of_the_problem():
    upright, skew = (measure(CASE, Continuum(3), 4, pose=pose).found for pose in (UPRIGHT, SKEW))
    assert skew == pytest.approx(upright, abs=1e-13)
    assert measure(CASE, Halving(fails_below=8), 4).found is None


def test_orders_are_read_above_what_the_reference_knows():
    rough = replace(CASE, reference=replace(CASE.reference, digits_trusted=1))
    assert study(rough, Halving(), (4, 8, 16, 64, 128)).floor == pytest.approx(
        1e-3 * np.hypot(*CASE.reference.value[:2])
    )
    assert study(rough, Halving(), (4, 8, 16, 64, 128)).tip.meshes == (8, 16)
    assert study(CASE, Halving(), (4, 8, 16, 64, 128)).tip.meshes == (64, 128)
