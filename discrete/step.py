"""A step in time while it is iterated on: velocities, and the configuration that follows from them."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from discrete.moving import Moving
from discrete.rotation import log, rate
from discrete.rows import cross, of_frames, of_vectors, turn_back, turned
from discrete.unknowns import AXIAL, SPIN, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.supports import Supports

    Array = NDArray[np.float64]

__all__ = ["PiercedError", "Step", "StepLostError"]

# Turn of a support in one step beyond which it is not told from the other way round [rad].
HALF_TURN = 3.0
# Turns in a step below which a rotation vector follows the spin to the accuracy of a Newton iteration, 1e-4 [rad].
SMALL = 0.03


class StepLostError(ArithmeticError):
    """A step that could not be taken."""


class PiercedError(StepLostError):
    """A step so long that a rod went through another: no other first guess of it helps."""


class Step:
    """x₁ = x₀ + Δt v₁ and R₁ = exp(Δt ω₁) R₀, the supports where they will be; all arrays by rows.

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
        v: Velocities at its end, shape (3, n_nodes).
        ω: Angular velocities, global axes, shape (3, n_nodes).
        Ω: The same in section axes, of the last configuration, shape (3, n_nodes).
        ΔΩ: Their change over the step, each in its own section axes.
        θ: Rotation vectors that ω makes of those before, shape (3, n_nodes).
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
        self._x_0, self._v_0, self._ω_0 = of_vectors(now.x), of_vectors(now.v), of_vectors(now.ω)
        R_0 = of_frames(now.R)
        self._base = of_frames(mesh.R) if added else R_0
        self._θ_0: Array | None = of_vectors(now.θ) if added else None
        self._Ω_0 = turn_back(R_0, self._ω_0[None])[0]
        self._frames = [(turn.node, turn.frame(self._goal)) for turn in supports.turns]
        # v and ω are one array, so that what is asked of both is asked once.
        self._rates = np.zeros((AXIAL, len(now.x)))
        self.v, self.ω, self.F_n = self._rates[X], self._rates[SPIN], now.F_n.copy()
        if not staying:
            self._go_on_as_before()
        moved = supports.increments(now.x, now.factors, self._goal)
        self._check_turns(supports, moved)
        self._rates.reshape(-1)[supports.firm_rows] = moved[:, :AXIAL].T.reshape(-1)[supports.firm_rows] / self.dt
        for node, frame in self._frames:
            self.ω[:, node] = log(frame @ now.R[node].T) / self.dt

    def configuration(self) -> tuple[Array, Array]:
        """Positions and section frames, shapes (3, n_nodes) and (3, 3, n_nodes)."""
        self.θ = self.dt * self.ω
        if self._θ_0 is not None:
            self.θ += self._θ_0
        R = turned(self._base, self.θ)
        for node, frame in self._frames:
            R[:, :, node] = frame
        self.Ω = turn_back(R, self.ω[None])[0]
        self.ΔΩ = self.Ω - self._Ω_0
        return self._x_0 + self.dt * self.v, R

    @property
    def Δv(self) -> Array:
        """Change of the velocities over the step, shape (3, n_nodes)."""
        return self.v - self._v_0

    def move(self, d: Array) -> None:
        """Take increments of positions, spins and axial forces, shape (7, n_nodes)."""
        change, spin = d[:AXIAL] / self.dt, d[SPIN]
        if float(np.abs(self.θ).max()) < SMALL:
            change[SPIN] -= cross((0.5 / self.dt) * self.θ, spin)
        else:
            change[SPIN] = rate(self.θ.T, spin.T).T / self.dt
        self._rates += change
        self.F_n += d[AXIAL, self._node_i]

    def motion(self) -> float:
        """Largest displacement or turn in the step."""
        return self.dt * float(np.abs(self._rates).max())

    def end(self) -> Moving:
        """State at its end."""
        x, R = self.configuration()
        now, h = self._now, 1.0 / self.dt
        trend = h * self.Δv.T, h * (self.ω - self._ω_0).T, h * (self.F_n - now.F_n)
        bend = None
        if now.trend is not None:
            (a, α, F), (a_0, α_0, F_0) = trend, now.trend
            bend = h * (a - a_0), h * (α - α_0), h * (F - F_0)
        θ = self.θ.T if self._added else now.θ
        frames = R.transpose(2, 0, 1)
        return Moving(self.t, x.T, frames, self.F_n, self.v.T, self.ω.T, self._goal, θ, trend, bend)

    def _go_on_as_before(self) -> None:
        """First guess: velocities and axial forces as parabolas through those of the steps before."""
        now, dt = self._now, self.dt
        self.v += self._v_0
        self.ω += self._ω_0
        for order, rates in ((1, now.trend), (2, now.bend)):
            if rates is not None:
                a, α, F = rates
                self.v += dt**order * a.T
                self.ω += dt**order * α.T
                self.F_n += dt**order * F

    def _check_turns(self, supports: Supports, moved: Array) -> None:
        """No support turns so far that its turn would be taken for a shorter one."""
        for turn in supports.turns:
            if sqrt(float(moved[turn.node, SPIN] @ moved[turn.node, SPIN])) > HALF_TURN:
                raise StepLostError("a support turns by about half a turn or more in one step")
