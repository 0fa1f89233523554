"""Rigid bodies through the inertia of one node: free and heavy tops, and what mutations of the law would do."""

from __future__ import annotations

import numpy as np
import pytest

from discrete.momentum import Inertia, in_body
from discrete.rotation import exp, rate, tangents


def spun(J, Ω, moment, t_end, steps):
    """Frame and angular velocity in the body of one rigid node that backward Euler turns, Newton's method each step.

    Args:
        J: Inertia in the body, shape (3,).
        Ω: Angular velocity at the start, body axes, shape (3,).
        moment: Moment in global axes of a frame, (1, 3, 3) → (1, 3), and its derivative with the spin, (1, 3, 3).
        t_end: Duration.
        steps: Their number.
    """
    node, dt = Inertia(np.ones(1), np.array([J])), t_end / steps
    R, Ω = np.eye(3)[None], np.array([Ω], dtype=float)
    for _ in range(steps):
        θ, R_0, Ω_0 = dt * np.einsum("nij,nj->ni", R, Ω), R, Ω
        for _ in range(20):
            R = exp(θ) @ R_0
            ω = θ / dt
            Ω = in_body(R, ω)
            needed = node.moment(R, Ω, Ω - Ω_0, dt)
            blocks = node.blocks(R, ω, Ω, needed, tangents(θ, θ)[0], dt)[:, 3:, 3:]
            M, slope = moment(R)
            φ = np.linalg.solve(blocks - slope, (M - needed)[..., None])[..., 0]
            θ = θ + rate(θ, φ)
            if np.abs(φ).max() < 1e-14:
                break
        else:
            raise AssertionError("Newton's method did not converge quadratically")
    return R[0], Ω[0]


def free(_):
    return np.zeros((1, 3)), np.zeros((1, 3, 3))


def heavy(R):
    """Moment c × m g of a centre of mass at R (0, 1, 0), m = 15, g = 9.81 along −z."""
    c, weight = R[:, :, 1], np.array([0.0, 0.0, -15 * 9.81])
    # δ(c × G) = −G × (φ × c)
    G, C = (np.cross(np.eye(3), v) for v in (weight, c[0]))
    return np.cross(c, weight), (G @ C)[None]


def extrapolated(run, steps):
    """Order one taken out, and the ratio of the differences of three runs."""
    coarse, middle, fine = (run(n) for n in (steps, 2 * steps, 4 * steps))
    return 2 * fine - middle, np.linalg.norm(middle - coarse) / np.linalg.norm(fine - middle)


@pytest.mark.parametrize(
    ("J", "start", "end"),
    [
        ((1.0, 2.0, 3.0), (0.1, 1.0, 0.1), (-0.5972700502763718, 0.808250262630822, 0.35436869357452233)),
        ((1.0, 1.0, 2.0), (0.3, 0.0, 2.0), (-0.25172145872293317, -0.16320633326677997, 2.0)),
    ],
)
def test_free_top(J, start, end):
    """Case K7 at t = 5."""
    found, ratio = extrapolated(lambda n: spun(J, start, free, 5.0, n)[1], 150)
    assert found == pytest.approx(end, abs=2e-2)
    assert ratio == pytest.approx(2.0, abs=0.3)


def test_attitude_of_a_free_top():
    """Case K7, J = (1, 2, 3), ω₀ = (0.1, 1, 0.1) at t = 1, as a quaternion up to its sign."""
    q = np.array([0.8755247784810687, 0.025174806691809524, 0.48032066590486633, 0.045985315899589575])
    w, v = q[0], q[1:]
    exact = (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * np.cross(np.eye(3), v).T
    found, _ = extrapolated(lambda n: spun((1.0, 2.0, 3.0), (0.1, 1.0, 0.1), free, 1.0, n)[0], 50)
    exact = exact if np.abs(exact - found).max() < np.abs(exact.T - found).max() else exact.T
    assert found == pytest.approx(exact, abs=1e-4)


def test_a_free_top_never_gains_energy():
    J = np.array([1.0, 2.0, 3.0])
    Ω, energies = np.array([1.0, -2.0, 1.5]), []
    for steps in (25, 50, 100):
        end = spun(J, Ω, free, 5.0, steps)[1]
        energies.append(0.5 * J @ end**2)
    assert max(energies) <= 0.5 * J @ Ω**2


def test_heavy_top():
    """Case K8 (Géradin & Cardona) at t = 0.1, J about the fixed point; 150 rad/s leave little to one order."""
    J = (15.234375, 0.46875, 15.234375)
    found, ratio = extrapolated(lambda n: spun(J, (0.0, 150.0, -4.61538), heavy, 0.1, n)[0][:, 1], 100)
    assert found == pytest.approx([0.42129665892536233, 0.894571974345606, -0.14916470056193015], abs=2e-2)
    assert ratio == pytest.approx(2.0, abs=0.45)


def test_blocks_are_the_derivative_of_what_inertia_takes():
    """Force and moment of a displaced and spun node by central differences, order two."""
    rng = np.random.default_rng(3)
    node, dt = Inertia(rng.uniform(1, 2, 2), rng.uniform(1, 3, (2, 3))), 0.3
    R_0, θ, Ω_0 = exp(rng.normal(size=(2, 3))), rng.normal(size=(2, 3)), rng.normal(size=(2, 3))

    def needed(θ):
        R = exp(θ) @ R_0
        Ω = in_body(R, θ / dt)
        return R, Ω, node.moment(R, Ω, Ω - Ω_0, dt)

    R, Ω, moment = needed(θ)
    blocks = node.blocks(R, θ / dt, Ω, moment, tangents(θ, θ)[0], dt)
    for k, unit in enumerate(np.eye(3)):
        step = 1e-6 * rate(θ, np.tile(unit, (2, 1)))
        slope = (needed(θ + step)[2] - needed(θ - step)[2]) / 2e-6
        assert blocks[:, 3:, 3 + k] == pytest.approx(slope, abs=1e-7)
    assert blocks[:, :3, :3] == pytest.approx((node.m / dt**2)[:, None, None] * np.eye(3))
    assert not blocks[:, :3, 3:].any()
    assert not blocks[:, 3:, :3].any()
