"""Longest stable steps of an explicit scheme on the paper's fibre: measured, from the matrices, in closed form.

Waves of one kind alone are let go, kicked at random and stepped; the step is bisected between those that keep the kick
small and those that make it grow. Linear theory says 2/ω_max; on a long chain of elements of length l that is

    axial     l √(ρA/EA)                       nodes moving against their neighbours
    torsion   l √(ρI₁/GJ)                      the same in spin
    bending   l √(ρA (3r² + l²)/EI) / 6        all nodes turning alike, J_v = m (3r² + l²)/12 against 12 EI/l

(J_v as in the paper, Eq. 9 with the inertia of a cylinder).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import eigvalsh

from discrete.unknowns import AXIAL
from dolfinrod.scene import Clamp, Dynamic, Rod, Scene, Section
from verification.explicit import Explicit, SymplecticEuler

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene import Load

    Array = NDArray[np.float64]

__all__ = ["LENGTH", "WAVES", "ExplicitLimit", "Wave", "explicit_limit", "fibre", "highest", "matrix"]

# The paper's fibre [m].
LENGTH = 0.04
# Steps after a kick, and the growth that tells a lost one: bounded motion stays below 1/√(1 − (Δt/limit)²).
STEPS, GROWTH = 250, 1e4
# Of displacements in L: small enough for linear theory, large enough for forces not to be round-off.
KICK = 1e-9
# Width of the last bracket, and how far the limit may lie from 2/ω_max: five times that.
WIDTH, NEAR = 1e-3, 5e-3
# The first bracket, in the closed form.
WIDEST = 2.0


@dataclass(frozen=True)
class Wave:
    """One kind of motion of a straight rod.

    Args:
        name: In words.
        places: What moves, of (u, v, w, θ_u, θ_v, θ_w).
        stated: Longest steps that process.md 1.1 states, by the length of an element [mm] [s].
    """

    name: str
    places: tuple[int, ...]
    stated: tuple[tuple[float, float], ...] = ()

    def closed(self, section: Section, l: float) -> float:
        """Longest step by the formula for a long chain [s]."""
        assert section.rhoA is not None
        assert section.rhoI is not None
        assert section.radius is not None
        ρA, r = section.rhoA, section.radius
        limits = {
            0: l * sqrt(ρA / section.EA),
            1: l * sqrt(ρA * (3.0 * r**2 + l**2) / section.EI[0]) / 6.0,
            3: l * sqrt(section.rhoI[0] / section.GJ),
        }
        return min(limits[place] for place in limits if place in self.places)


WAVES = (
    Wave("axial", (0,)),
    Wave("torsion", (3,), ((0.5, 4.9e-7),)),
    Wave("bending", (1, 2, 4, 5)),
    Wave("all together", (0, 1, 2, 3, 4, 5), ((0.5, 1.060e-7), (0.2, 4.240e-8))),
)


@dataclass(frozen=True)
class ExplicitLimit:
    """A limit three ways.

    Args:
        wave: Which motions were let go.
        l: Length of the elements [m].
        measured: Longest step that kept a kick small [s].
        matrices: 2/ω_max of the assembled matrices [s].
        closed: By the formula for a long chain [s].
        stated: In process.md 1.1 [s]; None where it states none.
    """

    wave: str
    l: float
    measured: float
    matrices: float
    closed: float
    stated: float | None

    @property
    def ratio(self) -> float:
        """Measured over 2/ω_max."""
        return self.measured / self.matrices

    @property
    def holds(self) -> bool:
        """They are one."""
        return abs(self.ratio - 1.0) <= NEAR


def fibre(motion: Dynamic | None = None, *loads: Load) -> Scene:
    """The paper's fibre, clamped at its start.

    Args:
        motion: In time; None: none.
        loads: What acts on it.

    Returns:
        The scene.
    """
    rod = Rod.straight(length=LENGTH, section=Section.ramie(), start=(0, 0, 0), direction=(1, 0, 0))
    return Scene([rod], [Clamp("start")], loads, motion=motion or Dynamic(1e-3, 1e-6))


def explicit_limit(wave: Wave, elements: int) -> ExplicitLimit:
    """Measure the longest stable step of the symplectic Euler rule, and work it out.

    Args:
        wave: Motions that are let go.
        elements: Of the fibre.

    Returns:
        The row.
    """
    rod = Explicit(fibre(), elements)
    rod.held = rod.letting_go(list(wave.places))
    l = LENGTH / elements
    closed = wave.closed(Section.ramie(), l)
    stable, lost = closed / WIDEST, closed * WIDEST
    while lost > stable * (1.0 + WIDTH):
        middle = sqrt(stable * lost)
        stable, lost = (stable, middle) if grows(rod, middle) else (middle, lost)
    stated = {round(1e-3 * mm, 9): dt for mm, dt in wave.stated}.get(round(l, 9))
    return ExplicitLimit(wave.name, l, stable, 2.0 / highest(rod), closed, stated)


def grows(rod: Explicit, dt: float) -> bool:
    """Whether steps of that length make a small kick large."""
    start = rod.kicked(KICK / dt)
    first = np.abs(start.v).max(), np.abs(start.Ω).max()
    most = GROWTH * max(first)
    rule, now = SymplecticEuler(), start
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for _ in range(STEPS):
            loads, internal, _ = rod.forces(now, 0.0)
            now = rule.step(now, *rod.accelerations(now, loads - internal), dt)
            if not max(np.abs(now.v).max(), np.abs(now.Ω).max()) <= most:
                return True
    return False


def highest(rod: Explicit) -> float:
    """Highest frequency of the assembled matrices of the straight, stress-free rod [rad/s]."""
    scaled, m = matrix(rod)
    return float(np.sqrt(eigvalsh(scaled, subset_by_index=[len(m) - 1] * 2)[0]))


def matrix(rod: Explicit) -> tuple[Array, Array]:
    """M^(−1/2) K M^(−1/2) of a straight, stress-free rod along x, and the masses, of whatever is not held.

    Args:
        rod: Its elements and nodes.

    Returns:
        Shapes (n, n) and (n,), rows in the order of (u, v, w, θ_u, θ_v, θ_w) node by node.
    """
    elements, n = rod.mesh.elements, len(rod.mesh.x)
    K = np.zeros((n * AXIAL, n * AXIAL))
    for i, k in zip(elements.node_i, elements.k_star, strict=True):
        at = slice(i * AXIAL, (i + 2) * AXIAL)
        K[at, at] += k
    m = np.hstack([np.repeat(rod.inertia.m[:, None], 3, axis=1), rod.inertia.J_star]).ravel()
    free = np.flatnonzero(~rod.held.ravel())
    return K[np.ix_(free, free)] / np.sqrt(np.outer(m[free], m[free])), m[free]
