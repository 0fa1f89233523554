"""Laws of rods that touch one another in motion: momentum, energy, ranks, restarts, shots."""

from __future__ import annotations

from dataclasses import replace

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from dolfinrod.checkpoint import checkpoint as clock
from dolfinrod.continuum.pace import Pace
from tests.scenes import interpolated, largest
from verification.references.friction import restitution

RADIUS = 0.01
SECTION = dr.Section(EA=4e3, GA=1.5e3, GJ=0.8, EI=1.0, radius=RADIUS, rhoA=1.0, rhoI=(5e-5, 2.5e-5, 2.5e-5))
LAW = dr.Penalty(1e4, 1e-4)
# Half of the critical damping of two rods.
DAMPED = dr.Penalty(1e4, 1e-4, damping=1.0 / np.sqrt(2e4))
ELEMENTS, STEP = 3, 2e-3
MESH = {"elements": ELEMENTS, "degree": 3}
SCHEMES = pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])
EULER_SLOWLY = pytest.mark.parametrize(
    "scheme", [pytest.param(dr.ImplicitEuler(), marks=pytest.mark.slow), dr.Midpoint()], ids=["Euler", "midpoint"]
)
ROUGH = dr.Coulomb(0.4)


def bundle(
    scheme: dr.ImplicitEuler | dr.Midpoint,
    friction: dr.Coulomb | None = None,
    *,
    n: int = 3,
    steps: int = 12,
    law: dr.Penalty = LAW,
) -> dr.Scene:
    """n free rods one above the other, each askew of the next, thrown at each other."""
    rods, velocities = [], []
    for k in range(n):
        along = np.array([np.cos(0.6 * k), np.sin(0.6 * k), 0.03 * k])
        middle = np.array([0.02 * k, 0.01 * k, (2 * RADIUS + 2e-4) * k])
        along /= np.linalg.norm(along)
        rods.append(dr.Rod.straight(1.0, SECTION, start=tuple(middle - 0.5 * along), direction=tuple(along)))
        velocities.append(dr.Velocity((0.1 * k, 0.0, 0.2 - 0.4 * k / (n - 1)), rod=k))
    motion = dr.Dynamic(STEP * steps, dt=STEP, scheme=scheme)
    return dr.Scene(rods, contacts=[dr.RodContact(law, friction)], motion=motion, velocities=velocities)


def momenta(result: dr.Result) -> tuple[np.ndarray, np.ndarray]:
    """Linear momentum and moment of momentum of all rods, Gauss-Lobatto weights of cubic elements, (n_t, 3)."""
    weights = np.zeros(3 * ELEMENTS + 1)
    for e in range(ELEMENTS):
        weights[3 * e : 3 * e + 4] += np.array([1.0, 5.0, 5.0, 1.0]) / 12.0 / ELEMENTS
    linear, angular = np.zeros((2, len(result.t), 3))
    for h in result.rods:
        p, J = SECTION.rhoA * h.v, np.einsum("tsij,j,tskj->tsik", h.frames, SECTION.rhoI, h.frames)
        linear += np.einsum("s,tsi->ti", weights, p)
        angular += np.einsum("s,tsi->ti", weights, np.cross(h.r, p) + np.einsum("tsij,tsj->tsi", J, h.omega))
    return linear, angular


def assert_same(one: dr.Result, other: dr.Result, off: float) -> None:
    """Two records of one motion."""
    np.testing.assert_allclose(one.t, other.t, rtol=1e-12)
    for a, b in zip(one.rods, other.rods, strict=True):
        np.testing.assert_allclose(a.r, b.r, atol=off)
        np.testing.assert_allclose(a.v, b.v, atol=off * 1e2)
    for name, values in other.energy.items():
        np.testing.assert_allclose(one.energy[name], values, atol=off)
    for i in range(len(one.t)):
        np.testing.assert_allclose(one.meetings[0].force(i, 0, 1), other.meetings[0].force(i, 0, 1), atol=1e4 * off)


