"""Laws of sections that damp: decay and shift of vibrations, order in time, energy, frames of reference, ranks."""

from __future__ import annotations

from dataclasses import replace

from mpi4py import MPI

import dolfinx.jit
import numpy as np
import pytest
import ufl

import discrete
import dolfinrod as dr
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.spatial import SpatialRods
from tests.scenes import FLAT, SKEW, Array, both_kinematics, differences, largest, rotation

# No two stiffnesses or inertias alike, thick enough for its turning to count.
THICK = dr.Section(EA=1200.0, GA=(400.0, 300.0), GJ=0.8, EI=(1.0, 2.0), rhoA=1.0, rhoI=(3e-2, 1e-2, 2e-2), damping=0.03)
MESH = {"elements": 4, "degree": 3}
WORKS = ("load work", "support work", "drag", "damping", "numerical")
BOTH_SCHEMES = pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])
BOTH_RODS = pytest.mark.parametrize(
    ("rods", "chosen"),
    [(PlanarRods(), dr.Planar(SKEW.turned((0, 0, 1)))), (SpatialRods(), dr.Spatial())],
    ids=["planar", "spatial"],
)


def unaccounted(result: dr.Result) -> float:
    """What the ledger lacks, over the largest entry."""
    e = result.energy
    stored = sum(e[name] - e[name][0] for name in ("kinetic", "strain", "potential"))
    return largest(stored - sum(e[name] for name in WORKS)) / max(largest(values) for values in e.values())


# First root of cos x cosh x = −1: the lowest vibration of a cantilever, β L (Rayleigh 1877, § 174).
β = 1.8751040687119611


def bending(s: Array) -> Array:
    """That vibration, 1 at the end."""
    ratio = (np.cosh(β) + np.cos(β)) / (np.sinh(β) + np.sin(β))
    return 0.5 * (np.cosh(β * s) - np.cos(β * s) - ratio * (np.sinh(β * s) - np.sin(β * s)))


def quarter(s: Array) -> Array:
    """The lowest vibration of whatever is clamped at one end and free at the other and does not bend."""
    return np.sin(0.5 * np.pi * s)


# Sections whose turning has no inertia.
NONE = (0.0, 0.0, 0.0)
# What vibrates, along or across the rod or about it, how, at which frequency. Where it shears it cannot bend.
VIBRATIONS = {
    "stretch": (dr.Section(EA=4.0, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0, rhoI=NONE), (1.0, 0, 0), quarter, np.pi),
    "shear": (dr.Section(EA=1e7, GA=4.0, GJ=1e7, EI=1e7, rhoA=1.0, rhoI=NONE), (0, 1.0, 0), quarter, np.pi),
    "bending": (
        dr.Section(GJ=1.0, EI=1.0, rhoA=1.0, rhoI=NONE, rigid={"shear", "extension"}),
        (0, 1.0, 0),
        bending,
        β**2,
    ),
}
SMALL = 1e-5
# Of four cubic elements, relative, and of a rod that bends a little where it shears.
ACCURATE = 1e-6


def swing(ω: float, τ: float, h: float, n: int, scheme: object) -> Array:
    """q(t) of q̈ + τω² q̇ + ω² q = 0 with q = 0, q̇ = 1 at t = 0, after 0 … n steps of a scheme.

    q = Im(e^{st})/Im(s), s = ω (−ζ + i √(1 − ζ²)), ζ = τω/2: it decays by e^{−τω²t/2}. A step takes e^{sh} for
    1/(1 − sh) or (1 + sh/2)/(1 − sh/2).
    """
    ζ = 0.5 * τ * ω
    s = ω * complex(-ζ, np.sqrt(1.0 - ζ**2))
    factor = 1.0 / (1.0 - s * h) if isinstance(scheme, dr.ImplicitEuler) else (1.0 + s * h / 2) / (1.0 - s * h / 2)
    return (factor ** np.arange(n + 1)).imag / s.imag


@pytest.mark.serial
@BOTH_SCHEMES
@both_kinematics
@pytest.mark.parametrize("kind", VIBRATIONS)
def test_vibrations_decay_as_those_of_a_damped_oscillator(kind, kinematics, scheme):
    section, direction, shape, ω = VIBRATIONS[kind]
    τ, h, n = 0.2 / ω, 0.4 / ω, 12
    across = np.asarray(SKEW.turned(direction))
    push = dr.Velocity(v=lambda r: SMALL * shape(SKEW.back(r)[:, 0])[:, None] * across)
    motion = dr.Dynamic(t_end=n * h, dt=h, scheme=scheme)
    rod = SKEW.straight(replace(section, damping=τ))
    scene = dr.Scene([rod], [dr.Clamp("start")], motion=motion, velocities=[push])
    tip = dr.solve(scene, kinematics=kinematics, **MESH).rods[0].r[:, -1]
    found = (tip - tip[0]) @ across / SMALL
    np.testing.assert_allclose(found, swing(ω, τ, h, n, scheme), rtol=0, atol=ACCURATE / ω)


