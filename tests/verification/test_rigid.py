"""Rigid tops, K7 and K8: orders of each integrator, references met by extrapolation, what is kept and what is lost."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from verification.ledger import decode, encode
from verification.report.misses import sentence
from verification.report.rigid import tops
from verification.rigid import SLACK, pairs, richardson, topstudy
from verification.rigidbodies import INTEGRATORS, TOPS, State
from verification.rigidbodies.top import rotation
from verification.toptrials import TOPS as TOPS_BY_NAME
from verification.toptrials import units

pytestmark = pytest.mark.serial

MIDPOINT, EULER, DISCRETE, ADDED = INTEGRATORS
UNEQUAL, ROUND, HEAVY = TOPS
FREE = pytest.mark.parametrize("top", [UNEQUAL, ROUND], ids=lambda top: top.name)
EVERY = pytest.mark.parametrize("integrator", INTEGRATORS, ids=lambda integrator: integrator.name)


@FREE
def test_references_keep_energy_and_momentum(top):
    """The tabulated states by themselves, to the digits they are good for."""
    for known in top.reference.states.values():
        q, w = (np.array([known[f"{name}{i}"] for i in of]) for name, of in (("q", range(4)), ("w", (1, 2, 3))))
        state = State(rotation(q), w)
        assert top.energy(state) == pytest.approx(top.energy(top.start), rel=1e-10)
        assert top.momentum(state) == pytest.approx(top.momentum(top.start), abs=1e-9)


def test_the_reference_of_the_heavy_top_keeps_its_energy():
    """½ w·J w + m g z, J about the fixed point by Steiner: Géradin & Cardona's m l² = 15 about the two cross axes."""
    assert pytest.approx([15.234375, 0.46875, 15.234375]) == HEAVY.J
    for known in HEAVY.reference.states.values():
        w = np.array([known[f"w{i}"] for i in (1, 2, 3)])
        energy = 0.5 * HEAVY.J @ w**2 + 15.0 * 9.81 * known["z"]
        assert energy == pytest.approx(HEAVY.energy(HEAVY.start), rel=1e-9)


@EVERY
@FREE
def test_free_tops(top, integrator):
    """K7 at 1 s: orders, momentum and energy as theory says; added rotation vectors lead to another attitude."""
    study = topstudy(top, integrator, levels=2, until=1.0)
    assert study.holds
    assert study.spin_order.observed == pytest.approx(max(study.theory, 1), abs=SLACK)
    assert study.attitude_order.observed == pytest.approx(study.theory, abs=SLACK)


@pytest.mark.parametrize(("integrator", "digits"), [(MIDPOINT, 1e-10), (EULER, 1e-8), (DISCRETE, 1e-8)])
def test_a_tumbling_body_is_met_by_extrapolation(integrator, digits):
    """K7, all ten digits of the reference by the midpoint rule, eight by either backward Euler, from four steps."""
    assert max(topstudy(UNEQUAL, integrator, until=1.0).extrapolated) < digits


def test_heavy_top():
    """K8 at 0.1 s, the first of its times: 0.3 and 0.15 rad a step."""
    study = topstudy(replace(HEAVY, second=(500, 1000)), MIDPOINT, until=0.1)
    assert study.holds
    assert study.precession[-1][-1] < 0.3 * study.precession[0][-1]
    assert max(study.axial) < 1e-12


@pytest.mark.slow
@EVERY
@pytest.mark.parametrize("top", TOPS, ids=lambda top: top.name)
def test_tops_until_the_end(top, integrator):
    """At all times of the references."""
    study = topstudy(top, integrator, levels=3 if top is HEAVY else 4)
    assert study.holds
    assert study.title in tops((study,))


@pytest.mark.slow
def test_the_heavy_top_is_met_by_extrapolation():
    """K8 at 0.1 s, nine digits trusted."""
    study = topstudy(replace(HEAVY, second=(1000, 2000, 4000, 8000)), MIDPOINT, until=0.1)
    assert max(study.extrapolated) < 1e-8


def test_what_is_missed_shows():
    """Momentum lost, energy gained, an order too low."""
    study = topstudy(UNEQUAL, MIDPOINT, levels=2, until=1.0)
    assert not replace(study, momentum=(1e-9, 1e-9)).holds
    assert not replace(study, theory=3).holds
    assert not replace(study, loses=True, gain=1e-6).holds
    assert "missed" in tops((replace(study, theory=3),))


def test_extrapolation_takes_out_the_powers_of_the_step():
    """1 + 3h + h² at h = 4, 2, 1 by all powers, 1 + 3h² + h⁴ by the even ones."""
    for power in (1, 2):
        found = [np.array([1.0 + 3.0 * h**power + h ** (2 * power)]) for h in (4.0, 2.0, 1.0)]
        assert richardson(found, power) == pytest.approx(np.array([1.0]), abs=1e-12)


def test_every_top_meets_every_integrator():
    assert len(pairs()) == len(TOPS) * len(INTEGRATORS)


def test_tops_are_asked_for_by_name():
    work = tuple(units((TOPS_BY_NAME,), quick=True))
    assert len(work) == len(pairs())
    assert not tuple(units(("laws",), quick=False))
    study = work[0].work()
    assert decode(encode(study)) == study
    assert "orders 1.99, 1.99, 1.99 of 3" in sentence(replace(study, theory=3))