@pytest.mark.parametrize("friction", [None, ROUGH], ids=["smooth", "rough"])
@pytest.mark.parametrize("law", [LAW, DAMPED], ids=["elastic", "damped"])
def test_a_free_bundle_keeps_its_momenta(law, friction):
    """The midpoint rule keeps both to round-off, friction and its couples included; and the ledger closes."""
    result = dr.solve(bundle(dr.Midpoint(), friction, law=law), **MESH)
    assert max(result.meetings[0].total(i) for i in range(len(result.t))) > 1.0
    for momentum in momenta(result):
        assert largest(momentum - momentum[0]) <= 1e-9 * largest(momentum[0])


@SCHEMES
@pytest.mark.parametrize("law", [LAW, DAMPED], ids=["elastic", "damped"])
def test_the_ledger_closes(law, scheme):
    """What is stored changes by the works; friction takes, damping does, and so does backward Euler."""
    result = dr.solve(bundle(scheme, ROUGH, law=law), **MESH)
    E = result.energy
    stored = sum(E[name] for name in ("kinetic", "strain", "potential", "contact"))
    works = sum(values for name, values in E.items() if name not in ("kinetic", "strain", "potential", "contact"))
    np.testing.assert_allclose(stored - stored[0], works, atol=1e-12)
    assert E["contact"].max() > 1e-3
    assert (np.diff(E["friction"]) <= 1e-15).all()
    assert E["friction"][-1] < 0.0
    assert (np.diff(E["damping"]) <= 1e-15).all()
    assert (E["damping"][-1] < 0.0) == (law is DAMPED)
    assert (E["wall work"] == 0.0).all()
    assert {"Rod contact", "Friction", "Inertia"} <= set(result.formulation.terms)


@SCHEMES
def test_rods_with_damping_part_as_their_restitution_says(scheme):
    """Two alike side by side: a spring between two masses, of half of one of them."""
    ratio, time, off = 0.5, np.pi / np.sqrt(2.0 * LAW.eps_N), []
    law = dr.Penalty(LAW.eps_N, 0.0, 2.0 * ratio * time / np.pi)
    rods = [dr.Rod.straight(1.0, SECTION, start=(0.0, 0.0, z)) for z in (0.0, 2.0 * RADIUS + 1e-6)]
    flights = [dr.Velocity((0.0, 0.0, v), rod=k) for k, v in enumerate((0.5, -0.5))]
    for n in (50, 100):
        motion = dr.Dynamic(2.0 * time, dt=time / n, scheme=scheme)
        scene = dr.Scene(rods, contacts=[dr.RodContact(law)], motion=motion, velocities=flights)
        v = [h.v[-1, :, 2].mean() for h in dr.solve(scene, **MESH).rods]
        assert v[0] == pytest.approx(-v[1], rel=1e-6)
        off.append(restitution(ratio) - 2.0 * v[1])
    if isinstance(scheme, dr.Midpoint):
        assert np.abs(off).max() <= 1e-3
    else:
        assert off[0] / off[1] == pytest.approx(2.0, rel=0.15)


def test_forces_do_not_depend_on_the_order_of_rods():
    scene = bundle(dr.ImplicitEuler(), ROUGH, n=2, steps=6)
    turned = replace(scene, rods=scene.rods[::-1], velocities=[replace(v, rod=1 - v.rod) for v in scene.velocities])
    one, other = dr.solve(scene, **MESH), dr.solve(turned, **MESH)
    for i in range(len(one.t)):
        F, G = one.meetings[0].force(i, 0, 1), other.meetings[0].force(i, 1, 0)
        np.testing.assert_allclose(F, G, atol=1e-12 * largest(F))


@EULER_SLOWLY
@pytest.mark.parametrize("law", [LAW, DAMPED], ids=["elastic", "damped"])
def test_ranks_do_not_matter(law, scheme):
    scene = bundle(scheme, ROUGH, steps=6, law=law)
    assert_same(*(dr.solve(scene, comm=comm, **MESH) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)), 1e-9)