def lobatto(n: int) -> Array:
    """Weights of the nodes of n cubic elements over a unit of length."""
    weights = np.zeros(3 * n + 1)
    for e in range(n):
        weights[3 * e : 3 * e + 4] += np.array([1.0, 5.0, 5.0, 1.0]) / 12.0 / n
    return weights


@pytest.mark.serial
@BOTH_SCHEMES
def test_twist_decays_so_too(scheme):
    """All sections of a rod clamped at one end are set spinning alike: the part of the lowest vibration in it."""
    ω, n = np.pi, 12
    τ, h = 0.2 / ω, 0.4 / ω
    section = dr.Section(EA=1.0, GA=1.0, GJ=4.0, EI=1.0, rhoA=1.0, rhoI=(1.0, 1.0, 1.0), damping=τ)
    spin = dr.Velocity(omega=SKEW.turned((SMALL, 0, 0)))
    motion = dr.Dynamic(t_end=n * h, dt=h, scheme=scheme)
    scene = dr.Scene([SKEW.straight(section)], [dr.Clamp("start")], motion=motion, velocities=[spin])
    rod = dr.solve(scene, **MESH).rods[0]
    angle = np.einsum("tsi,i->ts", rod.frames[..., 1], rod.frames[0, 0, :, 2])
    weights = lobatto(4) * quarter(rod.s)
    found = angle @ weights / weights.sum() / SMALL
    np.testing.assert_allclose(found, swing(ω, τ, h, n, scheme), rtol=0, atol=ACCURATE / ω)


def arched(motion: dr.Dynamic | dr.Static, section: dr.Section = THICK, history: object = None) -> dr.Scene:
    """A clamped arc in its plane that a force and a moment at its end bend far."""
    acting = dr.Steady() if history is None else history
    loads = [
        dr.PointForce(SKEW.turned((1.0, 3.0, 0.0)), "end", history=acting),
        dr.FollowerMoment((0.0, 0.0, 1.0), "end", history=acting),
    ]
    return dr.Scene([SKEW.arc(section, radius=1.0, angle=1.0)], [dr.Clamp("start")], loads, motion=motion)


def grown(t: float) -> float:
    """From 0 to 1 in 0.3 s, smoothly."""
    return float(np.sin(np.pi * t / 0.6) ** 2)


@pytest.mark.serial
@pytest.mark.parametrize(
    ("scheme", "kinematics", "order"),
    [(dr.ImplicitEuler(), dr.Planar(SKEW.turned((0, 0, 1))), 1), (dr.Midpoint(), dr.Spatial(), 2)],
    ids=["Euler", "midpoint"],
)
def test_order_in_the_time_step(scheme, kinematics, order):
    """Positions, velocities, frames, and what damping took: 1 for backward Euler, 2 for the midpoint rule."""
    ends = []
    for n in (20, 40, 80):
        scene = arched(dr.Dynamic(t_end=0.3, dt=0.3 / n, scheme=scheme, output=0.3), history=grown)
        result = dr.solve(scene, kinematics=kinematics, elements=2)
        h = result.rods[0]
        ends.append([h.r[-1], h.frames[-1], h.v[-1, 1:], result.energy["damping"][-1:]])
    for coarse, middle, fine in zip(*ends, strict=True):
        observed = np.log2(largest(middle - coarse) / largest(fine - middle))
        assert observed == pytest.approx(order, abs=0.25)


def damped(rods: PlanarRods | SpatialRods, chosen: dr.Planar | dr.Spatial) -> Problem:
    """A free arc far from rest, in a step from another such state."""
    scene = dr.Scene([SKEW.arc(THICK, angle=1.0)], motion=dr.Dynamic(t_end=1.0, dt=0.1))
    d = Discretization(MPI.COMM_SELF, rods, 3, (2,), stepped=True)
    problem = Problem(scene, d, Placement.of(scene, chosen))
    problem.x[:] += np.random.default_rng(5).normal(size=len(problem.x), scale=0.3)
    return problem


