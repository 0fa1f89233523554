"""A step in time while it is iterated on: velocities, and the configuration that follows from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.momentum import in_body
from discrete.moving import Moving
from discrete.rotation import cross, exp, log, rate
from discrete.unknowns import AXIAL, SPIN, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.supports import Supports

    Array = NDArray[np.float64]

__all__ = ["Step", "StepLostError"]

# Turn of a support in one step beyond which it is not told from the other way round [rad].
HALF_TURN = 3.0
# Turns in a step below which a rotation vector follows the spin to the accuracy of a Newton iteration, 1e-4 [rad].
SMALL = 0.03


class StepLostError(ArithmeticError):
    """A step that could not be taken."""


class Step:
    """x₁ = x₀ + Δt v₁ and R₁ = exp(Δt ω₁) R₀, the supports where they will be.

    Args:
        mesh: Nodes and elements.
        supports: What holds.
        now: Where the step begins.
        t: Where it ends.
        added: Whether rotation vectors are added up instead, R₁ = exp(Σ Δt ω) R at the start.
        staying: Whether the first guess is the configuration at the start instead of the one to which the motion leads.

    Attributes:
        t: As above.
        dt: Its length.
        v: Velocities at its end, shape (n_nodes, 3).
        ω: Angular velocities, global axes, shape (n_nodes, 3).
        Ω: The same in section axes, of the last configuration, shape (n_nodes, 3).
        ΔΩ: Their change over the step, each in its own section axes.
        θ: Rotation vectors that ω makes of those before, shape (n_nodes, 3).
        F_n: Axial forces, shape (n,).

    Raises:
        StepLostError: A support turns too far.
    """

    Ω: Array
    ΔΩ: Array
    θ: Array

    def __init__(self, mesh: Mesh, supports: Supports, now: Moving, t: float, *, added: bool, staying: bool) -> None:
        self._node_i, self._now, self.t, self.dt = mesh.elements.node_i, now, t, t - now.t
        self._goal, self._added = supports.factors(t), added
        self._base = mesh.R if added else now.R
        self._θ_0: Array | None = now.θ if added else None
        self._Ω_0 = in_body(now.R, now.ω)
        self._frames = [(turn.node, turn.frame(self._goal)) for turn in supports.turns]
        self.v, self.ω, self.F_n = now.v.copy(), now.ω.copy(), now.F_n.copy()
        if staying:
            self.v.fill(0.0)
            self.ω.fill(0.0)
        else:
            self._go_on_as_before()
        moved = supports.increments(now.x, now.factors, self._goal)
        self._check_turns(supports, moved)
        held = supports.firm[:, :3]
        self.v[held] = moved[:, X][held] / self.dt
        self.ω[supports.firm[:, 3:]] = 0.0
        for node, frame in self._frames:
            self.ω[node] = log(frame @ now.R[node].T) / self.dt

    def configuration(self) -> tuple[Array, Array]:
        """Positions and section frames."""
        self.θ = self.dt * self.ω
        if self._θ_0 is not None:
            self.θ += self._θ_0
        R = np.matmul(exp(self.θ), self._base)
        for node, frame in self._frames:
            R[node] = frame
        self.Ω = in_body(R, self.ω)
        self.ΔΩ = self.Ω - self._Ω_0
        return self._now.x + self.dt * self.v, R

    @property
    def Δv(self) -> Array:
        """Change of the velocities over the step, shape (n_nodes, 3)."""
        return self.v - self._now.v

    def move(self, d: Array) -> None:
        """Take increments of positions, spins and axial forces, shape (n_nodes, 7)."""
        spin = d[:, SPIN]
        small = float(np.abs(self.θ).max()) < SMALL
        self.v += d[:, X] / self.dt
        self.ω += (spin - cross(0.5 * self.θ, spin) if small else rate(self.θ, spin)) / self.dt
        self.F_n += d[self._node_i, AXIAL]

    def motion(self) -> float:
        """Largest displacement or turn in the step."""
        return self.dt * max(float(np.abs(self.v).max()), float(np.abs(self.ω).max()))

    def end(self) -> Moving:
        """State at its end."""
        x, R = self.configuration()
        now, h = self._now, 1.0 / self.dt
        trend = h * self.Δv, h * (self.ω - now.ω), h * (self.F_n - now.F_n)
        bend = None
        if now.trend is not None:
            (a, α, F), (a_0, α_0, F_0) = trend, now.trend
            bend = h * (a - a_0), h * (α - α_0), h * (F - F_0)
        θ = self.θ if self._added else now.θ
        return Moving(self.t, x, R, self.F_n, self.v, self.ω, self._goal, θ, trend, bend)

    def _go_on_as_before(self) -> None:
        """First guess: velocities and axial forces as parabolas through those of the steps before."""
        now, dt = self._now, self.dt
        for order, rates in ((1, now.trend), (2, now.bend)):
            if rates is not None:
                for value, rate_of in zip((self.v, self.ω, self.F_n), rates, strict=True):
                    value += dt**order * rate_of

    def _check_turns(self, supports: Supports, moved: Array) -> None:
        """No support turns so far that its turn would be taken for a shorter one."""
        for turn in supports.turns:
            if np.linalg.norm(moved[turn.node, SPIN]) > HALF_TURN:
                raise StepLostError("a support turns by about half a turn or more in one step")