@EULER_SLOWLY
@pytest.mark.parametrize("law", [LAW, DAMPED], ids=["elastic", "damped"])
def test_an_interrupted_bundle_goes_on_to_the_same_answer(law, scheme, shared_path, monkeypatch):
    """By its file and by the result, anchors of friction included."""
    monkeypatch.setattr(clock, "INTERVAL", 0.0)
    monkeypatch.setattr(clock, "SPARING", 0.0)
    scene, file = bundle(scheme, ROUGH, steps=8, law=law), shared_path / "bundle.h5"
    whole = dr.solve(scene, **MESH)

    def stop(step: dr.StepLog, _t_end: float) -> None:
        if step.t > 4.5 * STEP:
            raise KeyboardInterrupt

    with pytest.raises(dr.NotConverged, match="interrupted") as caught:
        dr.solve(scene, checkpoint=file, progress=stop, **MESH)
    assert_same(dr.solve(scene, checkpoint=file, **MESH), whole, 1e-9)
    again = dr.solve(scene, start=caught.value.result, **MESH)
    np.testing.assert_allclose(again.rods[0].r[-1], whole.rods[0].r[-1], atol=1e-9)


def test_a_shot_over_a_diameter_a_step_hits():
    """What would pass through the other in one step is taken in shorter ones; seen from above they stay in order."""
    scene = bundle(dr.Midpoint(), n=2, steps=4)
    speed = 3 * RADIUS / STEP
    shot = replace(
        scene,
        velocities=[dr.Velocity((0.0, 0.0, speed), rod=0)],
        contacts=[dr.RodContact(dr.Penalty(1e7, 1e-4))],
    )
    result = dr.solve(shot, **MESH)
    assert sum(row.cuts for row in result.log) > 0
    at = np.linspace(0.0, 1.0, 400)
    # Three elements bend so hard here that straight lines between their nodes are a radius off.
    below, above = (interpolated(h.s, h.r[-1], MESH["degree"], at) for h in result.rods)
    seen = np.linalg.norm(below[:, None, :2] - above[None, :, :2], axis=2)
    i, j = np.unravel_index(seen.argmin(), seen.shape)
    assert above[j, 2] - below[i, 2] > RADIUS
    assert result.rods[1].v[-1, :, 2].mean() > 0.0


def test_rods_are_moved_alike_by_iteration_and_by_factors_of_all(monkeypatch):
    """Where the iteration gives up at once, all rods together are factorised: the same motion."""
    scene = bundle(dr.ImplicitEuler(), ROUGH, steps=8)
    iterated = dr.solve(scene, **MESH)
    monkeypatch.setattr("dolfinrod.continuum.coupled.MOST", 1)
    factorised = dr.solve(scene, **MESH)
    assert max(iterated.meetings[0].total(i) for i in range(len(iterated.t))) > 1.0
    assert_same(iterated, factorised, 1e-9)


@SCHEMES
def test_steps_grow_again_as_they_have_shrunk(scheme):
    """Rods thrown at each other, over two diameters a step: what a step met does not end with it."""
    dt = 0.1
    scene = replace(bundle(scheme, n=2), motion=dr.Dynamic(5 * dt, dt=dt, scheme=scheme))
    result = dr.solve(scene, **MESH)
    steps = np.diff(result.t)
    assert sum(row.cuts for row in result.log) > 0
    assert steps.min() < 0.3 * dt
    assert (steps[1:] <= 2.0 * steps[:-1] * (1.0 + 1e-9)).all()
    assert steps[-1] > 0.5 * dt


def test_steps_that_were_lost_are_not_halved_for_ever():
    """Where they grow again slowly, halves of what was asked for count, not those of the last step."""
    pace = Pace(1.0, 2)
    for tried in (1.0, 0.5, 0.25):
        pace.fail(tried)
    assert (pace.length, pace.halved(pace.length, 10.0)) == (0.125, 3)
    assert pace.allows(0.0, 0.125)
    assert (pace.length, pace.halved(pace.length, 10.0)) == (0.25, 2)
    assert Pace(1.0, 2, 1e-3).halved(0.125, 10.0) == 0


def test_steps_that_only_lead_to_a_time_close_by_say_nothing_of_the_next():
    """Outputs and kinks of histories between steps: without a loss, all is as if they were not there."""
    pace = Pace(1.0, 2)
    assert pace.allows(0.0, 0.01)
    assert pace.length == 1.0
    assert pace.halved(0.01, 0.01) == 0
    scene = bundle(dr.ImplicitEuler(), n=2)
    motion = dr.Dynamic(1.0, dt=0.25, output=(0.01, 1.0))
    result = dr.solve(replace(scene, contacts=(), motion=motion), **MESH)
    assert np.allclose([row.t for row in result.log], [0.01, 0.25, 0.5, 0.75, 1.0])