@pytest.mark.serial
@BOTH_RODS
@pytest.mark.parametrize("level", [1.0, 0.5], ids=["Euler", "midpoint"])
def test_the_tangent_is_that_of_the_residual(rods, chosen, level):
    problem = damped(rods, chosen)
    d, x, random = problem.discretization, problem.x.copy(), np.random.default_rng(7)
    d.begin_step(x + random.normal(size=len(x), scale=0.2), 0.01, level)
    v = random.normal(size=len(x))
    A = d.tangent.matrix()
    d.tangent.add_matrix(A)
    A.assemble()
    ε = 1e-5
    sides = []
    for sign in (1.0, -1.0):
        problem.x[:] = x + sign * ε * v
        sides.append(d.assembled_residual().copy())
    product = A.convert("dense").getDenseArray() @ v
    np.testing.assert_allclose((sides[0] - sides[1]) / (2 * ε), product, rtol=0, atol=1e-7 * largest(product))


@pytest.mark.serial
@BOTH_RODS
@pytest.mark.parametrize("level", [1.0, 0.5], ids=["Euler", "midpoint"])
def test_no_rigid_motion_is_damped_however_far_it_goes(rods, chosen, level):
    """From any state: what moves and turns by one motion between two states has no rates, wherever forces are taken."""
    problem = damped(rods, chosen)
    d, before = problem.discretization, problem.x.copy()
    r, q = (d.dofs[f].reshape(-1, d.dofs[f].shape[2]) for f in ("r", "q"))
    after = before.copy()
    if d.kinematics.dim == 3:
        p = np.array([0.3, -0.7, 0.4, 0.5]) / np.linalg.norm([0.3, -0.7, 0.4, 0.5])
        w, u = p[0], p[1:]
        after[q[:, 0]] = w * before[q[:, 0]] - before[q[:, 1:]] @ u
        after[q[:, 1:]] = w * before[q[:, 1:]] + np.outer(before[q[:, 0]], u) + np.cross(u, before[q[:, 1:]])
        Q = rotation(p)
    else:
        after[q] += 2.0
        Q = np.array([[np.cos(2.0), -np.sin(2.0)], [np.sin(2.0), np.cos(2.0)]])
    after[r] = before[r] @ Q.T + np.arange(1.0, d.kinematics.dim + 1.0)
    assert d.excess is not None
    rates = []
    for dt in (1e-3, 1e9):
        # In an endless step there are no rates, and the means of strains are what they are in a short one.
        d.begin_step(before, dt, level)
        problem.x[:] = before + level * (after - before)
        rates.append(d.excess.rates().copy())
    assert largest(rates[0] - rates[1]) <= 1e-10 < 1e-3 < largest(problem.values.τ) / 1e-3


def test_a_rod_that_spins_without_strain_is_not_damped():
    """Straight, free, neither stretched nor sheared, sections that follow their centreline: nothing bends it."""
    section = dr.Section(GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(2e-2, 0.0, 0.0), rigid={"shear", "extension"}, damping=0.1)
    spin = dr.Velocity(v=(0.3, 0.0, 1.0), omega=(0.0, 0.0, 5.0), about=(0.5, 0.0, 0.0))
    for scheme in (dr.ImplicitEuler(), dr.Midpoint()):
        motion = dr.Dynamic(t_end=0.5, dt=0.05, scheme=scheme)
        result = dr.solve(
            dr.Scene([dr.Rod.straight(1.0, section)], motion=motion, velocities=[spin]), kinematics=dr.Spatial(), **MESH
        )
        assert largest(result.energy["damping"]) <= 1e-12 * result.energy["kinetic"][0]


def thrown(motion: dr.Dynamic, *sections: dr.Section) -> dr.Scene:
    """Free rods that turn about three axes and bend meanwhile."""

    def bent(r: Array) -> Array:
        return np.stack([0.0 * r[:, 0], 2.0 * np.sin(np.pi * r[:, 0]), 1.0 - np.cos(2.0 * np.pi * r[:, 0])], axis=1)

    start = (dr.Velocity(v=(0.3, 0.2, -0.1), omega=(8.0, 2.0, -3.0)), dr.Velocity(v=bent))
    return dr.Scene([dr.Rod.straight(1.0, section) for section in sections], motion=motion, velocities=start)


def test_a_free_rod_keeps_its_momenta_while_its_vibrations_die_out():
    """Damping is an inner force: the midpoint rule keeps both momenta to round-off."""
    result = dr.solve(thrown(dr.Dynamic(t_end=0.3, dt=0.02, scheme=dr.Midpoint()), THICK), **MESH)
    h, weights = result.rods[0], lobatto(4)
    J = np.einsum("tsij,j,tskj->tsik", h.frames, THICK.rhoI, h.frames)
    linear = np.einsum("s,tsi->ti", weights, h.v)
    angular = np.einsum("s,tsi->ti", weights, np.cross(h.r, h.v) + np.einsum("tsij,tsj->tsi", J, h.omega))
    for momentum in (linear, angular):
        assert largest(momentum - momentum[0]) <= 1e-11 * largest(momentum[0])
    assert result.energy["damping"][-1] < -0.05 * result.energy["kinetic"][0]


