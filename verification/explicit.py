"""Explicit steps in time of the paper's rod, for comparison only: what an implicit scheme is measured against.

Elements and masses are those of `discrete`; nothing is solved, each step takes one evaluation of the forces, and is
stable, if at all, only while Δt < 2/ω_max.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from discrete.assembly import scatter
from discrete.corotation import ChordElement
from discrete.loads import Loads
from discrete.mass import node_masses
from discrete.mesh import mesh
from discrete.momentum import Inertia
from discrete.rotation import cross, exp
from discrete.supports import Supports
from discrete.unknowns import SPIN, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]
    Places = NDArray[np.bool_]

__all__ = ["Explicit", "ForwardEuler", "Moved", "Nodes", "Rule", "SymplecticEuler"]

# Gain of energy over all that was put in beyond which a run is lost: it doubles every few steps from there on.
LOST = 1.0
# Steps between two looks at the energy.
EVERY = 20


@dataclass(frozen=True, eq=False)
class Nodes:
    """Rigid nodes at one time, in units of the model.

    Args:
        x: Positions, shape (n, 3).
        R: Section frames, shape (n, 3, 3).
        v: Velocities, shape (n, 3).
        Ω: Angular velocities in section axes, shape (n, 3).
    """

    x: Array
    R: Array
    v: Array
    Ω: Array


class Rule(Protocol):
    """An explicit rule."""

    @property
    def name(self) -> str:
        """In words."""

    def step(self, now: Nodes, a: Array, α: Array, dt: float) -> Nodes:
        """From accelerations at the start of a step, those of the spin in section axes, to its end."""


@dataclass(frozen=True)
class ForwardEuler:
    """r₁ = r₀ + Δt v₀, v₁ = v₀ + Δt a₀: each vibration grows by √(1 + ω²Δt²) a step, whatever the step."""

    name: str = "forward Euler"

    def step(self, now: Nodes, a: Array, α: Array, dt: float) -> Nodes:
        """Both by the rates at the start."""
        return Nodes(now.x + dt * now.v, now.R @ exp(dt * now.Ω), now.v + dt * a, now.Ω + dt * α)


@dataclass(frozen=True)
class SymplecticEuler:
    """v₁ = v₀ + Δt a₀, r₁ = r₀ + Δt v₁, the central differences of explicit codes: bounded while Δt < 2/ω_max."""

    name: str = "symplectic Euler"

    def step(self, now: Nodes, a: Array, α: Array, dt: float) -> Nodes:
        """Velocities first, positions by the new ones."""
        v, Ω = now.v + dt * a, now.Ω + dt * α
        return Nodes(now.x + dt * v, now.R @ exp(dt * Ω), v, Ω)


@dataclass(frozen=True, eq=False)
class Moved:
    """How an explicit run ended.

    Args:
        nodes: At its end.
        steps: Taken.
        lost: Whether it blew up: numbers beyond all bounds, or more energy gained than was ever put in.
        gained: Energy that the steps made or destroyed, EI/L.
        supplied: Largest work of the loads, or energy at the start [EI/L].
    """

    nodes: Nodes
    steps: int
    lost: bool
    gained: float
    supplied: float


class Explicit:
    """The discrete model of a scene, with explicit steps.

    Args:
        scene: The problem: dead loads, supports at rest that hold sections whole.
        elements: Of each rod.

    Attributes:
        mesh: Nodes and elements.
        inertia: Of the nodes.
        held: Velocities and spins that are zero, shape (n, 6).
    """

    def __init__(self, scene: Scene, elements: int) -> None:
        self.mesh = mesh(scene, elements)
        self._law = ChordElement(self.mesh.elements, paper_strain=False)
        self._loads = Loads(scene, self.mesh)
        self.inertia = Inertia(*node_masses(self.mesh, [rod.section for rod in scene.rods], whole_ends=False))
        self.held: Places = Supports(scene, self.mesh).firm

    def rest(self) -> Nodes:
        """Stress free and at rest."""
        x = self.mesh.x
        return Nodes(x, self.mesh.R, np.zeros_like(x), np.zeros_like(x))

    def forces(self, now: Nodes, t: float) -> tuple[Array, Array, float]:
        """Loads and internal forces at the nodes, shape (n, 7), and the strain energy."""
        elements = self.mesh.elements
        e = now.x[elements.node_i + 1] - now.x[elements.node_i]
        F_n = (np.sqrt(np.einsum("ni,ni->n", e, e)) - elements.l_0) / elements.compliance
        force, energy = self._law.measure(e, elements.triads(now.R), F_n)
        return self._loads.level(t).at(now.R), scatter(force, elements.node_i, len(now.x)), float(energy.sum())

    def accelerations(self, now: Nodes, missing: Array) -> tuple[Array, Array]:
        """Of positions and spins, the latter J*⁻¹(Rᵀ M − Ω × J* Ω) in section axes; zero where held."""
        J = self.inertia.J_star
        a = missing[:, X] / self.inertia.m[:, None]
        α = (np.einsum("nji,nj->ni", now.R, missing[:, SPIN]) - cross(now.Ω, J * now.Ω)) / J
        return np.where(self.held[:, :3], 0.0, a), np.where(self.held[:, 3:], 0.0, α)

    def run(self, rule: Rule, start: Nodes, dt: float, steps: int) -> Moved:
        """Take equal steps, and look now and then whether the energy is still what it should be.

        Args:
            rule: Of the steps.
            start: Where to begin, at t = 0.
            dt: Length of a step [s].
            steps: How many.

        Returns:
            Where they lead to, or where they were lost.
        """
        now, work, gained = start, 0.0, 0.0
        first = supplied = self.inertia.kinetic(start.v, start.Ω) + self.forces(start, 0.0)[2]
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            for k in range(steps):
                loads, internal, strain = self.forces(now, k * dt)
                if k % EVERY == 0:
                    gained = self.inertia.kinetic(now.v, now.Ω) + strain - first - work
                    if not gained <= LOST * supplied and k:
                        return Moved(now, k, True, gained, supplied)
                a, α = self.accelerations(now, loads - internal)
                after = rule.step(now, a, α, dt)
                work += float(np.vdot(loads[:, X], after.x - now.x))
                supplied = max(supplied, abs(work))
                now = after
            strain = self.forces(now, steps * dt)[2]
            gained = self.inertia.kinetic(now.v, now.Ω) + strain - first - work
        return Moved(now, steps, not gained <= LOST * supplied, gained, supplied)

    def letting_go(self, places: list[int]) -> Places:
        """What is held when motions of one kind alone are let go, of (u, v, w, θ_u, θ_v, θ_w) of a rod along x."""
        held = np.ones_like(self.held)
        held[:, places] = self.held[:, places]
        return held

    def kicked(self, size: float) -> Nodes:
        """At rest but for velocities and spins drawn at random, the same every time, where nothing holds."""
        rng = np.random.default_rng(0)
        rest = self.rest()
        v, Ω = (np.where(held, 0.0, size * rng.standard_normal(rest.v.shape)) for held in np.split(self.held, 2, 1))
        return replace(rest, v=v, Ω=Ω)
