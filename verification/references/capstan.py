"""A string round a rough drum: what it holds, how it slips before, and what polygons hold."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, exp, log, pi, sin, sqrt, tan

__all__ = ["Drum", "acceleration", "euler", "friction_of_polygon", "heavy", "polygon", "thick"]


def euler(mu: float, angle: float) -> float:
    """Largest T₂/T₁ of a string, e^{μθ}.

    Args:
        mu: Coefficient of friction.
        angle: θ, by which the string turns [rad].

    Source: Euler 1769.
    """
    return exp(mu * angle)


def polygon(mu: float, angle: float, chords: int) -> float:
    """The same of a string that turns at nodes only, by δ = θ/n at each and by δ/2 at the ends.

    Each chord adds ln (cos δ/2 + μ sin δ/2)/(cos δ/2 − μ sin δ/2): equilibrium of a node between chords, its reaction
    along the normal of the drum.

    Args:
        mu: Coefficient of friction.
        angle: θ [rad].
        chords: n.
    """
    half = 0.5 * angle / chords
    return float(((cos(half) + mu * sin(half)) / (cos(half) - mu * sin(half))) ** chords)


def friction_of_polygon(ratio: float, angle: float, chords: int) -> float:
    """μ of which a polygon holds T₂/T₁ = ratio: `polygon` the other way round."""
    step = ratio ** (1.0 / chords)
    return float((step - 1.0) / ((step + 1.0) * tan(0.5 * angle / chords)))


def thick(mu: float, angle: float, epsilon: float) -> float:
    """The same of a round rod, whose friction acts at its surface, e^{λθ}, λ (1 + εμλ) = μ (1 − ε).

    Friction has the arm R about the axis of the drum, tension the arm ρ = R + r, and the moment r μ p of friction about
    the centreline is balanced by a shear force Q = r μ p, which changes the pressure: p = (N − dQ/dφ)/ρ, dN/dφ =
    μ p (ρ − r). For a thin rod λ = μ (1 − ε (1 + μ²)).

    Args:
        mu: Coefficient of friction.
        angle: θ [rad].
        epsilon: ε = r/ρ, radius of the rod over that of its centreline.

    Source: own derivation for a rod free of moments; what happens at its ends is of order ε² in all.
    """
    arm = mu * (1.0 - epsilon)
    return exp(2.0 * arm / (1.0 + sqrt(1.0 + 4.0 * epsilon * mu * arm)) * angle)


def heavy(mu: float, hung: float) -> float:
    """Length h₂* that slips when a length h₁ of the same rope hangs on the other side of a drum of radius 1.

    h₂* = e^{μπ} h₁ + 2μ/(1 + μ²) (e^{μπ} + 1), both lengths over the radius: the rope on the drum weighs, too.

    Args:
        mu: Coefficient of friction.
        hung: h₁/R.

    Source: dT/dφ = μ (T + w R sin φ) + w R cos φ over half a turn, φ from the light side.
    """
    held = euler(mu, pi)
    return held * hung + 2.0 * mu / (1.0 + mu**2) * (held + 1.0)


def acceleration(mu: float, angle: float, light: float, strong: float, inertia: float) -> float:
    """Of a string without stretch that starts to slide, (T₂ − e^{μθ} T₁) μ/(ρA ρ (e^{μθ} − 1)).

    Args:
        mu: Coefficient of friction.
        angle: θ [rad].
        light: T₁ [N].
        strong: T₂ [N].
        inertia: ρA ρ, mass per angle [kg].

    Source: dT/dφ = μ T + ρA ρ a at no speed yet.
    """
    held = euler(mu, angle)
    return max(0.0, (strong - held * light) * mu / (inertia * (held - 1.0)))


@dataclass(frozen=True)
class Drum:
    """An elastic string round a drum, both ends raised together to T₁, then one of them to T₂ and back to T₁.

    Slip zones grow from the ends; T falls inwards by e^{−μφ} in them, or rises where an end is let back. An end moves
    by what their strains add up to; the size of load steps does not matter.

    Args:
        mu: Coefficient of friction.
        angle: θ [rad].
        radius: Of the string's centreline, ρ [m].
        EA: Axial stiffness [N].
        light: T₁ [N].

    Source: own derivation from dT/dφ = ±μ T where the string slips.
    """

    mu: float
    angle: float
    radius: float
    EA: float
    light: float = 1.0

    @property
    def limit(self) -> float:
        """T₂ at which the whole string slides [N]."""
        return self.light * euler(self.mu, self.angle)

    @property
    def raised(self) -> float:
        """Way of either end while both are raised to T₁ [m]."""
        return self._slipped(0.5 * self.angle, self.light)

    def pulled(self, strong: float) -> float:
        """Way of the end raised to T₂ after both had T₁ [m].

        Raises:
            ValueError: T₂ is beyond the limit.
        """
        reach = 0.5 * (self.angle + log(strong / self.light) / self.mu)
        if reach > self.angle * (1.0 + 1e-12):
            raise ValueError(f"T₂ must be at most {self.limit} N, got {strong} N")
        outwards, inwards = self._slipped(reach, strong), self._slipped(self.angle - reach, self.light)
        return outwards + inwards - self.raised

    def back(self, strong: float) -> float:
        """Its way since the start when it is let down to T₁ again, less by ρ/(μ EA) (√T₂ − √T₁)² [m]."""
        return self.pulled(strong) - self.radius / (self.mu * self.EA) * (sqrt(strong) - sqrt(self.light)) ** 2

    def loss(self, strong: float) -> float:
        """What friction takes while the end goes from T₂ to T₁ and to T₂ again [J].

        ∮ T du = ρ/(3 μ EA) (√T₁ + √T₂) (√T₂ − √T₁)³.
        """
        a, b = sqrt(self.light), sqrt(strong)
        return self.radius / (3.0 * self.mu * self.EA) * (a + b) * (b - a) ** 3

    def further(self, strong: float, phi: float) -> float:
        """Tension at an angle φ from the light end, both ends raised to T₁, the other further to T₂ [N]."""
        return max(self.light * exp(-self.mu * min(phi, self.angle - phi)), strong * exp(-self.mu * (self.angle - phi)))

    def let_back(self, strong: float, phi: float) -> float:
        """The same, both ends raised to T₂ and the light one let back to T₁ [N]."""
        return min(strong * exp(-self.mu * min(phi, self.angle - phi)), self.light * exp(self.mu * phi))

    def _slipped(self, reach: float, tension: float) -> float:
        """Stretch of a zone with T e^{−μφ} from an end to φ = reach [m]."""
        return tension * (1.0 - exp(-self.mu * reach)) / self.mu * self.radius / self.EA