@BOTH_SCHEMES
@both_kinematics
@pytest.mark.parametrize("rigid", [frozenset(), frozenset({"shear", "extension"})], ids=["elastic", "rigid"])
def test_the_ledger_closes_and_damping_only_takes(rigid, kinematics, scheme):
    """With a weight, a push, and a clamp that moves and turns."""
    moving = dr.Prescribed(
        "start",
        displacement=FLAT.turned((0.0, 0.3, 0.0)),
        rotation=FLAT.turned((0.0, 0.0, 0.5)),
        history=lambda t: np.sin(3.0 * t) ** 2,
    )
    loads = [dr.Gravity(FLAT.turned((0.5, -2.0, 0.0))), dr.PointForce(FLAT.turned((0.0, 3.0, 0.0)), "end")]
    scene = dr.Scene(
        [FLAT.straight(replace(THICK, rigid=rigid))],
        [moving],
        loads,
        motion=dr.Dynamic(t_end=0.5, dt=0.05, scheme=scheme),
    )
    result = dr.solve(scene, kinematics=kinematics, **MESH)
    assert unaccounted(result) <= 1e-12
    assert (np.diff(result.energy["damping"]) < 0.0).all()


@pytest.mark.serial
def test_the_numerical_entry_of_the_midpoint_rule_falls_as_dt_squared():
    """What the rule itself adds or takes stays apart from what damping takes."""
    off = []
    for n in (25, 50):
        result = dr.solve(arched(dr.Dynamic(t_end=0.5, dt=0.5 / n, scheme=dr.Midpoint())), **MESH)
        assert unaccounted(result) <= 1e-12
        off.append(largest(result.energy["numerical"]))
    assert off[1] < 0.35 * off[0]


@pytest.mark.serial
def test_strains_are_those_of_the_shape_and_resultants_those_of_strains_and_rates():
    """n = diag(EA, …)(γ + τ γ̇), m = diag(GJ, …)(κ + τ κ̇), backward Euler; κ adds up to the turn of the sections."""
    τ, dt = 0.03, 0.01
    section = dr.Section(EA=1200.0, GA=400.0, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=NONE, damping=τ)
    push = dr.PointForce(FLAT.turned((0.0, 3.0, 0.0)), "end", history=lambda t: np.sin(np.pi * t) ** 2)
    motion = dr.Dynamic(t_end=0.5, dt=dt)
    h = dr.solve(dr.Scene([FLAT.straight(section)], [dr.Clamp("start")], [push], motion=motion), elements=8).rods[0]
    moved = [np.diff(strain, axis=0) / dt for strain in (h.gamma, h.kappa)]
    for strain, rate, stiffness, resultant in (
        (h.gamma, moved[0], (1200.0, 400.0, 400.0), h.n),
        (h.kappa, moved[1], (0.8, 1.0, 1.0), h.m),
    ):
        expected = np.asarray(stiffness) * (strain[1:] + τ * rate)
        np.testing.assert_allclose(resultant[1:], expected, rtol=0, atol=1e-4 * largest(expected))
    turned = np.arctan2(h.frames[:, -1, 1, 0], h.frames[:, -1, 0, 0])
    np.testing.assert_allclose(h.kappa[:, :, 2] @ lobatto(8), turned, rtol=0, atol=1e-8)
    assert largest(h.m[-1, -1]) <= 1e-12


@pytest.mark.serial
@both_kinematics
def test_a_heavily_damped_rod_comes_to_rest_where_statics_finds_it(kinematics):
    section = replace(THICK, damping=5.0)
    rest = dr.solve(arched(dr.Static(), section), kinematics=kinematics, **MESH)
    moved = dr.solve(arched(dr.Dynamic(t_end=4e3, dt=200.0, output=4e3), section), kinematics=kinematics, **MESH)
    assert max(differences(moved, rest).values()) <= 1e-9


