"""Bodies that slide, stick and roll on rough walls, and bounce off them: closed forms per length of rod."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, atan2, cos, exp, log, pi, sin, sqrt, tan

from scipy.special import ellipk

__all__ = ["Bounce", "Incline", "Slide", "creep", "friction_angle", "moved_wall", "restitution", "swing_time", "wedge"]


@dataclass(frozen=True)
class Incline:
    """A body on a slope, released from rest: a block that may only slide, or a solid cylinder that may roll.

    Args:
        phi: Angle of the slope [rad].
        mu: Coefficient of friction.
        g: Weight per mass [m/s²].

    Source: textbook; I = m r²/2.
    """

    phi: float
    mu: float
    g: float = 9.81

    @property
    def block(self) -> float:
        """g (sin φ − μ cos φ), where that is positive [m/s²]."""
        return max(0.0, self.g * (sin(self.phi) - self.mu * cos(self.phi)))

    @property
    def rolls(self) -> bool:
        """Whether a cylinder does not slip: μ ≥ tan(φ)/3."""
        return self.mu >= tan(self.phi) / 3.0

    @property
    def cylinder(self) -> float:
        """Of its axis: 2/3 g sin φ, or that of the block where it slips [m/s²]."""
        return 2.0 / 3.0 * self.g * sin(self.phi) if self.rolls else self.block

    @property
    def spin(self) -> float:
        """Radius times the angular acceleration of the cylinder [m/s²]."""
        return self.cylinder if self.rolls else 2.0 * self.mu * self.g * cos(self.phi)


@dataclass(frozen=True)
class Slide:
    """A body pushed along a level plane at a speed v, without spin.

    Args:
        v: Its speed [m/s].
        mu: Coefficient of friction.
        g: Weight per mass [m/s²].

    Source: textbook; I = m r²/2.
    """

    v: float
    mu: float
    g: float = 9.81

    @property
    def stops(self) -> tuple[float, float]:
        """When and where a block does, v/μg and v²/2μg [s, m]."""
        return self.v / (self.mu * self.g), 0.5 * self.v**2 / (self.mu * self.g)

    @property
    def rolls(self) -> tuple[float, float, float]:
        """When, where and how fast a cylinder begins to roll, v/3μg and 5v²/18μg at 2v/3 [s, m, m/s]."""
        return self.v / (3.0 * self.mu * self.g), 5.0 * self.v**2 / (18.0 * self.mu * self.g), 2.0 * self.v / 3.0

    def cylinder(self, t: float) -> float:
        """Way of the cylinder at a time after it has begun to roll [m]."""
        begun, way, speed = self.rolls
        return way + speed * (t - begun)


def restitution(ratio: float) -> float:
    """Speed after an impact on a spring and a dashpot beside it over that before, where they never pull.

    What strikes them leaves when their force is zero, before the spring has its length again.

    Args:
        ratio: Of the damping to the critical one, ½ τ √(ε/ρA) [above 0].

    Source: Schwager & Pöschel, Granular Matter 9, 2007, DOI 10.1007/s10035-007-0065-z.
    """
    if ratio == 1.0:
        return exp(-2.0)
    if ratio < 1.0:
        ω = sqrt(1.0 - ratio**2)
        return exp(-ratio / ω * (pi - atan2(2.0 * ratio * ω, ω**2 - ratio**2)))
    Ω = sqrt(ratio**2 - 1.0)
    return exp(-ratio / Ω * log((ratio + Ω) / (ratio - Ω)))


@dataclass(frozen=True)
class Bounce:
    """A rod that meets a wall of stiffness ε at a speed v, broadside on and free of other loads.

    Args:
        v: Its speed towards the wall [m/s].
        rhoA: Mass per length [kg/m].
        eps_N: ε [N/m²].

    Source: ρA ẍ = −ε x while it touches.
    """

    v: float
    rhoA: float
    eps_N: float

    @property
    def depth(self) -> float:
        """v √(ρA/ε) [m]."""
        return self.v * sqrt(self.rhoA / self.eps_N)

    @property
    def time(self) -> float:
        """π √(ρA/ε) [s]."""
        return pi * sqrt(self.rhoA / self.eps_N)

    def slides(self, mu: float, along: float) -> tuple[float, float]:
        """Speed along the wall, and that of the rod's surface by its spin, after it has slid all the while [m/s].

        Args:
            mu: Coefficient of friction.
            along: Speed along the wall before, across the rod.

        Raises:
            ValueError: It stops sliding before it leaves.
        """
        after, spin = along - 2.0 * mu * self.v, 4.0 * mu * self.v
        if after < spin:
            raise ValueError(f"must be at least {6.0 * mu * self.v} m/s to slide on, got {along} m/s")
        return after, spin


def moved_wall(v: float, mu: float, q: float, rhoA: float) -> tuple[float, float]:
    """When a rod pressed by q against a wall that moves at v has its speed, and how far behind it is then [s, m]."""
    t = v * rhoA / (mu * q)
    return t, 0.5 * v * t


def creep(v_0: float, mu: float, normal: float, along: float) -> float:
    """Speed v_0 W/√(μ²N² − W²) of what friction −μ N v/√(v² + v_0²) cannot hold against W < μ N [m/s]."""
    return v_0 * along / sqrt((mu * normal) ** 2 - along**2)


def swing_time(amplitude: float, length: float, g: float) -> float:
    """Period of a body that slides to and fro without friction in a round groove, as a pendulum does [s].

    4 √(ℓ/g) K(sin²(a/2)), ℓ the radius on which its centre moves.
    """
    return float(4.0 * sqrt(length / g) * ellipk(sin(0.5 * amplitude) ** 2))


def wedge(weight: float, degrees: float, mu: float) -> tuple[float, float]:
    """Force of each wall of a V, and that along it at which a rod slides: W/(2 sin α) and μ W/sin α.

    Args:
        weight: W, across.
        degrees: α, of each wall from the plane of symmetry [°].
        mu: Coefficient of friction.
    """
    N = weight / (2.0 * sin(degrees * pi / 180.0))
    return N, 2.0 * mu * N


def friction_angle(mu: float) -> float:
    """Steepest slope on which a block rests [rad]."""
    return atan(mu)
