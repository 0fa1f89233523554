"""Two equal rods wound about each other into an even helix: exact for round rods of any EI, GJ and EA, shear-rigid.

Both run on radius R at an angle α to the axis, opposite each other, so that their axes are 2R apart and press on each
other by p = ε_N (g_0 − 2R + 2r) along the radius. Per stress-free length, with λ the stretch and t, N = −e_r, b the
tangent, normal and binormal of either,

    φ′ = λ sin α/R, κ = φ′ sin α, τ = φ′ cos α,  m = M t + B b, B = EI (κ − κ₀), M = GJ (τ − τ₀),
    n = S t + V b, V = (κ M − τ B)/λ  (moments about N),  p = κ S − τ V  (forces along N),  S = EA (λ − 1):

forces along t and b and moments about t and b balance by themselves. κ₀ and τ₀ are those of the stress-free helix,
zero for rods that were straight and whose ends turned with the ply. Opposite is nearest while tan α < 1.

Source: balance of Kirchhoff's rods (Love 1944, § 270) with a line load; our own derivation.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin, tan

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

__all__ = ["Ply", "helix"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Ply:
    """An even ply.

    Args:
        radius: R, of the axes of the rods [m].
        angle: α, of the rods to the axis of the ply; positive winds with a right hand (Z) [rad].
        rod: r, of the rods' surface [m].
        eps_N: [N/m²].
        g_0: Gap where contact begins [m].
        EA: [N].
        GJ: [N m²].
        EI: [N m²].
        natural: τ₀ and κ₀, stress free [1/m].

    Raises:
        ValueError: So steep that the rods are nearest elsewhere.
    """

    radius: float
    angle: float
    rod: float
    eps_N: float
    g_0: float
    EA: float
    GJ: float
    EI: float
    natural: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        if not abs(tan(self.angle)) < 1.0:
            raise ValueError(f"must be less than π/4 for the rods to be nearest opposite, got {self.angle}")

    @property
    def gap(self) -> float:
        """Between the surfaces [m]."""
        return 2.0 * (self.radius - self.rod)

    @property
    def line_load(self) -> float:
        """p [N/m]."""
        return self.eps_N * max(self.g_0 - self.gap, 0.0)

    @property
    def stretch(self) -> float:
        """λ with which forces along the radius balance."""
        return float(brentq(lambda λ: self._resultants(λ)[4] - self.line_load, 0.5, 2.0, xtol=1e-16, rtol=1e-15))

    @property
    def curvature(self) -> tuple[float, float]:
        """τ and κ [1/m]."""
        turn = self.turn
        return turn * cos(self.angle), turn * sin(self.angle)

    @property
    def turn(self) -> float:
        """φ′, by which the ply turns about its axis [rad/m]."""
        return self.stretch * sin(self.angle) / self.radius

    def _resultants(self, λ: float) -> tuple[float, float, float, float, float]:
        """S, V, M, B, and the line load that they balance."""
        turn = λ * sin(self.angle) / self.radius
        κ, τ = turn * sin(self.angle), turn * cos(self.angle)
        M, B = self.GJ * (τ - self.natural[0]), self.EI * (κ - self.natural[1])
        S, V = self.EA * (λ - 1.0), (κ * M - τ * B) / λ
        return S, V, M, B, κ * S - τ * V

    @property
    def force(self) -> Array:
        """n of either rod along t, N, b [N]."""
        S, V, *_ = self._resultants(self.stretch)
        return np.array([S, 0.0, V])

    @property
    def moment(self) -> Array:
        """m of either rod along t, N, b [N m]."""
        _, _, M, B, _ = self._resultants(self.stretch)
        return np.array([M, 0.0, B])

    @property
    def tension(self) -> float:
        """Of both rods, along the axis [N]."""
        S, _, V = self.force
        return float(2.0 * (S * cos(self.angle) + V * sin(self.angle)))

    @property
    def torque(self) -> float:
        """Of both rods about the axis: their moments, and their forces around at R [N m]."""
        (S, _, V), (M, _, B) = self.force, self.moment
        around = S * sin(self.angle) - V * cos(self.angle)
        return float(2.0 * (M * cos(self.angle) + B * sin(self.angle) + self.radius * around))

    def centreline(self, s: Array, phase: float = 0.0) -> Array:
        """Of a rod, the axis of the ply along x, φ = phase at the start, shape (n, 3) [m]."""
        return helix(self.radius, self.turn, self.stretch * cos(self.angle), s, phase)

    def frames(self, s: Array, phase: float = 0.0) -> Array:
        """Columns t, N, b, shape (n, 3, 3)."""
        φ = phase + self.turn * np.asarray(s)
        o, c, d = 0.0 * φ, np.cos(φ), np.sin(φ)
        out, around, along = np.stack([o, c, d], -1), np.stack([o, -d, c], -1), np.stack([o + 1.0, o, o], -1)
        t = cos(self.angle) * along + sin(self.angle) * around
        return np.stack([t, -out, np.cross(t, -out)], axis=-1)

    def off_balance(self, s: Array) -> tuple[float, float]:
        """What n′ + f and m′ + r′ × n come to by differences along the curve itself, over φ′n and φ′m."""
        step = 1e-3 / abs(self.turn)

        def by_s(of: NDArray[np.float64]) -> Array:
            before, near, after, far = of
            return np.asarray((8.0 * (after - near) - (far - before)) / (12.0 * step))

        places = [np.asarray(s) + k * step for k in (-2, -1, 1, 2)]
        n_s = by_s(np.stack([self.frames(at) @ self.force for at in places]))
        m_s = by_s(np.stack([self.frames(at) @ self.moment for at in places]))
        r_s = by_s(np.stack([self.centreline(at) for at in places]))
        here = self.frames(s)
        couple = np.cross(r_s, here @ self.force)
        forces, moments = n_s - self.line_load * here[..., 1], m_s + couple
        scales = (abs(self.turn) * float(np.linalg.norm(part)) for part in (self.force, self.moment))
        of_n, of_m = (float(np.abs(off).max() / scale) for off, scale in zip((forces, moments), scales, strict=True))
        return of_n, of_m


def helix(radius: float, turn: float, rise: float, s: Array, phase: float = 0.0) -> Array:
    """Points (rise·s, R cos φ, R sin φ), φ = phase + turn·s, shape (n, 3) [m]."""
    φ = phase + turn * np.asarray(s)
    return np.stack([rise * np.asarray(s), radius * np.cos(φ), radius * np.sin(φ)], axis=-1)