@pytest.mark.serial
def test_rods_of_one_scene_damp_each_in_its_own_way():
    motion = dr.Dynamic(t_end=0.1, dt=0.02, scheme=dr.Midpoint())
    sections = [replace(THICK, damping=τ) for τ in (0.05, 0.0, 0.01)]
    together = dr.solve(thrown(motion, *sections), **MESH)
    taken = 0.0
    for h, section in zip(together.rods, sections, strict=True):
        alone = dr.solve(thrown(motion, section), **MESH)
        for name in ("r", "frames", "v", "n", "m", "gamma", "kappa"):
            expected = getattr(alone.rods[0], name)
            np.testing.assert_allclose(getattr(h, name), expected, rtol=0, atol=1e-9 * max(1.0, largest(expected)))
        taken = taken + alone.energy["damping"]
    np.testing.assert_allclose(together.energy["damping"], taken, rtol=1e-9)


@pytest.mark.serial
def test_what_does_not_damp_leaves_no_trace(monkeypatch):
    """No term, nothing compiled, the same doubles before and after a scene that does; another τ compiles nothing."""
    compiled = []
    compile_form = dolfinx.jit.ffcx_jit

    def counted(*arguments: object, **options: object) -> object:
        compiled.extend(a for a in arguments if isinstance(a, ufl.Form))
        return compile_form(*arguments, **options)

    monkeypatch.setattr(dolfinx.jit, "ffcx_jit", counted)
    motion = dr.Dynamic(t_end=0.1, dt=0.02)
    options = {"elements": 3, "degree": 3}
    still = dr.solve(arched(motion, replace(THICK, damping=0.0)), **options)
    assert still.formulation.terms == ("Elasticity", "PointForce", "FollowerMoment", "Inertia")
    assert not still.energy["damping"].any()
    slow = dr.solve(arched(motion), **options)
    assert slow.formulation.terms == (*still.formulation.terms, "Damping")
    before = len(compiled)
    dr.solve(arched(motion, replace(THICK, damping=0.1)), elements=5, degree=3)
    again = dr.solve(arched(motion, replace(THICK, damping=0.0)), **options)
    kept = dr.solve(arched(motion), **options)
    assert len(compiled) == before
    for name in ("r", "v", "n", "m"):
        np.testing.assert_array_equal(getattr(again.rods[0], name), getattr(still.rods[0], name))
        np.testing.assert_array_equal(getattr(kept.rods[0], name), getattr(slow.rods[0], name))


@pytest.mark.serial
def test_both_models_agree():
    """A damped cantilever that swings far, backward Euler in both: apart by the elements of the discrete model."""
    section = dr.Section(EA=1e4, GJ=1.0, EI=1.0, rhoA=1.0, rhoI=NONE, rigid={"shear"}, damping=0.05)
    push = dr.PointForce(FLAT.turned((0.0, 3.0, 0.0)), "end", history=dr.Steady())
    motion = dr.Dynamic(t_end=0.5, dt=0.02)
    scene = dr.Scene([FLAT.straight(section)], [dr.Clamp("start")], [push], motion=motion)
    ours = dr.solve(scene, **MESH)
    apart = []
    for n in (10, 20):
        other = discrete.solve(scene, elements=n)
        taken = other.energy["damping"][-1] / ours.energy["damping"][-1] - 1.0
        apart.append(
            [largest(other.tip - ours.tip), abs(taken), largest(other.rods[0].m[-1, 0] - ours.rods[0].m[-1, 0])]
        )
    assert (np.array(apart[1]) < 0.35 * np.array(apart[0])).all()
    assert max(apart[1]) < 0.01


@pytest.mark.serial
def test_steps_of_free_length_follow_the_tolerance():
    """Apart from even steps by less than the tolerance of each, times their number; the ledger closes at once."""
    even, free = (
        dr.solve(arched(dr.Dynamic(t_end=0.3, scheme=dr.Midpoint(), output=0.3, **steps), history=grown), elements=2)
        for steps in ({"dt": 0.3 / 40}, {"dt": None, "tol": 1e-4})
    )
    assert largest(free.tip - even.tip) <= 1e-4 * len(free.log)
    assert unaccounted(free) <= 1e-12


@BOTH_SCHEMES
def test_one_and_two_ranks_agree(scheme):
    scene = thrown(dr.Dynamic(t_end=0.1, dt=0.02, scheme=scheme), THICK, replace(THICK, damping=0.0))
    together, alone = (dr.solve(scene, comm=comm, **MESH) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    for one, other in zip(together.rods, alone.rods, strict=True):
        for name in ("r", "frames", "v", "omega", "n", "m", "gamma", "kappa"):
            b = getattr(other, name)
            np.testing.assert_allclose(getattr(one, name), b, rtol=0, atol=1e-10 * max(1.0, largest(b)))
    for name, values in alone.energy.items():
        np.testing.assert_allclose(together.energy[name], values, rtol=0, atol=1e-10 * max(1.0, largest(values)))
